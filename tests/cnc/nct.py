#!/usr/bin/python3
"""Works at the turning centre inside LinuxCNC, in place of its display: at the panel, with part programs, by rungctl."""
import math
import time

import hal
import linuxcnc

import drive
from drive import again_until, at_rest, change_in_motion, check, command, done, end_motion, errors, idle, is_state, mdi, operator, scans, pin, pins, progress, rungctl, set_mode, state, wait
from panel import abort_cut_short, connect, panel, press, put, stopped_homing
from patience import patience

# What the simulated machine and the panel have as signals: driven by pins of this component.
SIGNALS = {"estop-chain": (hal.HAL_BIT, True), "door": (hal.HAL_BIT, True), "key-on": (hal.HAL_BIT, False),
           "key-reset": (hal.HAL_BIT, False), "wheel-counts": (hal.HAL_S32, 0)}


def mode(name):
    """LinuxCNC refuses a mode while something moves: an operator presses the key again."""
    press("key-" + name, lambda: pin("lamp-" + name))


def forget_errors():
    while errors.poll():
        pass


def position(axis):
    return state("actual_position")[{"x": 0, "z": 2}[axis]]


def near(value, wanted, within=0.05):
    return math.isclose(value, wanted, abs_tol=within)


def at(axis, wanted):
    wait(f"{axis} at {wanted}", lambda: near(position(axis), wanted))


def load(text):
    with open("test.ngc", "w", encoding="ascii") as file:
        file.write("G21 G18 G90 G8 G40\n" + text)
    mode("auto")
    command.program_open("test.ngc")
    done("program open")


def power():
    """The chain, LinuxCNC's own emergency stop, the key of the panel."""
    pins(safe=False, lamp_on=False)
    command.state(linuxcnc.STATE_ESTOP_RESET)
    pins(safe=True)
    is_state(linuxcnc.STATE_ESTOP_RESET)
    press("key-on")
    pins(machine_request=True, machine_on=True, lamp_on=True, hydraulics=True, hydraulic_pressure=True)
    is_state(linuxcnc.STATE_ON)
    press("key-off")
    pins(machine_request=False, machine_on=False, hydraulic_pressure=False)
    wait("off", lambda: state("task_state") != linuxcnc.STATE_ON)
    command.state(linuxcnc.STATE_ON)  # F2 of the user interface
    pins(machine_request=True, hydraulic_pressure=True, hold=False)
    is_state(linuxcnc.STATE_ON)


def reference():
    """The mode of the panel and its jog keys take the axes to their reference points; an open door stops them."""
    mode("reference")
    stopped_homing(0, "x-home", lambda: press("key-x-plus"))
    pins(hold=False)
    mode("reference")
    press("key-x-plus")
    wait("x is homed", lambda: state("homed")[0] == 1)
    press("key-z-minus")
    wait("all are homed", lambda: state("homed")[:3] == (1, 1, 1))
    pins(x_referenced=True, z_referenced=True, bar_referenced=True)


def by_hand():
    """Keys, steps and the hand wheel; an open door stops them, and LinuxCNC's own."""
    mode("jog")
    put("key-x-minus", True)
    wait("x jogs", lambda: position("x") < -0.2)
    put("key-x-minus", False)
    scans(10)
    stood = at_rest(lambda: position("x"))
    scans(10)
    check(near(position("x"), stood, 0.001), "x did not stop")
    mode("step")
    press("key-step-1000")
    press("key-z-minus")
    at("z", -1)
    press("key-step-100")
    press("key-z-minus")
    at("z", -1.1)
    mode("wheel")
    press("key-z-plus")
    wait("the wheel moves z", lambda: pin("wheel-axis") == 2)
    panel["wheel-counts"] = -5
    at("z", -1.6)
    press("key-x-plus")
    wait("the wheel moves x", lambda: pin("wheel-axis") == 1)
    before = position("x")
    panel["wheel-counts"] = -3
    at("x", before + 0.2)
    put("door", False)
    pins(hold=True, wheel_axis=0)
    panel["wheel-counts"] = 7
    scans(10)
    check(near(position("x"), before + 0.2), "x moved with an open door")
    panel["wheel-counts"] = -3
    put("door", True)
    pins(hold=False)


