#!/usr/bin/env python3
"""Power on the live page, read from its DOM, against what follows from the drawing: flow_test.py RUNGC [SCANS]

For each example: SCANS random scans (1000), with random inputs between them, at random places of the program. Power begins at
the left rail, goes along wires from left to right, through contacts that conduct, and along joints; a NOT turns it round. What
the page shows of each wire and coil must be that. What contacts show is compared with the interpreter by rung_test_web.
"""
import os
import random
import sys
import time
import unittest

from browser import Browser
from live import ROOT, Live

RUNGC = ""
SCANS = 1000
EXAMPLES = {"gsk-mill": "tool-change.scn", "gsk-panel": None, "fanuc-vmc": "tool-change.scn", "first-cnc": None, "nct-lathe": None,
            "nct-turning-centre": None, "technol-magazine": "tool-change.scn", "technol-machining-centre": "tool-change.scn",
            "technol-mill": "tool-change.scn"}

# Returns what is wrong in the rungs of the picture, and how much was compared.
CHECK = r"""
const wrong = [];
let compared = 0;
for (const article of document.querySelectorAll('article[data-flow]')) {
  if (!article.dataset.flow) continue;
  const wires = [], key = (x, y) => x + ',' + y, powered = new Set();
  for (const path of article.querySelectorAll('path[data-n]')) {
    let x = 0, y = 0;
    for (const [, letter, a, b] of path.getAttribute('d').matchAll(/([Mhv])(-?\d+)(?: (-?\d+))?/g)) {
      if (letter === 'M') { x = +a; y = +b; continue; }
      const end = letter === 'h' ? [x + +a, y] : [x, y + +a];
      wires.push({path, x, y, ex: end[0], ey: end[1], level: letter === 'h', on: false});
    }
  }
  const symbols = [...article.querySelectorAll('.k')].map(one => {
    const box = one.querySelector('rect'), x = +box.getAttribute('x'), y = +box.getAttribute('y') + 11;
    return {one, x, y, end: x + +box.getAttribute('width'), coil: one.classList.contains('o'),
            turns: one.dataset.mark === 'NOT', on: one.dataset.on === '1'};
  });
  const boxes = [...article.querySelectorAll('.x .b')].map(path => {
    const [, x, y, w, h] = path.getAttribute('d').match(/M(\d+) (\d+)h(\d+)v(\d+)/).map(Number);
    return {x, y, end: x + w, bottom: y + h};
  });
  // A wire that is cut ends at a number, and continues after it.
  const ends = new Map(), starts = new Map();
  for (const text of article.querySelectorAll('svg text')) {
    const at = [+text.getAttribute('x'), +text.getAttribute('y') - 4];
    const end = /^→(\d+)$/.exec(text.textContent), start = /^(\d+)→$/.exec(text.textContent);
    if (end) ends.set(end[1], key(at[0] - 3, at[1]));
    if (start) starts.set(start[1], [at[0] + 3, at[1]]);
  }
  for (const wire of wires) {
    if (wire.level && wire.x === 8) powered.add(key(8, wire.y));
    // Of a box it is taken as shown what comes out.
    if (wire.level && wire.path.dataset.on === '1' && boxes.some(b => b.end === wire.x && b.y <= wire.y && wire.y <= b.bottom)) powered.add(key(wire.x, wire.y));
  }
  // What is at the left of a NOT is complete before the NOT is looked at.
  const turning = symbols.filter(s => s.turns && s.one.dataset.on).sort((a, b) => a.x - b.x);
  for (let more = true; more || turning.length;) {
    if (!more) {
      const s = turning.shift();
      if (!powered.has(key(s.x, s.y))) powered.add(key(s.end, s.y));
    }
    more = false;
    const add = (x, y) => { if (!powered.has(key(x, y))) { powered.add(key(x, y)); more = true; } };
    for (const wire of wires) {
      if (wire.level) {
        if (!powered.has(key(wire.x, wire.y))) continue;
        wire.on = true;
        add(wire.ex, wire.ey);
      } else {
        const at = wires.flatMap(w => w.level ? [[w.x, w.y], [w.ex, w.ey]] : []).filter(([x, y]) => x === wire.x && y >= wire.y && y <= wire.ey);
        if (!at.some(([x, y]) => powered.has(key(x, y)))) continue;
        wire.on = true;
        for (const [x, y] of at) add(x, y);
      }
    }
    for (const [number, end] of ends) if (powered.has(end)) add(...starts.get(number));
    for (const s of symbols) if (powered.has(key(s.x, s.y)) && !s.turns && (s.on || s.coil)) add(s.end, s.y);
  }
  for (const wire of wires) {
    ++compared;
    if (wire.on !== (wire.path.dataset.on === '1')) wrong.push(`rung ${article.dataset.rung}: wire at ${wire.x},${wire.y}`);
  }
  for (const s of symbols.filter(s => s.coil && s.one.dataset.on !== '')) {
    ++compared;
    if (s.on !== powered.has(key(s.x, s.y))) wrong.push(`rung ${article.dataset.rung}: coil ${s.one.dataset.name}`);
  }
}
return [wrong.slice(0, 5), compared, document.getElementById('space').dataset.scan];
"""


