#!/usr/bin/python3
"""Interrupts M3, M5 and M6 at each step of their handshake, by an abort and by the emergency stop, in MDI and in part programs.

steps.json: a list of the dialect's steps, [name, functions-busy, strobe, ack], null: either level.
"""
import collections
import json
import random
import time

import hal
import linuxcnc
from drive import check, command, done, errors, mdi, pin, polled, set_mode, status, wait
from driver import run, switch_on
from patience import patience

TRIES = 60  # the order to LinuxCNC takes some milliseconds: it may come too late for a step
FAST = 0.0001

# What shows in HAL that LinuxCNC has begun the function: a pin and its level.
BEGUN = {"M3": ("spindle-forward", True), "M5": ("spindle-on", False), "M6": ("tool-change", True)}
# What falls with an abort; after M5 nothing does.
TAKEN_BACK = {"M3": "spindle-on", "M5": "enable", "M6": "tool-change"}
MODES = {"MDI": linuxcnc.MODE_MDI, "program": linuxcnc.MODE_AUTO}


def levels():
    return pin("functions-busy"), pin("strobe"), pin("ack")


def is_at(step, seen):
    return all(wanted is None or wanted == level for wanted, level in zip(step[1:], seen))


def poll(what, condition):
    end = time.monotonic() + patience(5)
    while not condition():
        check(time.monotonic() < end, f"never came: {what}; levels {levels()}")
        time.sleep(FAST)


def other_tool():
    return 1 if polled().tool_in_spindle == 2 else 2


def begin(function, mode):
    """Gives LinuxCNC what leads to the function, without waiting."""
    line = {"M3": "M3 S1000", "M5": "M5", "M6": f"T{other_tool()} M6"}[function]
    if mode == "MDI":
        set_mode(linuxcnc.MODE_MDI)
        command.mdi(line)
        return
    with open("part.ngc", "w", encoding="ascii") as file:
        file.write(f"G21 G90\n{line}\nG1 X{5 if status.position[0] < 2 else 0} F300\nM2\n")
    set_mode(linuxcnc.MODE_AUTO)
    command.program_open("part.ngc")
    done("program open")
    command.auto(linuxcnc.AUTO_RUN, 0)


def interrupt(function, kind):
    """Gives the levels at the moment when it takes effect: just before LinuxCNC takes the function back, where it does."""
    seen = levels()
    if kind == "e-stop":
        hal.set_p("rung.estop-button", "1")
        return seen
    command.abort()
    serial = command.serial
    end = time.monotonic() + patience(5)
    while pin(TAKEN_BACK[function]) and polled().echo_serial_number < serial:
        check(time.monotonic() < end, "LinuxCNC does not take the abort")
        seen = levels()
    return seen


def reach(function, mode, step):
    """Begins the function and waits for its step, or until it is over: a busy machine may not see a step of 8 ms."""
    name, level = BEGUN[function]
    begin(function, mode)
    poll(f"{function} begins", lambda: pin(name) == level)
    end = time.monotonic() + 0.5
    while not pin("functions-busy") and time.monotonic() < end:
        time.sleep(FAST)
    poll(f"step {step[0]} of {function}", lambda: is_at(step, levels()) or not pin("functions-busy"))


def check_quiet(kind):
    """No strobe, nothing moves, LinuxCNC is idle; and it stays so."""
    def quiet():
        return (not pin("functions-busy") and not is_strobe() and not pin("moves") and polled().inpos
                and status.interp_state == linuxcnc.INTERP_IDLE and not hal.get_value("iocontrol.0.tool-change")
                and not hal.get_value("spindle.0.on"))

    def is_strobe():
        return pin("strobe")

    if kind == "e-stop":
        wait("e-stop", lambda: polled().task_state == linuxcnc.STATE_ESTOP)
        check(not pin("enable"), "the machine is enabled in an e-stop")
    try:
        wait("quiet", quiet, 3)
    except AssertionError as problem:
        raise AssertionError(f"{problem}; levels {levels()}, moves {pin('moves')}, inpos {status.inpos}, "
                             f"interpreter {status.interp_state}, spindle {hal.get_value('spindle.0.on')}") from None
    before = tuple(status.position[:3])
    end = time.monotonic() + 0.05
    while time.monotonic() < end:
        check(quiet(), f"not quiet any more: {levels()}")
        check(tuple(status.position[:3]) == before, f"an axis moves from {before} to {status.position[:3]}")


def recover(kind):
    if kind == "e-stop":
        hal.set_p("rung.estop-button", "0")
        switch_on()


def check_next():
    """The next M3, M6 and M5 are carried out."""
    set_mode(linuxcnc.MODE_MDI)
    mdi("M3 S500")
    wait("the spindle turns", lambda: pin("spindle-cw") and pin("up-to-speed"))
    tool = other_tool()
    mdi(f"T{tool} M6")
    check(polled().tool_in_spindle == tool, f"tool {status.tool_in_spindle} in the spindle, expected {tool}")
    mdi("M5")
    wait("the spindle stops", lambda: not pin("spindle-cw") and not pin("functions-busy"))
    check(not pin("fault") and pin("functions-lost") == 0, "a fault, or lost functions")


def prepare(function):
    if function != "M5":
        return
    set_mode(linuxcnc.MODE_MDI)
    mdi("M3 S1000")
    wait("the spindle turns", lambda: pin("up-to-speed") and not pin("functions-busy"))


def attempt(function, mode, kind, step, former, lead):
    """The levels where it was interrupted. The order is given in it, or `lead` seconds after the former step began."""
    prepare(function)
    reach(function, mode, former if lead else step)
    time.sleep(lead)
    seen = interrupt(function, kind)
    check_quiet(kind)
    recover(kind)
    check_next()
    while errors.poll():
        pass
    return seen


def case(function, mode, kind, step, former):
    missed = collections.Counter()
    for tries in range(1, TRIES + 1):
        lead = 0 if tries % 2 or kind == "e-stop" else random.uniform(0.001, 0.03)
        try:
            seen = attempt(function, mode, kind, step, former, lead)
        except AssertionError as problem:
            raise AssertionError(f"{function} in {mode}, {kind} at step {step[0]}, try {tries}: {problem}") from None
        if is_at(step, seen):
            return tries
        missed[seen] += 1
    raise AssertionError(f"{function} in {mode}: no {kind} came within step {step[0]} in {TRIES} tries, but {missed}")


def main():
    with open("steps.json", encoding="ascii") as file:
        steps = json.load(file)
    switch_on()
    for function in BEGUN:
        for mode in MODES:
            for kind in ("abort", "e-stop"):
                hits = [f"{step[0]} ({case(function, mode, kind, step, former)})"
                        for former, step in zip([steps[0], *steps], steps)]
                print(f"aborts: {function} in {mode}, {kind} at: {', '.join(hits)}", flush=True)


run(main)
