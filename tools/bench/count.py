#!/usr/bin/env python3
"""Instructions that the example machines take a part (a scan; of GSK a slot of 8 ms), counted by callgrind.

count.py BIN            prints the table
count.py BIN --check    fails where a count has grown by more than 1 % against counts.json, or is not in it
count.py BIN --update   writes counts.json
count.py BIN --record   makes the recordings anew, after a change of an example or of the simulation
"""
import argparse
import json
import os
import platform
import re
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
RECORDINGS = HERE / "machines" / "recordings"
TABLE = HERE / "counts.json"
GROWTH = 1.01
TARGET = "x86_64-linux-gnu"
# No copies by AVX or by microcode, which callgrind would count element by element.
PLAIN_COPIES = "glibc.cpu.hwcaps=-AVX_Fast_Unaligned_Load,-AVX2,-AVX512F,-ERMS,-FSRM"
IDLE_PARTS = (200, 500)  # the first one that is counted, and how many

MACHINES = {
    "gsk-mill": {"part program": "nc-program.scn", "tool change": "tool-change.scn"},
    "nct-turning-centre": {"part program": "nc-program.scn", "tool change": "nc-tools.scn"},
    "technol-machining-centre": {"part program": "part-program.scn", "tool change": "tool-change.scn"},
}
HEAD = """## Instructions of the example machines

Counted by callgrind, exactly: a program built by `rungc build`, in a host of the runtime's library with the control of its dialect. What its machine does comes from a
recording; writing it into the program's memory is not counted. A part is a scan, of GSK a slot of 8 ms. After each part all of the program's
memory is compared with that of the interpreter, by a hash. `./dev bench --count` makes this table alone.
"""


class Failure(Exception):
    pass


def run(*words, **options):
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, check=False, **options)
    if done.returncode != 0:
        raise Failure(f"{' '.join(str(word) for word in words)}:\n{done.stdout}{done.stderr}")
    return done.stdout


def recording(machine, situation):
    return RECORDINGS / f"{machine}-{situation.replace(' ', '-')}.txt"


def parts_of(path):
    """A line begins with a hash, or stands for several (*N)."""
    lines = path.read_text(encoding="ascii").splitlines()[1:]
    return sum(int(line[1:]) if line.startswith("*") else 1 for line in lines)


def record(tools):
    RECORDINGS.mkdir(exist_ok=True)
    for machine, situations in MACHINES.items():
        for situation, scenario in situations.items():
            text = run(tools / "rung-bench-record", f"examples/{machine}/{scenario}", cwd=ROOT)
            recording(machine, situation).write_text(text, encoding="ascii")


def self_costs(path):
    """Instructions by the file of the code, calls not included (the format of callgrind's profiles)."""
    names, costs, within, skip = {}, {}, "", False
    for line in path.read_text(encoding="utf-8", errors="replace").splitlines():
        if found := re.match(r"(c?)ob=\((\d+)\)(?: (.*))?", line):  # cob: of what is called
            name = names.setdefault(found[2], found[3])
            within = within if found[1] else name
        elif line.startswith("calls="):
            skip = True  # the next line is what the call costs, callee included
        elif found := re.match(r"[+\-*\d]\S* (\d+)$", line):
            if not skip:
                costs[within] = costs.get(within, 0) + int(found[1])
            skip = False
    return costs


def count(tools, program, path, parts, folder):
    """Instructions a part: those of the program's code, and all."""
    profile = Path(folder) / "profile"
    first, number = parts
    run(tools / "rung-bench-scan", program, path)
    run("valgrind", "--tool=callgrind", "--collect-atstart=no", f"--callgrind-out-file={profile}", tools / "rung-bench-scan",
        program, path, first, number, env={**os.environ, "GLIBC_TUNABLES": PLAIN_COPIES})
    costs = self_costs(profile)
    rungs = sum(cost for name, cost in costs.items() if name and name.endswith(program.name))
    return round(rungs / number), round(sum(costs.values()) / number)


def measure(tools):
    rows = {}
    with tempfile.TemporaryDirectory() as folder:
        nothing = Path(folder) / "nothing.txt"
        nothing.write_text("recording of nothing\n", encoding="ascii")
        for machine, situations in MACHINES.items():
            program = Path(folder) / f"{machine}.so"
            run(tools / "rungc", "build", "--target", TARGET, "-o", program, cwd=ROOT / "examples" / machine)
            rows[f"{machine}, after cold start"] = count(tools, program, nothing, IDLE_PARTS, folder)
            for situation in situations:
                path = recording(machine, situation)
                rows[f"{machine}, {situation}"] = count(tools, program, path, (0, parts_of(path)), folder)
    return rows


def environment():
    return {"processor": platform.machine(), "code for": TARGET, "libc": " ".join(platform.libc_ver()),
            "compiler": run("clang++-19", "--version").splitlines()[0]}


def check(rows):
    """What is wrong with them."""
    kept = json.loads(TABLE.read_text(encoding="utf-8"))
    if kept["environment"] != environment():
        raise Failure(f"the counts of {TABLE.name} were made elsewhere: {kept['environment']}; here: {environment()}")
    wrong = []
    for name, (_, total) in rows.items():
        before = kept["instructions a part"].get(name)
        if before is None:
            wrong.append(f"{name}: {total}, which {TABLE.name} does not have")
        elif total > before * GROWTH:
            wrong.append(f"{name}: {before} before, {total} now")
    return wrong


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("tools", type=Path, metavar="BIN", help="the folder of the programs")
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--update", action="store_true")
    parser.add_argument("--record", action="store_true")
    options = parser.parse_args()
    options.tools = options.tools.resolve()
    if options.record:
        record(options.tools)
    rows = measure(options.tools)
    print(HEAD)
    print("| machine | compiled rungs | around them | instructions a part |\n| --- | --- | --- | --- |")
    for name, (rungs, total) in rows.items():
        print(f"| {name} | {rungs:,} | {total - rungs:,} | {total:,} |")
    print()
    if options.update:
        table = {"environment": environment(), "instructions a part": {name: total for name, (_, total) in rows.items()}}
        TABLE.write_text(json.dumps(table, indent=2) + "\n", encoding="utf-8")
    if options.check and (wrong := check(rows)):
        raise Failure("more instructions than before; if that is meant: ./dev bench --update\n" + "\n".join(wrong))


if __name__ == "__main__":
    try:
        main()
    except Failure as failure:
        sys.exit(f"count.py: {failure}")
