#!/usr/bin/env python3
"""The part of docs/performance.md after the engines: starts, counts, cold scans, costs of instructions; and the plots.

report.py BIN FOLDER    measures, prints the text, and writes the plots into the folder
"""
import datetime
import os
import platform
import re
import sys
import tempfile
from pathlib import Path

import machines
import passes
import peers
import plot
import real
import recordings
import services
import start
from callgrind import Failure, run
from generated import DIALECTS, LARGE_KINDS, Instructions, Programs, percentile, works

TITLES = {"bits": "bit logic", "arrays": "bit logic of arrays", "timers-idle": "timers, idle", "timers-running": "timers, running", "counters": "counters",
          "integers": "integer arithmetic", "reals": "floating-point arithmetic", "indexed": "indexed addressing",
          "signals": "bit logic on NC signals", "mechanisms-idle": "mechanisms, idle",
          "mechanisms-waiting": "mechanisms, waiting", "mechanisms": "mechanisms", "full": "full"}
NAMES = {"nct": "NCT", "gsk": "GSK", "technol": "TECHNOL"}
PLOTTED_SIZE = 1000
COLD = (("full", 1000), ("bits", 1000), ("timers-running", 100), ("counters", 100), ("integers", 200))

COUNTS_HEAD = """## Instructions of generated programs

Exact counts by callgrind, as above: a scan in the host's runner, without a control, after twenty
others. A program is drawn from a seed (tools/bench/generated) and written in each dialect, and as
straight-line C++ in two forms, one byte per bit and 64 bits per word, compiled by g++ and clang++
at -O3. All get the same inputs, some of which change before each scan, and must give the same
outputs: bits, words, tables and floating-point numbers are compared after each of 400 scans. The
reference is the straight-line form with the fewest instructions. "Bit logic of arrays" consists of
groups of 50 isomorphic rungs over adjacent bits: alarms that latch, and their lamps. "Full" is bit
logic with one timer, one counter and two integer operations for every ten rungs of it. A dash: the
control cannot hold that many rungs, or has no such instruction. In brackets: how many of these are
in the compiled rungs; the others are the runner's.
"""
PEERS_HEAD = """### The same programs in other systems

ClassicLadder interprets its rungs; matiec and STruC++ translate Structured Text (IEC 61131-3) into
C and C++, compiled at -O3 by gcc and clang. The one with fewer instructions counts. Results are
compared with ours after each of 400 scans, with the same inputs. In Structured Text a bit is a
BOOL, an integer a UDINT, a table an array. No variable is in the I/O image, so nothing is copied
before and after a scan; our counts include the copies, as above. A timer is the standard's TON,
which keeps the elapsed time as well; a counter is written with IF and assignments, because the
standard's CTU stops at its preset. Ratios are ours to theirs. Left out: mechanisms, which
Structured Text does not have, and programs of more than 1,000 rungs, because each becomes one
function, which takes too long to compile. ClassicLadder has bit logic only: its timers count in
tenths of a second, and its arithmetic is text, which it parses in every scan.
"""
COLD_HEAD = """## Cold scans

A task of 1 ms always runs after a sleep. Here our scan and the reference's run in turn in one
process, each after a sleep of 1 ms, 2,000 times. What changes at the machine is written before the
time is taken, to addresses that were looked up before. "10 %" is the 10th percentile. "Disturbed":
before the sleep other work touches 2 MB. "Early", ours only: the thread wakes 250 µs early,
prefetches what a scan reads, and waits ([real-time.md](real-time.md#waking-early)). "Hot": one scan
directly after another. Times are in microseconds and include two readings of the clock. Ratios are
from one run.
"""
TOUCHED_HEAD = """### What a scan touches

Cache lines of 64 bytes and pages of 4 kB, by callgrind's model of a cache that is empty at first.

| program | ours: code | ours: data | reference: code | reference: data |
| --- | --- | --- | --- | --- |"""
COST_HEAD = """## What an instruction costs

Measured as makers of controls do: a program of 100 equal rungs minus the empty program, divided by 100.
The condition is 1 and stays so, and what follows it is executed in every scan; a rung consists of
its contact and what the row names. Hot: one scan directly after another, median; cold: after a
sleep of 1 ms, 10th percentile.
"""