def functions():
    """The machine's own M functions, T, S, M3, M4, M5, M19, coolant."""
    mode("mdi")
    mdi("M251")
    pins(chuck_1_pressure=True, chuck_1_is_out=False)
    mdi("T3 M6")
    pins(tool=3, turret_1_clamped=True)
    wait("LinuxCNC knows the tool", lambda: state("tool_in_spindle") == 3)
    mdi("o<turret_2> call [12]")
    pins(tool_2=12, turret_2_clamped=True)
    mdi("S800 M3")
    mdi("G1 X-5 F3000")
    pins(spindle_start=True, spindle_at_speed=True, spindle_command=800, door_locked=True)
    check(near(hal.get_value("spindle.0.speed-in") * 60, 800, 21), "the feed did not wait for the spindle")
    mdi("S1800")  # the other gear
    mdi("G1 X-6 F3000")
    pins(spindle_command=1800, gear_is_high=True, spindle_at_speed=True)
    mdi("M4")
    mdi("G0 X-5")
    pins(spindle_negative=True)
    mdi("G96 D2000 S20")  # constant surface speed: the radius decides
    wait("20 m/min", lambda: near(pin("spindle-command"), 636.6, 1))
    mdi("G97 S500 M5")
    pins(spindle_stopped=True, spindle_start=False)
    mdi("M19 R0")
    pins(spindle_oriented=True)
    mdi("M8")
    pins(coolant_pump=True, coolant_on=True, coolant_1=True)
    mdi("M9")
    pins(coolant_pump=False)
    mdi("M21")
    pins(quill_pressure=True)
    mdi("M22")
    pins(quill_is_back=True)


def part():
    """A part program from the panel: start, a message, stop, single block, feed switch, optional stop."""
    load("M3 S600\nM8\nG1 X-30 F300\nG0 X-5\nM9\nM1\nM5\nM30\n")
    press("key-start", lambda: pin("started"))
    pins(started=True, lamp_start=True)
    wait("x cuts", lambda: position("x") < -7)
    pins(coolant_1=True, cutting=True, cutting_enabled=True, in_position=False)
    forget_errors()
    put("filter-ok", False)
    operator("Filter of the high-pressure coolant is clogged")
    put("filter-ok", True)
    press("key-stop", lambda: pin("stopped"))
    stood = at_rest(lambda: position("x"))
    press("key-start", lambda: not pin("stopped"))
    wait("x continues", lambda: position("x") < stood - 1)
    put("feed-switch", 0)
    wait("feed 0", lambda: state("feedrate") == 0)
    stood = at_rest(lambda: position("x"))
    check(stood > -29, "the cut was over before the feed was 0")
    put("feed-switch", 15)
    wait("feed 140 %", lambda: near(state("feedrate"), 1.4, 0.001))
    put("feed-switch", 12)
    wait("feed 100 %", lambda: near(state("feedrate"), 1, 0.001))
    idle()
    pins(coolant_1=False, spindle_start=False, started=False)
    load("G0 X-3\nM1\nG0 X-5\nG0 X-7\nM2\n")
    press("key-single")
    press("key-stop-1")
    pins(lamp_single=True)
    wait("optional stop", lambda: state("optional_stop"))
    for _ in range(8):
        before = progress()
        press("key-start", lambda: progress() != before)
        if near(at_rest(lambda: position("x")), -3) or state("interp_state") == linuxcnc.INTERP_IDLE:
            break
    check(near(position("x"), -3), f"single block did not stop at -3 but at {position('x')}")
    press("key-single")
    press("key-stop-1")
    pins(lamp_single=False)
    wait("no optional stop", lambda: not state("optional_stop"))
    press("key-start", lambda: position("x") < -4)
    idle()
    at("x", -7)


def counted():
    """M30 counts a workpiece; the log of the program says so, the operator is not told."""
    forget_errors()
    before = int(rungctl("get", "TOTAL").split()[-1])
    mdi("M230")
    check(rungctl("get", "TOTAL") == f"TOTAL = {before + 1}\n", "the workpiece was not counted")
    wait("the log", lambda: f"Workpieces: {before + 1}" in rungctl("messages"))
    scans(25)  # in which rung-operator may say something
    told = errors.poll()
    check(told is None, f"the operator was told {told}")


def bar_feeder():
    """M75: the program reads #505, opens the chuck, pushes the bar by an axis of its own, clamps and draws back."""
    mdi("#505 = 40")
    before = pushed()
    mdi("M75")
    wait("the bar pusher", lambda: near(pushed(), before + 35))
    pins(chuck_1_is_out=False, bar_done=True)
    mdi("M76")
    wait("the bar pusher at home", lambda: near(pushed(), 0))


def pushed():
    return hal.get_value("joint.2.motor-pos-cmd")


def send_home():
    """The abort that belongs to a RESET may come late, and end this, too."""
    command.mdi("M76")
    command.wait_complete(patience())


