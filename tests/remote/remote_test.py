#!/usr/bin/env python3
"""rung-run and rungctl as a user sees them, and the socket between them: remote_test.py BIN"""
import json
import os
import random
import re
import resource
import shutil
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from patience import patience, wait_until

BIN = None
OK, WRONG, USAGE, ENVIRONMENT = 0, 1, 2, 3

# X0.0 lights Y0.0, X0.1 lets the program never end.
PROGRAM = """dialect gsk
symbol GUARD X0.2
FUNC END1
LD   X0.0
OUT  Y0.0
FUNC LBL
PRM  L1
LD   X0.1
FUNC JMPB
PRM  L1
FUNC END2
"""
MAP = """[in]
run = { type = "bit", name = "X0.0" }
[out]
lamp = { type = "bit", name = "Y0.0" }
[rungctl]
permissions = ["set", "force", "reload", "stop", "start", "reset", "profile"]
protected = ["X0.2"]
"""


def build(folder, *options, source=PROGRAM, name="stuck.pmc"):
    (folder / name).write_text(source)
    subprocess.run([BIN / "rungc", "build", "-q", folder / name, "-o", folder / "stuck.so", *options], check=True)
    return folder / "stuck.so"


class Host(unittest.TestCase):
    map = MAP
    program_text = PROGRAM
    source_name = "stuck.pmc"
    build_options = ()

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.home = Path(cls.folder.name)
        cls.program = build(cls.home, *cls.build_options, source=cls.program_text, name=cls.source_name)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def program_with(self, before, after):
        """The program, and what is otherwise in it."""
        self.assertIn(before, self.program_text)
        other = self.home / ("other" + Path(self.source_name).suffix)
        other.write_text(self.program_text.replace(before, after))
        subprocess.run([BIN / "rungc", "build", "-q", other, "-o", self.home / "other.so"], check=True)
        return self.home / "other.so"

    def setUp(self):
        self.environment = {**os.environ, "RUNG_SOCKETS": str(self.home / "sockets")}
        (self.home / "plc.map").write_text(self.map)
        self.log = open(self.home / "log", "w+")
        self.addCleanup(self.log.close)
        self.start()
        self.addCleanup(self.end)
        self.socket = self.home / "sockets/plc.sock"
        self.wait(lambda: self.socket.exists() and "listening at" in self.logged())

    def start(self):
        # In a session of its own, where its compiler process, which has the lowest priority, gets the host's share of a
        # busy processor (sched_autogroup).
        self.host = subprocess.Popen([BIN / "rung-run", self.program, self.home / "plc.map", "--name", "plc"],
                                     stderr=self.log, env=self.environment, start_new_session=True)

    def end(self):
        self.host.terminate()
        self.assertEqual(self.host.wait(patience()), OK)
        self.assertFalse(self.socket.exists())

    def logged(self):
        return (self.home / "log").read_text()

    def wait(self, condition):
        self.assertTrue(wait_until(condition), self.logged())

    def ctl(self, *words, status=OK):
        done = subprocess.run([BIN / "rungctl", *map(str, words)], capture_output=True, text=True, timeout=patience(),
                              env=self.environment)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done.stdout if status == OK else done.stdout + done.stderr

    def get(self, name):
        return json.loads(self.ctl("get", name, "--json"))["values"][name]

    def scans(self):
        return json.loads(self.ctl("status", "--json"))["scans"]

    def pass_by(self, count):
        """Waits for that many scans of the program."""
        end = self.scans() + count
        self.wait(lambda: self.scans() >= end)

    def follow(self):
        following = subprocess.Popen([BIN / "rungctl", "messages", "--follow"], stdout=subprocess.PIPE, text=True, env=self.environment)
        self.addCleanup(following.stdout.close)
        self.addCleanup(following.wait)
        self.addCleanup(following.kill)
        return following

    def read_until(self, following, end):
        lines = [following.stdout.readline()]
        while lines[-1] and not lines[-1].endswith(end + "\n"):
            lines.append(following.stdout.readline())
        self.assertTrue(lines[-1], lines)
        return [line.strip().split(" ", 2)[-1].split(":")[0] for line in lines]

    def trace(self, out, *words):
        """A trace of names into a file, which sees every scan from the next one on."""
        tracing = subprocess.Popen([BIN / "rungctl", "trace", *words, "-o", out], env=self.environment, stdout=subprocess.DEVNULL)
        self.addCleanup(tracing.wait)
        self.addCleanup(tracing.kill)
        self.wait(lambda: out.exists() and out.stat().st_size > 0)
        self.pass_by(2)
        return tracing

    def connect(self):
        made = socket.socket(socket.AF_UNIX)
        self.addCleanup(made.close)
        made.settimeout(patience())
        made.connect(str(self.socket))
        lines = made.makefile("r")
        self.addCleanup(lines.close)
        return made, lines


