#!/usr/bin/python3
"""Works at the machining centre inside LinuxCNC, in place of its display: at the panel, with part programs, by rungctl."""
import time

import hal
import linuxcnc

import drive
from drive import (again_until, at_rest, change_in_motion, check, command, done, end_motion, errors, idle, is_state, mdi, operator, scans, pin, pins,
                   program_time, progress, rungctl, state, wait)
from panel import abort_cut_short, connect, press, put, stopped_homing

# What the simulated machine and the panel have as signals: driven by pins of this component.
SIGNALS = {"estop-chain": (hal.HAL_BIT, True), "door": (hal.HAL_BIT, True), "key-reset": (hal.HAL_BIT, False),
           "panel-start": (hal.HAL_BIT, False), "panel-single-block": (hal.HAL_BIT, False),
           "panel-auto": (hal.HAL_BIT, False), "panel-mdi": (hal.HAL_BIT, False), "panel-manual": (hal.HAL_BIT, False),
           "panel-home": (hal.HAL_BIT, False), "panel-x-minus": (hal.HAL_BIT, False), "wheel-x": (hal.HAL_BIT, False),
           "wheel-counts": (hal.HAL_S32, 0)}


def power():
    """The chain, LinuxCNC's own emergency stop, machine on; reference, which an open door stops."""
    pins(power=False)
    command.state(linuxcnc.STATE_ESTOP_RESET)
    is_state(linuxcnc.STATE_ESTOP_RESET)
    command.state(linuxcnc.STATE_ON)
    is_state(linuxcnc.STATE_ON)
    pins(main_contactor=True, hydraulics_on=True, drives_ready=True, power=True, hand_enabled=True)
    stopped_homing(2, "z-switch", lambda: press("panel-home"))
    pins(hand_enabled=True)
    press("panel-home")
    wait("all are homed", lambda: state("homed")[:4] == (1, 1, 1, 1))
    turned = hal.get_value("joint.3.motor-pos-fb")
    check(turned >= 1, f"the program has not driven the table to its switch at 1 degree, but to {turned}")
    check(abs(position("a")) < 0.05, f"the table's zero point is at {position('a')}")
    pins(program_directs=False, reference_asked=False, table_zero=False)
    pins(x_homed=True, y_homed=True, z_homed=True, table_homed=True, table_clamped=True, lamp_homed=True)


def position(axis):
    return state("actual_position")["xyza".index(axis)]


def at(axis, wanted):
    wait(f"{axis} at {wanted}", lambda: abs(position(axis) - wanted) < 0.05)


def stands():
    """X does, and the program knows it."""
    at_rest(lambda: position("x"))
    pins(x_moves=False)


def mode(key, wanted):
    press("panel-" + key, lambda: state("task_mode") == wanted)


def machine_m(code):
    """One of the machine's own functions, to its acknowledge."""
    mdi(f"M{code}")
    idle()


def by_hand():
    """A key of the panel and the hand wheel move X; the open door stops it."""
    mode("manual", linuxcnc.MODE_MANUAL)
    wait("axes are jogged, not joints", lambda: hal.get_value("halui.mode.is-teleop"))
    pins(by_hand=True, hand_enabled=True)
    put("panel-x-minus", True)
    wait("x jogs", lambda: position("x") < -1)
    pins(x_moves=True, x_jogs_minus=True)
    put("key-door", True)  # refused while an axis moves
    scans(5)
    put("key-door", False)
    check(not pin("door-free"), "the door opened beside a moving axis")
    put("panel-x-minus", False)
    stands()
    put("wheel-x", True)
    wait("the wheel moves x", lambda: hal.get_value("axis.x.jog-enable"))
    stood = position("x")
    put("wheel-counts", 100)
    at("x", stood + 1)
    put("wheel-x", False)
    stands()
    press("key-door")
    pins(door_free=True, hand_enabled=False, lamp_door=True)
    stood = position("x")
    put("panel-x-minus", True)
    scans(10)
    put("panel-x-minus", False)
    check(abs(position("x") - stood) < 0.01, "an axis moved with the door free")
    press("key-door")
    pins(door_free=False, door_locked=True, hand_enabled=True)
    while errors.poll():
        pass


