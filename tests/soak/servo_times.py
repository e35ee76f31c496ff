#!/usr/bin/env python3
"""Measures rung_hal in LinuxCNC's servo thread beside ClassicLadder, and prints a section of docs/performance.md:
servo_times.py BIN MODULE [--seconds N] [--changes N]"""
import argparse
import contextlib
import datetime
import json
import platform
import re
import shutil
import statistics
import subprocess
import sys
import textwrap
from pathlib import Path

import ladders
from aborts_test import machine
from bench import HERE, cnc_test, compiled, expect, folder, make_bench

ROOT = HERE.parents[1]
RUNGS = 512
PERIOD_NS = 1_000_000
QUIET, FIRST_CHANGE = 1, 2  # marks of servo_drive.py
COLUMNS = ("period", "motion", "mill", "turning", "centre", "bits", "ladder")
# Sources, maps, milliseconds between two parts of the schedule, titles.
MACHINES = {"mill": ("examples/gsk-mill", "examples/gsk-mill/mill.map", 8, "examples/gsk-mill, 511 rungs, GSK"),
            "turning": ("examples/nct-turning-centre", "examples/nct-turning-centre/linuxcnc/centre.map", 10,
                        "examples/nct-turning-centre, 590 rungs, NCT"),
            "centre": ("examples/technol-machining-centre", "examples/technol-machining-centre/linuxcnc/centre.map", 20,
                       "examples/technol-machining-centre, 584 rungs, TECHNOL")}
ALLOW = '\n[rungctl]\npermissions = ["reload"]\n'
CLOCKS = r"""
#include <stdio.h>
#include <time.h>
#include <x86intrin.h>
static double now(void) { struct timespec t; clock_gettime(CLOCK_MONOTONIC, &t); return t.tv_sec * 1e9 + t.tv_nsec; }
int main(void) {
  double from = now(); unsigned long long begin = __rdtsc();
  while (now() - from < 3e8) {}
  printf("%.9f", (now() - from) / (double)(__rdtsc() - begin));
}
"""


def ns_per_clock(place):
    """HAL measures functions in clocks of the processor, where it has them."""
    if platform.machine() != "x86_64":
        return 1.0
    (place / "clocks.c").write_text(CLOCKS)
    subprocess.run(["cc", "-O1", "-o", place / "clocks", place / "clocks.c"], check=True)
    return float(subprocess.run([place / "clocks"], check=True, capture_output=True, text=True).stdout)


def prepare(bench, options):
    """Every program twice: a change is one to the other file."""
    for name, (source, map_file, _, _) in MACHINES.items():
        for end in ("", "-again"):
            bench.programs.add(compiled(bench.rungc, ROOT / source, bench.home / f"{name}{end}.so"))
        for texts in (ROOT / source).glob("*.PlcErrors"):  # the map names them in the folder above its own
            shutil.copy(texts, bench.home.parent)
        text = (ROOT / map_file).read_text(encoding="utf-8")
        bench.file(name + ".map", text if "[rungctl]" in text else text + ALLOW)
    bench.programs.add(compiled(bench.rungc, bench.file("bits.pmc", ladders.gsk(RUNGS)), bench.home / "bits.so"))
    bench.file("bits.map", "".join(f'out.out-{i} = {{ type = "bit", name = "Y{i // 8}.{i % 8}" }}\n' for i in range(10)))
    bench.file("bits.clp", ladders.classic_ladder(RUNGS))
    shutil.copy(options.bin / "rungctl", bench.home)
    hosts = {name: [f"{name}-again.so", f"{name}.so"] for name in MACHINES}
    bench.file("plan.json", json.dumps({"seconds": options.seconds, "changes": options.changes, "hosts": hosts}))
    machine(bench, HERE / "servo_drive.py")
    text = (HERE / "servo.hal").read_text(encoding="utf-8")
    bench.file("machine.hal", text.replace("@RUNGS@", str(RUNGS)).replace("@BITS@", str(ladders.INPUTS + RUNGS)))


class Samples:
    """Rows of COLUMNS by their mark: the period in ns, times in us."""

    def __init__(self, path, clock_ns):
        self.rows = {}
        for line in path.read_text().splitlines():
            words = line.split()
            if len(words) == len(COLUMNS) + 1:  # or a line about an overrun
                period, *times, mark = map(int, words)
                row_of_times = dict(zip(COLUMNS, [period, *(time * clock_ns / 1000 for time in times)]))
                self.rows.setdefault(mark, []).append(row_of_times)

    def column(self, name, mark=QUIET):
        return [row_of_times[name] for row_of_times in self.rows[mark]]


