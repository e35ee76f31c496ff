#!/usr/bin/env python3
"""Native tools on compiled programs: gdb stops at lines of the PLC source and shows the program's names, callgrind counts
by lines.

debug_test.py RUNGC MINI_HOST [unittest arguments]
"""
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from patience import patience
from root import go_to_root

RUNGC = None
MINI_HOST = None
HERE = Path("tests/debug")
# Source, line of an operation in its last rung, what stands there, and the levels of optimisation to try.
PROGRAMS = (
    ("motor.lad", 12, "|--[/Y0.0]--(Y0.1)", "02"),
    ("motor.pmc", 10, "OUT Y0.1", "2"),
    ("motor.plc", 18, "WR  LAMP", "2"),
)

# Source, and what gdb prints in two scans: at a line, the values of names.
VALUES = (
    (
        "values.lad",
        [
            (11, {"LAMP": "false"}),
            (14, {"LAMP": "true", "FLAG": "false", "WHOLE": "0"}),
            (17, {"FLAG": "true", "WHOLE": "8", "M7008": "0"}),
            (20, {"M7008": "8", "COUNT": "0"}),
            (23, {"COUNT": "-3", "FACTOR_f64": "0"}),
            (26, {"FACTOR_f64": "3.5", "M7009_17": "false"}),
            (29, {"M7009_17": "true", "int_": "false"}),
            (32, {"int_": "true", "N_ON": "true"}),
            (11, {"LAMP": "true"}),
            (14, {"LAMP": "false"}),
            (17, {"FLAG": "false", "WHOLE": "0"}),
            (20, {"M7008": "0"}),
            (23, {"COUNT": "-6"}),
            (26, {"M7009_17": "true"}),
            (29, {"M7009_17": "false", "int_": "true"}),
            (32, {"int_": "false"}),
        ],
    ),
    (
        "values.pmc",
        [
            (7, {"LAMP": "false", "X0_7": "false"}),
            (10, {"LAMP": "true", "FLAG": "false", "CODE": "0"}),
            (12, {"FLAG": "true", "CODE_4": "false", "CODE": "8"}),
            (17, {"CODE_4": "true", "CODE": "24", "D4_i16": "0"}),
            (22, {"D4_i16": "-3", "R11": "0"}),
            (28, {"R11": "24", "Y0_1": "false"}),
            (7, {"LAMP": "true", "Y0_1": "true"}),
            (10, {"LAMP": "false"}),
            (12, {"FLAG": "false"}),
            (17, {"CODE": "0"}),
            (22, {"D4_i16": "-6", "R11": "24"}),
            (28, {"R11": "0"}),
        ],
    ),
    (
        "values.plc",
        [
            (16, {"LAMP": "false", "TITLE": '"Ready\\000"'}),
            (18, {"LAMP": "true", "FLAG": "false", "FLAGS": "0"}),
            (21, {"FLAG": "true", "FLAGS": "8", "TABLE": "0"}),
            (24, {"TABLE": "8", "COUNT": "0"}),
            (27, {"COUNT": "-3", "RATIO_f64": "0"}),
            (30, {"RATIO_f64": "7", "TITLE": '"Steady"', "OTHER": "false"}),
            (16, {"LAMP": "true", "OTHER": "true", "FLAGS": "24"}),
            (18, {"LAMP": "false"}),
            (21, {"FLAG": "false", "FLAGS": "16"}),
            (24, {"TABLE": "16", "COUNT": "-3"}),
            (27, {"COUNT": "-6"}),
            (30, {"LAMP": "false", "OTHER": "true"}),
        ],
    ),
)
CPP = ("g++", "clang++-19")


def run(*command):
    return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=patience(), errors="replace")


def tool(name):
    return unittest.skipUnless(shutil.which(name), f"{name} is not installed; ./dev setup does it")


