#!/usr/bin/env python3
"""What LinuxCNC has recorded is played on another type of machine: session.py BUILD BUILD_ARM64.

The machines' sessions (tests/cnc) run once more, and keep their recordings. Each is played by the runtime alone, on this
machine and on 64-bit ARM by qemu, with the programs compiled for each: messages, faults, and the whole
memory after every part must be the same.
"""
import json
import subprocess
import sys
import tempfile
from pathlib import Path

MACHINES = "fanuc|gsk|nct|technol"
PLAY = "tests/other-machine/rung_play_recording"


def sessions(build):
    """The commands of the tests: {name: words}."""
    shown = subprocess.run(["ctest", "--show-only=json-v1", "-R", rf"^cnc\.({MACHINES})$"], cwd=build, check=True, stdout=subprocess.PIPE)
    found = {test["name"]: test["command"] for test in json.loads(shown.stdout)["tests"]}
    if len(found) != len(MACHINES.split("|")):
        sys.exit(f"tests of {MACHINES}: found {list(found)}")
    return found


def played(command, session, target):
    result = subprocess.run([*command, session / "recording", *(session / target).iterdir()], stdout=subprocess.PIPE, encoding="utf-8")
    lines = result.stdout.splitlines()
    if result.returncode != 0:
        sys.exit("\n".join([f"{target}: not played as recorded:", *lines[-20:]]))
    return lines


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    here, there = (Path(argument).resolve() for argument in sys.argv[1:])
    for name, command in sessions(here).items():
        with tempfile.TemporaryDirectory() as folder:
            session = Path(folder, "session")
            result = subprocess.run([*command, "--keep", session])
            if result.returncode != 0:
                sys.exit(f"{name}: exit status {result.returncode}")
            ours = played([here / PLAY], session, "x86_64-linux-gnu")
            theirs = played(["qemu-aarch64-static", "-L", "/usr/aarch64-linux-gnu", there / PLAY], session, "aarch64-linux-gnu")
        for one, other in zip(ours, theirs):
            if one != other:
                sys.exit(f"{name}: {one}; on ARM: {other}")
        print(f"{name}, on both: {ours[-1]}", flush=True)


if __name__ == "__main__":
    main()
