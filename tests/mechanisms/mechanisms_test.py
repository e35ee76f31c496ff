#!/usr/bin/env python3
"""Random TECHNOL programs of mechanisms, block modules, timed blocks, timers and counters, held against a model written
from the manual's words (ch. 3.11, 4, 5), not from the compiler. mechanisms_test.py RUNGC [PROGRAMS [FIRST]]"""
import os
import random
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

RUNGC = None
PROGRAMS = 40
FIRST = 1
SCANS = 50
BITS = 6
MODULES = {"MIN": "INPUT", "MFAST": "FAST", "MONE": "MAIN", "MTWO": "MAIN", "MTHREE": "MAIN", "MCONT": "CONT"}
WAITS = ("EX", "EX0", "EX1", "TEX0", "TEX1", "TIM")


class Cell:
    def __init__(self, name, bits, value=0):
        self.name, self.bits, self.value = name, bits, value

    def count(self, by=1):
        self.value = (self.value + by) % (1 << self.bits)
        return self.value


class Step:
    """A statement: its label, what it is, its operands; its line once it is written."""

    def __init__(self, label, kind, **operands):
        self.label, self.kind, self.line = label, kind, 0
        self.__dict__.update(operands)


class Unit:
    """A mechanism or block module. `place` is where it goes on: a step, and whether that is a TIM under way."""

    def __init__(self, name):
        self.name, self.steps, self.counts = name, [], []
        self.active, self.shown = False, 0
        self.place = (0, False)

    def initialise(self):
        self.active, self.shown, self.place = False, 0, (0, False)
        for cell in self.counts:
            cell.value = 0

    def at(self, label):
        return next(i for i, step in enumerate(self.steps) if step.label == label)


