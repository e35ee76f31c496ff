"""NCT: each row of the inventory, each service, each diagnostic has scenarios of its own. Run by coverage_test.py."""
import csv
import re
import subprocess
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FOLDER = ROOT / "tests/scenarios/nct"

# What the compiler must reject in an NCT program; (w) is a warning. Each is told with its line.
CODES = """
address-format bit-format bit-out-of-range undeclared-symbol duplicate-symbol symbol-kind-mismatch address-out-of-range double-at-9999
odd-double-index user-area-required write-to-flags write-to-input(w) symbol-in-nc-area(w)
constant-format constant-out-of-range operand-count operand-type-mismatch operand-not-register unknown-instruction unknown-scope-symbol
unknown-function-code(w) message-format edge-with-immediate immediate-outside-int0 immediate-not-allowed modifier-not-allowed int0-only-signal(w) signal-index(w)
first-column-not-allowed first-column-required element-after-closing missing-closing-element missing-pin unknown-pin misaligned-box
dangling-wire unclosed-element tab-character empty-rung
duplicate-output mixed-output(w) label-out-of-range duplicate-label duplicate-subroutine label-conflict undefined-label undefined-subroutine
subroutine-before-end missing-ret ret-outside-subroutine recursive-call code-after-end duplicate-end jump-across-subroutine backward-jump(w)
label-unused(w) subroutine-unused(w) shared-state(w) unknown-module duplicate-module missing-main
""".split()

FILE_NAMES = {"+F": "ADDF", "-F": "SUBF", "*F": "MULF", "/F": "DIVF"}


def read(path):
    return path.read_text(encoding="utf-8-sig", errors="replace")


def split_outside(text, mark):
    """Splits at `mark` where it does not stand in parentheses."""
    parts, depth = [""], 0
    for c in text:
        depth += (c == "(") - (c == ")")
        if c == mark and depth == 0:
            parts.append("")
        else:
            parts[-1] += c
    return [part.strip() for part in parts]


class Operand:
    """An operand of a row as the inventory's CSV describes it: `Timer:word(PLCNVRAM-9999; ,index)`."""

    def __init__(self, text):
        self.name, _, kinds = text.partition(":")
        self.kinds = re.sub(r"\([^)]*\)|prefix.*", "", kinds).strip().split("|")
        self.range = self.range_of(kinds) if "dec" in self.kinds else None
        self.bcd = "BCD" in kinds
        self.kind = next((k for k in ("bit", "word", "double") if k in self.kinds), None)
        self.writes_user_memory = kinds.startswith(("word(PLCNVRAM", "double(PLCNVRAM"))

    def range_of(self, kinds):
        if "0 ms 1 s" in kinds:
            return (0, 3)  # a time basis
        found = re.search(r"\((\d+)-(2\^31|\d+)[ )]", kinds)
        if found is None:
            return (-(2**31), 2**31 - 1) if self.name in ("Operand", "Op2", "Data", "Variable") else None
        return (int(found[1]), 2**31 - 1 if "^" in found[2] else int(found[2]))

    def inside(self):
        """Texts of which a running program must have each: the last place, the ends of the range."""
        last = {"bit": ["9999.31"], "word": ["9999"], "double": ["9998"]}.get(self.kind, [])
        pattern = ["#$99999999" if self.bcd else "#$FFFFFFFF"] if "hex" in self.kinds and self.range is None else []
        return last + pattern + [f"#{value}" for value in self.range or ()]

    def outside(self):
        """Texts that an error must tell: one step further."""
        last = {"bit": ["9999.31,#1"], "word": ["9999,#1"], "double": ["9999"]}.get(self.kind, [])
        pattern = ["#$100000000"] if "hex" in self.kinds else []
        return last + pattern + ([f"#{self.range[0] - 1}", f"#{self.range[1] + 1}"] if self.range else [])


class Drawing:
    """What stands on the lines of a program file: (line, mnemonic of the inventory, operands)."""

    ELEMENT = re.compile(r'\[[^\]]*\]|\([^)]*\)|\{(?:"[^"]*"|[^}"])*\}|;.*')

    def __init__(self, path, bits):
        self.path = path
        self.elements = []
        for number, line in enumerate(read(path).splitlines(), 1):
            if line.startswith("section"):
                self.elements.append((number, "SEC", []))
            if line[:1] in ("|", " "):
                for match in self.ELEMENT.finditer(line):
                    if match[0][0] != ";":
                        self.elements.append((number, *self.element(match[0], bits)))

    @staticmethod
    def element(text, bits):
        inner = text[1:-1].strip()
        if text[0] == "{":
            words = re.findall(r'"[^"]*"|\S+', inner)
            return (words[0] if words else ""), words[1:]
        negated = inner.startswith("/")
        operand = inner.lstrip("/@%!")
        if text[0] == "(":
            form = re.match(r"([SR])\s+(.*)", inner)
            return ({"S": "SET", "R": "RST"}[form[1]], [form[2].lstrip("@%!")]) if form else ("negated-coil" if negated else "coil", [operand])
        on_bit = "." in operand or ":" in operand or operand.split(",")[0] in bits
        return ("closed" if negated else "open") + ("-contact-bit" if on_bit else "-contact-dword"), [operand]


