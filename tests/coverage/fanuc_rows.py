"""FANUC: each row of the inventory that is built has scenarios: one that runs, one at its boundaries, and a wrong use that
is told by its line; each row that is not built is refused by name. Run by coverage_test.py."""
import csv
import re
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FOLDER = ROOT / "tests/scenarios/fanuc"

NUMBERLESS = {"AND": "60", "OR": "61", "NOT": "62"}  # functions without an operand on their line
SPELLINGS = {"RD.STK.NOT": "RD.NOT.STK"}
CONTACTS = {"RD", "RD.NOT", "RD.STK", "RD.NOT.STK", "AND", "AND.NOT", "OR", "OR.NOT", "RDNT"}
PARAMETER = re.compile(r"-?\d+|[A-Z]\d+", re.IGNORECASE)


class Table:
    """The rows of the inventory; a row is named by its mnemonic, a function that a command shares its name with by `SUB n`."""

    def __init__(self):
        with (ROOT / "tests/unit/fanuc/instructions.csv").open() as file:
            rows = list(csv.DictReader(file))
        self.commands = {row["mnemonic"] for row in rows if not row["func_number"]}
        self.names = {row["func_number"]: self.name(row) for row in rows if row["func_number"]}
        self.functions = {name: name for name in self.names.values()}
        self.built = {self.name(row) for row in rows if row["certainty"] != "low"}
        self.unbuilt = {self.name(row) for row in rows if row["certainty"] == "low"}
        self.plain = {self.name(row) for row in rows if row["parameters"] == "-" and row["conditions"] == "-"}

    def name(self, row):
        return f"SUB {row['func_number']}" if row["func_number"] and row["mnemonic"] in self.commands else row["mnemonic"]


class Program:
    """The rows that are used on each line of a mnemonic file. A parameter's line belongs to its function."""

    def __init__(self, path, table):
        self.table = table
        raw = path.read_bytes()
        encoding = "utf-16" if raw[:2] in (b"\xff\xfe", b"\xfe\xff") else "utf-16-le" if raw[1:2] == b"\0" else "latin-1"
        self.lines = list(self.owners(raw.decode(encoding).splitlines()))

    def owners(self, lines):
        function, inside = None, not any(line.strip().upper().startswith("%@3") for line in lines)
        for line in lines:
            text = line.strip()
            if text.startswith("%"):
                inside, function = text.upper().startswith("%@3"), None
            words = re.sub(r"^\s*N\d+:|;.*|\(\*.*?\*\)", " ", line).split() if inside else []
            found = self.row(words) if words else None
            if found is not None:
                function = found if found not in self.table.commands else None
            yield found or (function if words else None)

    def row(self, words):
        word = SPELLINGS.get(words[0].upper(), words[0].upper())
        if word == "SUB" and len(words) > 1:
            return self.table.names.get(words[1].lstrip("0"), self.table.functions.get(words[1].upper()))
        if len(words) > 1 and words[1].upper() == "SP":
            return "SP"
        if word in NUMBERLESS and len(words) == 1:
            return self.table.names[NUMBERLESS[word]]
        if word in self.table.commands and (len(words) > 1 or word not in CONTACTS):
            return word
        return self.table.functions.get(word)


class Scenario:
    def __init__(self, path, table):
        self.path = path
        text = path.read_text(errors="replace")
        words = [word for line in re.findall(r"^program (.*)$", text, re.MULTILINE) for word in line.split("#")[0].split()]
        self.programs = [Program(path.parent / word, table) for word in words if (path.parent / word).is_file()]
        self.told = re.findall(r"^expect_(error|warning) (\d+) (\S+)", text, re.MULTILINE)
        steps = re.search(r"^(?:scan|fast|slot|run)\b", text, re.MULTILINE)
        expects = re.search(r"^expect(?:_range|_message|_call|_fault)? ", text, re.MULTILINE)
        self.runs = bool(steps and expects) and not any(kind == "error" for kind, *_ in self.told)

    def used(self):
        return {row for program in self.programs for row in program.lines if row}

    def reported(self):
        for _, number, code in self.told:
            for program in self.programs:
                if int(number) <= len(program.lines):
                    yield program.lines[int(number) - 1], code


class FanucRows(unittest.TestCase):
    maxDiff = None

    @classmethod
    def setUpClass(cls):
        cls.table = Table()
        cls.scenarios = [Scenario(path, cls.table) for path in sorted(FOLDER.rglob("*.scn"))]

    def used_where(self, wanted):
        return {row for scenario in self.scenarios if scenario.runs and wanted(scenario.path.stem) for row in scenario.used()}

    def test_every_row_has_a_scenario_that_runs(self):
        used = self.used_where(lambda name: "boundaries" not in name)
        self.assertEqual(sorted(self.table.built - used), [], "no scenario that runs uses it")

    def test_every_row_has_boundaries(self):
        used = self.used_where(lambda name: "boundaries" in name)
        self.assertEqual(sorted(self.table.built - self.table.plain - used), [], "no *-boundaries.scn that runs uses it")

    def test_every_row_has_a_wrong_use(self):
        told = {row for scenario in self.scenarios for row, code in scenario.reported() if code != "not-built-yet"}
        self.assertEqual(sorted(self.table.built - told), [], "no expect_error or expect_warning points at a line of these")

    def test_every_row_of_low_certainty_is_refused(self):
        told = {row for scenario in self.scenarios for row, code in scenario.reported() if code == "not-built-yet"}
        self.assertEqual(sorted(self.table.unbuilt - told), [], "no scenario expects not-built-yet at a line of these")

