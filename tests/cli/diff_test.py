#!/usr/bin/env python3
"""rungc diff as a user sees it: what rungs do otherwise, not what lines are. diff_test.py RUNGC"""
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
SAME, OTHERWISE, USAGE = 0, 1, 2

HEAD = "dialect nct\nmodule MAIN\nsymbol START 7000.00\nsymbol MOTOR 7001.00\nsymbol LAMP 7001.01\n"
ONE = '\nrung "motor"\n|--[START]--(MOTOR)\n'
TWO = '\nrung "lamp"\n|--[MOTOR]--(LAMP)\n'
THREE = '\nrung\n|--[/START]--(7002.00)\n'
END = "\nrung\n|--{END}\n"


class Diff(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def file(self, name, text):
        path = Path(self.folder.name) / name
        path.write_text(text)
        return path

    def diff(self, before, after, *args, ending="lad"):
        old, new = self.file(f"old.{ending}", before), self.file(f"new.{ending}", after)
        done = subprocess.run([RUNGC, "diff", old, new, *args], capture_output=True, text=True, timeout=patience(300), check=False)
        self.assertEqual(done.stderr, "")
        return done.returncode, done.stdout.replace(self.folder.name + "/", "")

    def test_the_same(self):
        again = HEAD.replace("symbol LAMP 7001.01\n", "") + "symbol LAMP 7001.01\n; a remark\n" + ONE.replace("START", "7000.00").replace('"motor"', '"the motor"') + TWO + THREE + END
        self.assertEqual(self.diff(HEAD + ONE + TWO + THREE + END, again),
                         (SAME, "rungs: 0 changed, 0 added, 0 removed, 0 moved, 4 the same\n"))

    def test_a_twin_above_changes_nothing(self):
        twin, edge = '\nrung\n|--[@START]--(7002.01)\n', '\nrung\n|--[@START]--(MOTOR)\n'
        self.assertEqual(self.diff(HEAD + edge + END, HEAD + twin + edge + END)[1].splitlines()[-1],
                         "rungs: 0 changed, 1 added, 0 removed, 0 moved, 2 the same")
        self.assertEqual(self.diff(HEAD + twin + edge + END, HEAD + edge + END)[1].splitlines()[-1],
                         "rungs: 0 changed, 0 added, 1 removed, 0 moved, 2 the same")

    def test_changed_added_removed_moved(self):
        status, text = self.diff(HEAD + ONE + TWO + THREE + END,
                                 HEAD + THREE + TWO.replace("[MOTOR]", "[MOTOR]--[START]") + '\nrung "new"\n|--[LAMP]--(7003.00)\n' + END)
        self.assertEqual((status, text), (OTHERWISE, """removed rung 1 "motor", old.lad:7
  - rung "motor"
  - |--[START]--(MOTOR)
changed rung 2 "lamp", old.lad:10 to rung 2 "lamp", new.lad:10
  - rung "lamp"
  - |--[MOTOR]--(LAMP)
  + rung "lamp"
  + |--[MOTOR]--[START]--(LAMP)
added rung 3 "new", new.lad:13
  + rung "new"
  + |--[LAMP]--(7003.00)
rungs: 1 changed, 1 added, 1 removed, 0 moved, 2 the same
"""))

    def test_moved(self):
        self.assertEqual(self.diff(HEAD + ONE + TWO + THREE + END, HEAD + TWO + THREE + ONE + END),
                         (OTHERWISE, """moved rung 1 "motor", old.lad:7 to rung 3 "motor", new.lad:13
rungs: 0 changed, 0 added, 0 removed, 1 moved, 3 the same
"""))

    def test_names(self):
        before = HEAD + "symbol OLD 7100\nsymbol MOVED 7101\n" + ONE + END
        after = HEAD + "symbol NEW 7100\nsymbol MOVED 7102\n" + ONE + END
        self.assertEqual(self.diff(before, after), (OTHERWISE, """changed name MOVED: M7101 32 bits to M7102 32 bits
added name NEW: M7100 32 bits
removed name OLD: M7100 32 bits
rungs: 0 changed, 0 added, 0 removed, 0 moved, 2 the same
"""))

    def test_json(self):
        status, text = self.diff(HEAD + ONE + END, HEAD + ONE.replace("[START]", "[/START]") + END, "--format", "json")
        found = json.loads(text)
        self.assertEqual((status, found["same"], len(found["rungs"])), (OTHERWISE, 1, 1))
        self.assertEqual(found["rungs"][0]["change"], "changed")
        self.assertEqual(found["rungs"][0]["after"]["text"].splitlines()[-1], "|--[/START]--(MOTOR)")

    def test_addresses_that_the_compiler_gives_out(self):
        """A new variable before others moves them, and changes nothing that rungs do."""
        source = Path("tests/scenarios/technol/address-forms.plc").read_text(encoding="utf-8")
        self.assertIn("DATA\n", source)
        status, text = self.diff(source, source.replace("DATA\n", "DATA\nFIRST_OF_ALL: DS 6\n", 1), "--dialect", "technol", ending="plc")
        self.assertEqual(status, OTHERWISE)
        self.assertIn("added name FIRST_OF_ALL", text)
        self.assertRegex(text, r"rungs: 0 changed, 0 added, 0 removed, 0 moved, \d+ the same\n$")

    def test_projects(self):
        for example in ("gsk-mill", "nct-turning-centre", "technol-machining-centre"):
            done = subprocess.run([RUNGC, "diff", f"examples/{example}", f"examples/{example}"], capture_output=True, text=True, check=False)
            self.assertEqual((done.returncode, done.stderr), (SAME, ""))

    def test_two_dialects(self):
        lad, pmc = self.file("a.lad", HEAD + ONE + END), self.file("b.pmc", "LD X0.0\nOUT Y0.0\nFUNC END1\nFUNC END2\n")
        done = subprocess.run([RUNGC, "diff", lad, pmc], capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stdout, done.stderr), (USAGE, "", "rungc: these are programs of two dialects\n"))


if __name__ == "__main__":
    go_to_root()
    RUNGC = sys.argv.pop(1)
    unittest.main()
