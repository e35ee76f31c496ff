#!/usr/bin/env python3
"""`replace` in scenarios and at the prompt of rungc run: what it says, and what of the machine goes along.
tools_test.py RUNGC [--long]

With --long on all engines, else on the interpreter and the JIT."""
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

RUNGC = ""
ENGINES = "jit,interp"
OK, WRONG, USAGE, ENVIRONMENT = 0, 1, 2, 3
PATIENCE = 300

LAMP = """dialect nct
module MAIN

symbol SWITCH 5100.00 ; allow(never-written)
symbol LAMP   5101.00
symbol COUNT  5300
symbol T_OFF  5200

rung "counts"
|--[@SWITCH]--{ADD COUNT COUNT #1}

rung
|--[SWITCH]--{TOND T_OFF #1 #1}--(LAMP)
"""
# another output, and a name more
LAMP2 = LAMP.replace("symbol T_OFF", "symbol BEACON 5101.01\nsymbol T_OFF") + """
rung
|--[SWITCH]--(BEACON)
"""

# A mechanism that waits for a second, then for an input.
MECHANISM = """DATA
        DFM  DONE
COUNT:  DS 2
TEXT:   STR 8,'before'
DATA_END
MODULE_MAIN
        MECH_BEGIN GO
        TIM  -,50
        FL   1,DONE
        MECH_END GO
        LOD  COUNT
        INR
        STO  COUNT
MODULE_MAIN_END
MODULE_INIT
        SHARE_VAR COUNT,'Machine.Count',TYPE_WORD
        SHARE_VAR TEXT,'Machine.Text',TYPE_STR
MODULE_INIT_END
""" + "".join(f"MODULE_{name}\nMODULE_{name}_END\n" for name in ("INPUT", "BLOCK_INIT", "BLOCK_DONE", "CLEAR", "HALT")) + "STOP\n"

GSK = "FUNC END1\n" + "LD   X0.0\nOUT  Y0.0\n" * 3 + "FUNC END2\n"
READS = "LD   R0.0\nFUNC WINDR\nPRM  D100\nPRM  R10\nOUT  R0.1\n"
WRITES = "LD   R0.2\nFUNC WINDW\nPRM  D200\nPRM  R11\nOUT  R0.3\n"


