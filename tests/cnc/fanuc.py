#!/usr/bin/python3
"""Runs inside LinuxCNC in place of its display: works at the panel of the machining centre and looks at the machine."""
import os
import subprocess
import time
import traceback

import hal
import linuxcnc

from drive import (again_until, at_rest, change_in_motion, check, command, done, end_motion, operator, scans, pin, pins, polled, program_time, progress, rungctl, run,
                   status, wait)
from patience import patience

PRESS = 19  # scans of the program, of 8 ms, in which a key is held: LinuxCNC is to see it, too
SCANS = 4  # in which it is up


def put(name, value):
    hal.set_p("rung." + name, str(value))


def signal(name, value):
    subprocess.run(["halcmd", "sets", name, str(value)], check=True, timeout=patience())


def press(*keys, count=PRESS, until=None):
    """Holds the keys until the program has seen them; again until this comes of it."""
    if until:
        return again_until(f"what {keys} are pressed for", lambda: press(*keys, count=count), until)
    begin = pin("scans")
    for key in keys:
        put("key-" + key, 1)
    scans(count, begin)
    for key in keys:
        put("key-" + key, 0)
    scans(SCANS)


def mode(key, wanted):
    press(key, until=lambda: polled().task_mode == wanted)


def mdi(line):
    wait("LinuxCNC at rest", lambda: polled().interp_state == linuxcnc.INTERP_IDLE and status.task_mode == linuxcnc.MODE_MDI)
    command.mdi(line)
    done(line)
    polled()


def position(axis):
    return polled().actual_position[axis]


def switch_on():
    """Emergency stop released, machine on by its button."""
    command.state(linuxcnc.STATE_ESTOP_RESET)
    pins(enable=True, lamp_on=True)
    wait("e-stop is reset", lambda: polled().task_state == linuxcnc.STATE_ESTOP_RESET)
    signal("on-button", 1)
    wait("machine on", lambda: polled().task_state == linuxcnc.STATE_ON)
    scans(SCANS)
    signal("on-button", 0)
    pins(servo_ready=True)


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


def jogged(key):
    """How far X goes while the key is held for some 0.6 s, in mm for each second of the program that it is."""
    begin, stood = program_time(), position(0)
    press(key, count=75)
    held = program_time() - begin
    return abs(at_rest(lambda: position(0)) - stood) / held


def jog():
    mode("jog", linuxcnc.MODE_MANUAL)
    pins(mode_is_jog=True)
    speed = jogged("px")
    check(13 < speed < 22, f"jog with {speed} mm/s instead of 20")
    put("feed-switch", 7)  # Gray code of position 5
    speed = jogged("nx")
    check(6 < speed < 11, f"jog with {speed} mm/s instead of half of that")
    put("feed-switch", 15)


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


def spindle():
    mode("mdi", linuxcnc.MODE_MDI)
    mdi("M3 S1000")
    begin = program_time()
    mdi("G1 X5 F6000")
    took = program_time() - begin
    check(pin("up-to-speed"), "feed without speed")
    check(took > 0.05, f"the feed did not wait for the spindle: {took:.3f} s")
    pins(spindle_cw=True, spindle_ccw=False, spindle_at_speed=True)
    mdi("M4 S1000")
    pins(spindle_cw=False, spindle_ccw=True)
    put("spindle-switch", 4)  # Gray code of position 7
    wait("spindle override 120 %", lambda: abs(polled().spindle[0]["override"] - 1.2) < 1e-6)
    put("spindle-switch", 7)
    wait("spindle override 100 %", lambda: abs(polled().spindle[0]["override"] - 1.0) < 1e-6)
    gears()
    mdi("M5")
    pins(spindle_cw=False, spindle_ccw=False, up_to_speed=False, spindle_stands=True)
    mdi("M19 R0")
    pins(orient=True, spindle_in_place=True)
    mdi("M5")


def speed_code():
    return int(rungctl("get", "F22:4").split()[-1])


def gears():
    """S goes to the program, which shifts the gear that the control has chosen; the cut waits for it."""
    pins(low_gear_valve=True, high_gear_valve=False)
    mdi("S2501")
    pins(gear_swing=True, up_to_speed=False)
    check(speed_code() == 2501, f"S{speed_code()}")
    mdi("G1 X4 F6000")
    check(pin("high-gear-valve") and not pin("low-gear-valve") and not pin("gear-swing"), "the cut did not wait for the gear")
    check(hal.get_value("spindle.0.speed-in") > 41, "feed without the speed of the other gear")
    mdi("S1000")
    mdi("G1 X5 F6000")
    pins(low_gear_valve=True, high_gear_valve=False, gear_swing=False, spindle_at_speed=True)


def coolant():
    mdi("M8")
    pins(coolant_pump=True, lamp_coolant=True)
    mdi("M7")
    pins(air_blow=True)
    mdi("M9")
    pins(coolant_pump=False, lamp_coolant=False)


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


def overrides():
    put("feed-switch", 8)
    wait("feed override 150 %", lambda: abs(polled().feedrate - 1.5) < 1e-6)
    put("feed-switch", 15)
    wait("feed override 100 %", lambda: abs(polled().feedrate - 1.0) < 1e-6)
    press("25")
    wait("rapid override 25 %", lambda: abs(polled().rapidrate - 0.25) < 1e-6)
    press("100")
    wait("rapid override 100 %", lambda: abs(polled().rapidrate - 1.0) < 1e-6)


