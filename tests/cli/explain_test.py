#!/usr/bin/env python3
"""rungc explain FILE:LINE:COLUMN: what is written at a place. explain_test.py RUNGC"""
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from patience import patience
from root import go_to_root

RUNGC = None

NCT = """dialect nct
module MAIN
symbol START 7000.00 ; green button
const LIMIT #10
rung "a switch"
|--[START]--[7000.01,IDX]--(7001.00)
symbol IDX 7010
rung
|--[7001.00]--{MOV 7020 LIMIT}
rung
|--[START]--{JMP #1}
rung
|--{JME #1}
rung
|--{END}
"""


class ExplainPlace(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.path = Path(self.folder.name) / "p.lad"
        self.path.write_text(NCT)

    def explain(self, line, column, status=0):
        done = subprocess.run([RUNGC, "explain", f"{self.path}:{line}:{column}"], capture_output=True, text=True, timeout=patience(), check=False)
        self.assertEqual(done.returncode, status, done.stderr)
        return (done.stdout + done.stderr).replace(str(self.path), "p.lad")

    def test_operand(self):
        self.assertEqual(self.explain(6, 5), """START: read here
  green button
  declared at p.lad:3:8

START (7000.00): read, but written by no rung
  written  –
  read     rung 1 "a switch", p.lad:5
           rung 3, p.lad:10
  perhaps  read by rung 1 "a switch", p.lad:5, as 7000.01, indexed
""")

    def test_index(self):
        self.assertTrue(self.explain(6, 14).startswith("7000.01,IDX: read here, with ',IDX' added at run time\n"))

    def test_declaration(self):
        self.assertIn("START\n  green button\n  declared at p.lad:3:8\n", self.explain(3, 8))

    def test_constant(self):
        self.assertEqual(self.explain(9, 25), "LIMIT: #10\n  declared at p.lad:4:7\n")

    def test_label(self):
        self.assertEqual(self.explain(11, 18), "#1: control goes there\n  asked at p.lad:11:18\n  is at   p.lad:13:9\n")

    def test_word(self):
        self.assertTrue(self.explain(9, 16).startswith("[nct] MOV:"), "the mnemonic")

    def test_program_with_errors(self):
        self.path.write_text(NCT.replace("[7001.00]", "[NOBODY]"))
        self.assertEqual(self.explain(6, 5), "START: read here\n  green button\n  declared at p.lad:3:8\n")

    def test_nothing_there(self):
        self.assertIn("has nothing in line 99, column 1", self.explain(99, 1, status=2))
        self.assertIn("has nothing in line 1, column 50", self.explain(1, 50, status=2))


if __name__ == "__main__":
    go_to_root()
    RUNGC = sys.argv.pop(1)
    unittest.main()
