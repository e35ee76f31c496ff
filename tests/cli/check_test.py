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
                         [("never-written", "START"), ("never-read", "MOTOR"), ("never-reset", "LATCH"), ("never-read", "LATCH"),
                          ("never-written", "BY_NO_NAME"), ("unused-name", "SPARE"), ("unused-name", "UNUSED")],
                         "MIDDLE is shifted with the others, KEPT is kept, the NC reads LAMP")

    def test_meant(self):
        text = NCT.format(start=" ; by the debugger  allow(never-written)", spare=" ; for later allow(unused-name)")
        names = [name for _, name in self.warnings("p.lad", text)]
        self.assertNotIn("START", names)
        self.assertNotIn("SPARE", names)
        other = NCT.format(start=" ; allow(never-read)", spare="")
        self.assertIn("START", [name for _, name in self.warnings("p.lad", other)], "only what is named is allowed")

    def test_each_half_of_a_double_has_its_own_sides(self):
        text = ("dialect nct\nmodule MAIN\nsymbol GO INP000.00\nsymbol D 6010\nsymbol LOST 6020\nsymbol HALF 6031\nrung\n|--[GO]--{MOVF D *2.5}\nrung\n"
                "|--[GO]--{MOVF LOST *2.5}\nrung\n|--[GO]--{MOV OUT000 6011}\nrung\n|--[GO]--{MOVF 6030 *1.0}\nrung\n|--[HALF]--(OUT010.00)\nrung\n|--{END}\n")
        self.assertEqual(self.warnings("p.lad", text), [("never-read", "LOST")], "the upper word of D is read")

    def test_an_index_may_lead_anywhere(self):
        text = "dialect nct\nmodule MAIN\nsymbol A 7001.00\nsymbol I 7002\nrung\n|--[A]--[7000.00,I]--{MOV 7010,I #1}\nrung\n|--{END}\n"
        self.assertEqual(self.warnings("p.lad", text), [])

    def test_gsk(self):
        self.assertEqual(self.warnings("p.pmc", GSK), [("never-reset", "ALARM"), ("never-reset", "LOST"), ("never-read", "LOST")],
                         "inputs, outputs, requests of messages and what is kept have their other side in the control")

    def test_technol(self):
        self.assertEqual(self.warnings("p.plc", TECHNOL), [("unused-name", "LOST"), ("unused-name", "SPARE")],
                         "control goes to the others, at the end of a timed block by itself, and for a command of the control")

    def test_a_program_with_errors_gets_them_alone(self):
        codes = self.warnings("p.lad", NCT.format(start="", spare="").replace("MOV KEPT", "MOW KEPT"), status=1)
        self.assertEqual([code for code, _ in codes], ["unknown-instruction"])

    def test_commands_that_compile_say_the_same(self):
        path = Path(self.folder.name) / "p.lad"
        path.write_text(NCT.format(start="", spare=""))
        said = subprocess.run([RUNGC, "check", path], capture_output=True, text=True, timeout=patience(), check=True)
        self.assertEqual(said.stdout, f"{path}: 3 rungs, 7 warnings\n")
        out = Path(self.folder.name) / "p.so"
        for words, end in ((["check", "-q", path], ""), (["build", path, "-o", out], "3 rungs, 7 warnings; wrote"), (["build", "-q", path, "-o", out], ""),
                           (["emit", "ir", path, "-o", "/dev/null"], "wrote /dev/null\n"), (["run", path, "--scans", "1"], "1 scan,")):
            with self.subTest(words=words):
                done = subprocess.run([RUNGC, *words], capture_output=True, text=True, timeout=patience(), check=True)
                self.assertEqual(done.stderr, said.stderr)
                self.assertIn(end, done.stdout)
                self.assertEqual(done.stdout == "", end == "")

    def scenario(self, name, *codes):
        """The warnings of a scenario's program that have one of the codes, with their lines."""
        done = subprocess.run([RUNGC, "check", "--no-project", "--json", f"tests/scenarios/{name}"], capture_output=True, text=True, timeout=patience(), check=True)
        return [(one["line"], one["code"], one["message"]) for one in json.loads(done.stdout) if one["code"] in codes]

    def test_overlaps(self):
        self.assertEqual(self.scenario("nct/overlaps.lad", "overlap", "shared-terminal"),
                         [(6, "shared-terminal", "'LIMIT_2' and 'LIMIT' are the same input or output"),
                          (10, "shared-terminal", "'LAMP_2' and 'LAMP' are the same input or output"),
                          (11, "overlap", "'T_STAR' shares memory with 'RUN' and another name"),
                          (15, "overlap", "'SPEED' shares memory with 'PARTS'")])
        self.assertEqual(self.scenario("gsk/overlaps.pmc", "overlap", "shared-terminal"),
                         [(4, "shared-terminal", "'JOG' and 'GO' are the same input or output"),
                          (7, "overlap", "'PARTS' shares memory with 'FAULT' and another name"),
                          (11, "overlap", "'COUNT' shares memory with 'STATION'")])
        self.assertEqual(self.scenario("technol/overlaps.plc", "overlap", "shared-terminal"),
                         [(7, "overlap", "'BEYOND' shares memory with 'NEXT' and another name"),
                          (10, "overlap", "'SAVED2' shares memory with 'SAVED'")])

    def test_the_places_of_an_overlap(self):
        done = subprocess.run([RUNGC, "check", "--no-project", "tests/scenarios/gsk/overlaps.pmc"], capture_output=True, text=True, timeout=patience(), check=True)
        for said in (":7:8: warning: 'PARTS' shares", ":8:8: note: 'FAULT' is declared here", ":34:6: note: 'PARTS' has 16 bits here",
                     ":4:8: warning: 'JOG' and 'GO'", ":3:8: note: 'GO' is declared here"):
            self.assertIn(said, done.stderr)

    def test_never_reset(self):
        self.assertEqual(self.scenario("nct/never-reset.lad", "never-reset", "timer-without-time"),
                         [(5, "never-reset", "'FAULT' is set, but nothing resets it"), (24, "timer-without-time", "T_NONE has the set time 0")])
        self.assertEqual(self.scenario("gsk/never-reset.pmc", "never-reset", "timer-without-time"),
                         [(4, "never-reset", "'FAULT' is set, but nothing resets it"), (10, "never-reset", "'ALARM' is set, but nothing resets it")])
        self.assertEqual(self.scenario("technol/never-reset.plc", "never-reset", "timer-without-time"), [(3, "never-reset", "'FAULT' is set, but nothing resets it")])

    def test_a_coil_that_must_be_there_needs_no_reader(self):
        text = ("dialect nct\nmessage 1 \"DOOR\"\nmodule MAIN\nsymbol GO INP000.00\nsymbol SHOWN 6000.00\nsymbol TIMED 6000.01\nsymbol LOST 6000.02\nsymbol NONE 6000.03\n"
                "rung\n|--[GO]--{MSG #1 #0 #0 #0}--(SHOWN)\nrung\n|--[GO]--{TOND 6001 #1 #1}--+--(TIMED)\n                            +--[GO]--(LOST)\n"
                "rung\n|--[GO]--(NONE)\nrung\n|--{END}\n")
        self.assertEqual(self.warnings("p.lad", text), [("never-read", "LOST"), ("never-read", "NONE")])
        text = ("symbol GO X0.0\nsymbol TIMED R0.0\nsymbol AGAIN R0.1\nsymbol NONE R0.2\nFUNC END1\nLD GO\nFUNC TMRB\nPRM 1\nPRM 1000\nOUT TIMED\nOUT AGAIN\n"
                "LD GO\nOUT NONE\nFUNC END2\n")
        self.assertEqual(self.warnings("p.pmc", text), [("never-read", "AGAIN"), ("never-read", "NONE")])

    def test_programs_of_the_docs_have_none(self):
        for path in sorted([*Path("docs").glob("*.lad"), *Path("docs").glob("*.pmc")]):
            done = subprocess.run([RUNGC, "check", "--no-project", "--json", path], capture_output=True, text=True, timeout=patience(), check=False)
            self.assertEqual(json.loads(done.stdout), [], path)

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
