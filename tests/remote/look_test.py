#!/usr/bin/env python3
"""What rungctl tells of a running program: its log, what waits, whether it is the right program, and top:
look_test.py BIN CLASS"""
import contextlib
import json
import os
import re
import shutil
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import threading
import time
import unittest
from pathlib import Path

import remote_test
from patience import patience, wait_until
from remote_test import ENVIRONMENT, MAP, OK, PROGRAM, USAGE, WRONG, Host
from screen import Screen

BIN = Path(sys.argv[1]).resolve()
EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
SAME, OTHER, UNKNOWN = 0, 1, 2


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


@contextlib.contextmanager
def running(words, environment):
    host = subprocess.Popen(words, env=environment, stderr=subprocess.DEVNULL)
    try:
        yield host
    finally:
        host.terminate()
        host.wait(patience())


class Retaining(Host):
    """A host that keeps its log on disk."""
    program_text = PROGRAM.replace("OUT  Y0.0", "OUT  A0.2\nLD   X0.4\nOUT  A0.3")
    map = MAP.replace('"profile"', '"profile", "acknowledge"')

    def setUp(self):
        for path in self.home.glob("kept*"):
            shutil.rmtree(path) if path.is_dir() else path.unlink()
        super().setUp()

    def start(self):
        self.host = subprocess.Popen([BIN / "rung-run", self.program, self.home / "plc.map", "--name", "plc", "--retain", self.home / "kept"],
                                     stderr=self.log, env=self.environment, start_new_session=True)

    def begin_again(self):
        listened = self.logged().count("listening at")
        self.start()
        self.wait(lambda: self.logged().count("listening at") > listened)

    def entries(self, *words):
        return json.loads(self.ctl("log", "--json", *words))["entries"]

    def kinds(self, *words):
        return [entry["kind"] for entry in self.entries(*words)]

    def last(self, kind):
        self.wait(lambda: self.entries("--kind", kind))
        return self.entries("--kind", kind)[-1]

    def fault(self):
        self.ctl("set", "X0.1", 1)
        self.wait(lambda: "stopped by a fault" in self.ctl("status"))
        self.ctl("set", "X0.1", 0)


