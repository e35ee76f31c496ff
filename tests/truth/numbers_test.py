#!/usr/bin/env python3
"""Every tool names a rung alike: `rungc check` counts as many rungs as `diff` compares and as the page of `view` shows; the number that
`xref` gives a rung is that of the page, at the same line; `test --coverage` counts them, too. Of the examples and the scenarios' programs.
numbers_test.py RUNGC; RUNG_TRUTH=large: all of them."""
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from patience import patience
from root import go_to_root

RUNGC = None
LARGE = os.environ.get("RUNG_TRUTH") == "large"
STEP = 1 if LARGE else 5  # every one of so many programs


def run(*arguments):
    return subprocess.run([RUNGC, *map(str, arguments)], capture_output=True, text=True, timeout=patience(300), check=False)


def programs():
    scenarios = [path for path in sorted(Path("tests/scenarios").rglob("*")) if path.suffix in (".lad", ".pmc", ".plc")]
    kept = ["mechs", "device-init"]  # rungs that the compiler cuts, or adds
    return sorted(Path("examples").glob("*/rung.toml")) + [path for i, path in enumerate(scenarios) if i % STEP == 0 or path.stem in kept]


def count_of(program):
    """What check says; None where the program has errors."""
    done = run("check", program)
    return int(re.search(r"(\d+) rungs?[,;]", done.stdout)[1]) if done.returncode == 0 else None


class Numbers(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def page(self, program):
        """Places of the rungs on the page, by their numbers."""
        out = Path(self.folder.name) / (re.sub(r"\W", "_", str(program)) + ".html")
        self.assertEqual(run("view", program, "-o", out).returncode, 0, program)
        places = re.findall(r'id="r(\d+)".*?class="f"[^>]*>([^<]*)<', out.read_text(), re.S)
        return {int(number): (Path(place.rpartition(":")[0]).name, int(place.rpartition(":")[2])) for number, place in places}

    def xref(self, program):
        entries = json.loads(run("xref", "--format", "json", program).stdout)
        return {(use["rung"], Path(use["file"]).name, use["line"]) for entry in entries for use in entry["written"] + entry["read"] if use["rung"] != 0}

    def held(self, program):
        """Whether the program was compared, what is wrong being raised."""
        count = count_of(program)
        if count is None:
            return False
        self.assertEqual(run("diff", program, program).stdout, f"rungs: 0 changed, 0 added, 0 removed, 0 moved, {count} unchanged\n", program)
        page = self.page(program)
        self.assertEqual(sorted(page), list(range(1, count + 1)), program)
        for rung, file, line in self.xref(program):
            self.assertEqual(page.get(rung), (file, line), program)
        return True

    def test_tools_agree(self):
        with ThreadPoolExecutor(2) as pool:
            self.assertGreater(sum(pool.map(self.held, programs())), 400 if LARGE else 80)

    def test_coverage_counts_the_same(self):
        for example in ("gsk-panel", "nct-lathe", "technol-mill"):
            done = run("test", f"examples/{example}", "--coverage")
            covered = re.search(r"rungs run +\d+ of (\d+)", done.stdout)
            self.assertEqual(int(covered[1]), count_of(f"examples/{example}"), example)


if __name__ == "__main__":
    go_to_root()
    RUNGC = sys.argv.pop(1)
    unittest.main()