def bar_lost():
    """What was lost while the bar was pushed is not done, then and later; RESET gives the block up."""
    mdi("#505 = 200")
    command.mdi("M75")
    begin = pushed()
    wait("the bar pusher", lambda: pushed() > begin + 5)
    drive.services_hang(pushed, lambda: check(not pin("bar-done"), "a lost order is said to be done"))
    check(not pin("bar-done") and rungctl("get", "BF_STEP") == "BF_STEP = 4\n", "a lost order is said to be done later")
    press("key-reset", lambda: pin("bar-done"))
    idle()
    set_mode(linuxcnc.MODE_MDI)
    again_until("the bar pusher at home", send_home, lambda: near(pushed(), 0))
    mdi("M251")  # the chuck, which let go of the bar


def variables():
    """The program writes #501 when LinuxCNC is at rest, and asks where an axis is at once."""
    total = int(rungctl("get", "PARTS").split()[-1])
    mdi("M68 E1 Q[#501]")
    wait(f"#501 = {total}", lambda: (mdi("M68 E1 Q[#501]"), near(hal.get_value("motion.analog-out-01"), total))[1])
    wait("where the probe touched", lambda: near(pin("macro-value-in-0"), -100, 1))


def signals():
    """M62 to M68 are the interface variables; the probe is seen by LinuxCNC and by the program."""
    mdi("M64 P1")
    pins(macro_out_1=True)
    mdi("M65 P1")
    pins(macro_out_1=False)
    mdi("M68 E0 Q2.5")
    check(rungctl("get", "CN_1101") == "CN_1101 = false\n", "CN_1101")
    mdi("M64 P0")  # clears the probe
    mdi("M65 P0")
    pins(macro_in_0=False)
    mdi("M19 R0")
    mdi("G0 Z-95")
    mdi("G38.2 Z-120 F600")
    wait("the probe's position", lambda: near(state("probed_position")[2], -100, 0.2))
    mdi("M66 P0 L3 Q2")
    wait("M66", lambda: state("din")[0] == 1)
    mdi("G0 Z-90")


def remote():
    """While it cuts: an input and a coil forced, edited sources loaded, and back."""
    mdi("M3 S600")
    mdi("M8")
    before = position("x")
    command.mdi("G1 X-40 F10")
    wait("x cuts", lambda: position("x") < before - 0.1)
    rungctl("set", "CONV_W", "true")
    pins(conveyor=True)
    rungctl("set", "CONV_W", "false")
    pins(conveyor=False)
    change_in_motion([("B_CONV", "true", "conveyor", True, False), ("COOL_PUMP", "false", "coolant_pump", False, True)], "edited")
    check("is protected by the mapping file" in rungctl("set", "ESTOP_OK", "false", refused=True), "the emergency stop was set")
    pins(coolant_pump=True, spindle_at_speed=True)
    end_motion()
    check(rungctl("rollback").endswith("the former program runs\n"), "rollback")
    mdi("M9")
    mdi("M5")


def alarm():
    """A start that the program refuses: the operator reads why, nothing moves; RESET ends it."""
    mdi("M252")
    pins(chuck_1_is_out=True)
    forget_errors()
    command.mdi("M3 S500")
    command.mdi("G0 X-20")
    operator("Spindle start refused: chuck, door, readiness")
    before = position("x")
    scans(30)
    check(near(position("x"), before), "x moved in spite of the fault")
    press("key-reset")
    idle()
    pins(hold=False, functions_busy=False, finished=True)
    mdi("M251")


def emergency_stop():
    """The chain opens in mid-cut; then all works again."""
    mdi("M3 S600")
    before = position("x")
    command.mdi("G1 X-80 F500")
    wait("x cuts", lambda: position("x") < before - 2)
    put("estop-chain", False)
    is_state(linuxcnc.STATE_ESTOP)
    pins(spindle_start=False, machine_request=False, hydraulics=False, k1_off=True)
    put("estop-chain", True)
    press("key-reset")
    is_state(linuxcnc.STATE_ESTOP_RESET)
    press("key-on")
    is_state(linuxcnc.STATE_ON)
    pins(hydraulic_pressure=True, hold=False)
    check(state("homed")[:3] == (1, 1, 1), "not homed any more")
    mode("mdi")
    mdi("M251")  # the chuck has its pressure again
    mdi("M3 S600")
    mdi("G1 X-20 F6000")
    mdi("M5")


STEPS = (power, reference, by_hand, functions, bar_feeder, bar_lost, abort_cut_short, part, counted, signals, variables, remote, alarm, emergency_stop)


def session():
    connect(SIGNALS)
    for step in STEPS:
        if step in (counted, signals, variables, remote, alarm, emergency_stop):
            set_mode(linuxcnc.MODE_MDI)
        begin = time.monotonic()
        step()
        print(f"driver: {step.__name__} ok, {time.monotonic() - begin:.1f} s", flush=True)
    check(not pin("fault") and pin("functions-lost") == 0, "a fault, or functions were lost")


if __name__ == "__main__":
    drive.run(session)
