#!/usr/bin/env python3
"""rungc wcet as a user sees it: wcet_test.py RUNGC [unittest arguments]"""
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

# The jump leaps over the third rung, which is heavier than the rest; the called one runs twice.
LADDER = """dialect nct
module MAIN

rung
|--[7000.00]--(7001.00)

rung
|--[7000.01]--{JMP #1}

rung "long"
|--[7000.02]--[/7000.03]--[7000.04]--[7000.05]--(7001.01)

rung
|--{JME #1}

rung
|--[7000.06]--{SBS #2}

rung
|--[7000.07]--{SBS #2}

rung
|--{END}

rung
|--{SBN #2}

rung "called"
|--[7000.02]--[7000.03]--(7001.02)

rung
|--[N_ON]--{RET}
"""

# A jump back to its own label, and a Level 1 without one.
LIST = """dialect gsk
LD   X10.0
OUT  Y10.0
FUNC END1
LD   X10.1
OUT  Y10.1
FUNC LBL
PRM  L1
LD   X10.2
AND  X10.3
OUT  Y10.2
LD   X10.4
FUNC JMPB
PRM  L1
LD   X10.5
OUT  Y10.3
FUNC END2
"""

# The longer of two ways.
ASSEMBLER = """DATA
        DFM  C,LOW
WAY:    DS 1
DATA_END
MODULE_INPUT
MODULE_INPUT_END
MODULE_MAIN
        LDR  C
        JL0  LEFT
        LOD  1
        JUM  BOTH
LEFT:   LOD  2
        INR
        INR
        INR
BOTH:   STO  WAY
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

def rungc(*arguments):
    return subprocess.run([RUNGC, *map(str, arguments)], capture_output=True, text=True, timeout=patience(300), errors="replace")


def without_figures(text):
    return re.sub(r"(machine instructions: )\d+", r"\1N", re.sub(r"[\d.e+]+ [num]?s\b", "TIME", text))


class Wcet(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def write(self, name, text):
        path = self.folder / name
        path.write_text(text)
        return path

    def tasks(self, *arguments):
        done = rungc("wcet", "--json", *arguments)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        report = json.loads(done.stdout)
        self.assertEqual(report["wcet"], 1)
        return {task["name"]: task for task in report["tasks"]}, report

    def output(self, *arguments):
        done = rungc("wcet", *arguments)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return done.stdout

    def text(self, *arguments):
        return without_figures(self.output(*arguments))

    def slice(self, *arguments):
        """What is said of the longest slice, in one line: where it is wrapped depends on its figures."""
        return without_figures(" ".join(self.output(*arguments).split("longest slice")[1].split()))

    def test_ladder_with_a_jump_and_calls(self):
        tasks, report = self.tasks(self.write("a.lad", LADDER))
        self.assertEqual((report["program"], report["dialect"]), ("a", "nct"))
        self.assertEqual(report["slice"]["steps"], 27)
        self.assertGreater(report["slice"]["time_ns"], 0)
        self.assertTrue(report["slice"]["fits"])
        main = tasks["MAIN"]
        self.assertEqual((main["steps"], main["path_steps"], main["budget"], main["parts"]), (27, 27, 1000000, 1))
        self.assertEqual(main["loops"], [])
        self.assertGreater(main["instructions"], 20)
        self.assertLess(main["instructions"], 400)
        self.assertEqual(main["calls"], [])
        self.assertEqual(main["path"][0], {
            "routine": "MAIN", "runs": 1, "steps": 27, "rungs": [[1, 7]], "index": [[0, 6]],
            "calls": [{"rung": 5, "index": 4, "routine": "MAIN.SBN2"}, {"rung": 6, "index": 5, "routine": "MAIN.SBN2"}]})
        self.assertEqual(main["path"][1], {
            "routine": "MAIN.SBN2", "runs": 2, "steps": 6, "rungs": [[8, 10]], "index": [[7, 9]], "calls": []})
        self.assertNotIn("measured", main)

    def test_ladder_as_text(self):
        source = self.write("a.lad", LADDER)
        ways = self.text(source).split("longest slice")[0]
        self.assertEqual(ways, """MAIN: at most 27 steps of a budget of 1000000
  machine instructions: N
  time on this computer: TIME
  MAIN: rungs 1-7; calls MAIN.SBN2 from rungs 5-6
  MAIN.SBN2, 6 steps, 2 times: rungs 8-10

