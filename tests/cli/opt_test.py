#!/usr/bin/env python3
"""rungc opt as a user sees it: opt_test.py RUNGC [unittest arguments]"""
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from patience import patience
from root import go_to_root

RUNGC = None
COUNTER = "docs/counter.rir"


class Opt(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.out = str(Path(self.folder.name) / "out.rir")

    def opt(self, *words, status=0):
        done = subprocess.run([RUNGC, "opt", *words], capture_output=True, text=True, check=False, timeout=patience(60))
        self.assertEqual(done.returncode, status, done.stderr)
        return done.stdout if status == 0 else done.stderr

    def test_its_output_of_a_large_program_is_read_again(self):
        self.opt("examples/nct-turning-centre", "-o", self.out)
        self.assertGreater(Path(self.out).stat().st_size, 1 << 20)
        once = self.opt(self.out, "--passes", "dead")
        self.assertEqual(once, Path(self.out).read_text(encoding="utf-8"))  # all of it is removed already

    def test_no_pass_follows_instrument(self):
        told = self.opt(COUNTER, "--passes", "fold,instrument,versions", status=2)
        self.assertIn("no pass can follow 'instrument', found 'versions'", told)
        self.opt(COUNTER, "--passes", "fold,instrument", "--verify-each", "-o", self.out)
        told = self.opt(self.out, "--passes", "dead", status=1)
        self.assertIn("the module is instrumented", told)

    def test_changed_declarations_are_printed(self):
        # The counter's register is then read and written by different runs.
        source = Path(self.folder.name) / "carried.rir"
        source.write_text(Path(COUNTER).read_text(encoding="utf-8").replace("slot_store.i32 $1, %2", ""), encoding="utf-8")
        printed = self.opt(source, "--passes", "fold,carried", "--print-after", "all")
        after_fold, after_carried = printed.split("; after carried, pass 2\n")
        self.assertNotIn("\nslot ", after_fold)
        self.assertEqual(after_carried.split("routine")[0], 'slot $1 i32 init 0 "register"\n')

    def test_a_module_as_text_stands_alone(self):
        self.assertIn("is the only file, found 2 files", self.opt(COUNTER, "docs/lamp.lad", status=2))


if __name__ == "__main__":
    go_to_root()
    RUNGC = sys.argv.pop(1)
    unittest.main()