class Machine:
    """The program and the state that the manual says it has."""

    def __init__(self, seed):
        self.random = random.Random(seed)
        self.labels = 0
        self.cells = []
        self.bits = [0] * BITS
        self.units = {name: Unit(name) for name in [*MODULES, "BLOCK_INIT", "BLOCK_DONE"]}
        for unit in self.units.values():
            self.fill(unit)
        self.phase = "idle"
        self.reached = False
        self.scans = self.milliseconds = 0
        self.timer = [Cell("TIMERB", 8), Cell("TIMERW", 16)]
        self.over = [0, 0]
        self.up, self.down = Cell("COUNTUP", 8), Cell("COUNTDN", 16)
        self.seen = [0, 0]
        self.equal = [0, 0]
        self.tenths, self.seconds = Cell("TENTHS", 16), Cell("SECONDS", 16)

    # ---- making a program

    def label(self):
        self.labels += 1
        return f"L{self.labels}"

    def cell(self, bits=None, value=0, automatic=False):
        bits = bits or self.random.choice((8, 16))
        cell = Cell("-" if automatic else f"C{len(self.cells)}", bits, value)
        self.cells.append(cell)
        return cell

    def count(self, unit):
        automatic = self.random.random() < 0.4
        cell = self.cell(16 if automatic else None, automatic=automatic)
        unit.counts.append(cell)
        return cell

    def time(self):
        value = self.random.choice((0, 1, 2, 3, 5))
        return self.cell(value=value) if self.random.random() < 0.3 else value

    def condition(self, unit, label=None):
        unit.steps.append(Step(label, "LDR", bit=self.random.randrange(BITS)))

    def fill(self, unit):
        kinds = ("act", "act", "BEX", *WAITS, "start", "stop", "init", "skip", "load")
        late, end, waiting = self.label(), self.label(), []
        for _ in range(self.random.randint(4, 10)):
            kind = self.random.choice(kinds)
            label = waiting.pop() if waiting and self.random.random() < 0.5 else None
            if kind == "act":
                unit.steps.append(Step(label, kind, cell=self.cell()))
            elif kind in ("EX", "BEX"):
                unit.steps.append(Step(label, kind))
            elif kind in ("EX0", "EX1"):
                self.condition(unit, label)
                unit.steps.append(Step(None, kind))
            elif kind in ("TEX0", "TEX1"):
                self.condition(unit, label)
                unit.steps.append(Step(None, kind, count=self.count(unit), time=self.time(), late=late,
                                       code=self.random.randrange(60000)))
            elif kind == "TIM":
                unit.steps.append(Step(label, kind, count=self.count(unit), time=self.time()))
            elif kind in ("start", "stop", "init"):
                unit.steps.append(Step(label, kind, other=self.random.choice(list(MODULES))))
            elif kind == "skip":
                waiting.append(self.label())
                self.condition(unit, label)
                unit.steps.append(Step(None, self.random.choice(("JL0", "JL1")), to=waiting[-1]))
            else:
                unit.steps.append(Step(label, "load", value=self.random.randrange(1000)))
        for label in waiting:
            unit.steps.append(Step(label, "load", value=1))
        if self.random.random() < 0.3:  # a loop with a state in it
            again = self.label()
            unit.steps.insert(0, Step(again, "EX"))
            self.condition(unit)
            unit.steps.append(Step(None, "JL1", to=again))
        unit.steps.append(Step(None, "JUM", to=end))
        unit.steps.append(Step(late, "store", cell=self.cell(32)))
        unit.steps.append(Step(end, "load", value=0))

    # ---- its text

    def source(self):
        lines = ["DATA", "        DFM  " + ",".join(f"B{i}" for i in range(8)), "        DFM  OVERB,OVERW,ATUP,ATDN,,,,"]
        own = [*self.timer, self.up, self.down, self.tenths, self.seconds]
        lines += [f"{c.name}: DS {c.bits // 8}" for c in [*self.cells, *own] if c.name != "-"]
        lines += ["DATA_END"]

        def module(name, write=None):
            lines.append(f"MODULE_{name}")
            if write:
                write()
            for unit, where in MODULES.items():
                if where == name:
                    self.write(self.units[unit], lines)
            if name in ("FAST", "MAIN"):
                lines.append("        PROC_CALL CLOCK")
            lines.append(f"MODULE_{name}_END")

        module("INPUT")
        for name in ("BLOCK_INIT", "BLOCK_DONE"):
            module(name, lambda unit=self.units[name]: self.write(unit, lines))
        module("FAST")
        module("MAIN", lambda: lines.extend(MAIN))
        module("CONT")
        module("INIT", lambda: lines.extend(f"        LOD  {c.value}\n        STO  {c.name}"
                                            for c in self.cells if c.value))
        module("CLEAR")
        module("HALT")
        return "\n".join(lines) + "\nSTOP\n"

    def write(self, unit, lines):
        mechanism = unit.name in MODULES
        if mechanism:
            lines.append(f"        MECH_BEGIN {unit.name}")
        for step in unit.steps:
            text = self.text(step)
            lines.append((f"{step.label}:" if step.label else "").ljust(8) + text[0])
            lines.extend("        " + line for line in text[1:])
            step.line = "\n".join(lines).count("\n") + 1
        if mechanism:
            lines.append(f"        MECH_END {unit.name}")

    @staticmethod
    def text(step):
        name = lambda value: value.name if isinstance(value, Cell) else str(value)
        if step.kind == "act":
            return [f"LOD  {step.cell.name}", "INR", f"STO  {step.cell.name}"]
        if step.kind == "LDR":
            return [f"LDR  B{step.bit}"]
        if step.kind in ("TEX0", "TEX1"):
            return [f"{step.kind} {name(step.count)},{name(step.time)},{step.late},{step.code}"]
        if step.kind == "TIM":
            return [f"TIM  {name(step.count)},{name(step.time)}"]
        if step.kind in ("start", "stop"):
            return [f"FL   {int(step.kind == 'start')},{step.other}"]
        if step.kind == "init":
            return [f"MECH_INIT {step.other}"]
        if step.kind in ("JL0", "JL1", "JUM"):
            return [f"{step.kind}  {step.to}"]
        if step.kind == "load":
            return [f"LOD  {step.value}"]
        if step.kind == "store":
            return [f"STO  DWRD.{step.cell.name}"]
        return [step.kind]

    # ---- what it does

    def run(self, unit):
        """One pass; true when the unit has run through."""
        at, in_time = unit.place
        rlo = dr = 0
        while at < len(unit.steps):
            step = unit.steps[at]
            kind = step.kind
            if in_time:
                in_time = False
                if step.count.count() < self.limit(step):
                    unit.shown = step.line
                    return False
                step.count.value = 0
                at += 1
                unit.place = (at, False)
                continue
            if kind == "act":
                dr = step.cell.count()
            elif kind == "LDR":
                rlo = self.bits[step.bit]
            elif kind == "load":
                dr = step.value
            elif kind == "store":
                step.cell.value = dr
            elif kind == "BEX":
                unit.place = (at + 1, False)
            elif kind == "EX":
                unit.place, unit.shown = (at + 1, False), step.line
                return False
            elif kind == "TIM":
                step.count.value = 0
                unit.place, unit.shown = (at, True), step.line
                return False
            elif kind in WAITS:
                if rlo != int(kind[-1]):
                    unit.place = (at + 1, False)
                    if kind.startswith("TEX"):
                        step.count.value = 0
                elif kind.startswith("TEX") and step.count.count() >= self.limit(step):
                    step.count.value = 0
                    dr, at = step.code, unit.at(step.late)
                    unit.place = (at, False)
                    continue
                else:
                    unit.shown = step.line
                    return False
            elif kind == "start":
                self.units[step.other].active = True
            elif kind == "stop":
                self.units[step.other].active = False
            elif kind == "init":
                self.units[step.other].initialise()
            elif kind == "JUM" or kind == f"JL{rlo}":
                at = unit.at(step.to)
                continue
            at += 1
        unit.initialise()
        return True

    @staticmethod
    def limit(step):
        time = step.time.value if isinstance(step.time, Cell) else step.time
        return min(time, (1 << step.count.bits) - 1)

    def mechanism(self, name):
        unit = self.units[name]
        if unit.active:
            self.run(unit)
        else:
            unit.shown = 0

    def clock(self, cycles, a_second):
        if cycles % (a_second // 10) == 0:
            self.tenths.count()
        if cycles % a_second == 0:
            self.seconds.count()

    def fast(self):
        self.milliseconds += 1
        self.mechanism("MFAST")
        self.clock(self.milliseconds, 1000)

    def supervise(self):
        if self.phase == "init" and self.run(self.units["BLOCK_INIT"]):
            self.phase = "motion"
        if self.phase == "motion" and self.reached:
            self.phase = "done"
        if self.phase == "done" and self.run(self.units["BLOCK_DONE"]):
            self.phase = "idle"

    def count_and_time(self):
        if self.scans % 5 == 0:
            for i, preset in enumerate((3, 2)):
                timer = self.timer[i]
                if not self.bits[i]:
                    timer.value = self.over[i] = 0
                elif timer.value >= preset:
                    self.over[i] = 1
                else:
                    self.over[i] = 0
                    timer.count()
            if self.bits[2] and not self.seen[0]:
                self.up.count()
            self.seen[0], self.equal[0] = self.bits[2], int(self.up.value == 2)
        if self.bits[3] and not self.seen[1]:
            self.down.count(-1)
        self.seen[1], self.equal[1] = self.bits[3], int(self.down.value == 65534)

    def scan(self):
        self.scans += 1
        self.mechanism("MIN")
        for _ in range(20):
            self.fast()
        self.supervise()
        self.count_and_time()
        for name in ("MONE", "MTWO", "MTHREE"):
            self.mechanism(name)
        self.clock(self.scans, 50)
        self.mechanism("MCONT")

    # ---- the scenario

    def scenario(self, name):
        lines = [f"program {name}.plc"]
        for _ in range(SCANS):
            lines += self.stimulus()
            lines.append("scan")
            self.scan()
            lines += self.expectations()
        return "\n".join(lines) + "\n"

    def stimulus(self):
        lines = []
        for i in range(BITS):
            if self.random.random() < 0.25:
                self.bits[i] ^= 1
                lines.append(f"set B{i} {self.bits[i]}")
        if self.random.random() < 0.6:
            name = self.random.choice(list(MODULES))
            self.units[name].active = self.random.random() < 0.85
            lines.append(f"set {name} {int(self.units[name].active)}")
        if self.random.random() < 0.1:
            lines.append("fast 7")
            for _ in range(7):
                self.fast()
        if self.phase == "idle" and self.random.random() < 0.4:
            lines.append("block start")
            self.phase, self.reached = "init", False
            self.units["BLOCK_INIT"].place = self.units["BLOCK_DONE"].place = (0, False)
        elif self.phase in ("init", "motion") and not self.reached and self.random.random() < 0.3:
            lines.append("block done")
            self.reached = True
        return lines

    def expectations(self):
        lines = [f"expect PO_F {int(self.phase != 'idle')}"]
        for name in MODULES:
            unit = self.units[name]
            lines += [f"expect {name} {int(unit.active)}", f"expect {name}_LINE {unit.shown}"]
        own = [*self.timer, self.up, self.down, self.tenths, self.seconds]
        lines += [f"expect {c.name} {c.value}" for c in [*self.cells, *own] if c.name != "-"]
        for bit, value in zip(("OVERB", "OVERW", "ATUP", "ATDN"), self.over + self.equal):
            lines.append(f"expect {bit} {value}")
        return lines


MAIN = """\
        DFTM01 TENTH
        LDR  B0
        LOD  3
        TM   TIMERB
        WR   OVERB
        LDR  B1
        LOD  2
        TM   TIMERW
        WR   OVERW
        LDR  B2
        LOD  2
        CU   COUNTUP
        WR   ATUP
TENTH:
        LDR  B3
        LOD  65534
        CD   COUNTDN
        WR   ATDN
        PROC_BEGIN CLOCK          ; goes by the clock of its caller
        DFTM01 NO_TENTH
        LOD  TENTHS
        INR
        STO  TENTHS
NO_TENTH:
        DFTM1 NO_SECOND
        LOD  SECONDS
        INR
        STO  SECONDS
NO_SECOND:
        PROC_END CLOCK""".splitlines()


class Mechanisms(unittest.TestCase):
    def test_programs_do_what_the_model_does(self):
        with tempfile.TemporaryDirectory() as folder:
            for seed in range(FIRST, FIRST + PROGRAMS):
                machine = Machine(seed)
                (Path(folder) / f"p{seed}.plc").write_text(machine.source())
                (Path(folder) / f"p{seed}.scn").write_text(machine.scenario(f"p{seed}"))
            scenarios = [f"p{seed}.scn" for seed in range(FIRST, FIRST + PROGRAMS)]
            done = subprocess.run([RUNGC, "test", *scenarios, "--engine", "interp,jit"], cwd=folder, capture_output=True)
            failed = [line for line in done.stdout.decode().splitlines() if not line.startswith("ok ")]
            self.assertEqual(done.returncode, 0, "\n".join(failed[:40]))


if __name__ == "__main__":
    RUNGC = os.path.abspath(sys.argv.pop(1))
    PROGRAMS = int(sys.argv.pop(1)) if len(sys.argv) > 1 else PROGRAMS
    FIRST = int(sys.argv.pop(1)) if len(sys.argv) > 1 else FIRST
    unittest.main()
