#!/usr/bin/env python3
"""Whether two builds make the same IR of all programs of tests, examples and docs: same_ir.py OLD_RUNGC NEW_RUNGC

For a change that must not change programs. Compares `emit ir`, as built and optimised, and its exit status; prints the
programs that differ, and exits with 1 where one does.
"""
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
ENDINGS = {".lad", ".mne", ".plc", ".pmc"}
LEVELS = ("0", "2")


def programs():
    listed = subprocess.run(["git", "ls-files", "tests", "examples", "docs"], cwd=ROOT, capture_output=True, text=True, check=True)
    files = [Path(line) for line in listed.stdout.splitlines()]
    yield from (["--no-project", str(file)] for file in files if file.suffix in ENDINGS)
    yield from ([str(file.parent)] for file in files if file.name == "rung.toml")


def ir_of(rungc, program, level):
    done = subprocess.run([rungc, "emit", "ir", "-O", level, *program], cwd=ROOT, capture_output=True, check=False, timeout=600)
    return done.returncode, done.stdout


def differs(old, new, program):
    return any(ir_of(old, program, level) != ir_of(new, program, level) for level in LEVELS)


def main():
    old, new = (str(Path(name).resolve()) for name in sys.argv[1:])
    all_programs = list(programs())
    with ThreadPoolExecutor(2) as pool:
        different = [program for program, found in zip(all_programs, pool.map(lambda p: differs(old, new, p), all_programs)) if found]
    for program in different:
        print("differs:", *program)
    print(f"{len(all_programs)} programs, {len(different)} differ")
    return bool(different)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    sys.exit(main())