class Folder(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.addCleanup(self.scratch.cleanup)
        self.folder = Path(self.scratch.name)
        self.file("lamp.lad", LAMP)
        self.file("lamp2.lad", LAMP2)

    def file(self, name, text):
        path = self.folder / name
        path.parent.mkdir(exist_ok=True)
        path.write_text(text, encoding="utf-8")

    def rungc(self, *args, stdin=""):
        return subprocess.run([RUNGC, *args], cwd=self.folder, input=stdin, capture_output=True, text=True,
                              timeout=PATIENCE)

    def scenario(self, text, *args):
        self.file("a.scn", text)
        return self.rungc("test", "a.scn", *args)

    def passes(self, text, *args):
        done = self.scenario(text, *(args or ("--engine", ENGINES, "-O", "0")))
        self.assertEqual((done.returncode, done.stderr), (OK, ""), done.stdout)
        return done.stdout

    def fails(self, text, *expected, status=WRONG, args=()):
        done = self.scenario(text, *args)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        for part in expected:
            self.assertIn(part, done.stdout)


class Scenarios(Folder):
    def test_there_and_back(self):
        self.passes("""program lamp.lad
set SWITCH 1
scan
expect COUNT 1
run 500ms
replace lamp2.lad
expect_no_change
scan
expect BEACON 1
expect LAMP 0
run 500ms
expect LAMP 1
expect COUNT 1
set SWITCH 0
scan
set SWITCH 1
scan
expect COUNT 2
replace lamp.lad
expect_change removed BEACON
expect_no_change
scan
expect 5101.01 1
cold_start
scan
expect COUNT 0
replace lamp.lad
expect_no_change
""")

    def test_what_the_report_has(self):
        self.file("next.lad", LAMP.replace("COUNT  5300", "COUNT  5310").replace("SWITCH 5100.00", "SWITCH 5100.01"))
        self.fails("program lamp.lad\nreplace next.lad\nexpect_change new COUNT\n", "a.scn:3: the report does not contain: "
                   "new COUNT; it contains: moved COUNT, moved SWITCH (before the first scan)")
        self.fails("program lamp.lad\nreplace next.lad\nexpect_change moved SWITCH\nexpect_no_change\n",
                   "a.scn:4: there are changes that no expect_change names: moved COUNT")
        self.fails("program lamp.lad\nreplace next.lad\nexpect_change moved COUNT\nexpect_change moved COUNT\n",
                   "a.scn:4: the report does not contain: moved COUNT; it contains: moved SWITCH")
        self.fails("program lamp.lad\nscan\nexpect_no_change\n", "a.scn:3: no program has been replaced")

    def test_mistakes(self):
        form = "expect_change new|removed|moved|retyped|released|cut [state] NAME | expect_change renamed FORMER NAME"
        self.file("wrong.lad", LAMP.replace("(LAMP)", "(LUMP)"))
        self.file("other.pmc", GSK)
        self.fails("program lamp.lad\nreplace\nexpect_change\nexpect_change gone A\nexpect_change renamed A\n"
                   "expect_change new A B\nexpect_no_change A\nreplace wrong.lad\nreplace other.pmc\n",
                   "a.scn:2: expected a file (the statement is: replace FILE…)",
                   f"a.scn:3: expected new, removed, moved, retyped, released, cut or renamed (the statement is: {form})",
                   "a.scn:4: expected new, removed, moved, retyped, released, cut or renamed, found 'gone'",
                   "a.scn:5: expected the new name", "a.scn:6: unexpected 'B' after the statement",
                   "a.scn:7: unexpected 'A' after the statement",
                   "a.scn:8: the program has errors:\nwrong.lad:13:", "error: 'LUMP' is not declared [undeclared-symbol]",
                   "a.scn:9: other.pmc has the dialect gsk, but the running program has nct")
        self.fails("program lamp.lad\nreplace none.lad\nexpect_no_change\n", "cannot read 'none.lad'",
                   status=ENVIRONMENT)

    def test_names_are_those_of_the_program_that_runs_then(self):
        self.fails("program lamp.lad\nset BEACON 1\nreplace lamp2.lad\nexpect BEACON 0\nreplace lamp.lad\n"
                   "expect BEACON 0\n", "a.scn:2: 'BEACON' is not a name of this program",
                   "a.scn:6: 'BEACON' is not a name of this program")

    def test_a_cell_may_be_called_state(self):
        self.file("now.lad", LAMP.replace("COUNT", "state"))
        self.file("next.lad", LAMP.replace("COUNT", "state").replace("5300", "5310"))
        self.passes("program now.lad\nreplace next.lad\nexpect_change moved state\nexpect_no_change\n")

    def test_between_two_passes(self):
        self.file("a.pmc", GSK)
        self.file("b.pmc", GSK.replace("Y0.0", "Y0.1"))
        self.fails("program a.pmc\nperiod 24ms\nslot\nreplace b.pmc\nexpect_no_change\n",
                   "a.scn:4: the program is within a scan (scan 1, 0.008 s)")
        self.passes("program a.pmc\nperiod 24ms\nset X0.0 1\nslot\nscan\nreplace b.pmc\nexpect_change released Y0.0\nexpect_no_change\n"
                    "expect Y0.0 0\nscan\nexpect Y0.1 1\n")

    def test_an_output_that_nobody_writes(self):
        """Of NCT the bits of a byte have different writers, and the image of an output is copied to it bit by bit."""
        head = "dialect nct\nmodule MAIN\nsymbol PUMP OUT000.03\n\nrung\n|--[INP000.00]--(OUT000.00)\n"
        self.file("a.lad", head + "\nrung\n|--[INP000.00]--(PUMP)\n")
        self.file("b.lad", head)
        self.passes("program a.lad\nset INP000.00 1\nscan 2\nexpect PUMP 1\nreplace b.lad\nexpect_change released PUMP\n"
                    "expect_no_change\nexpect PUMP 0\nexpect OUT000.00 1\nscan 2\nexpect PUMP 0\nexpect OUT000.00 1\n")

    def test_a_mechanism_that_waits(self):
        self.file("a.plc", MECHANISM)
        self.file("b.plc", MECHANISM.replace("TIM  -,50", "TIM  -,60"))
        self.file("c.plc", MECHANISM.replace("COUNT:  DS 2", "MORE:   DS 4\nCOUNT:  DS 2"))
        self.fails("program a.plc\nset GO 1\nscan 10\nreplace b.plc\nexpect_no_change\n",
                   "a.scn:4: MECH.GO.CONT waits at an instruction that the new program does not have (scan 10, 0.200 s)")
        self.passes("""program a.plc
set GO 1
scan 10
replace c.plc
expect_change new MORE
expect_change moved COUNT
expect_change moved TEXT
expect_no_change
expect Machine.Count 10
expect Machine.Text "before"
set COUNT 77
expect Machine.Count 77
scan 39
expect DONE 0
scan 2
expect DONE 1
replace b.plc
expect Machine.Text "before"
expect Machine.Count 118
""")

    def test_requests_that_wait_are_answered_to_the_new_program(self):
        self.file("a.pmc", f"FUNC END1\n{READS}{WRITES}FUNC END2\n")
        self.file("b.pmc", f"FUNC END1\n{WRITES}{READS}FUNC END2\n")  # numbers the services otherwise
        self.file("c.pmc", f"FUNC END1\n{WRITES}FUNC END2\n")
        asked = """program a.pmc
set D100:2 1
set D104:2 4
set D106:2 2
set D108:2 1
set R0.0 1
scan
"""
        answered = """reply end=0 data=-1234567
scan 2
expect R0.1 1
expect D110:4 -1234567
"""
        self.passes(f"{asked}replace b.pmc\nexpect_no_change\nexpect_call windr function=1 number=2\n{answered}")
        self.passes(f"{asked}expect_call windr\nreplace b.pmc\nexpect_no_change\n{answered}")
        self.passes(f"{asked}replace c.pmc\nexpect_no_call\nscan 3\nexpect_no_call\n")  # nobody waits any more
        # what the WINDR that is gone has locked is free: whether it waited or had finished
        written = "set D200:2 4\nset D204:2 4\nset D206:2 7\nset D208:2 2\nset R0.2 1\nscan\n"
        self.passes(f"{asked}{written}expect_call windr\nexpect_no_call\nreplace c.pmc\nscan\nexpect_call windw number=7\n")
        self.passes(f"{asked}expect_call windr\n{answered}{written}expect_no_call\nreplace c.pmc\nscan\nexpect_call windw number=7\n")
        # and what another one has locked is not
        self.passes(f"program a.pmc\n{written}expect_call windw\nreplace c.pmc\nscan\nexpect_no_call\n")

    def test_coverage_counts_both_programs(self):
        self.passes("program lamp.lad\nset SWITCH 1\nscan\nreplace lamp2.lad\nscan\nexpect BEACON 1\n", "--coverage")

    def test_a_profile_is_of_one_program(self):
        self.file("a.scn", "program lamp.lad\nscan\nreplace lamp2.lad\nscan\nexpect COUNT 0\n")
        done = self.rungc("profile", "a.scn")
        self.assertNotEqual(done.returncode, OK)
        self.assertIn("the scenario replaces its program; a profile needs a single program", done.stdout + done.stderr)

    def test_why_speaks_of_the_program_that_runs(self):
        self.fails("program lamp.lad\nscan 3\nreplace lamp2.lad\nset SWITCH 1\nscan\nexpect BEACON 0\n",
                   "BEACON (5101.01) = 1, since scan 4, 0.040 s", "SWITCH (5100.00) = 1, since scan 4",
                   "lamp2.lad:")
        self.fails("program lamp.lad\nscan 3\nreplace lamp2.lad\nscan\nexpect BEACON 1\n",
                   "BEACON (5101.01) = 0, since scan 4, 0.040 s", "SWITCH (5100.00) = 0, since scan 4",
                   "as the program was started, or a state loaded", ": replace lamp2.lad")

    def test_a_trace_follows_the_names(self):
        self.file("next.lad", LAMP.replace("COUNT  5300", "COUNT  5310").replace("LAMP", "LIGHT"))
        self.passes("program lamp.lad\nset SWITCH 1\nset COUNT 5\nscan\nreplace next.lad\nscan\nexpect COUNT 6\n",
                    "--trace", "t.csv", "--watch", "COUNT", "LAMP")
        rows = (self.folder / "t.csv").read_text(encoding="utf-8").splitlines()
        self.assertEqual(rows, ["time_s,scan,COUNT,LAMP", "0.000000,0,0,0", "0.010000,1,6,0", "0.020000,2,6,"])
        self.passes("program lamp.lad\nset SWITCH 1\nscan\nreplace next.lad\nscan\nexpect COUNT 1\n",
                    "--trace", "t.vcd", "--watch", "LAMP")
        self.assertIn("\nx!\n", (self.folder / "t.vcd").read_text(encoding="utf-8"))


class Shadows(Folder):
    """`shadow FILE…`: the same inputs, and what differs."""

    def setUp(self):
        super().setUp()
        self.file("late.lad", LAMP.replace("#1 #1", "#2 #1"))  # the lamp is lit a second later

    def test_a_program_that_does_the_same(self):
        self.passes("program lamp.lad\nshadow lamp.lad\nset SWITCH 1\nscan 50\nset SWITCH 0\nscan 5\nexpect_no_difference\n")

    def test_what_differs_is_named(self):
        scenario = "program lamp.lad\nshadow late.lad\nset SWITCH 1\nscan 110\n"
        both = "expect_difference LAMP\nexpect_difference T_OFF\n"
        self.passes(scenario + both + "expect_no_difference\nexpect LAMP 1\n")
        self.fails(scenario + "expect_no_difference\n",
                   "a.scn:5: there are differences that no expect_difference names: LAMP is 1, and 0 in the shadow (first at 1.0",
                   "; T_OFF is 1000, and 2000 in the shadow (first at 0.010 s)")
        self.fails(scenario + "expect_difference COUNT\n", "a.scn:5: COUNT did not differ; the differences are: LAMP is 1, and 0")
        self.fails(scenario + both + "expect_difference LAMP\n", "a.scn:7: the shadow shows no difference")

    def test_the_shadow_writes_nothing(self):
        self.passes("program lamp.lad\nshadow late.lad\nset SWITCH 1\nscan 2\nexpect COUNT 1\nscan 110\nexpect LAMP 1\nexpect COUNT 1\n")

    def test_it_begins_with_the_state_of_the_running_program(self):
        self.passes("program lamp.lad\nset SWITCH 1\nscan 10\nexpect COUNT 1\nshadow lamp2.lad\nscan 10\nexpect_no_difference\n")

    def test_every_engine_has_its_own(self):
        self.fails("program lamp.lad\nshadow late.lad\nset SWITCH 1\nscan 110\nexpect_no_difference\n", "[interp] there are differences",
                   args=("--engine", "all", "-O", "0"))

    def test_its_end(self):
        self.fails("program lamp.lad\nshadow lamp.lad\nshadow\nexpect_no_difference\n", "a.scn:4: no program runs beside this one")
        self.fails("program lamp.lad\nshadow lamp.lad\nreplace lamp2.lad\nexpect_no_difference\n", "a.scn:4: no program runs beside")
        self.fails("program lamp.lad\nshadow lamp.lad\nscan\ncold_start\nexpect_no_difference\n",
                   "a.scn:5: the shadow has ended together with the program")
        self.fails("program lamp.lad\nscan\nexpect_difference LAMP\n", "a.scn:3: no program runs beside this one: write shadow FILE… before")

    def test_its_fault(self):
        self.file("a.pmc", GSK)
        self.file("b.pmc", GSK.replace("FUNC END2", "FUNC LBL\nPRM  L1\nLD   X0.0\nFUNC JMPB\nPRM  L1\nFUNC END2"))
        self.fails("program a.pmc\nshadow b.pmc\nscan 2\nset X0.0 1\nscan 3\nexpect_no_difference\n",
                   "a.scn:6: the shadow has stopped with a fault: ")

    def test_what_cannot_run_beside_it(self):
        self.file("other.pmc", GSK)
        self.file("a.lad", LAMP.replace("(LAMP)", "(LUMP)"))
        self.fails("program lamp.lad\nshadow other.pmc\nscan\nexpect_no_difference\n",
                   "a.scn:2: other.pmc has the dialect gsk, but the running program has nct")
        self.fails("program lamp.lad\nshadow a.lad\nscan\nexpect_no_difference\n", "a.scn:2: the program has errors:", "undeclared-symbol")

    def test_requests_of_the_shadow_alone(self):
        self.file("a.pmc", "FUNC END1\nLD   R0.0\nOUT  Y0.0\nFUNC END2\n")
        self.file("b.pmc", f"FUNC END1\n{READS}LD   R0.0\nOUT  Y0.0\nFUNC END2\n")
        asked = "program a.pmc\nset D100:2 1\nset D104:2 4\nset D106:2 2\nset D108:2 1\nset R0.0 1\nshadow b.pmc\nscan 4\nexpect_no_call\n"
        self.passes(asked + "expect_difference windr\n")


class Prompt(Folder):
    def typed(self, lines, *args):
        return self.rungc("run", "lamp.lad", "-i", "-q", *args, stdin=lines)

    def test_a_shadow(self):
        self.file("late.lad", LAMP.replace("#1 #1", "#1 #3"))
        done = self.typed("shadow late.lad\nscan 2\nset SWITCH 1\nscan 3\nscan 110\nshadow\nsave again.scn\n")
        self.assertEqual(done.returncode, OK, done.stdout)
        self.assertEqual(done.stdout.count("LAMP is 1, and 0 in the shadow (first at "), 1, done.stdout)
        self.assertIn("\nshadow late.lad\nscan 2\nset SWITCH 1\nscan 3\nscan 110\nshadow\n",
                      (self.folder / "again.scn").read_text(encoding="utf-8"))

    def test_how_long_a_slice_may_last(self):
        done = self.typed("scan\nreplace lamp2.lad\n")
        self.assertRegex(done.stdout, r"a slice may last [0-9.]+ [mun]s: [0-9]+ steps of [0-9.]+ [mun]s at most "
                         r"\(MAIN, lamp2\.lad:[0-9]")

    def test_the_report_and_watched_names(self):
        self.file("next.lad", LAMP.replace("COUNT  5300", "COUNT  5310").replace("LAMP", "LIGHT"))
        done = self.typed("set SWITCH 1\nscan\nwatch COUNT LAMP\nreplace next.lad\nCOUNT\nwhy COUNT\n")
        self.assertEqual((done.returncode, done.stderr), (OK, ""), done.stdout)
        self.assertIn("moved COUNT\nrenamed LAMP LIGHT\n", done.stdout)
        self.assertRegex(done.stdout, r"kept \d+ variables and \d+ internal states\n")
        self.assertIn("LAMP is gone", done.stdout)
        self.assertIn("COUNT = 1", done.stdout)
        self.assertIn("next.lad:", done.stdout)

    def test_what_cannot_take_over(self):
        self.file("wrong.lad", LAMP.replace("(LAMP)", "(LUMP)"))
        self.file("other.pmc", GSK)
        done = self.typed("scan\nreplace wrong.lad\nreplace other.pmc\nreplace none.lad\nreplace -\nreplace\nscan\n")
        self.assertEqual(done.returncode, WRONG)
        self.assertIn("error: 'LUMP' is not declared [undeclared-symbol]", done.stderr)
        for part in ("the running program has not changed",
                     "other.pmc has the dialect gsk, but the running program has nct", "cannot read 'none.lad'",
                     "another program comes from files", "expected a file"):
            self.assertIn(part, done.stdout)

    def test_a_saved_session_replaces_again(self):
        done = self.typed("set SWITCH 1\nscan\nreplace lamp2.lad\nscan\nwatch BEACON\nsave s/again.scn\n")
        self.assertIn("cannot write", done.stdout)
        (self.folder / "s").mkdir()
        done = self.typed("set SWITCH 1\nscan\nreplace lamp2.lad\nscan\nwatch BEACON\nsave s/again.scn\n")
        self.assertEqual(done.returncode, OK, done.stdout)
        saved = (self.folder / "s" / "again.scn").read_text(encoding="utf-8")
        self.assertIn("\nreplace ../lamp2.lad\n", saved)
        self.assertEqual(self.rungc("test", "s/again.scn").returncode, OK)

    def test_retained_memory_is_that_of_the_new_program(self):
        kept = LAMP.replace("COUNT  5300", "COUNT  PLCNVRAM")
        self.file("lamp.lad", kept)
        self.file("next.lad", kept.replace("COUNT  PLCNVRAM", "COUNT  PLCNVRAM,#3"))
        done = self.typed("set COUNT 41\nset SWITCH 1\nscan\nreplace next.lad\nscan\n", "--retain", "kept")
        self.assertEqual((done.returncode, done.stderr), (OK, ""), done.stdout)
        self.assertIn("moved COUNT", done.stdout)
        again = self.rungc("run", "next.lad", "-i", "-q", "--retain", "kept", stdin="COUNT\n")
        self.assertIn("COUNT = 42", again.stdout, again.stderr)

    def test_retained_memory_of_a_program_that_was_changed_meanwhile(self):
        kept = LAMP.replace("COUNT  5300", "COUNT  PLCNVRAM")
        self.file("lamp.lad", kept)
        self.file("next.lad", kept.replace("COUNT  PLCNVRAM", "COUNT  PLCNVRAM,#3"))
        self.typed("set COUNT 41\nset SWITCH 1\nscan\n", "--retain", "kept")
        again = self.rungc("run", "next.lad", "-i", "-q", "--retain", "kept", stdin="COUNT\n")
        self.assertIn("COUNT = 42", again.stdout, again.stderr)
        self.assertIn("made by a program with other retained cells; its cells are taken by name and address: moved COUNT",
                      again.stderr)

    def test_shared_objects(self):
        for name in ("lamp", "lamp2"):
            self.assertEqual(self.rungc("build", f"{name}.lad", "-o", f"{name}.so", "-q").returncode, OK)
        done = self.rungc("run", "lamp.so", "-i", "-q", stdin="set SWITCH 1\nscan\nreplace lamp2.so\nscan\nBEACON\nwhy BEACON\n"
                                                            "replace lamp.lad\nwhy COUNT\nsave a.scn\n")
        self.assertIn("BEACON = 1", done.stdout, done.stderr)
        self.assertRegex(done.stdout, r"BEACON .*= 1, .*\n    written by rung ")
        self.assertIn("lamp.lad:9", done.stdout)

    def test_it_is_listed(self):
        done = self.typed("help replace\nhelp expect_change\n")
        self.assertIn("replace FILE…", done.stdout)
        self.assertIn("expect_change", done.stdout)


def main():
    global RUNGC, ENGINES
    RUNGC = str(Path(sys.argv.pop(1)).resolve())
    if "--long" in sys.argv:
        sys.argv.remove("--long")
        ENGINES = "all"
    unittest.main()


if __name__ == "__main__":
    main()