class Commands(Host):
    def test_status(self):
        text = self.ctl("status")
        self.assertRegex(text, r"^host plc, program stuck, dialect gsk\nrunning: \d+ scans, \d+ missed; program time [\d.]+ s\nsince the host started, every 1000 us: \d+ steps, \d+ overruns, ")
        for words in (["--host", "plc", "status"], ["--json", "status"], ["--json", "--host", "plc", "get", "X0.0"]):  # as of other programs
            self.ctl(*words)
        answer = json.loads(self.ctl("status", "--json"))
        self.assertEqual((answer["ok"], answer["scanned"], answer["faulted"]), (True, True, False))
        self.assertEqual(self.ctl("hosts"), "plc\n")

    def test_set_and_get(self):
        self.assertEqual(self.ctl("set", "D8:2", "500"), "D8:2 = 500 (was 0)\n")
        self.assertEqual(self.ctl("get", "D8:2", "X0.1"), "D8:2 = 500\nX0.1 = false\n")
        self.assertEqual(self.ctl("set", "D8:2", "0x10"), "D8:2 = 16 (was 500)\n")
        self.assertEqual(self.ctl("set", "D8:2", "-1"), "D8:2 = -1 (was 16)\n")
        self.assertIn("found 65536 for D8:2, expected at most 65535", self.ctl("set", "D8:2", "65536", status=WRONG))
        self.assertIn("found -32769 for D8:2, expected at least -32768", self.ctl("set", "D8:2", "-32769", status=WRONG))
        self.assertIn('found "open" for X0.3, expected true or false', self.ctl("set", "X0.3", "open", status=WRONG))
        self.assertIn("NOWHERE is not a name of the program stuck", self.ctl("set", "NOWHERE", "1", status=WRONG))
        self.assertIn("X0.2 is protected by the mapping file", self.ctl("set", "X0.2", "1", status=WRONG))
        self.assertIn("X0 is protected by the mapping file", self.ctl("set", "X0", "4", status=WRONG))  # that bit is in it
        self.assertEqual(self.get("D8:2"), -1)
        changes = re.findall(r"\d{4}-\d\d-\d\d \d\d:\d\d:\d\d \S+ \(user \d+, process \d+\): (.*)", self.logged())
        self.assertEqual(changes, ["set D8:2 from 0 to 500", "set D8:2 from 500 to 16", "set D8:2 from 16 to -1"])
        for name in ("Y0.0", "Y0"):  # a byte with a bit that rungs write
            said = f"rungs write {name}, or may write it by a computed address, so the next scan may overwrite it: forcing it holds it (rungctl force {name} VALUE)\n"
            self.assertTrue(self.ctl("set", name, "0").endswith(said), name)
        self.assertNotIn("rungs write", self.ctl("set", "Y0.6", "1"))

    def test_bits_are_written_as_in_scenarios(self):
        for word, value in (("on", "true"), ("OFF", "false"), ("True", "true"), ("false", "false"), ("1", "true"), ("0", "false")):
            self.assertTrue(self.ctl("set", "X0.3", word).startswith(f"X0.3 = {value} (was "))
            self.assertEqual(self.ctl("force", "X0.3", word), f"X0.3 is forced to {value}\n")
            self.ctl("unforce", "X0.3")

    def test_numbers_are_written_as_in_scenarios(self):
        for value, seen in (("0b101", 5), ("16#1F", 31), ("1_000", 1000), ("+7", 7), ("-0x80", -128), ("65535", -1)):
            self.assertTrue(self.ctl("set", "D8:2", value).startswith(f"D8:2 = {seen} (was "), value)
            self.assertEqual(self.get("D8:2"), seen)
        for value, found in (("1__0", '"1__0"'), ("0x", '"0x"'), ("1.5", "1.5"), ("nan", '"nan"'), ("[1]", '"[1]"'),
                             ("null", '"null"'), ("true", "true")):
            self.assertIn(f"found {found} for D8:2, expected an integer", self.ctl("set", "D8:2", value, status=WRONG))
        for value in ("1e999", "1e-999", "0x1_0000_0000_0000_0000"):
            self.assertIn(f"no variable can hold {value}, given for D8:2", self.ctl("set", "D8:2", value, status=WRONG))
        for value in ("18446744073709551616", "-9223372036854775809"):
            self.assertIn(f"found {value} for D8:2, expected -32768 to 65535", self.ctl("set", "D8:2", value, status=WRONG))
        self.assertIn("found 1.0 for X0.3, expected true or false", self.ctl("set", "X0.3", "1.0", status=WRONG))
        self.assertIn("found 256 for D8, expected at most 255", self.ctl("set", "D8", "0x100", status=WRONG))
        self.assertIn("found 2 for X0.3, expected true or false", self.ctl("set", "X0.3", "2", status=WRONG))

    def test_a_byte_has_no_sign_and_wider_integers_have_one(self):
        self.assertEqual(self.ctl("set", "D100", "255"), "D100 = 255 (was 0)\n")
        self.assertEqual(self.ctl("set", "D100", "-1"), "D100 = 255 (was 255)\n")
        self.assertEqual(self.ctl("get", "D100", "D100:2"), "D100 = 255\nD100:2 = 255\n")
        self.assertEqual(self.ctl("set", "D101", "0x80"), "D101 = 128 (was 0)\n")
        self.assertEqual(self.ctl("get", "D101", "D100:2", "D100:4"), "D101 = 128\nD100:2 = -32513\nD100:4 = 33023\n")

    def test_a_name_that_is_nearly_one(self):
        self.assertIn("GUADR is not a name of the program stuck", self.ctl("get", "GUADR", status=WRONG))
        for command in (("get",), ("watch",), ("set", 1), ("force", 1)):
            text = self.ctl(command[0], "GUADR", *command[1:], status=WRONG)
            self.assertTrue(text.endswith("; did you mean GUARD?\n"), text)
        self.assertNotIn("did you mean", self.ctl("get", "SOMETHING", status=WRONG))
        self.ctl("reload", self.program_with("symbol GUARD X0.2", "symbol LAMPS Y0.1"), "--yes")
        self.assertTrue(self.ctl("get", "LAMSP", status=WRONG).endswith("; did you mean LAMPS?\n"))
        self.assertNotIn("did you mean", self.ctl("get", "GUADR", status=WRONG))  # it is gone
        self.ctl("rollback")
        self.assertTrue(self.ctl("get", "GUADR", status=WRONG).endswith("; did you mean GUARD?\n"))

    def test_more_names_than_a_pass_is_asked_for(self):
        names = [f"D{i}" for i in range(257)]
        self.assertEqual(self.ctl("get", *names[:256]).count("\n"), 256)
        self.assertIn("found 257 names, expected at most 256", self.ctl("get", *names, status=WRONG))

    def test_forces(self):
        self.assertEqual(self.ctl("forced"), "nothing is forced\n")
        self.assertEqual(self.ctl("force", "X0.0", "true"), "X0.0 is forced to true\n")
        self.wait(lambda: self.get("Y0.0"))
        self.ctl("force", "D8:2", "9")
        names = {force["name"]: force["value"] for force in json.loads(self.ctl("forced", "--json"))["forced"]}
        self.assertEqual(names, {"X0.0": True, "D8:2": 9})
        self.assertIn("X0.2 is protected by the mapping file", self.ctl("force", "X0.2", "1", status=WRONG))
        self.assertEqual(self.ctl("unforce", "X0.0"), "X0.0 is no longer forced\n")
        self.wait(lambda: not self.get("Y0.0"))
        self.assertIn("X0.0 is not forced", self.ctl("unforce", "X0.0", status=WRONG))
        self.assertEqual(self.ctl("unforce", "--all"), "D8:2 is no longer forced\n")
        self.assertEqual(self.ctl("forced"), "nothing is forced\n")
        self.assertEqual(self.ctl("unforce", "--all"), "nothing was forced\n")
        self.ctl("unforce", status=USAGE)

    def test_stop_and_start(self):
        self.ctl("stop")
        self.assertIn("stopped by the operator", self.ctl("status"))
        self.ctl("force", "D8:2", "1", status=WRONG)  # there is nothing to hold it
        self.ctl("start")
        self.ctl("force", "X0.0", "1")
        self.wait(lambda: self.get("Y0.0"))
        self.ctl("stop")
        self.assertEqual(self.ctl("forced"), "nothing is forced\n")
        self.pass_by(6)  # in which the program is not to run
        self.assertTrue(self.get("Y0.0"))  # it stays as it is
        self.ctl("start")
        self.wait(lambda: not self.get("Y0.0"))

    def test_a_fault_and_reset(self):
        self.assertIn("the program is running; a reset is needed only after a fault", self.ctl("reset", status=WRONG))
        self.ctl("set", "X0.1", "1")
        self.wait(lambda: "stopped by a fault: dead-loop (rung " in self.ctl("status"))
        self.wait(lambda: "the program has stopped: dead-loop" in self.ctl("messages"))
        self.ctl("set", "X0.1", "0")
        self.ctl("reset")
        self.wait(lambda: "\nrunning: " in self.ctl("status"))
        self.assertRegex(self.ctl("status"), r"\nrunning: \d+ scans, \d+ missed since the last reset; program time ")
        self.assertFalse(self.get("X0.1"))

    def test_reload_and_rollback(self):
        self.assertIn("no program has been reloaded", self.ctl("rollback", status=WRONG))
        self.ctl("set", "D8:2", "7")
        text = self.ctl("reload", self.program)
        self.assertRegex(text, r"kept: \d+ names, \d+ states of edges, timers and counters\nthe new program runs\n$")
        self.assertEqual(self.get("D8:2"), 7)
        text = self.ctl("rollback")
        self.assertRegex(text, r"^kept: \d+ names, \d+ states of edges, timers and counters\nthe former program runs\n$")
        self.assertEqual(self.get("D8:2"), 7)
        self.assertTrue(self.ctl("rollback").endswith("\nthe reloaded program runs again\n"))
        self.assertTrue(self.ctl("rollback").endswith("\nthe former program runs\n"))
        self.assertEqual(self.ctl("reload", self.home / "none.so", status=ENVIRONMENT),
                         f"rungctl: there is no file {self.home}/none.so\n")
        junk = self.home / "junk.so"
        junk.write_text("not a program")
        self.assertIn("junk.so", self.ctl("reload", junk, status=WRONG))
        self.assertIn("running: ", self.ctl("status"))

    def test_a_fault_after_a_reload_puts_the_former_program_back(self):
        other = self.program_with("LD   X0.1", "LD   X0.4")
        self.ctl("reload", other)
        self.assertIn("program other,", self.ctl("status"))
        self.ctl("set", "X0.4", "1")
        self.wait(lambda: "stopped by a fault of other, which was running then: dead-loop (rung " in self.ctl("status"))
        self.assertIn("program stuck,", self.ctl("status"))
        self.wait(lambda: "the program other has stopped: dead-loop" in self.ctl("messages"))
        self.assertIn("; then stuck runs\n", self.ctl("messages"))
        self.assertIn("a fault of the program other has put the former program back already", self.ctl("rollback", status=WRONG))
        self.ctl("reset")
        self.wait(lambda: "\nrunning: " in self.ctl("status"))
        self.assertIn("program stuck,", self.ctl("status"))
        self.assertIn("a fault of the program other", self.ctl("rollback", status=WRONG))
        self.assertIn("program stuck,", self.ctl("status"))

    def test_a_program_that_faults_at_once(self):
        other = self.program_with("LD   X0.1", "LDI  X0.4")
        for _ in range(5):
            self.assertIn("the new program stopped at once with a fault, and the former one is back", self.ctl("reload", other, status=WRONG))
            self.ctl("reset")
            self.wait(lambda: "\nrunning: " in self.ctl("status"))

    def test_a_reload_of_a_program_that_the_operator_has_stopped(self):
        self.ctl("stop")
        self.assertTrue(self.ctl("reload", self.program).endswith("the new program is stopped\n"))
        self.assertTrue(self.ctl("rollback").endswith("the former program is stopped\n"))
        self.assertIn("the operator has stopped the program, so there is nothing to compare", self.ctl("reload", self.program, "--shadow", "3", status=WRONG))

    def shadowed(self):
        made, lines = self.connect()
        lines.readline()
        made.sendall(json.dumps({"do": "shadow", "program": str(self.program), "scans": 100000}).encode() + b"\n")
        self.assertTrue(json.loads(lines.readline())["ok"])

        def ask(**request):
            made.sendall(json.dumps(request).encode() + b"\n")
            return json.loads(lines.readline())

        return made, ask

    def test_a_shadow_is_its_clients(self):
        made, ask = self.shadowed()
        self.assertIn(ask(do="compared")["state"], ("prepared", "running"))
        self.assertIn("another client is running a shadow", self.ctl("reload", self.program, "--shadow", "3", status=WRONG))
        other, lines = self.connect()
        lines.readline()
        other.sendall(b'{"do":"compared"}\n')
        self.assertIn("there is no shadow", lines.readline())
        self.ctl("stop")
        self.assertEqual(ask(do="compared")["state"], "stopped")
        self.ctl("start")
        made, ask = self.shadowed()
        made.shutdown(socket.SHUT_RDWR)  # it ends with its client
        self.wait(lambda: subprocess.run([BIN / "rungctl", "reload", self.program, "--shadow", "3"], capture_output=True, timeout=patience(),
                                         env=self.environment, check=False).returncode == OK)

    def test_an_interrupt_ends_a_comparison(self):
        other = self.program_with("LD   X0.1", "LD   X0.4")
        reloads = subprocess.Popen([BIN / "rungctl", "reload", other, "--shadow", "100000", "--yes"], stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True, env=self.environment)
        self.wait(lambda: ": shadow " in self.logged())
        reloads.send_signal(signal.SIGINT)
        self.assertIn("interrupted; nothing has changed", reloads.communicate(timeout=patience())[1])
        self.assertEqual(reloads.returncode, WRONG)
        self.assertIn("program stuck,", self.ctl("status"))

    def test_a_reload_of_a_stopped_program_waits_for_a_reset(self):
        self.ctl("set", "X0.1", "1")
        self.wait(lambda: "stopped by a fault: dead-loop (rung " in self.ctl("status"))
        other = self.program_with("LD   X0.1", "LD   X0.4")
        self.assertTrue(self.ctl("reload", other, "--yes").endswith("the new program waits for a reset\n"))
        self.assertIn("program other, dialect gsk\nstopped by a fault of stuck, which was running then: dead-loop (rung 2, ", self.ctl("status"))
        self.assertTrue(self.ctl("rollback").endswith("the former program waits for a reset\n"))

    def test_a_reload_names_the_forces_that_it_ends(self):
        self.ctl("force", "X0.3", "1")
        self.ctl("force", "D8:2", "7")
        self.assertIn("2 forces ended: D8:2, X0.3\n", self.ctl("reload", self.program))
        self.assertIn("which ends the forces of D8:2, X0.3\n", self.logged())
        self.assertNotIn("ended", self.ctl("reload", self.program))

    def test_a_shadow_before_a_reload(self):
        other = self.program_with("LD   X0.0", "LDI  X0.0")
        text = self.ctl("reload", other, "--shadow", "25", status=WRONG)
        self.assertRegex(text, r"^shadow run finished: \d+ task runs compared, outputs that differ: 1\n")
        self.assertIn("Y0.0: false now, true in the new program\n", text)
        self.assertIn("nothing has changed", text)
        self.assertFalse(self.get("Y0.0"))
        text = self.ctl("reload", self.program, "--shadow", "25")
        self.assertRegex(text, r"^shadow run finished: \d+ task runs compared, no difference\n")
        self.assertTrue(text.endswith("the new program runs\n"))
        self.ctl("reload", other, "--shadow", "25", "--yes")
        self.wait(lambda: self.get("Y0.0"))
        self.ctl("reload", self.program, "--shadow", "0", status=USAGE)
        faulty = self.program_with("LD   X0.1", "LDI  X0.4")
        text = self.ctl("reload", faulty, "--shadow", "25", "--yes", status=WRONG)
        self.assertIn("the new program stopped with a fault during the comparison; nothing has changed", text)
        self.assertIn("running", self.ctl("status"))

    def test_a_compiled_program_beside_sources_is_refused(self):
        self.assertIn("expected one compiled program, or only sources", self.ctl("reload", self.program, "other.pmc", status=USAGE))

    def test_watch_shows_changes(self):
        watching = subprocess.Popen([BIN / "rungctl", "watch", "D8:2", "--json"], stdout=subprocess.PIPE, text=True,
                                    env=self.environment)
        self.addCleanup(watching.stdout.close)
        begun = json.loads(watching.stdout.readline())
        self.assertEqual(begun["names"][0]["type"], "i16")
        self.assertEqual(json.loads(watching.stdout.readline())["values"], [0])
        self.ctl("set", "D8:2", "5")
        self.assertEqual(json.loads(watching.stdout.readline())["values"], [5])
        watching.send_signal(signal.SIGINT)
        self.assertEqual(watching.wait(patience()), OK)

    def test_trace(self):
        out = self.home / "trace.vcd"
        tracing = self.trace(out, "X0.3", "D8:2")
        self.ctl("set", "X0.3", "1")
        self.ctl("set", "D8:2", "3")
        self.pass_by(2)
        tracing.send_signal(signal.SIGINT)
        self.assertEqual(tracing.wait(patience()), OK)
        text = out.read_text()
        for wanted in ("$var wire 1 ! X0.3 $end", '$var wire 16 " D8:2 $end', "\n0!\n", "\n1!\n", '\nb11 "\n'):
            self.assertIn(wanted, text)

    def test_a_trace_that_ends_by_itself(self):
        out = self.home / "short.vcd"
        self.assertEqual(self.trace(out, "X0.3", "--for", "0.5").wait(patience()), OK)
        self.assertIn("\n0!\n", out.read_text())

    def test_the_log_names_forces_that_end(self):
        self.ctl("force", "D8:2", "7")
        self.ctl("stop")
        self.assertIn("stop, which ends the forces of D8:2\n", self.logged())
        self.ctl("start")
        self.ctl("force", "X0.3", "1")
        self.ctl("set", "X0.1", "true")
        self.wait(lambda: "the forces of X0.3 have ended\n" in self.logged())
        self.assertIn("a fault has stopped the program: a reset restarts it", self.ctl("force", "X0.3", "1", status=WRONG))

    def test_a_set_without_effect_is_refused(self):
        self.assertIn("X0.0 is written before every slice by pin run: setting it has no effect, forcing it has (rungctl force X0.0 VALUE)\n",
                      self.ctl("set", "X0.0", "1", status=WRONG))
        self.ctl("force", "D8:2", "7")
        self.assertIn("D8:2 is forced to 7: it stays so", self.ctl("set", "D8:2", "9", status=WRONG))
        self.assertIn("D8 is forced as D8:2 to 7: it stays so", self.ctl("set", "D8", "9", status=WRONG))
        self.assertEqual(self.get("D8:2"), 7)
        self.assertIn("D6:4 has D8:2, which is forced to 7: it stays so", self.ctl("set", "D6:4", "9", status=WRONG))
        self.assertNotIn(": set ", self.logged())

    def test_values_after_a_fault_are_those_of_the_fault(self):
        self.ctl("set", "D8:2", "5")
        self.ctl("set", "X0.1", "true")
        self.wait(lambda: "stopped by a fault: dead-loop" in self.ctl("status"))
        self.assertEqual(self.ctl("get", "X0.1", "D8:2"), "X0.1 = true\nD8:2 = 5\n")
        made, lines = self.connect()
        lines.readline()
        made.sendall(b'{"do":"watch","names":["X0.1","D8:2"]}\n')
        self.assertEqual([json.loads(lines.readline()).get("values") for _ in range(2)], [None, [True, 5]])
        for words in (("force", "D8:2", "1"), ("stop",), ("start",)):
            self.assertIn("stopped", self.ctl(*words, status=WRONG))
        self.assertEqual(self.ctl("set", "D8:2", "9"),
                         "D8:2 = 9 (was 5)\na fault has stopped the program: only inputs that are set now survive the reset\n")

    def test_a_watched_name_that_is_gone(self):
        watching = subprocess.Popen([BIN / "rungctl", "watch", "GUARD", "Y0.0"], env=self.environment, text=True,
                                    stdout=subprocess.PIPE)
        self.addCleanup(watching.stdout.close)
        self.addCleanup(watching.wait)
        self.addCleanup(watching.kill)
        self.assertRegex(watching.stdout.readline(), r"^\d+\.\d{3} GUARD = false\n$")
        other = self.program_with("symbol GUARD X0.2\n", "")
        self.ctl("reload", other, "--yes")
        self.assertIn(" Y0.0 = false\n", watching.stdout.readline())
        self.assertRegex(watching.stdout.readline(), r"^\d+\.\d{3} GUARD is gone\n$")
        self.assertIn("GUARD is not a name of the program other", self.ctl("get", "GUARD", status=WRONG))
        self.ctl("rollback")
        self.assertRegex(watching.stdout.readline(), r"^\d+\.\d{3} GUARD = false\n$")
        self.ctl("reload", self.program_with("symbol GUARD X0.2\n", "symbol GUARD D8\n"), "--yes")  # a byte, for a client that waits for a bit
        self.assertRegex(watching.stdout.readline(), r"^\d+\.\d{3} GUARD is gone\n$")
        self.ctl("rollback")
        self.assertRegex(watching.stdout.readline(), r"^\d+\.\d{3} GUARD = false\n$")

    def test_a_trace_of_a_program_that_does_not_run_ends_too(self):
        self.ctl("set", "X0.1", "true")
        self.wait(lambda: "stopped by a fault" in self.ctl("status"))
        for time in ("nan", "0", "-1", "1e9"):
            self.assertIn("0.001", self.ctl("trace", "X0.3", "-o", self.home / "none.vcd", "--for", time, status=USAGE))
        self.assertIn(": 1 scan\n", self.ctl("trace", "X0.3", "-o", self.home / "none.vcd", "--for", "0.3"))

    def test_an_interrupted_trace_has_all_that_came_before(self):
        out = self.home / "late.vcd"
        tracing = self.trace(out, "X0.3")
        tracing.send_signal(signal.SIGSTOP)  # as on a machine that has other work
        self.ctl("set", "X0.3", "1")
        tracing.send_signal(signal.SIGINT)
        tracing.send_signal(signal.SIGCONT)
        self.assertEqual(tracing.wait(patience()), OK)
        self.assertIn("\n1!\n", out.read_text())

    def test_a_trace_that_is_ended_twice(self):
        out = self.home / "twice.vcd"
        tracing = self.trace(out, "X0.3")
        self.host.send_signal(signal.SIGSTOP)
        self.addCleanup(self.host.send_signal, signal.SIGCONT)
        self.assertTrue(wait_until(lambda: tracing.send_signal(signal.SIGINT) or tracing.poll() is not None))
        self.assertEqual(tracing.wait(patience()), OK)
        self.host.send_signal(signal.SIGCONT)
        self.assertRegex(out.read_text(), r"\n#\d+\n$")

    def test_a_trace_outlives_its_host(self):
        out = self.home / "outlived.vcd"
        tracing = self.trace(out, "X0.3")
        self.end()
        self.assertEqual(tracing.wait(patience()), WRONG)
        self.assertRegex(out.read_text(), r"\n#\d+\n$")
        self.start()
        self.wait(self.socket.exists)

    def test_sigrok_reads_a_trace(self):
        out = self.home / "sigrok.vcd"
        tracing = self.trace(out, "X0.3", "Y0.0", "D8:2")
        for value in (1, 0, 1):
            self.ctl("set", "X0.3", value)
            self.pass_by(2)
        tracing.send_signal(signal.SIGINT)
        self.assertEqual(tracing.wait(patience()), OK)
        done = subprocess.run(["sigrok-cli", "-I", "vcd:downsample=1000", "-i", out, "-O", "csv:header=false:label=off"],
                              capture_output=True, text=True, timeout=patience())
        self.assertEqual(done.returncode, OK, done.stderr)
        bits = [line.split(",") for line in done.stdout.splitlines() if re.match("[01],[01]", line)]  # it leaves numbers out
        changes = [now for before, now in zip([None, *bits], bits) if now != before]
        self.assertEqual(changes, [["0", "0"], ["1", "0"], ["0", "0"], ["1", "0"]], done.stdout[:500] + done.stderr)

    def test_map(self):
        self.assertEqual(self.ctl("map"), f"in    bit   run = false   X0.0 ({self.home}/plc.map:2)\nout   bit   lamp = false  Y0.0 ({self.home}/plc.map:4)\n")
        self.ctl("stop")
        self.ctl("set", "Y0.0", "1")
        self.ctl("start")
        def pins():
            return [(pin["name"], pin["uses"], pin["value"]) for pin in json.loads(self.ctl("map", "--json"))["pins"]]
        self.wait(lambda: pins() == [("run", ["X0.0"], False), ("lamp", ["Y0.0"], False)])  # after the next scan

    def test_messages_are_followed(self):
        self.ctl("set", "X0.1", "1")
        self.wait(lambda: "the program has stopped: dead-loop" in self.ctl("messages"))
        following = subprocess.Popen([BIN / "rungctl", "messages", "--follow"], stdout=subprocess.PIPE, text=True,
                                     env=self.environment)
        self.addCleanup(following.stdout.close)
        self.assertIn("the program has stopped: dead-loop", following.stdout.readline())  # what came before
        self.ctl("set", "X0.1", "0")
        self.ctl("reset")
        self.assertIn("the program has been restarted", following.stdout.readline())
        following.terminate()
        following.wait(patience())