def machine_text():
    cpu = re.search(r"model name\s*: (.*)", Path("/proc/cpuinfo").read_text(encoding="utf-8"))
    gcc = run("g++", "--version").splitlines()[0]
    clang = run("clang++-19", "--version").splitlines()[0]
    return (f"{cpu[1] if cpu else platform.machine()}, Linux {platform.release().partition('-')[0]}, {' '.join(platform.libc_ver())}, {gcc}, {clang}, "
            f"{datetime.date.today()}")


def named(work):
    return f"{work[1]:,} × {TITLES[work[0]]}" if work[0] != "full" else f"full, {work[1]:,} rungs"


def reference(row):
    return min(row["straight"].values())


def counts_text(rows):
    with_straight = any(row and row["straight"] for row in rows.values())
    head = ["program", *(NAMES[d] for d in DIALECTS)]
    if with_straight:
        head += ["reference", "its form", *(f"{NAMES[d]} / reference" for d in DIALECTS)]
    lines = [COUNTS_HEAD, f"| {' | '.join(head)} |", "|" + " --- |" * len(head)]
    for work in dict.fromkeys(key[1:] for key in rows):
        each = [rows[(dialect, *work)] for dialect in DIALECTS]
        cells = [named(work), *(f"{row['ours']:,} ({row['rungs']:,})" if row else "–" for row in each)]
        some = next((row for row in each if row and row["straight"]), None)
        if not any(each):
            continue
        if some:
            form = min(some["straight"], key=some["straight"].get)
            cells += [f"{reference(some):,}", ", ".join(form), *(f"{row['ours'] / reference(row):.2f}" if row else "–" for row in each)]
        lines.append(f"| {' | '.join(cells)} |")
    return "\n".join(lines) + "\n"


def fewest(row, title):
    """(compiler, instructions) of a peer, or None."""
    counts = {name.removeprefix(f"{title}, "): count for name, count in row["peers"].items() if name.startswith(f"{title}, ")}
    return min(counts.items(), key=lambda each: each[1], default=None)


def ratio_text(ratio):
    return f"{ratio:.2f}" if ratio >= 0.1 else f"{ratio:.2g}"


def peer_lines(rows, title):
    for work in dict.fromkeys(key[1:] for key in rows):
        each = [rows[(dialect, *work)] for dialect in DIALECTS]
        some = next((row for row in each if row and fewest(row, title)), None)
        if some is None:
            continue
        compiler, count = fewest(some, title)
        cells = [named(work), *(f"{row['ours']:,}" if row else "–" for row in each), f"{reference(some):,}", f"{count:,}", compiler,
                 *(ratio_text(row["ours"] / fewest(row, title)[1]) if row else "–" for row in each)]
        yield f"| {' | '.join(cells)} |"


def peers_text(rows, versions):
    """Empty where there is no peer."""
    lines = [PEERS_HEAD] if versions else []
    for title, version in versions.items():
        head = ["program", *(NAMES[d] for d in DIALECTS), "straight-line reference", title, "C compiled by",
                *(f"{NAMES[d]} / {title}" for d in DIALECTS)]
        lines += [f"{title} {version}:", "", f"| {' | '.join(head)} |", "|" + " --- |" * len(head), *peer_lines(rows, title), ""]
    return "\n".join(lines) + "\n" if lines else ""


def microseconds(values, percent):
    return percentile(values, percent) / 1000


def ratio_spread(ours, theirs):
    """(10th percentile, median, 90th) of the ratios of scans that ran in turn."""
    ratios = [a / b for a, b in zip(ours, theirs) if b > 0]
    return tuple(percentile(ratios, p) for p in (10, 50, 90))


def cold_row(name, times):
    ours_hot, ours, ours_disturbed, hot, cold, disturbed, early = times

    def cell(a, b, percent):
        x, y = microseconds(a, percent), microseconds(b, percent)
        return f"{x:.2f}, {y:.2f}, {x / y:.2f}"

    def early_cell(percent):
        x = microseconds(early, percent)
        return f"{x:.2f}, {x / microseconds(ours, percent):.2f}"
    return (f"| {name} | {microseconds(ours_hot, 50):.2f}, {microseconds(hot, 50):.2f} | {cell(ours, cold, 10)} | "
            f"{cell(ours, cold, 50)} | {cell(ours_disturbed, disturbed, 10)} | {early_cell(10)} | {early_cell(50)} |")


