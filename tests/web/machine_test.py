#!/usr/bin/env python3
"""The live page of a machine that runs, through the socket of its host and by its recording: machine_test.py BIN"""
import json
import os
import signal
import subprocess
import sys
import tempfile
import time
import unittest
import urllib.error
from pathlib import Path

from live import Live
from patience import patience, wait_until

BIN = None
PROGRAM = """dialect gsk
symbol BUTTON X0.0
symbol ENDLESS X0.1
symbol LAMP Y0.0
symbol HELD R0.0
FUNC END1
; hold
LD   BUTTON
OR   HELD
OUT  HELD
; lamp
LD   HELD
OUT  LAMP
; a loop
FUNC LBL
PRM  L1
LD   ENDLESS
FUNC JMPB
PRM  L1
FUNC END2
"""
OTHER = PROGRAM.replace("; lamp\nLD   HELD\n", "; lamp of another program\nLDI  HELD\n")
MAP = """[in]
run = { type = "bit", name = "X0.2" }
[out]
lamp = { type = "bit", name = "LAMP" }
"""
RIGHTS = '[rungctl]\npermissions = ["set", "force", "reload", "stop", "start", "reset"]\n'


class Host:
    """rung-run with the program, in a folder of its own, until end()."""

    def __init__(self, map=MAP + RIGHTS, words=("--retain", "kept"), program=None):
        self.folder = tempfile.TemporaryDirectory()
        self.home = Path(self.folder.name)
        self.environment = {**os.environ, "RUNG_SOCKETS": str(self.home / "sockets")}
        (self.home / "plc.map").write_text("" if program else map)
        self.words = words
        self.program = program or "mill.so"
        if not program:
            self.build("mill.pmc", PROGRAM)
        self.start()

    def build(self, name, text):
        (self.home / name).write_text(text)
        subprocess.run([BIN / "rungc", "build", "-q", name, "-o", Path(name).stem + ".so"], check=True, cwd=self.home)

    def start(self):
        with open(self.home / "log", "a") as log:
            self.process = subprocess.Popen([BIN / "rung-run", self.program, "plc.map", "--name", "plc", *self.words], cwd=self.home,
                                            stderr=log, env=self.environment, start_new_session=True)
        assert wait_until(lambda: self.ctl("status").returncode == 0), (self.home / "log").read_text()

    def ctl(self, *words):
        return subprocess.run([BIN / "rungctl", *map(str, words)], cwd=self.home, env=self.environment, capture_output=True, text=True,
                              timeout=patience())

    def done(self, *words):
        result = self.ctl(*words)
        assert result.returncode == 0, result.stdout + result.stderr
        return result.stdout

    def kill(self):
        self.process.kill()
        self.process.wait()

    def end(self):
        self.process.terminate()
        self.process.wait(patience())
        self.folder.cleanup()

    def page(self, *words):
        return Live(BIN / "rungctl", *words, cwd=self.home, command="web", option=None, environment=self.environment)


class Following(unittest.TestCase):
    """A host and its page, anew for each test."""
    map = MAP + RIGHTS

    def setUp(self):
        self.host = Host(self.map)
        self.addCleanup(self.host.end)
        self.live = self.host.page().log_in()
        self.addCleanup(self.live.close)

    def picture(self, names="", live=None):
        return (live or self.live).ask(f"picture?page=test&after=0&from=0&to=20&names={'%0A'.join(names.split())}")

    def until(self, condition, names="", live=None):
        """The first picture for which the condition is true."""
        shown = []

        def found():
            shown[:] = [self.picture(names, live)]
            return condition(shown[0])
        if wait_until(found, step=0.02) is None:
            self.fail(f"never: {json.dumps(shown)}")
        return shown[0]

    def write(self, what, **more):
        return self.live.ask("order", {"do": what, "writing": True, **more})["done"]

    def refused(self, call):
        with self.assertRaises(urllib.error.HTTPError) as caught:
            call()
        with caught.exception as answer:
            return answer.code, answer.read().decode()

    def events(self, kind):
        return [event[4] for event in self.live.ask("events?after=0") if event[3] == kind]

    def row(self, text):
        """The row of a rung by its title."""
        return str(self.live.ask("names")["titles"].index(text))


