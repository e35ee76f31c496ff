#!/usr/bin/env python3
"""FANUC programs of real machines: fanuc_programs_test.py BIN

Needs FANUC_PROGRAMS (README.md). What a program consists of is told by a reader that shares nothing with the compiler
(tools/bench/real/ladder.py); what it does, by the straight-line C++ that is written from that.
"""
import collections
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path += [str(ROOT / "tools/bench/real"), str(ROOT / "tools/bench")]
import ladder  # noqa: E402
import programs  # noqa: E402
import real  # noqa: E402

BIN = None
SCANS = 10_000
SEEDS = (1, 2, 3)
TIMERS = {"TMR": "duplicate-timer", "TMRB": "duplicate-timer", "CTR": "duplicate-counter", "CTRB": "duplicate-counter"}
BROWSER = ("chromium", "--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
           "--disable-background-networking", "--disable-component-update", "--virtual-time-budget=60000", "--dump-dom")


def run(*words, status=0):
    done = subprocess.run([str(word) for word in words], capture_output=True, check=False, timeout=3000)
    if done.returncode != status:
        raise AssertionError(f"{' '.join(map(str, words))} ended with {done.returncode}:\n{done.stderr.decode()[-2000:]}")
    return done.stdout


def rungc(command, *words):
    return run(BIN / "rungc", command, *words)


def parts_of(files):
    read = ladder.read(files)
    return [*read.levels.values(), *read.subprograms.values()]


def statements(files):
    """Contacts, coils and functions in their order, with addresses in the place of symbols."""
    return [[(each.word, each.operands) for each in part] for part in parts_of(files)]


def counts(files):
    kinds = collections.Counter()
    for each in (each for part in parts_of(files) for each in part):
        kinds["function" if each.is_function else "coil" if each.word in ladder.COILS else "contact"] += each.word not in ladder.STACK
    return kinds


def used_again(files):
    """How often a number of a timer or counter, or of an edge, is used once more."""
    seen, again = set(), collections.Counter()
    for each in (each for part in parts_of(files) for each in part if each.is_function):
        code = TIMERS.get(each.word, "duplicate-edge-number" if each.word in ("DIFU", "DIFD") else None)
        if code is None or each.operands[0] == 0:
            continue
        key = (code if code == "duplicate-edge-number" else each.word, each.operands[0])
        again[code] += key in seen
        seen.add(key)
    return +again


def module(files):
    """The lines of its IR but for the first one, which names it after its file."""
    return run(BIN / "tests/rung_fanuc_module", *files).decode().splitlines()[1:]


def each_program(test):
    """Runs the test with the files of each program."""
    def run_all(self):
        for name, files in self.files.items():
            with self.subTest(name):
                test(self, files)
    return run_all


class Programs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.made = tempfile.TemporaryDirectory()
        cls.folder = Path(cls.made.name)
        cls.files = programs.extract(cls.folder)

    @classmethod
    def tearDownClass(cls):
        cls.made.cleanup()

    def same(self, found, expected):
        """Lists of which one difference is enough: a diff of a hundred thousand lines takes minutes."""
        for one, other in zip(found, expected):
            self.assertEqual(one, other)
        self.assertEqual(len(found), len(expected))

    def converted(self, files, form, name):
        target = self.folder / f"{files[-1].stem}-{name}"
        rungc("convert", "--no-project", "-q", "--to", form, "-o", target, *files)
        return [target]

    def test_are_whole(self):
        self.assertEqual(len(self.files), 9)
        total = sum((counts(files) for files in self.files.values()), collections.Counter())
        self.assertGreater(total["contact"], 150_000)
        self.assertGreater(total["coil"], 50_000)
        self.assertGreater(total["function"], 20_000)

    @each_program
    def test_have_no_errors_and_the_warnings_of_their_numbers(self, files):
        said = json.loads(rungc("check", "--no-project", "--json", *files))
        self.assertEqual([one for one in said if one["severity"] == "error"], [])
        found = collections.Counter(one["code"] for one in said if one["code"].startswith("duplicate-"))
        self.assertEqual(dict(found), dict(used_again(files)))

    @each_program
    def test_are_the_same_as_ladder_text_and_back(self, files):
        drawn = self.converted(files, "ladder", "drawn.lad")
        self.same(module(drawn), module(files))
        back = self.converted(drawn, "list", "back.mne")
        self.same(module(back), module(files))
        self.same(statements(back), statements(files))

    @each_program
    def test_are_formatted_once(self, files):
        copies = [Path(shutil.copy(file, self.folder / f"formatted-{file.name}")) for file in files]
        rungc("format", "-q", *copies)
        rungc("format", "--check", *copies)
        self.same(statements(copies), statements(files))
        self.same(module(copies), module(files))

    @each_program
    def test_do_the_same_on_all_engines(self, files):
        run(BIN / "tests/rung_fanuc_engines", SCANS, 1, *files)

    @each_program
    def test_do_what_straight_line_code_does(self, files):
        program, reference = self.folder / "program.so", self.folder / "straight.so"
        rungc("build", "--no-project", "-q", "-o", program, *files)
        real.build_straight(files, reference)
        for seed in SEEDS:
            run(BIN / "rung-bench-real", program, reference, seed, SCANS)

    @each_program
    def test_are_drawn(self, files):
        page = self.folder / "page.html"
        rungc("view", "--no-project", "-q", "-o", page, *files)
        shown = run(*BROWSER, page.as_uri()).decode()
        rungs = re.search(r"(\d+) rungs", rungc("check", "--no-project", *files).decode())[1]
        self.assertEqual(len(set(re.findall(r' id="r(\d+)"', shown))), int(rungs))


if __name__ == "__main__":
    if programs.folder() is None:
        sys.exit("FANUC_PROGRAMS is not set: tests/fanuc-programs/README.md says what it names")
    BIN = Path(sys.argv.pop(1)).resolve()
    os.environ["LD_LIBRARY_PATH"] = str(BIN.parent / "lib")
    unittest.main()
