#!/usr/bin/env python3
"""Checks README.md, CONTRIBUTING.md and docs/ against the tree and the program. docs_test.py RUNGC"""
import csv
import os
import re
import shlex
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

RUNGC = None
ROOT = Path(__file__).resolve().parents[2]
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").rglob("*.md"))]
# Blocks of these pages whose commands are run.
RUN_PAGES = [ROOT / "docs" / "guide.md"]
# Not run: interactive, or for a machine that has to be set up first.
SKIPPED_COMMANDS = ("gdb",)


def shown(path):
    return path.relative_to(ROOT)


class Docs(unittest.TestCase):
    def test_reference_is_what_the_tables_say(self):
        for page in ("gsk", "nct", "technol", "diagnostics", "ir"):
            text = subprocess.run([RUNGC, "doc", page], capture_output=True, check=True).stdout.decode()
            path = ROOT / "docs" / "reference" / f"{page}.md"
            self.assertTrue(path.exists() and path.read_text() == text, f"{shown(path)} is stale: run tests/update")

    def test_gsk_page_has_every_instruction_and_signal(self):
        page = (ROOT / "docs" / "reference" / "gsk.md").read_text()
        headings = re.findall(r"^### (\S+?)(?: \(function (\d+)\))?: ", page.split("\n## Address areas")[0], re.MULTILINE)
        rows = csv.DictReader((ROOT / "frontend/dialects/gsk/instructions.csv").read_text().splitlines())
        self.assertEqual(sorted(headings), sorted((row["mnemonic"], row["func_number"]) for row in rows))
        found = re.findall(r"^\| ([XYFG]\d+(?:\.\d)?)(?: \((\d) bytes?\))? \| `([^`]+)` \| (.*) \| l\.(\d+) \|$",
                           page.split("\n## Signals")[1], re.MULTILINE)
        wanted = []
        for row in csv.DictReader((ROOT / "rtlib/nc/gsk/signals.csv").read_text().splitlines()):
            place = row["address"][0] + str(int(row["address"][1:])) + (row["bit"] and "." + row["bit"])
            width = {"bit": "", "byte": "1", "word": "2", "dword": "4"}[row["type"]]
            only = {"both": "", "mc": " (GSK25iMc only)", "tc": " (GSK25iTc only)"}[row["mc_or_tc"]]
            wanted.append((place, width, row["symbol"], row["meaning"].replace("|", "\\|") + only, row["manual_line"].split(";")[0]))
        self.assertEqual(len(wanted), 2147)
        self.assertEqual(sorted(found), sorted(wanted))

    def test_configuration_keys_are_told(self):
        for dialect, compiler, control in (("gsk", "tmr.N", "overtravel"), ("nct", "PLCNVRAM", "spindles"), ("technol", "encoding", "PlcErrors")):
            page = (ROOT / "docs" / "reference" / f"{dialect}.md").read_text()
            rows = page.split("\n## Configuration\n")[1].split("\n## ")[0].split("| --- | --- | --- | --- | --- |\n")[1].splitlines()
            read_by = dict(re.match(r"\| `(\S+)` \| .* \| .* \| (compiler|control) \| \S.* \|$", row).groups() for row in rows if row)
            self.assertEqual((read_by[compiler], read_by[control]), ("compiler", "control"))

    def test_links_lead_somewhere(self):
        for page in PAGES:
            for target in re.findall(r"\]\(([^)#]+)(?:#[^)]*)?\)", page.read_text()):
                if "://" not in target:
                    self.assertTrue((page.parent / target).exists(), f"{shown(page)} links to {target}")

    def test_commands_of_the_guide_run(self):
        with tempfile.TemporaryDirectory() as folder:
            for name in ("examples", "docs"):
                os.symlink(ROOT / name, Path(folder) / name)
            (Path(folder) / "build").mkdir()
            os.symlink(Path(RUNGC).parent, Path(folder) / "build" / "bin")
            for page in RUN_PAGES:
                for block in re.findall(r"^```\n(.*?)^```", page.read_text(), re.MULTILINE | re.DOTALL):
                    for command in block.splitlines():
                        if not command.startswith(SKIPPED_COMMANDS) and "/" in command.split()[0]:
                            self.run_command(page, command, folder)

    def run_command(self, page, command, folder):
        done = subprocess.run(["bash", "-c", command], cwd=folder, capture_output=True, timeout=120)
        self.assertEqual(done.returncode, 0, f"{shown(page)}: {shlex.quote(command)}\n{done.stdout.decode()[-800:]}{done.stderr.decode()[-800:]}")


if __name__ == "__main__":
    RUNGC = os.path.abspath(sys.argv.pop(1))
    unittest.main()
