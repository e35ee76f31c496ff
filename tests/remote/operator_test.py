#!/usr/bin/env python3
"""rung-operator beside a LinuxCNC that is a file: what comes to its screen, how often, and when it begins and ends.
operator_test.py BIN CLASS"""
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from patience import patience, wait_until

TOOL = Path(__file__).resolve().parents[2] / "machine/rung-hal/rung-operator"
# The folder has `on` while it runs, and `stuck` while nobody reads its errors; what was shown is in `shown`.
LINUXCNC = """import os, time
HOME = os.path.dirname(__file__)
class error(Exception): pass
def has(name): return os.path.exists(os.path.join(HOME, name))
class stat:
    def poll(self):
        if has("no-channel"): raise SystemError("<method 'poll'> returned NULL without setting an error")
        if not has("on"): raise error("emcStatusBuffer invalid err=3")
class command:
    def error_msg(self, text):
        with open(os.path.join(HOME, "shown"), "a") as out: out.write(text + "\\n")
        if has("stuck"): time.sleep(1)
"""
RUNGCTL = """#!/bin/sh
touch "{home}/followed"
exec tail -n +1 -f "{home}/said"
"""


class Operator(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.home = Path(folder.name)
        (self.home / "linuxcnc.py").write_text(LINUXCNC)
        (self.home / "rungctl").write_text(RUNGCTL.format(home=self.home))
        (self.home / "rungctl").chmod(0o755)
        (self.home / "said").write_text("")

    def begin(self):
        environment = {**os.environ, "PYTHONPATH": str(self.home), "PATH": f"{self.home}:{os.environ['PATH']}"}
        self.process = subprocess.Popen([sys.executable, TOOL], env=environment, stderr=subprocess.PIPE, text=True)
        self.addCleanup(self.process.stderr.close)
        self.addCleanup(self.process.wait)
        self.addCleanup(self.process.kill)

    def switch(self, name, on=True):
        if on:
            (self.home / name).touch()
        else:
            (self.home / name).unlink()

    def say(self, **words):
        with open(self.home / "said", "a") as out:
            out.write(json.dumps(words) + "\n")

    def message(self, text, time="10:52:27", logged=False):
        self.say(event="message", text=f"2026-11-25 {time} {text}", logged=logged)

    def shown(self):
        path = self.home / "shown"
        return path.read_text().splitlines() if path.exists() else []

    def wait(self, condition):
        self.assertTrue(wait_until(condition), self.shown())

    def test_it_waits_for_linuxcnc_and_ends_with_it(self):
        self.switch("no-channel")
        self.begin()
        self.assertFalse(wait_until(lambda: self.process.poll() is not None, seconds=1))
        self.switch("no-channel", False)
        self.assertFalse(wait_until(lambda: self.process.poll() is not None, seconds=1))
        self.switch("on")
        self.say(ok=True, messages=[], shown=["message 5 \"OIL LEVEL\""])
        self.wait(lambda: self.shown() == ['message 5 "OIL LEVEL"'])  # it is on already
        self.switch("on", False)
        self.assertEqual(self.process.wait(patience()), 0)
        self.assertEqual(self.process.stderr.read(), "")

    def test_a_repeated_message_is_shown_once(self):
        self.switch("on")
        self.begin()
        for i in range(30):
            self.message("message 1 \"DOOR\"", f"10:52:{i:02}")
        self.message("message 2 \"logged\"", logged=True)
        self.message("message 3 \"HOT\"")
        self.wait(lambda: len(self.shown()) >= 2)
        more = r" \((\d+) more are not shown\)"
        self.assertEqual([re.sub(more, "", line) for line in self.shown()],
                         ['2026-11-25 10:52:00 message 1 "DOOR"', '2026-11-25 10:52:27 message 3 "HOT"'])
        self.assertEqual(sum(map(int, re.findall(more, "".join(self.shown())))), 29)

    def test_a_flood_does_not_fill_the_queue(self):
        self.switch("on")
        self.begin()
        for i in range(300):
            self.message(f"message {i} \"FLOOD\"")
        self.wait(lambda: len(self.shown()) >= 10)
        self.assertLess(len(self.shown()), 25)  # what LinuxCNC holds unread
        self.assertGreater(sum(map(int, re.findall(r"\((\d+) more are not shown\)$", "\n".join(self.shown()), re.MULTILINE))), 200)

    def test_who_does_not_read_is_left_alone(self):
        self.switch("on")
        self.switch("stuck")
        self.begin()
        for i in range(20):
            self.message(f"message {i} \"UNREAD\"")
        self.wait(lambda: len(self.shown()) == 1)
        self.assertFalse(wait_until(lambda: len(self.shown()) > 1, seconds=3))


if __name__ == "__main__":
    sys.argv.pop(1)
    unittest.main()