class Profile(Host):
    build_options = ("--profile",)

    def rows(self, *words):
        answer = json.loads(self.ctl("profile", "--json", *words))
        return answer, {row["line"]: row for row in answer["rungs"]}

    def test_counts_and_times(self):
        self.wait(lambda: self.rows()[1].get(4, {"executions": 0})["executions"] > 5)
        answer, rows = self.rows()
        self.assertEqual(answer["ran"], len(answer["rungs"]))
        self.assertLessEqual(answer["ran"], answer["count"])
        self.assertEqual(rows[4]["file"], str(self.home / "stuck.pmc"))
        times = [row["time_ns"] for row in answer["rungs"]]
        self.assertEqual(times, sorted(times, reverse=True))
        self.assertNotIn(0, [row["rung"] for row in answer["rungs"]])  # what the compiler made is no rung for a reader
        self.assertGreater(answer["outside_ns"], 0)
        self.assertAlmostEqual(sum(times) + answer["outside_ns"], answer["time_ns"], delta=1)
        longest = [row["max_ns"] for row in self.rows("--by", "longest")[0]["rungs"]]
        self.assertEqual(longest, sorted(longest, reverse=True))
        self.assertEqual(len(self.rows("--top", "1")[0]["rungs"]), 1)
        text = self.ctl("profile", "--top", "1")
        self.assertRegex(text, r"^  rung  executions   share    mean ns     max ns  place\n +\d+ +\d+ ")
        self.assertRegex(text, r"\.\.\. and \d+ more\n"
                         r" +- +[0-9.]+% +outside of the rungs: clock of timers, starts and ends of modules\n\d+ of \d+ rungs have run\n$")

    def test_reset(self):
        def executions():
            return self.rows()[1].get(4, {"executions": 0})["executions"]

        self.wait(lambda: executions() > 200)
        before = self.scans()
        self.assertTrue(self.ctl("profile", "--reset").endswith("the counters start again from 0\n"))
        self.assertLessEqual(executions(), self.scans() - before)  # one a scan, and none of the 200
        self.assertIn(": clear the profile", self.logged())

    def test_wrong_words(self):
        self.ctl("profile", "--by", "name", status=USAGE)
        self.ctl("profile", "--top", "0", status=USAGE)