class Debug(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        # The command's own debug information would only cost gdb time to read.
        self.rungc = str(self.folder / "bin/rungc")
        for file in ("bin/rungc", "lib/rung/rung-llvm.so"):
            stripped = self.folder / file
            stripped.parent.mkdir(parents=True)
            subprocess.run(["strip", "--strip-debug", "-o", stripped, Path(RUNGC).parents[1] / file], check=True)

    def shared_object(self, source, level, *options):
        out = self.folder / f"{source}.so"
        done = run(self.rungc, "build", str(HERE / source), "-o", str(out), "-g", "-O", level, *options)
        self.assertEqual(done.returncode, 0, done.stdout)
        return str(out)

    def gdb(self, commands, *arguments):
        """gdb's commands on two scans of a program that is not loaded yet."""
        commands = ["set breakpoint pending on", "set confirm off", "set startup-with-shell off"] + commands
        return run("gdb", "-nx", "-batch", *[word for c in commands for word in ("-ex", c)], "--args", self.rungc, "run", *arguments, "--scans", "2")

    def shows(self, source, stops, expression, *arguments):
        """At each stop in turn gdb prints the values of the names, written as the expression says."""
        plan = [(f"{source}:{line}", [expression.format(name) for name in values]) for line, values in stops]
        quoted = json.dumps(plan).replace('"', '\\"')
        done = self.gdb(["set language c", f'set $plan = "{quoted}"', "set language auto", f"source {HERE}/print_values.py"], *arguments)
        expected = []
        for line, values in stops:
            expected.append(f"line {line}")
            expected += [f"{expression.format(name)} = {value}" for name, value in values.items()]
        shown = [line for line in done.stdout.splitlines() if re.match(r"line \d|\S+ = ", line)]
        self.assertEqual(shown, expected, done.stdout)

    def stops(self, source, line, text, *arguments):
        """gdb, told to stop at the line before anything is loaded, stops there and knows the source."""
        done = self.gdb([f"break {source}:{line}", "run", "backtrace 1", "continue"], *arguments)
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

    @tool("gdb")
    def test_gdb_shows_names_in_a_shared_object(self):
        for source, stops in VALUES:
            for level in "02":
                for expression in ("mem->{}", "{}"):
                    with self.subTest(source=source, level=level, expression=expression):
                        self.shows(source, stops, expression, self.shared_object(source, level))

    @tool("gdb")
    def test_gdb_shows_names_in_generated_cpp(self):
        for compiler in filter(shutil.which, CPP):
            for source, stops in VALUES:
                for level in "02":
                    with self.subTest(source=source, level=level, compiler=compiler):
                        self.shows(source, stops, "mem->{}", self.shared_object(source, level, "--via", "cpp", "--cxx", compiler))

    @tool("gdb")
    def test_gdb_shows_names_in_code_of_the_jit(self):
        for source, stops in VALUES:
            for level in "02":
                for expression in ("mem->{}", "{}"):
                    with self.subTest(source=source, level=level, expression=expression):
                        self.shows(source, stops, expression, str(HERE / source), "--engine", "jit", "--debugger", "-O", level)

    @tool("gdb")
    def test_gdb_knows_no_other_names(self):
        for via in ("llvm", "cpp"):
            with self.subTest(via=via):
                done = self.gdb(["break values.lad:14", "run", "print mem->VALVE", "print VALVE", "ptype mem"], self.shared_object("values.lad", "2", "--via", via))
                self.assertIn("There is no member named VALVE.", done.stdout)
                self.assertIn('No symbol "VALVE" in current context.', done.stdout)
                self.assertIn("bool LAMP;", done.stdout)

    @tool("gdb")
    def test_gdb_writes_what_the_next_line_reads(self):
        for options in ((), ("--via", "cpp")):
            with self.subTest(options=options):
                commands = ["break values.lad:26", "break values.lad:29", "run", "set variable mem->LAMP = 0", "continue", "print mem->M7009_17"]
                self.assertIn("$1 = false", self.gdb(commands, self.shared_object("values.lad", "2", *options)).stdout)

    @tool("readelf")
    def test_debug_information_is_dwarf_4(self):
        for options in ((), ("--via", "cpp")):
            with self.subTest(options=options):
                shown = run("readelf", "--debug-dump=info", "--dwarf-depth=1", self.shared_object("values.lad", "2", *options)).stdout
                self.assertEqual(set(re.findall(r"^ +Version: +(\d+)$", shown, re.MULTILINE)), {"4"})

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


    def guide_commands(self, *programs):
        """The lines of the guide's section that start with one of these programs, after what they need has been built."""
        section = Path("docs/guide.md").read_text().split("\n## Profile and debug\n")[1].split("\n## ")[0]
        (self.folder / "out").mkdir()
        (self.folder / "build").mkdir()
        (self.folder / "build/bin").symlink_to(Path(RUNGC).parent)
        (self.folder / "examples").symlink_to(Path("examples").resolve())
        done = run(RUNGC, "build", "examples/gsk-mill/mill.pmc", "-o", str(self.folder / "out/mill.so"), "-g")
        self.assertEqual(done.returncode, 0, done.stdout)
        return [line for line in section.splitlines() if line.split(" ")[0] in programs]

    def in_folder(self, command):
        done = subprocess.run(["bash", "-c", command], cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=patience(250), errors="replace")
        self.assertEqual(done.returncode, 0, f"{command}\n{done.stdout}")
        return done.stdout

    @tool("valgrind")
    def test_callgrind_runs_as_the_guide_says(self):
        """On rungc itself, with all its debug information."""
        count, annotate = self.guide_commands("valgrind", "callgrind_annotate")
        self.in_folder(count)
        shown = self.in_folder(annotate)
        scans = int(re.search(r"--scans (\d+)", count).group(1))
        first = re.search(r"^ *([\d,]+) .*LD   SPINDLE_CW$", shown, re.MULTILINE)  # of LEVEL1, which runs in every scan
        self.assertIsNotNone(first, shown)
        self.assertGreaterEqual(int(first.group(1).replace(",", "")), scans)
        self.assertGreater(len(re.findall(r"^ *[\d,]+ .*(?:LD|AND|OUT) +\S+$", shown, re.MULTILINE)), 100)

    @tool("perf")
    def test_perf_runs_as_the_guide_says(self):
        record, report, annotate = self.guide_commands("perf")
        if subprocess.run(["perf", "record", "-e", "cpu-clock", "-o", os.devnull, "true"], capture_output=True).returncode != 0:
            self.skipTest("this machine does not let perf record")
        self.in_folder(record)
        self.assertRegex(self.in_folder(report), r"\d+\.\d+% +\[\.\] LEVEL2\.20\n")
        self.assertRegex(self.in_folder(annotate), r"\d+\.\d+ +mill\.pmc:\d+\n")


if __name__ == "__main__":
    go_to_root()
    RUNGC = os.path.abspath(sys.argv.pop(1))
    MINI_HOST = os.path.abspath(sys.argv.pop(1))
    unittest.main()
