#!/usr/bin/env python3
"""Looks for what no test touches: diagnostic codes, and instructions without a scenario. coverage_test.py RUNGC"""
import re
import subprocess
import sys
import unittest
from pathlib import Path

RUNGC = None
ROOT = Path(__file__).resolve().parents[2]
HERE = Path(__file__).resolve().parent


def listed(name):
    """Names in a list file; behind each stands why it is there."""
    entries = {}
    for line in (HERE / name).read_text().splitlines():
        if line.strip() and not line.startswith("#"):
            word, _, reason = line.partition(" ")
            entries[word] = reason.strip()
    return entries


def diagnostics():
    """enumerator -> code"""
    found = {}
    for path in sorted((ROOT / "ir/support/diag").glob("*.def")):
        found.update(re.findall(r'^DIAG\((\w+),\s*"([a-z0-9-]+)"', path.read_text(), re.MULTILINE))
    return found


def test_texts():
    for pattern in ("tests/**/*.scn", "examples/**/*.scn", "tests/unit/**/*.cpp", "tests/cli/*.py"):
        for path in sorted(ROOT.glob(pattern)):
            if "unit/support" not in path.as_posix():  # those walk all codes and raise none
                yield path.read_text(errors="replace")


class Coverage(unittest.TestCase):
    def test_every_diagnostic_is_raised(self):
        words = set()
        for text in test_texts():
            words.update(re.findall(r"[A-Za-z][A-Za-z0-9]*(?:-[a-z0-9]+)*", text))
        codes = diagnostics()
        self.assertGreater(len(codes), 100)
        excused = listed("diagnostics_not_raised.txt")
        missing = sorted(code for name, code in codes.items() if code not in words and name not in words and code not in excused)
        self.assertEqual(missing, [], "no test raises these; add a scenario with expect_error, or say why not in diagnostics_not_raised.txt")
        raised = sorted(code for name, code in codes.items() if (code in words or name in words) and code in excused)
        self.assertEqual(raised, [], "a test raises these now: take them out of diagnostics_not_raised.txt")
        self.assertEqual(sorted(set(excused) - set(codes.values())), [], "no such codes")
        self.assertEqual([code for code, reason in excused.items() if not reason], [], "give a reason")

    def test_every_built_instruction_has_a_scenario(self):
        excused = listed("instructions_without_scenario.txt")
        for dialect in ("gsk", "nct", "technol"):
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
            head = re.match(r"(.+?)(?: \(function (\d+)\))?: ", entry)
            yield head.group(1), head.group(2)

    @staticmethod
    def stands_in(mnemonic, number, sources):
        if number is not None and re.search(rf"\bFUNC\s+0*{number}\b", sources):
            return True
        forms = {"open-contact-bit": r"\[[^/\]]", "closed-contact-bit": r"\[/", "open-contact-dword": r"\[[^/\]]", "closed-contact-dword": r"\[/",
                 "coil": r"\([^/SR)]", "negated-coil": r"\(/", "SET": r"\(S |\bSET\b", "RST": r"\(R |\bRST\b", "SEC": r"^section ",
                 "END1": r"module LEVEL2", "END2": r"module LEVEL2", "SP": r"module SUB", "SPE": r"module SUB"}
        if mnemonic in forms and re.search(forms[mnemonic], sources, re.MULTILINE):
            return True
        return re.search(rf"(?<![\w]){re.escape(mnemonic)}(?![\w])", sources, re.IGNORECASE) is not None


if __name__ == "__main__":
    RUNGC = sys.argv.pop(1)
    unittest.main()