class HostWithReals(Host):
    """A double of NCT in two words: it has a name that everything takes."""
    program_text = "dialect nct\nmodule MAIN\nsymbol SPEED 7002\nrung\n|--[7100.00]--{+F SPEED SPEED *0.5}\n"
    source_name = "stuck.lad"
    map = """[in]
run = { type = "bit", name = "7100.01" }
limit = { type = "float", name = "REAL.7010" }
[rungctl]
permissions = ["set", "force"]
protected = ["REAL.7020"]
"""


class Reals(HostWithReals):
    def test_set_and_get(self):
        self.assertEqual(self.ctl("set", "REAL.7000", "2.5"), "REAL.7000 = 2.5 (was 0.0)\n")
        self.assertEqual(self.ctl("get", "7000", "7001", "REAL.7000"), f"7000 = 0\n7001 = {0x40040000}\nREAL.7000 = 2.5\n")
        self.assertEqual(self.ctl("set", "REAL.7000", "-0x10"), "REAL.7000 = -16.0 (was 2.5)\n")
        self.assertEqual(self.ctl("set", "REAL.7000", "1e300"), "REAL.7000 = 1e+300 (was -16.0)\n")
        self.assertEqual(self.ctl("set", "REAL.7000", "18446744073709551616"), "REAL.7000 = 1.8446744073709552e+19 (was 1e+300)\n")
        for wrong in ("1e999", "1e-999"):
            self.assertIn(f"no variable can hold {wrong}, given for REAL.7000", self.ctl("set", "REAL.7000", wrong, status=WRONG))
        for bits, seen in ((0x7FF80000, "nan"), (0x7FF00000, "inf"), (-0x100000, "-inf")):
            self.ctl("set", "7000", "0")
            self.ctl("set", "7001", str(bits))
            self.assertEqual(self.ctl("get", "REAL.7000"), f"REAL.7000 = {seen}\n")
        for wrong in ("nan", "x"):
            self.assertIn(f'found "{wrong}" for REAL.7000, expected a number', self.ctl("set", "REAL.7000", wrong, status=WRONG))
        self.assertIn("found 2.5 for 7000, expected an integer", self.ctl("set", "7000", "2.5", status=WRONG))
        for wrong in ("REAL.9999", "REAL.7100.00", "REAL."):
            self.assertIn(f"{wrong} is not a name of the program", self.ctl("get", wrong, status=WRONG))
        self.assertTrue(self.ctl("get", "REAL.SPEDE", status=WRONG).endswith("; did you mean REAL.SPEED?\n"))
        self.assertIn("7021 is protected by the mapping file", self.ctl("set", "7021", "1", status=WRONG))
        self.assertIn("setting it has no effect", self.ctl("set", "REAL.7010", "1", status=WRONG))

    def test_traces(self):
        out = self.home / "trace.vcd"
        tracing = self.trace(out, "REAL.SPEED", "SPEED")
        self.ctl("set", "REAL.SPEED", "1.5")
        self.pass_by(2)
        tracing.send_signal(signal.SIGINT)
        self.assertEqual(tracing.wait(patience()), OK)
        text = out.read_text()
        for wanted in ("$var real 64 ! REAL.SPEED $end", '$var wire 32 " SPEED $end', "\nr1.5 !\n"):
            self.assertIn(wanted, text)

    def test_watches(self):
        watching = subprocess.Popen([BIN / "rungctl", "watch", "REAL.SPEED"], stdout=subprocess.PIPE, text=True, env=self.environment)
        self.addCleanup(watching.stdout.close)
        self.assertRegex(watching.stdout.readline(), r"^[\d.]+ REAL\.SPEED = 0\.0\n$")
        self.ctl("set", "REAL.SPEED", "-2")
        self.assertRegex(watching.stdout.readline(), r"^[\d.]+ REAL\.SPEED = -2\.0\n$")
        watching.send_signal(signal.SIGINT)
        self.assertEqual(watching.wait(patience()), OK)


class ForcedReals(HostWithReals):
    def test_forces(self):
        self.ctl("force", "REAL.SPEED", "0.25")
        self.ctl("set", "7100.00", "1")
        self.pass_by(3)
        self.assertEqual(self.get("REAL.SPEED"), 0.25)
        self.assertRegex(self.ctl("forced"), r"^REAL\.SPEED = 0\.25, by ")
        self.ctl("unforce", "REAL.SPEED")
        self.wait(lambda: self.get("REAL.SPEED") > 1)


class Alarms(Host):
    """Messages that are bits of the program's memory."""
    program_text = PROGRAM.replace("OUT  Y0.0", "OUT  A0.2")

    def test_a_bit_that_comes_on_is_a_message(self):
        for count in (1, 2):
            self.ctl("force", "X0.0", "true")
            self.wait(lambda: self.ctl("messages").count("message 3") == count)
            self.ctl("unforce", "X0.0")
            self.wait(lambda: not self.get("A0.2"))
        self.assertEqual(self.ctl("messages").count("message"), 2)


class Pins(Host):
    """Cells whose bits are pins, one by one."""
    program_text = PROGRAM.replace("LD   X0.0\nOUT  Y0.0", "LD   X5.3\nOUT  Y5.1")
    map = """[in]
x5 = { type = "bit", name = "X5", bits = 6 }
level = { type = "float", name = "D16:4", scale = 10 }
[out]
y5 = { type = "bit", name = "Y5", bits = 2 }
[rungctl]
permissions = ["set"]
"""

    def test_the_pin_that_writes_a_bit_is_named(self):
        for name, by in (("X5.0", "pin x5-0"), ("X5.4", "pin x5-4"), ("X5", "pins x5-0 to x5-5"), ("X5.7", "pins x5-0 to x5-5")):
            self.assertIn(f"{name} is written before every slice by {by}: setting it has no effect", self.ctl("set", name, "1", status=WRONG))
        self.assertIn("\npart of X4:2 is written before every slice, so setting it has no effect there: X5 by pins x5-0 to x5-5\n", self.ctl("set", "X4:2", "1"))

    def test_the_map_shows_names_and_values(self):
        lines = [line[:line.index(" (")] for line in self.ctl("map").splitlines()]
        self.assertEqual(lines, [f"in    bit   x5-{bit} = false  bit {bit} of X5" for bit in range(6)] +
                         ["in    float level = 0.0   D16:4"] + [f"out   bit   y5-{bit} = false  bit {bit} of Y5" for bit in range(2)])


class FullDisk(Host):
    """What rungctl prints goes to a full disk: each command says so."""
    map = MAP.replace('permissions = [', 'permissions = ["serve", ') + '[recording]\nfolder = "recording"\n'
    build_options = ("--profile",)
    commands = {"hosts": [], "status": [], "messages": [], "get": ["X0.0"], "watch": ["X0.0"], "trace": ["X0.0", "-o", "{home}/full.vcd", "--for", "0.1"],
                "set": ["D8:2", "1"], "event": ["reset"], "force": ["D8:2", "1"], "unforce": ["--all"], "forced": [], "reload": ["{program}"],
                "rollback": [], "mark": ["here"], "recording": ["--keep"], "stop": [], "start": [], "reset": [], "map": [], "profile": [], "serve": [],
                "log": [], "top": ["--once"], "verify": ["{program}"], "web": [], "why": ["D8:2"], "completion": ["bash"], "help": []}

    def start(self):
        self.host = subprocess.Popen([BIN / "rung-run", self.program, self.home / "plc.map", "--name", "plc", "--simulate"],
                                     stderr=self.log, env=self.environment, start_new_session=True)

    def run_it(self, name, out):
        words = [word.format(home=self.home, program=self.program) for word in self.commands[name]]
        return subprocess.run(["timeout", "-s", "INT", "1", BIN / "rungctl", name, *words] if name == "watch" and out == subprocess.PIPE
                              else [BIN / "rungctl", name, *words],
                              stdin=subprocess.DEVNULL, stdout=out, stderr=subprocess.PIPE, text=True, timeout=patience(), env=self.environment)

    def test_every_command(self):
        self.ctl("set", "X0.1", "1")
        self.wait(lambda: "has stopped" in self.ctl("messages"))
        self.ctl("set", "X0.1", "0")
        self.assertEqual(sorted(re.findall(r"^  rungctl (\S+) ", self.ctl("help"), re.MULTILINE)), sorted(self.commands), "commands without a line in this test")
        for name in ("reset", *(name for name in self.commands if name != "reset")):
            with self.subTest(command=name), open("/dev/full", "w") as full:
                done = self.run_it(name, full)
                by = "rungc" if name in ("web", "why") else "rungctl"
                self.assertEqual((done.returncode, done.stderr), (ENVIRONMENT, f"{by}: cannot write to standard output\n"))
                if name not in ("reset", "stop", "start", "web"):  # which the program does once; web runs until Ctrl-C
                    self.assertNotEqual(self.run_it(name, subprocess.PIPE).stdout, "")


