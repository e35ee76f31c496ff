#!/usr/bin/env python3
"""rungc profile as a user sees it: profile_test.py RUNGC [unittest arguments]"""
import functools
import json
import os
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
MILL = Path("examples/gsk-mill")

# What lies below a jump runs when its input is on.
LAMP = """dialect nct
module MAIN

rung "lamp"
|--[5100.00]--(5101.00)

rung
|--[/5100.01]--{JMP #1}

rung "seldom"
|--[5100.02]--[/5100.03]--[5100.04]--[5100.05]--(5101.01)

rung
|--{JME #1}

rung
|--[/5100.06]--{JMP #2}

rung "never"
|--[5100.02]--(5101.02)

rung
|--{JME #2}
"""


def rungc(*arguments):
    return subprocess.run([RUNGC, *map(str, arguments)], capture_output=True, text=True, timeout=patience(300), errors="replace")

# A box that is evaluated while its input is on.
SUM = """dialect nct
module MAIN

rung "sum"
|--[5100.00]--{ADD 5200 5200 #1}
"""


class Profile(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def write(self, name, text):
        path = self.folder / name
        path.write_text(text)
        return path

    def profile(self, *arguments):
        done = rungc("profile", "--json", *arguments)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return json.loads(done.stdout)

    @staticmethod
    @functools.cache
    def tool_change():
        """What several tests look at."""
        return json.loads(rungc("profile", "--json", MILL / "tool-change.scn", "--repeat", 1).stdout)

    def scenario(self, name, text, program="lamp.lad"):
        if not (self.folder / "lamp.lad").exists():
            self.write("lamp.lad", LAMP)
        return self.write(name, f"program {program}\n{text}\nexpect 5101.02 0\n")

    def test_counts_are_the_same_in_every_run_and_on_every_engine(self):
        """The figures that the default order is made of: the whole list, six times."""
        exact = []
        for engine in ("jit", "jit", "jit", "jit", "interp", "llvm"):
            profile = self.profile(MILL / "tool-change.scn", "--engine", engine, "--repeat", 1)
            exact.append([(row["rung"], row["executions"], row["scans"], row["operations"]) for row in profile["rungs"]] + [profile["worst_by_operations"], profile["scan_operations"]])
        for other in exact[1:]:
            self.assertEqual(exact[0], other)

    def test_the_default_order_is_by_operations(self):
        profile = Profile.tool_change()
        operations = [row["operations"] for row in profile["rungs"]]
        self.assertEqual(operations, sorted(operations, reverse=True))
        self.assertAlmostEqual(sum(row["share"] for row in profile["rungs"] + profile["added"]), 1)
        self.assertEqual(profile["operations"], sum(row["operations"] for row in profile["rungs"] + profile["added"]))

    def test_by_time_is_ordered_by_the_mean_of_all_but_the_slowest_scans(self):
        profile = self.profile(MILL / "tool-change.scn", "--by", "time", "--repeat", 2)
        times = [row["time_ns"] for row in profile["rungs"]]
        self.assertEqual(times, sorted(times, reverse=True))
        for row in profile["rungs"]:
            self.assertAlmostEqual(row["time_ns"], row["scans"] * row["mean_ns"], delta=0.01 * row["time_ns"] + 0.1)
            self.assertLessEqual(row["min_ns"], row["median_ns"])
            self.assertLessEqual(row["median_ns"], row["p99_ns"])
            self.assertLessEqual(row["p99_ns"], row["max_ns"])

    def test_scans_are_held_against_their_periods(self):
        profile = self.profile(MILL / "tool-change.scn", "--repeat", 2)
        whole, *others = profile["deadlines"]
        self.assertEqual((whole["name"], whole["period_us"]), ("whole scan", 8000))
        self.assertEqual(whole["ns"]["count"], profile["scans"])
        self.assertAlmostEqual(whole["worst_percent"], whole["ns"]["max"] / 8000 / 10, places=6)
        self.assertEqual({o["name"] for o in others}, {"LEVEL1", "LEVEL2"})
        self.assertLess(whole["ns"]["median"], profile["measured_scan_ns"])
        self.assertGreater(profile["cost_ns"], 0)

    def test_parts_of_level_2_are_held_against_slots(self):
        scenario = self.write("slots.scn", f"program {(MILL / 'mill.pmc').resolve()}\nconfig slot_steps 500\nscan 20\nexpect READY 0\n")
        profile = self.profile(scenario, "--repeat", 1)
        whole, part, *tasks = profile["deadlines"]
        self.assertGreater(whole["period_us"], 8000)
        self.assertEqual((part["name"], part["period_us"]), ("time slice", 8000))
        self.assertEqual(part["ns"]["count"], whole["ns"]["count"] * whole["period_us"] / 8000)
        self.assertEqual([(t["name"], t["period_us"]) for t in tasks], [("LEVEL1", 8000), ("part of LEVEL2", 8000)])

    def test_the_worst_scan_is_named_and_explained(self):
        scenario = self.scenario("one.scn", "scan 5\nset 5100.01 1\nscan\nset 5100.01 0\nscan 5")
        worst = self.profile(scenario, "--repeat", 1)["worst_by_operations"]
        self.assertEqual((worst["scenario"], worst["scan"], worst["line"]), (str(scenario), 6, 4))
        self.assertGreater(worst["value"], worst["usual"])
        self.assertEqual(worst["causes"][0]["title"], "seldom")
        self.assertTrue(worst["causes"][0]["only_then"])
        text = rungc("profile", scenario, "--repeat", 1).stdout
        self.assertRegex(text, r'most operations: scan 6 at \S+ s \(\S*one\.scn:4\), \d+ operations, usually \d+ operations\n  \d+ operations, in no other scan: rung 3 "seldom", \S*lamp\.lad:10\n')

    def test_several_scenarios_are_one_profile(self):
        one = self.scenario("one.scn", "scan 3")
        two = self.scenario("two.scn", "set 5100.00 1\nscan 4\nexpect 5101.00 1")
        for arguments in ((one, two), ("--scenario", one, two), (one, "--scenario", two)):
            profile = self.profile(*arguments)
            self.assertEqual(profile["scans"], 7)
            self.assertEqual(len(profile["scenarios"]), 2)
            self.assertEqual(max(row["executions"] for row in profile["rungs"]), 7)

    def test_programs_instead_of_those_of_the_scenario(self):
        other = self.write("other.lad", 'dialect nct\nmodule MAIN\n\nrung "other"\n|--[5100.00]--(5101.00)\n')
        scenario = self.scenario("one.scn", "scan 3")
        self.assertEqual([row["title"] for row in self.profile("--scenario", scenario, other)["rungs"]], ["other"])
        self.assertEqual([row["title"] for row in self.profile(other, "--scenario", scenario)["rungs"]], ["other"])

    def test_scenarios_of_different_programs_are_refused(self):
        self.write("other.lad", 'dialect nct\nmodule MAIN\n\nrung "other"\n|--[5100.00]--(5101.00)\n')
        one = self.scenario("one.scn", "scan")
        two = self.scenario("two.scn", "scan", "other.lad")
        done = rungc("profile", one, two)
        self.assertEqual(done.returncode, 3, done.stdout)
        self.assertIn("two.scn", done.stdout)
        self.assertIn("a different program", done.stdout)

    def test_rungs_that_never_ran_are_counted_and_listed(self):
        scenario = self.scenario("one.scn", "scan 5")
        profile = self.profile(scenario, "--repeat", 1)
        self.assertEqual([row["title"] for row in profile["never"]], ["seldom", "never"])
        done = rungc("profile", scenario, "--repeat", 1)
        self.assertIn("; 2 never (--never lists them)", done.stdout)
        self.assertNotIn("never ran:", done.stdout)
        listed = rungc("profile", scenario, "--repeat", 1, "--never").stdout
        self.assertRegex(listed, r'never ran:\n  rung 3 "seldom", \S*lamp.lad:10\n  rung 6 "never", \S*lamp.lad:19\n')

    def test_sums_add_up(self):
        profile = Profile.tool_change()
        for sums in ("subprograms", "modules", "files"):
            self.assertEqual(sum(s["operations"] for s in profile[sums]), profile["operations"], sums)
        self.assertEqual(sum(s["ran"] for s in profile["subprograms"]), len(profile["rungs"]) + len(profile["added"]))
        self.assertIn("P5", [s["name"] for s in profile["subprograms"]])

    def test_baseline_names_what_changed(self):
        scenario = self.scenario("one.scn", "scan 5")
        old = self.write("old.json", rungc("profile", scenario, "--repeat", 1, "--json").stdout)
        self.write("lamp.lad", LAMP.replace("|--[5100.00]--(5101.00)", "|--[5100.00]--[5100.07]--(5101.00)") + '\nrung "another"\n|--[5100.00]--(5101.03)\n')
        profile = self.profile(scenario, "--repeat", 1, "--baseline", old)
        self.assertEqual([c["title"] for c in profile["baseline"]["more"]], ["lamp"])
        self.assertEqual([c["title"] for c in profile["baseline"]["new"]], ["another"])
        self.assertEqual(profile["baseline"]["gone"], [])
        text = rungc("profile", scenario, "--repeat", 1, "--baseline", old).stdout
        self.assertRegex(text, r'more operations:\n  \d+ -> \d+ \(\+\d+\.\d%\): rung 1 "lamp", \S*lamp.lad:4\n')
        wrong = rungc("profile", scenario, "--baseline", self.write("wrong.json", "{}"))
        self.assertEqual(wrong.returncode, 3)
        self.assertIn("wrong.json: it is not a profile; write it with rungc profile --json", wrong.stderr)
        self.assertEqual(rungc("profile", scenario, "--baseline", self.folder / "none.json").returncode, 3)

    def test_heat_is_drawn(self):
        """On the drawing, with the figures of the profile at its rungs."""
        page = self.folder / "heat.html"
        for example in (MILL / "tool-change.scn", Path("examples/technol-mill/tool-change.scn")):
            profile = self.profile(example, "--repeat", 1, "--html", page)
            html = page.read_text()
            first = profile["rungs"][0]
            self.assertIn(f"{100 * first['share']:.1f} %, {first['operations']} operations", html)
            self.assertIn("share of all operations", html)
            self.assertIn("never ran", html)
            self.assertIn("<svg", html)
            bars = set(re.findall(r'<s class="s(\d)"', html))
            self.assertTrue(len(bars) > 1 and bars <= set("12345"), bars)  # in the colours of the legend
        done = rungc("profile", MILL / "parts.scn", "--html", self.folder / "none/heat.html")
        self.assertEqual(done.returncode, 3)
        self.assertIn("cannot write", done.stderr)

    def test_a_failing_scenario_is_reported_as_by_test(self):
        scenario = self.scenario("wrong.scn", "scan 3\nexpect 5101.00 1")
        done = rungc("profile", scenario)
        self.assertEqual(done.returncode, 1)
        self.assertIn(f"{scenario}:3: ", done.stdout)

    def test_the_text_says_what_measuring_costs(self):
        done = rungc("profile", MILL / "parts.scn", "--top", 3)
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertRegex(done.stdout, r"a scan takes \d+\.?\d* [num]+s \(\d+\.?\d* [num]+s while measured\); the overhead of \d+\.\d ns per rung is already subtracted")
        self.assertIn("  ... and ", done.stdout)

    def branches(self, program, statements):
        """The file of -o, of a scenario of these statements."""
        scenario = self.write("branches.scn", f"program {program.name}\n{statements}\nexpect 5101.00 0\n")
        done = rungc("profile", scenario, "--repeat", 1, "-o", self.folder / "sum.prof")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return self.folder / "sum.prof"

    def generated(self, program, *options):
        done = rungc("emit", "cpp", program, *options)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout, done.stderr

    def test_code_is_laid_out_by_what_branches_did(self):
        program = self.write("sum.lad", SUM)
        for on, hint in ((0, "[[unlikely]] {"), (1, "[[likely]] {")):
            profile = self.branches(program, f"set 5100.00 {on}\nscan 20")
            code, told = self.generated(program, "--profile-use", profile)
            self.assertIn(hint, code)
            self.assertEqual(told, "")
        self.assertNotIn("likely]] {", self.generated(program)[0])
        shared = self.folder / "sum.so"
        built = rungc("build", program, "--profile-use", profile, "-o", shared)
        self.assertEqual(built.returncode, 0, built.stderr)
        self.assertEqual(rungc("run", shared, "--for", "1s").returncode, 0)

    def test_branches_of_a_rung_that_has_changed_are_left_out(self):
        program = self.write("sum.lad", SUM)
        profile = self.branches(program, "scan 20")
        program.write_text(SUM.replace("[5100.00]", "[5100.01]"))
        code, told = self.generated(program, "--profile-use", profile)
        self.assertNotIn("likely]] {", code)
        self.assertIn("sum.prof: has no counts for 1 of 1 rungs with branches (new or changed)", told)
        for file, text in ((self.write("wrong.prof", "{}"), "wrong.prof: it was not written by rungc profile -o"),
                           (self.folder / "none.prof", "cannot read")):
            done = rungc("emit", "cpp", program, "--profile-use", file)
            self.assertEqual(done.returncode, 3)
            self.assertIn(text, done.stderr)
        done = rungc("profile", self.folder / "branches.scn", "--repeat", 1, "-o", self.folder / "none/sum.prof")
        self.assertEqual(done.returncode, 3)
        self.assertIn("cannot write", done.stderr)

    def test_wrong_usage(self):
        for arguments, text in (
            ((), "rung.toml"),
            (("examples/gsk-mill/mill.pmc",), "needs a scenario (.scn)"),
            ((MILL / "parts.scn", "--engine", "gcc"), "--engine takes one of"),
            ((MILL / "parts.scn", "--by", "luck"), "--by"),
            ((MILL / "parts.scn", "--repeat", "0"), "--repeat"),
        ):
            done = rungc("profile", *arguments)
            self.assertEqual(done.returncode, 2, arguments)
            self.assertIn(text, done.stdout + done.stderr)
        done = rungc("profile", self.folder / "none.scn")
        self.assertEqual(done.returncode, 3)
        self.assertIn("cannot read", done.stderr)


if __name__ == "__main__":
    go_to_root()
    RUNGC = os.path.abspath(sys.argv.pop(1))
    unittest.main()
