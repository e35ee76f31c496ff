#!/usr/bin/env python3
"""The machining centre of examples/gsk-mill in LinuxCNC: gsk_mill.py --module rung_hal.so --rungc RUNGC"""
import argparse
import shutil
import sys
import tempfile
from pathlib import Path

from cnc_test import Bench, HERE, check_machine, expect

ROOT = HERE.parents[1]
MACHINE = ROOT / "examples/gsk-mill"
# Of the program: a lamp that lights with the coolant's level, which no rung of it uses.
EDIT = ("FUNC END2", "LD   COOLANT_LEVEL\nOUT  R98.0\n\nFUNC END2")


def prepare(bench, rungc):
    project = bench.home / "gsk-mill"
    shutil.copytree(MACHINE, project)
    text = (MACHINE / "mill.pmc").read_text(encoding="utf-8")
    expect(text.count(EDIT[0]) == 1, "the end of the program")
    bench.program(bench.file("edited.pmc", text.replace(*EDIT)), "edited.so")
    ini = project / "linuxcnc/machine.ini"
    text = ini.read_text(encoding="utf-8")
    expect(text.count("DISPLAY = axis") == 1, "the display")
    ini.write_text(text.replace("DISPLAY = axis", f"DISPLAY = {bench.home}/drive_gsk.py"), encoding="utf-8")
    for tool in (Path(rungc).parent / "rungctl", ROOT / "tools/rung-hal/rung-operator", ROOT / "tools/rung-hal/rung-services"):
        shutil.copy(tool, bench.home)
    bench.copy(HERE / "drive_gsk.py")
    return ini


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--module", default="", help="the component; empty when it was not built")
    parser.add_argument("--rungc", required=True)
    parser.add_argument("--libexec", required=True, help="the folder in which the component looks for rung-compile")
    options = parser.parse_args()
    check_machine(options.module)
    with tempfile.TemporaryDirectory(dir="/var/tmp", prefix="rung-cnc-") as folder:
        bench = Bench(options, folder)
        ini = prepare(bench, options.rungc)
        bench.run("linuxcnc", "-r", str(ini))
        result = bench.home / "result.txt"
        expect(result.exists(), "LinuxCNC did not start the driver")
        expect(result.read_text(encoding="utf-8") == "passed", result.read_text(encoding="utf-8"))
    print("passed")


if __name__ == "__main__":
    sys.exit(main())