def blocks(path):
    """(kind, events) of the blocks of a segment, and the bytes after them: docs/recording.md."""
    data = path.read_bytes()
    if len(data) < 56:  # it has just been made
        return [], data
    magic, version, mode, program, number, run, since, zero, checksum = struct.unpack("<8sIIQQQqII", data[:56])
    assert (magic, version, zero, checksum) == (b"RUNGREC\n", 1, 0, zlib.crc32(data[:52])), path
    found, at, unpacker = [], 56, None
    while at + 32 <= len(data):
        magic, kind, size, raw, wall, zero, checksum = struct.unpack("<4sIIIqII", data[at:at + 32])
        packed = data[at + 32:at + 32 + size]
        if len(packed) < size or magic != b"RBLK" or zlib.crc32(packed, zlib.crc32(data[at:at + 28])) != checksum:
            break
        if kind == 1:
            unpacker = zlib.decompressobj(-15)
        events = unpacker.decompress(packed)
        assert len(events) == raw
        found.append((kind, events))
        at += 32 + size
    return found, data[at:]


class Recorded(Host):
    """What happens to the program, in files beside its retained memory."""

    def start(self):
        self.host = subprocess.Popen([BIN / "rung-run", self.program, self.home / "plc.map", "--name", "plc", "--retain", self.home / "kept"],
                                     stderr=self.log, env=self.environment, start_new_session=True)

    def setUp(self):
        shutil.rmtree(self.home / "kept.recording", ignore_errors=True)
        super().setUp()

    def segments(self):
        return sorted((self.home / "kept.recording").glob("*.rec"))

    def test_a_mark_is_in_files_that_are_kept(self):
        self.assertIn("marked", self.ctl("mark", "the door is open"))
        self.wait(lambda: any(b"the door is open" in events for path in self.segments() for _, events in blocks(path)[0]))
        self.assertIn("00000001.kept.rec", [path.name for path in self.segments()])
        answer = json.loads(self.ctl("recording", "--json"))
        self.assertEqual((answer["folder"], answer["losses"]), (str(self.home / "kept.recording"), 0))
        self.assertGreater(answer["written"], 0)
        self.assertGreaterEqual(answer["bytes"], answer["written"])
        self.assertNotIn("problem", answer)
        self.assertIn("mark the door is open", self.logged())
        self.assertIn("expected at most 400", self.ctl("mark", "x" * 401, status=WRONG))
        programs = list((self.home / "kept.recording").glob("*.program"))
        self.assertEqual([path.read_bytes() for path in programs], [self.program.read_bytes()])

    def test_a_killed_host_leaves_whole_blocks(self):
        self.wait(lambda: self.segments() and len(blocks(self.segments()[0])[0]) > 5)
        self.host.kill()
        self.host.wait(patience())
        found, _ = blocks(self.segments()[0])
        self.assertGreater(len(found), 5)
        self.assertEqual(found[0][0], 1)
        self.assertNotEqual(found[-1][0], 3)
        self.socket.unlink()
        self.start()  # and the next host continues in another file
        self.wait(lambda: len(self.segments()) == 2)
        self.end()
        self.assertEqual(blocks(self.segments()[1])[0][-1][0], 3)
        self.start()
        self.wait(lambda: self.socket.exists())

    def test_a_fault_is_kept(self):
        self.ctl("set", "X0.1", "1")
        self.wait(lambda: "has stopped" in self.ctl("messages"))
        self.wait(lambda: "00000001.kept.rec" in [path.name for path in self.segments()])
        self.ctl("set", "X0.1", "0")
        self.ctl("reset")


class NotRecorded(Host):
    """Without retained memory the map says where."""

    def test_nothing(self):
        self.assertIn('[recording] folder = "PATH"', self.ctl("recording", status=WRONG))
        self.assertIn('[recording] folder = "PATH"', self.ctl("mark", "a", status=WRONG))


class History(Host):
    """Messages that came and went, over starts of the host."""
    program_text = PROGRAM.replace("OUT  Y0.0", "OUT  A0.2\nLD   X0.4\nOUT  A0.3")

    def setUp(self):
        for path in self.home.glob("kept.*"):
            if path.is_file():
                path.unlink()
        super().setUp()

    def start(self):
        self.host = subprocess.Popen([BIN / "rung-run", self.program, self.home / "plc.map", "--name", "plc", "--retain", self.home / "kept"],
                                     stderr=self.log, env=self.environment, start_new_session=True)

    def begin_again(self):
        listened = self.logged().count("listening at")
        self.start()
        self.wait(lambda: self.logged().count("listening at") > listened)

    def entries(self, *words):
        return json.loads(self.ctl("messages", "--json", *words))["entries"]

    def show(self, name, on):
        self.ctl("set", name, on)
        self.pass_by(2)

    def test_came_and_went(self):
        self.show("X0.4", 1)
        self.wait(lambda: self.entries())
        self.assertRegex(self.ctl("messages"), r"^\d{4}-\d\d-\d\d \d\d:\d\d:\d\d - on now    message 4\n$")
        self.show("X0.4", 0)
        self.wait(lambda: not self.entries()[0]["on"])
        entry = self.entries()[0]
        self.assertEqual((entry["text"], entry["kind"]), ("message 4", "message"))
        self.assertLessEqual(entry["came"], entry["went"])
        self.assertRegex(self.ctl("messages"), r"^\d{4}-\d\d-\d\d \d\d:\d\d:\d\d - (\S+ )?\d\d:\d\d:\d\d  message 4\n$")
        self.assertEqual(self.ctl("messages", "--on"), "")
        self.show("X0.4", 1)
        self.wait(lambda: self.ctl("messages", "--on").endswith(" - on now    message 4\n"))
        self.ctl("set", "X0.1", 1)
        self.wait(lambda: "has stopped" in self.ctl("messages"))
        self.assertEqual(self.ctl("messages", "--on").count("\n"), 1)
        self.ctl("set", "X0.1", 0)
        self.ctl("set", "X0.4", 0)
        self.ctl("reset")
        self.wait(lambda: self.ctl("messages", "--on") == "")

    def test_followers_hear_of_the_end_by_a_reset(self):
        self.show("X0.4", 1)
        self.wait(lambda: self.entries())
        following = self.follow()
        self.assertRegex(following.stdout.readline(), " - on now    message 4\n$")
        self.ctl("set", "X0.1", 1)
        self.read_until(following, "until rungctl reset")
        self.assertTrue(self.entries()[0]["on"])  # a fault ends no message
        for name in ("X0.1", "X0.4"):
            self.ctl("set", name, 0)
        self.ctl("reset")
        self.assertEqual(self.read_until(following, "the program has been restarted"), ["message 4 has gone", "the program has been restarted"])
        self.assertIn("went", self.entries()[0])

    def test_followers_hear_of_the_end_by_a_reload(self):
        """No rung of the new program could end it."""
        self.show("X0.4", 1)
        self.wait(lambda: self.entries())
        following = self.follow()
        self.assertRegex(following.stdout.readline(), " - on now    message 4\n$")
        self.ctl("reload", self.program_with("LD   X0.4\nOUT  A0.3\n", ""), "--yes")
        self.read_until(following, "message 4 has gone")
        self.assertIn("went", self.entries()[0])
        self.ctl("rollback")
        self.assertRegex(following.stdout.readline(), "message 4\n$")
        self.wait(lambda: [entry["on"] for entry in self.entries() if entry["kind"] == "message"] == [False, True])

    def test_followers_hear_of_both(self):
        following = self.follow()
        for on in range(50):  # until it follows
            self.show("X0.4", on % 2)
        lines = [following.stdout.readline() for _ in range(2)]
        self.assertRegex(lines[0] + lines[1], r"message 4( has gone)?\n.*message 4( has gone)?\n")
        self.assertEqual(sum("has gone" in line for line in lines), 1)

    def test_a_regular_end_and_another_start(self):
        self.show("X0.4", 1)
        self.wait(lambda: self.entries())
        self.end()
        self.begin_again()
        self.assertEqual(self.entries(), [])
        entry, = self.entries("--history")
        self.assertEqual((entry["text"], entry["on"], entry["cut"]), ("message 4", False, True))
        self.assertLessEqual(entry["came"], entry["went"])
        self.assertIn("  message 4, still on when the host ended\n", self.ctl("messages", "--history"))

    def test_a_host_that_is_killed(self):
        self.show("X0.4", 1)
        path = self.home / "kept.log"
        self.wait(lambda: path.exists() and b"message 4" in path.read_bytes())
        self.host.kill()
        self.host.wait()
        with open(path, "ab") as out:
            out.write(b'{"n":9,"came":17')  # as when the power fails within a line
        self.begin_again()
        self.show("X0.4", 1)
        self.wait(lambda: self.entries())
        self.assertRegex(self.ctl("messages", "--history"), r"^\S+ \S+ - \?         message 4, still on when the host ended\n"
                                                            r"\S+ \S+ - on now    message 4\n$")

    def test_a_place_that_cannot_be_written(self):
        path = self.home / "kept.log"
        self.end()
        path.unlink(missing_ok=True)
        path.mkdir()
        self.begin_again()
        self.show("X0.4", 1)
        self.wait(lambda: "the log is not kept on disk: cannot read" in self.ctl("messages"))
        self.assertIn("message 4\n", self.ctl("messages"))
        self.assertIn("\nrunning: ", self.ctl("status"))
        self.end()
        path.rmdir()
        self.begin_again()