""")
        self.assertRegex(self.slice(source), r"^, including process-image copies: TIME: 27 steps of TIME at most \(rung .*\), and the period is TIME$")

    def test_list_with_a_loop(self):
        tasks, report = self.tasks(self.write("a.pmc", LIST))
        self.assertTrue(report["slice"]["loops"])
        self.assertEqual((tasks["LEVEL1"]["steps"], tasks["LEVEL1"]["loops"]), (3, []))
        level2 = tasks["LEVEL2"]
        self.assertEqual((level2["steps"], level2["path_steps"]), (1000000, 13))
        self.assertEqual([loop["rungs"] for loop in level2["loops"]], [[[3, 5]]])
        self.assertEqual(level2["path"][0]["rungs"], [[2, 6]])
        self.assertGreater(level2["instructions"], 1000000)
        text = self.text(self.write("a.pmc", LIST))
        self.assertIn("LEVEL2: at most 1000000 steps, the whole budget: the program may loop\n", text)
        self.assertIn("  loop: rungs 3-5, LEVEL2\n"
                      "  the budget of 1000000 steps ends the run; with each loop run once, the longest path has 13\n", text)

    def test_slice_of_a_program_that_loops(self):
        """Its bound has each loop once, so it says nothing of the longest that a slice may last."""
        source = self.write("a.pmc", LIST)
        report = self.tasks(source)[1]
        self.assertLess(report["slice"]["time_ns"], report["slice"]["period_ns"])
        self.assertIsNone(report["slice"]["fits"])
        self.assertRegex(self.slice(source), r"^, including process-image copies, each loop \(rungs 3-5, LEVEL2\) counted once: TIME: \d+ steps of TIME at most .*, "
                                             r"and the period is TIME; a run that loops may last TIME$")
        once = self.write("b.pmc", LIST.replace("FUNC JMPB\nPRM  L1\n", "OUT Y10.4\n").replace("FUNC LBL\nPRM  L1\n", ""))
        self.assertTrue(self.tasks(once)[1]["slice"]["fits"])
        self.assertNotIn("loop", self.output(once))

    def test_assembler_with_two_ways(self):
        tasks, _ = self.tasks(self.write("a.plc", ASSEMBLER))
        self.assertEqual((tasks["MAIN"]["steps"], tasks["MAIN"]["path"][0]["rungs"]), (8, [[1, 1], [3, 4]]))
        self.assertIn("  MODULE_MAIN: rungs 1, 3-4\n", self.text(self.write("a.plc", ASSEMBLER)))

    def test_calls_of_the_host(self):
        tasks, _ = self.tasks(self.write("a.plc", ASSEMBLER.replace("JUM  BOTH", "ESET 3\n        JUM  BOTH")))
        (call,) = tasks["MAIN"]["calls"]
        self.assertEqual((call["function"], call["count"]), ("message", 1))
        self.assertGreater(call["call_ns"], 0)
        self.assertRegex(self.text(self.folder / "a.plc"), r"(?s)MAIN: .*machine instructions: N, and at most 1 call of message\n"
                         r"  time on this computer: TIME, TIME of it in these calls\n")

    def test_what_runs_took(self):
        self.write("a.lad", LADDER)
        scenario = self.write("a.scn", "program a.lad\nset 7000.01 1\nset 7000.06 1\nscan 3\nset 7000.07 1\nscan 2\n")
        tasks, report = self.tasks("--scenario", scenario)
        self.assertEqual(report["measured_by"], str(scenario))
        self.assertEqual((tasks["MAIN"]["measured"]["runs"], tasks["MAIN"]["measured"]["steps"]), (5, 22)) # 27 but the 5 of the third
        self.assertGreater(tasks["MAIN"]["measured"]["time_ns"], 0)
        self.assertIn("  measured in 5 runs: 22 steps, TIME including process-image copies\n", self.text("--scenario", scenario))

    def test_the_machines_of_the_examples(self):
        for folder, scenario in (("fanuc-vmc", "tool-change.scn"), ("gsk-mill", "tool-change.scn"), ("nct-turning-centre", "turret.scn"),
                                 ("technol-machining-centre", "tool-change.scn")):
            machine = Path("examples") / folder
            tasks, report = self.tasks("--scenario", machine / scenario)
            ran = [task for task in tasks.values() if task["measured"]["runs"] > 0]
            self.assertGreater(len(ran), 0)
            for task in tasks.values():
                self.assertEqual(task.get("no_instructions"), None, task["name"])
                self.assertLessEqual(task["measured"]["steps"], task["steps"], task["name"])
                self.assertLessEqual(task["path_steps"], task["budget"], task["name"])
                calls = sum(call["count"] * call["call_ns"] for call in task["calls"])
                self.assertAlmostEqual(task["time_ns"], task["steps"] * report["slice"]["step_ns"] + calls, places=0)

    def assertFails(self, status, message, *arguments):
        done = rungc("wcet", *arguments)
        self.assertEqual((done.returncode, done.stdout), (status, ""))
        self.assertIn(message, done.stderr)

    def test_wrong_input(self):
        program = self.write("a.lad", LADDER)
        self.assertFails(2, "wcet needs the sources: 'a.so' is a compiled program", "a.so")
        self.assertFails(3, "cannot read 'none.lad'", "none.lad")
        self.assertFails(1, "error:", self.write("bad.lad", LADDER.replace("{JME #1}", "{JME #3}")))
        self.assertFails(1, "error:", "--json", self.folder / "bad.lad")
        self.assertFails(3, "none.scn", program, "--scenario", "none.scn")
        self.assertFails(1, "a.scn:2: ", "--scenario",
                         self.write("a.scn", "program a.lad\nexpect 7001.00 1\n"))
        self.assertFails(1, "a.scn:2: ", "--scenario", self.write("a.scn", "program a.lad\nset NOTHING 1\n"))


if __name__ == "__main__":
    go_to_root()
    RUNGC = sys.argv.pop(1)
    unittest.main()
