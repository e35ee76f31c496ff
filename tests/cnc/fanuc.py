#!/usr/bin/python3
"""Runs inside LinuxCNC in place of its display: works at the panel of the FANUC machining centre and looks at the machine."""
import hal
import linuxcnc

import pmc
from drive import check, command, operator, scans, pin, pins, polled, program_time, rungctl, run, status, wait
from pmc import mdi, mode, position, press, put, signal, switch_on

# The switches have Gray code.
MACHINE = pmc.Machine(jog_key="jog", memory_key="mem", feed_full=15, feed_half=7, feed_fifth=3, feed_most=8,
                      spindle_switch="spindle-switch", spindle_full=7, spindle_more=4,
                      speed="F22:4", coolant_level="CLT_LEVEL", coolant_pump="CLT_PUMP", estop="EMG_PB",
                      motor_alarm="EX1006 A MOTOR PROTECTION SWITCH", with_part={})


def homing():
    check(not any(polled().homed[:3]), "homed too early")
    operator("REFERENCE POINTS ARE UNKNOWN")
    mode("ref", linuxcnc.MODE_MANUAL)
    pins(mode_is_zero=True, lamp_ref=True)
    press("px", "py", "pz")
    wait("homed", lambda: polled().homed[:3] == (1, 1, 1))
    pins(homed_x=True, homed_y=True, homed_z=True)


def modes():
    for key, wanted in (("mdi", linuxcnc.MODE_MDI), ("mem", linuxcnc.MODE_AUTO), ("wheel", linuxcnc.MODE_MANUAL),
                        ("mdi", linuxcnc.MODE_MDI), ("jog", linuxcnc.MODE_MANUAL), ("mem", linuxcnc.MODE_AUTO),
                        ("edit", linuxcnc.MODE_MANUAL)):
        mode(key, wanted)
        wait(f"lamp of {key}", lambda: pin(f"lamp-{key}"))
    command.mode(linuxcnc.MODE_MDI)  # on the screen: the program sees what LinuxCNC does
    pins(mode_is_mdi=True, mode_is_edit=False)
    command.mode(linuxcnc.MODE_MANUAL)
    pins(mode_is_mdi=False, mode_is_edit=True)


def wheel():
    mode("wheel", linuxcnc.MODE_MANUAL)
    pins(mode_is_wheel=True)
    put("wheel-z", 1)
    put("wheel-x10", 1)
    pins(wheel_0=True, wheel_1=True, step_low=True)
    before = position(2)
    signal("wheel-counts", -7)
    wait("seven steps of the wheel", lambda: abs(position(2) - before + 0.07) < 1e-6)
    put("wheel-z", 0)
    pins(wheel_0=False)
    signal("wheel-counts", 0)
    scans(25)
    check(abs(position(2) - before + 0.07) < 1e-6, "the wheel moves an axis that it has not chosen")
    put("wheel-x10", 0)
    mode("jog", linuxcnc.MODE_MANUAL)


def tools():
    """T during which the magazine turns, M6 with the arm; random pockets: the old tool goes where the new one came from."""
    begin = program_time()
    mdi("T3 M6")
    took = program_time() - begin
    check(took > 0.8, f"the magazine and the arm were not waited for: {took:.3f} s")
    check(polled().tool_in_spindle == 3, f"tool {status.tool_in_spindle} in the spindle")
    pins(tool=3, changing=False, pocket=3)
    mdi("T1 M6")
    pins(tool=1, pocket=1)
    check(table_entry(1) == 3, "tool 3 is not in the pocket of tool 1")
    mdi("T3 M6")  # from there
    pins(tool=3, pocket=1)
    check(table_entry(1) == 1, "tool 1 is not back")
    begin = program_time()
    mdi("T3 M6")  # the tool of the spindle
    check(program_time() - begin < 0.5, "a change for the tool of the spindle")


def table_entry(pocket):
    return int(rungctl("get", f"D{100 + 2 * pocket}:2").split()[-1])


def interrupted():
    """Emergency stop while the arm swaps: nothing moves before the operator finishes the change with the key."""
    old = pin("tool")
    pocket = next(pocket for pocket in range(1, 25) if table_entry(pocket) == 2)
    command.mdi("T2 M6")
    wait("the arm swaps", lambda: "true" in rungctl("get", "ARM_LEFT"))
    signal("estop-button", 1)
    pins(enable=False, arm_motor=False, changing=True)
    wait("e-stop", lambda: polled().task_state == linuxcnc.STATE_ESTOP)
    signal("estop-button", 0)
    operator("TOOL CHANGE INTERRUPTED")
    scans(25)
    switch_on()
    scans(100)
    pins(changing=True, arm_motor=False, tool=old)
    mode("jog", linuxcnc.MODE_MANUAL)
    put("key-changer", 1)
    pins(changing=False, tool=2)
    put("key-changer", 0)
    check(table_entry(pocket) == old, "the table does not follow the arm")
    pins(no_interlock=True)
    mode("mdi", linuxcnc.MODE_MDI)
    mdi("M61 Q2")  # LinuxCNC has not seen the end of its change
    mdi("G53 G0 Z0")


def parts():
    """The number of parts to macro variable 501, by a window function."""
    mode("mdi", linuxcnc.MODE_MDI)
    mdi("#501 = 0")
    rungctl("set", "TOTAL:4", "41")
    rungctl("set", "SEND_PART", "true")
    wait("the answer", lambda: "false" in rungctl("get", "SEND_PART"))
    check("false" in rungctl("get", "MSG_WIN"), "LinuxCNC has refused it")
    mdi("M68 E0 Q#501")
    wait("#501 = 41", lambda: hal.get_value("motion.analog-out-00") == 41)


STEPS = (switch_on, homing, modes, MACHINE.jog, wheel, MACHINE.spindle, pmc.coolant, tools, parts, MACHINE.overrides, MACHINE.part,
         pmc.single, MACHINE.alarm, pmc.probe, MACHINE.remote, interrupted, pmc.emergency_stop)
run(lambda: pmc.work(STEPS))
