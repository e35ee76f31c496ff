#!/usr/bin/env python3
"""Looks for what no test touches: diagnostics that nothing raises, and instructions without a scenario. coverage_test.py RUNGC"""
import csv
import re
import subprocess
import sys
import unittest
from pathlib import Path

from fanuc_rows import FanucRows
from nct_rows import NctRows
from raised_codes import RaisedCodes, listed
from technol_errors import TechnolErrors
from technol_rows import TechnolRows
from technol_signals import TechnolSignals

RUNGC = None
ROOT = Path(__file__).resolve().parents[2]


class Coverage(unittest.TestCase):
    def test_every_built_instruction_has_a_scenario(self):
        excused = listed("instructions_without_scenario.txt")
        for dialect in ("fanuc", "gsk", "nct", "technol"):
            sources = self.running_programs(dialect)
            missing = [m for m, n in self.instructions(dialect) if not self.stands_in(m, n, sources) and f"{dialect}:{m}" not in excused]
            self.assertEqual(missing, [], f"{dialect}: instructions that no running scenario's program uses")

    @staticmethod
    def running_programs(dialect):
        """The programs, without comments, of all scenarios that run (and do not only look for errors)."""
        programs = set()
        for scenario in [*(ROOT / "tests/scenarios" / dialect).rglob("*.scn"), *ROOT.glob(f"examples/{dialect}-*/*.scn")]:
            text = scenario.read_text()
            if not re.search(r"^expect_error\b", text, re.MULTILINE):
                for words in re.findall(r"^program (.*)$", text, re.MULTILINE):
                    programs.update((scenario.parent / word).resolve() for word in words.split("#")[0].split())
        return "\n".join(re.sub(r";.*", "", path.read_text(errors="replace")) for path in sorted(programs))

    @staticmethod
    def instructions(dialect):
        """(mnemonic, function number or None) of the rows that are built, from the reference."""
        text = subprocess.run([RUNGC, "doc", dialect], capture_output=True, check=True).stdout.decode()
        for entry in re.split(r"^### ", text, flags=re.MULTILINE)[1:]:
            if "Not built yet." in entry:
                continue
            head = re.match(r"(\S+)(?: \(function (\d+)\))?: ", entry)
            if head:  # other headings of the reference have more words
                yield head.group(1), head.group(2)

    @staticmethod
    def stands_in(mnemonic, number, sources):
        if number is not None and re.search(rf"\b(?:FUNC|SUB)\s+0*{number}\b", sources):
            return True
        forms = {"open-contact-bit": r"\[[^/\]]", "closed-contact-bit": r"\[/", "open-contact-dword": r"\[[^/\]]", "closed-contact-dword": r"\[/",
                 "coil": r"\([^/SR)]", "negated-coil": r"\(/", "SET": r"\(S |\bSET\b", "RST": r"\(R |\bRST\b", "SEC": r"^section ",
                 "END1": r"module LEVEL2", "END2": r"module LEVEL2", "SP": r"module SUB", "SPE": r"module SUB"}
        if mnemonic in forms and re.search(forms[mnemonic], sources, re.MULTILINE):
            return True
        return re.search(rf"(?<![\w]){re.escape(mnemonic)}(?![\w])", sources, re.IGNORECASE) is not None