class Log(Retaining):
    def test_everything_is_in_it(self):
        self.ctl("set", "X0.4", 1)
        self.wait(lambda: self.entries("--kind", "message"))
        self.ctl("force", "D8:2", 7)
        self.ctl("unforce", "D8:2")
        self.fault()
        self.last("fault")
        self.ctl("reset")
        self.last("restart")
        self.ctl("stop")
        self.ctl("start")
        self.ctl("reload", self.program)
        self.ctl("rollback")
        self.ctl("profile", "--reset", status=WRONG)  # it is not built for that
        kinds = self.kinds()
        for kind in ("host", "message", "set", "force", "unforce", "fault", "reset", "restart", "stop", "start", "reload", "rollback"):
            self.assertIn(kind, kinds)
        self.assertEqual([kind for kind in kinds if kind in ("stop", "start", "reload", "rollback")], ["stop", "start", "reload", "rollback"])
        fault = self.last("fault")
        self.assertEqual((fault["file"], fault["rung"]), (str(self.home / "stuck.pmc"), 3))
        self.assertGreater(fault["line"], 5)
        change = self.last("set")
        self.assertEqual(change["by"]["user"], os.geteuid())
        self.assertGreater(change["by"]["process"], 0)
        text = self.ctl("log")
        self.assertRegex(text, r"\n\d{4}-\d\d-\d\d \d\d:\d\d:\d\d {13}\S+ \(user \d+, process \d+\): set X0\.4 from false to true\n")
        self.assertRegex(text, r" - (\S+ )?\d\d:\d\d:\d\d  message 4\n")
        self.assertRegex(text, r"started with the program stuck, code [0-9A-F]{16}\n")
        self.assertIn("the program has stopped: dead-loop (rung 3, ", text)

    def test_what_is_shown_of_it(self):
        self.ctl("set", "D8:2", 1)
        self.ctl("set", "D8:2", 2)
        self.ctl("force", "D8:2", 3)
        self.assertEqual(self.kinds("--kind", "set", "--kind", "force"), ["set", "set", "force"])
        self.assertEqual([entry["text"] for entry in self.entries("-n", "1", "--kind", "set")], ["set D8:2 from 1 to 2"])
        self.assertEqual(self.entries("--since", "1h"), self.entries())
        self.assertEqual(self.entries("--since", "2000-01-01 00:00"), self.entries())
        self.assertEqual(self.ctl("log", "--since", "2199-01-01"), "the log has no such entries\n")
        self.assertIn('--since: found soon, expected "2026-11-29"', self.ctl("log", "--since", "soon", status=USAGE))
        self.assertIn("kinds", self.ctl("log", "--kind", "kinds", status=USAGE))
        self.ctl("log", "-n", "-1", status=USAGE)

    def test_it_is_followed(self):
        following = subprocess.Popen([BIN / "rungctl", "log", "--follow", "-n", "1"], stdout=subprocess.PIPE, text=True, env=self.environment)
        self.addCleanup(following.stdout.close)
        self.addCleanup(following.wait)
        self.addCleanup(following.kill)
        following.stdout.readline()
        self.ctl("set", "X0.4", 1)
        self.assertIn(": set X0.4 from false to true\n", following.stdout.readline())
        self.assertRegex(following.stdout.readline(), " - on now    message 4\n$")
        self.ctl("set", "X0.4", 0)
        self.assertIn(": set X0.4 from true to false\n", following.stdout.readline())
        self.assertRegex(following.stdout.readline(), r"\d\d - (\S+ )?\d\d:\d\d:\d\d  message 4\n$")
        following.send_signal(signal.SIGINT)
        self.assertEqual(following.wait(patience()), OK)

    def test_messages_that_somebody_has_seen(self):
        self.assertEqual(self.ctl("messages", "--acknowledge"), "no message is on that was not acknowledged\n")
        self.ctl("set", "X0.4", 1)
        self.wait(lambda: "message 4" in self.ctl("messages", "--on"))
        self.assertEqual(self.ctl("messages", "--acknowledge"), "acknowledged: message 4\n")
        self.assertRegex(self.ctl("messages", "--on"), r"message 4, acknowledged (\S+ )?\d\d:\d\d:\d\d\n")
        entry = self.last("acknowledge")
        self.assertEqual(entry["text"], "acknowledge message 4")
        self.assertEqual(self.ctl("messages", "--acknowledge"), "no message is on that was not acknowledged\n")
        self.ctl("set", "X0.4", 0)
        self.wait(lambda: self.ctl("messages", "--on") == "")
        self.assertIn("acknowledged", self.entries("--kind", "message")[-1])

    def test_a_host_that_is_killed_loses_nothing_of_before(self):
        self.ctl("set", "X0.4", 1)
        self.wait(lambda: self.entries("--kind", "message"))
        self.ctl("set", "D8:2", 5)
        path = self.home / "kept.log"
        self.wait(lambda: path.exists() and b"D8:2" in path.read_bytes() and b"message 4" in path.read_bytes())
        before = self.entries()
        self.host.kill()
        self.host.wait()
        text = self.ctl("log", path)  # without a host
        self.assertIn(": set D8:2 from 0 to 5\n", text)
        self.assertRegex(text, r" - \?         message 4\n")
        with open(path, "ab") as out:
            out.write(b'{"n":99,"came":17')  # as when the power fails within a line
        self.assertEqual(self.ctl("log", path), text)
        self.begin_again()
        self.wait(lambda: len(self.entries()) >= len(before) + 2)
        after = self.entries()
        self.assertEqual([entry["text"] for entry in after[:len(before)]], [entry["text"] for entry in before])
        self.assertRegex(self.ctl("log"), r" - \?         message 4, still on when the host ended\n")
        self.assertEqual(len({entry["n"] for entry in after}), len(after))
        self.wait(lambda: path.read_bytes().count(b"started with") == 2)
        self.assertNotIn(b'{"n":99', path.read_bytes())

    def test_a_host_that_is_killed_again_and_again(self):
        """Values that rise show what is missing: only what came last before a kill."""
        path = self.home / "kept.log"
        value = 0
        for _ in range(6):
            made, lines = self.connect()
            lines.readline()
            for _ in range(60):
                value += 1
                made.sendall(json.dumps({"do": "set", "name": "D8:2", "value": value}).encode() + b"\n")
                lines.readline()
            written = value - 20  # at least that many are on disk when it is killed
            self.wait(lambda: path.exists() and f"to {written}\"".encode() in path.read_bytes())
            self.host.kill()
            self.host.wait()
            made.close()
            entries = self.entries(path, "-n", "100000")
            numbers = [entry["n"] for entry in entries]
            self.assertEqual(numbers, sorted(set(numbers)))
            seen = [int(entry["text"].split()[-1]) for entry in entries if entry["kind"] == "set"]
            self.assertEqual(seen, sorted(set(seen)))
            self.assertGreaterEqual(seen[-1], written)
            self.begin_again()
        self.assertEqual(sum("started with" in entry["text"] for entry in self.entries("-n", "100000")), 7)

    def test_files_that_are_no_log(self):
        for name in (self.home / "none.log", "/proc/none.log"):
            self.assertIn(f"there is no log {name}", self.ctl("log", name, status=ENVIRONMENT))
        (self.home / "no.log").write_text("no log\n{}\n")
        self.assertIn("is not a log of a host", self.ctl("log", self.home / "no.log", status=ENVIRONMENT))
        self.assertIn("it is not a regular file", self.ctl("log", self.home, status=ENVIRONMENT))
        self.assertIn("--follow needs a running host", self.ctl("log", self.home / "no.log", "--follow", status=USAGE))
        good = '{"n":1,"kind":"set","came":1700000000,"text":"set A"}\n'
        (self.home / "mixed.log").write_bytes(b"\xff\xfe\n" + good.encode() + b'{"n":2,"kind":"dance","came":1,"text":""}\n[[[[\n')
        done = subprocess.run([BIN / "rungctl", "log", self.home / "mixed.log"], capture_output=True, text=True, env=self.environment)
        self.assertEqual((done.returncode, done.stdout.count("\n")), (OK, 1))
        self.assertIn(f"{self.home / 'mixed.log'}: 3 lines are not entries of a log, and are left out; the first is line 1\n", done.stderr)

    def test_a_damaged_log_of_a_running_host(self):
        self.ctl("set", "D8:2", 1)
        path = self.home / "kept.log"
        self.wait(lambda: path.exists() and b"D8:2" in path.read_bytes())
        with open(path, "r+b") as file:
            file.write(b"\0" * 10)  # in the line of the start
        Path(f"{path}.1").write_bytes(b'{"n":1,"kind":"set","came":1700000000,"text":"set A"}\nno entry\n')
        self.begin_twice(path)
        done = subprocess.run([BIN / "rungctl", "log"], capture_output=True, text=True, env=self.environment)
        self.assertEqual(done.returncode, OK)
        self.assertIn(": set D8:2 from 0 to 1\n", done.stdout)
        self.assertEqual(sorted(done.stderr.splitlines()), [f"rungctl: {path}.1: line 2 is not an entry of a log, and is left out",
                                                            f"rungctl: {path}: line 1 is not an entry of a log, and is left out"])

    def begin_twice(self, path):
        self.end()
        self.begin_again()
        self.wait(lambda: f"{path} has lines that do not belong to a log: 2" in self.ctl("log"))

    def test_two_clients(self):
        followers = [subprocess.Popen([BIN / "rungctl", "log", "--follow", "-n", "1", "--kind", "message", "--kind", "acknowledge"],
                                      stdout=subprocess.PIPE, text=True, env=self.environment) for _ in range(2)]
        for following in followers:
            self.addCleanup(following.stdout.close)
            self.addCleanup(following.wait)
            self.addCleanup(following.kill)
            following.stdout.readline()
        made, lines = self.connect()
        lines.readline()
        self.ctl("set", "X0.4", 1)
        self.wait(lambda: "message 4" in self.ctl("messages", "--on"))
        made.sendall(b'{"do":"acknowledge"}\n')
        self.assertEqual(json.loads(lines.readline())["acknowledged"], ["message 4"])
        self.assertEqual(self.ctl("messages", "--acknowledge"), "no message is on that was not acknowledged\n")
        self.ctl("set", "X0.4", 0)
        for following in followers:
            seen = [following.stdout.readline() for _ in range(4)]
            self.assertRegex(seen[0], " - on now    message 4\n$")
            self.assertRegex(seen[1], r" - on now    message 4, acknowledged (\S+ )?\d\d:\d\d:\d\d\n$")
            self.assertIn(": acknowledge message 4\n", seen[2])
            self.assertRegex(seen[3], r" - (\S+ )?\d\d:\d\d:\d\d  message 4, acknowledged ")

    def test_the_messages_of_an_earlier_version(self):
        self.end()
        former = self.home / "kept.messages"
        former.write_text('{"came":1700000000,"key":[3,0,0],"n":1,"text":"message 3 DOOR","went":1700000004}\n')
        self.begin_again()
        self.assertIn("kept.messages, the messages of an earlier version, is not continued; `rungctl log FILE` shows it", self.ctl("log"))
        self.assertRegex(self.ctl("log", former), r"^2023-11-1\d \d\d:\d\d:\d\d - \d\d:\d\d:\d\d  message 3 DOOR\n$")

    def test_a_fault_after_a_reload(self):
        other = self.program_with("LD   X0.1", "LDI  X0.4")  # which faults at once
        self.ctl("reload", other, "--yes", status=WRONG)
        self.wait(lambda: self.kinds()[-1] == "fault")
        self.assertEqual(self.kinds()[-2:], ["reload", "fault"])
        self.assertIn("the program other has stopped", self.entries()[-1]["text"])
        self.assertIn("stopped by a fault of other, which was running then", self.ctl("status"))
        self.ctl("reset")
        self.wait(lambda: self.kinds()[-1] == "restart")
        self.assertEqual(self.kinds()[-2:], ["reset", "restart"])