class Machine(Following):
    def test_shows_what_runs(self):
        first = self.until(lambda p: p["state"] == "running" and p["follows"])
        self.until(lambda p: p["scan"] > first["scan"] + 20)
        self.assertEqual(first["notice"], "")
        index = self.live.ask("index")
        self.assertEqual((index["title"], index["live"], index["machine"]), ("mill.pmc", True, True))
        lamp = self.row("lamp")
        self.until(lambda p: p["values"] == {"LAMP": "0"} and p["rows"][lamp].count("0"), "LAMP")
        self.host.done("set", "BUTTON", "on")
        on = self.until(lambda p: p["values"]["LAMP"] == "1", "LAMP")
        self.assertEqual(on["rows"][lamp], "233")
        why = self.live.ask("why?name=LAMP")
        self.assertEqual([step[1].split(":")[0] for step in why["steps"]][:3], ["LAMP (Y0.0) = 1", "HELD (R0.0) = 1", "BUTTON (X0.0) = 1"])
        self.assertIn("through the host", why["steps"][-1][1])
        names = {name: number for number, name, *_ in self.live.ask("names")["names"]}
        self.assertEqual(why["steps"][0][4], [["HELD", "1", [names["HELD"]], True]])
        self.assertEqual(why["different"], ["HELD (R0.0) = 0"])

    def test_goes_back_while_the_machine_runs(self):
        self.host.done("set", "BUTTON", "on")
        self.until(lambda p: p["values"]["LAMP"] == "1", "LAMP")
        pressed = self.live.ask("why?name=LAMP")["steps"][0][2]
        self.live.order("pause")
        paused = self.picture()
        self.assertEqual((paused["state"], paused["follows"]), ("past", False))
        later = self.until(lambda p: p["last"] > paused["last"] + 50)
        self.assertEqual(later["scan"], paused["scan"])
        self.live.order("seek", scans=pressed)
        self.assertEqual(self.until(lambda p: p["scan"] == pressed, "LAMP")["values"], {"LAMP": "1"})
        self.live.order("step", scans=-1)
        before = self.until(lambda p: p["scan"] == pressed - 1, "LAMP")
        self.assertEqual(before["values"], {"LAMP": "0"})
        trace = self.live.ask("trace?names=LAMP&scans=5")
        self.assertEqual((trace["first"], trace["values"]), (pressed - 5, [["0"] * 5]))
        for what in ("step", "seek"):
            self.live.order("seek", scans=pressed)
            self.until(lambda p: p["scan"] == pressed)
            self.live.order(what, scans=-10**15)
            self.until(lambda p: p["scan"] == p["first"])
        self.live.order("run")
        self.until(lambda p: p["state"] == "running" and p["scan"] > later["last"])

    def test_writes_what_the_host_allows(self):
        self.assertEqual(self.picture()["mayWrite"], "")
        self.assertEqual(self.refused(lambda: self.live.order("set", name="BUTTON", value="1"))[0], 403)
        self.assertEqual(self.write("set", name="BUTTON", value="on"), "BUTTON = true (was false)")
        self.until(lambda p: p["values"]["LAMP"] == "1", "LAMP")
        self.assertEqual(self.write("force", name="LAMP", value="0"), "LAMP is forced to false")
        forced = self.until(lambda p: p["forces"], "LAMP")
        self.assertEqual([(one["name"], one["value"]) for one in forced["forces"]], [("LAMP", "0")])
        names = {name: number for number, name, *_ in self.live.ask("names")["names"]}
        self.assertEqual(forced["forces"][0]["ids"], [names["LAMP"]])
        self.assertIn("LAMP", self.host.done("forced"))
        self.assertEqual(self.write("unforce", name="LAMP"), "no longer forced: LAMP")
        self.until(lambda p: not p["forces"] and p["values"]["LAMP"] == "1", "LAMP")
        self.assertEqual(self.write("mark", name="now"), "marked")
        self.assertIsNotNone(wait_until(lambda: self.events("mark") == ["now"] and self.events("unforce")))
        self.assertRegex(self.events("set")[0], r"BUTTON.* \(by \w+\)")
        self.assertEqual(self.refused(lambda: self.write("set", name="NOTHING", value="1"))[0], 409)
        self.assertIn("no statements", self.refused(lambda: self.write("statement", name="scan"))[1])

    def test_operator_and_faults(self):
        self.host.done("stop")
        self.until(lambda p: p["state"] == "stopped")
        self.host.done("start")
        self.until(lambda p: p["state"] == "running")
        self.host.done("set", "ENDLESS", "on")
        fault = self.until(lambda p: p["state"] == "fault")
        self.assertNotEqual(fault["fault"], "")
        self.assertIsNotNone(wait_until(lambda: self.events("fault")))
        self.host.done("set", "ENDLESS", "off")
        self.host.done("reset")
        self.until(lambda p: p["state"] == "running")

    def test_a_host_that_is_killed_and_started_again(self):
        before = self.until(lambda p: p["state"] == "running")
        self.host.kill()
        lost = self.until(lambda p: p["state"] == "lost")
        self.assertIn("plc", lost["notice"])
        self.assertGreaterEqual(lost["scan"], before["scan"])
        self.live.order("step", scans=-3)  # its past is there
        self.until(lambda p: p["scan"] <= lost["last"] - 3)
        self.live.order("run")
        self.host.start()
        after = self.until(lambda p: p["state"] == "running" and p["scan"] > lost["last"] + 10)
        self.assertEqual(after["notice"], "")
        self.assertEqual(after["program"], before["program"])
        self.assertIsNotNone(wait_until(lambda: self.events("begin")))
        self.write("set", name="BUTTON", value="1")  # by a connection of its own, which was lost, too
        self.until(lambda p: p["values"]["LAMP"] == "1", "LAMP")
        self.live.order("seek", scans=before["scan"])
        self.until(lambda p: p["scan"] == before["scan"])

    def test_another_program(self):
        before = self.until(lambda p: p["state"] == "running" and p["values"] == {"LAMP": "0"}, "LAMP")
        self.host.build("other.pmc", OTHER)
        self.host.done("reload", self.host.home / "other.so")
        after = self.until(lambda p: p["program"] != before["program"] and p["values"] == {"LAMP": "1"}, "LAMP")
        self.assertIn("lamp of another program", self.live.ask("names")["titles"])
        self.assertEqual(after["notice"], "")
        self.live.order("seek", scans=before["scan"])  # the former program, in its own drawing
        self.until(lambda p: p["program"] == before["program"] and p["scan"] == before["scan"])
        self.assertNotIn("lamp of another program", self.live.ask("names")["titles"])
        self.live.order("run")
        self.until(lambda p: p["program"] == after["program"])

    def test_reloads_its_sources(self):
        before = self.until(lambda p: p["state"] == "running" and p["values"] == {"LAMP": "0"}, "LAMP")
        self.assertEqual(self.refused(lambda: self.live.order("reload"))[0], 403)
        (self.host.home / "mill.pmc").write_text("dialect gsk\nnonsense\n")
        self.assertIn("mill.pmc:2", self.refused(lambda: self.write("reload"))[1])
        (self.host.home / "mill.pmc").write_text(OTHER)
        self.assertEqual(self.write("reload"), "the new program runs")
        self.until(lambda p: p["program"] != before["program"] and p["values"] == {"LAMP": "1"}, "LAMP")
        lamp = self.row("lamp of another program")
        self.until(lambda p: p["rows"][lamp] == "233")  # the beginning of the power, a contact, a coil

    def test_a_message_without_a_text(self):
        """A program that was compiled without the texts of its messages: the page says that there is none."""
        self.until(lambda p: p["state"] == "running")
        self.host.build("other.pmc", PROGRAM.replace("OUT  LAMP\n", "OUT  LAMP\nOUT  A0.0\n"))
        self.host.done("reload", self.host.home / "other.so")
        self.host.done("set", "BUTTON", "on")
        self.until(lambda p: p["messages"] == [["1", "(no text)"]])
        self.assertIsNotNone(wait_until(lambda: self.events("message") == ["1 (no text)"]))

    def test_the_rungs_of_a_stopped_program(self):
        """Those of the last scan that ran, also in a picture of a later scan; values are those of that one."""
        self.host.done("set", "BUTTON", "on")
        lamp = self.row("lamp")
        self.until(lambda p: p["rows"][lamp] == "233" and p["ran"] == 0)
        self.host.done("stop")
        first = self.until(lambda p: p["ran"])
        later = self.until(lambda p: p["scan"] > first["ran"] + 20)
        self.assertEqual((later["state"], later["ran"], later["rows"][lamp]), ("stopped", first["ran"], "233"))
        self.live.order("seek", scans=first["ran"])
        self.until(lambda p: p["scan"] == first["ran"] and p["ran"] == 0 and p["rows"][lamp] == "233")
        self.live.order("run")
        self.host.done("start")
        self.until(lambda p: p["state"] == "running" and p["ran"] == 0 and p["rows"][lamp] == "233")

    def test_another_program_whose_sources_are_gone(self):
        before = self.until(lambda p: p["state"] == "running")
        self.host.build("other.pmc", OTHER)
        (self.host.home / "other.pmc").unlink()
        self.host.done("reload", self.host.home / "other.so")
        self.until(lambda p: p["program"] != before["program"] and p["values"] == {"LAMP": "1"}, "LAMP")
        self.assertIn("cannot read 'other.pmc'", self.live.ask("names")["titles"][0])

    def test_two_browsers(self):
        other = Live.of_link(self.live.order_link()).log_in()
        self.until(lambda p: p["state"] == "running", live=other)
        self.live.order("pause")
        paused = self.until(lambda p: p["state"] == "past", live=other)
        self.assertEqual(paused["scan"], self.picture()["scan"])
        other.order("run")
        self.until(lambda p: p["state"] == "running")

    def test_nobody_looks(self):
        """A page that nobody looks at makes no pictures, and has what has happened when somebody does."""
        first = self.until(lambda p: p["state"] == "running")
        time.sleep(7)
        self.host.done("set", "BUTTON", "on")
        later = self.until(lambda p: p["values"]["LAMP"] == "1", "LAMP")
        self.assertGreater(later["scan"], first["scan"])
        self.assertLess(later["revision"] - first["revision"], 6 * 33)