class Fanuc(Host):
    """Programs of FANUC: texts of messages, types of the PMC, names in either case."""
    source_name = "stuck.mne"
    program_text = """%@0
4 0i-F PMC(MEM-B,FLT)
%
%@2
X0.0 Start
Y0.0 Lamp
%
%@3
SUB 1
RD START
WRT LAMP
RD X0.3
WRT A0.0
SUB 69
L1
RD X0.1
SUB 68
L1
RD R9091.1
SUB 41
1
SUB 2
SUB 64
%
%@4
A0.0 1001 FORMER TEXT
%
"""
    map = MAP.replace("X0.0", "X0.4").replace('"Y0.0"', '"Y0.1"')

    def on(self):
        return [line.split("  ")[-1].strip() for line in self.ctl("messages", "--on").splitlines()]

    def show(self):
        self.ctl("set", "X0.3", 1)
        self.wait(lambda: self.on() == ["message EX1001 FORMER TEXT"])

    def test_a_reload_with_another_message(self):
        self.show()
        following = self.follow()
        following.stdout.readline()
        self.ctl("reload", self.program_with("1001 FORMER TEXT", "2002 NEW TEXT"))
        self.assertEqual(self.read_until(following, "2002 NEW TEXT"), ["message EX1001 FORMER TEXT has gone", "message 2002 NEW TEXT"])
        self.assertEqual(self.on(), ["message 2002 NEW TEXT"])
        self.ctl("rollback")
        self.read_until(following, "EX1001 FORMER TEXT")
        self.assertEqual(self.on(), ["message EX1001 FORMER TEXT"])
        self.ctl("reload", self.program_with("FORMER TEXT", "CORRECTED TEXT"))
        self.wait(lambda: self.on() == ["message EX1001 CORRECTED TEXT"])
        self.ctl("set", "X0.3", 0)
        self.wait(lambda: not self.on())

    def test_a_reload_without_the_text(self):
        self.show()
        self.ctl("reload", self.program_with("A0.0 1001 FORMER TEXT\n", ""))
        self.wait(lambda: not self.on())

    def test_a_new_program_that_faults_at_once_changes_no_message(self):
        self.show()
        faulty = self.program_with("RD X0.1", "RD R9091.1")
        faulty = self.home / "other.mne"
        faulty.write_text(faulty.read_text().replace("1001 FORMER TEXT", "2002 NEW TEXT"))
        subprocess.run([BIN / "rungc", "build", "-q", faulty, "-o", self.home / "other.so"], check=True)
        self.assertIn("the former one is back", self.ctl("reload", self.home / "other.so", status=WRONG))
        self.assertIn("message EX1001 FORMER TEXT", self.on())
        self.ctl("reset")
        self.show()
        self.assertNotIn("NEW TEXT", self.ctl("messages"))

    def test_a_reload_while_a_fault_has_stopped_the_program(self):
        self.show()
        self.ctl("set", "X0.1", 1)
        self.wait(lambda: "stopped by a fault" in self.ctl("status"))
        self.ctl("reload", self.program_with("1001 FORMER TEXT", "2002 NEW TEXT"))
        self.ctl("reload", self.program_with("1001 FORMER TEXT", "2003 LAST TEXT"))
        self.ctl("set", "X0.1", 0)
        self.ctl("reset")
        self.wait(lambda: self.on() == ["message 2003 LAST TEXT"])

    def test_a_smaller_type(self):
        self.ctl("set", "D8:2", 7)
        smaller = self.program_with("0i-F PMC(MEM-B,FLT)", "PMC-SA1")
        said = self.ctl("reload", smaller, status=WRONG)
        self.assertIn("the new program loses state: ", said)
        for area in ("C80 to C5199", "D1860 to D9999", "K20 to K999", "T80 to T9499"):
            self.assertIn(f"removed {area}\n", said)
            self.assertIn(area, said.splitlines()[-1])
        self.assertIn("; nothing has changed; use --yes to do it anyway", said)
        self.assertIn("program stuck,", self.ctl("status"))
        self.ctl("reload", smaller, "--yes")
        self.assertEqual(self.get("D8:2"), 7)
        self.ctl("reload", self.program)

    def test_names_of_forces(self):
        self.ctl("force", "START", 1)
        self.wait(lambda: self.get("Y0.0"))
        self.assertEqual(self.ctl("force", "x0.0", 0), "x0.0 is forced to false\n")
        self.wait(lambda: not self.get("Y0.0"))
        self.assertEqual(self.ctl("forced").count("\n"), 1)
        self.assertEqual(self.ctl("unforce", "start"), "x0.0 is no longer forced\n")
        self.assertIn("START is not forced", self.ctl("unforce", "START", status=WRONG))


class Rights(Host):
    map = MAP[:MAP.index("[rungctl]")]

    def test_without_a_word_in_the_map_nothing_is_changed(self):
        for words, right in ((["set", "D8:2", "1"], "set"), (["force", "D8:2", "1"], "force"), (["unforce", "D8:2"], "force"),
                             (["stop"], "stop"), (["start"], "start"), (["reset"], "reset"), (["rollback"], "reload"),
                             (["reload", self.program], "reload")):
            self.assertIn(f'"{right}" is not allowed here; for it the mapping file needs [rungctl] permissions = ["{right}"]',
                          self.ctl(*words, status=WRONG))
        self.ctl("status")
        self.assertIn("build it with rungc build --profile", self.ctl("profile", status=WRONG))
        self.assertEqual(self.ctl("get", "D8:2"), "D8:2 = 0\n")
        self.ctl("map")
        self.ctl("messages")
        self.assertIn('"acknowledge" is not allowed here', self.ctl("messages", "--acknowledge", status=WRONG))
        self.assertIn("started with the program stuck", self.ctl("log"))
        self.ctl("verify", self.program)
        self.ctl("top", "--once")
        self.ctl("forced")
        made, lines = self.connect()
        lines.readline()
        made.sendall(b'{"do":"clear-profile"}\n')
        self.assertIn('"profile" is not allowed here', json.loads(lines.readline())["error"])


class Protected(Host):
    map = MAP.replace('protected = ["X0.2"]', 'protected = ["GUARD"]')

    def test_a_name_is_protected_where_a_reload_has_moved_it(self):
        moved = self.home / "moved.pmc"
        moved.write_text(PROGRAM.replace("symbol GUARD X0.2", "symbol GUARD X0.4"))
        subprocess.run([BIN / "rungc", "build", "-q", moved, "-o", self.home / "moved.so"], check=True)
        self.assertIn("X0.2 is protected by the mapping file", self.ctl("set", "X0.2", "1", status=WRONG))
        self.ctl("set", "X0.4", "0")
        self.ctl("reload", self.home / "moved.so", "--yes")
        for words in (("set", "X0.4", "1"), ("force", "X0.4", "1"), ("set", "GUARD", "1")):
            self.assertIn("is protected by the mapping file", self.ctl(*words, status=WRONG))
        self.ctl("set", "X0.2", "0")


class Named(Host):
    """A reload looks at the mapping file as loading does."""
    program_text = PROGRAM.replace("symbol GUARD X0.2", "symbol GUARD X0.2\nsymbol GO X0.0\nsymbol LAMP Y0.0")
    map = MAP.replace('"X0.0"', '"GO"').replace('"Y0.0"', '"LAMP"').replace('"X0.2"', '"GUARD"')

    def test_what_does_not_fit_is_refused(self):
        for before, after, text in (
                ("symbol GO X0.0", "symbol RUN X0.0", "plc.map:2:30: in.run.name: found an unknown name GO"),
                ("symbol LAMP Y0.0", "symbol LIGHT Y0.0", "plc.map:4:31: out.lamp.name: found an unknown name LAMP"),
                ("symbol GUARD X0.2\n", "", "plc.map:7:14: rungctl.protected: found an unknown name GUARD"),
                ("symbol GO X0.0", "symbol GO Y0.5", "in.run.name: found GO, an output of the program")):
            with self.subTest(after=after):
                answer = self.ctl("reload", self.program_with(before, after), "--yes", status=WRONG)
                self.assertRegex(answer, r"^rungctl: the mapping file does not fit the new program; nothing has changed:\n(\S+plc.map:\d+:\d+: .*\n)+$")
                self.assertIn(text, answer)
                self.assertIn("program stuck,", self.ctl("status"))

    def test_an_output_that_no_rung_writes_any_more(self):
        without = self.program_with("OUT  Y0.0", "OUT  R0.0")
        said = self.ctl("reload", without, status=WRONG)
        self.assertIn("released LAMP: no rung writes it any more, it becomes 0\n", said)
        self.assertIn("rungctl: no rung of the new program writes LAMP any more: it becomes 0; nothing has changed; use --yes", said)

    def test_a_pin_whose_cell_moves(self):
        moved = self.program_with("symbol GO X0.0", "symbol GO X0.5")
        self.assertIn("pins lose or change their variables: pin run: GO moves from X0.0 to X0.5; nothing has changed; "
                      "use --yes to do it anyway", self.ctl("reload", moved, status=WRONG))
        self.assertIn("program stuck,", self.ctl("status"))
        self.assertIn("pin run: GO moves from X0.0 to X0.5\n", self.ctl("reload", moved, "--yes"))
        self.assertIn("X0.5 is written before every slice by pin run", self.ctl("set", "X0.5", "1", status=WRONG))
        self.assertEqual(self.get("X0.0"), False)
        self.ctl("set", "X0.0", "1")
        self.assertEqual(self.get("X0.0"), True)
        self.assertIn("pin run: GO moves from X0.5 to X0.0\n", self.ctl("rollback"))


class OfAnotherMachine(Host):
    names = [f"KEY{number}" for number in range(12)]
    program_text = PROGRAM.replace("FUNC END1", "".join(f"symbol {name} X1{at // 8}.{at % 8}\n" for at, name in enumerate(names)) + "FUNC END1")
    map = MAP.replace("[out]", "".join(f'{name.lower()} = {{ type = "bit", name = "{name}" }}\n' for name in names) + "[out]")

    def test_a_few_of_its_mistakes_are_enough(self):
        lines = self.ctl("reload", self.program_with("symbol KEY", "symbol LAMP"), "--yes", status=WRONG).splitlines()
        self.assertEqual(lines[0], "rungctl: the mapping file does not fit the new program; nothing has changed:")
        self.assertEqual(len(lines), 12)
        self.assertIn("found an unknown name KEY9", lines[10])
        self.assertEqual(lines[11], "and 2 more; is this the right program?")


class WayBack(Host):
    """What the program that runs does not have starts with its initial contents when the former one is back."""
    source_name = "stuck.plc"
    program_text = """DATA
INB: DFM GO,STOPP,,,,,,
OUTM: DFM MOTOR,,,,,,,
DATA_END
MODULE_INPUT
MODULE_INPUT_END
MODULE_MAIN
LDR GO
FL1 1,MOTOR
LDR STOPP
FL1 0,MOTOR
MODULE_MAIN_END
MODULE_BLOCK_INIT
MODULE_BLOCK_INIT_END
MODULE_BLOCK_DONE
MODULE_BLOCK_DONE_END
MODULE_INIT
MODULE_INIT_END
MODULE_CLEAR
MODULE_CLEAR_END
MODULE_HALT
MODULE_HALT_END
STOP
"""
    map = '[rungctl]\npermissions = ["set", "reload"]\n'

    def test_a_latch_that_was_left_on(self):
        other = self.home / "other.plc"
        other.write_text(self.program_text.replace("DFM MOTOR", "DFM LAMP").replace("FL1 1,MOTOR", "WR LAMP").replace("FL1 0,MOTOR", ""))
        subprocess.run([BIN / "rungc", "build", "-q", other, "-o", self.home / "other.so"], check=True)
        self.ctl("set", "GO", "1")
        self.wait(lambda: self.get("MOTOR"))
        self.ctl("set", "GO", "0")
        self.assertIn("removed MOTOR", self.ctl("reload", self.home / "other.so", "--yes"))
        self.ctl("set", "STOPP", "1")
        self.pass_by(2)
        self.ctl("set", "STOPP", "0")
        self.assertIn("removed LAMP\n", self.ctl("rollback"))
        self.assertFalse(self.get("MOTOR"))


