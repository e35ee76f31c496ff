#!/usr/bin/env python3
"""rungc import as a user sees it: recognition, options, and what is made, run. import_test.py RUNGC

A GSK has the addresses and the slots of a FANUC PMC, so its template is the program that what is made is tried on."""
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from patience import patience

RUNGC = None
OK, WRONG, USAGE, ENVIRONMENT = 0, 1, 2, 3
PARAMETERS = "%\n(PMC=0I-F,MSID=1)\nN600000 P6\nN620005 P10000001\nN640000 P300\nN640002 P5\n%\n"
SYMBOLS = "START,X0010.0,Grüner Knopf\n"
SIGNALS = "PMC SIGNAL DATA\nSET,0,(STOP,1,BIT),(X10.2,1,BIT)\nSET,100,(START,1,BIT)\nSET,50,(D100,300,WORD)\n"
NAMES = ("X10.0", "X10.1", "X10.2", "Y8.0", "Y8.1", "A0.0") # START, STOP, MOTOR_OK; PUMP, LAMP, the message


class Import(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.home = Path(folder.name)

    def rungc(self, *words, status=OK, stdin=""):
        done = subprocess.run([RUNGC, *map(str, words)], cwd=self.home, capture_output=True, text=True, input=stdin, timeout=patience(120))
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done.stdout, done.stderr

    def file(self, name, contents):
        path = self.home / name
        path.write_bytes(contents if isinstance(contents, bytes) else contents.encode())
        return name

    def project(self):
        self.rungc("new", "gsk", ".")

    def trace(self, period=8, shift=0):
        """What the template does in 3.5 s, slot by slot, as a control would have traced it; the buttons are pressed
        `shift` slots later."""
        lines = ["set STOP 1", "set MOTOR_OK 1"]
        for slot in range(440):
            lines += {10 + shift: ["set START 1"], 20 + shift: ["set START 0"], 350 + shift: ["set STOP 0"]}.get(slot, [])
            lines += ["slot", "print " + " ".join(NAMES)]
        out, _ = self.rungc("run", "-i", "--config", f"period_us={period * 1000}", stdin="\n".join(lines) + "\n")
        values = re.findall(r" = (\d)", out)
        rows = [values[i:i + len(NAMES)] for i in range(0, len(values), len(NAMES))]
        self.assertEqual(len(rows), 440)
        return [f"{number - 10},{','.join(row)}" for number, row in enumerate(rows)]

    def traced(self, rows):
        return self.file("trace.csv", "\r\n".join(["Mode,TIME CYCLE", "Data," + ",".join(NAMES), *rows, ""]))

    def test_a_remark_shows_the_beginning_of_a_long_line(self):
        for name, contents, shown in (("p.txt", "%\nN600000 P" + 3_000_000 * "1" + "\n%\n", "the value is '111"),
                                      ("s.csv", "START,X0010.0,\nSTOP," + 3_000_000 * "y" + ",\n", "found 'yyy")):
            said = self.rungc("import", self.file(name, contents), status=WRONG)[1]
            self.assertIn(shown, said)
            self.assertLess(len(said), 1000)

    def test_each_kind_is_recognised_by_its_contents(self):
        for text, begin in ((PARAMETERS, "# Made by rungc import from f"), (SYMBOLS, "; Made by rungc import from f"),
                            (SIGNALS, "# Made by rungc import from f: a signal operation file")):
            with self.subTest(text=text):
                out, _ = self.rungc("import", self.file("f", text))
                self.assertTrue(out.startswith(begin), out)
                said = "; name it in `files` of rung.toml" if text == SYMBOLS else ""
                self.assertEqual(self.rungc("import", "f", "-o", "made")[0], f"wrote made{said}\n")
                self.assertEqual((self.home / "made").read_text(), out)

    def test_encodings(self):
        expected = "START,X0010.0,Grüner Knopf\n"
        for encoding in ("utf-8", "latin-1", "utf-16-le", "utf-16", "utf-8-sig"):
            with self.subTest(encoding=encoding):
                self.assertIn(expected, self.rungc("import", self.file("f", SYMBOLS.encode(encoding)))[0])
        named = self.file("f", "START,X10.0,始動\n".encode("shift_jis"))
        self.assertIn("始動", self.rungc("import", named, "--encoding", "shift_jis")[0])
        self.assertIn("is not utf-8 (byte", self.rungc("import", named, "--encoding", "utf-8", status=WRONG)[1])
        self.assertIn("unknown encoding 'klingon'", self.rungc("import", named, "--encoding", "klingon", status=USAGE)[1])

    def test_other_files_are_named(self):
        for contents, said in ((b"\1\0\2\0LEVEL1.#LR\0\0", "a LADDER-III project (.LAD)"), (b"PMC\0\0\3\xff\x10", "memory card file"),
                               (b"%\nO1234\nG0 X0\n", "a part program"), (b"LD X0.0\nFUNC END1\n", "a command list of a GSK control"),
                               (b"%@3\nRD X0.0\n%\n", "a file of a program, as it has sections"), (b"hello\n", "is not recognised; --as says")):
            with self.subTest(contents=contents):
                out, err = self.rungc("import", self.file("f", contents), "-o", "made", status=WRONG)
                self.assertEqual((out, (self.home / "made").exists()), ("", False))
                self.assertRegex(err, r"^rungc: 'f' is ")
                self.assertIn(said, err)
        self.assertIn("'f' is a ZIP archive", self.rungc("import", self.file("f", b"PK\3\4"), "--as", "trace", status=WRONG)[1])
        self.assertIn("cannot read 'none'", self.rungc("import", "none", status=ENVIRONMENT)[1])

    def test_a_file_with_mistakes_makes_nothing(self):
        name = self.file("f.csv", "START,X10.0\nSTOP,X10.9\n")
        out, err = self.rungc("import", name, "-o", "made", status=WRONG)
        self.assertEqual((out, err, (self.home / "made").exists()),
                         ("", "f.csv:2:6: error: found 'X10.9', expected an address such as X8.4, D100 or P12\n", False))
        _, err = self.rungc("import", self.file("f.csv", "A,X10.0\n" + "B\n" * 300), status=WRONG)
        self.assertEqual(len(err.splitlines()), 201)
        self.assertIn("100 more are not shown", err)

    def test_options_of_a_trace(self):
        trace = self.file("t.csv", "Data,X10.0,Y8.0\n0,0,0\n1,0,0\n")
        self.assertIn("a trace needs --sampling TIME", self.rungc("import", trace, status=USAGE)[1])
        for wrong in ("0ms", "8", "2min"):
            self.assertIn(f"--sampling '{wrong}'", self.rungc("import", trace, "--sampling", wrong, status=USAGE)[1])
        self.assertIn("--settle '2'", self.rungc("import", trace, "--sampling", "8ms", "--settle", "2", status=USAGE)[1])
        self.assertIn("are for a trace", self.rungc("import", self.file("s.csv", SIGNALS), "--sampling", "8ms", status=USAGE)[1])
        self.assertIn("slot 3\n", self.rungc("import", trace, "--sampling", "24ms")[0])
        self.assertIn("set Y8.0 0\nslot 125\n", self.rungc("import", trace, "--sampling", "8ms", "--settle", "1s")[0])

    def test_parameters_are_taken_by_scenarios_and_retained_memory(self):
        self.project()
        self.rungc("import", self.file("PMC1_PRM.TXT", PARAMETERS), "-o", "machine.part")
        self.file("values.scn", "include machine.part\nscan\nexpect T0:2 6\nexpect K5 0x81\nexpect D0:2 300\nexpect D2:2 5\n")
        self.rungc("test", "values.scn")
        out, _ = self.rungc("run", "-i", "--retain", "kept", stdin=(self.home / "machine.part").read_text())
        self.assertIn("\nwrote kept.a, kept.b\n", out)
        out, _ = self.rungc("run", "-i", "--retain", "kept", stdin="print T0:2 K5 D0:2\n")
        self.assertRegex(out, r"T0:2 = 6 .*K5 = 129 .*D0:2 = 300 ")

    def test_a_signal_operation_file_is_a_scenario(self):
        self.project()
        made, _ = self.rungc("import", self.file("s.csv", SIGNALS))
        self.file("s.scn", made + "expect PUMP 1\nexpect D100:2 300\n")
        self.rungc("test", "s.scn")

    def test_the_trace_of_a_program_is_a_test_that_it_passes(self):
        self.project()
        rows = self.trace()
        _, err = self.rungc("import", self.traced(rows), "--sampling", "8ms", "-o", "trace.scn")
        self.assertRegex(err, r"^trace\.csv:2:24: note: Y8\.0 is expected in 4\d\d of 440 frames; the others are within 1 frame of a change")
        self.rungc("test", "trace.scn")

    def test_the_trace_of_another_program_is_a_test_that_fails(self):
        self.project()
        rows = self.trace()
        self.assertTrue(rows[300].endswith(",1,1,0"))
        rows[300:303] = [row[:-3] + "0" + row[-2:] for row in rows[300:303]] # the lamp is off for three frames
        self.rungc("import", self.traced(rows), "--sampling", "8ms", "-o", "trace.scn")
        out, _ = self.rungc("test", "trace.scn", status=WRONG)
        self.assertRegex(out, r"trace\.scn:\d+: Y8\.1 is 1, expected 0 \(scan 301,")

    def test_a_longer_cycle_needs_more_tolerance(self):
        """Level 2 in three parts: the cycle of the machine began at another slot than that of the scenario."""
        self.project()
        toml = self.home / "rung.toml"
        toml.write_text(toml.read_text() + 'period_us = "24000"\n')
        failed = 0
        for shift in range(3):
            rows = self.trace(24, shift)
            self.rungc("import", self.traced(rows[2:]), "--sampling", "8ms", "--tolerance", "3", "-o", "trace.scn")
            self.rungc("test", "trace.scn")
            self.rungc("import", self.traced(rows[2:]), "--sampling", "8ms", "--tolerance", "0", "-o", "strict.scn")
            done = subprocess.run([RUNGC, "test", "strict.scn"], cwd=self.home, capture_output=True, timeout=patience(120))
            failed += done.returncode == WRONG
        self.assertGreater(failed, 0)


if __name__ == "__main__":
    RUNGC = str(Path(sys.argv.pop(1)).resolve())
    unittest.main()