class Slices(unittest.TestCase):
    def test_a_picture_has_all_tasks(self):
        """The rungs of a TECHNOL program run in one of twenty slices; each picture has them."""
        host = Host(program=Path(__file__).resolve().parents[2] / "examples/technol-machining-centre", words=("--retain", "kept", "--simulate"))
        self.addCleanup(host.end)
        live = host.page().log_in()
        self.addCleanup(live.close)
        revision = 0

        def next_picture():
            nonlocal revision
            picture = live.ask(f"picture?page=test&after={revision}&from=100&to=220")
            revision = picture["revision"]
            return picture if picture["scan"] > 100 else None
        self.assertIsNotNone(wait_until(next_picture))
        for _ in range(10):
            picture = next_picture()
            ran = sum(1 for flow in picture["rows"].values() if flow and "-" not in flow)
            self.assertGreater(ran, 20, picture["scan"])


class WithoutRights(Following):
    map = MAP

    def test_nothing_can_be_written(self):
        self.until(lambda p: p["state"] == "running" and "permissions" in p["mayWrite"])
        for what in ("set", "force"):
            code, text = self.refused(lambda: self.write(what, name="LAMP", value="1"))
            self.assertEqual(code, 403)
            self.assertIn('permissions = ["set", "force"]', text)
        self.assertEqual(self.picture()["forces"], [])


