#!/usr/bin/env python3
"""rungc test --coverage: numbers of small programs counted by hand, its options, the examples. coverage_test.py RUNGC"""
import json
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

# Rung 1: (START or PUMP) and not STOP. Rung 2: PUMP switches a timer, the timer READY. Rung 3 never runs.
NCT = """dialect nct
module MAIN

symbol START   5100.00
symbol STOP    5100.01
symbol LAMP    5100.02
symbol PUMP    5101.00
symbol READY   5101.01
symbol NEVER   5101.02
symbol T_WARM  5200

rung "latch"
|--[START]--+--[/STOP]--(PUMP)
|--[PUMP]---+

rung "warm"
|--[PUMP]--{TOND T_WARM #1 #0}--(READY)

rung "over the next"
|--[/LAMP]--{JMP 1}

rung "left out"
|--[LAMP]--(NEVER)

rung
|--{JME 1}
"""

NCT_ON = """program lamp.lad
scan
set START 1
scan
expect PUMP 1
set START 0
scan
expect PUMP 1
"""
NCT_OFF = """program lamp.lad
set START 1
scan
set STOP 1
scan
expect PUMP 0
"""

# Level 1 is empty. P1 is called by both levels: one rung in two routines.
GSK = """FUNC END1
LD   X0.0
ANI  X0.1
LD   R1.0
ANI  X0.2
ORB
OUT  Y0.0
OUT  R1.0
FUNC END2
"""
GSK_SCN = """program lamp.pmc
scan
set X0.0 1
scan
expect Y0.0 1
set X0.1 1
set X0.2 1
scan
expect Y0.0 0
"""

TECHNOL = """DATA
GO:     DFM  GO_BIT,DOOR,PUMP,LAMP,,,,
COUNT:  DS 1
DATA_END
MODULE_INPUT
MODULE_INPUT_END
MODULE_MAIN
        LDR  GO_BIT
        LA   -DOOR
        LO   PUMP
        WR   PUMP
        LDR  PUMP
        JL0  NEXT
        FL   1,LAMP
NEXT:
MODULE_MAIN_END
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

STOP
"""
TECHNOL_SCN = """program main.plc
scan
set GO_BIT 1
scan
expect PUMP 1
expect LAMP 1
"""


def run(*args, cwd=None):
    return subprocess.run([RUNGC, *map(str, args)], cwd=cwd, capture_output=True, text=True, timeout=patience(300))


