#!/usr/bin/env python3
"""rungc diff as a user sees it: what rungs do otherwise, not what lines are. diff_test.py RUNGC"""
import json
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from patience import patience
from root import go_to_root

RUNGC = None
SAME, OTHERWISE, USAGE = 0, 1, 2

HEAD = "dialect nct\nmodule MAIN\nsymbol START 7000.00\nsymbol MOTOR 7001.00\nsymbol LAMP 7001.01\n"
ONE = '\nrung "motor"\n|--[START]--(MOTOR)\n'
TWO = '\nrung "lamp"\n|--[MOTOR]--(LAMP)\n'
THREE = '\nrung\n|--[/START]--(7002.00)\n'
END = "\nrung\n|--{END}\n"


class Diff(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def file(self, name, text):
        path = Path(self.folder.name) / name
        path.write_text(text)
        return path

    def diff(self, before, after, *args, ending="lad"):
        old, new = self.file(f"old.{ending}", before), self.file(f"new.{ending}", after)
        done = subprocess.run([RUNGC, "diff", old, new, *args], capture_output=True, text=True, timeout=patience(300), check=False)
        self.assertEqual(done.stderr, "")
        return done.returncode, done.stdout.replace(self.folder.name + "/", "")

    def test_the_same(self):
        again = HEAD.replace("symbol LAMP 7001.01\n", "") + "symbol LAMP 7001.01\n; a remark\n" + ONE.replace("START", "7000.00").replace('"motor"', '"the motor"') + TWO + THREE + END
        self.assertEqual(self.diff(HEAD + ONE + TWO + THREE + END, again),
                         (SAME, "rungs: 0 changed, 0 added, 0 removed, 0 moved, 4 unchanged\n"))

    def test_page(self):
        """Both versions of what differs in the order of the newer one, the rest folded; a name that is no page is refused."""
        page = Path(self.folder.name) / "page.html"
        added = '\nrung "more"\n|--[LAMP]--(7002.01)\n'
        status, text = self.diff(HEAD + ONE + TWO + THREE + END, HEAD + ONE.replace("[START]", "[/START]") + added + THREE + END, "-o", page)
        self.assertEqual((status, text), (OTHERWISE, f"wrote page.html\n"))
        html = page.read_text()
        self.assertEqual(re.findall(r'<section class="is-(\w+)"', html), ["changed", "removed", "added"])
        self.assertEqual(html.count('class="qp"'), 2)
        self.assertIn("2 unchanged rungs: 3 to 4", html)
        self.assertNotIn("<script", html)
        status, text = self.diff(HEAD + ONE + END, HEAD + ONE + END, "-o", page)
        self.assertEqual(status, SAME)
        self.assertNotIn("<section", page.read_text())
        done = subprocess.run([RUNGC, "diff", "a.lad", "b.lad", "-o", "page.svg"], capture_output=True, text=True, timeout=patience(300), check=False)
        self.assertEqual(done.returncode, USAGE)
        self.assertIn(".html", done.stderr)

    def test_names_without_case(self):
        """Of FANUC (F4); in NCT they are two names."""
        old = "%@2\nD10 Count\nR5.0 Flag\n%\n%@3\nSUB 1\nRD FLAG\nWRT Y0.0\nSUB 2\nSUB 64\n%\n"
        self.assertEqual(self.diff(old, old.replace("Count", "COUNT").replace("RD FLAG", "rd flag"), ending="mne"),
                         (SAME, "rungs: 0 changed, 0 added, 0 removed, 0 moved, 1 unchanged\n"))
        self.assertIn("changed name COUNT: D10 byte to D12 byte\n", self.diff(old, old.replace("D10 Count", "D12 COUNT"), ending="mne")[1])
        text = self.diff(HEAD + ONE + END, HEAD.replace("LAMP", "Lamp") + ONE + END)[1]
        self.assertIn("removed name LAMP", text)

    def test_a_twin_above_changes_nothing(self):
        twin, edge = '\nrung\n|--[@START]--(7002.01)\n', '\nrung\n|--[@START]--(MOTOR)\n'
        self.assertEqual(self.diff(HEAD + edge + END, HEAD + twin + edge + END)[1].splitlines()[-1],
                         "rungs: 0 changed, 1 added, 0 removed, 0 moved, 2 unchanged")
        self.assertEqual(self.diff(HEAD + twin + edge + END, HEAD + edge + END)[1].splitlines()[-1],
                         "rungs: 0 changed, 0 added, 1 removed, 0 moved, 2 unchanged")

    def test_requests_with_blocks_change_places(self):
        """Each has a buffer of its own; which part of the compiler's memory it is says nothing."""
        head = HEAD + "symbol READ 7100\nsymbol WRITE 7200\n"
        read, write = "\nrung\n|--[START]--{MR READ #107}--(MOTOR)\n", "\nrung\n|--[LAMP]--{MW WRITE #106}--(7001.05)\n"
        self.assertEqual(self.diff(head + read + TWO + write + END, head + write + read + TWO + END),
                         (OTHERWISE, """moved rung 3, old.lad:15 to rung 1, new.lad:9
rungs: 0 changed, 0 added, 0 removed, 1 moved, 3 unchanged
"""))
        self.assertEqual(self.diff(head + write + END, head + read + write + END)[1].splitlines()[-1],
                         "rungs: 0 changed, 1 added, 0 removed, 0 moved, 2 unchanged")

    def test_changed_added_removed_moved(self):
        status, text = self.diff(HEAD + ONE + TWO + THREE + END,
                                 HEAD + THREE + TWO.replace("[MOTOR]", "[MOTOR]--[START]") + '\nrung "new"\n|--[LAMP]--(7003.00)\n' + END)
        self.assertEqual((status, text), (OTHERWISE, """removed rung 1 "motor", old.lad:7
  - rung "motor"
  - |--[START]--(MOTOR)
changed rung 2 "lamp", old.lad:10 to rung 2 "lamp", new.lad:10
  - rung "lamp"
  - |--[MOTOR]--(LAMP)
  + rung "lamp"
  + |--[MOTOR]--[START]--(LAMP)
added rung 3 "new", new.lad:13
  + rung "new"
  + |--[LAMP]--(7003.00)
rungs: 1 changed, 1 added, 1 removed, 0 moved, 2 unchanged
"""))

    def test_moved(self):
        self.assertEqual(self.diff(HEAD + ONE + TWO + THREE + END, HEAD + TWO + THREE + ONE + END),
                         (OTHERWISE, """moved rung 1 "motor", old.lad:7 to rung 3 "motor", new.lad:13
rungs: 0 changed, 0 added, 0 removed, 1 moved, 3 unchanged
"""))

    def test_names(self):
        before = HEAD + "symbol OLD 7100\nsymbol MOVED 7101\n" + ONE + END
        after = HEAD + "symbol NEW 7100\nsymbol MOVED 7102\n" + ONE + END
        self.assertEqual(self.diff(before, after), (OTHERWISE, """changed name MOVED: 7101 32 bits to 7102 32 bits
added name NEW: 7100 32 bits
removed name OLD: 7100 32 bits
rungs: 0 changed, 0 added, 0 removed, 0 moved, 2 unchanged
"""))

    NCT_JUMPS = """{HEAD}
rung
|--[START]--{{JMP #1}}

rung
|--[LAMP]--{{SBS #5}}

rung
|--[START]--(MOTOR)

rung
|--{{JME #1}}

rung
|--[MOTOR]--(LAMP)

rung
|--{{END}}

rung
|--{{SBN #5}}

rung
|--[START]--(7003.00)

rung
|--[LAMP]--(7003.01)

rung
|--[LAMP]--{{RET}}
"""

    def nct_jumps(self, *changes):
        text = self.NCT_JUMPS.format(HEAD=HEAD)
        changed = text
        for old, new in changes:
            self.assertIn(old, changed)
            changed = changed.replace(old, new)
        return self.diff(text, changed)

    def test_jumps_go_by_what_they_lead_to(self):
        same = (SAME, "rungs: 0 changed, 0 added, 0 removed, 0 moved, 10 unchanged\n")
        self.assertEqual(self.nct_jumps(("|--{JME #1}", "|--{JME #1} ; the target")), same)
        self.assertEqual(self.nct_jumps(("#1}", "#7}")), same, "a label by another name")
        self.assertEqual(self.nct_jumps(("#5}", "#6}")), same, "a subroutine by another name")
        status, text = self.nct_jumps(("rung\n|--{JME #1}\n\nrung\n|--[MOTOR]--(LAMP)\n", "rung\n|--[MOTOR]--(LAMP)\n\nrung\n|--{JME #1}\n"))
        self.assertEqual(text.splitlines()[-1], "rungs: 0 changed, 0 added, 0 removed, 1 moved, 9 unchanged", text)
        status, text = self.nct_jumps(("|--{JME #1}", "|--{JME #1}\n\nrung\n|--[LAMP]--(7003.02)"))
        self.assertEqual(text.splitlines()[-1], "rungs: 0 changed, 1 added, 0 removed, 0 moved, 10 unchanged", text)

    def test_another_target(self):
        before = HEAD + "\nrung\n|--[START]--{JMP #1}\n\nrung\n|--[/START]--{JMP #1}\n\nrung\n|--[LAMP]--{JMP #2}\n\nrung\n|--{JME #1}\n" + ONE + "\nrung\n|--{JME #2}\n" + TWO + END
        status, text = self.diff(before, before.replace("JMP #1", "JMP #2", 1))
        self.assertEqual((status, text), (OTHERWISE, """changed rung 1, old.lad:7 to rung 1, new.lad:7
  - rung
  - |--[START]--{JMP #1}
  + rung
  + |--[START]--{JMP #2}
  leads to rung 6, new.lad:22, before: to rung 4, old.lad:16
rungs: 1 changed, 0 added, 0 removed, 0 moved, 7 unchanged
"""))
        _, text = self.diff(before, before.replace("JMP #1", "JMP #2", 1), "--format", "json")
        self.assertEqual(json.loads(text)["rungs"][0]["leads"], [{"before": "rung 4, old.lad:16", "after": "rung 6, new.lad:22"}])

    def test_gsk_jumps(self):
        before = ("LD X20.0\nFUNC JMPB\nPRM L1\nLD X20.1\nOUT R10.0\nFUNC LBL\nPRM L1\nLD X20.2\nOUT R10.1\nFUNC END1\n"
                  "LD X20.3\nFUNC CALL\nPRM P1\nFUNC END2\nFUNC SP\nPRM P1\nLD X20.4\nOUT R10.2\nFUNC SPE\n")
        for old, new in (("PRM L1\nLD X20.2", "PRM L1 ; target\nLD X20.2"), ("L1", "L9"), ("P1", "P22"), ("X20.4", "X020.4")):
            status, text = self.diff(before, before.replace(old, new), ending="pmc")
            self.assertEqual((status, text), (SAME, "rungs: 0 changed, 0 added, 0 removed, 0 moved, 6 unchanged\n"), (old, new))
        status, text = self.diff(before, before.replace("X20.2", "X20.7"), ending="pmc")
        self.assertEqual(text.splitlines()[-1], "rungs: 1 changed, 0 added, 0 removed, 0 moved, 5 unchanged", text)

    TECHNOL = """DATA
BITS: DFM A,B,C,D,,,,
TEXT: STR 10,'abc'
LIST: DS 8
WORD_1: DS 2
STEP: DS 1
DATA_END
MODULE_INPUT
MODULE_INPUT_END
MODULE_BLOCK_INIT
MODULE_BLOCK_INIT_END
MODULE_BLOCK_DONE
MODULE_BLOCK_DONE_END
MODULE_MAIN
        LDR A
        JL1 FURTHER
        LOD CNST.0
        STO STEP
FURTHER:
        LDR B
        WR C
        STRCPY TEXT,'xyz'
        LOD CNST.10
        STO WORD_1
        LOD WORD.LIST[BX]
        STO WORD_1
        MECH_BEGIN ALFA
        LDR A
        EX0
        FL 1,D
        EX
        LDR B
        EX1
        FL 0,D
        MECH_END ALFA
MODULE_MAIN_END
MODULE_INIT
MODULE_INIT_END
MODULE_CLEAR
        MECH_INIT ALFA
MODULE_CLEAR_END
MODULE_HALT
MODULE_HALT_END
STOP
"""

    def technol(self, *changes):
        changed = self.TECHNOL
        for old, new in changes:
            self.assertIn(old, changed)
            changed = changed.replace(old, new)
        return self.diff(self.TECHNOL, changed, "--dialect", "technol", ending="plc")

    def test_technol_lines_and_numbers(self):
        for change in (("DATA\n", "; one line\nDATA\n"), ("FL 1,D", "FL 1,D ; a remark"), ("FURTHER", "LATER"), ("CNST.10", "CNST.0Ah"),
                       ("MODULE_MAIN\n", "\n\nMODULE_MAIN\n"), ("CNST.0\n", "CNST.0h\n")):
            status, text = self.technol(change)
            self.assertEqual(status, SAME, f"{change}\n{text}")
            self.assertRegex(text, r"^rungs: 0 changed, 0 added, 0 removed, 0 moved, \d+ unchanged\n$")
        for change in (("DATA\n", "DATA\nFIRST: DS 3\n"), ("STEP: DS 1\n", "STEP: DS 1\nLAST: DS 300\n")):
            status, text = self.technol(change)
            self.assertRegex(text, r"rungs: 0 changed, 0 added, 0 removed, 0 moved, \d+ unchanged\n$", change)

    def test_technol_changes(self):
        for change, rungs in ((("        LDR B\n        WR C\n", "        LDR -B\n        WR C\n"), "1 changed, 0 added"),
                              (("CNST.10", "CNST.11"), "1 changed, 0 added"), (("WORD.LIST[BX]", "WORD.(LIST[BX]+2)"), "1 changed, 0 added"),
                              (("'xyz'", "'xyy'"), "1 changed, 0 added"), (("EX0\n", "EX1\n"), "1 changed, 0 added"),
                              (("        LDR B\n        EX1\n", "        LDR A\n        EX1\n        LDR B\n        EX1\n"), "0 changed, 1 added"),
                              (("        LDR B\n        EX1\n", "        TIM -,50\n        LDR B\n        EX1\n"), "0 changed, 1 added"),
                              (("        LDR B\n        WR C\n", "        LDR A\n        WR B\n        LDR B\n        WR C\n"), "0 changed, 1 added")):
            status, text = self.technol(change)
            self.assertEqual(status, OTHERWISE, change)
            self.assertRegex(text, rf"rungs: {rungs}, 0 removed, 0 moved, \d+ unchanged\n$", f"{change}\n{text}")

    def test_technol_waits(self):
        """The count of a TIM is cleared by what comes to it, in a rung of its own or not; how it is called says nothing."""
        for before in ("FL 1,D\n        TIM -,50\n", "EX\n        TIM -,50\n"):
            for time, changed in (("032h", 0), ("T_NEW", 0), ("51", 1)):
                with self.subTest(before=before, time=time):
                    old = self.TECHNOL.replace("        FL 1,D\n", f"        {before}").replace("DATA\n", "DATA\n        EQUI T_NEW,50\n", 1)
                    status, text = self.diff(old, old.replace("TIM -,50", f"TIM -,{time}"), "--dialect", "technol", ending="plc")
                    self.assertEqual(status, OTHERWISE if changed else SAME, text)
                    self.assertRegex(text, rf"rungs: {changed} changed, 0 added, 0 removed, 0 moved, \d+ unchanged\n$")

    def test_technol_clocks(self):
        """The period of a timed block is what it does; what other blocks are timed is not."""
        block = "        DFTM1 LATER\n        LDR B\n        WR C\nLATER:\n"
        one = self.TECHNOL.replace("        LDR B\n        WR C\n", block)
        two = one.replace(block, block + block.replace("LATER", "LATEST"))
        for old, new, rungs in ((one, one.replace("DFTM1 ", "DFTM10 "), "1 changed, 0 added"), (two, two.replace("DFTM1 LATER\n", "DFTM10 LATER\n"), "1 changed, 0 added"),
                                (one, two, "0 changed, 2 added")):
            status, text = self.diff(old, new, "--dialect", "technol", ending="plc")
            self.assertEqual(status, OTHERWISE)
            self.assertRegex(text, rf"rungs: {rungs}, 0 removed, 0 moved, \d+ unchanged\n$")

    def test_a_rung_is_shown_to_its_last_line(self):
        """A macro with a jump makes several rungs in one line; the last one goes on below it."""
        macro = "DEF_T_MACRO AT_MOST CELL,HIGH\n T_LOCAL FITS\n LOD TMAC.CELL\n LE TMAC.HIGH\n JL1 FITS\n LOD TMAC.HIGH\nFITS: STO TMAC.CELL\nEND_T_MACRO\n"
        old = self.TECHNOL.replace("DATA\n", macro + "DATA\n", 1).replace("        LDR B\n        WR C\n", "        AT_MOST WORD_1,CNST.50\n        LOD CNST.7\n        STO STEP\n")
        status, text = self.diff(old, old.replace("CNST.7", "CNST.8"), "--dialect", "technol", ending="plc")
        self.assertEqual(status, OTHERWISE)
        self.assertIn("  - AT_MOST WORD_1,CNST.50\n  - LOD CNST.7\n", text)
        self.assertIn("  + AT_MOST WORD_1,CNST.50\n  + LOD CNST.8\n", text)

    def test_technol_texts_and_procedures_of_requests(self):
        """Each text has a space and each procedure that the control calls a number, in their order, which says nothing."""
        old = self.TECHNOL.replace("STEP: DS 1\n", "STEP: DS 1\nPACKET: STR 12\n").replace("MODULE_MAIN\n", "".join(
            ["MODULE_MAIN\n", *(f"        PROC_BEGIN {name}\n        LDR A\n        WR {bit}\n        PROC_END {name}\n" for name, bit in (("P1", "B"), ("P2", "C")))]))
        old = old.replace("MODULE_INIT\n", "MODULE_INIT\n        LDR A\n        JL1 NEXT\nNEXT:\n        CAN_RECV_REQ 2,580h,-,21h,-,P1,PACKET\n").replace("        EX0\n", "        EX0\n        PLCT_COL_INDEX 0,'one',WORD_1\n        EX\n")
        changed, added = "1 changed, 0 added", "0 changed, 1 added"
        for change, rungs in ((("STRCPY TEXT,'xyz'", "STRCPY TEXT,'xyz'\n        STRCPY TEXT,'new'"), changed), (("'one'", "'two'"), changed),
                              (("MODULE_INIT\n", "MODULE_INIT\n        CAN_RECV_REQ 2,580h,-,22h,-,P2,PACKET\n"), added), (("-,P1,", "-,P2,"), changed)):
            status, text = self.diff(old, old.replace(*change), "--dialect", "technol", ending="plc")
            self.assertEqual(status, OTHERWISE, change)
            self.assertRegex(text, rf"rungs: {rungs}, 0 removed, 0 moved, \d+ unchanged\n$", f"{change}\n{text}")
        self.assertIn("  leads to PROC P2, before: to PROC P1\n", text)

    def test_technol_local_data_of_macros(self):
        """Each use has its own, in their order, which says nothing."""
        macro = "DEF_T_MACRO EDGE BIT,TO\n T_LOCAL BEFORE,I,J,K,L,M,N,O,NONE\nDATA_LOCAL\n DFM BEFORE,I,J,K,L,M,N,O\nDATA_LOCAL_END\n LDR TMAC.BIT\n LA -BEFORE\n JL0 NONE\n FL 1,TMAC.TO\nNONE: LDR TMAC.BIT\n WR BEFORE\nEND_T_MACRO\n"
        use = "        LDR D\n        JL1 {0}\n        EDGE {1},C\n{0}:\n"
        old = self.TECHNOL.replace("DATA\n", macro + "DATA\n", 1).replace("        LDR B\n        WR C\n", use.format("U1", "A") + use.format("U2", "B"))
        for new, rungs in ((old.replace("MODULE_MAIN\n", "MODULE_MAIN\n" + use.format("U0", "B"), 1), "0 changed, 2 added, 0 removed"), (old.replace("LA -BEFORE", "LA BEFORE"), "2 changed, 0 added, 0 removed"),
                           (old.replace("EDGE A,C", "EDGE B,C"), "1 changed, 0 added, 0 removed")):
            status, text = self.diff(old, new, "--dialect", "technol", ending="plc")
            self.assertEqual(status, OTHERWISE)
            self.assertRegex(text, rf"rungs: {rungs}, 0 moved, \d+ unchanged\n$", text)
            self.assertNotIn("BEFORE#", text)

    def technol_program(self, data, main):
        head, tail = self.TECHNOL.split("DATA\n", 1)[0], self.TECHNOL.split("DATA_END\n", 1)[1]
        begin, end = tail.index("MODULE_MAIN\n"), tail.index("MODULE_MAIN_END\n")
        clear = tail[end:].replace("        MECH_INIT ALFA\n", "")
        return f"{head}DATA\n{data}DATA_END\n{tail[:begin]}MODULE_MAIN\n{main}{clear}"

    def technol_pair(self, data, main, old, new):
        before = self.technol_program(data, main)
        self.assertIn(old, before)
        status, text = self.diff(before, re.sub(rf"(?<!\w){re.escape(old.rstrip())}(?!\w)" + old[len(old.rstrip()):], new, before), ending="plc")
        self.assertRegex(text.splitlines()[-1], r"^rungs: 0 changed, 0 added, 0 removed, 0 moved, \d+ unchanged$", text)
        return status, text.splitlines()[:-1]

    def test_a_bit_moves_in_a_byte_that_is_used_as_a_whole(self):
        data = "IN1: DFM A,B,,,,,,\nREST: DFM C,,,,,,,\n"
        logic = "        LDR B\n        LA A\n        WR C\n"
        for wide in ("MOVE IN1,P1IN", "MOVE P1OUT,IN1", "LOD BYTE.IN1\n        STO BYTE.REST", "LOD BYTE.IN1[BX]\n        STO BYTE.REST", "MOVE WORD.IN1,WORD.IN1"):
            main = f"{logic}        {wide}\n"
            with self.subTest(wide):
                self.assertEqual(self.technol_pair(data, main, "A,B,,", "A,,B,"), (OTHERWISE, ["changed name B: bit 1 of IN1 to bit 2 of IN1"]))
                self.assertEqual(self.technol_pair(data, main, "A,B,,", "B,A,,"), (OTHERWISE, ["changed name A: bit 0 of IN1 to bit 1 of IN1", "changed name B: bit 1 of IN1 to bit 0 of IN1"]))
                self.assertEqual(self.technol_pair(data, main, "DATA\n", "DATA\nNEW: DS 3\n"), (OTHERWISE, ["added name NEW: byte × 3"]))
        table = logic + "        LOD BYTE.FIRST[BX]\n        STO BYTE.IN1\n"
        self.assertEqual(self.technol_pair("FIRST: DFM D,,,,,,,\n" + data, table, "DFM C,,", "DFM ,C,"), (OTHERWISE, ["changed name C: bit 0 of REST to bit 1 of REST"]), "a table of bytes")
        self.assertEqual(self.technol_pair("FIRST: DS 4\n" + data, table, "DFM C,,", "DFM ,C,"), (SAME, []), "a variable that ends before")
        self.assertEqual(self.technol_pair(data, logic, "A,B,,", "A,,B,"), (SAME, []))
        self.assertEqual(self.technol_pair(data, logic, "A,B,,", "B,A,,"), (SAME, []))
        self.assertEqual(self.technol_pair(data, logic + "        MOVE IN1,P1IN\n", "DFM C,,", "DFM ,C,"), (SAME, []))

    def test_names_of_variables(self):
        data = "IN1: DFM A,B,,,,,,\nN1: DS 2\nN2: DS 2\nLIST: DS 8\n"
        main = "        LDR A\n        WR B\n        MOVE IN1,P1IN\n        LOD WORD.N1\n        STO WORD.N2\n        LOD WORD.LIST[BX]\n        STO WORD.N1\n"
        for old, new in (("A", "AA"), ("B", "AB"), ("IN1", "ZIN"), ("N1", "N9"), ("N2", "A2"), ("LIST", "ALIST")):
            with self.subTest(old):
                status, lines = self.technol_pair(data, main, old, new)
                self.assertEqual((status, [line.split(":")[0] for line in lines]), (OTHERWISE, sorted((f"removed name {old}", f"added name {new}"), key=lambda line: line.split()[2])))

    def test_the_name_of_a_mechanism(self):
        status, text = self.diff(self.TECHNOL, re.sub(r"\bALFA\b", "ZULU", self.TECHNOL), "--dialect", "technol", ending="plc")
        lines = text.splitlines()
        self.assertEqual((status, sorted(line.split(":")[0] for line in lines[:-1])), (OTHERWISE, ["added name ZULU", "removed name ALFA"]), text)
        self.assertRegex(lines[-1], r"^rungs: 0 changed, 0 added, 0 removed, 0 moved, \d+ unchanged$")

    def test_one_variable_more_and_another_name_in_one_place(self):
        data = "FIRST: DS 2\nN1: DS 2\n"
        main = "ONE:    LOD WORD.FIRST\n        STO WORD.N1\nTWO:    LOD WORD.N1\n        INR\n        STO WORD.FIRST\n        JL1 ONE\n        JL1 TWO\n"
        before = self.technol_program(data, main)
        for now in ("FIRST: DS 2\nNEW: DS 2\nN9: DS 2\n", "FIRST: DS 2\nN9: DS 2\nNEW: DS 2\n"):
            with self.subTest(now):
                added = main.replace("WORD.N1", "WORD.N9") + "THREE:  LOD CNST.7\n        STO WORD.NEW\n        JL0 THREE\n"
                _, text = self.diff(before, self.technol_program(now, added), ending="plc")
                self.assertRegex(text.splitlines()[-1], r"^rungs: 0 changed, 1 added, 0 removed, 0 moved, \d+ unchanged$", text)

    def test_line_numbers_that_the_program_reads(self):
        mechanism = "        MECH_BEGIN ALFA\n        EX\n        EX\n        MECH_END ALFA\n"
        reads = "        LOD WORD.ALFA_LINE\n        STO WORD.N1\n"
        before = self.technol_program("N1: DS 2\n", reads + mechanism)
        line = before.splitlines().index("        EX") + 1
        self.assertEqual(self.technol_pair("N1: DS 2\n", mechanism, "DATA\n", "DATA\n; one\n"), (SAME, []), "nothing reads them")
        self.assertEqual(self.technol_pair("N1: DS 2\n", reads + mechanism, "STOP\n", "; one\nSTOP\n"), (SAME, []), "below")
        self.assertEqual(self.technol_pair("N1: DS 2\n", reads + mechanism, "DATA\n", "DATA\n\n\n"),
                         (OTHERWISE, [f"line numbers that the program reads have changed: ALFA_LINE {line} → {line + 2}, {line + 1} → {line + 3}"]))
        _, text = self.diff(before, "; one\n" + before, "--format", "json", ending="plc")
        self.assertEqual(json.loads(text)["lines"], [{"name": "ALFA_LINE", "before": [line, line + 1], "after": [line + 1, line + 2]}])

    def test_a_list_and_the_ladder_that_it_becomes(self):
        source = self.file("h.pmc", "FUNC END1\nLD X20.0\nLDI X20.2\nAND X20.4\nORB\nSET R0.0\nFUNC END2\n")
        ladder = Path(self.folder.name) / "h.lad"
        subprocess.run([RUNGC, "convert", source, "--to", "ladder", "-o", ladder], capture_output=True, check=True)
        self.assertEqual(self.run_diff(source, ladder)[:2], (SAME, "rungs: 0 changed, 0 added, 0 removed, 0 moved, 1 unchanged\n"))

    def test_initial_contents(self):
        self.assertEqual(self.technol(("'abc'", "'abd'"))[1].splitlines()[0], "changed initial value TEXT: 'abc' to 'abd'")
        status, text = self.technol(("STEP: DS 1\n", "STEP: DS 1\nMORE: STR 5,'new'\n"))
        self.assertEqual(text.splitlines()[:2], ["added name MORE:  × 6", "added initial value MORE: 'new'"])
        first, later = "TOOL struc\nN DW ?\nL DD 7\nTOOL ends\nT1 TOOL <5,1000>\nDATA_END\n", "TOOL struc\nN DW ?\nL DD 7\nTOOL ends\nT1 TOOL <5,1001>\nDATA_END\n"
        head, tail = self.TECHNOL.split("DATA_END\n", 1)
        status, text = self.diff(head + first + tail, head + later + tail, "--dialect", "technol", ending="plc")
        self.assertEqual(status, OTHERWISE)
        self.assertRegex(text, r"^changed initial value T1\S*: ")
        _, text = self.diff(head + first + tail, head + later + tail, "--dialect", "technol", "--format", "json", ending="plc")
        self.assertEqual([change["change"] for change in json.loads(text)["contents"]], ["changed"] * len(json.loads(text)["contents"]))

    def project(self, name, config, source="LD X20.0\nFUNC TMR\nPRM 1\nOUT R10.0\nFUNC END1\nFUNC END2\n", messages=None):
        folder = Path(self.folder.name) / name
        folder.mkdir()
        (folder / "v.pmc").write_text(source)
        if messages is not None:
            (folder / "v.msg").write_text(messages)
            config += 'messages = "v.msg"\n'
        (folder / "rung.toml").write_text(f'dialect = "gsk"\nfiles = ["v.pmc"]\n[config]\n{config}')
        return folder

    def run_diff(self, *args):
        done = subprocess.run([RUNGC, "diff", *args], capture_output=True, text=True, timeout=patience(300), check=False)
        return done.returncode, *(text.replace(self.folder.name + "/", "") for text in (done.stdout, done.stderr))

    def test_configuration(self):
        a, b = self.project("a", '"tmr.1" = 1000\n'), self.project("b", '"tmr.1" = 2000\n"tmr.2" = 8\n')
        self.assertEqual(self.run_diff(a, b), (OTHERWISE, """changed configuration tmr.1: 1000 to 2000
added configuration tmr.2: 8
rungs: 0 changed, 0 added, 0 removed, 0 moved, 1 unchanged
""", ""))
        self.assertEqual([c["name"] for c in json.loads(self.run_diff(a, b, "--format", "json")[1])["configuration"]], ["tmr.1", "tmr.2"])

    def test_the_encoding_of_the_files_is_not_the_program(self):
        a, b = self.project("a", ""), self.project("b", "")
        (b / "rung.toml").write_text('encoding = "cp1250"\n' + (b / "rung.toml").read_text())
        self.assertEqual(self.run_diff(a, b), (SAME, "rungs: 0 changed, 0 added, 0 removed, 0 moved, 1 unchanged\n", ""))

    def test_numbers_are_those_of_check(self):
        """Several MECH_INIT one below the other: each ends its rung, whether its mechanism counts time or not."""
        mechanisms = "".join(f"        MECH_BEGIN M{i}\n        TIM  -,5\n        MECH_END M{i}\n" for i in range(3)) + "        MECH_BEGIN M3\n        EX\n        MECH_END M3\n"
        inits = "        PROC_BEGIN RESET\n" + "".join(f"        MECH_INIT M{i}\n" for i in (0, 3, 1, 2)) + "        PROC_END RESET\n"
        text = self.TECHNOL.replace("        LDR A\n        JL1 FURTHER\n", mechanisms + inits + "        LDR A\n        JL1 FURTHER\n")
        path = self.file("p.plc", text)
        checked = subprocess.run([RUNGC, "check", path], capture_output=True, text=True, check=False).stdout
        _, same = self.diff(text, text, ending="plc")
        self.assertEqual(re.search(r"(\d+) rungs", checked)[1], re.search(r"(\d+) unchanged", same)[1])
        status, longer = self.diff(text, text.replace("TIM  -,5\n        MECH_END M1", "EX\n        MECH_END M1"), ending="plc")
        self.assertEqual((status, longer.splitlines()[-1].split(", ")[:4]), (OTHERWISE, ["rungs: 1 changed", "0 added", "0 removed", "0 moved"]), longer)

    def test_messages(self):
        a, b = (self.project(name, "", messages=f'1 "{text}"\n2 "oil"\n') for name, text in (("a", "air"), ("b", "no air")))
        status, text, _ = self.run_diff(a, b)
        self.assertEqual(status, OTHERWISE)
        self.assertEqual(text.splitlines()[0].split(": ")[1], "air to no air")
        before = HEAD + 'message 3 "x"\nbutton 3 "y"\n' + ONE + "rung\n|--[N_ON]--{MSG #3 #0 #0}--(7300.00)\n" + END
        self.assertEqual(self.diff(before, before.replace('"x"', '"u"').replace('"y"', '"v"'))[1].splitlines()[:2],
                         ["changed message 3: x to u", "changed button 3: y to v"])

    def test_a_copy_beside_its_project(self):
        a = self.project("a", '"tmr.1" = 1000\n', messages='1 "air"\n')
        copy = self.file("before.pmc", (a / "v.pmc").read_text().replace("X20.0", "X20.1"))
        said = "rungc: before.pmc is in no project: it is compared in the place of a/v.pmc, with all else of a/rung.toml\n"
        for new in (a, a / "v.pmc"):
            status, text, error = self.run_diff(copy, new)
            self.assertEqual((status, text.splitlines()[-1], error), (OTHERWISE, "rungs: 1 changed, 0 added, 0 removed, 0 moved, 0 unchanged", said))
            self.assertNotIn("message", text)
        status, text, error = self.run_diff("examples/nct-lathe/io.lad", "examples/nct-lathe")
        self.assertEqual((status, error), (SAME, ""), "a file of the project is the project")
        lonely = self.file("other.lad", HEAD + ONE + END)
        self.assertEqual(self.run_diff(lonely, "examples/nct-lathe")[2].split(": ")[-1].strip(), "configuration and messages are not compared")

    def test_levels_and_modules(self):
        rung = "LD X20.0\nOUT R10.0\n"
        self.assertEqual(self.diff(rung + "FUNC END1\nFUNC END2\n", "FUNC END1\n" + rung + "FUNC END2\n", ending="pmc")[1].splitlines()[0],
                         "moved rung 1, old.pmc:1 to rung 1, new.pmc:2, from LEVEL1 to LEVEL2")
        before = HEAD + ONE + TWO
        self.assertEqual(self.diff(before, before.replace(TWO, "\nmodule INT0\n" + TWO))[1].splitlines()[0],
                         'moved rung 2 "lamp", old.lad:10 to rung 2 "lamp", new.lad:12, from MAIN to INT0')

    def test_compiled_program(self):
        program = Path(self.folder.name) / "p.so"
        program.write_bytes(b"\x7fELF\x02\x01\x01" + bytes(100))
        for command in (["diff", program, program], ["check", program], ["xref", program], ["view", program, "-o", "x.svg"], ["format", program], ["emit", "ir", program]):
            done = subprocess.run([RUNGC, *command], capture_output=True, text=True, check=False)
            self.assertEqual((done.returncode, done.stdout), (OTHERWISE, ""), command)
            self.assertEqual(done.stderr.splitlines()[0], f"error: '{program}' is a compiled program; its source files are needed here [compiled-program]", command)

    def test_help(self):
        done = subprocess.run([RUNGC, "diff", "--help"], capture_output=True, text=True, check=False)
        self.assertIn("Exit status: 0 no difference, 1 there are differences or a program is wrong", done.stdout)

    def test_json(self):
        status, text = self.diff(HEAD + ONE + END, HEAD + ONE.replace("[START]", "[/START]") + END, "--format", "json")
        found = json.loads(text)
        self.assertEqual((status, found["same"], len(found["rungs"])), (OTHERWISE, 1, 1))
        self.assertEqual(found["rungs"][0]["change"], "changed")
        self.assertEqual(found["rungs"][0]["after"]["text"].splitlines()[-1], "|--[/START]--(MOTOR)")

    def test_addresses_that_the_compiler_gives_out(self):
        """A new variable before others moves them, and changes nothing that rungs do."""
        source = Path("tests/scenarios/technol/address-forms.plc").read_text(encoding="utf-8")
        self.assertIn("DATA\n", source)
        status, text = self.diff(source, source.replace("DATA\n", "DATA\nFIRST_OF_ALL: DS 6\n", 1), "--dialect", "technol", ending="plc")
        self.assertEqual(status, OTHERWISE)
        self.assertIn("added name FIRST_OF_ALL", text)
        self.assertRegex(text, r"rungs: 0 changed, 0 added, 0 removed, 0 moved, \d+ unchanged\n$")

    def test_projects(self):
        for example in ("fanuc-vmc", "gsk-mill", "nct-turning-centre", "technol-machining-centre"):
            done = subprocess.run([RUNGC, "diff", f"examples/{example}", f"examples/{example}"], capture_output=True, text=True, check=False)
            self.assertEqual((done.returncode, done.stderr), (SAME, ""))

    def test_programs_of_several_files(self):
        """Those of the newer version come after --to; the order of the files is that of the program."""
        files = {}
        for version, contact in (("old", "X9.0"), ("new", "X9.1")):
            (Path(self.folder.name) / version).mkdir()
            files[version] = [self.file(f"{version}/symbols.mne", f"%@2\n{contact} START\n%\n"),
                              self.file(f"{version}/ladder.mne", "%@3\nEND1\nRD START\nWRT Y9.0\nEND2\nEND\n%\n")]
        status, text, error = self.run_diff(*files["old"], "--to", *files["new"])
        self.assertEqual((status, error), (OTHERWISE, ""))
        self.assertIn("changed name START: X9.0 to X9.1\n", text)
        self.assertRegex(text, r"rungs: 1 changed, 0 added, 0 removed, 0 moved, 0 unchanged\n$")
        self.assertEqual(self.run_diff(*files["old"], "--to", *files["old"])[0], SAME)
        self.assertEqual(self.run_diff(files["old"][1], "--to", files["old"][1])[0], OTHERWISE, "a symbol is missing")
        self.file("new/rung.toml", 'dialect = "fanuc"\nfiles = ["symbols.mne", "ladder.mne"]\n[config]\n"tmr.1" = 96\n')
        for newer in (files["new"], [Path(self.folder.name) / "new"]):
            status, text, error = self.run_diff(*files["old"], "--to", *newer)
            self.assertEqual((status, text.splitlines()[-2:]), (OTHERWISE, ["changed name START: X9.0 to X9.1", "rungs: 1 changed, 0 added, 0 removed, 0 moved, 0 unchanged"]))
            self.assertEqual(error.splitlines(), [f"rungc: old/{name} is in no project: it is compared in the place of new/{name}, with all else of new/rung.toml"
                                                  for name in ("symbols.mne", "ladder.mne")])
        for words in (files["old"] + files["new"], files["old"][:1]):
            status, text, error = self.run_diff(*words)
            self.assertEqual((status, text), (USAGE, ""))
            self.assertIn(f"found {len(words)} name", error)
            self.assertIn("write those of the newer one after --to", error)

    def test_two_dialects(self):
        lad, pmc = self.file("a.lad", HEAD + ONE + END), self.file("b.pmc", "LD X0.0\nOUT Y0.0\nFUNC END1\nFUNC END2\n")
        done = subprocess.run([RUNGC, "diff", lad, pmc], capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stdout, done.stderr), (USAGE, "", "rungc: the two programs have different dialects\n"))


if __name__ == "__main__":
    go_to_root()
    RUNGC = sys.argv.pop(1)
    unittest.main()
