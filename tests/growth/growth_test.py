#!/usr/bin/env python3
"""Compile time grows with the size of the program and not faster: growth_test.py GROWTH SIZE

Instructions, not seconds: a busy machine does not matter. From one size to the double and to the fourfold they grow by a
step and by another; twice the step is linear, four times quadratic.
"""
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROGRAM, SIZE = None, 0
MOST = 2.5


def instructions():
    """By case: the instructions of each of its sizes, in the order of the sizes."""
    with tempfile.TemporaryDirectory() as folder:
        profile = Path(folder) / "profile"
        done = subprocess.run(["valgrind", "--tool=callgrind", f"--callgrind-out-file={profile}", "--toggle-collect=measured",
                               "--dump-after=measured", PROGRAM, str(SIZE)],
                              capture_output=True, text=True, check=True)
        counts = {}
        for number, line in enumerate(done.stdout.splitlines(), 1):
            text = Path(f"{profile}.{number}").read_text(encoding="utf-8")
            counts.setdefault(line.split()[0], []).append(int(re.search(r"^totals: (\d+)", text, re.M).group(1)))
        return counts


@unittest.skipUnless(shutil.which("valgrind"), "valgrind is not installed; ./dev setup does it")
class Growth(unittest.TestCase):
    def test_is_linear(self):
        counts = instructions()
        # It notices quadratic work.
        one, two, four = counts.pop("quadratic")
        self.assertGreater((four - two) / (two - one), 3.5)
        self.assertGreater(len(counts), 5)
        for case, (one, two, four) in counts.items():
            with self.subTest(case):
                step = two - one
                self.assertGreater(step, 100 * SIZE, "so few instructions are not the work of the case")
                self.assertLess((four - two) / step, MOST)


if __name__ == "__main__":
    SIZE = int(sys.argv.pop(2))
    PROGRAM = sys.argv.pop(1)
    unittest.main()
