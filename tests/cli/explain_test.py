#!/usr/bin/env python3
"""rungc explain FILE:LINE:COLUMN: what is written at a place. explain_test.py RUNGC"""
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from patience import patience
from root import go_to_root

RUNGC = None

NCT = """dialect nct
module MAIN
symbol START 7000.00 ; green button
const LIMIT #10
rung "a switch"
|--[START]--[7000.01,IDX]--(7001.00)
symbol IDX 7010
rung
|--[7001.00]--{MOV 7020 LIMIT}
rung
|--[START]--{JMP #1}
rung
|--{JME #1}
rung
|--{END}
"""
TECHNOL = """DATA
        DFM  BIT,IN
DATA_END
MODULE_INPUT
MODULE_INPUT_END
MODULE_MAIN
        MECH_BEGIN WAIT
        LDR  IN
        FL   1,BIT
        LOD  CNST.40h
        EX
        LDR  IN
        TEX1 -,25,DONE,1
DONE:   MECH_END WAIT
MODULE_MAIN_END
""" + "".join(f"MODULE_{name}\nMODULE_{name}_END\n" for name in ("BLOCK_INIT", "BLOCK_DONE", "INIT", "CLEAR", "HALT")) + "STOP\n"
ERRORS = "\nThe program has errors, so what its rungs do is not known: `rungc check` lists the errors.\n"


