"""What the drivers of the machining centres with a PMC do alike inside LinuxCNC: work at the panel and look at the machine."""
import os
import subprocess
import time
import traceback
from dataclasses import dataclass

import hal
import linuxcnc

from drive import again_until, at_rest, change_in_motion, check, command, done, end_motion, operator, scans, pin, pins, polled, program_time, progress, rungctl, status, wait
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


def jogged(key):
    """How far X goes while the key is held for some 0.6 s, in mm for each second of the program that it is."""
    begin, stood = program_time(), position(0)
    press(key, count=75)
    held = program_time() - begin
    return abs(at_rest(lambda: position(0)) - stood) / held


def coolant():
    mdi("M8")
    pins(coolant_pump=True, lamp_coolant=True)
    mdi("M7")
    pins(air_blow=True)
    mdi("M9")
    pins(coolant_pump=False, lamp_coolant=False)


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


def work(steps):
    component = hal.component("driver")  # get_value needs one
    component.ready()
    failures = [failure for step in steps if (failure := tried(step))]
    if pin("fault") or pin("functions-lost") != 0:
        failures.append("a fault, or functions were lost")
    check(not failures, "\n".join(failures))


@dataclass(frozen=True)
class Machine:
    """With what programs, panels and machines call differently; its methods are what is tried with both."""
    jog_key: str  # of modes
    memory_key: str
    feed_full: int  # positions of the feed switch: 100 %, 50 %, 20 %, 150 %
    feed_half: int
    feed_fifth: int
    feed_most: int
    spindle_switch: str  # of its pin: which value is 100 %, which 120 %
    spindle_full: int
    spindle_more: int
    speed: str  # in the program: S, coolant, emergency stop
    coolant_level: str
    coolant_pump: str
    estop: str
    motor_alarm: str  # its text
    with_part: dict  # pins during the part program, besides those of all

    def jog(self):
        """At two positions of the feed switch."""
        mode(self.jog_key, linuxcnc.MODE_MANUAL)
        pins(mode_is_jog=True)
        speed = jogged("px")
        check(13 < speed < 22, f"jog with {speed} mm/s instead of 20")
        put("feed-switch", self.feed_half)
        speed = jogged("nx")
        check(6 < speed < 11, f"jog with {speed} mm/s instead of half of that")
        put("feed-switch", self.feed_full)

    def spindle(self):
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
        put(self.spindle_switch, self.spindle_more)
        wait("spindle override 120 %", lambda: abs(polled().spindle[0]["override"] - 1.2) < 1e-6)
        put(self.spindle_switch, self.spindle_full)
        wait("spindle override 100 %", lambda: abs(polled().spindle[0]["override"] - 1.0) < 1e-6)
        self.gears()
        mdi("M5")
        pins(spindle_cw=False, spindle_ccw=False, up_to_speed=False, spindle_stands=True)
        mdi("M19 R0")
        pins(orient=True, spindle_in_place=True)
        mdi("M5")

    def gears(self):
        """S goes to the program, which shifts the gear that the control has chosen; the cut waits for it."""
        pins(low_gear_valve=True, high_gear_valve=False)
        mdi("S2501")
        pins(gear_swing=True, up_to_speed=False)
        speed = int(rungctl("get", self.speed).split()[-1])
        check(speed == 2501, f"S{speed}")
        mdi("G1 X4 F6000")
        check(pin("high-gear-valve") and not pin("low-gear-valve") and not pin("gear-swing"), "the cut did not wait for the gear")
        check(hal.get_value("spindle.0.speed-in") > 41, "feed without the speed of the other gear")
        mdi("S1000")
        mdi("G1 X5 F6000")
        pins(low_gear_valve=True, high_gear_valve=False, gear_swing=False, spindle_at_speed=True)

    def overrides(self):
        put("feed-switch", self.feed_most)
        wait("feed override 150 %", lambda: abs(polled().feedrate - 1.5) < 1e-6)
        put("feed-switch", self.feed_full)
        wait("feed override 100 %", lambda: abs(polled().feedrate - 1.0) < 1e-6)
        press("25")
        wait("rapid override 25 %", lambda: abs(polled().rapidrate - 0.25) < 1e-6)
        press("100")
        wait("rapid override 100 %", lambda: abs(polled().rapidrate - 1.0) < 1e-6)

    def part(self):
        """A part program, started at the panel, held, continued."""
        put("feed-switch", self.feed_fifth)
        mode(self.memory_key, linuxcnc.MODE_AUTO)
        command.program_open(os.path.abspath("part.ngc"))
        command.wait_complete(patience())
        press("start", until=lambda: polled().interp_state != linuxcnc.INTERP_IDLE)
        wait("the cut", lambda: pin("spindle-cw") and pin("coolant-pump") and position(0) > 22)
        press("hold", until=lambda: pin("paused"))
        here = at_rest(lambda: position(0))
        scans(25)
        check(abs(position(0) - here) < 0.01, "it moves while it is held")
        check(here < 59, "the cut was over before it was held")
        pins(**self.with_part)
        put("feed-switch", self.feed_full)
        press("start", until=lambda: not pin("paused"))
        wait("the end", lambda: polled().interp_state == linuxcnc.INTERP_IDLE and pin("tool") == 1)
        pins(spindle_cw=False, coolant_pump=False, **{name: not value for name, value in self.with_part.items()})
        check(status.tool_in_spindle == 1, f"tool {status.tool_in_spindle} in the spindle")

    def alarm(self):
        """A motor protection switch trips: feed hold, the operator reads why, reset."""
        put("motors-ok", 0)
        operator(self.motor_alarm)
        pins(no_block_lock=False, beacon_red=True)
        put("motors-ok", 1)
        signal("reset-key", 1)
        scans(38)  # so that LinuxCNC, which it aborts as well, has seen it
        pins(no_block_lock=True, beacon_red=False)
        wait("LinuxCNC has given up", lambda: polled().interp_state == linuxcnc.INTERP_IDLE)
        signal("reset-key", 0)

    def remote(self):
        """During a cut: an input and a coil forced, edited sources loaded, and back."""
        mdi("M8")
        pins(coolant_pump=True)
        command.mdi("G1 X30 F10")
        change_in_motion([(self.coolant_level, "false", "coolant_pump", False, True),
                          (self.coolant_pump, "false", "coolant_pump", False, True)], "edited")
        check("is protected by the mapping file" in rungctl("set", self.estop, "false", refused=True), "the emergency stop was set")
        pins(coolant_pump=True, enable=True)
        end_motion()
        check(rungctl("rollback").endswith("the former program runs\n"), "rollback")
        mdi("M9")
