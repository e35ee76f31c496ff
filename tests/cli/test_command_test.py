#!/usr/bin/env python3
"""rungc test as a user sees it: files and folders, several at a time, filters, colours, progress, watching. test_command_test.py RUNGC"""
import os
import pty
import re
import select
import signal
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as xml
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from patience import patience

RUNGC = None
OK, WRONG, USAGE, ENVIRONMENT = 0, 1, 2, 3

LAMP = """dialect nct
module MAIN
symbol START 5100.00
symbol PUMP  5101.00
symbol SPEED 5200
rung
|--[START]--(PUMP)
"""
GOOD = "program lamp.lad\nset START on\nscan 3\nexpect PUMP on\n"
BAD = "program lamp.lad\nscan\nexpect PUMP on\n"


class Folder(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.file("lamp.lad", LAMP)

    def file(self, name, content):
        path = Path(self.folder.name) / name
        path.parent.mkdir(exist_ok=True)
        path.write_text(content)
        return name

    def run_tests(self, *args, engine="interp"):
        done = subprocess.run([RUNGC, "test", *args, "--engine", engine], cwd=self.folder.name, capture_output=True, timeout=patience(), text=True)
        self.lines = done.stdout.splitlines()
        return done


class Selecting(Folder):
    def test_a_folder_gives_all_scenarios_below_sorted(self):
        for name in ("b.scn", "a.scn", "deep/c.scn", "deep/start.part"):
            self.file(name, GOOD.replace("lamp.lad", "../lamp.lad") if "/" in name else GOOD)
        done = self.run_tests(".")
        self.assertEqual(done.returncode, OK, done.stdout)
        self.assertEqual([line.split()[1] for line in self.lines[:-1]], ["a.scn", "b.scn", "deep/c.scn"])
        self.assertRegex(self.lines[-1], r"^3 passed, 0 failed in \d")

    def test_files_stay_in_their_order(self):
        self.file("b.scn", GOOD), self.file("a.scn", GOOD)
        self.run_tests("b.scn", "a.scn")
        self.assertEqual([line.split()[1] for line in self.lines[:-1]], ["b.scn", "a.scn"])

    def test_a_folder_without_scenarios(self):
        Path(self.folder.name, "empty").mkdir()
        done = self.run_tests("empty")
        self.assertEqual((done.returncode, done.stderr), (USAGE, "rungc: there is no scenario (*.scn) in or below 'empty'\n"))

    def test_a_missing_file(self):
        done = self.run_tests("none.scn")
        self.assertEqual(done.returncode, ENVIRONMENT)
        self.assertIn("cannot read 'none.scn'", done.stdout)

    def test_a_program_gets_one_line(self):
        for name in ("lamp.lad", "mill.pmc", "mill.plc"):
            self.file(name, LAMP)
            done = self.run_tests(name)
            self.assertEqual(done.returncode, USAGE)
            self.assertEqual(len(done.stderr.splitlines()), 1)
            self.assertIn(f"'{name}' is a program, not a scenario: `rungc check {name}` checks it", done.stderr)

    def test_filters(self):
        for name in ("pump-on.scn", "pump-off.scn", "lamp-on.scn", "deep/pump.scn"):
            self.file(name, GOOD.replace("lamp.lad", "../lamp.lad") if "/" in name else GOOD)
        for args, expected in ((["--filter", "pump"], ["deep/pump.scn", "pump-off.scn", "pump-on.scn"]),
                               (["--filter", "*-on.scn"], ["lamp-on.scn", "pump-on.scn"]),
                               (["--filter", "pump*"], ["deep/pump.scn", "pump-off.scn", "pump-on.scn"]),
                               (["--filter", "deep/*"], ["deep/pump.scn"]),
                               (["--filter", "off", "--filter", "lamp-o"], ["lamp-on.scn", "pump-off.scn"])):
            self.assertEqual(self.run_tests(".", *args).returncode, OK)
            self.assertEqual([line.split()[1] for line in self.lines[:-1]], expected, args)
        done = self.run_tests(".", "--filter", "nothing")
        self.assertEqual((done.returncode, done.stderr), (USAGE, "rungc: --filter matches none of the 4 scenarios\n"))

    def test_fail_fast(self):
        for name, text in (("a.scn", GOOD), ("b.scn", BAD), ("c.scn", BAD), ("d.scn", GOOD)):
            self.file(name, text)
        for jobs in ("1", "4"):
            done = self.run_tests(".", "--fail-fast", "-j", jobs)
            self.assertEqual(done.returncode, WRONG)
            self.assertRegex(self.lines[-1], r"^1 passed, 1 failed, 2 not run in ")

    def test_several_at_a_time_come_in_order(self):
        names = [self.file(f"s{i:02}.scn", BAD if i % 5 == 0 else f"program lamp.lad\nset START on\nscan {2000 if i % 3 == 0 else 1}\nexpect PUMP on\n")
                 for i in range(24)]
        alone = self.run_tests(*names, "-j", "1", engine="interp,jit")
        # Without the times, which are never the same.
        expected = [re.sub(r", \d+ ms|in .*", "", line) for line in self.lines]
        together = self.run_tests(*names, "-j", "8", engine="interp,jit")
        self.assertEqual(alone.returncode, together.returncode)
        self.assertEqual([re.sub(r", \d+ ms|in .*", "", line) for line in self.lines], expected)
        self.assertEqual(len([line for line in expected if line.startswith("FAILED")]), 5)

    def test_engines_that_are_files_at_a_time(self):
        names = []
        for i in range(4):
            self.file(f"p{i}.lad", LAMP.replace("5101.00", f"51{10 + i}.00"))
            names.append(self.file(f"p{i}.scn", GOOD.replace("lamp.lad", f"p{i}.lad")))
        done = self.run_tests(*names, "-j", "4", "-O", "0", engine="all")
        self.assertEqual(done.returncode, OK, done.stdout)

    def test_wrong_numbers_of_jobs(self):
        self.file("a.scn", GOOD)
        for jobs in ("0", "many", "-1"):
            self.assertEqual(self.run_tests("a.scn", "-j", jobs).returncode, USAGE)


class Reporting(Folder):
    def test_times(self):
        self.file("a.scn", GOOD)
        self.run_tests("a.scn")
        self.assertRegex(self.lines[0], r"^ok      a\.scn \(3 scans, \d+ ms\)$")
        self.assertRegex(self.lines[1], r"^1 passed, 0 failed in (\d+ ms|\d+\.\d\d s)$")

    def test_what_is_printed(self):
        self.file("a.scn", 'program lamp.lad\nset START 1\nset SPEED 500\nscan 3\nprint PUMP "after three" SPEED\nexpect PUMP off\n')
        done = self.run_tests("a.scn", "--junit", "report.xml", engine="interp,jit")
        self.assertEqual(done.returncode, WRONG)
        self.assertRegex(self.lines[1], r"^  \d+\.\d{3} ms, scan 3: PUMP = 1, after three, SPEED = 500 \(0x1F4\)$")
        self.assertIn("a.scn:6: [interp] PUMP is 1, expected off", self.lines[2])
        case = xml.parse(Path(self.folder.name) / "report.xml").getroot().find("testcase")
        self.assertIn("after three", case.find("system-out").text)
        self.assertIn("a.scn:6:", case.find("failure").text)

    def test_a_scenario_that_expects_nothing(self):
        self.file("a.scn", "program lamp.lad\nscan\n")
        self.file("b.scn", GOOD)
        done = self.run_tests(".")
        self.assertEqual(done.returncode, OK)
        self.assertIn("warning: it expects nothing", self.lines[1])
        self.assertRegex(self.lines[-1], r"^2 passed, 0 failed, 1 expecting nothing in ")
        done = self.run_tests(".", "--strict")
        self.assertEqual(done.returncode, WRONG)
        self.assertIn("a.scn:1: the scenario expects nothing", done.stdout)
        self.assertRegex(self.lines[-1], r"^1 passed, 1 failed in ")

    def test_included_files_are_named(self):
        self.file("parts/start.part", "program ../lamp.lad\nset START 1\nscan\n")
        self.file("parts/end.part", "\nexpect PUMP off\n")
        self.file("a.scn", "include parts/start.part\ninclude parts/end.part\n")
        self.assertIn("  parts/end.part:2: PUMP is 1, expected off", self.run_tests("a.scn").stdout)

    def test_everything_that_is_wrong_is_told_at_once(self):
        self.file("a.scn", "program lamp.lad\nwait 2s\nset STRAT on\nscan\nexpect PUMP maybe\nprint PMUP\n")
        out = self.run_tests("a.scn").stdout
        for text in ("a.scn:2: unknown statement 'wait'; did you mean: run 250ms", "a.scn:3: 'STRAT' is not a name of this program; did you mean START?",
                     "a.scn:5: 'maybe' is not a value", "a.scn:6: 'PMUP' is not a name of this program; did you mean PUMP?"):
            self.assertIn(text, out)
        self.assertLess(out.index("a.scn:2:"), out.index("a.scn:3:"))
        self.assertLess(out.index("a.scn:3:"), out.index("a.scn:5:"))

    def test_names_are_not_guessed_at_when_the_program_is_unknown(self):
        self.file("a.scn", "program lamp.lad\nconfg nc simulated\nset NC.MPOS.1 3\nscan\nexpect PUMP 1\n")
        out = self.run_tests("a.scn").stdout
        self.assertIn("a.scn:2: unknown statement 'confg'; did you mean: config KEY VALUE", out)
        self.assertEqual(out.count("a.scn:"), 1)

    def test_errors_of_the_program_come_with_those_of_the_scenario(self):
        self.file("bad.lad", LAMP.replace("[START]", "[STRAT]"))
        self.file("a.scn", "program bad.lad\nwait 2s\nexpect PUMP 1\n")
        out = self.run_tests("a.scn").stdout
        self.assertIn("a.scn:2: unknown statement 'wait'", out)
        self.assertIn("undeclared-symbol", out)

    def test_colours(self):
        self.file("a.scn", GOOD)
        self.file("b.scn", BAD)
        self.assertNotIn("\033", self.run_tests("a.scn", "b.scn").stdout)
        self.assertNotIn("\033", self.run_tests("a.scn", "b.scn", "--color", "never").stdout)
        out = self.run_tests("a.scn", "b.scn", "--color", "always").stdout
        self.assertIn("\033[32mok\033[0m", out)
        self.assertIn("\033[1;31mFAILED\033[0m", out)
        self.assertEqual(self.run_tests("a.scn", "--color", "purple").returncode, USAGE)


class OnATerminal(Folder):
    def run_on_terminal(self, *args):
        parent, child = pty.openpty()
        process = subprocess.Popen([RUNGC, "test", *args, "--engine", "interp"], cwd=self.folder.name, stdout=child, stderr=child)
        os.close(child)
        out = b""
        while True:
            try:
                chunk = os.read(parent, 4096)
            except OSError:
                break
            if not chunk:
                break
            out += chunk
        os.close(parent)
        self.assertEqual(process.wait(patience()), OK, out)
        return out.decode()

    def test_short_runs_have_colours_and_no_progress(self):
        self.file("a.scn", GOOD)
        out = self.run_on_terminal("a.scn")
        self.assertIn("\033[32mok\033[0m", out)
        self.assertNotIn("1 of 1", out)
        self.assertNotIn("\033", self.run_on_terminal("a.scn", "--color", "never"))

    def test_long_runs_show_how_far_they_are(self):
        scans, out = 20000, ""
        while "1 of 1" not in out and scans < 1e9:  # until it takes long, however fast the machine is
            scans *= 3
            self.file("long.scn", f"program lamp.lad\nset START on\nscan {scans}\nexpect PUMP on\n")
            out = self.run_on_terminal("long.scn")
        self.assertRegex(out, r"\r\033\[K1 of 1, \d\.\d\d s: long\.scn")
        self.assertRegex(out.split("\r\033[K")[-1], r"^\033\[32mok")


class Watching(Folder):
    def start(self, *args):
        self.process = subprocess.Popen([RUNGC, "test", *args, "--watch-files", "--engine", "interp"], cwd=self.folder.name, stdout=subprocess.PIPE)
        self.addCleanup(self.stop)
        self.out = b""

    def stop(self):
        if self.process.poll() is None:
            self.process.kill()
        self.process.wait(patience())
        self.process.stdout.close()

    def until(self, text):
        """What came until this text, which must come."""
        while text.encode() not in self.out:
            ready, _, _ = select.select([self.process.stdout], [], [], patience())
            chunk = os.read(self.process.stdout.fileno(), 4096) if ready else b""
            self.assertTrue(chunk, f"{text!r} did not come: {self.out!r}")
            self.out += chunk
        seen, self.out = self.out.split(text.encode(), 1)
        return (seen + text.encode()).decode()

    def test_runs_again_when_something_changes(self):
        self.file("start.part", "set START on\n")
        self.file("a.scn", "program lamp.lad\ninclude start.part\nscan\nexpect PUMP on\n")
        self.start(".")
        self.assertIn("1 passed, 0 failed", self.until("Ctrl-C ends\n"))

        self.file("start.part", "set START off\n")  # an included file
        seen = self.until("Ctrl-C ends\n")
        self.assertIn("start.part has changed", seen)
        self.assertIn("0 passed, 1 failed", seen)

        new = Path(self.folder.name, "lamp.new")  # the program, put in place as editors do
        new.write_text(LAMP.replace("[START]", "[/START]"))
        new.replace(Path(self.folder.name, "lamp.lad"))
        seen = self.until("Ctrl-C ends\n")
        self.assertIn("lamp.lad has changed", seen)
        self.assertIn("1 passed, 0 failed", seen)

        self.file("b.scn", BAD)  # a new one in the folder; with [/START] it passes
        self.assertIn("2 passed, 0 failed", self.until("Ctrl-C ends\n"))

        self.file("a.scn", "programme\n")  # mistakes do not end it
        self.assertIn("a.scn:1: unknown statement 'programme'", self.until("Ctrl-C ends\n"))

        self.file("notes.txt", "no scenario\n")  # which is nothing to it; the next change is
        self.file("a.scn", "programmes\n")
        seen = self.until("Ctrl-C ends\n")
        self.assertIn("a.scn has changed", seen)
        self.assertIn("a.scn:1: unknown statement 'programmes'", seen)
        self.assertNotIn("notes.txt", seen)
        self.process.send_signal(signal.SIGINT)
        self.assertEqual(self.process.wait(patience()), WRONG)

    def test_waits_for_a_program_that_is_not_there(self):
        self.file("a.scn", GOOD.replace("lamp.lad", "later.lad"))
        self.start("a.scn")
        self.assertIn("cannot read 'later.lad'", self.until("Ctrl-C ends\n"))
        self.file("later.lad", LAMP)
        self.assertIn("1 passed, 0 failed", self.until("Ctrl-C ends\n"))
        self.process.send_signal(signal.SIGTERM)
        self.assertEqual(self.process.wait(patience()), OK)


if __name__ == "__main__":
    RUNGC = os.path.abspath(sys.argv.pop(1))
    unittest.main()