class Coverage(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def write(self, **files):
        for name, text in files.items():
            self.folder.joinpath(name.replace("__", ".")).write_text(text, encoding="utf-8")

    def coverage(self, *args, status=OK):
        """The JSON of a run in the folder."""
        done = run("test", *args, "--coverage-json", "out.json", cwd=self.folder)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return json.loads(self.folder.joinpath("out.json").read_text(encoding="utf-8"))

    def assertTotals(self, totals, rungs, contacts, coils, conditions):
        found = {name: (share["seen"], share["all"]) for name, share in totals.items()}
        self.assertEqual(found, {"rungs": rungs, "contacts": contacts, "coils": coils, "conditions": conditions})

    @staticmethod
    def deciding(rung):
        """(outputs, condition) -> situations"""
        return {(" ".join(rung["outputs"][o]["text"] for o in decision["outputs"]),
                 rung["conditions"][by["condition"]]["text"]): (set(by["alone"]), by["both_ways"])
                for decision in rung["decisions"] for by in decision["by"]}


class Nct(Coverage):
    def setUp(self):
        super().setUp()
        self.write(lamp__lad=NCT, on__scn=NCT_ON, off__scn=NCT_OFF)

    def test_one_scenario(self):
        report = self.coverage("on.scn")
        program, = report["programs"]
        self.assertEqual(program["files"], ["lamp.lad"])
        latch, warm, over, left, label = program["rungs"]
        self.assertEqual([r["number"] for r in program["rungs"]], [1, 2, 3, 4, 5])
        self.assertEqual((latch["title"], latch["file"], latch["line"]), ("latch", "lamp.lad", 12))
        self.assertEqual([r["runs"] for r in program["rungs"]], [3, 3, 3, 0, 3])
        self.assertEqual([(c["text"], c["line"], c["column"], c["open"], c["closed"]) for c in latch["conditions"]],
                         [("[START]", 13, 4, True, True), ("[PUMP]", 14, 4, True, True),
                          ("[/STOP]", 13, 16, False, True)])
        # 1: all off; 2: START; 3: PUMP alone holds itself.
        self.assertEqual(self.deciding(latch), {("(PUMP)", "[START]"): ({"open/off", "closed/on"}, True),
                                                ("(PUMP)", "[PUMP]"): ({"open/off", "closed/on"}, True),
                                                ("(PUMP)", "[/STOP]"): ({"closed/on"}, False)})
        self.assertEqual([(c["text"], c["kind"]) for c in warm["conditions"]],
                         [("[PUMP]", "contact"), ("{TOND T_WARM #1 #0}", "result")])
        self.assertEqual([(o["text"], o["kind"], o["off"], o["on"]) for o in warm["outputs"]],
                         [("{TOND T_WARM #1 #0}", "input", True, True), ("(READY)", "coil", True, True)])
        self.assertEqual(self.deciding(over), {("{JMP 1}", "[/LAMP]"): ({"closed/on"}, False)})
        self.assertEqual([(c["open"], c["closed"]) for c in left["conditions"]], [(False, False)])
        self.assertEqual(label["conditions"], [])
        self.assertTotals(report["totals"], (4, 5), (3, 6), (2, 3), (4, 7))
        self.assertEqual(report["totals"]["conditions"]["one_way"], 2)

    def test_scenarios_are_added_up(self):
        report = self.coverage("on.scn", "off.scn")
        program, = report["programs"]
        self.assertEqual(program["rungs"][0]["runs"], 5)
        self.assertTrue(self.deciding(program["rungs"][0])["(PUMP)", "[/STOP]"][1])
        self.assertTotals(report["totals"], (4, 5), (4, 6), (2, 3), (5, 7))

    def test_threads_count_the_same(self):
        files = ["on.scn", "off.scn"] * 8
        one = self.coverage(*files, "-j", 1)
        self.assertEqual(self.coverage(*files, "-j", 4), one)

    def test_a_former_run(self):
        whole = self.coverage("on.scn", "off.scn")
        self.coverage("off.scn")
        self.folder.joinpath("out.json").rename(self.folder / "former.json")
        self.assertEqual(self.coverage("on.scn", "--coverage-merge", "former.json"), whole)

    def test_a_former_run_of_another_text(self):
        self.coverage("off.scn")
        self.folder.joinpath("out.json").rename(self.folder / "former.json")
        self.write(lamp__lad=NCT.replace("[/STOP]--(PUMP)", "[/STOP]--(PUMP)  ; changed").replace("[LAMP]--", "[START]--"))
        report = self.coverage("on.scn", "--coverage-merge", "former.json")
        self.assertEqual([r["runs"] for r in report["programs"][0]["rungs"]], [5, 5, 5, 0, 5])

    def test_text(self):
        done = run("test", "on.scn", "--coverage", cwd=self.folder)
        self.assertEqual(done.returncode, OK, done.stderr)
        for line in ["coverage of lamp.lad",
                     "  rungs run                      4 of 5       80.0 %",
                     "  contacts open and closed       3 of 6       50.0 %",
                     "  coils on and off               2 of 3       66.6 %",
                     "  conditions shown to decide     4 of 7       57.1 %  and 2 in one direction only",
                     '  rung 1 "latch" (lamp.lad:12)',
                     "    [/STOP] (line 13) never open",
                     '  rung 4 "left out" (lamp.lad:22) never ran']:
            self.assertIn(line, done.stdout.splitlines())

    def test_a_program_without_gaps(self):
        self.write(all__lad="dialect nct\nmodule MAIN\nrung\n|--[5100.00]--(5101.00)\n",
                   all__scn="program all.lad\nscan\nset 5100.00 1\nscan\nexpect 5101.00 1\n")
        done = run("test", "all.scn", "--coverage", "--coverage-min", 100, cwd=self.folder)
        self.assertEqual(done.returncode, OK, done.stdout + done.stderr)
        self.assertNotIn("not covered", done.stdout)

    def test_the_least(self):
        done = run("test", "on.scn", "--coverage-min", 60, cwd=self.folder)
        self.assertEqual(done.returncode, WRONG)
        self.assertIn("contacts open and closed 50.0 %, less than the 60 %", done.stderr)
        self.assertIn("conditions shown to decide 57.1 %", done.stderr)
        self.assertNotIn("coils", done.stderr)
        self.assertEqual(run("test", "on.scn", "--coverage-min", 50, cwd=self.folder).returncode, OK)
        self.assertEqual(run("test", "on.scn", "--coverage-min", 101, cwd=self.folder).returncode, USAGE)

    def test_failed_scenarios_count_and_fail(self):
        self.write(bad__scn=NCT_ON.replace("expect PUMP 1", "expect PUMP 0", 1))
        self.assertEqual(self.coverage("bad.scn", status=WRONG)["programs"][0]["rungs"][0]["runs"], 2)

    def test_bad_files(self):
        done = run("test", "on.scn", "--coverage-merge", "on.scn", cwd=self.folder)
        self.assertEqual(done.returncode, ENVIRONMENT)
        self.assertIn("'on.scn' is not a report of --coverage-json", done.stderr)
        done = run("test", "on.scn", "--coverage-merge", "none.json", cwd=self.folder)
        self.assertEqual((done.returncode, done.stderr), (ENVIRONMENT, "rungc: cannot read 'none.json': No such file or directory\n"))
        done = run("test", "on.scn", "--coverage-json", "no/folder.json", cwd=self.folder)
        self.assertEqual(done.returncode, ENVIRONMENT)

    def test_page(self):
        done = run("test", "on.scn", "--coverage-html", "out.html", cwd=self.folder)
        self.assertEqual((done.returncode, done.stderr), (OK, ""), done.stdout)
        self.assertIn("coverage of lamp.lad: out.html", done.stdout)
        page = self.folder.joinpath("out.html").read_text(encoding="utf-8")
        for text in ["rungs run: 4 of 5, 80.0 %", "contacts open and closed: 3 of 6, 50.0 %", "never open", "never ran",
                     "ran 3 times", "was shown to switch (PUMP) on, but never off"]:
            self.assertIn(text, page)

    def test_pages_of_several_programs(self):
        self.write(other__lad=NCT, other__scn=NCT_ON.replace("lamp.lad", "other.lad"))
        done = run("test", "on.scn", "other.scn", "--coverage-html", "out.html", cwd=self.folder)
        self.assertEqual(done.returncode, OK, done.stderr)
        self.assertTrue(self.folder.joinpath("out.html").exists() and self.folder.joinpath("out-2.html").exists())

    def test_other_engines(self):
        done = run("test", "on.scn", "--coverage", "--engine", "jit", cwd=self.folder)
        self.assertEqual(done.returncode, USAGE)
        self.assertIn("coverage needs the interpreter", done.stderr)
        self.assertEqual(run("test", "on.scn", "--coverage", "--engine", "interp", cwd=self.folder).returncode, OK)


class Gsk(Coverage):
    def test_list(self):
        self.write(lamp__pmc=GSK, lamp__scn=GSK_SCN)
        report = self.coverage("lamp.scn")
        rung, = report["programs"][0]["rungs"]
        self.assertEqual([(c["text"], c["line"], c["column"]) for c in rung["conditions"]],
                         [("LD   X0.0", 2, 1), ("ANI  X0.1", 3, 1), ("LD   R1.0", 4, 1), ("ANI  X0.2", 5, 1)])
        both = "OUT  Y0.0 OUT  R1.0"
        # 1: nothing closed but X0.1 and X0.2; 2: X0.0 closed; 3: R1.0 closed, X0.1 and X0.2 open.
        self.assertEqual(self.deciding(rung), {(both, "LD   X0.0"): ({"open/off", "closed/on"}, True),
                                               (both, "ANI  X0.1"): ({"closed/on", "open/off"}, True),
                                               (both, "LD   R1.0"): ({"open/off"}, False),
                                               (both, "ANI  X0.2"): ({"open/off"}, False)})
        self.assertTotals(report["totals"], (1, 1), (4, 4), (2, 2), (2, 4))

    def test_page_of_a_list(self):
        self.write(lamp__pmc=GSK, lamp__scn=GSK_SCN.replace("set X0.2 1\n", "").replace("expect Y0.0 0", "expect Y0.0 1"))
        done = run("test", "lamp.scn", "--coverage-html", "out.html", cwd=self.folder)
        self.assertEqual((done.returncode, done.stderr), (OK, ""), done.stdout)
        page = self.folder.joinpath("out.html").read_text(encoding="utf-8")
        self.assertEqual(page.count("never open"), 1) # X0.2
        self.assertIn("contacts open and closed: 3 of 4, 75.0 %", page)

    def test_ladder_text_counts_the_same(self):
        self.write(lamp__pmc=GSK, lamp__scn=GSK_SCN)
        totals = self.coverage("lamp.scn")["totals"]
        self.assertEqual(run("convert", "lamp.pmc", "--to", "ladder", "-o", "lamp.lad", cwd=self.folder).returncode, OK)
        self.write(lamp__scn=GSK_SCN.replace("lamp.pmc", "lamp.lad"))
        self.assertEqual(self.coverage("lamp.scn")["totals"], totals)

    def test_a_subprogram_of_both_levels_is_one_rung(self):
        calls = "LD   X0.7\nFUNC CALL\nPRM  P1\n"
        self.write(both__pmc=calls + "FUNC END1\n" + calls + "FUNC END2\nFUNC SP\nPRM  P1\nLD   X0.0\nOUT  R0.0\nFUNC SPE\n",
                   both__scn="program both.pmc\nscan\nset X0.7 1\nset X0.0 1\nscan\nexpect R0.0 1\n")
        first, second, sub = self.coverage("both.scn")["programs"][0]["rungs"]
        self.assertEqual([r["runs"] for r in (first, second, sub)], [2, 2, 2])
        self.assertEqual(len(sub["conditions"]), 1)

    def test_function_conditions(self):
        self.write(timer__pmc="FUNC END1\nLD   X0.0\nFUNC TMRB\nPRM  1\nPRM  16\nOUT  R0.0\nFUNC END2\n",
                   timer__scn="program timer.pmc\nscan\nset X0.0 1\nrun 100ms\nexpect R0.0 1\n")
        rung, = self.coverage("timer.scn")["programs"][0]["rungs"]
        self.assertEqual([(c["text"], c["kind"]) for c in rung["conditions"]],
                         [("LD   X0.0", "contact"), ("TMRB 1 16", "result")])
        self.assertEqual([(o["text"], o["kind"]) for o in rung["outputs"]], [("TMRB 1 16", "input"), ("OUT  R0.0", "coil")])
        self.assertEqual([by["both_ways"] for d in rung["decisions"] for by in d["by"]], [True, True])


class Technol(Coverage):
    def test_equations(self):
        self.write(main__plc=TECHNOL, main__scn=TECHNOL_SCN)
        report = self.coverage("main.scn")
        rungs = [r for r in report["programs"][0]["rungs"] if r["conditions"]]
        write, jump = rungs
        self.assertEqual([(c["text"], c["line"], c["column"]) for c in write["conditions"]],
                         [("LDR GO_BIT", 8, 9), ("LA -DOOR", 9, 9), ("LO PUMP", 10, 9)])
        # 1: GO off; 2: GO on.
        self.assertEqual(self.deciding(write), {("WR PUMP", "LDR GO_BIT"): ({"open/off", "closed/on"}, True),
                                                ("WR PUMP", "LA -DOOR"): ({"closed/on"}, False),
                                                ("WR PUMP", "LO PUMP"): ({"open/off"}, False)})
        self.assertEqual(self.deciding(jump), {("JL0 NEXT", "LDR PUMP"): ({"open/off", "closed/on"}, True)})
        self.assertEqual(jump["outputs"][0]["kind"], "input")
        self.assertEqual((report["totals"]["contacts"], report["totals"]["coils"]),
                         ({"seen": 2, "all": 4}, {"seen": 1, "all": 1}))


    def test_drawing(self):
        self.write(main__plc=TECHNOL, main__scn=TECHNOL_SCN)
        done = run("test", "main.scn", "--coverage-html", "out.html", cwd=self.folder)
        self.assertEqual((done.returncode, done.stderr), (OK, ""), done.stdout)
        page = self.folder.joinpath("out.html").read_text(encoding="utf-8")
        self.assertIn('<g class="g am"><text x="156" y="58">never open</text>', page)  # below the contact of DOOR
        self.assertIn("contacts open and closed: 2 of 4, 50.0 %", page)


class Examples(Coverage):
    """Whole programs: every scenario passes under coverage, and what is counted is plausible."""

    def check(self, example, rungs, least):
        scenarios = sorted(Path("examples", example).glob("*.scn"))
        out = self.folder / "out.json"
        done = run("test", *scenarios, "--coverage", "--coverage-json", out)
        self.assertEqual(done.returncode, OK, done.stdout + done.stderr)
        report = json.loads(out.read_text(encoding="utf-8"))
        found = report["totals"]
        for name, share in found.items():
            self.assertGreaterEqual(100 * share["seen"] / share["all"], least, f"{name} {share}")
        self.assertGreaterEqual(found["rungs"]["all"], rungs)
        for program in report["programs"]:
            numbers = [rung["number"] for rung in program["rungs"]]
            self.assertEqual(numbers, list(range(1, len(numbers) + 1)))

    def test_fanuc_vmc(self):
        self.check("fanuc-vmc", 400, 75)

    def test_gsk_mill(self):
        self.check("gsk-mill", 500, 50)

    def test_nct_lathe(self):
        self.check("nct-lathe", 50, 50)

    def test_technol_mill(self):
        self.check("technol-mill", 50, 40)


if __name__ == "__main__":
    go_to_root()
    RUNGC = str(Path(sys.argv.pop(1)).resolve())
    unittest.main()