class Flow(unittest.TestCase):
    def row_that_ran(self, live, kinds, chance):
        """Most rungs of a TECHNOL program are of units that do not run."""
        while True:
            first = chance.randrange(len(kinds))
            rows = live.ask(f"picture?page=test&after=0&from={first}&to={first + 60}")["rows"]
            if ran := [int(row) for row, flow in rows.items() if flow and kinds[int(row)] == "r"]:
                return chance.choice(ran)

    def run_example(self, name):
        seed = int(os.environ.get("RUNG_SEED", time.time()))
        chance = random.Random(seed)
        words = [ROOT / "examples" / name]
        if EXAMPLES[name] is not None:
            words = ["--scenario", ROOT / "examples" / name / EXAMPLES[name]]
        live = Live(RUNGC, *words)
        page = Browser()
        try:
            page.open(live.link)
            live.log_in_again(page)
            live.order("pause")
            inputs = [one[1] for one in live.ask("names")["names"] if one[4] == "i"]
            index = live.ask("index")
            compared, taken = 0, [0, 0]
            for scan in range(SCANS):
                for one in chance.sample(inputs, min(3, len(inputs))):
                    refusal = live.refusal("set", name=one, value=str(chance.randrange(2)), writing=True)
                    taken[refusal is None] += 1
                if scan % 5 == 0:
                    row = self.row_that_ran(live, index["kinds"], chance)
                    page.js("document.getElementById('ladder').scrollTop = arguments[0]", sum(index["heights"][:row]))
                at = live.order("step", scans=1).split()[1]
                page.until("return document.getElementById('space').dataset.scan === arguments[0] && [...document.querySelectorAll('article')].every(a => a.dataset.flow !== undefined)", f"scan {at}", at)
                wrong, count, shown = page.js(CHECK)
                self.assertEqual(shown, at)
                self.assertEqual(wrong, [], f"{name}, scan {at}, seed {seed}")
                compared += count
            self.assertGreater(compared, 10 * SCANS)
            self.assertGreater(taken[True], taken[False], "values that the program took")
            print(f"{name}: {SCANS} scans, {compared} wires and coils, {taken[True]} inputs set")
        finally:
            page.close()
            live.close()


for example in EXAMPLES:
    setattr(Flow, "test_" + example.replace("-", "_"), lambda self, name=example: self.run_example(name))


if __name__ == "__main__":
    RUNGC = sys.argv.pop(1)
    if len(sys.argv) > 1 and sys.argv[1].isdigit():
        SCANS = int(sys.argv.pop(1))
    unittest.main()
