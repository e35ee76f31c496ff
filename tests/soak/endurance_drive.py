#!/usr/bin/python3
"""Part programs and MDI for so many seconds as seconds.txt says, an e-stop a minute; seen.json has what has been counted."""
import json
import time

import hal
import linuxcnc
from drive import check, command, done, errors, mdi, polled, set_mode, status, wait
from driver import run, switch_on

HOSTS = ("fanuc", "gsk", "nct", "technol")
PINS = ("scans", "missed", "functions-lost", "fault")
LINES = ("M3 S1000", "G1 X10 F3000", "T{} M6", "M5", "G1 X0")


def values(pin):
    return {host: hal.get_value(f"{host}.{pin}") for host in HOSTS}


def other_tool():
    return 1 if polled().tool_in_spindle == 2 else 2


def by_mdi(tool):
    set_mode(linuxcnc.MODE_MDI)
    for line in LINES:
        mdi(line.format(tool))


def by_program(tool):
    with open("part.ngc", "w", encoding="ascii") as file:
        file.write("G21 G90\n" + "\n".join(LINES).format(tool) + "\nM2\n")
    set_mode(linuxcnc.MODE_AUTO)
    command.program_open("part.ngc")
    done("program open")
    command.auto(linuxcnc.AUTO_RUN, 0)
    wait("the program runs", lambda: polled().interp_state != linuxcnc.INTERP_IDLE or status.tool_in_spindle == tool)
    wait("the end of the program", lambda: polled().interp_state == linuxcnc.INTERP_IDLE)


def emergency_stop():
    set_mode(linuxcnc.MODE_MDI)
    mdi("M3 S1000")
    hal.set_p("gsk.estop-button", "1")
    wait("e-stop", lambda: polled().task_state == linuxcnc.STATE_ESTOP)
    wait("the spindles stop", lambda: not any(values("moves").values()))
    hal.set_p("gsk.estop-button", "0")
    switch_on()


def cycle(number):
    tool = other_tool()
    (by_program if number % 2 else by_mdi)(tool)
    check(polled().tool_in_spindle == tool, f"cycle {number}: tool {status.tool_in_spindle}, expected {tool}")
    wait("the spindles stop", lambda: not any(values("moves").values()))
    check(not any(values("fault").values()), f"cycle {number}: faults {values('fault')}")
    while errors.poll():
        pass


def settle():
    """Functions end, and messages leave."""
    wait("no function is under way", lambda: not any(values("functions-busy").values()))
    time.sleep(1)


def main():
    with open("seconds.txt", encoding="ascii") as file:
        end = time.monotonic() + float(file.read())
    switch_on()
    before, begin = values("scans"), time.monotonic()
    cycles = stops = 0
    while time.monotonic() < end:
        cycle(cycles)
        cycles += 1
        if time.monotonic() - begin > 60 * (stops + 1):
            emergency_stop()
            stops += 1
    settle()
    seen = {pin: values(pin) for pin in PINS}
    seen["scans"] = {host: count - before[host] for host, count in seen["scans"].items()}
    seen["shown"] = {host: hal.get_value(f"{host}.shown") for host in ("nct", "technol")}
    seen.update(seconds=time.monotonic() - begin, cycles=cycles, stops=stops)
    with open("seen.json", "w", encoding="ascii") as file:
        json.dump(seen, file)


run(main)