class Sources(unittest.TestCase):
    """What the page is drawn from."""

    def setUp(self):
        self.host = Host()
        self.addCleanup(self.host.end)
        self.source = self.host.home / "mill.pmc"

    def failed(self, *words):
        result = self.host.ctl("web", *words)
        self.assertEqual(result.returncode, 3, result.stdout + result.stderr)
        return result.stderr

    def test_elsewhere(self):
        (self.host.home / "copy").mkdir()
        self.source.rename(self.host.home / "copy/mill.pmc")
        self.assertRegex(self.failed(), r"cannot read 'mill\.pmc'.*; name its sources")
        live = self.host.page("copy/mill.pmc").log_in()
        self.addCleanup(live.close)
        self.assertIn("lamp", live.ask("names")["titles"])

    def test_changed(self):
        self.source.write_text(OTHER)
        text = self.failed()
        self.assertIn("built from another version of mill.pmc", text)
        self.assertIn("name its sources", text)
        self.source.write_text("dialect gsk\nnonsense\n")
        self.assertIn("mill.pmc:2", self.failed())

    def test_wrong_words(self):
        self.assertIn("--listen", self.host.ctl("web", "--listen", "nowhere:99999").stderr)
        self.assertIn("cannot reach a host", self.host.ctl("web", "--host", "other").stderr)