class GskRows(unittest.TestCase):
    """Each row of the GSK inventory that is built has scenarios of its own: one that runs, and a wrong use that is told by its line."""

    FOLDER = ROOT / "tests/scenarios/gsk"
    BASIC = {"LD", "LDI", "OUT", "OUTI", "AND", "ANI", "OR", "ORI", "ORB", "ANB", "SET", "RST"}

    @classmethod
    def setUpClass(cls):
        with (ROOT / "tests/unit/gsk/instructions.csv").open() as file:
            cls.rows = [(row["mnemonic"], row["func_number"]) for row in csv.DictReader(file)]
        cls.built = {mnemonic for mnemonic, _ in Coverage.instructions("gsk")}
        cls.functions = {number: mnemonic for mnemonic, number in cls.rows if number}
        cls.functions.update((mnemonic, mnemonic) for mnemonic, number in cls.rows if number)

    def test_the_reference_lists_the_inventory(self):
        text = subprocess.run([RUNGC, "doc", "gsk"], capture_output=True, check=True).stdout.decode()
        heads = re.findall(r"^### (\S+)(?: \(function (\d+)\))?: ", text, re.MULTILINE)
        self.assertEqual(sorted(heads), sorted(self.rows))

    def test_every_row_has_a_scenario_of_its_own_that_runs(self):
        missing = []
        for mnemonic in sorted(self.built):
            name = mnemonic.lower()
            scenarios = [self.FOLDER / f"{name}.scn", *sorted(self.FOLDER.glob(f"{name}-*.scn"))]
            if not any(path.exists() and self.runs(path.read_text()) and mnemonic in self.used(path) for path in scenarios):
                missing.append(mnemonic)
        self.assertEqual(missing, [], "no tests/scenarios/gsk/MNEMONIC.scn or MNEMONIC-*.scn runs a program that uses it")

    def test_every_row_has_a_wrong_use(self):
        told = set()
        for path in self.FOLDER.glob("*.scn"):
            lines = [int(n) for n in re.findall(r"^expect_(?:error|warning) (\d+) ", path.read_text(), re.MULTILINE)]
            for owners in self.owners(path) if lines else []:
                told.update(mnemonic for line in lines for mnemonic in owners.get(line, ()))
        excused = listed("gsk_rows_without_errors.txt")
        self.assertEqual(sorted(self.built - told - set(excused)), [], "no expect_error or expect_warning points at a line of these")
        self.assertEqual(sorted(set(excused) & told), [], "a scenario shows a wrong use now: take them out of gsk_rows_without_errors.txt")
        self.assertEqual([m for m, reason in excused.items() if not reason], [], "give a reason")

    @staticmethod
    def runs(text):
        steps = re.search(r"^(?:scan|fast|slot|run)\b", text, re.MULTILINE)
        return steps and re.search(r"^expect(?:_range|_message|_call|_fault)? ", text, re.MULTILINE) and not re.search(r"^expect_error\b", text, re.MULTILINE)

    @classmethod
    def used(cls, scenario):
        return {mnemonic for owners in cls.owners(scenario) for names in owners.values() for mnemonic in names}

    @classmethod
    def owners(cls, scenario):
        """For each program file of a scenario: line number -> mnemonics of the instructions that stand there."""
        for words in re.findall(r"^program (.*)$", scenario.read_text(), re.MULTILINE):
            for name in words.split("#")[0].split():
                lines = (scenario.parent / name).read_text(encoding="utf-8-sig", errors="replace").splitlines()
                yield dict(enumerate(cls.of_drawing(lines) if name.endswith(".lad") else cls.of_list(lines), 1))

    @classmethod
    def of_list(cls, lines):
        function = None  # the one whose PRM and TABLE lines come
        for line in lines:
            words = re.sub(r"^\s*\d+\b", "", line.split(";")[0]).upper().split()
            if words and words[0] == "FUNC":
                name = words[1] if len(words) > 1 else ""
                function = cls.functions.get(name.lstrip("0") or "0" if name.isdigit() else name)
            if words and words[0] in ("FUNC", "PRM", "TABLE"):
                yield {function} - {None}
            else:
                yield {words[0]} & cls.BASIC if words else set()

    @classmethod
    def of_drawing(cls, lines):
        forms = {"LD": r"\[[^/\]@%]", "LDI": r"\[/", "OUT": r"\((?![/]|[SR] )", "OUTI": r"\(/", "SET": r"\(S ", "RST": r"\(R "}
        modules = {"LEVEL1": {"END1"}, "LEVEL2": {"END1", "END2"}, "SUB": {"SP", "SPE"}}
        for line in lines:
            line = line.split(";")[0]
            found = {mnemonic for mnemonic, form in forms.items() if re.search(form, line)} if re.match(r"[| ]", line) else set()
            found.update({word.upper() for word in re.findall(r"\{(\w+)", line)} & set(cls.functions.values()))
            words = line.split()
            if words and words[0] == "module":
                found.update(modules.get(words[1].upper(), set()))
            yield found


if __name__ == "__main__":
    RUNGC = RaisedCodes.RUNGC = NctRows.RUNGC = TechnolRows.RUNGC = TechnolErrors.RUNGC = TechnolSignals.RUNGC = sys.argv.pop(1)
    unittest.main()