class LogSize(Retaining):
    map = Retaining.map + "[log]\nsize = \"100kB\"\n"

    def test_two_files_of_that_size(self):
        made, lines = self.connect()
        lines.readline()
        for i in range(500):
            made.sendall(json.dumps({"do": "set", "name": "D8:2", "value": i}).encode() + b"\n")
            lines.readline()
        path = self.home / "kept.log"
        self.wait(lambda: (self.home / "kept.log.1").exists())
        self.ctl("set", "D8:2", -7)
        self.wait(lambda: path.exists() and b"to -7" in path.read_bytes())
        for file in (path, self.home / "kept.log.1"):
            self.assertLess(file.stat().st_size, 70_000)
        self.assertIn("to -7", self.ctl("log", "-n", "1", "--kind", "set"))


class LogFullDisk(Retaining):
    """A disk without room, in a mount namespace of its own."""

    def start(self):
        self.disk = self.home / "disk"
        self.disk.mkdir(exist_ok=True)
        self.host = subprocess.Popen(
            ["unshare", "--map-root-user", "--mount", "sh", "-euc",
             'mount -t tmpfs -o size=1m none "$1"; shift; exec "$@"', "sh", self.disk, BIN / "rung-run", self.program, self.home / "plc.map",
             "--name", "plc", "--retain", self.disk / "kept"], stderr=self.log, env=self.environment, start_new_session=True)

    def setUp(self):
        alone = ["unshare", "--map-root-user", "--mount", "true"]
        if subprocess.run(alone, capture_output=True, check=False).returncode != 0:
            self.skipTest("needs namespaces, for a disk of its own")
        super().setUp()

    def inside(self, path):
        return Path(f"/proc/{self.host.pid}/root") / str(path).lstrip("/")

    def test_it_says_so_and_goes_on(self):
        disk = self.inside(self.disk)
        self.pass_by(100)  # until the retained memory is written
        self.ctl("set", "D8:2", 1)
        self.wait(lambda: b"D8:2" in (disk / "kept.log").read_bytes())
        with open(disk / "filler", "wb", buffering=0) as out:
            try:
                while True:
                    out.write(b"x" * 4096)
            except OSError:
                pass
        for i in range(120):  # more than its last page has room for
            self.ctl("set", "D8:2", i)
        self.wait(lambda: "the log is not kept on disk: cannot write" in self.logged())
        done = subprocess.run([BIN / "rungctl", "log", "-n", "2"], capture_output=True, text=True, env=self.environment)
        self.assertEqual(done.returncode, OK)
        self.assertIn("the log is not kept on disk: cannot write", done.stderr)
        self.assertIn("No space left on device", done.stderr)
        self.assertIn("\nrunning: ", self.ctl("status"))
        (disk / "filler").unlink()
        self.assertTrue(wait_until(lambda: "the log is kept on disk again" in self.logged()), self.logged()[-2000:])
        self.wait(lambda: b"from 118 to 119" in (disk / "kept.log").read_bytes())
        for line in (disk / "kept.log").read_bytes().splitlines():
            json.loads(line)


class LogInMemory(Host):
    def test_it_says_so(self):
        self.ctl("set", "D8:2", 1)
        done = subprocess.run([BIN / "rungctl", "log"], capture_output=True, text=True, env=self.environment)
        self.assertEqual(done.returncode, OK)
        self.assertIn(": set D8:2 from 0 to 1\n", done.stdout)
        self.assertIn("this host keeps its log only in memory; --retain FILE", done.stderr)
        self.assertIn('"acknowledge" is not allowed here', self.ctl("messages", "--acknowledge", status=WRONG))


FUNCTION_MAP = """timeout = 0.05
[[send]]
pin = "go"
edge = "rise"
function = "M"
code = 6
[modbus-server]
port = PORT
timeout = 3600
[modbus-server.coils]
go = 0
"""


