#!/usr/bin/python3
"""Runs inside LinuxCNC in place of its display: works at the panel of the GSK machining centre and looks at the machine."""
import json

import hal
import linuxcnc

import pmc
from drive import check, command, scans, pin, pins, polled, program_time, rungctl, run, status, wait
from pmc import mdi, mode, position, press, put, signal, switch_on

MACHINE = pmc.Machine(jog_key="manual", memory_key="auto", feed_full=10, feed_half=5, feed_fifth=2, feed_most=15,
                      spindle_switch="spindle-switch-1", spindle_full=0, spindle_more=1,
                      speed="S00~S31", coolant_level="COOLANT_LEVEL", coolant_pump="COOLANT_PUMP", estop="X_ESP",
                      motor_alarm="MOTOR PROTECTION", with_part={"user_out_0": True})  # M64


def homing():
    pins(no_interlock=True)
    check(not any(polled().homed[:3]), "homed too early")
    mode("zero", linuxcnc.MODE_MANUAL)
    pins(mode_is_zero=True, lamp_zero=True)
    press("px", "py", "pz")
    wait("homed", lambda: polled().homed[:3] == (1, 1, 1))
    pins(homed_x=True, homed_y=True, homed_z=True)
    mode("mdi", linuxcnc.MODE_MDI)  # while rung-services reads a variable for the program, in a mode of its own
    mode("manual", linuxcnc.MODE_MANUAL)
    # the program has asked for macro variable 500, and has its answer
    wait("the program's first question", lambda: "false" in rungctl("get", "LIFE_WISH"))


def modes():
    for key, wanted in (("mdi", linuxcnc.MODE_MDI), ("auto", linuxcnc.MODE_AUTO), ("wheel", linuxcnc.MODE_MANUAL),
                        ("mdi", linuxcnc.MODE_MDI), ("manual", linuxcnc.MODE_MANUAL), ("step", linuxcnc.MODE_MANUAL)):
        mode(key, wanted)
        wait(f"lamp of {key}", lambda: pin(f"lamp-{key}"))
    command.mode(linuxcnc.MODE_MDI)  # on the screen: the program sees what LinuxCNC does
    pins(mode_is_mdi=True, mode_is_step=False)
    command.mode(linuxcnc.MODE_MANUAL)
    pins(mode_is_mdi=False, mode_is_step=True)


def mode_meanwhile():
    """A key that is pressed while rung-services has a line of MDI for the program."""
    mode("manual", linuxcnc.MODE_MANUAL)
    rungctl("set", "LIFE_WISH", "true")
    mode("mdi", linuxcnc.MODE_MDI)
    wait("the answer", lambda: "false" in rungctl("get", "LIFE_WISH"))
    scans(63)  # half a second, in which rung-services may go back to a mode
    check(polled().task_mode == linuxcnc.MODE_MDI, "the mode of the key was undone")


def jog_steps():
    mode("step", linuxcnc.MODE_MANUAL)
    press("50")
    before = position(1)
    for _ in range(2):
        press("py")
    wait("two steps", lambda: abs(position(1) - before - 0.2) < 1e-6)


def wheel():
    mode("wheel", linuxcnc.MODE_MANUAL)
    press("nz")
    press("25")
    pins(mode_is_wheel=True)
    before = position(2)
    signal("wheel-counts", -7)
    wait("seven steps of the wheel", lambda: abs(position(2) - before + 0.07) < 1e-6)
    mode("manual", linuxcnc.MODE_MANUAL)
    signal("wheel-counts", 0)
    scans(25)
    check(abs(position(2) - before + 0.07) < 1e-6, "the wheel moves in another mode")


def tools():
    """The magazine, the tool in the spindle and macro variable 500 by window functions."""
    mdi("#500 = 3600")
    begin = program_time()
    mdi("T1 M6")
    took = program_time() - begin
    check(took > 0.4, f"the magazine and the arm were not waited for: {took:.3f} s")
    check(polled().tool_in_spindle == 1, f"tool {status.tool_in_spindle} in the spindle")
    pins(tool=1, changing=False, life_limit=3600)
    ends = json.loads(rungctl("get", "TOOL_BLOCK_END:2", "D178:2", "--json"))["values"]
    check(set(ends.values()) == {0}, f"end codes of the window functions: {ends}")


STEPS = (switch_on, homing, modes, mode_meanwhile, MACHINE.jog, jog_steps, wheel, MACHINE.spindle, pmc.coolant, tools, MACHINE.overrides,
         MACHINE.part, pmc.single, MACHINE.alarm, pmc.probe, MACHINE.remote, pmc.emergency_stop)
run(lambda: pmc.work(STEPS))
