#!/usr/bin/env python3
"""rungc run as a person uses it: inputs, scenarios, and the prompt, through a terminal of its own. prompt_test.py RUNGC"""
import os
import pty
import re
import select
import signal
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from patience import patience
from root import go_to_root

RUNGC = ""
OK, WRONG, USAGE, ENVIRONMENT = 0, 1, 2, 3
ROOT = Path(__file__).resolve().parents[2]
RUNNING = r"scan \d+, [\d.]+ s, running for "  # a statement that takes its time

LAMP = """dialect nct
module MAIN

symbol START   5100.00  ; set by the tests: allow(never-written)
symbol STOP    5100.01  ; allow(never-written)
symbol PUMP    5101.00
symbol READY   5101.01
symbol T_WARM  5200

rung "start/stop latch"
|--[START]--+--[/STOP]--(PUMP)
|--[PUMP]---+

rung "warm after half a minute"
|--[PUMP]--{TOND T_WARM #30 #1}--(READY)
"""

LAMP_SCENARIO = """program lamp.lad
set START 1
scan
set START 0
scan
expect PUMP 1
print PUMP "still on"
"""

LOOP = """FUNC END1
FUNC LBL
PRM L1
LDI X0.0
FUNC JMPB
PRM L1
FUNC END2
"""


def rungc(*args, cwd, stdin=""):
    return subprocess.run([RUNGC, *args], cwd=cwd, input=stdin, capture_output=True, text=True, timeout=patience())


