#!/usr/bin/env python3
"""What recordings of the example machines at work take, and whether they are played as they were.

recordings.py BIN [SCANS]    measures, prints the section of docs/performance.md; exit 1 if a scan was played otherwise,
                             or a limit is exceeded
"""
import json
import sys
import tempfile
from pathlib import Path

import machines
from callgrind import Failure, counted, run, self_costs

ROOT = Path(__file__).resolve().parents[2]
WORK = Path(__file__).resolve().parent / "machines" / "work"
SCANS = 600_000
MOST_BYTES = 12  # of events, a scan
MOST_DAY = 512e6  # of files
DAY = 86_400_000  # scans at 1 kHz
HEAD = """## Recordings

What it takes to record a machine ([recording.md](recording.md)). Each example machine works with
its simulated control: tool changes, spindle, axes and coolant, one workpiece after the other, for
{scans:,} scans, which are ten minutes at 1 kHz. The program runs in a host of the runtime library;
what the machine and the CNC write into it is recorded. "Events": bytes before packing, without the
states that are written every ten seconds of the program's clock. "Day": what a day at 1 kHz would
take on the disk, with states every ten seconds, extrapolated from this. All scans are then played,
and a hash of the outputs is compared after each one, and the whole state at each recorded one:
"differences". "Played" is processor time.

Instructions are exact counts by callgrind for the part program, as
[above](#instructions-of-the-example-machines): of a scan or slot without a recorder, and what the
recorder adds on a processor with AVX2, which compares the inputs. Each program runs for less than
half a minute, so that whole states weigh more than later.
"""


def piece(machine):
    return WORK / f"{machine}.scn"


def scenario(machine):
    return f"examples/{machine}/{machines.MACHINES[machine]['part program']}"


def instructions(tools, machine, folder):
    """Of a part, without and with the recorder."""
    program, path = Path(folder) / f"{machine}.so", machines.recording(machine, "part program")
    machines.build(tools, machine, program)
    number = machines.parts_of(path)
    totals = []
    for recording in ((), (Path(folder) / f"{machine}.counted",)):
        profile = Path(folder) / "profile"
        counted(profile, tools / "rung-bench-scan", program, path, 0, number, *recording)
        totals.append(sum(self_costs(profile).values()) / number)
    return totals


def measure(tools, scans):
    rows = {}
    with tempfile.TemporaryDirectory() as folder:
        for machine in machines.MACHINES:
            at_work = json.loads(run(tools / "rung-bench-work", scenario(machine), piece(machine), scans, cwd=ROOT))
            rows[machine] = {**at_work, "instructions": instructions(tools, machine, folder)}
    return rows


def day(row):
    """States are as many as at 1 kHz: one for each 10,000 scans."""
    events, states = row["packed_events"] / row["scans"], row["packed_states"] / row["states"]
    return DAY * events + DAY / 10_000 * states


def text_of(rows, scans):
    lines = [HEAD.format(scans=scans), "| machine | workpieces | events, bytes a scan | day, MB | scans played | differences | played, s | instructions | recorder |",
             "| --- | --- | --- | --- | --- | --- | --- | --- | --- |"]
    for machine, row in rows.items():
        without, with_it = row["instructions"]
        lines.append(f"| {machine} | {row['pieces']:,} | {row['events'] / row['scans']:.1f} | {day(row) / 1e6:.0f} | {row['scans']:,} | {row['differences']} "
                     f"| {row['seconds']:.1f} | {without:,.0f} | {with_it - without:+,.0f} ({100 * (with_it / without - 1):.1f} %) |")
    return "\n".join(lines) + "\n"


def problems(rows):
    for machine, row in rows.items():
        if row["differences"] or row["losses"]:
            yield f"{machine}: {row['differences']} differences, {row['losses']} losses"
        if row["events"] > MOST_BYTES * row["scans"]:
            yield f"{machine}: {row['events'] / row['scans']:.1f} bytes a scan, expected at most {MOST_BYTES}"
        if day(row) > MOST_DAY:
            yield f"{machine}: {day(row) / 1e6:.0f} MB a day, expected at most {MOST_DAY / 1e6:.0f}"


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    scans = int(sys.argv[2]) if len(sys.argv) == 3 else SCANS
    try:
        rows = measure(Path(sys.argv[1]).resolve(), scans)
    except Failure as failure:
        sys.exit(str(failure))
    print(text_of(rows, scans))
    sys.exit("\n".join(problems(rows)) or 0)


if __name__ == "__main__":
    main()
