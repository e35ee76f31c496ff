#!/usr/bin/env python3
"""Compile time grows with the size of the program and not faster: growth_test.py GROWTH

Instructions, not seconds: a busy machine does not matter. From one size to the double and to the fourfold they grow by a
step and by another; twice the step is linear, four times quadratic.
"""
import re
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from patience import patience

PROGRAM = None
SIZE = 500
MOST = 2.5


def instructions(case, size):
    done = subprocess.run(["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", PROGRAM, case, str(size)],
                          capture_output=True, text=True, timeout=patience(200), check=True)
    return int(re.search(r"Collected : (\d+)", done.stderr).group(1))


def growth(case):
    """The first step of instructions, and by how much the second is larger."""
    one, two, four = (instructions(case, factor * SIZE) for factor in (1, 2, 4))
    return two - one, (four - two) / (two - one)


@unittest.skipUnless(shutil.which("valgrind"), "valgrind is not installed; ./dev setup does it")
class Growth(unittest.TestCase):
    def test_is_linear(self):
        cases = subprocess.run([PROGRAM], capture_output=True, text=True, timeout=patience(), check=True).stdout.split()
        self.assertGreater(len(cases), 5)
        for case in cases:
            with self.subTest(case):
                step, factor = growth(case)
                self.assertGreater(step, 100 * SIZE, "so few instructions are not the work of the case")
                self.assertLess(factor, MOST)

    def test_notices_quadratic_work(self):
        self.assertGreater(growth("quadratic")[1], 3.5)


if __name__ == "__main__":
    PROGRAM = sys.argv.pop(1)
    unittest.main()
