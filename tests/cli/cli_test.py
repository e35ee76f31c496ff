#!/usr/bin/env python3
"""Runs rungc as a user does: exit statuses, streams, diagnostics, hostile input. cli_test.py RUNGC"""
import json
import os
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

RUNGC = None
OK, WRONG, USAGE, ENVIRONMENT = 0, 1, 2, 3

LAMP = """dialect nct
module MAIN

rung "start/stop latch"
|--[5100.00]--+--[/5100.01]--(5101.00)
|--[5101.00]--+
"""
GSK = "LD X0.0\nFUNC 0\n"  # a network that is not closed, and no END2
TECHNOL_NULL = "DATA\nDATA_END\n" + "".join(
    f"MODULE_{m}\nMODULE_{m}_END\n" for m in ("INPUT", "BLOCK_INIT", "BLOCK_DONE", "MAIN", "INIT", "CLEAR", "HALT")) + "STOP\n"


def rungc(*args, stdin=None, timeout=120):
    return subprocess.run([RUNGC, *args], input=stdin, capture_output=True, timeout=timeout)


class Cli(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def file(self, name, content):
        path = Path(self.folder.name) / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return str(path)

    def survives(self, path, *args, limit=60):
        """A clear error or success within a time that nobody calls a hang."""
        start = time.monotonic()
        done = rungc("check", path, *args)
        self.assertIn(done.returncode, (OK, WRONG), done.stderr[-2000:])
        self.assertLess(time.monotonic() - start, limit)
        if done.returncode == WRONG:
            self.assertIn(b"[", done.stderr, "an error without a code")
        return done


class Statuses(Cli):
    def test_good_program(self):
        done = rungc("check", self.file("lamp.lad", LAMP))
        self.assertEqual(done.returncode, OK, done.stderr)

    def test_wrong_program_names_file_line_and_column(self):
        path = self.file("bad.pmc", GSK)
        done = rungc("check", path)
        self.assertEqual(done.returncode, WRONG)
        self.assertRegex(done.stderr.decode(), rf"{path}:\d+:\d+: error: .* \[[a-z0-9-]+\]")

    def test_wrong_usage(self):
        for args in ([], ["frobnicate"], ["check"], ["build", "x.lad"], ["test", "x.scn", "--engine", "abacus"]):
            self.assertEqual(rungc(*args).returncode, USAGE, args)

    def test_missing_file(self):
        done = rungc("check", str(Path(self.folder.name) / "none.lad"))
        self.assertEqual(done.returncode, ENVIRONMENT)
        self.assertIn(b"none.lad", done.stderr)

    def test_help_everywhere(self):
        for command in ("check", "build", "emit", "run", "test", "profile", "explain", "doc"):
            done = rungc(command, "--help")
            self.assertEqual(done.returncode, OK, command)
            self.assertIn(b"Usage", done.stdout)

    def test_standard_input(self):
        self.assertEqual(rungc("check", "-", "--dialect", "nct", stdin=LAMP.encode()).returncode, OK)
        done = rungc("check", "-", stdin=TECHNOL_NULL.encode())
        self.assertEqual(done.returncode, WRONG, "nothing tells the dialect")
        self.assertIn(b"[", done.stderr)
        self.assertEqual(rungc("check", "-", "--dialect", "technol", stdin=TECHNOL_NULL.encode()).returncode, OK)

    def test_json(self):
        done = rungc("check", self.file("bad.pmc", GSK), "--json")
        self.assertEqual(done.returncode, WRONG)
        entries = json.loads(done.stdout)
        self.assertTrue(entries)
        for entry in entries:
            self.assertLessEqual({"code", "severity", "message", "file", "line", "column"}, set(entry))

    def test_color(self):
        path = self.file("bad.pmc", GSK)
        self.assertIn(b"\x1b[", rungc("check", path, "--color", "always").stderr)
        self.assertNotIn(b"\x1b[", rungc("check", path, "--color", "auto").stderr)

    def test_failing_scenario_names_its_line_and_what_it_read(self):
        self.file("lamp.lad", LAMP)
        scenario = self.file("lamp.scn", "program lamp.lad\nscan\nexpect 5101.00 1\n")
        done = rungc("test", scenario, "--engine", "interp")
        self.assertEqual(done.returncode, WRONG)
        self.assertIn(b"lamp.scn:3: 5101.00 is 0, expected 1", done.stdout)
        self.assertIn(b"0 passed, 1 failed", done.stdout)

    def test_junit(self):
        self.file("lamp.lad", LAMP)
        good = self.file("good.scn", "program lamp.lad\nset 5100.00 1\nscan\nexpect 5101.00 1\n")
        bad = self.file("bad.scn", "program lamp.lad\nscan\nexpect 5101.00 1\n")
        report = str(Path(self.folder.name) / "report.xml")
        self.assertEqual(rungc("test", good, bad, "--engine", "interp", "--junit", report).returncode, WRONG)
        text = Path(report).read_text()
        self.assertIn('tests="2" failures="1" errors="0"', text)


class Products(Cli):
    def test_shared_objects_of_both_ways_do_the_same(self):
        source = self.file("lamp.lad", LAMP)
        outputs = set()
        for via in ("llvm", "cpp"):
            for level in ("-O0", "-O2"):
                out = str(Path(self.folder.name) / f"lamp-{via}{level}.so")
                done = rungc("build", source, "-o", out, "--via", via, level, "-g")
                self.assertEqual(done.returncode, OK, done.stderr)
                done = rungc("run", out, "--scans", "3", "--watch", "5101.00")
                self.assertEqual(done.returncode, OK, done.stderr)
                outputs.add(done.stdout)
        self.assertEqual(len(outputs), 1)

    def test_emit(self):
        source = self.file("lamp.lad", LAMP)
        for what, mark in (("cpp", "rung_program_v1"), ("ir", "rung"), ("llvm", "define"), ("asm", ".text"), ("layout", "space")):
            done = rungc("emit", what, source)
            self.assertEqual(done.returncode, OK, done.stderr)
            self.assertIn(mark, done.stdout.decode())

    def test_unwritable_output(self):
        done = rungc("build", self.file("lamp.lad", LAMP), "-o", "/nonexistent/lamp.so")
        self.assertEqual(done.returncode, ENVIRONMENT)

    def test_a_file_that_is_no_program(self):
        done = rungc("run", self.file("text.so", "not an object"))
        self.assertEqual(done.returncode, ENVIRONMENT)

    def test_run_for_a_time(self):
        done = rungc("run", self.file("lamp.lad", LAMP), "--for", "100ms")
        self.assertEqual(done.returncode, OK, done.stderr)
        self.assertIn(b"10 scans", done.stdout)

    def test_explain_and_doc(self):
        self.assertIn(b"multi-level-output", rungc("explain", "multi-level-output").stdout)
        self.assertIn(b"TOND", rungc("explain", "tond").stdout)
        self.assertEqual(rungc("explain", "no-such-thing").returncode, WRONG)
        for page in ("gsk", "nct", "technol", "diagnostics", "ir"):
            self.assertEqual(rungc("doc", page).returncode, OK, page)
        self.assertEqual(rungc("doc", "klingon").returncode, USAGE)


class HostileInput(Cli):
    def test_unknown_dialect(self):
        done = rungc("check", self.file("lamp.lad", LAMP), "--dialect", "klingon")
        self.assertEqual(done.returncode, WRONG)
        self.assertIn(b"[unknown-dialect]", done.stderr)

    def test_limits_of_sources(self):
        chain = "".join(f"symbol S{i} S{i + 1},#1\n" for i in range(5000))
        done = self.survives(self.file("chain.lad", "dialect nct\n" + chain + "symbol S5000 5100\nmodule MAIN\n"))
        self.assertIn(b"[too-deep]", done.stderr)
        data = TECHNOL_NULL.replace("DATA\n", "DATA\nBIG: DS 10000000\nMORE: DS 10000000\n", 1)
        self.assertIn(b"[too-large]", self.survives(self.file("big.plc", data)).stderr)

    def test_empty_files(self):
        for name in ("empty.lad", "empty.pmc", "empty.plc"):
            self.assertEqual(self.survives(self.file(name, "")).returncode, WRONG)

    def test_binary_junk(self):
        junk = bytes(range(256)) * 64
        for name in ("junk.lad", "junk.pmc", "junk.plc"):
            self.assertEqual(self.survives(self.file(name, junk)).returncode, WRONG)
            with open(RUNGC, "rb") as program:
                self.survives(self.file("elf" + name, program.read(300000)))

    def test_ten_megabytes_in_one_line(self):
        for name, start, piece in (("long.lad", "dialect nct\nmodule MAIN\nrung\n|", "--[5100.00]"), ("long.pmc", "", "LD X0.0 "), ("long.plc", "DATA\n", "LDR A ")):
            self.survives(self.file(name, start + piece * (10_000_000 // len(piece))))

    def test_hundred_thousand_rungs(self):
        ladder = "dialect nct\nmodule MAIN\n" + "".join(f"\nrung\n|--[5100.{i % 32:02}]--[/5101.{i % 32:02}]--{{MOV {5200 + i % 4000} #{i}}}\n" for i in range(100_000))
        self.assertEqual(self.survives(self.file("many.lad", ladder)).returncode, OK)
        listing = "FUNC 0\n" + "".join(f"LD X{i % 128}.0\nOUT R{i % 900}.{i % 8}\n" for i in range(100_000)) + "FUNC 1\n"
        done = self.survives(self.file("many.pmc", listing))
        self.assertEqual(done.returncode, WRONG)
        self.assertIn(b"program-too-large", done.stderr)
        mnemonics = TECHNOL_NULL.replace("DATA\n", "DATA\nCELL: DFM B0,B1,B2,B3,B4,B5,B6,B7\n", 1).replace("MODULE_MAIN\n", "MODULE_MAIN\n" + "LDR B0\nLA B1\nWR B2\n" * 100_000, 1)
        self.assertEqual(self.survives(self.file("many.plc", mnemonics)).returncode, OK)

    def test_deeply_nested_branches(self):
        depth = 1500
        lines = ["|" + "--+" * depth + "--[5100.00]--(5101.00)"]
        for level in range(depth, 0, -1):
            lines.append(" " * (3 * level) + "+--[5100.01]--+" if level == depth else " " * (3 * level) + "+")
        self.survives(self.file("deep.lad", "dialect nct\nmodule MAIN\nrung\n" + "\n".join(lines) + "\n"))
        stack = "FUNC 0\n" + "LD X0.0\n" * 5000 + "ANB\n" * 4999 + "OUT R0.0\nFUNC 1\n"
        self.assertIn(b"stack-overflow", self.survives(self.file("deep.pmc", stack)).stderr)

    def test_an_include_of_itself(self):
        path = self.file("self.plc", "T_INCLUDE self.plc\n" + TECHNOL_NULL)
        self.survives(path)

    def test_the_same_file_twice(self):
        path = self.file("twice.plc", TECHNOL_NULL)
        done = rungc("check", path, path)
        self.assertEqual(done.returncode, WRONG)


if __name__ == "__main__":
    RUNGC = os.path.abspath(sys.argv.pop(1))
    unittest.main()
