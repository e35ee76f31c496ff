#!/usr/bin/env python3
"""An example's own LinuxCNC configuration: machine_session.py --example FOLDER --driver DRIVER.py --module rung_hal.so --rungc RUNGC.

The configuration is started as it is, with the driver as its display and an edited program beside its own.
Exit status 77: cannot be tried here, and why.
"""
import argparse
import shutil
import tempfile
from pathlib import Path

from cnc_test import HERE, Bench, check_machine, expect

TOOLS = HERE.parents[1] / "tools"


def build(bench, options):
    """program.so, and edited.so of the changed copy that `remote` loads."""
    bench.program(options.example)
    name, old, new = options.edit
    with tempfile.TemporaryDirectory() as folder:
        copy = Path(folder) / "edited"
        shutil.copytree(options.example, copy, ignore=shutil.ignore_patterns("*.scn", "linuxcnc"))
        source = copy / name
        text = source.read_text(encoding="utf-8")
        expect(text.count(old) == 1, f"{old} is not once in {name}")
        source.write_text(text.replace(old, new), encoding="utf-8")
        bench.program(copy, "edited.so")


def configure(bench, options):
    """The example's folder, but for the program's path and the display."""
    shutil.copytree(options.example / "linuxcnc", bench.home, dirs_exist_ok=True)
    ini = bench.home / "machine.ini"
    text = ini.read_text(encoding="utf-8")
    for old, new in (("DISPLAY = axis\n", f"DISPLAY = ./{options.driver.name}\n"),
                     (options.program, f"{bench.home}/program.so")):
        expect(text.count(old) == 1, f"{old} is not once in machine.ini")
        text = text.replace(old, new)
    ini.write_text(text, encoding="utf-8")
    for tool in (Path(options.rungc).parent / "rungctl", TOOLS / "rung-hal/rung-operator", TOOLS / "rung-hal/rung-services", HERE / "drive.py", options.driver):
        shutil.copy(tool, bench.home)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--example", type=Path, required=True, help="the example's folder, with its folder linuxcnc")
    parser.add_argument("--driver", type=Path, required=True, help="what works at the machine")
    parser.add_argument("--edit", nargs=3, required=True, metavar=("FILE", "OLD", "NEW"), help="the change that is loaded")
    parser.add_argument("--program", required=True, help="the program's path in machine.ini")
    parser.add_argument("--module", default="", help="the component; empty when it was not built")
    parser.add_argument("--rungc", required=True)
    parser.set_defaults(libexec="")  # nothing is compiled there
    options = parser.parse_args()
    check_machine(options.module)
    with tempfile.TemporaryDirectory(dir="/var/tmp", prefix="rung-cnc-") as folder:
        bench = Bench(options, folder)
        build(bench, options)
        configure(bench, options)
        bench.run("linuxcnc", "-r", str(bench.home / "machine.ini"))
        result = bench.home / "result.txt"
        expect(result.exists(), "LinuxCNC did not start the driver")
        expect(result.read_text(encoding="utf-8") == "passed", result.read_text(encoding="utf-8"))
    print("passed")


if __name__ == "__main__":
    main()