class NotRecorded(unittest.TestCase):
    def test_says_what_is_needed(self):
        host = Host(words=())
        self.addCleanup(host.end)
        for words in (("web",), ("why", "LAMP")):
            result = host.ctl(*words)
            self.assertEqual(result.returncode, 3, result.stdout + result.stderr)
            self.assertIn('[recording] folder = "PATH"', result.stderr)


class Why(unittest.TestCase):
    """rungctl why, and rungc replay of a host that runs."""

    @classmethod
    def setUpClass(cls):
        cls.host = Host()
        cls.addClassCleanup(cls.host.end)
        time.sleep(0.3)
        cls.host.done("set", "BUTTON", "on")

    def test_a_chain(self):
        text = self.host.done("why", "LAMP")
        self.assertRegex(text, r"LAMP \(Y0\.0\) = 1, since scan \d+, [\d.]+ s\n.*rung 2 \"lamp\", mill\.pmc:\d+")
        self.assertRegex(text, r"BUTTON \(X0\.0\) = 1, since scan \d+")
        self.assertIn("written by a person or another program", text)
        found = json.loads(self.host.done("why", "LAMP", "--json"))
        self.assertIn("LAMP", json.dumps(found))

    def test_another_time(self):
        us = json.loads(self.host.done("get", "LAMP", "--json"))["us"]
        first = self.host.done("why", f"LAMP@{us / 1e6:.3f}s")
        self.assertIn("LAMP (Y0.0) = 1", first)
        self.assertIn("LAMP (Y0.0) = 0", self.host.done("why", "LAMP@0.01s"))

    def test_mistakes(self):
        unknown = self.host.ctl("why", "NOTHING")
        self.assertEqual(unknown.returncode, 2, unknown.stderr)
        self.assertIn("NOTHING", unknown.stderr)
        late = self.host.ctl("why", "LAMP@99999999")
        self.assertEqual(late.returncode, 2)
        self.assertIn("the recording has scans", late.stderr)
        nobody = self.host.ctl("why", "LAMP", "--host", "nobody")
        self.assertEqual(nobody.returncode, 1)

    def test_prompt_goes_on(self):
        """Each line of the prompt knows what has run until then."""
        prompt = subprocess.Popen([BIN / "rungc", "replay", "--host", "plc"], cwd=self.host.home, env=self.host.environment, text=True,
                                  stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        self.addCleanup(prompt.stdout.close)
        self.addCleanup(prompt.wait)
        self.addCleanup(prompt.kill)
        prompt.stdin.write("show HELD\n")
        prompt.stdin.flush()
        before = json.loads(self.host.done("status", "--json"))["us"]
        self.assertIsNotNone(wait_until(lambda: json.loads(self.host.done("status", "--json"))["us"] > before + 500_000))
        prompt.stdin.write(f"time {before / 1e6 + 0.2:.3f}s\nquit\n")
        prompt.stdin.close()
        said = prompt.stdout.read()
        self.assertIn("HELD = 1", said)
        self.assertNotIn("ended", said)
        self.assertEqual(prompt.wait(patience()), 0, said)

    def test_needs_one_source(self):
        for words in (("replay",), ("replay", "kept.recording", "--host", "plc")):
            result = subprocess.run([BIN / "rungc", *words], cwd=self.host.home, env=self.host.environment, capture_output=True, text=True)
            self.assertEqual(result.returncode, 2)
            self.assertIn("either a RECORDING or --host", result.stderr)


if __name__ == "__main__":
    BIN = Path(sys.argv.pop(1)).resolve()
    unittest.main(verbosity=2)