def part():
    """A part program, started at the panel, held, continued."""
    put("feed-switch", 3)  # 20 %
    mode("mem", linuxcnc.MODE_AUTO)
    command.program_open(os.path.abspath("part.ngc"))
    command.wait_complete(patience())
    press("start", until=lambda: polled().interp_state != linuxcnc.INTERP_IDLE)
    wait("the cut", lambda: pin("spindle-cw") and pin("coolant-pump") and position(0) > 22)
    press("hold", until=lambda: pin("paused"))
    here = at_rest(lambda: position(0))
    scans(25)
    check(abs(position(0) - here) < 0.01, "it moves while it is held")
    check(here < 59, "the cut was over before it was held")
    put("feed-switch", 15)
    press("start", until=lambda: not pin("paused"))
    wait("the end", lambda: polled().interp_state == linuxcnc.INTERP_IDLE and pin("tool") == 1)
    pins(spindle_cw=False, coolant_pump=False)
    check(status.tool_in_spindle == 1, f"tool {status.tool_in_spindle} in the spindle")


def single():
    """Single block: one block for each press of cycle start."""
    with open("single.ngc", "w", encoding="ascii") as file:
        file.write("G21 G90\nG0 X1\nG0 X2\nG0 X3\nM2\n")
    press("single")
    pins(lamp_single=True)
    command.program_open(os.path.abspath("single.ngc"))
    command.wait_complete(patience())
    seen = [round(position(0))]
    while seen[-1] != 3 and len(seen) < 12:
        before = progress()
        press("start", until=lambda: progress() != before)
        # "In position" was seen while the joint was still short of it.
        wait("the end of the block", lambda: polled().inpos and abs(at_rest(lambda: position(0)) - round(position(0))) < 0.0005)
        seen.append(round(position(0)))
    check(seen == sorted(seen) and set(seen) == {0, 1, 2, 3}, f"single blocks: {seen}")
    press("single")
    pins(lamp_single=False)
    press("start")
    wait("the end", lambda: polled().interp_state == linuxcnc.INTERP_IDLE)


def alarm():
    """A motor protection switch trips: feed hold, the operator reads why, reset."""
    put("motors-ok", 0)
    operator("EX1006 A MOTOR PROTECTION SWITCH")
    pins(no_block_lock=False, beacon_red=True)
    put("motors-ok", 1)
    signal("reset-key", 1)
    scans(38)  # so that LinuxCNC, which it aborts as well, has seen it
    pins(no_block_lock=True, beacon_red=False)
    wait("LinuxCNC has given up", lambda: polled().interp_state == linuxcnc.INTERP_IDLE)
    signal("reset-key", 0)


def probe():
    mode("mdi", linuxcnc.MODE_MDI)
    mdi("G0 Z0")
    command.mdi("G38.2 Z-20 F300")
    wait("motion", lambda: position(2) < -0.5)
    signal("probe", 1)
    check(command.wait_complete(patience()) == linuxcnc.RCS_DONE, "G38.2")
    signal("probe", 0)
    check(polled().probe_tripped and -20 < position(2) < 0, f"probed at {status.probed_position[2]}")
    mdi("G53 G0 Z0")


def remote():
    """During a cut: an input and a coil forced, edited sources loaded, and back."""
    mdi("M8")
    pins(coolant_pump=True)
    command.mdi("G1 X30 F10")
    change_in_motion([("CLT_LEVEL", "false", "coolant_pump", False, True),
                      ("CLT_PUMP", "false", "coolant_pump", False, True)], "edited")
    check("is protected by the mapping file" in rungctl("set", "EMG_PB", "false", refused=True), "the emergency stop was set")
    pins(coolant_pump=True, enable=True)
    end_motion()
    check(rungctl("rollback").endswith("the former program runs\n"), "rollback")
    mdi("M9")


def emergency_stop():
    """In the middle of a cut; then the machine is switched on and works again."""
    mdi("M3 S1000")
    command.mdi("G1 X40 F60")
    wait("the cut", lambda: pin("up-to-speed") and not polled().inpos)
    signal("estop-button", 1)
    pins(enable=False, spindle_cw=False)
    wait("e-stop", lambda: polled().task_state == linuxcnc.STATE_ESTOP)
    signal("estop-button", 0)
    scans(25)
    switch_on()
    mode("mdi", linuxcnc.MODE_MDI)
    mdi("M3 S500")
    pins(spindle_cw=True)
    mdi("M5")


STEPS = (switch_on, homing, modes, jog, wheel, spindle, coolant, tools, parts, overrides, part, single, alarm, probe, remote, interrupted,
         emergency_stop)


def tried(step):
    """What went wrong; the steps after it show more."""
    begin = time.monotonic()
    try:
        step()
        failure = ""
    except Exception:
        failure = f"{step.__name__}: {traceback.format_exc(limit=-3)}"
    print(f"driver: {step.__name__} {'failed' if failure else 'ok'}, {time.monotonic() - begin:.1f} s", flush=True)
    return failure


def main():
    component = hal.component("driver")  # get_value needs one
    component.ready()
    failures = [failure for step in STEPS if (failure := tried(step))]
    if pin("fault") or pin("functions-lost") != 0:
        failures.append("a fault, or functions were lost")
    check(not failures, "\n".join(failures))


run(main)
