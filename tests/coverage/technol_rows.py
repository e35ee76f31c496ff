"""TECHNOL: each row of the inventory and each diagnostic has scenarios of its own. Run by coverage_test.py."""
import csv
import re
import subprocess
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FOLDER = ROOT / "tests/scenarios/technol"
HERE = Path(__file__).resolve().parent

# What the compiler must reject in a TECHNOL program; (w) is a warning. Each is told with its line.
CODES = """
unbalanced-stack stack-underflow stack-overflow undefined-symbol duplicate-symbol reserved-word bad-identifier bad-number bad-string syntax-error
unknown-instruction unsupported-assembler operand-count operand-range wrong-operand-kind invalid-type-prefix untyped-operand type-mismatch
write-to-readonly too-many-bits dfm-needs-eight missing-label declaration-outside-data data-not-first missing-module duplicate-module
module-not-closed module-not-allowed missing-stop code-outside-module ex-outside-mechanism mech-name-mismatch mech-not-closed
nested-mechanism mech-loop-without-ex jump-crosses-unit proc-name-mismatch proc-not-closed nested-procedure recursive-procedure
init-only-instruction include-not-found code-in-include macro-not-closed macro-operand-count macro-recursion
unterminated-equation(w) name-too-long(w) cnts-prefix(w) jlo-alias(w) shared-name(w) reserved-word(w) mixed-real-integer(w) value-not-preserved(w)
tm-outside-dftm(w) string-too-long(w) text-after-stop(w)
""".split()

# Mnemonics that only stand beside another one share its scenario.
BESIDE = {"ENDS": "STRUC", "DB": "STRUC", "DW": "STRUC", "DD": "STRUC", "DUP": "STRUC", "END_T_MACRO": "DEF_T_MACRO", "T_LOCAL": "DEF_T_MACRO", "STI": "CLI",
          **{f"REGUL_{axis}": "REGUL_X" for axis in "YZ456"}}


def read(path):
    return path.read_text(encoding="utf-8", errors="replace")


def mnemonics_of(line, known):
    """The mnemonics of the inventory that stand in a line of a source text."""
    line = re.sub(r"'[^']*'?", "''", line)
    line = re.sub(r"^\s*[\w?@]+\s*:", "", line.split(";")[0]).upper()
    words = re.findall(r"[\w?@]+", line)
    found = {word for word in words[:1] if word in known}
    found |= {word for word in words[1:2] if word in ("STRUC", "ENDS", "DB", "DW", "DD")}  # behind a name
    return found | ({"DUP"} if re.search(r"\bDUP\s*\(", line) else set())


class Scenario:
    def __init__(self, path, known):
        self.path = path
        text = read(path)
        words = re.findall(r"^program (.*)$", text, re.MULTILINE)
        self.files = [path.parent / word for line in words for word in line.split("#")[0].split()]
        for file in self.files:  # grows: included files stand beside the file that includes them
            for name in re.findall(r"^\s*T_INCLUDE\s+'?([^\s';]+)", read(file), re.MULTILINE | re.IGNORECASE):
                included = file.parent / name
                if included.is_file() and included not in self.files:
                    self.files.append(included)
        self.lines = [[mnemonics_of(line, known) for line in read(file).splitlines()] for file in self.files]
        self.told = re.findall(r"^expect_(error|warning) (\d+) (\S+)", text, re.MULTILINE)
        expects = re.search(r"^expect(?:_range|_message|_log|_call|_fault)? ", text, re.MULTILINE)
        self.runs = bool(expects) and not any(kind == "error" for kind, *_ in self.told)

    def used(self):
        return {mnemonic for lines in self.lines for line in lines for mnemonic in line}

    def reported(self):
        """(mnemonic, code) of the lines that an expectation points at."""
        for _, number, code in self.told:
            for lines in self.lines:
                if int(number) <= len(lines):
                    yield from ((mnemonic, code) for mnemonic in lines[int(number) - 1])


class TechnolRows(unittest.TestCase):
    maxDiff = None
    RUNGC = None

    @classmethod
    def setUpClass(cls):
        with (ROOT / "tests/unit/technol/instructions.csv").open() as file:
            cls.rows = [row["mnemonic"] for row in csv.DictReader(file)]
        page = subprocess.run([cls.RUNGC, "doc", "technol"], capture_output=True, check=True).stdout.decode()
        entries = {re.match(r"\S+", entry)[0].rstrip(":"): entry for entry in re.split(r"^### ", page, flags=re.MULTILINE)[1:]}
        cls.built = {row for row in cls.rows if row in entries}
        cls.scenarios = [Scenario(path, set(cls.rows)) for path in sorted(FOLDER.rglob("*.scn"))]
        cls.reported = {pair for scenario in cls.scenarios for pair in scenario.reported()}

    def excused(self, name):
        text = read(HERE / name)
        return {word for line in text.splitlines() if not line.startswith("#") for word in line.split()}

    def compare(self, missing, name, text):
        """`missing` is what the list says, no more and no less: the list shrinks with each piece that is added."""
        excused = self.excused(name)
        self.assertEqual(sorted(set(missing) - excused), [], text)
        self.assertEqual(sorted(excused - set(missing)), [], f"these are there now: take them out of {name}")

    def own(self, mnemonic):
        names = {mnemonic, mnemonic.removesuffix("_END"), BESIDE.get(mnemonic, mnemonic)}
        return [s for s in self.scenarios if any(s.path.stem == name or s.path.stem.startswith(name + "-") for name in names)]

    def test_the_reference_lists_the_inventory(self):
        page = subprocess.run([self.RUNGC, "doc", "technol"], capture_output=True, check=True).stdout.decode()
        heads = re.findall(r"^### ([A-Z0-9_]+): ", page, re.MULTILINE)
        self.assertEqual(sorted(set(self.rows) - set(heads)), [])
        self.assertEqual(len(heads), len(set(heads)))

    def test_every_row_has_a_scenario_of_its_own_that_runs(self):
        missing = [m for m in self.built if not any(s.runs and m in s.used() for s in self.own(m))]
        self.compare(missing, "technol_rows_without_scenario.txt", "no tests/scenarios/technol/MNEMONIC.scn or MNEMONIC-*.scn runs a program that uses it")

    def test_every_row_has_a_wrong_use(self):
        told = {mnemonic for mnemonic, _ in self.reported}
        self.compare(self.built - told, "technol_rows_without_errors.txt", "no expect_error or expect_warning points at a line of these")

    def test_every_code_is_told_by_its_line(self):
        told = {(code, kind == "error") for s in self.scenarios for kind, _, code in s.told if kind == "warning" or s.path.stem.startswith("errors")}
        missing = [code for code in CODES if (code.removesuffix("(w)"), not code.endswith("(w)")) not in told]
        self.assertEqual(sorted(missing), [], "no errors-*.scn (for a warning: no scenario) expects it with its line")
