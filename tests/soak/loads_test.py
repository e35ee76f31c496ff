#!/usr/bin/env python3
"""rung_hal is loaded and unloaded in a running thread, again and again: loads_test.py BIN MODULE [--count N]

The thread has other functions, which continue. After each unload the signals of the output pins have their safe values, and
rtapi_app has as many open files and threads as after the first ones, and no more memory.
"""
import argparse
import re
import sys
import time
from pathlib import Path

from bench import Figures, check_growth, cnc_test, compiled, expect, folder, make_bench, named, printed, session, wait

# An output that follows the pin `run`, one that is its opposite and a number, in each dialect.
FANUC = """%@3
END1
RD X1.0
WRT Y0.0
RD.NOT X1.0
WRT Y0.1
RD X1.0
MOVB
X2
D0
END2
END
%
"""
GSK = """dialect gsk
FUNC END1
LD   X1.0
OUT  Y0.0
LDI  X1.0
OUT  Y0.1
LD   X1.0
FUNC MOVB
PRM  X2
PRM  D0
FUNC END2
"""
NCT = """dialect nct
module MAIN
rung
|--[INP000.00]--(OUT000.00)
rung
|--[/INP000.00]--(OUT000.01)
rung
|--[INP000.00]--{MOV 7000 INP001}
rung
|--{END}
"""
MODULES = "".join(f"MODULE_{name}\nMODULE_{name}_END\n" for name in
                  ("INPUT", "BLOCK_INIT", "BLOCK_DONE", "INIT", "CLEAR", "HALT"))
TECHNOL = f"""DATA
RUN:    DFM  ON,,,,,,,
OUT:    DFM  LAMP,BRAKE,,,,,,
NUMBER: DS 1
VALUE:  DS 1
DATA_END
{MODULES}MODULE_MAIN
        LDR  ON
        WR   LAMP
        LDR  -ON
        WR   BRAKE
        LDR  ON
        JL0  READY
        LOD  BYTE.NUMBER
        STO  BYTE.VALUE
READY:
MODULE_MAIN_END
STOP
"""
MAP = """in.run = {{ type = "bit", name = "{}" }}
in.number = {{ type = "u32", name = "{}" }}
out.lamp = {{ type = "bit", name = "{}" }}
out.brake = {{ type = "bit", name = "{}", safe = true }}
out.value = {{ type = "s32", name = "{}", safe = -5 }}
"""
PMC_MAP = MAP.format("X1.0", "X2", "Y0.0", "Y0.1", "D0")
PROGRAMS = {"fanuc": (".mne", FANUC, PMC_MAP),
            "gsk": (".pmc", GSK, PMC_MAP),
            "nct": (".lad", NCT, MAP.format("INP000.00", "INP001", "OUT000.00", "OUT000.01", "7000")),
            "technol": (".plc", TECHNOL, MAP.format("ON", "BYTE.NUMBER", "LAMP", "BRAKE", "BYTE.VALUE"))}

# Waits in the session until the test has looked.
LOOK = """#!/bin/sh
: > look
while [ -e look ]; do sleep 0.005; done
"""
BEGIN = """loadrt threads name1=servo period1=1000000
loadrt siggen
loadrt and2
addf siggen.0.update servo
addf and2.0 servo
start
newsig lamp bit
newsig brake bit
newsig value s32
"""
LOAD = """loadrt rung_hal names=box so=@DIR@/{0}.so map=@DIR@/{0}.map retain=@DIR@/{0}
addf box.scan servo
setp box.run 1
net lamp box.lamp
net brake box.brake
net value box.value
setp box.number 77
loadusr -w sleep 0.1
gets lamp
gets brake
gets value
unloadrt rung_hal
gets lamp
gets brake
gets value
getp siggen.0.sawtooth
loadusr -w ./look.sh
"""
GROWTH = 512  # kB: each thread that is begun may get an area of its own from the allocator, until there are some
RUNNING, SAFE = ["TRUE", "FALSE", "77"], ["FALSE", "TRUE", "-5"]


def prepare(bench, count):
    for name, (suffix, text, map_text) in PROGRAMS.items():
        bench.programs.add(compiled(bench.rungc, bench.file(name + suffix, text), bench.home / f"{name}.so"))
        bench.file(name + ".map", map_text)
    bench.file("look.sh", LOOK).chmod(0o755)
    loads = "".join(LOAD.format(list(PROGRAMS)[i % len(PROGRAMS)]) for i in range(count))
    bench.file("test.hal", BEGIN + loads + "show funct\nstatus mem\n")


def look(bench, process):
    wait(f"an unload; the session says {printed(bench)[-600:]}", lambda: (bench.home / "look").exists())
    figures = Figures(wait("rtapi_app", lambda: named(process.pid, "rtapi_app")))
    (bench.home / "look").unlink()
    return figures


def loads(text):
    """What `gets` and `getp` have printed, seven values a load."""
    shown = [line.strip() for line in text.splitlines() if re.fullmatch(r"TRUE|FALSE|-?[\d.]+(e-?\d+)?", line.strip())]
    return [shown[i:i + 7] for i in range(0, len(shown), 7)]


def check_values(text, count):
    list_of_values = loads(text)
    expect(len(list_of_values) == count, f"{len(list_of_values)} loads have shown their values")
    for number, seen in enumerate(list_of_values, 1):
        expect(seen[:6] == RUNNING + SAFE, f"load {number}: before and after the unload {seen[:6]}, expected {RUNNING + SAFE}")
    expect(len({seen[6] for seen in list_of_values}) > count / 2, "the thread's other function has stopped")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bin", type=Path)
    parser.add_argument("module", type=Path)
    parser.add_argument("--count", type=int, default=200)
    options = parser.parse_args()
    cnc_test.check_machine(options.module)
    with folder() as place:
        bench = make_bench(options, place)
        prepare(bench, options.count)
        begin = time.monotonic()
        with session(bench, "halrun", "test.hal") as process:
            figures = [look(bench, process) for _ in range(options.count)]
            wait("the end", lambda: process.poll() is not None)
        text = printed(bench)
    expect(process.returncode == 0, f"halrun ended with {process.returncode}: {text[-2000:]}")
    print(f"{options.count} loads in {time.monotonic() - begin:.0f} s;",
          *(line.strip() for line in text.splitlines() if "shared memory" in line))
    check_growth(figures, GROWTH)
    check_values(text, options.count)
    print("passed")


if __name__ == "__main__":
    sys.exit(main())