def by_program():
    """The program itself asks for manual mode and moves X; the keys do nothing meanwhile."""
    mode("mdi", linuxcnc.MODE_MDI)
    for name in ("AUTMAN_REQ", "REQ_EXT_CONT_AUTMAN", "EXM_X0"):
        rungctl("set", name, "true")
    wait("manual mode", lambda: state("task_mode") == linuxcnc.MODE_MANUAL)
    stood = position("x")
    put("panel-x-minus", True)
    wait("x is moved", lambda: position("x") > stood + 1)
    rungctl("set", "EXM_X0", "false")
    stands()
    put("panel-x-minus", False)
    for name in ("REQ_EXT_CONT_AUTMAN", "AUTMAN_REQ"):
        rungctl("set", name, "false")
    mode("mdi", linuxcnc.MODE_MDI)
    again_until("manual mode again", lambda: rungctl("set", "AUTMAN_SELECT", "true"),
                lambda: state("task_mode") == linuxcnc.MODE_MANUAL)
    pins(manual_chosen=False)
    wait("LinuxCNC's key is up", lambda: not hal.get_value("ask-manual.out"))
    mode("mdi", linuxcnc.MODE_MDI)
    mdi("G0 X0")


def spindle():
    """A direction contactor, the speed at the drive, feed that waits for it; the other way; orientation; gears."""
    mode("mdi", linuxcnc.MODE_MDI)
    mdi("M3 S1000")
    began = program_time()
    mdi("G1 X5 F6000")
    check(program_time() - began > 0.2, "the feed did not wait for the spindle")
    pins(spindle_cw=True, cw_in=True, spindle_reached=True)
    check(abs(pin("spindle-volt") - 2.5) < 0.01, f"{pin('spindle-volt')} V")
    mdi("M4 S2000")
    pins(spindle_cw=False, spindle_ccw=True, spindle_reached=True)
    command.spindleoverride(0.5)
    wait("half the speed", lambda: abs(pin("spindle-volt") - 2.5) < 0.01)
    command.spindleoverride(1.0)
    mdi("M5")
    pins(spindle_ccw=False, spindle_at_rest=True, functions_busy=False)
    machine_m(42)
    check(pin("gear-2-in"), "M42 was done before the gear")
    machine_m(41)
    check(pin("gear-1-in"), "M41 was done before the gear")
    mdi("M19 R0")
    wait("orientation", lambda: hal.get_value("spindle.0.is-oriented"))
    pins(orient=True, functions_busy=False)
    mdi("M5")
    mdi("G0 X0")


def coolant():
    mode("mdi", linuxcnc.MODE_MDI)
    mdi("M8")
    pins(coolant_2=True, coolant_1=False)
    mdi("M9")
    pins(coolant_2=False)
    mdi("M7")
    pins(coolant_1=True)
    mdi("M9")
    pins(coolant_1=False)
    machine_m(251)  # M51 of the machine
    pins(blast=True)
    machine_m(253)
    pins(blast=False)
    press("soft-conveyor")
    pins(conveyor_plus=True)
    machine_m(271)
    pins(conveyor_plus=False)


def tools():
    """T turns the magazine, M6 swings the arm where Z stands on its reference."""
    mdi("G0 Z-20")
    mdi("T2")
    mdi("M6")
    check(state("tool_in_spindle") == 2 and pin("tool") == 2, f"tool {state('tool_in_spindle')}, {pin('tool')}")
    at("z", 0)
    pins(tool_in_spindle=True, arm_home=True, arm_at_180=True, pocket_up=True, orient=False)


def probing():
    mode("mdi", linuxcnc.MODE_MDI)
    machine_m(84)
    pins(probe_power=True)
    mdi("G38.2 Z-100 F4800")
    check(abs(state("probed_position")[2] + 50) < 0.5, f"probed at {state('probed_position')[2]}")
    pins(touches=1, stop=True)  # the program stops with each touch
    press("panel-start")
    pins(stop=False)
    machine_m(85)
    mdi("G0 Z0")
    pins(probe_power=False)


def load(text):
    with open("test.ngc", "w", encoding="ascii") as file:
        file.write("G21 G17 G90 G94\n" + text)
    mode("auto", linuxcnc.MODE_AUTO)
    command.program_open("test.ngc")
    done("program open")


def part():
    """The example's part program, from the key START to the counted workpiece."""
    mode("auto", linuxcnc.MODE_AUTO)
    command.program_open("part.ngc")
    done("program open")
    before = pin("workpieces")
    press("panel-start")
    seen = set()

    def finished():
        seen.update(name for name in ("spindle-cw", "coolant-2", "lamp-green", "table-free", "block-runs") if pin(name))
        return pin("workpieces") == before + 1 and state("interp_state") == linuxcnc.INTERP_IDLE

    wait("a workpiece", finished)
    check(len(seen) == 5, f"during the part program only {seen} came on")
    pins(spindle_cw=False, coolant_2=False, work_free=True, tool=2)


