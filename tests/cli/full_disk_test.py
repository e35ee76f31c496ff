#!/usr/bin/env python3
"""What rungc and rung-run print goes to a full disk: each command says so. full_disk_test.py RUNGC RUNG_RUN"""
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from patience import patience
from root import go_to_root

RUNGC = RUNG_RUN = None
OK, ENVIRONMENT = 0, 3
PROGRAM = """dialect gsk
FUNC END1
LD   X0.0
OUT  Y0.0
FUNC END2
"""
LONG = "dialect gsk\nFUNC END1\n" + "".join(f"LD   X0.0\nAND  X0.1\nOUT  R{i}.0\n" for i in range(1, 300)) + "FUNC END2\n"
SCENARIO = "program a.pmc\nscan 2\nexpect Y0.0 0\n"
# By command; {n}: a folder that is not there yet.
COMMANDS = {
    "new": ["gsk", "{n}"],
    "check": ["a.pmc"],
    "build": ["a.pmc", "-o", "made.so"],
    "map": ["a.pmc", "--template"],
    "bind": ["host.h", "a.pmc", "--struct", "io", "--template"],
    "seal": ["a.so"],
    "key": ["new", "{n}"],
    "emit": ["ir", "a.pmc"],
    "opt": ["a.pmc"],
    "convert": ["a.pmc", "--to", "ladder"],
    "import": ["s.csv"],
    "format": ["a.pmc", "--stdout"],
    "view": ["a.pmc", "-o", "a.html"],
    "xref": ["a.pmc"],
    "diff": ["a.pmc", "b.pmc"],
    "run": ["a.pmc", "--scans", "2"],
    "test": ["a.scn"],
    "replay": ["a.scn", "--show", "Y0.0"],
    "lsp": ["--help"],  # its work needs an editor at the other end of a pipe
    "web": ["--help"],  # its work needs a host: remote.FullDisk
    "profile": ["a.scn", "--engine", "interp"],
    "wcet": ["a.pmc"],
    "explain": ["dead-loop"],
    "doc": ["ir"],
    "completion": ["bash"],
    "help": [],
}
MORE = [["opt", "a.pmc", "--statistics"], ["opt", "a.pmc", "--print-after", "fold"], ["--help"], ["--version"], ["check", "--json", "a.pmc"], ["check", "--help"], ["emit", "cpp", "a.pmc"],
        ["emit", "layout", "a.pmc"], ["emit", "llvm", "a.pmc"], ["emit", "asm", "a.pmc"], ["profile", "--json", "a.scn", "--engine", "interp"],
        ["wcet", "--json", "a.pmc"], ["xref", "--json", "a.pmc"], ["doc", "gsk"], ["doc", "diagnostics"], ["help", "--man"], ["explain"],
        ["explain", "gsk"], ["test", "--coverage-all", "--engine", "interp", "long.scn"]]


class FullDisk(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.home = Path(folder.name)
        self.made = 0
        for name, text in (("a.pmc", PROGRAM), ("b.pmc", PROGRAM.replace("LD ", "LDI")), ("a.scn", SCENARIO), ("long.pmc", LONG), ("s.csv", "START,X10.0\n"),
                           ("long.scn", SCENARIO.replace("a.pmc", "long.pmc")),
                           ("host.h", "struct io { _Bool lamp; };\n")):
            (self.home / name).write_text(text)
        self.run_it(RUNGC, ["build", "-q", "a.pmc", "-o", "a.so"], subprocess.DEVNULL)

    def run_it(self, program, words, out):
        self.made += 1
        words = [word.format(n=f"made{self.made}") for word in words]
        return subprocess.run([program, *words], stdin=subprocess.DEVNULL, stdout=out, stderr=subprocess.PIPE, text=True, cwd=self.home,
                              timeout=patience(), env={**os.environ, "HOME": str(self.home)})

    def is_noticed(self, program, words):
        """First that it prints something at all."""
        with self.subTest(words=words), open("/dev/full", "w") as full:
            good = self.run_it(program, words, subprocess.PIPE)
            self.assertNotEqual(good.stdout, "", good.stderr)
            done = self.run_it(program, words, full)
            self.assertEqual(done.returncode, ENVIRONMENT, done.stderr)
            self.assertEqual(re.findall(r"^\S+: cannot write to standard output$", done.stderr, re.MULTILINE), [f"{program.name}: cannot write to standard output"],
                             done.stderr)

    def test_every_command(self):
        listed = re.findall(r"^  rungc (\S+) ", self.run_it(RUNGC, ["help"], subprocess.PIPE).stdout, re.MULTILINE)
        self.assertEqual(sorted(listed), sorted(COMMANDS), "commands without a line in this test")
        for name, words in COMMANDS.items():
            if name != "bind" or (RUNGC.parent / "rung-layout").exists():
                self.is_noticed(RUNGC, [name, *words])

    def test_other_forms_of_commands(self):
        for words in MORE:
            self.is_noticed(RUNGC, words)

    def test_standard_error(self):
        for words in (["check", "none.pmc"], ["explain", "zzqq"], ["build", "none.pmc", "-o", "none.so"], ["check", "a.pmc", "--config", "tmr.1=x"]):
            with self.subTest(words=words), open("/dev/full", "w") as full:
                done = subprocess.run([RUNGC, *words], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=full, cwd=self.home, timeout=patience())
                self.assertEqual(done.returncode, ENVIRONMENT)

    def test_rung_run(self):
        for words in (["--help"], ["--version"], ["--man"]):
            self.is_noticed(RUNG_RUN, words)


if __name__ == "__main__":
    RUNGC, RUNG_RUN = (Path(word).resolve() for word in (sys.argv.pop(1), sys.argv.pop(1)))
    go_to_root()
    unittest.main()
