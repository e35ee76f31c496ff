#!/usr/bin/env python3
"""The programs of all dialects run in one LinuxCNC for ten minutes: endurance_test.py BIN MODULE [--minutes N]

MDI, part programs, tool changes, an e-stop a minute. Counted are passes, those that were missed, faults, functions and messages that
were lost, and what rtapi_app has of memory, threads and open files.
"""
import argparse
import json
import re
import sys
import time
from pathlib import Path

from aborts_test import DIALECTS, machine, pins
from bench import HERE, Figures, check_growth, cnc_test, compiled, expect, folder, make_bench, named, printed, session

PERIOD = {"fanuc": 0.008, "gsk": 0.008, "nct": 0.010, "technol": 0.020}
GROWTH = 256  # kB
# What LinuxCNC prints into the lines of others.
OF_OTHERS = r"(UNEXPECTED \S+ \d+|task: main loop took \S+ seconds|Shutting down and cleaning up LinuxCNC\.\.\.)\n"
MESSAGES = {"nct": "An M function", "technol": "PLC00099"}  # of programs that count what they show


def prepare(bench, minutes):
    for name, dialect in DIALECTS.items():
        source = HERE / ("steps" + dialect["suffix"])
        bench.programs.add(compiled(bench.rungc, source, bench.home / f"{name}.so"))
        counted = 'out.shown = { type = "u32", name = "SHOWN" }\n' if name in MESSAGES else ""
        bench.file(name + ".map", counted + pins(dialect["pins"]) + (HERE / "steps.map").read_text(encoding="utf-8"))
    bench.file("seconds.txt", str(60 * minutes))
    machine(bench, HERE / "endurance_drive.py")
    bench.copy(HERE / "all.hal", "machine.hal")


def watch(bench, minutes):
    """Figures of rtapi_app, about thirty, until LinuxCNC ends."""
    figures = []
    with session(bench, "linuxcnc", "-r", str(bench.home / "machine.ini")) as process:
        end = time.monotonic() + 60 * minutes + 120
        while process.poll() is None:
            rtapi = named(process.pid, "rtapi_app")
            if rtapi and not (bench.home / "seen.json").exists():
                figures.append(Figures(rtapi))
            expect(time.monotonic() < end, "LinuxCNC does not end")
            time.sleep(2 * minutes)
    return figures


def written(text, message):
    """How often the log has the message: what comes again and again is counted in a line of its own."""
    lines = [line for line in text.splitlines() if message in line]
    counts = [re.search(r"\((\d+) times more since ", line) for line in lines]
    return sum(int(count[1]) if count else 1 for count in counts)


def check_counts(seen, text):
    for host, period in PERIOD.items():
        due = seen["seconds"] / period
        print(f"{host}: {seen['scans'][host]} passes of {due:.0f}, {seen['missed'][host]} missed, functions lost "
              f"{seen['functions-lost'][host]}, fault {seen['fault'][host]}")
        expect(not seen["fault"][host] and not seen["functions-lost"][host], f"{host}: a fault, or functions were lost")
        expect(abs(seen["scans"][host] + seen["missed"][host] - due) < 0.02 * due, f"{host}: its clock is not that of the machine")
    lines = re.sub(OF_OTHERS, "", text)
    for host, message in MESSAGES.items():
        arrived = written(lines, message)
        print(f"{host}: {arrived} messages of {seen['shown'][host]} arrived")
        expect(arrived == seen["shown"][host] > 0, f"{host}: messages were lost")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bin", type=Path)
    parser.add_argument("module", type=Path)
    parser.add_argument("--minutes", type=float, default=10)
    options = parser.parse_args()
    cnc_test.check_machine(options.module)
    with folder() as place:
        bench = make_bench(options, place)
        prepare(bench, options.minutes)
        figures = watch(bench, options.minutes)
        text, result = printed(bench), bench.home / "result.txt"
        expect(result.exists(), f"LinuxCNC did not start the driver: {text[-2000:]}")
        expect(result.read_text(encoding="utf-8") == "passed", result.read_text(encoding="utf-8"))
        seen = json.loads((bench.home / "seen.json").read_text())
    print(f"{seen['seconds']:.0f} s: {seen['cycles']} cycles of M3, T, M6 and M5, {seen['stops']} e-stops")
    check_counts(seen, text)
    check_growth(figures, GROWTH)
    print("passed")


if __name__ == "__main__":
    sys.exit(main())
