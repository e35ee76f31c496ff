#!/usr/bin/env python3
"""Where the page of `rungc run --web` begins: run_test.py RUNGC"""
import sys
import unittest

from live import ROOT, Live

RUNGC = ""


class Begins(unittest.TestCase):
    def first_scan(self, *words):
        live = Live(RUNGC, ROOT / "tests" / "web" / "toggle.lad", *words).log_in()
        self.addCleanup(live.close)
        live.order("pause")
        picture = live.ask("picture?page=test&after=0&from=0&to=0&names=")
        return picture["scan"]

    def test_after_the_scans_that_were_asked_for(self):
        self.assertLess(self.first_scan(), 20_000)
        self.assertGreaterEqual(self.first_scan("--scans", "20000"), 20_000)
        self.assertGreaterEqual(self.first_scan("--for", "500s"), 20_000)


if __name__ == "__main__":
    RUNGC = sys.argv.pop(1)
    unittest.main()
