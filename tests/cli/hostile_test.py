#!/usr/bin/env python3
"""Sources and other files that are no files, are too deep or grow without end: an error, soon. hostile_test.py RUNGC"""
import os
import re
import resource
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from patience import patience
from root import go_to_root

RUNGC = None
OK, WRONG, USAGE, ENVIRONMENT = 0, 1, 2, 3
MOST_MEMORY = 4 << 30
HEAD = """DATA
BITS: DFM A,B,,,,,,
DATA_END
MODULE_INPUT
MODULE_INPUT_END
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
"""


class Hostile(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.home = Path(folder.name)

    def file(self, name, text):
        (self.home / name).write_text(text)
        return self.home / name

    def technol(self, name, body, before=""):
        return self.file(name, f"{before}{HEAD}MODULE_MAIN\n{body}MODULE_MAIN_END\nSTOP\n")

    def rungc(self, *words):
        # Instrumented programs reserve more than that.
        limit = None if os.environ.get("ASAN_OPTIONS") else lambda: resource.setrlimit(resource.RLIMIT_AS, (MOST_MEMORY,) * 2)
        done = subprocess.run([RUNGC, *map(str, words)], capture_output=True, text=True, preexec_fn=limit, timeout=patience(60),
                              stdin=subprocess.DEVNULL)
        return done.returncode, done.stdout + done.stderr

    def expect_error(self, words, status, *texts):
        found, said = self.rungc(*words)
        self.assertEqual(found, status, said[:2000])
        for text in texts:
            self.assertIn(text, said[:20000])

    # ---- what is no file

    def no_files(self):
        pipe = self.home / "pipe"
        os.mkfifo(pipe)
        yield "/dev/zero", "it is not a regular file"
        yield pipe, "it is not a regular file"
        huge = self.home / "huge"
        with open(huge, "w") as file:
            file.truncate(1 << 36)
        yield huge, "it has more than "

    def test_what_is_no_file_is_read_nowhere(self):
        program = self.technol("good.plc", " LDR A\n WR B\n")
        for path, text in self.no_files():
            for words in (["check", path], ["build", path, "-o", self.home / "x.so"], ["run", path], ["test", path],
                          ["format", path], ["diff", path, program], ["diff", program, path], ["xref", path],
                          ["view", path, "-o", self.home / "x.html"], ["map", program, "--check", path]):
                with self.subTest(words=words):
                    self.expect_error(words, ENVIRONMENT, text)
            if path != self.home / "huge":
                self.expect_error(["seal", path], ENVIRONMENT, text)
            included = self.technol("includes.plc", " LDR A\n WR B\n", f"T_INCLUDE {path}\n")
            self.expect_error(["check", included], WRONG, text)
            self.expect_error(["check", program, "--config", f"plc_errors={path}"], WRONG, "")

    # ---- depth

    def test_names_do_nothing_to_a_terminal(self):
        name = "\x1b[2J\nall is well.pmc"
        shown = "\\x1b[2J\\x0aall is well.pmc"
        self.file(name, "dialect gsk\nOUT NOWHERE\n")
        self.expect_error(["check", self.home / name], WRONG, f"{shown}:2:5: error: ")
        self.expect_error(["check", self.home / ("no" + name)], ENVIRONMENT, "no\\x1b[2J")

    def test_brackets(self):
        for depth in (1000, 50_000, 200_000):
            program = self.technol("deep.plc", f" LDR {'(' * depth}A{')' * depth}\n WR B\n")
            self.expect_error(["check", program], WRONG, "brackets nested more than 100 deep [too-deep]")

    def test_keys_of_many_parts(self):
        key = "a." * 100_000 + "b"
        program = self.technol("good.plc", " LDR A\n WR B\n")
        for number, text in enumerate((f"[{key}]\nx = 1\n", f"[in]\n{key} = 1\n", f"[in]\nx = {{ {key} = 1 }}\n")):
            with self.subTest(number):
                self.expect_error(["map", program, "--check", self.file("deep.map", text)], WRONG, "a key has more than 64 parts")
                self.expect_error(["check", self.file("rung.toml", text)], WRONG, "a key has more than 64 parts")
        (self.home / "rung.toml").unlink()
        good = self.file("good.map", '[in]\na = { type = "bit", name = "A" } # "..." ' + "." * 100 + "\nb = { type = 'bit', name = \"A\\u002e" + "." * 100 + '" }\n')
        found, said = self.rungc("map", program, "--check", good)
        self.assertEqual((found, said.count("good.map:")), (WRONG, 1), said)

    def test_control_characters_in_toml(self):
        program = self.technol("good.plc", " LDR A\n WR B\n")
        for text in ('[in]\na = { type = "bit", name = "A\\u0000.1" }\n', '[in]\n"a\\u0000b" = { type = "bit", name = "A" }\n', 'x = [["\\u001b"]]\n'):
            with self.subTest(text):
                line = text.count("\n")
                self.expect_error(["map", "--no-project", program, "--check", self.file("base.map", text)], WRONG, f"base.map:{line}:", "holds a control character")
                self.expect_error(["check", self.file("rung.toml", text)], WRONG, f"rung.toml:{line}:", "holds a control character")
        (self.home / "rung.toml").unlink()

    def test_numbers_with_a_comment_inside(self):
        program = self.technol("good.plc", " LDR A\n WR B\n")
        self.expect_error(["map", program, "--check", self.file("base.map", "timeout = 16#20\n")], WRONG, "write 0x20 for 16#20")

    # ---- growth

    def test_macros_of_macros(self):
        macros = "".join(f"DEF_T_MACRO M{i}\n" + f" M{i + 1}\n" * 10 + "END_T_MACRO\n" for i in range(9))
        macros += "DEF_T_MACRO M9\n LDR A\n WR B\nEND_T_MACRO\n"
        self.expect_error(["check", self.technol("grows.plc", " M0\n", macros)], WRONG, "too many lines of macros: at most ")

    def test_files_that_include_others_twice(self):
        for i in range(30):
            self.file(f"x{i}.inc", f"T_INCLUDE x{i + 1}.inc\n" * 2)
        self.file("x30.inc", "; nothing\n")
        self.expect_error(["check", self.technol("includes.plc", " LDR A\n WR B\n", "T_INCLUDE x0.inc\n")], WRONG, "[too-")

    # ---- what is long

    def test_lines_of_contacts(self):
        """Names that come again and again, and negated ones: what compilers of chains take the square of their length for."""
        def line(negated, coil):
            names = (f"{5200 + i % 2000 // 15}.{i % 2000 % 15:02}" for i in range(5000))
            return "|" + "".join(f"--[{'/' if negated(i) else ''}{name}]" for i, name in enumerate(names)) + f"--({coil})\n"
        ladder = self.file("line.lad", "dialect nct\nmodule MAIN\n\nrung \"never\"\n" + line(lambda i: i % 7 == 3, "5100.00")
                           + "\nrung \"always\"\n" + line(lambda i: True, "5100.01"))
        for engine in ("interp", "jit", "llvm", "cpp"):
            with self.subTest(engine):
                found, said = self.rungc("run", ladder, "--engine", engine, "--scans", "2", "--watch", "5100.00", "5100.01")
                self.assertEqual((found, *re.findall(r"5100.0\d = \d", said)), (OK, "5100.00 = 0", "5100.01 = 1"), said[:2000])


if __name__ == "__main__":
    go_to_root()
    RUNGC = sys.argv.pop(1)
    unittest.main()
