"""TECHNOL: every name of the control's interface is there, of its type, and written only where it may be. Run by coverage_test.py."""
import csv
import json
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FOLDER = ROOT / "tests/scenarios/technol"

FRAME = """MODULE_INPUT
MODULE_INPUT_END
MODULE_BLOCK_INIT
MODULE_BLOCK_INIT_END
MODULE_BLOCK_DONE
MODULE_BLOCK_DONE_END
MODULE_INIT
MODULE_INIT_END
MODULE_CLEAR
MODULE_CLEAR_END
MODULE_HALT
MODULE_HALT_END
STOP
"""
# MOVE takes two operands of one type only.
CELL = {"byte": "C1", "word": "C2", "dword": "C4", "qword": "QWRD.C8", "real": "REAL.C8"}
BYTES = {"byte": 1, "word": 2, "dword": 4, "qword": 8, "real": 8}


class Program:
    """Statements, and what each must be told."""

    def __init__(self):
        scratch = [f"{cell} ; allow(unused-name) allow(never-read) allow(never-written)"
                   for cell in ("T1: DFM TB,,,,,,,", "C1: DS 1", "C2: DS 2", "C4: DS 4", "C8: DS 8")]
        self.lines = ["DATA", *scratch, "DATA_END", "MODULE_MAIN"]
        self.expected = []

    def add(self, statement, told=None):
        self.lines.append("        " + statement)
        if told:
            self.expected.append((len(self.lines), *told))

    def reads(self, name, kind):
        if kind == "bit":
            self.add(f"LDR {name}")
            self.add("WR TB")
        else:
            self.add(f"MOVE {CELL[kind]},{name}")

    def writes(self, name, kind, told):
        self.add(f"FL 1,{name}" if kind == "bit" else f"MOVE {name},{CELL[kind]}", told)

    def text(self):
        return "\n".join([*self.lines, "MODULE_MAIN_END"]) + "\n" + FRAME


class TechnolSignals(unittest.TestCase):
    maxDiff = None
    RUNGC = None

    @classmethod
    def setUpClass(cls):
        with (ROOT / "rtlib/nc/technol/signals.csv").open(newline="") as file:
            cls.rows = list(csv.DictReader(file))
        cls.weights = [row for row in cls.rows if row["index"].startswith(("bit ", "byte ", "in "))]
        cls.blocks = [row for row in cls.rows if row["symbol"].startswith("BLK[].")]
        cls.public = [row for row in cls.rows if row["group"].startswith(("RTM.", "SHARE")) or row["group"].endswith("(RtmVar)")]
        other = {id(row) for row in cls.weights + cls.blocks + cls.public}
        cls.members = [row for row in cls.rows if id(row) not in other and "." in row["symbol"]]
        other |= {id(row) for row in cls.members}
        cls.cells = [row for row in cls.rows if id(row) not in other]

    def assertTold(self, program):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "signals.plc"
            path.write_text(program.text())
            run = subprocess.run([self.RUNGC, "check", "--json", path], capture_output=True)
        told = [(entry["line"], entry["severity"], entry["code"]) for entry in json.loads(run.stdout)]
        self.assertEqual([(*entry, program.lines[entry[0] - 1]) for entry in told],
                         [(*entry, program.lines[entry[0] - 1]) for entry in program.expected])

    @staticmethod
    def toldOfWriting(row):
        """Cells of chapter 8 that the program may only read are protected, those of other chapters warn (an example writes one)."""
        if row["direction"] != "in":
            return None
        return ("error" if row["group"].startswith("8.") else "warning", "write-to-readonly")

    @staticmethod
    def last(row):
        """The number of the last element of an array."""
        found = re.fullmatch(r"0\.\.(\d+)", row["index"])
        return int(found[1]) if found else 0

    def test_every_cell(self):
        self.assertGreater(len(self.cells), 1500)
        program = Program()
        for row in self.cells:
            name, kind = row["symbol"], row["type"]
            if kind == "struct":
                continue
            program.reads(name, kind)
            program.writes(name, kind, self.toldOfWriting(row))
            if self.last(row) and kind != "bit":
                end = f"{name}+{self.last(row) * BYTES[kind]}"
                program.reads(end, kind)
                program.writes(end, kind, self.toldOfWriting(row))
        self.assertTold(program)

    def test_every_member(self):
        program = Program()
        seen = set()
        for struct in (row for row in self.cells if row["type"] == "struct"):
            for row in self.members:
                owner, _, member = row["symbol"].partition(".")
                if owner != struct["layout"] or row["type"] in ("struct", "string"):
                    continue
                seen.add(row["symbol"])
                program.reads(f'{struct["symbol"]}.{member}', row["type"])
        self.assertTold(program)
        owners = {symbol.partition(".")[0] for symbol in seen}
        self.assertEqual(sorted({row["symbol"].partition(".")[0] for row in self.members} - owners), ["INOUTS"])  # by CAN_SYSIO_READ only
        self.assertGreater(len(seen), 30)

    def test_every_weight(self):
        program = Program()
        for row in self.weights:
            program.reads(f'C1.{row["symbol"]}', "bit")
            program.writes(f'(C2+1).{row["symbol"]}', "bit", None)
        self.assertTold(program)

    def test_every_element_of_a_block(self):
        program = Program()
        told = ("error", "write-to-readonly")
        for row in self.blocks:
            element, last = row["symbol"][6:], self.last(row)
            for index in [""] + ([f"[{last}]"] if last else []):
                if row["type"] == "bit":
                    program.reads(f"BLK[0].{element}{index}", "bit")
                    program.writes(f"BLK[15].{element}{index}", "bit", told)
                else:
                    prefix = "REAL." if row["type"] == "real" else ""
                    program.add(f"LOD BLK[1].{prefix}{element}{index}")
                    program.add(f"STO BLK[1].{prefix}{element}{index}", told)
        self.assertTold(program)

    def test_names_of_screens_and_connections_are_none_of_a_program(self):
        names = {row["symbol"].upper() for row in self.cells + self.weights}
        program = Program()
        told = set()
        for row in self.public:
            name = row["symbol"]
            if name.upper() in names or not re.fullmatch(r"[A-Za-z_]\w{0,30}", name) or name.upper() in told:
                continue
            told.add(name.upper())
            program.add(f"LOD {name}", ("error", "undefined-symbol"))
        self.assertGreater(len(told), 300)
        self.assertTold(program)

    def test_every_group_has_a_scenario_in_each_direction(self):
        """Given by the NC and read by the program, or written by the program and read by the NC."""
        given, read = set(), set()
        for path in FOLDER.glob("*.scn"):
            for word, name in re.findall(r"^\s*(set|expect|block start) (.*)$", path.read_text(), re.MULTILINE):
                for part in name.split() if word == "block start" else [name.split()[0]]:
                    symbol = re.sub(r"\[\d+\]", "[]", part.partition("=")[0]).upper()
                    (read if word == "expect" else given).update({symbol, symbol.partition(".")[0], symbol.partition(".")[2], re.sub(r"\[\]$", "", symbol), re.sub(r":\d+$|\+\d+.*$", "", symbol)})
        groups = {}
        for row in self.cells + self.weights + self.blocks:
            directions = {"in": "in", "out": "out"}.get(row["direction"], "in out").split()
            for direction in directions:
                groups.setdefault((row["group"], direction), set()).add(row["symbol"].upper())
        missing = sorted(group for group, names in groups.items() if not names & (given if group[1] == "in" else read))
        self.assertEqual(missing, [], "no scenario sets (in) or expects (out) a signal of these groups")
