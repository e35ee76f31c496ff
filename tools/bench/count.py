#!/usr/bin/env python3
"""Instructions by callgrind: per part for the example machines, per scan for programs with device services and generated ones.

count.py BIN            prints the tables
count.py BIN --check    fails where a count is more than 1 % above that of counts.json. The counts hold for the environment
                        that the file names; in another one growth is only reported. Where the variable CI is set, another
                        environment is a failure as well, and so is a count that the file lacks
count.py BIN --update   writes counts.json
count.py BIN --record   renews the recordings, after a change of an example or of the simulation
count.py BIN --small    generated programs of 100 rungs only
count.py BIN --all      generated programs of 10,000 and 50,000 rungs as well: compilers take an hour for them
"""
import argparse
import json
import os
import platform
import sys
import tempfile
from pathlib import Path

import machines
import peers
import report
import services
from callgrind import TARGET, Failure, run
from generated import KINDS, SMALL_WORKS, Programs, works

TABLE = Path(__file__).resolve().parent / "counts.json"
GROWTH = 1.01


def environment(tools):
    return {"processor": platform.machine(), "code for": TARGET, "libc": " ".join(platform.libc_ver()),
            "compiler": run("clang++-19", "--version").splitlines()[0], "build": build_type(tools)}


def build_type(tools):
    cache = (tools.parent / "CMakeCache.txt").read_text(encoding="utf-8")
    return next((line.partition("=")[2] for line in cache.splitlines() if line.startswith("CMAKE_BUILD_TYPE:")), "none")


def names_of(rows):
    return {f"{dialect} {kind} {size}": row["ours"] for (dialect, kind, size), row in rows.items() if row is not None}


def compare(counts, kept):
    """(what has grown, what the table does not have)"""
    grown = [f"{name}: {kept[name]} before, {count} now" for name, count in counts.items()
             if name in kept and count > kept[name] * GROWTH]
    return grown, [f"{name}: {count}, not in {TABLE.name}" for name, count in counts.items() if name not in kept]


def verdict(counts, table, here, pinned_only):
    """What to print, and whether it is a failure. `pinned_only`: another environment than the table's is a failure."""
    grown, missing = compare(counts, table["instructions"])
    elsewhere = table["environment"] != here
    lines = grown + missing
    if elsewhere:
        lines.append(f"the counts of {TABLE.name} are for another environment: {table['environment']}; this one: {here}")
    if pinned_only:
        return lines, bool(lines)
    return lines, bool(lines) and not elsewhere


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("tools", type=Path, metavar="BIN", help="the folder of the programs")
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--update", action="store_true")
    parser.add_argument("--record", action="store_true")
    sizes = parser.add_mutually_exclusive_group()
    sizes.add_argument("--small", action="store_true")
    sizes.add_argument("--all", action="store_true")
    options = parser.parse_args()
    options.tools = options.tools.resolve()
    if options.record:
        machines.record(options.tools)
    of_machines = machines.measure(options.tools)
    of_services = services.measure(options.tools)
    with tempfile.TemporaryDirectory() as folder:
        programs = Programs(options.tools, folder)
        # A check needs no straight-line form, which compilers take minutes for.
        rows = programs.counts(SMALL_WORKS if options.small else works(KINDS if options.all else ()), not options.check)
    print(machines.text_of(of_machines))
    print(services.text_of(of_services))
    print(report.counts_text(rows))
    print(report.peers_text(rows, peers.versions()), end="")
    counts = {name: total for name, (_, total, _) in of_machines.items()}
    counts |= services.names_of(of_services) | names_of(rows)
    if options.update:
        kept = json.loads(TABLE.read_text(encoding="utf-8"))
        here = environment(options.tools)
        # Those of large programs stay as long as they are of the same environment.
        former = kept["instructions"] if kept["environment"] == here else {}
        table = {"environment": here, "instructions": former | counts}
        TABLE.write_text(json.dumps(table, indent=2) + "\n", encoding="utf-8")
    if options.check:
        lines, failed = verdict(counts, json.loads(TABLE.read_text(encoding="utf-8")), environment(options.tools),
                                bool(os.environ.get("CI")))
        problems = [services.excess(of_services)]
        if failed:
            problems.append("counts have grown, or are not in the table; if that is intended: ./dev bench --count --update\n" + "\n".join(lines))
        if any(problems):
            raise Failure("\n".join(filter(None, problems)))
        print("\n".join(lines))


if __name__ == "__main__":
    try:
        main()
    except Failure as failure:
        sys.exit(f"count.py: {failure}")