def cold_text(programs, rows):
    """The text, and groups for the plot: a program, and of each dialect the spread of ratios."""
    lines = [COLD_HEAD, "| program | hot: ours, reference | cold, 10 %: ours, reference, ratio | cold, median: ours, reference, ratio | "
             "disturbed, 10 %: ours, reference, ratio | early, 10 %: ours, ratio to cold | early, median: ours, ratio to cold |", "|" + " --- |" * 7]
    places = [TOUCHED_HEAD]
    groups = []
    for work in COLD:
        spreads = []
        for dialect in DIALECTS:
            row = rows.get((dialect, *work))
            if row is None:
                spreads.append(None)
                continue
            fastest = programs.fastest(row, work)
            name = f"{NAMES[dialect]}, {named(work)}"
            times = programs.times(dialect, work, fastest)
            lines.append(cold_row(name, times))
            spreads.append(ratio_spread(times[1], times[4]))
            own, theirs = programs.footprint(dialect, work, {}), programs.footprint(dialect, work, fastest)
            cells = [f"{side[0][i]:,} lines, {side[1][i]} pages" for side in (own, theirs) for i in (0, 1)]
            places.append(f"| {name} | {' | '.join(cells)} |")
        groups.append((named(work), spreads))
    return "\n".join([*lines, "", *places]) + "\n", groups


def cost_text(programs):
    lines = [COST_HEAD]
    for dialect in DIALECTS:
        lines += [f"### {NAMES[dialect]}", "", "| rung | instructions | ns, hot | ns, cold |", "| --- | --- | --- | --- |"]
        lines += [f"| {title} | {count:.1f} | {hot:.2f} | {cold:.2f} |" for title, count, hot, cold in Instructions(programs, dialect).rows()]
        lines.append("")
    return "\n".join(lines)


def main(tools, folder):
    machine = machine_text()
    starts = start.measure(tools)
    of_machines = machines.measure(tools)
    of_services = services.measure(tools)
    of_recordings = recordings.measure(tools, recordings.SCANS)
    of_real = real.measure(tools)
    of_passes = passes.measure(tools)
    with tempfile.TemporaryDirectory() as built:
        programs = Programs(tools, built)
        rows = programs.counts(works(LARGE_KINDS), True)
        cold, groups = cold_text(programs, rows)
        costs = cost_text(programs)
    series = [NAMES[dialect] for dialect in DIALECTS]
    by_count = [(named(work), [rows[(d, *work)]["ours"] / reference(rows[(d, *work)]) if rows[(d, *work)] else None for d in DIALECTS])
                for work in dict.fromkeys(key[1:] for key in rows) if work[1] == PLOTTED_SIZE]
    plots = {"performance-counts.svg": plot.bars("Instructions per scan, as ratio to the fastest straight-line C++", machine, by_count, series, 1),
             "performance-cold.svg": plot.bars("Cold scans, as ratio to straight-line C++: median, 10 to 90 %", machine, groups, series, 1)}
    for name, drawing in plots.items():
        (folder / name).write_text(drawing, encoding="utf-8")
    print(start.text_of(starts, os.cpu_count()))
    print(machines.text_of(of_machines))
    print(services.text_of(of_services))
    print(recordings.text_of(of_recordings, recordings.SCANS))
    print(real.text_of(of_real))
    print(passes.text_of(of_passes))
    print(f"{counts_text(rows)}\n![Ratios of instructions, a bar for each dialect and program](performance-counts.svg)\n")
    print(peers_text(rows, peers.versions()), end="")
    print(f"{cold}\n![Ratios of cold scans, with their spread](performance-cold.svg)\n")
    print(f"Measured on {machine}.\n\n{costs}")


if __name__ == "__main__":
    try:
        main(Path(sys.argv[1]).resolve(), Path(sys.argv[2]))
    except Failure as failure:
        sys.exit(f"report.py: {failure}")
