#!/usr/bin/env python3
"""A replacement takes instructions in proportion to the bytes of state: instructions_test.py RUNG_REPLACE FOLDER"""
import re
import shutil
import subprocess
import sys
import unittest

ARGUMENTS = None
COUNT = 12     # every program takes over from every other one
FIXED = 10_000  # instructions; the rest is one a byte at most: callgrind counts each byte of a string instruction


@unittest.skipUnless(shutil.which("valgrind"), "valgrind is not installed; ./dev setup does it")
class Instructions(unittest.TestCase):
    def test_are_bounded_by_the_bytes_of_state(self):
        done = subprocess.run(["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null",
                               "--toggle-collect=rung_instance_replace", *ARGUMENTS, str(COUNT)],
                              capture_output=True, text=True, timeout=280, check=True)
        replaced, state = map(int, re.search(r"(\d+) replacements, of (\d+) bytes", done.stdout).groups())
        each = int(re.search(r"Collected : (\d+)", done.stderr).group(1)) / replaced
        print(f"{each:.0f} instructions for {state} bytes of state")
        self.assertLess(each, FIXED + state)
        self.assertGreater(each, state / 32, "what was counted copies nothing")


if __name__ == "__main__":
    ARGUMENTS = sys.argv[1:]
    unittest.main(argv=sys.argv[:1])
