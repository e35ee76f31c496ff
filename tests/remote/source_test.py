#!/usr/bin/env python3
"""Sources that a host compiles in a process of its own, and attacks by them: source_test.py BIN"""
import base64
import json
import os
import shutil
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import remote_test
from patience import patience, wait_until
from remote_test import ENVIRONMENT, OK, PROGRAM, USAGE, WRONG, Host

BIN = Path(sys.argv[1]).resolve()
TEMPLATE = Path(__file__).resolve().parents[2] / "tools/rungc/templates/technol"


def packed(texts, files, dialect=b"technol"):
    """As docs/control-protocol.md has it."""
    def entry(letter, key, value=b""):
        return letter + struct.pack("<II", len(key), len(value)) + key + value
    return (b"rung-sources 1\n" + entry(b"d", dialect) + b"".join(entry(b"f", name) for name in files) +
            b"".join(entry(b"t", name, text) for name, text in texts.items()) + entry(b"e", b""))


class SourceHost(Host):
    """Its compiler is that of the build, or what `compiler` names."""
    compiler = None

    def setUp(self):
        os.environ["RUNG_COMPILE"] = str(self.compiler or BIN / "rung-compile")
        super().setUp()

    def ask(self, connection, **request):
        made, lines = connection
        made.sendall(json.dumps(request).encode() + b"\n")
        return json.loads(lines.readline())

    def connected(self):
        connection = self.connect()
        connection[1].readline()
        return connection

    def send(self, connection, data):
        for at in range(0, max(1, len(data)), 45000):
            piece = base64.b64encode(data[at:at + 45000]).decode()
            answer = self.ask(connection, do="sources", first=at == 0, piece=piece)
            if not answer["ok"]:
                return answer
        return answer

    def result(self, connection):
        def answer():
            found = self.ask(connection, do="compiled")
            return found if found.get("state") != "compiling" else None

        found = wait_until(answer)
        self.assertIsNotNone(found, "it compiles without end")
        return found

    def compiled(self, data):
        connection = self.connected()
        answer = self.send(connection, data)
        self.assertTrue(answer["ok"], answer)
        self.assertTrue(self.ask(connection, do="compile")["ok"])
        result = self.result(connection)
        connection[0].shutdown(socket.SHUT_WR)  # another one may send then
        self.assertEqual(connection[1].read(), "")  # the host has let it go
        self.wait(lambda: not self.children())
        return result

    def children(self):
        found = []
        for task in Path(f"/proc/{self.host.pid}/task").iterdir():
            found += [int(child) for child in (task / "children").read_text().split()]
        return found

    def assertScans(self):
        """The host goes on, answers, and has no process left."""
        before = self.scans()
        self.wait(lambda: self.scans() > before + 5)
        self.wait(lambda: not self.children())


