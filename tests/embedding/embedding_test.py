#!/usr/bin/env python3
"""The hosts of examples/embed-*, as docs/embedding.md shows them: embedding_test.py RUNGC EMBED_JIT HOST..."""
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from patience import patience
from root import go_to_root

RUNGC = None
JIT = None  # compiles in its process
HOSTS = []


class Embedding(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.programs = [cls.build("axis.lad"), cls.build("axis-2.lad")]

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    @classmethod
    def build(cls, source):
        output = str(Path(cls.folder.name) / source.replace(".lad", ".so"))
        subprocess.run([RUNGC, "build", f"examples/embed-plc/{source}", "-o", output, "--profile", "--no-project", "-q"], check=True)
        return output

    def run_host(self, host, *arguments):
        return subprocess.run([host, *arguments], capture_output=True, text=True, timeout=patience())

    def test_the_toys_run_fault_and_change(self):
        for host in HOSTS:
            with self.subTest(host=host):
                done = self.run_host(host, *self.programs)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertRegex(done.stdout, r"70\d ms: dead-loop \(rung 5, \S*axis\.lad:\d+\)\n")
                self.assertRegex(done.stdout, r"1\d\d\d ms: the new program runs\n")
                self.assertRegex(done.stdout, r"(?m)^1\d strokes; the worst rung is .*axis-2\.lad:\d+$")

    def test_what_is_wrong_is_said(self):
        for host in HOSTS:
            with self.subTest(host=host):
                done = self.run_host(host, "/nowhere/axis.so", self.programs[1])
                self.assertEqual(done.returncode, 1)
                self.assertIn("/nowhere/axis.so", done.stderr)

    def test_from_source(self):
        done = self.run_host(JIT, "examples/embed-plc/axis.lad", "examples/embed-plc/axis-2.lad")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(done.stdout, "the drive is on at 0 mm: 1, at 6 mm: 0\nthe new program, which goes further: 1, at 6 mm: 1\n")
        wrong = Path(self.folder.name) / "wrong.lad"
        wrong.write_text("dialect gsk\nmodule LEVEL1\nrung\n|--[NOBODY]--(Y0.0)\n")
        done = self.run_host(JIT, str(wrong), "examples/embed-plc/axis-2.lad")
        self.assertEqual(done.returncode, 1)
        self.assertIn("wrong.lad:4:5: error: 'NOBODY'", done.stderr)

    def test_they_are_short(self):
        for source in Path("examples").glob("embed-*/*"):
            self.assertLess(len(source.read_text().splitlines()), 80, source)


if __name__ == "__main__":
    go_to_root()
    RUNGC, JIT, *HOSTS = sys.argv[1:]
    unittest.main(argv=sys.argv[:1])
