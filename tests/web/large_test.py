#!/usr/bin/env python3
"""A program of 50,000 rungs on the live page: large_test.py RUNGC"""
import sys
import tempfile
import time
import unittest
from pathlib import Path

from browser import Browser
from live import Live

RUNGC = ""
RUNGS = 50_000
SECONDS = 3.0  # of a processor of its own, from the link to rungs with power


def program():
    lines = ["dialect nct", "module MAIN", ""]
    lines += [f"symbol B{i:04}  {5000 + i // 32}.{i % 32:02}  ; allow(never-written)" for i in range(3200)]
    for i in range(RUNGS):
        if i % 500 == 0:
            lines += ["", f'section "part {i // 500}"']
        a, b, c = (f"B{(i * step) % 3200:04}" for step in (1, 7, 13))
        lines += ["", f'rung "rung number {i + 1}"', f"|--[{a}]---+--[/{b}]--({'SR'[i % 2]} {c})", f"|--[/{c}]--+"]
    return "\n".join(lines) + "\n"


class Large(unittest.TestCase):
    def test_opens_fast(self):
        with tempfile.TemporaryDirectory(prefix="rung-large-") as folder:
            path = Path(folder) / "large.lad"
            path.write_text(program(), encoding="ascii")
            begin = time.monotonic()
            live = Live(RUNGC, path, "--quiet", cwd=folder)
            print(f"started after {time.monotonic() - begin:.1f} s")
            page = Browser()
            try:
                begin = time.monotonic()
                page.driver.get(live.link)
                page.until("return document.querySelectorAll('article [data-on=\"1\"]').length > 0", "power")
                seconds = time.monotonic() - begin
                print(f"open after {seconds:.2f} s")
                self.assertLess(seconds, SECONDS)
                self.assertLess(page.js("return document.querySelectorAll('article').length"), 60)
                begin = time.monotonic()
                page.js("document.getElementById('ladder').scrollTop = document.getElementById('space').clientHeight")
                page.until("return document.querySelector('#r50000 [data-on]')", "the last rung")
                print(f"the last rung after {time.monotonic() - begin:.2f} s")
                self.assertEqual(page.errors(), [])
            finally:
                page.close()
                live.close()


if __name__ == "__main__":
    RUNGC = str(Path(sys.argv.pop(1)).resolve())
    unittest.main()