class Scenario:
    def __init__(self, path, signals):
        self.path = path
        self.text = read(path)
        lines = self.text.splitlines()
        words = next((line.split("#")[0].split()[1:] for line in lines if line.startswith("program ")), [])
        files = [path.parent / word for word in words]
        bits = set(signals)
        for file in files:
            bits.update(re.findall(r"^symbol\s+(\S+)\s+\S*[.:]", read(file), re.MULTILINE))
            for name, base in re.findall(r"^symbol\s+(\S+)\s+([A-Za-z_]\w*)(?:,\S+)?\s*(?:;.*)?$", read(file), re.MULTILINE):
                bits.update({name} if base in bits else set())
        self.drawings = [Drawing(file, bits) for file in files if file.suffix == ".lad"]
        self.told = {}  # line -> codes
        for line, code in re.findall(r"^expect_(?:error|warning) (\d+) (\S+)", self.text, re.MULTILINE):
            self.told.setdefault(int(line), set()).add(code)
        self.fails = re.search(r"^expect_error\b", self.text, re.MULTILINE) is not None
        steps = re.search(r"^(?:scan|fast|run)\b", self.text, re.MULTILINE)
        self.runs = not self.fails and steps is not None and re.search(r"^expect(?:_range|_message|_log|_call|_fault)? ", self.text, re.MULTILINE) is not None

    def elements(self):
        for drawing in self.drawings:
            yield from drawing.elements