class Reload(SourceHost):
    def source(self, text, name="edited.pmc"):
        (self.home / name).write_text(text)
        return self.home / name

    def test_more_than_ten_warnings_are_not_shown(self):
        def warnings(count):
            coils = "".join(f"LD   X0.0\nOUT  Y{i + 1}.0\nLDI  X0.0\nOUT  Y{i + 1}.0\n" for i in range(count))
            edited = self.source(PROGRAM.replace("FUNC END2", coils + "FUNC END2"))
            done = subprocess.run([BIN / "rungctl", "reload", edited], capture_output=True, text=True, env=self.environment, timeout=patience())
            self.assertEqual(done.returncode, OK, done.stderr)
            return done.stderr

        self.assertEqual(warnings(10).count("[double-coil]"), 10)
        self.assertEqual(warnings(11), "more than 10 warnings: `rungc check` shows all\n")

    def test_an_edited_source_takes_over(self):
        self.ctl("set", "D8:2", "7")
        edited = self.source(PROGRAM.replace("LD   X0.0", "LDI  X0.0"))
        text = self.ctl("reload", edited)
        self.assertRegex(text, r"kept: \d+ names, \d+ states of edges, timers and counters\nthe new program runs\n$")
        self.wait(lambda: self.get("Y0.0"))
        self.assertEqual(self.get("D8:2"), 7)
        self.assertIn("program edited", self.ctl("status"))
        self.assertIn("reload edited, compiled here from sources", self.logged())
        self.ctl("rollback")
        self.wait(lambda: not self.get("Y0.0"))

    def test_a_project_has_its_name(self):
        folder = self.home / "changed"
        folder.mkdir()
        (folder / "main.pmc").write_text(PROGRAM)
        (folder / "rung.toml").write_text('name = "mill 7"\ndialect = "gsk"\nfiles = ["main.pmc"]\n')
        self.ctl("reload", folder)
        self.assertIn("program mill 7", self.ctl("status"))
        self.assertIn("reload mill 7, compiled here from sources", self.logged())

    def test_its_errors_are_those_of_rungc(self):
        wrong = self.source(PROGRAM.replace("OUT  Y0.0", "OUT  X0.5"))
        said = subprocess.run([BIN / "rungc", "check", wrong], capture_output=True, text=True).stderr
        self.assertIn(f"{wrong}:5:6: error: ", said)
        text = self.ctl("reload", wrong, status=WRONG)
        self.assertEqual(text, said + "rungctl: nothing has changed\n")
        self.assertIn("running: ", self.ctl("status"))
        answer = json.loads(subprocess.run([BIN / "rungctl", "reload", wrong, "--json"], capture_output=True, text=True,
                                           env=self.environment).stdout)
        self.assertEqual((answer["ok"], answer["diagnostics"][0]["line"]), (False, 5))
        # The host's process says the same of sources that somebody sends who has not looked at them.
        name = str(wrong).encode()
        answer = self.compiled(packed({name: wrong.read_bytes()}, [name], b"gsk"))
        self.assertEqual((answer["state"], answer["report"]), ("errors", said))

    def test_an_error_at_a_line_of_one_word(self):
        wrong = self.source("%@4\nA0.0\n%\n", "wrong.mne")
        self.assertIn(f"{wrong}:2:1: error: a message is written `A0.0 1000 TEXT`; the number is missing", self.ctl("reload", wrong, status=WRONG))
        answer = json.loads(subprocess.run([BIN / "rungctl", "reload", wrong, "--json"], capture_output=True, text=True,
                                           env=self.environment).stdout)
        self.assertEqual((answer["ok"], answer["diagnostics"][0]["line"]), (False, 2))
        self.assertIn("running: ", self.ctl("status"))

    def test_what_is_lost_asks_first(self):
        with_symbol = self.source(PROGRAM.replace("symbol GUARD X0.2", "symbol GUARD X0.2\nsymbol COUNT D8"))
        self.ctl("reload", with_symbol)
        text = self.ctl("reload", self.source(PROGRAM), "--shadow", "25", status=WRONG)
        self.assertIn("no difference\nremoved COUNT\n", text)
        self.assertIn("the new program loses state: COUNT; nothing has changed; use --yes to do it anyway", text)
        self.ctl("reload", self.source(PROGRAM), "--yes")
        self.assertEqual(self.ctl("reload", self.home / "none.pmc", status=ENVIRONMENT),
                         f"cannot read '{self.home}/none.pmc': No such file or directory\nrungctl: nothing has changed\n")
        text = self.ctl("reload", self.source(PROGRAM.replace("LD   X0.0", "LDI  X0.0")), "--shadow", "25", status=WRONG)
        self.assertIn("Y0.0: false now, true in the new program\n", text)

    def test_with_profile_its_rungs_are_counted(self):
        self.ctl("reload", self.source(PROGRAM), "--profile")
        self.wait(lambda: json.loads(self.ctl("profile", "--json"))["ran"] > 0)

    def test_a_dialect_of_another_control_is_refused(self):
        ladder = self.source("dialect nct\n", "other.lad")
        shutil.copy(Path(__file__).resolve().parents[2] / "docs/lamp.lad", ladder)
        self.assertIn("has the dialect nct, but the running program has gsk", self.ctl("reload", ladder, status=WRONG))

    def test_requests_in_the_wrong_order(self):
        connection = self.connected()
        for request, error in (({"do": "compile"}, 'no sources have been sent before; "sources" sends them'),
                               ({"do": "compiled"}, 'no sources have been sent before; "sources" sends them'),
                               ({"do": "reload", "compiled": True}, 'no sources have been sent before; "sources" sends them'),
                               ({"do": "sources", "first": True}, 'found no text "piece" in the request, expected one'),
                               ({"do": "sources", "first": True, "piece": "*"}, 'found a "piece" that is not in base64, expected that')):
            self.assertEqual(self.ask(connection, **request)["error"], error)
        self.send(connection, b"rung")
        self.assertIn("have not been compiled", self.ask(connection, do="compiled")["error"])
        self.assertIn("no program has been compiled", self.ask(connection, do="reload", compiled=True)["error"])
        other = self.connected()
        self.assertIn("another client is compiling a program here", self.send(other, b"x")["error"])
        self.ask(connection, do="compile")
        self.assertIn("already", self.ask(connection, do="compile")["error"])
        self.assertEqual(self.result(connection)["report"], "found bytes that are not sources, or not all of them")
        connection[0].shutdown(socket.SHUT_RDWR)
        self.wait(lambda: self.send(other, b"x")["ok"])


