#!/usr/bin/env python3
"""Access to bits and packed integers takes less than ten instructions: access_count_test.py ACCESS_COUNT"""
import re
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "support"))
from patience import patience

PROGRAM = None
ROUNDS, PLACES = 1000, 16


def instructions(work, rounds):
    done = subprocess.run(["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", PROGRAM, work, str(rounds)],
                          capture_output=True, text=True, timeout=patience(), check=True)
    return int(re.search(r"Collected : (\d+)", done.stderr).group(1))


def each(work):
    return (instructions(work, ROUNDS) - instructions(work, 0)) / (ROUNDS * PLACES)


@unittest.skipUnless(shutil.which("valgrind"), "valgrind is not installed; ./dev setup does it")
class Access(unittest.TestCase):
    def test_takes_less_than_ten_instructions(self):
        loop = each("none")
        for work in ("read", "signed", "write"):
            with self.subTest(work):
                self.assertLess(each(work) - loop, 10)
                self.assertGreater(each(work) - loop, 3, "what was counted is no access")


if __name__ == "__main__":
    PROGRAM = sys.argv.pop(1)
    unittest.main()