def part(values, share):
    """The value that so many of them do not exceed."""
    return sorted(values)[min(len(values) - 1, int(len(values) * share))]


def runs_of(values, every):
    """Of so many calls one runs a part of the schedule; these are the longest."""
    return sorted(values)[-(len(values) // every):]


def row(title, values, every, passes):
    runs = runs_of(values, every)
    return (f"| {title} | {every} | {len(runs) / passes:.0f} | {statistics.median(runs):.1f} | {part(runs, 0.99):.1f} | {max(runs):.1f} | "
            f"{100 * statistics.fmean(values) / (PERIOD_NS / 1000):.2f} |")


def pauses(samples, changed, name, every):
    """Of each change the longest call while it was made, less what a call takes that runs a part."""
    usual = part(samples.column(name), 1 - 0.5 / every)
    marks = [number + FIRST_CHANGE for number, host in enumerate(changed) if host == name]
    return [max(0.0, max(samples.column(name, mark)) - usual) for mark in marks]


def processor():
    return re.search(r"model name\s*: (.*)", Path("/proc/cpuinfo").read_text(encoding="utf-8")).group(1)


def version(package):
    return subprocess.run(["dpkg-query", "-Wf${Version}", package], check=True, capture_output=True, text=True).stdout


def section(samples, changed, passes):
    periods = [abs(period - PERIOD_NS) / 1000 for period in samples.column("period")]
    bits, ladder = (samples.column(name) for name in ("bits", "ladder"))
    calls = len(bits)
    bits = statistics.median(runs_of(bits, 8)) * round(calls / 8 / passes["bits"])
    lines = ["", "## In LinuxCNC's servo thread", "",
             *textwrap.wrap(
                 f"LinuxCNC {version('linuxcnc-uspace')} on {processor()}, Linux {platform.release().split('-')[0]}, {datetime.date.today()}: "
                 "simulated axes in motion, and a servo thread of 1 ms without real-time priority on a machine with other work, which interrupts it. "
                 f"Times are those of HAL (`NAME.scan.time`) over {len(periods):,} cycles. A working call of a function is one that runs rungs. "
                 "The three machines are instances of one component, with nothing connected to their pins. ClassicLadder and the program beside it "
                 f"have the same {RUNGS} rungs of three contacts and a coil; ten of their outputs are compared.", 150), "",
             "| function | ms between working calls | working calls per scan | us per working call: median | 99 % | worst | % of the thread's time |",
             "| --- | --- | --- | --- | --- | --- | --- |"]
    lines += [row(title, samples.column(name), every, passes[name]) for name, (_, _, every, title) in MACHINES.items()]
    lines.append(row(f"rung_hal, {RUNGS} rungs of bit logic, GSK", samples.column("bits"), 8, passes["bits"]))
    lines.append(row(f"ClassicLadder, {RUNGS} rungs of bit logic", ladder, 1, calls))
    lines.append(row("motion-controller", samples.column("motion"), 1, calls))
    lines += ["", f"ClassicLadder takes {statistics.median(ladder) / bits:.0f} times as long for a scan of these {RUNGS} rungs (medians).",
              f"The thread's periods differ from 1 ms by {statistics.median(periods):.1f} us (median), {part(periods, 0.99):.1f} us (99 %), "
              f"{max(periods):.0f} us (worst).", "",
              "| reload by rungctl | reloads | excess over a usual call, us: median | worst |", "| --- | --- | --- | --- |"]
    for name, (_, _, every, title) in MACHINES.items():
        longer = pauses(samples, changed, name, every)
        lines.append(f"| {title} | {len(longer)} | {statistics.median(longer):.1f} | {max(longer):.1f} |")
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bin", type=Path)
    parser.add_argument("module", type=Path)
    parser.add_argument("--seconds", type=int, default=30)
    parser.add_argument("--changes", type=int, default=20)
    options = parser.parse_args()
    cnc_test.check_machine(options.module)
    with folder() as place, contextlib.redirect_stdout(sys.stderr):
        bench = make_bench(options, place)
        prepare(bench, options)
        bench.run("linuxcnc", "-r", str(bench.home / "machine.ini"))
        result = bench.home / "result.txt"
        expect(result.exists(), "LinuxCNC did not start the driver")
        expect(result.read_text(encoding="utf-8") == "passed", result.read_text(encoding="utf-8"))
        samples = Samples(bench.home / "samples.txt", ns_per_clock(place))
        seen = json.loads((bench.home / "seen.json").read_text())
        text = section(samples, seen["changed"], seen["passes"])
    print(text)


if __name__ == "__main__":
    sys.exit(main())
