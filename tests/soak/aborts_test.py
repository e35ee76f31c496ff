#!/usr/bin/env python3
"""M3, M5 and M6 are interrupted at every step of their handshake in LinuxCNC: aborts_test.py BIN MODULE [DIALECT…]

Each by an abort and by the emergency stop, from MDI and from a part program. After each no strobe is up, nothing moves, and the
next M3, M6 and M5 are carried out. After the name of each step is the number of tries that it took to come within it.
"""
import argparse
import json
import re
import sys
from pathlib import Path

from bench import CNC, HERE, cnc_test, expect, folder, make_bench

# Steps: name, functions-busy, strobe, ack.
PMC = {"pins": {"in": {"estop-ok": "ESTOP_OK", "estop-button": "ESTOP_BUTTON"},
                "out": {"enable": "ESP", "strobe": "MF", "ack": "FIN"}},
       "steps": [["before the strobe", True, False, False], ["strobe up", True, True, False],
                 ["acknowledged", True, True, True], ["strobe falling", True, False, True],
                 ["done", False, None, None]]}
DIALECTS = {
    "fanuc": {"suffix": ".mne", **PMC},
    "gsk": {"suffix": ".pmc", **PMC},
    "nct": {"suffix": ".lad",
            "pins": {"in": {"estop-ok": "ESTOP_OK", "estop-button": "ESTOP_BUTTON"},
                     "out": {"enable": "ENABLE", "strobe": "STROBE", "ack": "CP_M1ACK"}},
            "steps": [["before the strobe", True, False, True], ["strobe up", True, True, None],
                      ["acknowledge taken away", True, False, False], ["done", False, None, None]]},
    "technol": {"suffix": ".plc",
                "pins": {"in": {"estop-ok": "P1IN.0", "estop-button": "P1IN.1"},
                         "out": {"enable": "ENABLE", "strobe": "PO_F", "ack": "DONE_RUNS"}},
                "steps": [["before the block", True, False, None], ["MODULE_BLOCK_INIT", True, True, False],
                          ["MODULE_BLOCK_DONE", True, True, True], ["done", False, None, None]]},
}
COMMON = {name: name.upper().replace("-", "_") for name in ("spindle-cw", "spindle-ccw", "up-to-speed", "moves")}
TIMEOUT = 900


def pins(directions):
    lines = [f'{direction}.{pin} = {{ type = "bit", name = "{name}" }}'
             for direction, names in directions.items() for pin, name in names.items()]
    return "\n".join(lines + [f'out.{pin} = {{ type = "bit", name = "{name}" }}' for pin, name in COMMON.items()]) + "\n\n"


def prepare(bench, dialect):
    bench.program(HERE / ("steps" + dialect["suffix"]))
    bench.file("program.map", pins(dialect["pins"]) + (HERE / "steps.map").read_text(encoding="utf-8"))
    bench.file("steps.json", json.dumps(dialect["steps"]))
    machine(bench, HERE / "aborts_drive.py")


def machine(bench, driver):
    """LinuxCNC's configuration of tests/cnc; its tasks look for orders every millisecond."""
    ini = (CNC / "machine.ini").read_text(encoding="utf-8").split("[APPLICATIONS]")[0]
    ini = re.sub(r"CYCLE_TIME = .*", "CYCLE_TIME = 0.001", ini)
    bench.file("machine.ini", ini.replace("./drive.py", f"./{driver.name}"))
    bench.copy(HERE / "machine.hal")
    bench.copy(CNC / "tool.tbl")
    for file in (CNC / "drive.py", HERE / "driver.py", driver):
        bench.copy(file)
    (bench.home / driver.name).chmod(0o755)


def interrupted(options, name):
    dialect = DIALECTS[name]
    with folder() as place:
        bench = make_bench(options, place)
        prepare(bench, dialect)
        output = bench.run("linuxcnc", "-r", str(bench.home / "machine.ini")).stdout
        result = bench.home / "result.txt"
        expect(result.exists(), f"{name}: LinuxCNC did not start the driver")
        text = result.read_text(encoding="utf-8")
    shown = re.findall("aborts: .*", output)  # another process may have begun the line
    expect(text == "passed", f"{name}: {text}")
    expect(len(shown) == 12 and all(line.count("(") == len(dialect["steps"]) for line in shown), f"{name}: not all steps: {shown}")
    print(f"{name}: M3, M5 and M6 interrupted at all of {len(dialect['steps'])} steps, {len(shown) * len(dialect['steps'])} cases")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bin", type=Path)
    parser.add_argument("module", type=Path)
    parser.add_argument("dialects", nargs="*", metavar="DIALECT", help=f"{', '.join(DIALECTS)}; default: all")
    options = parser.parse_args()
    cnc_test.check_machine(options.module)
    cnc_test.TIMEOUT = TIMEOUT
    for name in options.dialects or DIALECTS:
        interrupted(options, name)
    print("passed")


if __name__ == "__main__":
    sys.exit(main())
