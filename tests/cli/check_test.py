#!/usr/bin/env python3
"""rungc check of names that look like mistakes: what it warns of, and how a program says that one is meant. check_test.py RUNGC"""
import json
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
symbol START   7000.00{start}
symbol MOTOR   7001.00
symbol LATCH   7001.01
symbol BY_NO_NAME 7001.02
symbol SPARE   7001.03{spare}
symbol TABLE   7100
symbol MIDDLE  7102
symbol LAST    7104
symbol KEPT    4100
symbol LAMP    OUT000.03
const  USED    #1
const  UNUSED  #2
rung
|--[START]--+--(MOTOR)
            +--(S LATCH)
            +--(LAMP)
            +--{{ASHL TABLE LAST USED}}
rung
|--[7001.02]--{{MOV KEPT #1}}
rung
|--{{END}}
"""
GSK = """symbol BUTTON X0.0
symbol LAMP Y0.0
symbol ALARM A0.0
symbol COUNT D10
symbol HALF R20
symbol LOST R10.0
LD BUTTON
OUT LAMP
SET ALARM
SET LOST
LD BUTTON
FUNC MOVN
PRM 4
PRM COUNT
PRM R18
LD R20.1
OUT Y0.1
FUNC END1
FUNC END2
"""
TECHNOL = """DATA
DATA_END
MODULE_INPUT
MODULE_INPUT_END
MODULE_BLOCK_INIT
MODULE_BLOCK_INIT_END
MODULE_BLOCK_DONE
MODULE_BLOCK_DONE_END
MODULE_MAIN
      JUM  THERE
LOST: PROC_CALL CALLED
ALSO: LOD  CNST.1    ; of a listing, allow(unused-name)
THERE: DFTM10 TIMED
TIMED: PROC_BEGIN CALLED
      PROC_END CALLED
      PROC_BEGIN _ON_CMD
      PROC_END _ON_CMD
      PROC_BEGIN SPARE
      PROC_END SPARE
MODULE_MAIN_END
MODULE_INIT
MODULE_INIT_END
MODULE_CLEAR
MODULE_CLEAR_END
MODULE_HALT
MODULE_HALT_END
STOP
"""


class CheckNames(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def warnings(self, name, text, *args, status=0):
        path = Path(self.folder.name) / name
        path.write_text(text)
        done = subprocess.run([RUNGC, "check", "--json", *args, path], capture_output=True, text=True, timeout=patience(), check=False)
        self.assertEqual(done.returncode, status, done.stderr)
        lines = text.splitlines()
        return [(one["code"], lines[one["line"] - 1][one["column"] - 1:one["endColumn"] - 1]) for one in json.loads(done.stdout)]

    def test_nct(self):
        text = NCT.format(start="", spare="")
        self.assertEqual(self.warnings("p.lad", text),
                         [("never-written", "START"), ("never-read", "MOTOR"), ("never-read", "LATCH"),
                          ("never-written", "BY_NO_NAME"), ("unused-name", "SPARE"), ("unused-name", "UNUSED")],
                         "MIDDLE is shifted with the others, KEPT is kept, the NC reads LAMP")

    def test_meant(self):
        text = NCT.format(start=" ; by the debugger  allow(never-written)", spare=" ; for later allow(unused-name)")
        names = [name for _, name in self.warnings("p.lad", text)]
        self.assertNotIn("START", names)
        self.assertNotIn("SPARE", names)
        other = NCT.format(start=" ; allow(never-read)", spare="")
        self.assertIn("START", [name for _, name in self.warnings("p.lad", other)], "only what is named is allowed")

    def test_an_index_may_lead_anywhere(self):
        text = "dialect nct\nmodule MAIN\nsymbol A 7001.00\nsymbol I 7002\nrung\n|--[A]--[7000.00,I]--{MOV 7010,I #1}\nrung\n|--{END}\n"
        self.assertEqual(self.warnings("p.lad", text), [])

    def test_gsk(self):
        self.assertEqual(self.warnings("p.pmc", GSK), [("never-read", "LOST")],
                         "inputs, outputs, requests of messages and what is kept have their other side in the control")

    def test_technol(self):
        self.assertEqual(self.warnings("p.plc", TECHNOL), [("unused-name", "LOST"), ("unused-name", "SPARE")],
                         "control goes to the others, at the end of a timed block by itself, and for a command of the control")

    def test_a_program_with_errors_gets_them_alone(self):
        codes = self.warnings("p.lad", NCT.format(start="", spare="").replace("MOV KEPT", "MOW KEPT"), status=1)
        self.assertEqual([code for code, _ in codes], ["unknown-instruction"])

    def test_other_commands_say_nothing(self):
        path = Path(self.folder.name) / "p.lad"
        path.write_text(NCT.format(start="", spare=""))
        done = subprocess.run([RUNGC, "emit", "ir", path], capture_output=True, text=True, timeout=patience(), check=False)
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_examples_have_none(self):
        for folder in sorted(Path("examples").iterdir()):
            if not (folder / "rung.toml").exists():
                continue
            done = subprocess.run([RUNGC, "check", "--json", folder], capture_output=True, text=True, timeout=patience(), check=False)
            self.assertEqual(json.loads(done.stdout), [], folder)


if __name__ == "__main__":
    go_to_root()
    RUNGC = sys.argv.pop(1)
    unittest.main()
