#!/usr/bin/env python3
"""Native tools on compiled programs: gdb stops at lines of the PLC source, callgrind counts by them.

debug_test.py RUNGC MINI_HOST [unittest arguments]; runs in the root of the repository.
"""
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

RUNGC = None
MINI_HOST = None
HERE = Path("tests/debug")
# Source, line of an operation in its last rung, what stands there, and the levels of optimisation to try.
PROGRAMS = (
    ("motor.lad", 12, "|--[/Y0.0]--(Y0.1)", "02"),
    ("motor.pmc", 10, "OUT Y0.1", "2"),
    ("motor.plc", 18, "WR  LAMP", "2"),
)


def run(*command):
    return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=120, errors="replace")


def tool(name):
    return unittest.skipUnless(shutil.which(name), f"{name} is not installed; ./dev setup does it")


class Debug(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        # The command's own debug information would only cost gdb time to read.
        self.rungc = str(self.folder / "rungc")
        subprocess.run(["strip", "--strip-debug", "-o", self.rungc, RUNGC], check=True)

    def shared_object(self, source, level):
        out = self.folder / f"{source}.so"
        done = run(self.rungc, "build", str(HERE / source), "-o", str(out), "-g", "-O", level)
        self.assertEqual(done.returncode, 0, done.stdout)
        return str(out)

    def stops(self, source, line, text, *arguments):
        """gdb, told to stop at the line before anything is loaded, stops there and knows the source."""
        commands = ["set breakpoint pending on", "set confirm off", "set startup-with-shell off", f"break {source}:{line}", "run", "backtrace 1", "continue"]
        done = run("gdb", "-nx", "-batch", *[word for c in commands for word in ("-ex", c)], "--args", self.rungc, "run", *arguments, "--scans", "2")
        stop = re.compile(rf"^Breakpoint 1, \S+ \(\) at \S*{re.escape(source)}:{line}$", re.MULTILINE)
        self.assertEqual(len(stop.findall(done.stdout)), 2, done.stdout)  # once a scan
        self.assertIn(f"{line}\t", done.stdout)
        self.assertIn(text, done.stdout)
        self.assertRegex(done.stdout, rf"#0 +\S+ \(\) at \S*{re.escape(source)}:{line}")

    @tool("gdb")
    def test_gdb_stops_in_a_shared_object(self):
        for source, line, text, levels in PROGRAMS:
            for level in levels:
                with self.subTest(source=source, level=level):
                    self.stops(source, line, text, self.shared_object(source, level))

    @tool("gdb")
    def test_gdb_stops_in_code_of_the_jit(self):
        for source, line, text, levels in PROGRAMS:
            for level in levels:
                with self.subTest(source=source, level=level):
                    self.stops(source, line, text, str(HERE / source), "--engine", "jit", "--debugger", "-O", level)

    @tool("valgrind")
    def test_callgrind_counts_by_line(self):
        scans = 100
        for source, _, text, _ in PROGRAMS:
            with self.subTest(source=source):
                counts = self.folder / "callgrind.out"
                done = run("valgrind", "--tool=callgrind", "--dump-line=yes", f"--callgrind-out-file={counts}", MINI_HOST, self.shared_object(source, "2"), str(scans))
                self.assertEqual(done.returncode, 0, done.stdout)
                shown = run("callgrind_annotate", "--auto=yes", "--threshold=100", "--show-percs=no", str(counts), str(HERE / source)).stdout
                at = re.search(rf"^ *([\d,]+) +{re.escape(text)}$", shown, re.MULTILINE)
                self.assertIsNotNone(at, shown)
                executed = int(at.group(1).replace(",", ""))
                self.assertGreaterEqual(executed, scans)  # at least an instruction a scan
                self.assertEqual(executed % scans, 0, "the same work in every scan")


if __name__ == "__main__":
    RUNGC = os.path.abspath(sys.argv.pop(1))
    MINI_HOST = os.path.abspath(sys.argv.pop(1))
    unittest.main()
