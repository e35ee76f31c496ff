#!/usr/bin/env python3
"""An example's own LinuxCNC configuration: machine_session.py --example FOLDER --driver DRIVER.py --module rung_hal.so --rungc RUNGC.

The configuration is started as it is, in a copy of the example, with the driver as its display and edited sources beside its own.
What it has recorded is then played: with the same values everywhere, and the reason of the emergency stop.
Exit status 77: cannot be tried here, and why.
"""
import argparse
import re
import shutil
import subprocess
import tempfile
from pathlib import Path

from cnc_test import HERE, PATIENCE, Bench, check_machine, expect

TOOLS = HERE.parents[1] / "machine/rung-hal"


def replace(path, old, new):
    text = path.read_text(encoding="utf-8")
    expect(text.count(old) == 1, f"{old} is not once in {path.name}")
    path.write_text(text.replace(old, new), encoding="utf-8")


def edit(folder, options):
    """The changed copy of the sources that `remote` loads."""
    name, old, new = options.edit
    shutil.copytree(options.example, folder, ignore=shutil.ignore_patterns("*.scn", "linuxcnc"))
    replace(folder / name, old, new)


def configure(bench, options):
    """The example's folder, but for the display."""
    shutil.copytree(options.example, bench.home / "machine", ignore=shutil.ignore_patterns("*.scn"))
    folder = bench.home / "machine" / "linuxcnc"
    replace(folder / "machine.ini", "DISPLAY = axis\n", f"DISPLAY = ./{options.driver.name}\n")
    for file in (HERE / "drive.py", HERE / "panel.py", HERE / "pmc.py", PATIENCE, options.driver):
        shutil.copy(file, folder)
    for tool in (Path(options.rungc).parent / "rungctl", TOOLS / "rung-operator", TOOLS / "rung-services"):
        shutil.copy(tool, bench.home)
    return folder


def record(folder):
    """Also a machine that retains nothing."""
    for mapping in folder.glob("*.map"):
        mapping.write_text(mapping.read_text(encoding="utf-8") + '\n[recording]\nfolder = "recording"\n', encoding="utf-8")


def replay(options, recording, *words, text=None):
    result = subprocess.run([options.rungc, "replay", recording, *words], input=text, stdout=subprocess.PIPE, encoding="utf-8",
                            check=text is None)
    return result.stdout


def shown(place):
    """By its name, or by its address in brackets after the name."""
    return rf"(\S+ \()?{re.escape(place)}\b"


def check_recording(options, recording):
    said = replay(options, recording, text="compare\nquit\n")
    expect(re.fullmatch(r"\d+ scans do what was recorded\n", said), f"played differently: {said}")
    what, contact = options.estop
    found = re.findall(r"^scan (\d+),", replay(options, recording, "--find", f"falls {contact}"), re.MULTILINE)
    expect(found, f"{contact} has never been open")
    # the program may need a scan more
    said = replay(options, recording, "--why", f"{what}@{int(found[-1]) + 1}")
    expect(re.match(rf"{shown(what)}.* = 0, since scan", said), f"no emergency stop: {said}")
    expect(re.search(rf"^ *{shown(contact)}.* = 0, .*decided", said, re.MULTILINE), f"{contact} was not the reason: {said}")


def keep(options, configuration, folder):
    """For tests/other-machine/session.py: the recording, and its programs for two types of machines. They are known by hashes,
    which are of names of files, too: as the component and `rungctl reload edited` were given them."""
    shutil.copytree(configuration / "recording", folder / "recording")
    for target in ("x86_64-linux-gnu", "aarch64-linux-gnu"):
        for name, sources in (("original", configuration.parent), ("edited", "edited")):
            made = folder / target / f"{name}.so"
            made.parent.mkdir(exist_ok=True)
            subprocess.run([options.rungc, "build", sources, "-q", "-o", made, "--target", target], cwd=configuration, check=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--example", type=Path, required=True, help="the example's folder, with its folder linuxcnc")
    parser.add_argument("--driver", type=Path, required=True, help="what works at the machine")
    parser.add_argument("--edit", nargs=3, required=True, metavar=("FILE", "OLD", "NEW"), help="the change that is loaded")
    parser.add_argument("--estop", nargs=2, required=True, metavar=("NAME", "CONTACT"), help="what the emergency stop's contact switches off")
    parser.add_argument("--keep", type=Path, metavar="FOLDER", help="leave the recording there, and the sources of its programs")
    parser.add_argument("--never", nargs="+", default=[], metavar="TEXT", help="what LinuxCNC and the program must not report")
    parser.add_argument("--module", default="", help="the component; empty when it was not built")
    parser.add_argument("--rungc", required=True)
    parser.add_argument("--libexec", required=True, help="the folder in which the component looks for rung-compile")
    options = parser.parse_args()
    check_machine(options.module)
    with tempfile.TemporaryDirectory(dir="/var/tmp", prefix="rung-cnc-") as folder:
        bench = Bench(options, folder)
        configuration = configure(bench, options)
        record(configuration)
        edit(configuration / "edited", options)
        log = bench.run("linuxcnc", "-r", str(configuration / "machine.ini")).stdout
        result = configuration / "result.txt"
        expect(result.exists(), "LinuxCNC did not start the driver")
        expect(result.read_text(encoding="utf-8") == "passed", result.read_text(encoding="utf-8"))
        for text in options.never:
            expect(text not in log, f"{text}: in the log")
        if options.keep:
            keep(options, configuration, options.keep)
        check_recording(options, configuration / "recording")
    print("passed")


if __name__ == "__main__":
    main()
