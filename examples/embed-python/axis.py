#!/usr/bin/env python3
"""A demonstration CNC: one axis, moved by a PLC program in virtual time. axis.py PROGRAM.so NEXT.so"""
import sys
from ctypes import c_bool, c_int32, c_uint8

import rung  # where it is not installed: with lib/python of a build in PYTHONPATH


class Axis:
    def __init__(self, plc):
        self.start, self.jam, self.enable = c_bool(), c_bool(), c_bool()
        self.position = c_int32()  # 0.001 mm
        self.strokes = c_uint8()
        plc.bind("START", self.start, rung.TO_PROGRAM)
        plc.bind("JAM", self.jam, rung.TO_PROGRAM)
        plc.bind("D0:4", self.position, rung.TO_PROGRAM)
        plc.bind("ENABLE", self.enable, rung.FROM_PROGRAM)
        plc.bind("STROKES", self.strokes, rung.FROM_PROGRAM)

    def move(self):
        """Simulates the machine for a millisecond."""
        if self.enable:
            self.position.value += 50
        self.start.value = not self.enable and self.position.value == 0
        if not self.enable:  # back to the start
            self.position.value = max(0, self.position.value - 250)


def run(program, following):
    with (rung.Image(program) as image, rung.Image(following) as new, rung.Instance(image) as plc,
          rung.Replacement(plc, new) as change):
        axis = Axis(plc)
        plc.power_on(rung.WARM)
        report = [f"  {what.kind.name.lower()}: {what.name}" for what in change.changes()]
        changed = False
        for ms in range(2000):
            if ms == 700:
                axis.jam.value = True
            if not plc.run_due(1_000_000):  # ns; after the fault outputs are 0: the axis does not move
                print(f"{ms} ms: {plc.fault().text}")
                axis.jam.value = False
                plc.power_on(rung.WARM)
            if ms >= 1000 and not changed and plc.replace(change):  # a new program, while the axis moves
                changed = True
                print(f"{ms} ms: the new program runs", *report, sep="\n")
            axis.move()
        worst = plc.worst_rung()
        print(f"{axis.strokes.value} strokes; the worst rung is {worst.title}, {worst.file}:{worst.line}")
        plc.power_off()


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    try:
        run(*sys.argv[1:])
    except rung.Error as error:
        sys.exit(str(error))