class Ends(Host):
    """The regular end of a host, whatever ends it, and what a service manager hears."""

    def start(self):
        self.heard = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
        self.addCleanup(self.heard.close)
        self.heard.settimeout(patience())
        self.heard.bind("\0" + str(self.home / "notify"))
        self.environment |= {"NOTIFY_SOCKET": "@" + str(self.home / "notify"), "WATCHDOG_USEC": "200000"}
        self.host = subprocess.Popen([BIN / "rung-run", self.program, self.home / "plc.map", "--name", "plc",
                                      "--retain", self.home / "kept"],
                                     stderr=self.log, env=self.environment, start_new_session=True)

    def end(self):
        self.host.kill()
        self.host.wait(patience())

    def test_a_terminal_that_is_closed(self):
        self.host.send_signal(signal.SIGHUP)
        self.assertEqual(self.host.wait(patience()), OK)
        self.assertTrue((self.home / "kept.a").exists() or (self.home / "kept.b").exists())
        self.assertIn("steps, ", self.logged())

    def test_a_service_manager_hears_of_it(self):
        self.assertIn(b"READY=1", self.heard.recv(200))
        self.assertEqual({self.heard.recv(200) for _ in range(3)}, {b"WATCHDOG=1"})
        self.host.terminate()
        while b"STOPPING=1" not in self.heard.recv(200):
            pass
        self.assertEqual(self.host.wait(patience()), OK)


class WithoutStandardFiles(Host):
    """What is opened does not take the place of a closed standard file, whatever is printed then."""

    def start(self):
        self.host = subprocess.Popen(["sh", "-c", 'exec "$0" "$@" <&- >&- 2>&-', BIN / "rung-run", self.program, self.home / "plc.map", "--name", "plc"],
                                     env=self.environment, start_new_session=True)

    def setUp(self):
        self.environment = {**os.environ, "RUNG_SOCKETS": str(self.home / "sockets")}
        (self.home / "plc.map").write_text(self.map)
        self.start()
        self.addCleanup(self.end)
        self.socket = self.home / "sockets/plc.sock"
        self.assertTrue(wait_until(self.socket.exists))

    def test_they_are_nothing(self):
        self.assertEqual({os.readlink(f"/proc/{self.host.pid}/fd/{file}") for file in range(3)}, {"/dev/null"})
        self.ctl("set", "D8:2", "5")
        self.assertEqual(self.get("D8:2"), 5)


class SmallFiles(Host):
    """Files have a limit: what goes beyond it is an error of that file."""

    def start(self):
        self.host = subprocess.Popen([BIN / "rung-run", self.program, self.home / "plc.map", "--name", "plc", "--retain", self.home / "kept"],
                                     stderr=self.log, env=self.environment, start_new_session=True)

    def end(self):
        self.host.terminate()
        self.assertEqual(self.host.wait(patience()), ENVIRONMENT)  # retained memory is not on disk
        self.assertFalse(self.socket.exists())

    def test_it_runs_on_and_ends(self):
        resource.prlimit(self.host.pid, resource.RLIMIT_FSIZE, (100, 100))
        self.ctl("set", "D8:2", "7")
        self.wait(lambda: "retained memory is not written: " in self.ctl("messages"))
        for number in range(100):
            self.ctl("set", "D8:2", number)
        self.assertEqual(self.get("D8:2"), 99)
        self.assertIn("running: ", self.ctl("status"))


class NobodyReads(Host):
    """What rung-run prints goes to a pipe whose reader has gone."""

    def start(self):
        reads, writes = os.pipe()
        self.host = subprocess.Popen([BIN / "rung-run", self.program, self.home / "plc.map", "--name", "plc"],
                                     stderr=writes, env=self.environment, start_new_session=True)
        os.close(writes)
        self.addCleanup(os.close, reads)
        self.addCleanup(self.host.wait)
        self.addCleanup(self.host.kill)
        self.reads = reads

    def setUp(self):
        self.environment = {**os.environ, "RUNG_SOCKETS": str(self.home / "sockets")}
        (self.home / "plc.map").write_text(self.map)
        self.start()
        self.socket = self.home / "sockets/plc.sock"
        self.assertTrue(wait_until(self.socket.exists))

    def test_it_runs_on_and_ends(self):
        os.read(self.reads, 1)
        os.dup2(os.open("/dev/null", os.O_RDONLY), self.reads)
        self.assertTrue(wait_until(lambda: self.scans() > 0))
        self.ctl("set", "X0.1", "true") # a line of its log; then the fault has another
        self.assertTrue(wait_until(lambda: "stopped by a fault" in self.ctl("status")))
        self.host.terminate()
        self.assertEqual(self.host.wait(patience()), OK)


class Protocol(Host):
    def ask(self, connection, text):
        made, lines = connection
        made.sendall(text.encode() + b"\n")
        return json.loads(lines.readline())

    def test_the_greeting(self):
        _, lines = self.connect()
        self.assertEqual(json.loads(lines.readline()),
                         {"rung": "host", "protocol": 1, "host": "plc", "program": "stuck", "dialect": "gsk"})

    def test_wrong_requests_are_answered(self):
        connection = self.connect()
        connection[1].readline()
        for text, error in (("{", "found a line that is not JSON, expected an object"),
                            ("5", "found number, expected an object"),
                            ("{}", 'found no text "do" in the request, expected one'),
                            ('{"do":5}', 'found no text "do" in the request, expected one'),
                            ('{"do":"dance"}', 'found "dance", expected a command of this protocol'),
                            ('{"do":"get"}', 'found no list "names" of 1 to 256 texts in the request, expected one'),
                            ('{"do":"get","names":[]}', 'found no list "names" of 1 to 256 texts in the request, expected one'),
                            ('{"do":"set","name":"D8:2"}', 'found no "value" in the request, expected one'),
                            ('{"do":"messages","follow":1}', 'found no true or false for "follow", expected one of them'),
                            ('{"do":"reload","program":"x.so"}', "found the path x.so, expected an absolute one"),
                            ('{"do":"profile","top":0}', 'found 0 for "top", expected a number from 1 to 10000'),
                            ('{"do":"profile","by":5}', 'found 5 for "by", expected "time" or "longest"'),
                            ('{"do":"rungs","first":-1}', 'found -1 for "first", expected a number up to 5'),
                            ('{"do":"rungs","first":6}', 'found 6 for "first", expected a number up to 5'),
                            ('{"do":"log","follow":"yes"}', 'found no true or false for "follow", expected one of them')):
            answer = self.ask(connection, text)
            self.assertEqual((answer["ok"], answer["error"]), (False, error), text)
        answer = self.ask(connection, '{"do":"status","id":[1,"a"]}')
        self.assertEqual((answer["ok"], answer["id"]), (True, [1, "a"]))
        self.assertTrue(self.ask(connection, "[" * 30000)["error"])

    def test_a_name_has_no_control_characters(self):
        connection = self.connect()
        connection[1].readline()
        for name in ("D8:2\0x", "D8:2\n", "D8:2\x1b[2J", "D8:2\x7f"):
            for request in ({"do": "set", "name": name, "value": 1}, {"do": "force", "name": name, "value": 1},
                            {"do": "get", "names": [name]}, {"do": "reload", "program": "/" + name}):
                answer = self.ask(connection, json.dumps(request))
                self.assertFalse(answer["ok"])
                self.assertIn("found a control character in ", answer["error"])
        self.assertEqual(self.get("D8:2"), 0)
        self.assertNotIn("\x1b", self.logged())

    def test_mutated_requests_do_no_harm(self):
        """From a seed: bytes and words of good requests in other places."""
        chance = random.Random(4711)
        good = ['{"do":"status","id":1}', '{"do":"get","names":["X0.0","D8:2"]}', '{"do":"watch","names":["D8:2"],"all":false}',
                '{"do":"set","name":"D8:2","value":-5}', '{"do":"force","name":"X0.3","value":true}', '{"do":"forced"}',
                '{"do":"unforce","all":true}', '{"do":"reload","program":"/dev/zero","yes":true}', '{"do":"messages"}',
                '{"do":"map"}', '{"do":"profile","top":5,"by":"longest"}', '{"do":"clear-profile"}', '{"do":"compile"}', '{"do":"compiled"}',
                '{"do":"sources","first":true,"piece":"cnVuZw=="}', '{"do":"reload","compiled":true}', '{"do":"shadow","program":"/x","scans":5}', '{"do":"compared"}',
                '{"do":"log","follow":true}', '{"do":"program"}', '{"do":"rungs","first":2}', '{"do":"acknowledge"}',
                '{"do":"set","name":"X0.3","value":1e400}', '{"do":"set","name":"D8:2","value":18446744073709551615}']
        words = sorted({word for line in good for word in re.findall(r'"[^"]*"|-?\d+|true|false|[{}:,\[\]]', line)} | {"null", "1.5", '""'})
        made, lines = self.connect()
        lines.readline()
        answers = 0
        for _ in range(400):
            line = chance.choice(good)
            if chance.randrange(2):  # a value of another kind, or none
                request = json.loads(line)
                request[chance.choice(list(request))] = chance.choice([None, 0, -1, 2**70, 1.5, "", "D8:2", "X0.3", True, [], ["X0.0"], {}])
                line = json.dumps(request)
            for _ in range(chance.randrange(0, 3)):
                at = chance.randrange(len(line) + 1)
                kind = chance.randrange(3)
                if kind == 0:
                    line = line[:at] + chance.choice(words) + line[at + chance.randrange(8):]
                elif kind == 1:
                    line = line[:at] + chr(chance.randrange(32, 0x2000)) + line[at + 1:]
                else:
                    line = line[:at] + line[at + chance.randrange(1, 6):]
            made.sendall(line.encode("utf-8", "replace").replace(b"\n", b" ") + b"\n")
            while "event" in (answer := json.loads(lines.readline())):
                pass
            self.assertIn("ok", answer, line)
            self.assertEqual("error" in answer, not answer["ok"], line)
            answers += answer["ok"]
        self.assertGreater(answers, 20)
        self.ctl("unforce", "--all")
        self.assertIn("running: ", self.ctl("status"))

    def test_a_line_that_is_too_long_ends_the_connection(self):
        made, lines = self.connect()
        lines.readline()
        with self.assertRaises((OSError, EOFError)):
            made.sendall(b"x" * 200000)
            if lines.readline() == "":
                raise EOFError
        self.ctl("status")

    def test_many_requests_at_once(self):
        made, lines = self.connect()
        lines.readline()
        made.sendall(b"".join(b'{"do":"map","id":%d}\n' % i for i in range(200)))
        self.assertEqual([json.loads(lines.readline())["id"] for _ in range(200)], list(range(200)))

    def test_only_so_many_are_served(self):
        connections = [self.connect() for _ in range(16)]
        for _, lines in connections:
            self.assertIn("protocol", json.loads(lines.readline()))
        _, lines = self.connect()
        self.assertIn("the host serves 16 others already", json.loads(lines.readline())["error"])
        connections[0][0].close()
        connections[0][1].close()
        self.wait(lambda: "protocol" in json.loads(self.connect()[1].readline()))

    def test_one_who_does_not_read_does_not_hold_up_the_others(self):
        made, lines = self.connect()
        lines.readline()
        made.sendall(b'{"do":"watch","names":["D8:2"],"all":true}\n' + b'{"do":"map"}\n' * 2000)
        for _ in range(20):
            self.ctl("status")

    def test_the_place_is_the_users_alone(self):
        self.assertEqual((self.home / "sockets").stat().st_mode & 0o777, 0o700)
        self.assertEqual(self.socket.stat().st_mode & 0o777, 0o600)

    def test_another_user_is_refused(self):
        if os.geteuid() != 0:
            self.skipTest("needs root, to be another user")
        (self.home / "sockets").chmod(0o755)
        self.addCleanup((self.home / "sockets").chmod, 0o700)
        self.socket.chmod(0o666)
        self.home.chmod(0o755)
        code = f"import socket; s = socket.socket(socket.AF_UNIX); s.connect({str(self.socket)!r}); print(s.makefile().readline())"
        done = subprocess.run(["python3", "-c", code], user=65534, group=65534, extra_groups=[], capture_output=True, text=True)
        self.assertIn("only the user who has started the host, and root, may use it", done.stdout, done.stderr)

    def test_a_second_host_of_the_name(self):
        done = subprocess.run([BIN / "rung-run", self.program, self.home / "plc.map", "--name", "plc"], capture_output=True,
                              text=True, env=self.environment, timeout=patience())
        self.assertEqual(done.returncode, ENVIRONMENT)
        self.assertIn("plc.sock: another host is called plc; choose another name", done.stderr)
        self.ctl("status")


