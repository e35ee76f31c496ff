"""TECHNOL: a program with mistakes is told exactly these, each once. Run by coverage_test.py.

errors-*.scn and bad-*.scn expect errors and warnings by their lines; here they are all that is reported. The columns are in
tests/coverage/technol_errors.txt, which RUNG_UPDATE=1 writes anew."""
import json
import os
import re
import subprocess
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FOLDER = ROOT / "tests/scenarios/technol"
GOLDEN = ROOT / "tests/coverage/technol_errors.txt"


class TechnolErrors(unittest.TestCase):
    maxDiff = None
    RUNGC = None

    def check(self, path):
        """What the compiler reports for the program of a scenario, by line."""
        text = path.read_text()
        files = [word for line in re.findall(r"^program (.*)$", text, re.MULTILINE) for word in line.split("#")[0].split()]
        config = [f"--config={key}={value}" for key, value in re.findall(r"^config (\S+) (\S+)", text, re.MULTILINE)]
        run = subprocess.run([Path(self.RUNGC).resolve(), "check", "--json", *config, *files], capture_output=True, cwd=FOLDER)
        return sorted(json.loads(run.stdout), key=lambda told: (told["file"], told["line"], told["column"], told["code"]))

    def test_nothing_else_is_told(self):
        lines = []
        for path in sorted([*FOLDER.glob("errors-*.scn"), *FOLDER.glob("bad-*.scn")]):
            told = self.check(path)
            expected = re.findall(r"^expect_(error|warning) (\d+) (\S+)", path.read_text(), re.MULTILINE)
            found = [(entry["severity"], str(entry["line"]), entry["code"]) for entry in told]
            with self.subTest(scenario=path.name):
                self.assertEqual(sorted(found), sorted(expected))
            lines += [f'{entry["file"]}:{entry["line"]}:{entry["column"]}-{entry["endColumn"]} {entry["severity"]} {entry["code"]}' for entry in told]
        text = "\n".join(lines) + "\n"
        if os.environ.get("RUNG_UPDATE") == "1":
            GOLDEN.write_text(text)
        self.assertEqual(GOLDEN.read_text(), text, "tests/coverage/technol_errors.txt")
