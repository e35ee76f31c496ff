#!/usr/bin/env python3
"""The commands of rungc on a mnemonic file of FANUC: symbols without regard to case, parameters on lines of their own,
sections. fanuc_test.py RUNGC"""
import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from patience import patience

RUNGC = None
OK, WRONG = 0, 1

LADDER = """%@0
4 0i-F PMC(MEM-B,FLT)
%
%@2-C
X9.0 START
$1 '' 'start key'
X9.1 STOP
R1.0 RUN
Y9.0 LAMP
P1 COUNT
%
%@3
SUB 1
(* the latch *)
RD start
OR RUN
AND.NOT STOP
WRT RUN
(* the lamp *)
RD RUN
TMRB 1 16
WRT LAMP
RD RUN
CALL Count
SUB 2
COUNT SP
RD START
SUB 57
1
WRT R2.0
RD R9091.0
RD.STK R2.0
SUB 36
2
D0
1
D0
WRT R2.1
SPE
SUB 64
%
"""
LATCH, TIMER, CALL, EDGE, SUM = 15, 20, 23, 27, 31  # lines of the networks
SCENARIO = "program lamp.mne\nscan\nexpect LAMP 0\nset START 1\nscan 4\nexpect LAMP 1\nexpect D0:2 1\n"


class Fanuc(unittest.TestCase):
    maxDiff = None

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.write("lamp.mne", LADDER)
        self.write("lamp.scn", SCENARIO)

    def write(self, name, text, encoding="utf-8"):
        (self.folder / name).write_bytes(text.encode(encoding))

    def run_rungc(self, *args, status=OK):
        done = subprocess.run([Path(RUNGC).resolve(), *args], cwd=self.folder, capture_output=True, timeout=patience(), check=False)
        self.assertEqual(done.returncode, status, done.stderr)
        return done.stdout.decode(), done.stderr.decode()

    def test_check(self):
        self.assertIn("lamp.mne: 5 rungs, no warnings", self.run_rungc("check", "lamp.mne")[0])
        self.write("bad.mne", LADDER.replace("WRT LAMP", "WRT LAMPE"))
        said = self.run_rungc("check", "bad.mne", status=WRONG)[1]
        self.assertIn("bad.mne:22:5: error: 'LAMPE' is not declared [undefined-symbol]", said)
        self.assertIn("did you mean LAMP?", said)
        report, = json.loads(self.run_rungc("check", "--json", "bad.mne", status=WRONG)[0])
        self.assertEqual((report["code"], report["line"], report["column"]), ("undefined-symbol", 22, 5))

    def test_utf_16_as_the_control_s_tools_write_it(self):
        for name, text in (("mark.mne", "\ufeff" + LADDER), ("bare.mne", LADDER)):
            self.write(name, text.replace("\n", "\r\n"), "utf-16-le")
            self.assertIn("5 rungs, no warnings", self.run_rungc("check", name)[0])
        self.write("bare.mne", ";Двери\r\n" + LADDER, "utf-16-le")
        self.assertIn("5 rungs, no warnings", self.run_rungc("check", "bare.mne")[0])

    def test_a_line_that_names_the_dialect(self):
        text = LADDER.replace("0i-F PMC(MEM-B,FLT)", "NEW").replace("WRT LAMP", "WRT A0.0") + "%@4\nA0.0\nB0.0 1000 TEXT\n%\n"
        self.write("bare.mne", text)
        bare = json.loads(self.run_rungc("check", "--json", "bare.mne", status=WRONG)[0])
        self.assertEqual([one["code"] for one in bare], ["unknown-pmc", "bad-listed-message", "bad-listed-message"])
        for before, encoding in (("dialect fanuc\n", "utf-8"), ("; a\ndialect fanuc\n", "utf-8"), ("dialect fanuc\n", "utf-16"), ("Dialect FANUC\n", "utf-8")):
            self.write("named.mne", before + text, encoding)
            reports = [json.loads(self.run_rungc("check", "--json", "named.mne", status=WRONG)[0])]
            if "dialect fanuc" in before:
                done = subprocess.run([RUNGC, "check", "--json", "-"], input=(self.folder / "named.mne").read_bytes(), capture_output=True, timeout=patience(), check=False)
                reports.append(json.loads(done.stdout))
            for named in reports:
                self.assertEqual([(one["code"], one["line"] - before.count("\n"), one["column"], one["message"]) for one in named],
                                 [(one["code"], one["line"], one["column"], one["message"]) for one in bare])

    def test_a_message_without_a_number(self):
        self.write("bad.mne", LADDER + "%@4\nA0.0\n%\n")
        said = self.run_rungc("check", "bad.mne", status=WRONG)[1]
        self.assertIn("a message is written `A0.0 1000 TEXT`; the number is missing [bad-listed-message]", said)
        report, = json.loads(self.run_rungc("check", "--json", "bad.mne", status=WRONG)[0])
        self.assertEqual((report["code"], report["line"], report["column"]), ("bad-listed-message", LADDER.count("\n") + 2, 1))

    def test_a_file_without_line_feeds(self):
        self.write("mac.mne", LADDER.replace("\n", "\r"))
        for command in (("check",), ("format", "--stdout"), ("import",)):
            said = self.run_rungc(*command, "mac.mne", status=WRONG)[1]
            self.assertIn("is a text without LF, whose lines end with CR alone: save it with CR LF at the ends of its lines", said)
            self.assertNotIn("END1", said)

    def test_the_whole_scenario_on_all_engines(self):
        self.assertIn("1 passed, 0 failed", self.run_rungc("test", "--engine", "all", "lamp.scn")[0])

    def test_constants_cannot_be_forced(self):
        for name, number in (("R9091.1", 0), ("R9091", 0)):
            self.write("lamp.scn", SCENARIO + f"force R9091.5 1\nforce {name} {number}\n")
            said = self.run_rungc("test", "lamp.scn", status=WRONG)[0]
            self.assertIn(f"lamp.scn:9: {name} is a constant of the control, in the code of the program: it cannot be forced", said)

    def test_retained_memory_of_another_program(self):
        """Names are found in either case; what a smaller type has no place for is reported by areas."""
        def run(program, session):
            done = subprocess.run([Path(RUNGC).resolve(), "run", "-i", "-q", "--retain", "kept", program], cwd=self.folder, input=session,
                                  capture_output=True, text=True, timeout=patience(), check=False)
            self.assertEqual(done.returncode, OK, done.stderr)
            return done.stdout, done.stderr
        ladder = "%@0\n4 0i-F PMC(MEM-B,FLT)\n%\n%@2\nD10 Count\n%\n%@3\nSUB 1\nRD X0.0\nWRT Y0.0\nSUB 2\nSUB 64\n%\n"
        self.write("large.mne", ladder)
        self.write("small.mne", ladder.replace("0i-F PMC(MEM-B,FLT)", "PMC-SA1").replace("D10 Count", "D20 COUNT"))
        run("large.mne", "set Count 7\nset K50 3\nscan\n")
        shown, said = run("small.mne", "print count D20\n")
        self.assertIn("count = 7 (0x7), D20 = 7 (0x7)", shown)
        self.assertIn("its cells are taken by name and address: removed C80 to C5199, moved COUNT, removed D1860 to D9999, "
                      "removed K20 to K999, removed T80 to T9499\n", said)

    def test_xref_by_symbols_and_places(self):
        table = self.run_rungc("xref", "lamp.mne")[0]
        self.assertIn(f'RUN (R1.0)\n  written  rung 1 "the latch", lamp.mne:{LATCH}\n', table)
        self.assertIn(f"D0:2\n  written  rung 5, lamp.mne:{SUM}\n  read     rung 5, lamp.mne:{SUM}\n", table)
        for place in ("R1.0", "RUN"):
            entry, = json.loads(self.run_rungc("xref", "--format", "json", "lamp.mne", "--place", place)[0])
            self.assertEqual((entry["name"], entry["address"]), ("RUN", "R1.0"))
            self.assertEqual([use["line"] for use in entry["read"]], [LATCH, TIMER, CALL])

    def test_what_others_read_or_write_is_no_mistake(self):
        symbols = "%@2-C\nE10.0 ASKED\nE10.1 GIVEN\nR9010.0 OWN\nR10.0 ALONE\nR10.1 UNSEEN\n%\n"
        self.write("others.mne", symbols + "%@3\nSUB 1\nRD ASKED\nAND ALONE\nWRT GIVEN\nRD GIVEN\nWRT UNSEEN\nSUB 2\nSUB 64\n%\n")
        said = self.run_rungc("check", "others.mne")[1]
        self.assertIn("'ALONE' is read, but nothing writes it [never-written]", said)
        self.assertIn("'UNSEEN' is written, but nothing reads it [never-read]", said)
        self.assertNotIn("ASKED' is", said)
        self.write("others.mne", symbols + "%@3\nSUB 1\nRD X9.0\nWRT GIVEN\nWRT OWN\nSET ASKED\nSET ALONE\nSUB 2\nSUB 64\n%\n")
        said = self.run_rungc("check", "others.mne")[1]
        self.assertNotIn("'GIVEN' is", said)
        self.assertNotIn("'ASKED' is", said)
        self.assertIn("'ALONE' is set, but nothing resets it [never-reset]", said)

    def test_a_dummy_coil_is_one_warning(self):
        coils = "".join(f"RD X9.{i}\nWRT R7.0\n" for i in range(5))
        self.write("dummy.mne", f"SUB 1\n{coils}RD R7.0\nWRT Y9.0\nSUB 2\nSUB 64\n")
        self.assertEqual(self.run_rungc("check", "dummy.mne")[1].count("R7.0 is driven by two coils"), 1)
        self.write("outputs.mne", f"SUB 1\n{coils.replace('R7', 'Y7')}SUB 2\nSUB 64\n")
        self.assertEqual(self.run_rungc("check", "outputs.mne")[1].count("Y7.0 is driven by two coils"), 4)

    def test_xref_lists_the_readers_of_bits_that_never_change(self):
        self.write("constant.mne", "SUB 1\nRD R9091.1\nWRT Y9.0\nRD R9091.0\nOR R9091.1\nWRT Y9.1\nRD R9091.5\nWRT Y9.2\nSUB 2\nSUB 64\n")
        said = self.run_rungc("xref", "constant.mne", "--place", "R9091.0", "--place", "R9091.1", "--place", "R9091.5")[0]
        self.assertEqual(said, """R9091.0
  written  by the control or the machine
  read     rung 2, constant.mne:4

R9091.1
  written  by the control or the machine
  read     rung 1, constant.mne:2
           rung 2, constant.mne:4

R9091.5
  written  by the control or the machine
  read     rung 3, constant.mne:7
""")
        self.write("rung.toml", 'dialect = "fanuc"\nfiles = ["constant.mne"]\n')
        self.assertIn("[fanuc] R9091.1: always 1\n", self.run_rungc("explain", "R9091.1")[0])
        self.assertIn("  read     rung 1, constant.mne:2\n", self.run_rungc("explain", "R9091.1")[0])

    def test_explain_functions_by_number_and_places_of_the_control(self):
        for word in ("SUB 24", "SUB24", "sub 24"):
            self.assertTrue(self.run_rungc("explain", word)[0].startswith("[fanuc] TMRB (function 24): on-delay timer"))
        self.assertEqual(self.run_rungc("explain", "R9091.1")[0], "[fanuc] R9091.1: always 1\n  with memory C and larger this is Z91.1\n")
        self.assertEqual(self.run_rungc("explain", "Z91.5")[0], "[fanuc] Z91.5: clock: 0.1 s 0, then 0.1 s 1\n  with memory A and B this is R9091.5\n")
        self.assertEqual(self.run_rungc("explain", "K918")[0], "[fanuc] K918: shift of the messages to the texts of another language\n")
        self.assertIn("[fanuc] A9000: state of the messages", self.run_rungc("explain", "A9000")[0])
        self.assertIn("[fanuc] R9000.1: 1 if the result", self.run_rungc("explain", "R9000")[0])

    def test_explain_in_a_project_shows_its_dialect(self):
        self.assertIn("[gsk] ", self.run_rungc("explain", "TMRB")[0])
        self.write("rung.toml", 'dialect = "fanuc"\nfiles = ["lamp.mne"]\n')
        self.assertNotIn("[gsk] ", self.run_rungc("explain", "TMRB")[0])

    def test_a_file_without_a_command_may_be_incomplete(self):
        note = "note: the file may be incomplete: it has no section %@3, or no command in it"
        for text in ("", "%@A\n%@2-C\nX9.0 START\n%\n"):
            self.write("part.mne", text)
            self.assertEqual(self.run_rungc("check", "part.mne", status=WRONG)[1].count(note), 1)
        self.write("part.mne", "%@3\nRD X9.0\nWRT Y9.0\n")
        self.assertNotIn(note, self.run_rungc("check", "part.mne", status=WRONG)[1])

    def test_a_file_may_be_incomplete(self):
        whole = "%@A\n%@3\nSUB 1\nRD X9.0\nWRT Y9.0\nSUB 2\nSUB 64\n%\n%@4\nA0.0 1000 TEXT\n%\n%@E\n"
        section = "warning: the section {} does not end with a line that is %; the file may be incomplete [incomplete-file]"
        for text, warning in ((whole, ""), (whole + "\x1a", ""), (whole[:-4] + "\x1a", "warning: %@A is not followed by %@E; the file may be incomplete"),
                              (whole[:-6], "part.mne:9:1: " + section.format("%@4")), (whole.replace("%\n%@4", "%@4"), "part.mne:2:1: " + section.format("%@3")),
                              ("%@2-E(SYM=1 ADR=2)\nA,X0.0\n" + whole, "part.mne:1:1: " + section.format("%@2-E"))):
            self.write("part.mne", text)
            said = self.run_rungc("check", "part.mne")[1]
            self.assertIn(warning, said)
            self.assertEqual(said.count("[incomplete-file]"), 1 if warning else 0, text)
        begin, end = whole.split("%@4")
        self.write("begin.mne", begin)
        self.write("end.mne", "%@4" + end)
        self.assertEqual(self.run_rungc("check", "begin.mne", "end.mne")[1], "")

    def test_a_byte_that_no_text_has(self):
        self.write("bad.mne", LADDER.replace("RD RUN\nTMRB", "RD R\0UN\nTMRB"))
        said = self.run_rungc("check", "bad.mne", status=WRONG)[1]
        self.assertIn(f"bad.mne:{TIMER}:5: error: character 0x00 has no meaning here [bad-character]", said)
        self.assertIn("note: a text has no such byte: the file was damaged, or it is not a text", said)

    def test_the_type_that_is_not_known_is_in_quotes(self):
        self.assertIn("the PMC type '' is not known", self.run_rungc("check", "lamp.mne", "--config", "pmc=")[1])

    def test_names_that_begin_like_a_comment(self):
        self.write("hash.mne", "%@2\nX9.0 #START\nY9.0 #LAMP=A\n%\n%@3\nSUB 1\nRD #START\nWRT #LAMP=A\nSUB 2\nSUB 64\n%\n")
        self.write("hash.scn", """program hash.mne
set "#START" 1
scan 2
expect "#LAMP=A" 1
print "#LAMP=A" "#not a name" "text"
""")
        self.assertIn("scan 2: #LAMP=A = 1, #not a name, text\n", self.run_rungc("test", "hash.scn")[0])
        self.write("wrong.scn", "program hash.mne\nset #START 1\n")
        self.assertIn("a name that begins with # is written in quotes", self.run_rungc("test", "wrong.scn", status=WRONG)[0])
        done = subprocess.run([Path(RUNGC).resolve(), "run", "-i", "hash.mne", "--set", "#START=1"], cwd=self.folder, capture_output=True, timeout=patience(), check=False,
                              text=True, input='watch "#LAMP=A"\nscan 2\ntoggle "#START"\nscan 2\nsave saved.scn\n')
        self.assertEqual((done.returncode, done.stderr), (OK, ""))
        saved = (self.folder / "saved.scn").read_text()
        self.assertEqual(saved.split("fanuc\n")[1], 'set "#START" 1\nscan 2\nset "#START" 0\nscan 2\nexpect "#LAMP=A" 0\n')
        self.assertIn("1 passed", self.run_rungc("test", "saved.scn")[0])

    def test_a_table_is_only_read_or_only_written_if_its_direction_never_changes(self):
        def ladder(direction, width):
            return f"""%@2
D500 TABLE
D200 DATA
D300 DIGITS
D309 NINTH
D310 TENTH
D400 NUMBER
D402 INDEX
%
%@3
SUB 1
RD {direction}
RD.STK R0.0
RD.STK X9.0
SUB 35
1
D0
TABLE
DATA
D1
WRT Y9.0
RD {width}
RD.STK {direction}
RD.STK R0.0
RD.STK X9.0
SUB 18
10
DIGITS
NUMBER
INDEX
WRT Y9.1
SUB 2
SUB 64
%
"""

        def rungs(place):
            entry, = json.loads(self.run_rungc("xref", "--format", "json", "table.mne", "--place", place)[0])
            return tuple({use["rung"] for use in entry[side]} for side in ("written", "read"))

        said = {"R9091.0": ("read", "written"), "R9091.1": ("written", "read"), "X9.7": ("read and written", "read and written")}
        for direction, (ofTable, ofData) in said.items():
            self.write("table.mne", ladder(direction, "R9091.0"))
            self.assertNotIn("error", self.run_rungc("check", "table.mne")[1])
            for name, line, rung, access in (("TABLE", 18, 1, ofTable), ("DATA", 19, 1, ofData), ("DIGITS", 28, 2, ofTable), ("NUMBER", 29, 2, ofData)):
                self.assertIn(f"{name}: {access} here", self.run_rungc("explain", f"table.mne:{line}:1")[0])
                self.assertEqual(rungs(name), ({rung} if "written" in access else set(), {rung} if "read" in access else set()), (direction, name))
        for width, tenth in (("R9091.0", set()), ("R9091.1", {2})):
            self.write("table.mne", ladder("R9091.0", width))
            self.assertEqual([rungs(name)[1] for name in ("DIGITS", "NINTH", "TENTH")], [{2}, {2}, tenth])

    def test_other_commands_show_a_few_warnings(self):
        for count in (10, 11):
            symbols = "".join(f"R{i}.0 NAME{i}\n" for i in range(count))
            self.write("many.mne", f"%@2\n{symbols}%\n%@3\nSUB 1\n" + "".join(f"RD NAME{i}\nWRT Y{i}.0\n" for i in range(count)) + "SUB 2\nSUB 64\n%\n")
            self.assertEqual(self.run_rungc("check", "many.mne")[1].count("[never-written]"), count)
            said = self.run_rungc("run", "many.mne", "--scans", "1", "--config", "pmc=PMC-SB7")[1]
            self.assertEqual(said.count("[never-written]"), 10 if count == 10 else 0)
            self.assertEqual("more than 10 warnings: `rungc check many.mne --config pmc=PMC-SB7` shows all\n" in said, count == 11)
        report = json.loads(self.run_rungc("build", "--json", "many.mne", "-o", "many.so")[0])
        self.assertEqual(len(report), 11)

    def test_explain_what_is_at_a_position(self):
        said = self.run_rungc("explain", f"lamp.mne:{LATCH}:4")[0]
        for part in ("start: read here", "start key", "declared at lamp.mne:5:6", "START (X9.0)"):
            self.assertIn(part, said)
        self.assertTrue(self.run_rungc("explain", "lamp.mne:21:1")[0].startswith("[fanuc] TMRB (function 24): on-delay timer"))
        self.assertTrue(self.run_rungc("explain", "lamp.mne:28:5")[0].startswith("[fanuc] DIFU (function 57): rising edge"))
        self.assertIn("[fanuc] *ESP: G8.4", self.run_rungc("explain", "G8.4")[0])

    def test_coverage_names_commands(self):
        said = self.run_rungc("test", "--coverage", "lamp.scn")[0]
        self.assertRegex(said, r"rungs run +5 of 5 ")
        for part in ("AND.NOT STOP (line 17) never open", "DIFU 1 (line 28) never off", "WRT R2.1 (line 38) never on"):
            self.assertIn(part, said)

    def test_diff_shows_changed_networks(self):
        self.write("new.mne", LADDER.replace("AND.NOT STOP", "AND STOP").replace("TMRB 1 16", "TMRB 1 24"))
        said = self.run_rungc("diff", "lamp.mne", "new.mne", status=WRONG)[0]
        self.assertIn(f'changed rung 1 "the latch", lamp.mne:{LATCH} to rung 1 "the latch", new.mne:{LATCH}\n', said)
        self.assertIn("  - TMRB 1 16\n", said)
        self.assertIn("  + TMRB 1 24\n", said)
        self.assertIn("rungs: 2 changed, 0 added, 0 removed, 0 moved, 3 unchanged", said)
        self.write("case.mne", LADDER.replace("WRT LAMP", "wrt lamp").replace("SUB 57", "DIFU"))
        self.assertIn("5 unchanged", self.run_rungc("diff", "lamp.mne", "case.mne")[0])

    def test_wcet_and_profile_name_networks(self):
        said = self.run_rungc("wcet", "lamp.mne")[0]
        self.assertRegex(said, r"LEVEL2: at most \d+ steps of a budget of 10000000")
        self.assertIn("LEVEL2: rungs 1-5", said)
        said = self.run_rungc("profile", "lamp.scn")[0]
        self.assertIn("5 of 5 rungs ran", said)
        self.assertRegex(said, rf"lamp\.mne:{TIMER} +the lamp")

    def test_profile_of_slots_alone(self):
        self.write("lamp.scn", "program lamp.mne\nset START 1\nslot 4\nexpect LAMP 1\n")
        said = self.run_rungc("profile", "lamp.scn")[0]
        self.assertIn("lamp.scn, 0 whole scans, ", said)
        self.assertIn("\nno scan was timed: only the statements scan and run make whole scans; ", said)
        self.assertRegex(said, r"\nLEVEL2 +4 ")
        for text in ("a scan takes", "whole scan ", "operations in a scan"):
            self.assertNotIn(text, said)

    def test_pins_of_a_template_keep_signs(self):
        names = {"+J1": "j1-plus", "-J1": "j1-minus", "*+L1": "l1-plus-not", "*-L1": "l1-minus-not", "C2-J1": "c2-j1-minus", "C2*ESP": "c2-esp-not",
                 "C2-PUMP": "c2-pump"}
        outputs = "".join(f"G{1100 + at}.0 {name}\n" for at, name in enumerate(names))
        self.write("axes.mne", LADDER.replace("P1 COUNT\n", outputs + "P1 COUNT\n")
                   .replace("SUB 2\n", "".join(f"RD START\nWRT {name}\n" for name in names) + "SUB 2\n"))
        said = self.run_rungc("map", "axes.mne", "--template")[0]
        for name, pin in names.items():
            self.assertIn(f'\n{pin} = {{ type = "bit", name = "{name}" }}', said)

    def test_a_number_of_a_message_leads_to_its_bit(self):
        self.write("texts.mne", LADDER.replace("SPE\nSUB 64\n%\n", "SPE\nSUB 64\n%\n%@4\nA1.2 1007 DOOR OPEN\n%\n").replace("WRT R2.1", "WRT A1.2"))
        done = subprocess.run([Path(RUNGC).resolve(), "run", "-i", "-q", "texts.mne"], cwd=self.folder, capture_output=True, text=True,
                              input="why 1007\nwhy EX1007\nwhy 1008\nwhy A1.2\n", timeout=patience(), check=False)
        for word in ("1007", "EX1007"):
            self.assertIn(f"'{word}' is a message, not a name of this program; its bit is A1.2\n", done.stdout)
        self.assertIn("'1008' is not a name of this program", done.stdout)
        self.assertIn("A1.2 = 0", done.stdout)

    def test_the_end_of_forces_is_said(self):
        done = subprocess.run([Path(RUNGC).resolve(), "run", "-i", "-q", "lamp.mne"], cwd=self.folder, capture_output=True, text=True,
                              input="force X9.1 1\nscan\nforce X9.0 1\nforces\nreplace lamp.mne\nforce X9.0 1\nwarm_start\nforce X9.0 1\nunforce\n",
                              timeout=patience(), check=False)
        for text in ("X9.0 = 1, since 0.008 s\n", "X9.1 = 1, since 0.000 s\n", "2 forces ended: X9.0, X9.1\n", "1 force ended: X9.0\n"):
            self.assertIn(text, done.stdout)
        self.assertEqual(done.stdout.count(" ended: "), 2, "unforce says nothing")

    def test_format(self):
        self.write("wild.mne", LADDER.replace("RD RUN", "  rd   RUN").replace("COUNT SP", " COUNT  sp"))
        self.assertEqual(self.run_rungc("format", "--check", "wild.mne", status=WRONG)[0], "wild.mne\n")
        self.run_rungc("format", "wild.mne", "lamp.mne")
        self.assertEqual((self.folder / "wild.mne").read_text(), (self.folder / "lamp.mne").read_text())
        self.assertIn("RD         RUN\nTMRB       1 16\nWRT        LAMP\n", (self.folder / "wild.mne").read_text())

    def test_commands_that_need_no_file(self):
        self.assertTrue(self.run_rungc("doc", "fanuc")[0].startswith("# "))
        self.assertIn("XMOVB", self.run_rungc("explain", "fanuc")[0])


if __name__ == "__main__":
    RUNGC = sys.argv.pop(1)
    unittest.main()