class Attacks(SourceHost):
    def sent(self, include):
        text = (TEMPLATE / "main.plc").read_text().replace("T_INCLUDE names.inc", f"T_INCLUDE {include}")
        names = (TEMPLATE / "include/names.inc").read_bytes()
        return {b"main.plc": text.encode(), b"pump.plc": (TEMPLATE / "pump.plc").read_bytes(), b"names.inc": names}

    def large(self, size):
        """A program that takes its time."""
        texts = self.sent("names.inc")
        texts[b"main.plc"] = texts[b"main.plc"].replace(b"PUMP,LAMP,", b"PUMP,LAMP,O")
        texts[b"pump.plc"] = texts[b"pump.plc"].replace(b"MODULE_MAIN_END", b"LDR O\nWR O\n" * (size // 11) + b"MODULE_MAIN_END")
        return packed(texts, [b"main.plc", b"pump.plc"])

    def including(self, include):
        return self.compiled(packed(self.sent(include), [b"main.plc", b"pump.plc"]))

    def test_a_good_program_compiles(self):
        answer = self.including("names.inc")
        self.assertEqual((answer["state"], answer["report"]), ("compiled", ""))

    def test_no_path_of_a_source_is_opened(self):
        secret = self.home / "secret.inc"
        secret.write_text("        EQUI TWO_SECONDS,100\n")
        secret.chmod(0o600)
        fifo = self.home / "fifo.inc"
        os.mkfifo(fifo)
        link = self.home / "link.inc"
        link.symlink_to(secret)
        for path in (secret, fifo, link, f"{self.home}/../{self.home.name}/secret.inc", "/proc/self/fd/0", "/proc/self/mem",
                     "/dev/zero", "../../../../etc/shadow"):
            answer = self.including(path)
            self.assertEqual(answer["state"], "errors", answer)
            self.assertIn(f"main.plc:2:19: error: ", answer["report"])
            self.assertIn("[include-not-found]", answer["report"])
            self.assertNotIn("EQUI", answer["report"])
        self.assertScans()

    def test_what_its_user_cannot_read_is_not_read_for_him(self):
        """rungctl, and rung-run, of a user who is not root, with an include that only root can read."""
        if os.geteuid() != 0:
            self.skipTest("needs root, to have something that others cannot read")
        folder = self.home / "user"
        folder.mkdir()
        self.home.chmod(0o755)
        for name, text in self.sent(folder / "secret.inc").items():
            (folder / name.decode()).write_bytes(text)
        (folder / "secret.inc").write_text("        EQUI TWO_SECONDS,100 ; SECRET\n")
        (folder / "secret.inc").chmod(0o600)
        (folder / "rung.toml").write_text('dialect = "technol"\nfiles = ["main.plc", "pump.plc"]\n')
        (folder / "m.map").write_text("")
        for tool in ("rung-run", "rung-compile"):
            shutil.copy(BIN / tool, folder)
        folder.chmod(0o755)
        done = subprocess.run([folder / "rung-run", folder / "rung.toml", folder / "m.map"], user=65534, group=65534,
                              extra_groups=[], capture_output=True, text=True, timeout=patience(), start_new_session=True,
                              env={"RUNG_SOCKETS": "/tmp/none"}) # it finds the compiler beside itself
        self.assertEqual(done.returncode, ENVIRONMENT)
        self.assertIn("main.plc:2:19: error: ", done.stderr)
        self.assertNotIn("SECRET", done.stderr)

    def test_a_gigabyte_of_source(self):
        connection = self.connected()
        sent = 0
        piece = base64.b64encode(b"\n" * 45000).decode()
        while sent < 1 << 30:
            answer = self.ask(connection, do="sources", first=sent == 0, piece=piece)
            if not answer["ok"]:
                break
            sent += 45000
        self.assertLessEqual(sent, 16 << 20)
        self.assertEqual(answer["error"], "the sources have more than 16777216 bytes, expected no more")
        large = self.home / "large.pmc"
        large.touch()
        os.truncate(large, 1 << 30)
        self.assertIn("the sources have 1073741824 bytes, expected at most 16777216", self.ctl("reload", large, status=WRONG))
        self.assertScans()

    def test_a_program_that_takes_too_long_or_too_much(self):
        connection = self.connected()
        self.assertTrue(self.send(connection, self.large(15_500_000))["ok"])
        before = self.scans()
        self.assertTrue(self.ask(connection, do="compile")["ok"])
        self.wait(lambda: self.scans() > before + 100)  # others are answered
        self.assertEqual(len(self.children()), 1)
        self.wait(lambda: os.getpriority(os.PRIO_PROCESS, self.children()[0]) == 19)
        answer = self.result(connection)
        self.assertEqual(answer["state"], "failed", answer)
        self.assertRegex(answer["report"], r"30 s of processor time|more than 60 s|more than 2048 MB|SIG|signal")
        self.assertScans()

    def test_a_client_that_goes_away(self):
        connection = self.connected()
        self.send(connection, self.large(3_000_000))
        self.ask(connection, do="compile")
        self.wait(self.children)
        connection[0].shutdown(socket.SHUT_RDWR)
        self.assertScans()
        self.assertEqual(self.including("names.inc")["state"], "compiled")

    def test_a_process_that_is_killed(self):
        connection = self.connected()
        self.send(connection, self.large(3_000_000))
        self.ask(connection, do="compile")
        self.wait(self.children)
        os.kill(self.children()[0], signal.SIGKILL)
        answer = self.result(connection)
        self.assertEqual((answer["state"], answer["report"]),
                         ("failed", "the compiler process failed: it was ended by the signal Killed"))
        self.assertScans()

    def test_what_is_left_to_the_process(self):
        connection = self.connected()
        self.send(connection, self.large(3_000_000))
        self.ask(connection, do="compile")
        self.wait(self.children)
        child = Path(f"/proc/{self.children()[0]}")
        self.wait(lambda: "\nSeccomp:\t2\n" in (child / "status").read_text())
        status = (child / "status").read_text()
        self.assertIn("\nThreads:\t1\n", status)
        for wanted in ("\nNoNewPrivs:\t1\n", "\nCapEff:\t0000000000000000\n", "\nCapPrm:\t0000000000000000\n"):
            self.assertIn(wanted, status)
        if os.geteuid() == 0:
            self.assertIn("\nUid:\t65534\t65534\t65534\t65534\n", status)
            self.assertIn("\nGroups:\t \n", status)
        if os.geteuid() == 0:
            files = {int(file.name): os.readlink(file) for file in (child / "fd").iterdir()}
            self.assertTrue(set(files) <= set(range(12)), files)
            self.assertTrue(all(target.startswith(("pipe:", "/memfd:", "/dev/null")) for target in files.values()), files)
        connection[0].shutdown(socket.SHUT_RDWR)
        self.assertScans()


FAKE = """#!{python}
import fcntl, os, signal, sys, time
SEALS = fcntl.F_SEAL_WRITE | fcntl.F_SEAL_SHRINK | fcntl.F_SEAL_GROW | fcntl.F_SEAL_SEAL
while os.read(0, 65536): pass
def image(data, seals=SEALS):
    os.write(4, data)
    if seals: fcntl.fcntl(4, fcntl.F_ADD_SEALS, seals)
good = open({good!r}, "rb").read()
{body}
"""


class BrokenCompilers(SourceHost):
    """What a compiler process delivers that somebody has taken over, or that does not work."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.compiler = cls.home / "fake"

    def fake(self, body):
        self.compiler.write_text(FAKE.format(python=shutil.which("python3", path="/usr/bin:/bin") or sys.executable, good=str(self.program), body=body))
        self.compiler.chmod(0o755)

    def answer(self, body):
        self.fake(body)
        answer = self.compiled(packed({b"a": b""}, [b"a"]))
        self.assertEqual(answer["state"], "failed", answer)
        self.assertScans()
        return answer["report"]

    def test_images_that_are_none(self):
        done = '; os.write(3, b"compiled\\n")'
        for body, error in (("image(b'junk' * 1000)", "it is not an ELF"),
                            ("pass", "it is not sealed, so others could still change it"),
                            ("image(b'')", "it is "),
                            ("image(good, 0)", "it is not sealed, so others could still change it"),
                            ("image(good, SEALS & ~fcntl.F_SEAL_WRITE)", "it is not sealed, so others could still change it"),
                            ("image(good, SEALS & ~fcntl.F_SEAL_GROW)", "it is not sealed, so others could still change it"),
                            ("image(good[:-1])", "cannot load the program that was compiled: "),
                            ("image(good[:3000] + b'!' + good[3001:])", "its content is not what was sealed"),
                            ("image(good[:-136])", "it has no seal at its end")):
            self.assertIn(error, self.answer(body + done), body)

    def test_a_good_image_is_taken(self):
        self.fake('image(good); os.write(3, b"compiled\\n")')
        self.assertEqual(self.compiled(packed({b"a": b""}, [b"a"]))["state"], "compiled")

    def test_answers_that_are_none(self):
        for body, error in (("pass", "the compiler process failed: it ended with status 0"),
                            ("sys.exit(5)", "the compiler process failed: it ended with status 5"),
                            ('os.write(3, b"hello\\n")', "the compiler process gave an unknown answer"),
                            ('os.write(3, b"compiled")', "the compiler process failed: it ended with status 0"),
                            ('image(good); os.write(3, b"compiled\\n"); os.kill(os.getpid(), 11)', "it was ended by the signal Segmentation fault"),
                            ("os.kill(os.getpid(), 6)", "the program may need more than 2048 MB to be compiled"),
                            ("\nwhile True: os.write(3, b'x' * 65536)", "its answer has more than 262144 bytes")):
            self.assertIn(error, self.answer(body), body)

    def test_one_that_never_ends(self):
        self.fake("signal.pause()")
        connection = self.connected()
        self.send(connection, b"x")
        self.ask(connection, do="compile")
        self.wait(self.children)
        self.assertEqual(self.ask(connection, do="compiled")["state"], "compiling")
        connection[0].shutdown(socket.SHUT_RDWR)
        self.assertScans()

    def test_one_that_reads_nothing(self):
        self.fake("")
        self.compiler.write_text(self.compiler.read_text().replace("while os.read(0, 65536): pass", "os.write(3, b'failed\\nno'); sys.exit(0)"))
        self.assertEqual(self.compiled(packed({b"a": b"x" * 1_000_000}, [b"a"]))["report"], "no")

    def test_one_that_others_may_write(self):
        self.fake("pass")
        self.compiler.chmod(0o777)
        self.assertIn("every user may write to it (mode 0777)", self.compiled(b"")["report"])
        self.compiler.unlink()
        self.assertEqual(self.compiled(b"")["report"], f"sources cannot be compiled here: {self.compiler}: No such file or directory; install the package rung, "
                         "or start the host with RUNG_COMPILE set to the path of rung-compile")


class RungRun(unittest.TestCase):
    def test_each_new_project_runs(self):
        for dialect in ("nct", "gsk", "technol"):
            with self.subTest(dialect), tempfile.TemporaryDirectory() as home:
                subprocess.run([BIN / "rungc", "new", dialect, "machine"], check=True, cwd=home, stdout=subprocess.DEVNULL)
                folder = Path(home) / "machine"
                subprocess.run([BIN / "rungc", "map", "--template", "-o", "machine.map"], check=True, cwd=folder,
                               stdout=subprocess.DEVNULL)
                host = subprocess.Popen([BIN / "rung-run", ".", "machine.map"], cwd=folder, stderr=subprocess.PIPE, text=True,
                                        env={**os.environ, "RUNG_SOCKETS": str(Path(home) / "sockets")}, start_new_session=True)
                self.assertIn("listening at", host.stderr.readline())
                host.terminate()
                host.communicate(timeout=patience())
                self.assertEqual(host.returncode, OK)

    def test_sources_at_the_start(self):
        with tempfile.TemporaryDirectory() as folder:
            home = Path(folder)
            environment = {**os.environ, "RUNG_SOCKETS": str(home / "sockets")}
            environment.pop("RUNG_COMPILE", None)  # it takes the one beside it
            (home / "a.pmc").write_text(PROGRAM)
            (home / "m.map").write_text(remote_test.MAP)
            host = subprocess.Popen([BIN / "rung-run", home / "a.pmc", home / "m.map"], stderr=subprocess.PIPE, text=True,
                                    env=environment, start_new_session=True)
            self.assertIn("listening at", host.stderr.readline())
            host.terminate()
            host.communicate(timeout=patience())
            self.assertEqual(host.returncode, OK)
            (home / "a.pmc").write_text(PROGRAM.replace("OUT  Y0.0", "OUT  X0.5"))
            done = subprocess.run([BIN / "rung-run", home / "a.pmc", home / "m.map"], capture_output=True, text=True,
                                  env=environment, timeout=patience(), start_new_session=True)
            self.assertEqual(done.returncode, ENVIRONMENT)
            self.assertIn(f"{home}/a.pmc:5:6: error: ", done.stderr)


if __name__ == "__main__":
    sys.argv.pop(1)
    remote_test.BIN = BIN
    unittest.main()