def stops():
    """Feed hold and START by the panel, the open door, M64 and M66, the feed override, single blocks."""
    mdi_inputs = "M64 P0\nG4 P0.06\nM66 P0 L3 Q2\nM65 P0\n"
    load("M10\n" + mdi_inputs + "G1 X20 F240\nG0 X0\nM2\n")
    press("panel-start")
    wait("x moves", lambda: position("x") > 2)
    check(state("din")[0] == 1 and pin("light"), "M66 and M64")
    command.auto(linuxcnc.AUTO_PAUSE)
    pins(stop=True, x_enabled=False, x_moves=False, block_runs=True)
    stands()
    stood = position("x")
    press("key-door")
    pins(door_free=True)
    press("panel-start")  # START locks the door, then the feed goes on
    pins(door_free=False, door_locked=True, stop=False, x_enabled=True)
    command.feedrate(0.2)
    wait("x moves on", lambda: position("x") > stood + 0.2)
    wait("slowly", lambda: abs(state("current_vel") - 0.8) < 0.04)
    command.feedrate(1.5)
    wait("fast", lambda: abs(state("current_vel") - 6) < 0.08)
    command.feedrate(10)  # what remains of it takes its time only
    idle()
    command.feedrate(1.0)
    check(abs(position("x")) < 0.05, "the program did not end at 0")
    put("panel-single-block", True)
    load("G1 X5 F6000\nX10\nX0\nM2\n")
    for wanted in (5, 10, 0):
        wait("a step is taken", lambda: step_to(wanted))
    put("panel-single-block", False)
    press("panel-start")
    idle()


def step_to(wanted):
    before = progress()
    press("panel-start", lambda: progress() != before)
    return abs(at_rest(lambda: position("x")) - wanted) < 0.05


def alarm():
    """A tool that no pocket has: the block waits, the operator reads why; RESET gives it up."""
    while errors.poll():
        pass
    with open("tool.tbl", "a", encoding="ascii") as file:
        file.write("T77 P77 D8 Z0\n")
    command.load_tool_table()
    mode("mdi", linuxcnc.MODE_MDI)
    command.mdi("T77")
    operator("message PLC00040 0 77 0 0 Tool 77 is not in the magazine")
    check("Tool 77 is not in the magazine" in rungctl("messages"), "no text for rungctl")
    pins(buzzer=True, tool_prepared=False)
    press("key-reset")
    pins(buzzer=False, functions_busy=False)
    wait("LinuxCNC has given up", lambda: state("interp_state") == linuxcnc.INTERP_IDLE)
    mode("mdi", linuxcnc.MODE_MDI)
    # LinuxCNC's abort, which switches coolant off, comes by halui and may be later than the program's own end of T.
    wait("coolant after the reset", lambda: (mdi("M8"), pin("coolant-2"))[1])
    mdi("M9")


def remote():
    """While an axis cuts: an input and a coil forced, edited sources loaded, and back."""
    mdi("M8")
    pins(coolant_2=True)
    command.mdi("G1 X40 F20")
    lit = pin("light")
    change_in_motion([("K_LIGHT", "true", "light", not lit, not lit),  # a key that changes it
                      ("O_COOL2", "false", "coolant_2", False, True)], "edited")
    check("is protected by the mapping file" in rungctl("set", "P1IN.0", "false", refused=True), "the emergency chain was set")
    pins(coolant_2=True)
    end_motion()
    check(rungctl("rollback").endswith("the former program runs\n"), "rollback")
    mdi("M9")
    mdi("G0 X0")


def emergency_stop():
    """In the cut: everything stops, LinuxCNC too; then the machine is switched on and works again."""
    mdi("M3 S1000")
    command.mdi("G1 X40 F120")
    wait("x moves", lambda: position("x") > 2)
    put("estop-chain", False)
    pins(spindle_cw=False, main_contactor=False, power=False, lamp_red=True)
    is_state(linuxcnc.STATE_ESTOP)
    stood = position("x")
    check(stood < 35, "the axis went on")
    put("estop-chain", True)
    scans(10)
    check(not pin("main-contactor") and abs(position("x") - stood) < 0.01, "something started by itself")
    command.state(linuxcnc.STATE_ESTOP_RESET)
    is_state(linuxcnc.STATE_ESTOP_RESET)
    press("key-reset")
    command.state(linuxcnc.STATE_ON)
    is_state(linuxcnc.STATE_ON)
    pins(power=True, spindle_cw=False, hand_enabled=True)
    mode("mdi", linuxcnc.MODE_MDI)
    mdi("M3 S1000")
    mdi("G1 X0 F6000")
    pins(spindle_cw=True, fault=False)
    mdi("M5")
    pins(spindle_cw=False, functions_busy=False, functions_lost=0)


STEPS = [power, by_hand, by_program, spindle, coolant, tools, probing, abort_cut_short, part, stops, alarm, remote, emergency_stop]


def session():
    connect(SIGNALS)
    for step in STEPS:
        begin = time.monotonic()
        step()
        print(f"technol: {step.__name__} ok, {time.monotonic() - begin:.1f} s", flush=True)


drive.run(session)