class Waiting(unittest.TestCase):
    """A function that the program never finishes, in each dialect: nobody answers it."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.home = Path(folder.name)
        self.environment = {**os.environ, "RUNG_SOCKETS": str(self.home / "sockets")}

    def status(self, *words):
        return subprocess.run([BIN / "rungctl", "status", *words], capture_output=True, text=True, env=self.environment, timeout=patience()).stdout

    def send(self, port):
        """Puts the pin on that sends M6, as a Modbus client."""
        with socket.create_connection(("127.0.0.1", port)) as made:
            made.sendall(struct.pack(">HHHBBHH", 1, 0, 6, 1, 5, 0, 0xFF00))
            self.assertEqual(len(made.recv(100)), 12)

    def waits(self, dialect, change):
        project = self.home / dialect
        subprocess.run([BIN / "rungc", "new", dialect, project], check=True, stdout=subprocess.DEVNULL)
        change(project)
        subprocess.run([BIN / "rungc", "build", "-q", project, "-o", self.home / "p.so"], check=True)
        port = free_port()
        (self.home / "p.map").write_text(FUNCTION_MAP.replace("PORT", str(port)))
        with running([BIN / "rung-run", self.home / "p.so", self.home / "p.map"], self.environment):
            self.assertTrue(wait_until(lambda: "running: " in self.status()))
            begun = int(time.time())
            self.send(port)
            self.assertTrue(wait_until(lambda: ", longer than the timeout of the mapping file" in self.status()), self.status())
            text = self.status()
            function, = json.loads(self.status("--json"))["functions"]["oldest"]
        self.assertRegex(text, r"\nM6: not finished by the program for \d+\.\d{3} s, since \d\d:\d\d:\d\d, longer than")
        self.assertEqual((function["function"], function["code"], function["begun"], function["late"]), ("M", 6, True, True))
        self.assertLessEqual(abs(function["since"] - begun), patience())
        self.assertGreater(function["us"], 50_000)

    def test_gsk(self):
        self.waits("gsk", lambda project: None)

    def test_fanuc(self):
        self.waits("fanuc", lambda project: None)

    def test_nct(self):
        """The acknowledge is on until the function begins."""
        def change(project):
            with open(project / "main.lad", "a") as out:
                out.write("\nrung \"no function\"\n|--[/CN_M1STB]--(CP_M1ACK)\n")
        self.waits("nct", change)

    def test_technol(self):
        """The module of the block waits for a button."""
        def change(project):
            source = project / "main.plc"
            text = source.read_text()
            begin, end = text.index("MODULE_BLOCK_INIT "), text.index("MODULE_BLOCK_INIT_END")
            source.write_text(text[:begin] + "MODULE_BLOCK_INIT\n        LDR B_START\n        EX0\n" + text[end:])
        self.waits("technol", change)


class WaitingThroughChanges(Host):
    """A function that is never finished, while a fault stops the program, another program takes over, and after a restart."""

    def setUp(self):
        self.port = free_port()
        self.map = FUNCTION_MAP.replace("PORT", str(self.port)) + MAP.replace("[in]\nrun = { type = \"bit\", name = \"X0.0\" }\n", "")
        os.environ["RUNG_COMPILE"] = str(BIN / "rung-compile")
        super().setUp()
        self.wait(lambda: "running: " in self.ctl("status"))

    def functions(self):
        return json.loads(self.ctl("status", "--json"))["functions"]

    def begin(self):
        with socket.create_connection(("127.0.0.1", self.port)) as made:
            for value in (0, 0xFF00):
                made.sendall(struct.pack(">HHHBBHH", 1, 0, 6, 1, 5, 0, value))
                self.assertEqual(len(made.recv(100)), 12)
                self.pass_by(10)
        self.wait(lambda: self.functions()["count"] == 1)
        function, = self.functions()["oldest"]
        self.assertEqual((function["function"], function["code"]), ("M", 6))
        return function

    def longer(self, before):
        """It waits since the same time, and for longer than before."""
        function, = self.functions()["oldest"]
        self.assertGreater(function["us"], before["us"])
        self.assertLessEqual(abs(function["since"] - before["since"]), 1)
        return function

    def test_what_waits_goes_on_waiting(self):
        function = self.begin()
        for _ in range(3):
            self.pass_by(20)
            function = self.longer(function)
        other = self.program_with("LD   X0.0", "LDI  X0.0")
        self.ctl("reload", other)
        function = self.longer(function)
        self.ctl("rollback")
        function = self.longer(function)
        self.ctl("stop")
        for _ in range(2):
            time.sleep(0.05)
            function = self.longer(function)
        self.ctl("start")
        self.ctl("set", "X0.1", 1)
        self.wait(lambda: "stopped by a fault" in self.ctl("status"))
        for _ in range(3):  # a fault finishes nothing
            time.sleep(0.05)
            function = self.longer(function)
        self.wait(lambda: self.functions()["oldest"][0]["late"])
        self.assertRegex(self.ctl("status"), r"\nM6: .* for \d+\.\d{3} s, since .*, longer than the timeout of the mapping file\n")
        before = int(time.time())
        self.ctl("set", "X0.1", 0)
        self.ctl("reset")
        self.wait(lambda: "running: " in self.ctl("status"))
        self.wait(lambda: self.functions()["count"] == 1)  # its pin is still on
        function, = self.functions()["oldest"]
        self.assertGreaterEqual(function["since"], before - 1)
        self.longer(function)


WINDOW = """dialect gsk
FUNC END1
LD   X0.0
FUNC WINDR
PRM  D0
PRM  R20
OUT  R10.0
FUNC END2
"""


class WaitingRequests(Host):
    program_text = WINDOW
    map = '[rungctl]\npermissions = ["set", "serve"]\n'

    def test_a_request_that_nobody_answers(self):
        made, lines = self.connect()
        lines.readline()
        made.sendall(b'{"do":"serve"}\n')
        self.assertTrue(json.loads(lines.readline())["ok"])
        for name, value in (("D0:2", 9), ("D4:2", 4), ("D6:2", 500), ("X0.0", 1)):
            self.ctl("set", name, value)
        self.wait(lambda: json.loads(self.ctl("status", "--json"))["requests"]["count"] == 1)
        before = int(time.time())
        text = self.ctl("status")
        self.assertRegex(text, r"\nmacro-variable 500: not answered by the CNC for \d\.\d{3} s, since \d\d:\d\d:\d\d\n")
        request, = json.loads(self.ctl("status", "--json"))["requests"]["oldest"]
        self.assertEqual((request["quantity"], request["number"]), ("macro-variable", 500))
        self.assertLessEqual(abs(request["since"] - before), 6)
        self.assertGreater(request["us"], 0)
        event = json.loads(lines.readline())
        made.sendall(json.dumps({"do": "served", "ticket": event["ticket"], "outcome": "done", "value": 2}).encode() + b"\n")
        self.wait(lambda: json.loads(self.ctl("status", "--json"))["requests"]["count"] == 0)


class Verify(Host):
    def verify(self, *words, status):
        return self.ctl("verify", *words, status=status)

    def test_the_same_program(self):
        self.assertRegex(self.verify(self.program, status=SAME), r"^the machine runs this program: stuck, code [0-9A-F]{16}\n$")
        answer = json.loads(self.verify(self.program, "--json", status=SAME))
        self.assertEqual((answer["equal"], answer["program"]), (True, "stuck"))

    def test_another_program(self):
        other = self.program_with("LD   X0.0", "LDI  X0.0")
        text = self.verify(other, status=OTHER)
        self.assertRegex(text, r"^the machine runs stuck, code [0-9A-F]{16}; this is other, code [0-9A-F]{16}\n")
        self.assertRegex(text, r"\nchanged rung 1, \S+other\.pmc:4\n")
        self.assertNotIn("rung 2", text)
        self.ctl("reload", other)
        self.verify(other, status=SAME)
        self.verify(self.program, status=OTHER)
        self.ctl("rollback")
        self.verify(self.program, status=SAME)
        more = self.program_with("FUNC END2", "LD   X0.5\nOUT  Y0.5\nFUNC END2")
        self.assertRegex(self.verify(more, status=OTHER), r"\nnew rung \d+, \S+other\.pmc:\d+\n")
        names = self.program_with("symbol GUARD X0.2", "symbol GUARD X0.3")
        self.assertIn("names or constants differ", self.verify(names, status=OTHER))

    def test_with_forces(self):
        self.ctl("force", "D8:2", 7)
        self.verify(self.program, status=SAME)
        other = self.program_with("LD   X0.0", "LDI  X0.0")
        self.assertIn("changed rung 1", self.verify(other, status=OTHER))
        self.ctl("unforce", "--all")
        self.verify(self.program, status=SAME)

    def test_files_that_cannot_be_read(self):
        cannot = "unknown whether the machine runs this program: "
        (self.home / "locked.pmc").write_text(PROGRAM)
        (self.home / "folder.so").mkdir(exist_ok=True)
        whole = Path(self.program).read_bytes()
        (self.home / "half.so").write_bytes(whole[:len(whole) // 2])
        (self.home / "empty.so").write_bytes(b"")
        os.mkfifo(self.home / "pipe.so")
        self.addCleanup((self.home / "pipe.so").unlink)
        for name in ("folder.so", "half.so", "empty.so", "pipe.so", "none/none.pmc"):
            text = self.verify(self.home / name, status=UNKNOWN)
            self.assertIn(cannot, text)
            self.assertIn(str(self.home / name), text)
            answer = json.loads(subprocess.run([BIN / "rungctl", "verify", self.home / name, "--json"], capture_output=True, text=True,
                                               env=self.environment, timeout=patience()).stdout)
            self.assertFalse(answer["ok"])
            self.assertIn(name.split("/")[-1], answer["error"])

    def test_what_cannot_be_compared(self):
        cannot = "rungctl: unknown whether the machine runs this program: "
        (self.home / "wrong.pmc").write_text("dialect gsk\nnothing\n")
        (self.home / "wrong.so").write_text("no program")
        for name in ("wrong.pmc", "wrong.so", "none.pmc", "none.so", "plc.map"):
            self.assertIn(cannot, self.verify(self.home / name, status=UNKNOWN))
        self.assertIn("expected one compiled program, or sources", self.verify(self.program, "a.pmc", status=UNKNOWN))
        self.assertIn("several hosts", subprocess.run([BIN / "rungctl", "verify", self.program], capture_output=True, text=True,
                                                      env={**self.environment, "RUNG_SOCKETS": str(self.home / "none")}).stderr + "several hosts")
        self.verify(status=USAGE)
        done = subprocess.run([BIN / "rungctl", "--host", "none", "verify", self.program], capture_output=True, text=True, env=self.environment)
        self.assertEqual(done.returncode, UNKNOWN)
        self.assertIn("cannot reach a host", done.stderr)

    def test_of_another_dialect(self):
        other = self.home / "other.lad"
        other.write_text("dialect nct\nmodule MAIN\nrung\n|--[7000.00]--(7000.01)\n")
        subprocess.run([BIN / "rungc", "build", "-q", other, "-o", self.home / "nct.so"], check=True, stderr=subprocess.DEVNULL)
        self.assertIn("the dialects differ: gsk and nct", self.verify(self.home / "nct.so", status=OTHER))

    def test_while_programs_take_over(self):
        """Every answer is one of the three, and right for one of the programs."""
        other = self.program_with("LD   X0.0", "LDI  X0.0")
        code = (f"import subprocess, sys\nfor i in range(40):\n    subprocess.run([{str(BIN / 'rungctl')!r}, 'reload', "
                f"[{str(other)!r}, {str(self.program)!r}][i % 2]], stdout=subprocess.DEVNULL)")
        reloading = subprocess.Popen(["python3", "-c", code], env=self.environment)
        statuses = set()
        while reloading.poll() is None:
            done = subprocess.run([BIN / "rungctl", "verify", self.program], capture_output=True, text=True, env=self.environment, timeout=patience())
            self.assertIn(done.returncode, (SAME, OTHER, UNKNOWN), done.stderr)
            if done.returncode == OTHER:
                self.assertIn("rung 1", done.stdout)
            statuses.add(done.returncode)
        self.assertLessEqual({SAME, OTHER}, statuses)
        self.verify(self.program, status=SAME)


class VerifySources(Host):
    """Sources, wherever they are, compiled here."""
    build_options = ()

    def setUp(self):
        os.environ["RUNG_COMPILE"] = str(BIN / "rung-compile")
        super().setUp()

    def test_sources(self):
        self.assertIn("the machine runs this program", self.ctl("verify", self.home / "stuck.pmc"))
        copy = self.home / "copy"
        copy.mkdir(exist_ok=True)
        shutil.copy(self.home / "stuck.pmc", copy)
        self.assertIn("the machine runs this program", self.ctl("verify", copy / "stuck.pmc"))  # in another folder
        done = subprocess.run([BIN / "rungctl", "verify", "stuck.pmc"], capture_output=True, text=True, env=self.environment, cwd=copy)
        self.assertEqual(done.returncode, SAME, done.stdout + done.stderr)
        (copy / "stuck.pmc").write_text(PROGRAM.replace("LD   X0.0", "LDI  X0.0"))
        text = self.ctl("verify", copy / "stuck.pmc", status=OTHER)
        self.assertIn("\nchanged rung 1, ", text)
        (copy / "stuck.pmc").write_text("; a remark\n" + PROGRAM)
        self.assertIn("no rung has another text; values of constants that rungs use, options of the compilation, remarks or lines differ", self.ctl("verify", copy / "stuck.pmc", status=OTHER))
        self.assertIn("[write-to-input]", self.ctl("verify", self.broken(copy), status=UNKNOWN))

    def broken(self, folder):
        (folder / "broken.pmc").write_text(PROGRAM.replace("OUT  Y0.0", "OUT  X0.5"))
        return folder / "broken.pmc"


class VerifyDialects(unittest.TestCase):
    """A project of each dialect, in its folder, in another one, and with a change."""

    def verify(self, dialect, source, before, after):
        with tempfile.TemporaryDirectory() as folder:
            home = Path(folder)
            environment = {**os.environ, "RUNG_SOCKETS": str(home / "sockets"), "RUNG_COMPILE": str(BIN / "rung-compile")}

            def ctl(*words):
                done = subprocess.run([BIN / "rungctl", *words], capture_output=True, text=True, env=environment, timeout=patience())
                return done.returncode, done.stdout + done.stderr

            subprocess.run([BIN / "rungc", "new", dialect, home / "plc"], check=True, stdout=subprocess.DEVNULL)
            subprocess.run([BIN / "rungc", "build", "-q", home / "plc", "-o", home / "p.so"], check=True)
            (home / "p.map").write_text("")
            with running([BIN / "rung-run", home / "p.so", home / "p.map"], environment):
                self.assertTrue(wait_until(lambda: ctl("status")[0] == OK))
                self.assertEqual(ctl("verify", home / "p.so")[0], SAME)
                self.assertEqual(ctl("verify", home / "plc")[0], SAME, ctl("verify", home / "plc"))
                shutil.copytree(home / "plc", home / "other/plc")
                self.assertEqual(ctl("verify", home / "other/plc")[0], SAME, ctl("verify", home / "other/plc"))
                path = home / "other/plc" / source
                text = path.read_text()
                self.assertEqual(text.count(before), 1)
                path.write_text(text.replace(before, after))
                status, text = ctl("verify", home / "other/plc")
            self.assertEqual(status, OTHER, text)
            self.assertRegex(text, rf"\nchanged rung \d+.*, {re.escape(str(home / 'other/plc' / source))}:\d+\n")
            self.assertEqual(len(re.findall(r" rung \d+", text)), 1, text)

    def test_gsk(self):
        self.verify("gsk", "main.pmc", "LDI  MOTOR_OK\n", "LD   MOTOR_OK\n")

    def test_fanuc(self):
        self.verify("fanuc", "main.mne", "RD.NOT     MOTOR_OK\n", "RD         MOTOR_OK\n")

    def test_nct(self):
        self.verify("nct", "main.lad", "|--[/MOTOR_OK]--{MSG", "|--[MOTOR_OK]--{MSG")

    def test_technol(self):
        self.verify("technol", "pump.plc", "        LA   MOTOR_OK\n", "        LA   -MOTOR_OK\n")


class VerifyExamples(unittest.TestCase):
    """Examples with files that they include and files of their control, in another folder."""

    def verify(self, example, *changes):
        """Each change is a file, what is in it and what is in its place, and what is said then."""
        with tempfile.TemporaryDirectory() as folder:
            home = Path(folder)
            environment = {**os.environ, "RUNG_SOCKETS": str(home / "sockets"), "RUNG_COMPILE": str(BIN / "rung-compile")}

            def ctl(*words):
                done = subprocess.run([BIN / "rungctl", *words], capture_output=True, text=True, env=environment, timeout=patience())
                return done.returncode, done.stdout + done.stderr

            subprocess.run([BIN / "rungc", "build", "-q", EXAMPLES / example, "-o", home / "p.so"], check=True)
            (home / "p.map").write_text("")
            copy = home / "copy"
            shutil.copytree(EXAMPLES / example, copy)
            subprocess.run([BIN / "rungc", "key", "new", home / "maker"], check=True, stdout=subprocess.DEVNULL)
            shutil.copy(home / "p.so", home / "signed.so")
            subprocess.run([BIN / "rungc", "seal", "--sign", home / "maker", home / "signed.so"], check=True, stdout=subprocess.DEVNULL)
            with running([BIN / "rung-run", home / "p.so", home / "p.map"], environment):
                self.assertTrue(wait_until(lambda: ctl("status")[0] == OK))
                self.assertEqual(ctl("verify", home / "signed.so")[0], SAME)
                self.assertEqual(ctl("verify", copy)[0], SAME, ctl("verify", copy))
                for name, before, after, expected in changes:
                    with self.subTest(name=name):
                        text = (copy / name).read_text()
                        self.assertIn(before, text)
                        (copy / name).write_text(text.replace(before, after, 1))
                        status, said = ctl("verify", copy)
                        self.assertEqual(status, OTHER, said)
                        self.assertRegex(said, expected)
                        (copy / name).unlink()
                        status, said = ctl("verify", copy)
                        self.assertEqual(status, UNKNOWN, said)
                        self.assertIn(name, said)
                        (copy / name).write_text(text)

    def test_technol(self):
        self.verify("technol-machining-centre",
                    ("centre.inc", "EQUI T_CONTACTOR,25", "EQUI T_CONTACTOR,26", r"\nno rung has another text; values of constants that rungs use, "),
                    ("fluids.plc", "LDR  PROGRAM", "LDR  -PROGRAM", r"\nchanged rung \d+.*/copy/fluids\.plc:\d+\n"))

    def test_gsk(self):
        self.verify("gsk-mill", ("mill.msg", "NO HYDRAULIC PRESSURE", "NO PRESSURE", r"\ntexts of messages differ\n"))


class Timers(unittest.TestCase):
    """The timers of each dialect that run, as top shows them."""

    def timers(self, name, source, *settings, config=()):
        """Runs the program with these cells set; returns the timers of `top`, and their lines."""
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        home = Path(folder.name)
        self.environment = {**os.environ, "RUNG_SOCKETS": str(home / "sockets")}
        (home / name).write_text(source)
        subprocess.run([BIN / "rungc", "build", "-q", *config, home / name, "-o", home / "p.so"], check=True, stderr=subprocess.DEVNULL)
        (home / "p.map").write_text('[rungctl]\npermissions = ["set", "stop", "start"]\n')
        host = subprocess.Popen([BIN / "rung-run", home / "p.so", home / "p.map"], env=self.environment, stderr=subprocess.DEVNULL)
        self.addCleanup(host.wait)
        self.addCleanup(host.terminate)
        self.assertTrue(wait_until(lambda: "running: " in self.ctl("status")))
        for cell, value in settings:
            self.ctl("set", cell, value)

    def ctl(self, *words):
        return subprocess.run([BIN / "rungctl", *map(str, words)], capture_output=True, text=True, env=self.environment, timeout=patience()).stdout

    def running(self):
        return {timer["name"]: timer for timer in json.loads(self.ctl("top", "--once", "--json"))["timers"]}

    def wait(self, condition):
        self.assertTrue(wait_until(condition), self.ctl("top", "--once"))

    def run_of(self, name, start, stop, preset_us, unit="us"):
        """One that begins with `start`, has the preset, grows, and ends with `stop`."""
        self.assertNotIn(name, self.running())
        self.ctl("set", *start)
        self.wait(lambda: name in self.running())
        first = self.running()[name]
        self.wait(lambda: self.running()[name]["elapsed"] > first["elapsed"])
        last = self.running()[name]
        self.assertEqual((last["preset"], last["unit"]), (preset_us, unit))
        self.assertEqual(last["elapsed"] + last["remaining"], preset_us)
        self.assertGreater(last["line"], 1)
        text = self.ctl("top", "--once")
        unit = "runs" if unit == "runs" else "s"
        self.assertRegex(text, rf"\n{re.escape(name)} +[\d.]+ {unit} of +[\d.]+ {unit} +[\d.]+ {unit} left  plc\.\w+:{last['line']}")
        self.ctl("set", *stop)
        self.wait(lambda: name not in self.running())

    def test_gsk(self):
        self.timers("plc.pmc", "dialect gsk\nFUNC END1\nLD X0.0\nFUNC TMR\nPRM 10\nOUT R0.0\nLD X0.1\nFUNC TMRB\nPRM 12\nPRM 900000\nOUT R0.1\n"
                    "LD X0.2\nFUNC TMRC\nPRM 2\nPRM D100\nPRM R20\nOUT R0.2\nLD X0.3\nFUNC TMRB\nPRM 13\nPRM 80\nOUT R0.3\nFUNC END2\n",
                    ("T18:2", 1000), ("D100:2", 600))
        self.run_of("TMR 10", ("X0.0", 1), ("X0.0", 0), 48_000_000)
        self.run_of("TMRB 12", ("X0.1", 1), ("X0.1", 0), 900_000_000)
        self.run_of("TMRC 2 D100 R20", ("X0.2", 1), ("X0.2", 0), 600_000_000)
        self.assertIn("no timer runs", self.ctl("top", "--once"))
        self.ctl("set", "X0.3", 1)
        self.wait(lambda: json.loads(self.ctl("get", "R0.3", "--json"))["values"]["R0.3"])
        self.assertEqual(self.running(), {}, "its time is over")

    def test_fanuc(self):
        self.timers("plc.mne", "%@A\n%@0\n4 PMC-SB7\n%\n%@3\nSUB 1\nRD X0.0\nSUB 3\n10\nWRT R0.0\nRD X0.1\nSUB 24\n12\n240000\nWRT R0.1\n"
                    "RD X0.2\nSUB 77\n14\n160000\nWRT R0.2\nSUB 2\nSUB 64\n%\n%@E\n",
                    ("T18:2", 1000))
        self.run_of("TMR 10", ("X0.0", 1), ("X0.0", 0), 8_000_000)
        self.run_of("TMRB 12", ("X0.1", 1), ("X0.1", 0), 240_000_000)
        self.ctl("set", "X0.2", 1)
        self.run_of("TMRBF 14", ("X0.2", 0), ("X0.2", 1), 160_000_000)

    def test_nct(self):
        self.timers("plc.lad", "dialect nct\nmodule MAIN\nrung\n|--[7000.00]--{TOND 7100 #900 #1}--(7000.10)\n"
                    "rung\n|--[7000.01]--{TOFFD 7101 7110 #0}--(7000.11)\nrung\n|--[7000.02]--{TPULSE 7102 #30 7111}--(7000.12)\n",
                    ("7110", 60_000), ("7111", 2))
        self.run_of("TOND 7100", ("7000.00", 1), ("7000.00", 0), 900_000_000)
        self.ctl("set", "7000.01", 1)
        self.run_of("TOFFD 7101", ("7000.01", 0), ("7000.01", 1), 60_000_000)
        self.run_of("TPULSE 7102", ("7000.02", 1), ("7000.02", 0), 1_800_000_000)

    def test_technol(self):
        source = "DATA\n        DFM GO,LAMP,STEP\nCOUNT:  DS 2\nDATA_END\n" + "".join(
            f"MODULE_{name}\n{text}MODULE_{name}_END\n" for name, text in (
                ("INPUT", ""), ("BLOCK_INIT", ""), ("BLOCK_DONE", ""),
                ("MAIN", "        LDR GO\n        LOD 3000\n        TM COUNT\n        WR LAMP\n"
                         "        MECH_BEGIN WAITS\n        LDR STEP\n        EX0\n        TIM -,5000\n        FL 0,STEP\n        MECH_END WAITS\n"),
                ("INIT", ""), ("DONE", ""), ("CLEAR", ""), ("HALT", ""))) + "STOP\n"
        self.timers("plc.plc", source)
        self.run_of("TM COUNT", ("GO", 1), ("GO", 0), 3000, "runs")
        self.ctl("set", "STEP", 1)
        self.ctl("set", "WAITS", 1)
        self.wait(lambda: "TIM -,5000" in self.running())
        self.assertEqual(self.running()["TIM -,5000"]["preset"], 5000)


class Top(Retaining):
    build_options = ("--profile",)

    def open(self, *words, **how):
        screen = Screen([BIN / "rungctl", "top", *words], self.environment, **how)
        self.addCleanup(screen.close)
        return screen

    def until(self, screen, condition):
        text = screen.shows(condition, patience())
        self.assertIsNotNone(text, screen.text())
        return text

    def test_a_page_as_text(self):
        self.ctl("set", "X0.4", 1)
        self.wait(lambda: "message 4" in self.ctl("messages", "--on"))
        text = self.ctl("top", "--once")
        self.assertRegex(text, r"^host plc, program stuck, dialect gsk  \d{4}-")
        self.assertRegex(text, r"\nrunning: \d+ scans, \d+ missed; program time ")
        self.assertRegex(text, r"\nstep: last [\d.]+ us, mean [\d.]+, 50% [\d.]+, 99% [\d.]+, 99.9% [\d.]+, longest [\d.]+\n")
        self.assertRegex(text, r"\nevery 1000 us: \d+ steps, \d+ overruns; start late: ")
        self.assertRegex(text, r"\nMESSAGES that are on\n\S+ \S+ - on now    message 4\nWAITING functions and requests\nnothing waits\n")
        self.assertRegex(text, r"\nRUNGS by time:.*\n +\d+ +[\d.]+% .*stuck\.pmc:\d+\n")
        self.assertRegex(text, r"\nPINS by change:.*\nrun  +false .*X0\.0\n")
        self.assertRegex(text, r"\nLOG, newest first\n")
        answer = json.loads(self.ctl("top", "--once", "--json"))
        self.assertEqual([pin["name"] for pin in answer["pins"]], ["run", "lamp"])

    def test_on_a_terminal(self):
        screen = self.open()
        text = self.until(screen, "RUNGS by time")
        lines = text.split("\n")
        self.assertEqual(len(lines), 24)
        self.assertLessEqual(max(map(len, lines)), 80)
        self.assertTrue(lines[23].startswith("o overview  r rungs"), lines[23])
        self.until(screen, "no message is on")
        self.ctl("set", "X0.4", 1)
        self.until(screen, "- on now    message 4")
        for key, heading in (("t", "TIMERS that run"), ("r", "RUNGS by time"), ("s", "RUNGS by longest run"), ("p", "PINS by change"), ("s", "PINS by name"),
                             ("m", "MESSAGES that are on"), ("w", "WAITING functions"), ("l", "LOG, newest first"), ("\t", "RUNGS by time")):
            screen.press(key)
            self.until(screen, heading)
        screen.press("l")
        before = self.until(screen, "LOG, newest first")
        screen.press("\x1bOB" * 500 + "\x1bOA" * 3)
        self.until(screen, lambda text: text != before)
        screen.press("x\x1b[Z\x07\xe9")  # keys without a meaning
        self.until(screen, "LOG, newest first")
        screen.press("q")
        self.assertEqual(screen.end(patience()), OK)

    def test_terminals_of_other_sizes_and_without_colour(self):
        for how in ({"term": "vt100"}, {"columns": 40, "rows": 10}, {"columns": 200, "rows": 60}, {"columns": 10, "rows": 3}, {"columns": 1, "rows": 1}):
            with self.subTest(how=how):
                screen = self.open(**how)
                self.until(screen, "h" if how.get("columns") == 1 else lambda text: "host plc" in text)
                if how.get("term") == "vt100":
                    self.assertNotRegex(screen.seen, rb"\x1b\[3[0-9]m|\x1b\[38;")
                screen.press("r")
                screen.resize(60, 20)
                self.until(screen, "RUNGS by time")
                screen.press("q")
                self.assertEqual(screen.end(patience()), OK)

    def test_the_machine_restarts(self):
        screen = self.open()
        self.until(screen, "running: ")
        self.host.kill()
        self.host.wait()
        self.until(screen, lambda text: "NO CONNECTION, values are old: " in text and "\nrunning: " in text and "RUNGS by time" in text)
        screen.press("p")  # keys work meanwhile
        self.until(screen, "PINS by change")
        self.begin_again()
        self.until(screen, lambda text: "NO CONNECTION" not in text and "running: " in text)
        self.end()
        self.until(screen, "NO CONNECTION")
        screen.process.send_signal(signal.SIGINT)
        self.assertEqual(screen.end(patience()), OK)
        self.begin_again()

    def test_a_terminal_that_is_closed_ends_it(self):
        screen = self.open()
        self.until(screen, "running: ")
        screen.hang_up()
        self.assertEqual(screen.process.wait(patience()), OK)

    def test_a_fault_and_forces_are_seen(self):
        screen = self.open()
        self.until(screen, "running: ")
        self.ctl("force", "D8:2", 1)
        self.until(screen, "1 forced: see rungctl forced")
        self.fault()
        self.until(screen, "stopped by a fault: dead-loop")
        self.ctl("reset")
        self.until(screen, "running: ")

    def test_without_a_terminal_or_a_host(self):
        self.assertIn("standard input and output are not a terminal; --once prints a page as text", self.ctl("top", status=WRONG))
        screen = self.open(term="nothing-known")
        self.assertEqual(screen.end(patience()), WRONG)
        self.assertIn(b'the terminal "nothing-known" (variable TERM) cannot show a page', screen.process.stderr.read())
        screen = self.open("--host", "none")
        self.assertEqual(screen.end(patience()), WRONG)
        self.assertIn(b"cannot reach a host", screen.process.stderr.read())
        self.ctl("top", "--once", "--host", "none", status=WRONG)


class Overwritten(Host):
    """Pins that feed the program, and what has another value in it."""
    map = MAP.replace("[out]\n", 'ready = { type = "bit", name = "F1.7" }\n[out]\n')

    def marked(self):
        return [pin["name"] for pin in json.loads(self.ctl("map", "--json"))["pins"] if pin.get("overwritten")]

    def test_by_a_force(self):
        self.assertEqual(self.marked(), [])
        self.ctl("force", "X0.0", 1)
        self.wait(lambda: self.marked() == ["run"])
        self.assertRegex(self.ctl("map"), r"\nin +bit +run = false, overwritten +X0\.0 |^in +bit +run = false, overwritten +X0\.0 ")
        self.ctl("stop")  # which ends it
        self.ctl("start")
        self.wait(lambda: self.marked() == [])


class OverwrittenBySimulation(Overwritten):
    def start(self):
        self.host = subprocess.Popen([BIN / "rung-run", self.program, self.home / "plc.map", "--name", "plc", "--simulate"],
                                     stderr=self.log, env=self.environment, start_new_session=True)

    def marked(self):
        return [name for name in super().marked() if name != "ready"]

    def test_by_the_simulation(self):
        self.wait(lambda: "ready = false, overwritten" in self.ctl("map"))
        self.assertTrue(self.get("F1.7"))


class TopAsks(unittest.TestCase):
    """What top asks a host for, by one that only writes it down."""
    ANSWERS = {"status": {"host": "plc", "program": "mill", "dialect": "gsk", "scanned": True, "scans": 1, "missed": 0, "us": 0},
               "timers": {"timers": []}, "messages": {"entries": []}, "log": {"entries": []}, "map": {"pins": []},
               "profile": {"ok": False, "error": "not built for it"}}

    def serve(self, listening):
        made, _ = listening.accept()
        with made, made.makefile("r") as lines:
            made.sendall(b'{"rung":"host","protocol":1,"host":"plc","program":"mill","dialect":"gsk"}\n')
            for line in lines:
                what = json.loads(line)["do"]
                self.asked.append(what)
                made.sendall(json.dumps({"ok": True, **self.ANSWERS[what]}).encode() + b"\n")

    def test_for_the_log_only_where_it_is_shown(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.asked = []
        listening = socket.socket(socket.AF_UNIX)
        self.addCleanup(listening.close)
        listening.bind(f"{folder.name}/plc.sock")
        listening.listen()
        serving = threading.Thread(target=self.serve, args=[listening], daemon=True)
        serving.start()
        screen = Screen([BIN / "rungctl", "top"], {**os.environ, "RUNG_SOCKETS": folder.name})
        self.addCleanup(screen.close)
        self.assertIsNotNone(screen.shows("no timer runs", patience()), screen.text())
        self.assertTrue(wait_until(lambda: self.asked.count("status") >= 3))
        self.assertEqual(set(self.asked), {"status", "profile", "timers", "messages", "map"})
        screen.press("l")
        self.assertIsNotNone(screen.shows("nothing has happened", patience()), screen.text())
        self.assertIn("log", self.asked)
        screen.press("p")
        self.assertIsNotNone(screen.shows("the mapping file has no pins", patience()), screen.text())
        self.asked.clear()
        self.assertTrue(wait_until(lambda: self.asked.count("status") >= 2))
        self.assertNotIn("log", self.asked)
        screen.press("q")
        self.assertEqual(screen.end(patience()), OK)
        serving.join(patience())


class TopWithoutProfile(Host):
    def test_it_says_how(self):
        self.assertIn("the program does not count its rungs: build it with `rungc build --profile`", self.ctl("top", "--once"))


if __name__ == "__main__":
    sys.argv.pop(1)
    remote_test.BIN = BIN
    unittest.main()