class Folder(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.addCleanup(self.scratch.cleanup)
        self.folder = self.scratch.name
        self.file("lamp.lad", LAMP)
        self.file("lamp.scn", LAMP_SCENARIO)

    def file(self, name, text):
        (Path(self.folder) / name).write_text(text, encoding="utf-8")
        return name

    def read(self, name):
        return (Path(self.folder) / name).read_text(encoding="utf-8")

    def run_it(self, *args, stdin=""):
        return rungc("run", *args, cwd=self.folder, stdin=stdin)

    def good(self, *args, stdin=""):
        done = self.run_it(*args, stdin=stdin)
        self.assertEqual((done.returncode, done.stderr), (OK, ""), done.stdout)
        return done.stdout

    def passes(self, scenario):
        done = rungc("test", scenario, "--strict", "--engine", "all", cwd=self.folder)
        self.assertEqual(done.returncode, OK, done.stdout + self.read(scenario))


class Inputs(Folder):
    """--set and --scenario."""

    def test_an_input_is_set_before_the_first_scan(self):
        self.assertIn("10.000 ms  PUMP = 1", self.good("lamp.lad", "--set", "START=on", "--watch", "PUMP"))
        both = self.good("lamp.lad", "--set", "START=1", "--set", "STOP=true", "--watch", "PUMP")
        self.assertIn("10.000 ms  PUMP = 0", both)

    def test_wrong_inputs(self):
        for pair, message in (("STRAT=1", "did you mean START?"), ("START", "--set START: expected NAME=VALUE"),
                              ("START=2", "a bit takes 0 or 1, not 2"), ("START=yes", "'yes' is not a value: expected a number"),
                              ("=1", "expected NAME=VALUE")):
            done = self.run_it("lamp.lad", "--set", pair)
            self.assertEqual(done.returncode, USAGE, pair)
            self.assertIn(message, done.stderr)

    def test_a_scenario_drives_the_program(self):
        output = self.good("lamp.lad", "--scenario", "lamp.scn", "--watch", "PUMP")
        self.assertIn("10.000 ms  PUMP = 1", output)
        self.assertIn('scan 2: PUMP = 1, still on', output)
        self.assertIn("2 scans, 20.000 ms", output)
        self.assertIn("5 scans", self.good("lamp.lad", "--scenario", "lamp.scn", "--scans", "3"))

    def test_a_scenario_brings_its_program(self):
        self.assertIn("2 scans", self.good("--scenario", "lamp.scn"))
        self.file("no.scn", "scan\n")
        done = self.run_it("--scenario", "no.scn")
        self.assertEqual(done.returncode, USAGE)
        self.assertIn("names no program and is not in a project", done.stderr)

    def test_a_scenario_of_a_project(self):
        done = rungc("run", "--scenario", "examples/gsk-mill/tool-change.scn", cwd=ROOT)
        self.assertEqual((done.returncode, done.stderr), (OK, ""), done.stdout)

    def test_a_scenario_brings_its_configuration(self):
        self.file("slow.scn", "program lamp.lad\nconfig timeslice 2ms\nscan 2\nexpect PUMP 0\n")
        self.assertIn("2 scans, 20.000 ms", self.good("--scenario", "slow.scn"))
        self.assertIn("2 scans, 50.000 ms", self.good("--scenario", "slow.scn", "--config", "timeslice=5ms"))
        self.file("wrong.scn", "program lamp.lad\nconfig nothing 1\nscan\n")
        done = self.run_it("--scenario", "wrong.scn")
        self.assertEqual(done.returncode, USAGE)
        self.assertIn("nothing", done.stderr)

    def test_a_scenario_that_fails_explains_itself(self):
        self.file("bad.scn", "program lamp.lad\nscan\nexpect PUMP 1\nscan 100\n")
        done = self.run_it("--scenario", "bad.scn")
        self.assertEqual(done.returncode, WRONG)
        self.assertIn("bad.scn:3: PUMP is 0, expected 1 (scan 1, 0.010 s)", done.stdout)
        self.assertIn('written by rung 1 "start/stop latch"', done.stdout)
        self.assertIn("1 scan, 10.000 ms", done.stdout)

    def test_scenarios_that_cannot_be_run(self):
        for text, status, message in (("program lamp.lad\nfrob\n", WRONG, "x.scn:2: unknown statement 'frob'"),
                                      ("program lamp.lad\nexpect_error x\n", USAGE, "does not compile"),
                                      ("program lamp.lad\nset NOTHING 1\n", WRONG, "is not a name of this program")):
            self.file("x.scn", text)
            done = self.run_it("--scenario", "x.scn")
            self.assertEqual(done.returncode, status, text)
            self.assertIn(message, done.stdout + done.stderr)
        self.assertEqual(self.run_it("--scenario", "none.scn").returncode, ENVIRONMENT)
        self.assertEqual(self.run_it("lamp.lad", "--scenario", "lamp.scn", "--realtime").returncode, USAGE)

    def test_for_counts_after_a_scenario_too(self):
        self.assertIn("102 scans", self.good("lamp.lad", "--scenario", "lamp.scn", "--for", "1s"))
        self.assertIn("100 scans", self.good("lamp.lad", "--for", "1s", "-i"))

    def test_texts_need_no_quotes(self):
        self.assertEqual(rungc("new", "technol", "t", cwd=self.folder).returncode, OK)
        for value, message in (("3x", "'3x' is not a value"), ("=1", "'=1' is not a value"), ("1s", "is a time"),
                               ("1 2", "unexpected '2'")):
            done = self.run_it("lamp.lad", "--set", f"START={value}")
            self.assertEqual(done.returncode, USAGE)
            self.assertIn(message, done.stderr)
        done = self.run_it("lamp.lad", "--set", "NC.MPOS.1=x")
        self.assertIn("is a number, not a text", done.stderr)

    def test_output_can_be_read_by_programs(self):
        self.assertEqual(self.good("lamp.lad", "-q"), "")
        done = self.run_it("lamp.lad", "--json", "--watch", "PUMP")
        self.assertEqual(done.stdout.strip(), "[]")
        self.assertIn("PUMP = 0", done.stderr)

    def test_too_many_scans(self):
        self.assertEqual(self.run_it("lamp.lad", "--scans", "18446744073709551616").returncode, USAGE)

    def test_places_in_the_scenario_are_named(self):
        self.file("x.scn", "program lamp.lad\nscan 0\n")
        self.file("wrong.scn", "program lamp.lad\n\nconnect A B\nscan\n")
        done = self.run_it("--scenario", "wrong.scn")
        self.assertEqual(done.returncode, USAGE)
        self.assertIn("wrong.scn:3: this dialect has no connections", done.stderr)
        self.file("gsk.scn", "program other.pmc\ndialect gsk\nset START 1\nscan\nexpect PUMP 1\n")
        self.good("lamp.lad", "--scenario", "gsk.scn")  # another program: its dialect does not count

    def test_a_trace(self):
        self.good("lamp.lad", "--set", "START=1", "--scans", "2", "--trace", "out.csv", "--watch", "PUMP")
        self.assertEqual(len(self.read("out.csv").splitlines()), 4)  # names, the start, two scans
        self.good("lamp.lad", "--trace", "out.vcd")
        self.assertIn("PUMP", self.read("out.vcd"))
        done = self.run_it("lamp.lad", "--trace", "out.txt")
        self.assertEqual(done.returncode, USAGE)
        self.assertIn("must end in .vcd or .csv", done.stderr)

    def test_a_shared_object(self):
        self.assertEqual(rungc("build", "lamp.lad", "-o", "lamp.so", cwd=self.folder).returncode, OK)
        output = self.good("./lamp.so", "--scenario", "lamp.scn", "--watch", "PUMP")
        self.assertIn("10.000 ms  PUMP = 1", output)
        done = self.run_it("./lamp.so", "-i", stdin="set START 1\nscan\nwhy PUMP\nsave x.scn\n")
        self.assertEqual(done.returncode, WRONG)
        self.assertIn("run its sources", done.stdout)
        self.assertIn("PUMP (5101.00) = 1, since scan 1, 0.010 s\n    written by rung 1", done.stdout)
        self.file("slow.scn", "program lamp.lad\nperiod 40ms\nscan\n")
        done = self.run_it("./lamp.so", "--scenario", "slow.scn")
        self.assertEqual(done.returncode, USAGE)
        self.assertIn("the scenario sets the period", done.stderr)
        done = self.run_it("./lamp.so", "--config", "timeslice")
        self.assertEqual(done.returncode, USAGE)
        self.assertIn("--config takes KEY=VALUE, found 'timeslice'", done.stderr)
        done = self.run_it("./lamp.so", "--config", "timeslice=5ms")
        self.assertEqual(done.returncode, USAGE)
        self.assertIn("is for the compiler", done.stderr)

    def test_a_fault_names_its_explanation(self):
        self.file("loop.pmc", LOOP)
        done = self.run_it("loop.pmc", "--scans", "5")
        self.assertEqual(done.returncode, WRONG)
        self.assertIn("stopped with a fault: dead-loop", done.stderr)
        self.assertIn("try `rungc explain dead-loop`", done.stderr)
        self.assertIn("1 scan,", done.stdout)
        done = self.run_it("loop.pmc", "-i", stdin="scan\nsave saved.scn\n")
        self.assertEqual(done.returncode, WRONG)
        self.assertIn("cold_start and warm_start restart it", done.stdout)
        self.passes("saved.scn")


class Piped(Folder):
    """The prompt without a terminal: lines from a pipe."""

    def prompt(self, lines, *args, status=OK, program="lamp.lad"):
        done = self.run_it(program, "-i", *args, stdin=lines)
        self.assertEqual((done.returncode, done.stderr), (status, ""), done.stdout)
        return done.stdout

    def test_every_command(self):
        output = self.prompt("watch PUMP\ntoggle START\nscan\nPUMP\nexpect PUMP on\nwhy PUMP\nwatch\nunwatch PUMP\n"
                             "toggle START\nscan 2 times\nmessages\nhelp\nhelp toggle\nprint PUMP \"text\"\nquit\nscan\n")
        for text in ("0.000 ms  PUMP = 0", "10.000 ms  PUMP = 1", "PUMP = 1", "ok", "written by rung 1", "no messages",
                     "toggle NAME", "scan [N]", "scan 3: PUMP = 1, text", "3 scans, 30.000 ms"):
            self.assertIn(text, output)
        self.assertNotIn("expect_error", output)

    def test_a_double_has_a_name(self):
        self.file("sum.lad", "dialect nct\nmodule MAIN\nrung\n|--[7100.00]--{MOVF 7000 *2.5}\n")
        output = self.prompt("scan 2\nset 7100.00 1\nscan\nREAL.7000\n7000\nwhy REAL.7000\nwatch REAL.7000\nset REAL.7000 0x10\n"
                             "scan\nsave out.scn\nprint REAL.7000\n", program="sum.lad")
        for text in ("REAL.7000 = 2.5\n", "7000 = 0 (0x0)\n", " = 2.5, since scan 3, 0.030 s\n    written by rung 1",
                     "30.000 ms  REAL.7000 = 16\n", "40.000 ms  REAL.7000 = 2.5\n", "scan 4: REAL.7000 = 2.5\n"):
            self.assertIn(text, output)
        self.assertIn("\nexpect REAL.7000 2.5\n", self.read("out.scn"))
        self.assertIn("did you mean", self.prompt("REAL.FL_RE\nprint REAL.FL_RE\n", status=WRONG, program="sum.lad"))

    def test_forces(self):
        lines = "set START 1\nforce PUMP 0\nscan\nPUMP\nforces\nunforce PUMP\nscan\nPUMP\nforces\n"
        for args in ((), ("--engine", "interp")):
            output = self.prompt(lines, *args).splitlines()
            self.assertEqual(output[:4], ["PUMP = 0", "PUMP = 0, since 0.000 s", "PUMP = 1", "nothing is forced"])
        for args in ((), ("--no-ir",)):
            self.assertEqual(rungc("build", "lamp.lad", "-o", "lamp.so", *args, cwd=self.folder).returncode, OK)
            output = self.prompt(lines, status=WRONG if args else OK, program="./lamp.so")
            self.assertIn("./lamp.so: it carries no IR" if args else "PUMP = 0", output)

    def test_why_says_what_is_forced(self):
        output = self.prompt("force STOP on\nforce PUMP 1\nscan\nwhy PUMP\nwhy READY\nunforce\nwhy PUMP\n")
        for text in ("PUMP (5101.00) = 1, since scan 1, 0.010 s\n    forced by a person\n      force PUMP 1\n",
                     "  PUMP (5101.00) = 1, since scan 1, 0.010 s\n    forced by a person\n      force PUMP 1\n"):
            self.assertIn(text, output)
        # A value that has been set, and that no scan has seen.
        self.assertIn("PUMP = 1, set after scan 1, 0.010 s; no scan has run since\n", self.prompt("scan\nset PUMP 1\nwhy PUMP\n"))

    def test_wrong_forces(self):
        for line, message in (("force NOTHING 1", "'NOTHING' is not a name"), ("force PUMP", "expected a value"),
                              ("force PUMP 2", "a bit takes 0 or 1"), ("force", "expected a name"),
                              ("unforce PUMP", "PUMP is not forced")):
            self.assertIn(message, self.prompt(line + "\nscan\n", status=WRONG))

    def test_wrong_lines(self):
        for line, message in (("togle START", "did you mean toggle?"), ("frob", "help lists them"),
                              ("wait 2s", "did you mean: run 250ms"), ("expect PUMP 1", "PUMP is 0, expected 1 (before the first scan)"),
                              ("set NOTHING 1", "'NOTHING' is not a name"), ("toggle T_WARM", "is not a bit; write: set T_WARM VALUE"),
                              ("toggle", "the command is: toggle NAME"), ("watch NOTHING", "is not a name"),
                              ("unwatch PUMP", "PUMP is not watched"), ("why", "the command is: why NAME"),
                              ("why NOTHING", "is not a name"), ("save x.txt", "save FILE.scn"), ("save", "save FILE.scn"),
                              ("save none/x.scn", "cannot write 'none/x.scn'"), ("help frob", "is not a statement"),
                              ("program x.lad", "belongs to the start of a scenario"), ("period 5ms", "belongs to the start"),
                              ("set PUMP \"x", "a text is not closed"), ("include none.scn", "cannot read 'none.scn'"),
                              ("set !INP 1 2", "unexpected '2'"), ("set N_FRISTCC 1", "did you mean N_FIRSTCC?")):
            output = self.prompt(line + "\n# a comment\n\nscan\n", status=WRONG)
            self.assertIn(message, output)
            self.assertIn("1 scan,", output, "the session continues")

    def test_the_saved_session_passes(self):
        self.prompt("watch PUMP READY\ntoggle START\nscan\nexpect PUMP on\nexpect READY on\nset NOTHING 1\nrun 31s\n"
                    "save saved.scn\n", status=WRONG)
        saved = self.read("saved.scn")
        self.assertIn("program lamp.lad\n", saved)
        self.assertNotIn("NOTHING", saved)
        self.assertNotIn("READY on", saved, "what failed is left out")
        self.assertIn("expect READY 1\n", saved, "what is watched is expected")
        self.passes("saved.scn")

    def test_an_included_file(self):
        self.file("steps.part", "set START 1\nscan 2\nexpect PUMP 1\n")
        self.prompt("include steps.part\nset STOP 1\nscan\nexpect PUMP 0\nsave saved.scn\n")
        self.passes("saved.scn")
        self.file("wrong.part", "set START 1\nscan x\n")
        self.assertIn("wrong.part:2: 'x' is not a number of runs", self.prompt("include wrong.part\n", status=WRONG))

    def test_what_went_before_is_saved_too(self):
        output = self.prompt("expect PUMP 1\nsave saved.scn\n", "--set", "START=1", "--scenario", "lamp.scn", "--scans",
                             "2", "--config", "timeslice=2ms")
        self.assertIn("wrote saved.scn", output)
        self.assertIn("config timeslice 2ms", self.read("saved.scn"))
        self.passes("saved.scn")

    def test_the_period_of_a_scenario_is_saved(self):
        self.file("slow.scn", "program lamp.lad\nperiod 40ms\nset START 1\nscan 2\n")
        self.prompt("scan\nwatch T_WARM\nsave saved.scn\n", "--scenario", "slow.scn")
        self.assertIn("period 40000us\n", self.read("saved.scn"))
        self.passes("saved.scn")

    def test_names_of_files_with_blanks(self):
        self.file("my lamp.lad", LAMP)
        self.prompt("toggle START\nscan\nexpect PUMP 1\nsave saved.scn\n", program="my lamp.lad")
        self.assertIn('program "my lamp.lad"', self.read("saved.scn"))
        self.passes("saved.scn")

    def test_another_program_in_the_folder_of_a_project(self):
        self.assertEqual(rungc("new", "nct", "p", cwd=self.folder).returncode, OK)
        self.file("p/lamp.lad", LAMP)
        self.prompt("toggle START\nscan\nexpect PUMP 1\nsave p/saved.scn\n", "--project", "p", program="p/lamp.lad")
        self.passes("p/saved.scn")

    def test_a_program_that_needs_its_project(self):
        self.assertEqual(rungc("new", "technol", "t", cwd=self.folder).returncode, OK)
        done = self.run_it("--project", "t", "-i", stdin="scan\nwatch P1IN\nsave t/saved.scn\nsave saved.scn\n")
        self.passes("t/saved.scn")
        if "include" in self.read("t/rung.toml"):
            self.assertIn("save the scenario in the folder of the project", done.stdout)

    def test_a_fault_that_was_not_the_expected_one(self):
        self.file("loop.pmc", LOOP)
        self.assertEqual(self.run_it("loop.pmc", "-i", stdin="expect_fault foo\nscan\nsave saved.scn\n").returncode, WRONG)
        self.assertIn("expect_fault dead-loop", self.read("saved.scn"))
        self.passes("saved.scn")

    def test_what_differs_from_the_project_is_saved(self):
        self.assertEqual(rungc("new", "nct", "p", cwd=self.folder).returncode, OK)
        self.assertIn('timeslice = "2ms"', self.read("p/rung.toml"))
        for value, saved in (("5ms", ["config timeslice 5ms"]), ("2ms", [])):
            self.run_it("--project", "p", "--config", "timeslice=" + value, "-i", stdin="scan\nsave p/saved.scn\n")
            self.assertEqual([line for line in self.read("p/saved.scn").splitlines() if line.startswith("config")], saved)

    def test_one_standard_input(self):
        done = self.run_it("-", "--dialect", "nct", "-i", stdin=LAMP)
        self.assertEqual(done.returncode, USAGE)
        self.assertIn("cannot both come from standard input", done.stderr)

    def test_a_wrong_name_among_the_watched(self):
        self.assertIn("STOP = 0", self.prompt("watch START NOPE STOP\n", status=WRONG))

    def test_a_hollow_session_says_so(self):
        self.assertIn("it expects nothing yet", self.prompt("scan\nsave saved.scn\n"))

    def test_in_a_project_the_program_is_the_projects(self):
        self.assertEqual(rungc("new", "gsk", "clamp", cwd=self.folder).returncode, OK)
        self.file("steps", "")
        done = self.run_it("--project", "clamp", "-i", stdin="scan\nexpect R0.0 0\nsave clamp/saved.scn\nsave outside.scn\n")
        self.assertEqual((done.returncode, done.stderr), (OK, ""), done.stdout)
        self.assertNotIn("program", self.read("clamp/saved.scn"))
        self.assertIn("program clamp/", self.read("outside.scn"))
        self.passes("clamp/saved.scn")
        self.passes("outside.scn")

    def test_retained_memory_is_not_a_scenario(self):
        output = self.prompt("scan\nsave saved.scn\n", "--retain", "image", status=WRONG)
        self.assertIn("a scenario starts cold", output)

    def test_each_dialect(self):
        scenarios = (("gsk", "slot 2\nset X1.0 1\nscan\nexpect X1.0 1\nplc stop\n", "slot 2"),
                     ("nct", "fast\nscan\nset N_SIMU 0\nexpect 5100 0\n", "fast"),
                     ("technol", "scan\nset P1IN 1\nscan\nexpect P1IN 1\nplc stop\nplc start\nscan\n", "plc start"))
        for dialect, lines, saved in scenarios:
            self.assertEqual(rungc("new", dialect, dialect, cwd=self.folder).returncode, OK)
            done = self.run_it("--project", dialect, "-i", stdin=lines + f"save {dialect}/saved.scn\n")
            self.assertEqual(done.stderr, "")
            self.assertIn(saved, self.read(f"{dialect}/saved.scn"), done.stdout)
            self.passes(f"{dialect}/saved.scn")


class Terminal:
    """A program on a terminal of its own, as a person sees it."""

    def __init__(self, *args, cwd):
        self.master, slave = pty.openpty()
        environment = {**os.environ, "TERM": "xterm", "COLUMNS": "100", "LINES": "40"}
        self.process = subprocess.Popen([RUNGC, *args], cwd=cwd, stdin=slave, stdout=slave, stderr=slave, env=environment,
                                        start_new_session=True, preexec_fn=self.own_terminal)
        os.close(slave)
        self.seen = ""

    @staticmethod
    def own_terminal():
        import fcntl
        import termios
        fcntl.ioctl(0, termios.TIOCSCTTY, 0)

    def type(self, keys):
        os.write(self.master, keys.encode())

    def until(self, pattern):
        """What the terminal shows up to this; without escape sequences."""
        while not (found := re.search(pattern, self.seen)):
            if not select.select([self.master], [], [], patience())[0]:
                raise AssertionError(f"no {pattern!r} in:\n{self.seen}")
            try:
                more = os.read(self.master, 4096)
            except OSError:  # the other end is closed
                more = b""
            if not more:
                raise AssertionError(f"ended without {pattern!r}:\n{self.seen}")
            self.seen += re.sub(r"\x1b(\[[0-9;?]*[a-zA-Z]|[=>])", "", more.decode(errors="replace"))
        shown, self.seen = self.seen[:found.end()], self.seen[found.end():]
        return shown

    def line(self, text, then=r"[\s\S]*scan \d+, [\d.]+ s> $"):
        """Types a line; what is shown after it, up to the next prompt."""
        self.type(text + "\r")
        return self.until(re.escape(text) + r"\s*\n" + then)

    def end(self):
        """The exit status."""
        try:
            while select.select([self.master], [], [], patience())[0] and os.read(self.master, 4096):
                pass
        except OSError:  # the other end is closed
            pass
        return self.process.wait(patience())

    def close(self):
        if self.process.poll() is None:
            self.process.kill()
            self.process.wait()
        os.close(self.master)


class OnATerminal(Folder):
    def start(self, *args):
        terminal = Terminal("run", "lamp.lad", "-i", *args, cwd=self.folder)
        self.addCleanup(terminal.close)
        terminal.until(r"scan 0, 0.000 s> ")
        return terminal

    def test_a_session(self):
        terminal = self.start()
        terminal.line("watch PUMP")
        terminal.line("toggle START")
        self.assertIn("PUMP = 1", terminal.line("scan"))
        self.assertIn("ok", terminal.line("expect PUMP on"))
        self.assertIn("wrote saved.scn", terminal.line("save saved.scn"))
        terminal.type("quit\r")
        self.assertEqual(terminal.end(), OK)
        self.passes("saved.scn")

    def test_completion(self):
        terminal = self.start()
        # libedit draws what a completion adds, after the cursor was moved.
        terminal.type("tog\t")
        terminal.until("gle")
        terminal.type("STA\t")
        terminal.until("RT")
        terminal.line("")
        terminal.type("set ST\t\t")
        terminal.until("START  STOP")
        terminal.type("o\t")  # whatever the case
        terminal.until("OP")
        terminal.line("0")
        terminal.line("scan")
        self.assertIn("ok", terminal.line("expect PUMP 1"))
        terminal.type("set N_FIRSTC\t")
        terminal.until("C ")
        terminal.line("1")
        terminal.type("include lamp.\t\t")
        terminal.until("lamp.lad  lamp.scn")
        terminal.type("\x03")
        terminal.until("> $")
        terminal.type("nothing\t")
        terminal.line("", "unknown statement 'nothing'")
        terminal.type("quit\r")
        self.assertEqual(terminal.end(), OK)

    def test_control_c_gives_a_line_up(self):
        terminal = self.start()
        terminal.type("set STOP 1")
        terminal.until("STOP 1")
        terminal.type("\x03")
        terminal.until(r"\^C\s+scan 0, 0.000 s> ")
        self.assertIn("STOP = 0", terminal.line("STOP"))

    def test_control_c_interrupts_a_run(self):
        terminal = self.start()
        terminal.type("run 900000s\r")
        terminal.until(RUNNING)
        terminal.type("\x03")
        shown = terminal.until(r"interrupted\s+scan (\d+), [\d.]+ s> ")
        scans = int(re.search(r"scan (\d+), [\d.]+ s> $", shown).group(1))
        self.assertGreater(scans, 0)
        self.assertLess(scans, 90000000)
        terminal.line("expect PUMP 0")
        terminal.line("save saved.scn")
        self.assertIn(f"run {scans * 10000}us\n", self.read("saved.scn"))
        terminal.type("\x04")
        self.assertEqual(terminal.end(), OK)

    def test_control_c_ends_an_included_file(self):
        self.file("long.part", "run 900000s\nset STOP 1\nscan 5\n")
        terminal = self.start()
        terminal.type("include long.part\r")
        terminal.until(RUNNING)
        terminal.type("\x03")
        terminal.until(r"interrupted\s+scan \d+, [\d.]+ s> $")
        self.assertIn("STOP = 0", terminal.line("STOP"))

    def test_control_c_ends_a_scenario(self):
        self.file("long.scn", "program lamp.lad\nrun 900000s\n")
        terminal = Terminal("run", "--scenario", "long.scn", cwd=self.folder)
        self.addCleanup(terminal.close)
        terminal.until(RUNNING)
        terminal.type("\x03")
        terminal.until(r"interrupted at long.scn:2")
        self.assertEqual(terminal.end(), WRONG)

    def test_a_broken_character_is_dropped(self):
        terminal = self.start()
        os.write(terminal.master, b"PUMP\xc3\r")
        terminal.until("PUMP = 0")

    def test_names_of_files_are_completed_by_characters(self):
        for name in ("ñé.part", "ñè.part", "with space.part"):
            self.file(name, "scan\n")
        terminal = self.start()
        terminal.type("include ñ\t\t")
        terminal.until("ñè.part  ñé.part")
        terminal.type("\x03")
        terminal.until("> $")
        terminal.type("include with\t\r")
        terminal.until(r"scan 1, 0.010 s> $")

    def test_long_compilations_show_that_they_live(self):
        rungs = "".join(f"rung\n|--[{7100 + i // 30}.{i % 30:02}]--{{ADD 8000 8001 8002}}\n" for i in range(20000))
        self.file("big.lad", "dialect nct\nmodule MAIN\n\n" + rungs)
        terminal = Terminal("build", "big.lad", "-o", "big.so", cwd=self.folder)
        self.addCleanup(terminal.close)
        terminal.until(r"compiling to machine code, \d+ s")
        terminal.type("\x03")

    def test_history(self):
        terminal = self.start()
        terminal.line("scan 7")
        terminal.type("\x1b[A")
        terminal.until("scan 7")
        terminal.line("", r"[\s\S]*scan 14, 0.140 s> ")

    def test_a_signal_ends_it(self):
        terminal = self.start()
        terminal.process.send_signal(signal.SIGTERM)
        self.assertEqual(terminal.end(), OK)

    def test_progress_is_shown_and_gone(self):
        terminal = self.start()
        terminal.type("run 900000s\r")
        terminal.until(RUNNING)
        terminal.type("\x03")
        terminal.until(r"interrupted")


if __name__ == "__main__":
    go_to_root()
    RUNGC = os.path.abspath(sys.argv.pop(1))
    unittest.main(verbosity=1)