class ExplainPlace(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.path = Path(self.folder.name) / "p.lad"
        self.path.write_text(NCT)

    def explain(self, line, column, status=0):
        done = subprocess.run([RUNGC, "explain", f"{self.path}:{line}:{column}"], capture_output=True, text=True, timeout=patience(), check=False)
        self.assertEqual(done.returncode, status, done.stderr)
        return (done.stdout + done.stderr).replace(str(self.path), "p.lad")

    def test_operand(self):
        self.assertEqual(self.explain(6, 5), """START: read here
  green button
  declared at p.lad:3:8

START (7000.00): read, but written by no rung
  written  –
  read     rung 1 "a switch", p.lad:5
           rung 3, p.lad:10
  perhaps  read by rung 1 "a switch", p.lad:5, as 7000.01, indexed
""")

    def test_index(self):
        self.assertTrue(self.explain(6, 14).startswith("7000.01,IDX: read here, with ',IDX' added at run time\n"))

    def test_declaration(self):
        self.assertIn("START: bit\n  green button\n  declared at p.lad:3:8\n", self.explain(3, 8))

    def test_constant(self):
        self.assertEqual(self.explain(9, 25), "LIMIT: #10\n  declared at p.lad:4:7\n")

    def test_label(self):
        self.assertEqual(self.explain(11, 18), "#1: control goes there\n  asked at p.lad:11:18\n  is at   p.lad:13:9\n")

    def test_word(self):
        self.assertTrue(self.explain(9, 16).startswith("[nct] MOV:"), "the mnemonic")

    def test_what_is_not_a_word(self):
        """It is said to be that; nothing is searched."""
        self.path.write_text(NCT.replace("(7001.00)\nsymbol", "(7001.00) ; and a remark\nsymbol"))
        for line, column, what in ((5, 9, "the title of a rung"), (3, 26, "a comment"), (6, 40, "a comment"), (3, 7, "a blank"), (6, 3, "a wire"),
                                   (6, 1, "a wire"), (6, 12, "a wire")):
            self.assertEqual(self.explain(line, column), what + "\n", f"{line}:{column}")
        self.assertEqual(self.explain(6, 4), "'[': nothing by itself; name the place of what is beside it\n")

    def test_keywords_marks_and_constants(self):
        self.path.write_text(NCT.replace("--[START]--{JMP", "--[/START]--{JMP").replace("[7001.00]--{MOV 7020 LIMIT}", "[7001.00]--+--{MOV 7020 #5}\n              +--(S 7003.00)"))
        for line, column, what in ((1, 1, "dialect: the control that the program is for; the first statement of a file"), (1, 9, "nct: the control that the program is for"),
                                   (2, 1, "module: begins a module, which ends where the next one begins"), (2, 8, "MAIN: the name of the module"),
                                   (3, 2, "symbol: gives an address a name"), (4, 1, "const: gives a constant a name"), (4, 13, "'#10': a constant"),
                                   (5, 2, "rung: begins a rung; its text is the rung's title"), (9, 28, "'#5': a constant"),
                                   (10, 19, "'S': the coil sets its bit, and leaves it without power"), (12, 5, "'/': the contact is normally closed")):
            self.assertEqual(self.explain(line, column).splitlines()[0], what, f"{line}:{column}")
        self.assertIn("\nSTART: read here\n", self.explain(12, 5), "the operand behind the mark, too")
        self.assertTrue(self.explain(3, 14).startswith("7000.00 is START: bit\n"), "an address has its name")

    def test_words_of_lists(self):
        for name, text, places in (("p.pmc", "LD X0.0\nFUNC 17\nPRM 1\nOUT R0.0\nFUNC END1\nFUNC END2\n",
                                    ((2, 1, "[gsk] FUNC: "), (2, 6, "[gsk] "), (3, 1, "[gsk] PRM: "), (3, 5, "'1': a constant"), (5, 6, "[gsk] END1 "), (1, 4, "X0.0: read here"))),
                                   ("p.plc", TECHNOL, ((1, 1, "[technol] DATA: "), (9, 14, "'1': a constant"), (9, 16, "BIT: written here"), (10, 14, "'CNST.40h': a constant"),
                                                       (13, 14, "'-': nothing is given here"), (14, 18, "WAIT: bit"), (9, 15, "',': nothing by itself; name the place of what is beside it")))):
            self.path = Path(self.folder.name) / name
            self.path.write_text(text)
            for line, column, what in places:
                self.assertTrue(self.explain(line, column).startswith(what), f"{name}:{line}:{column}: {self.explain(line, column)}")

    def test_a_mnemonic_is_that_of_the_dialect(self):
        path = Path(self.folder.name) / "p.pmc"
        path.write_text("dialect gsk\n        LD X0.0 ; a remark\n        OUT Y0.0\n        FUNC END1\n        FUNC END2\n")
        self.path = path
        text = self.explain(2, 9)
        self.assertIn("[gsk] LD", text)
        self.assertNotIn("[technol]", text)
        self.assertEqual(self.explain(2, 22), "a comment\n")

    def test_a_function_by_its_number(self):
        path = Path(self.folder.name) / "p.pmc"
        path.write_text("FUNC 0\nLD X0.0\nFUNC 35\nPRM 0\nFUNC 36\nFUNC 1\n")
        self.path = path
        self.assertTrue(self.explain(3, 6).startswith("[gsk] JMP (function 35): jump over a region\n"))

    def test_immediate_operand(self):
        self.path.write_text("dialect nct\nmodule INT0\nsymbol PRB INP000.05\nrung\n|--[!PRB]--(7000.00)\nmodule MAIN\nrung\n|--[7000.00]--[PRB]--(7000.01)\n")
        text = self.explain(5, 6)
        self.assertTrue(text.startswith("!PRB: read here\n"), text)
        self.assertIn("rung 1, p.lad:4, as !", text)
        self.assertIn("rung 2, p.lad:7\n", text)

    def test_program_with_errors(self):
        self.path.write_text(NCT.replace("[7001.00]", "[NOBODY]"))
        self.assertEqual(self.explain(6, 5), "START: read here\n  green button\n  declared at p.lad:3:8\n  symbol START 7000.00 ; green button\n" + ERRORS)

    def test_byte_order_mark(self):
        """It is nothing by itself: what follows it is explained, in the first column, too."""
        self.path.write_bytes(b"\xef\xbb\xbf" + NCT.encode())
        for column in (1, 2, 8):
            self.assertTrue(self.explain(1, column).startswith("dialect: the control"), self.explain(1, column))
        self.path.write_bytes(b"\xef\xbb\xbf")
        self.assertNotIn("neither a name", self.explain(1, 1, status=1))

    def test_included_file(self):
        """A file that a project includes is a part of its program."""
        self.path = Path("examples/technol-machining-centre/centre.inc")
        self.assertTrue(self.explain(6, 9).startswith("[technol] EQUI"), self.explain(6, 9))
        self.assertTrue(self.explain(6, 14).startswith("T_DRIVES: "), self.explain(6, 14))

    def test_a_bit_that_there_is_not(self):
        self.path.write_text("dialect nct\nmodule MAIN\nrung\n|--[INP000.32]--(7000.00)\nrung\n|--{END}\n")
        self.assertTrue(self.explain(4, 5).startswith("error here: "), self.explain(4, 5))

    def test_an_index_into_another_signal(self):
        self.path.write_text("dialect nct\nmodule MAIN\nrung\n|--[N_ON]--{MOV OUT000,#1 #5}\nrung\n|--{END}\n")
        text = self.explain(4, 18)
        self.assertIn("  24V interface outputs, DWORD 1: ", text)
        self.assertNotIn("DWORD 0", text)

    def test_nothing_there(self):
        self.assertIn("has nothing in line 99, column 1", self.explain(99, 1, status=2))
        self.assertIn("has nothing in line 1, column 50", self.explain(1, 50, status=2))


class ExplainName(unittest.TestCase):
    """Names of the project that the working directory belongs to."""

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        (Path(self.folder.name) / "p.lad").write_text(NCT.replace("START", "PUMP_RUN"))
        (Path(self.folder.name) / "rung.toml").write_text('name = "p"\ndialect = "nct"\nfiles = ["p.lad"]\n')

    def explain(self, *words, status=0, cwd=None):
        done = subprocess.run([Path(RUNGC).resolve(), "explain", *words], capture_output=True, text=True, timeout=patience(), check=False,
                              cwd=cwd or self.folder.name)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done.stdout + done.stderr

    WHOLE = """PUMP_RUN: bit
  green button
  declared at p.lad:3:8

PUMP_RUN (7000.00)
  written  –
  read     rung 1 "a switch", p.lad:5
           rung 3, p.lad:10
  perhaps  read by rung 1 "a switch", p.lad:5, as 7000.01, indexed
"""

    def test_name(self):
        self.assertEqual(self.explain("PUMP_RUN").replace(": read, but written by no rung", ""), self.WHOLE)
        self.assertEqual(self.explain("pump_run"), self.explain("PUMP_RUN"))
        self.assertIn("PUMP_RUN: bit\n", self.explain("PUMP_RUN", "--project", self.folder.name, cwd="/"))
        self.assertEqual(self.explain("LIMIT"), "LIMIT: #10\n  declared at p.lad:4:7\n")

    def test_part_of_a_name(self):
        self.assertRegex(self.explain("PUMP"), r"(?m)^  PUMP_RUN +name in .*rung.toml +green button$")

    def test_names_do_not_hide_the_reference(self):
        self.assertTrue(self.explain("MOV").startswith("[nct] MOV"))

    def test_program_with_errors(self):
        path = Path(self.folder.name) / "p.lad"
        path.write_text(path.read_text().replace("[7001.00]", "[NOBODY]"))
        self.assertEqual(self.explain("PUMP_RUN"), "PUMP_RUN: bit\n  green button\n  declared at p.lad:3:8\n  symbol PUMP_RUN 7000.00 ; green button\n" + ERRORS)
        self.assertIn("rungc: the program of the project has errors, so its addresses are not known: `rungc check` lists the errors\n", self.explain("7000.00", status=1))

    def test_address(self):
        text = self.explain("7000.00")
        self.assertEqual(text.splitlines()[0], "7000.00 is PUMP_RUN: bit")
        self.assertEqual(text.split("\n", 1)[1], self.explain("PUMP_RUN").split("\n", 1)[1], "the rest is what the name has")
        self.assertIn("\n  written  rung 1", self.explain("7001.00"), "an address without a name")
        self.assertIn("'7999.00' is not known", self.explain("7999.00", status=1), "the program does not use it")

    def test_without_a_project(self):
        with tempfile.TemporaryDirectory() as empty:
            self.assertIn("'PUMP_RUN' is not known", self.explain("PUMP_RUN", status=1, cwd=empty))
            self.assertIn("has no rung.toml", self.explain("MOV", "--project", empty, status=1))


class ExplainWord(unittest.TestCase):
    def explain(self, word):
        return subprocess.run([RUNGC, "explain", word], capture_output=True, text=True, timeout=patience(), check=True).stdout

    def test_hits_are_whole_sentences(self):
        text = self.explain("lamp")
        self.assertIn("panel lamp: USER1 (X0.7 is hand-wheel trial cutting; Y6.7 is USR1 as well)", " ".join(text.split()))
        self.assertRegex(self.explain("param"), r"(?s)param\.N +gsk configuration +parameter N; `param\.N\.A`.*?first\.")

    def test_kinds_of_operands(self):
        self.assertIn("format-a", self.explain("COIN"))
        self.assertIn("[gsk] kind of operands format-a\n", self.explain("format-a"))

    def test_nothing_that_only_a_manual_has(self):
        for word in ("COIN", "CTR", "overtravel", "HB_B12", "SET"):
            self.assertNotRegex(self.explain(word), r"\bl\.\d|\(P\d+\)", word)
        self.assertIn("Manual: 5.19.\n", self.explain("COIN"))

    def test_part_of_a_signal(self):
        self.assertTrue(self.explain("INP000.32").startswith("[nct] INP000.32: there is no bit 32; a double word has the bits 00 to 31\n"))
        self.assertTrue(self.explain("INP000.31").startswith("[nct] INP000: "))
        self.assertTrue(self.explain("OUT000,#1").startswith("[nct] OUT000,#1 is OUT010: 24V interface outputs, DWORD 1"))

    def test_ranges_once(self):
        self.assertNotRegex(self.explain("CNT"), r"0…2147483647 +0 to 2147483647")


if __name__ == "__main__":
    go_to_root()
    RUNGC = sys.argv.pop(1)
    unittest.main()