class NctRows(unittest.TestCase):
    maxDiff = None
    RUNGC = None

    @classmethod
    def setUpClass(cls):
        with (ROOT / "tests/unit/nct/instructions.csv").open() as file:
            cls.rows = {row["mnemonic"]: row for row in csv.DictReader(file)}
        with (ROOT / "rtlib/nc/nct/signals.csv").open() as file:
            signals = list(csv.DictReader(file))
        flags = ["FL_ER", "FL_UF", "FL_OF", "FL_CY", "FL_GT", "FL_EQ", "FL_LT"]
        cls.signals = signals
        cls.scenarios = [Scenario(path, flags + [s["symbol"] for s in signals if s["type"] == "bit"]) for path in sorted(FOLDER.rglob("*.scn"))]
        cls.running = [scenario for scenario in cls.scenarios if scenario.runs]
        cls.operands = {m: [Operand(o) for o in split_outside(row["operands"], ";")] for m, row in cls.rows.items() if row["operands"] != "-"}

    def own(self, mnemonic):
        name = FILE_NAMES.get(mnemonic, mnemonic)
        return [s for s in self.scenarios if s.path.parent == FOLDER and (s.path.stem == name or s.path.stem.startswith(name + "-"))]

    def test_every_row_has_a_scenario_of_its_own_that_runs(self):
        missing = [m for m in self.rows if not any(s.runs and m in {e[1] for e in s.elements()} for s in self.own(m))]
        self.assertEqual(sorted(missing), [], "no tests/scenarios/nct/MNEMONIC.scn or MNEMONIC-*.scn runs a program that uses it")

    def test_every_row_has_a_wrong_use(self):
        told = {e[1] for s in self.scenarios for e in s.elements() if s.told.get(e[0], set()) - {"not-built-yet"}}
        self.assertEqual(sorted(set(self.rows) - told), [], "no expect_error or expect_warning points at a line of these")

    def test_the_ends_of_every_operand_are_tried(self):
        """The last address and both ends of a range in a program that runs, one step further in one that is refused."""
        used, refused = set(), set()
        for scenario in self.scenarios:
            for line, mnemonic, operands in scenario.elements():
                if scenario.runs or scenario.told.get(line, set()) & self.OUTSIDE:
                    (used if scenario.runs else refused).update((mnemonic, i, text) for i, text in enumerate(operands))
        missing = []
        for mnemonic, operands in self.operands.items():
            if mnemonic == "SEC":
                continue  # its text has no ends
            for i, operand in enumerate(operands):
                missing += [f"{mnemonic} {i + 1} runs {text}" for text in operand.inside() if (mnemonic, i, text) not in used]
                missing += [f"{mnemonic} {i + 1} refuses {text}" for text in operand.outside() if (mnemonic, i, text) not in refused]
                if operand.writes_user_memory and self.rows[mnemonic]["category"] in ("timer", "counter", "nc-service"):
                    missing += [f"{mnemonic} {i + 1} refuses 3999"] if (mnemonic, i, "3999") not in refused else []
                    missing += [f"{mnemonic} {i + 1} runs 4000"] if not {(mnemonic, i, "4000"), (mnemonic, i, "PLCNVRAM")} & used else []
        self.assertEqual(sorted(missing), [], "see class Operand for what is looked for")

    OUTSIDE = {"address-out-of-range", "double-at-9999", "user-area-required", "constant-out-of-range", "label-out-of-range"}

    def test_every_operand_meets_an_index_that_leaves_the_memory_while_it_runs(self):
        """The row with a register as index of that operand, and FL_ER looked at on one of the next lines (MR, MW have execution codes)."""
        tried = set()
        for scenario in self.running:
            for drawing in scenario.drawings:
                looks = {line for line, mnemonic, operands in drawing.elements if operands[:1] == ["FL_ER"]}
                for line, mnemonic, operands in drawing.elements:
                    if looks & set(range(line + 1, line + 10)) or mnemonic in ("MR", "MW"):
                        tried.update((mnemonic, i) for i, text in enumerate(operands) if re.search(r",[0-9A-Za-z]", text))
        missing = [f"{m} {i + 1}" for m, operands in self.operands.items() for i, o in enumerate(operands) if o.kind and (m, i) not in tried]
        self.assertEqual(sorted(missing), [], "no scenario that runs has a register as index there")

    def test_every_code_is_told_by_its_line(self):
        told = {(code, kind == "error") for s in self.scenarios for kind, code in re.findall(r"^expect_(error|warning) \d+ (\S+)", s.text, re.MULTILINE)
                if kind == "warning" or s.path.stem.startswith("errors")}
        missing = [code for code in CODES if (code.removesuffix("(w)"), not code.endswith("(w)")) not in told]
        self.assertEqual(sorted(missing), [], "no errors-*.scn (for a warning: no scenario) expects it with its line")

    def test_every_scope_symbol_and_axis_code_is_used(self):
        used = {(e[1], i, text) for s in self.running for e in s.elements() for i, text in enumerate(e[2])}
        missing = [name for name in self.scope_symbols() if ("SCP", 1, name) not in used]
        codes = {int(code) for s in self.running for code in re.findall(r"^(?:expect_call|prepare) MOVCMND\b.*\bcode=(\d+)", s.text, re.MULTILINE)}
        missing += [f"axis code {code}" for code in range(15) if code not in codes and ("MOVCMND", 1, f"#{code}") not in used]
        self.assertEqual(sorted(missing), [], "no scenario that runs uses it")

    def test_every_execution_code_of_every_function_is_brought_about(self):
        """services/{mr,mw}-F.scn has a line `expect PLACE CODE  # execution code CODE` for each code of the function."""
        functions = re.findall(r"^### (MR|MW) (\d+)\n\n(?:.+\n)*?.*Execution\s+codes:\s+([\d,\s]+)\.", self.reference(), re.MULTILINE)
        self.assertEqual(len(functions), 33)
        missing = []
        for mnemonic, number, codes in functions:
            path = FOLDER / f"services/{mnemonic.lower()}-{number}.scn"
            text = read(path) if path.exists() else ""
            told = {code for code, said in re.findall(r"^expect \S+ (\d+)\s+# execution code (\d+)\b", text, re.MULTILINE) if code == said}
            missing += [f"{mnemonic} {number} code {code}" for code in re.split(r",\s+", codes) if code not in told]
        self.assertEqual(sorted(missing), [], "the function's own scenario does not expect this execution code")

    def scope_symbols(self):
        names = re.findall(r"^\| `(\w+)` \|", self.reference().split("## Quantities of SCP")[1].split("\n## ")[0], re.MULTILINE)
        self.assertEqual(len(names), 46)
        return names

    def test_the_reference_has_every_signal(self):
        text = self.reference().split("\n## Signals")[1]
        self.assertEqual(sorted(re.findall(r"^\| `(\w+)` \|", text, re.MULTILINE)), sorted(s["symbol"] for s in self.signals))

    def test_every_group_of_signals_is_used_in_both_directions(self):
        """A scenario that runs writes a signal of each group and direction by `set`, or reads it by `expect`, or its program names it."""
        used = {re.split(r"[.,:]", text.lstrip("!@%/"))[0] for s in self.running for e in s.elements() for text in e[2]}
        for scenario in self.running:
            used.update(re.split(r"[.,:]", name)[0] for name in re.findall(r"^(?:set|expect) !?(\S+)", scenario.text, re.MULTILINE))
        groups = {(s["group"], s["direction"]) for s in self.signals}
        touched = {(s["group"], s["direction"]) for s in self.signals if s["symbol"] in used}
        self.assertEqual(sorted([f"{g} {d}" for g, d in groups - touched]), [], "no scenario that runs touches a signal of the group")

    @classmethod
    def reference(cls):
        if not hasattr(cls, "page"):
            cls.page = subprocess.run([cls.RUNGC, "doc", "nct"], capture_output=True, check=True).stdout.decode()
        return cls.page