class WithoutAHost(unittest.TestCase):
    def run_ctl(self, folder, *words):
        return subprocess.run([BIN / "rungctl", *words], capture_output=True, text=True,
                              env={**os.environ, "RUNG_SOCKETS": str(folder)}, timeout=patience())

    def test_no_host(self):
        with tempfile.TemporaryDirectory() as folder:
            done = self.run_ctl(folder, "status")
            self.assertEqual((done.returncode, done.stderr), (WRONG, f"rungctl: no host is running: no socket is in {folder}\n"))
            done = self.run_ctl(folder, "status", "--host", "mill")
            self.assertIn(f"cannot reach a host at {folder}/mill.sock: No such file or directory", done.stderr)
            self.assertEqual(self.run_ctl(folder, "hosts").stdout, "no host is running\n")
            self.assertEqual(self.run_ctl(folder, "dance").returncode, USAGE)

    def test_a_host_that_was_killed_leaves_its_place(self):
        with tempfile.TemporaryDirectory() as folder:
            home = Path(folder)
            program = build(home)
            (home / "m.map").write_text("")
            environment = {**os.environ, "RUNG_SOCKETS": str(home / "sockets")}
            for _ in range(2):
                host = subprocess.Popen([BIN / "rung-run", program, home / "m.map"], env=environment,
                                        stderr=subprocess.PIPE, text=True)
                self.assertIn("listening at", host.stderr.readline())
                self.assertEqual(self.run_ctl(home / "sockets", "hosts").stdout, "rung\n")
                host.kill()
                host.wait()
                host.stderr.close()
                self.assertEqual(self.run_ctl(home / "sockets", "hosts").stdout, "no host is running\n")

    def test_the_folder_of_the_user_may_come_later(self):
        """As when somebody logs in after a service has begun."""
        alone = ["unshare", "--map-root-user", "--mount", "sh", "-euc"]
        if subprocess.run([*alone, "true"], capture_output=True, check=False).returncode != 0:
            self.skipTest("needs namespaces, for folders of its own")
        with tempfile.TemporaryDirectory() as folder:
            home = Path(folder)
            build(home)
            (home / "m.map").write_text("")
            script = """
mount -t tmpfs none /run
"$2/rung-run" "$1/stuck.so" "$1/m.map" --name "$3" 2> "$1/log" &
until grep -q "listening at /tmp/rung-0/" "$1/log"; do sleep 0.02; done
mkdir -p /run/user/0
"$2/rungctl" status --host "$3"
"$2/rungctl" hosts
kill $!
wait
"""
            done = subprocess.run([*alone, script, "sh", home, BIN, f"later-{os.getpid()}"], env={**os.environ, "RUNG_SOCKETS": ""}, capture_output=True, text=True,
                                  timeout=patience())
            self.assertIn("running: ", done.stdout, done.stderr)
            self.assertIn(f"\nlater-{os.getpid()}\n", done.stdout)

    def test_a_stranger_in_the_place_of_a_host(self):
        if os.geteuid() != 0:
            self.skipTest("needs root, to be two other users")
        with tempfile.TemporaryDirectory() as folder:
            Path(folder).chmod(0o777)
            code = ("import socket, sys; s = socket.socket(socket.AF_UNIX); s.bind(sys.argv[1]); s.listen(); print(1, flush=True); "
                    "s.accept()[0].sendall(b'{\"rung\": \"host\", \"protocol\": 1}\\n'); sys.stdin.read()")
            stranger = subprocess.Popen(["python3", "-c", f"import os; os.umask(0); {code}", f"{folder}/plc.sock"], user=1, group=1,
                                        extra_groups=[], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
            stranger.stdout.readline()
            shutil.copy(BIN / "rungctl", folder)
            done = subprocess.run([f"{folder}/rungctl", "status"], user=65534, group=65534, extra_groups=[], capture_output=True,
                                  text=True, timeout=patience(),
                                  env={**os.environ, "RUNG_SOCKETS": folder, "LLVM_PROFILE_FILE": "/dev/null"})  # of a build for coverage
            stranger.kill()
            stranger.communicate()
            self.assertEqual((done.returncode, done.stderr),
                             (WRONG, f"rungctl: the host at {folder}/plc.sock belongs to user 1, and is not used\n"))

    def test_what_rung_run_refuses(self):
        with tempfile.TemporaryDirectory() as folder:
            home = Path(folder)
            program = build(home)
            (home / "wrong.map").write_text('in.a = { type = "bit", name = "NOWHERE" }\nin.b = 5\n')
            environment = {**os.environ, "RUNG_SOCKETS": str(home / "sockets")}

            def run(*words):
                done = subprocess.run([BIN / "rung-run", *words], capture_output=True, text=True, env=environment, timeout=patience())
                return done.returncode, done.stderr

            status, text = run(program, home / "wrong.map")
            self.assertEqual((status, text.count("wrong.map:")), (WRONG, 2), text)
            self.assertEqual(run(home / "none.so", home / "wrong.map")[0], ENVIRONMENT)
            status, text = run(program, home / "none.map")
            self.assertEqual(status, ENVIRONMENT)
            self.assertIn("cannot read", text)
            self.assertEqual(run(program)[0], USAGE)
            (home / "m.map").write_text("")
            status, text = run(home / "m.map", program)
            self.assertEqual(status, USAGE)
            self.assertIn(f"found the mapping file {home}/m.map as the program, expected PROGRAM and then MAP; exchange the two\n", text)
            for option in ("--com", "--can", "--config"):
                self.assertEqual(run(program, home / "m.map", "--simulate", option, "0")[0], USAGE)
            for name, wrong in (("../x", "expected letters, digits, '-', '_' and '.'"),
                                ("x" * 200, "found a name of 200 characters for a host, expected at most 60")):
                status, text = run(program, home / "m.map", "--name", name)
                self.assertEqual(status, USAGE)
                self.assertIn(wrong, text)

    def test_retained_memory_in_use(self):
        with tempfile.TemporaryDirectory() as folder:
            home = Path(folder)
            program = build(home)
            (home / "m.map").write_text("")
            environment = {**os.environ, "RUNG_SOCKETS": str(home / "sockets")}
            words = [BIN / "rung-run", program, home / "m.map", "--retain", home / "kept", "--name"]
            with subprocess.Popen([*words, "one"], env=environment, stderr=subprocess.PIPE, text=True) as first:
                self.assertIn("listening at", first.stderr.readline())
                done = subprocess.run([*words, "two"], env=environment, capture_output=True, text=True, timeout=patience())
                first.kill()
            self.assertEqual(done.returncode, ENVIRONMENT, done.stderr)
            self.assertIn("kept", done.stderr)

    def test_a_host_is_connected_with_once(self):
        """One that it serves beside others is not taken up by looks whether it is there."""
        with tempfile.TemporaryDirectory() as folder:
            with socket.socket(socket.AF_UNIX) as host:
                host.bind(f"{folder}/plc.sock")
                host.listen()
                for words in (["status"], ["--host", "plc", "status"]):
                    asking = subprocess.Popen([BIN / "rungctl", *words], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
                                              env={**os.environ, "RUNG_SOCKETS": folder})
                    client, _ = host.accept()
                    client.sendall(b'{"rung":"host","protocol":1,"host":"plc"}\n')
                    self.assertIn(b"status", client.recv(200))
                    client.sendall(b'{"ok":true,"host":"plc","program":"p","dialect":"gsk"}\n')
                    self.assertIn("host plc, program p", asking.communicate(timeout=patience())[0])
                    client.close()
                    host.settimeout(0)
                    with self.assertRaises(BlockingIOError):
                        host.accept()
                    host.settimeout(patience())


if __name__ == "__main__":
    BIN = Path(sys.argv.pop(1))
    unittest.main()
