"""What the drivers of the example machines share: signals of the machine and the panel, driven by pins of a component of their own."""
import functools

import hal
import linuxcnc

from drive import again_until, at_rest, check, command, pin, pins, program_state, scans, set_mode, wait

PRESS_US = 80_000  # of the program's time, in which a key is down: LinuxCNC is to see it, too
SCANS = 4  # of the program in which it is, at least

panel = hal.component("panel")
driven = set()


def connect(signals):
    """`signals`: their names, each with its type and its first value."""
    for name, (kind, value) in signals.items():
        panel.newpin(name, kind, hal.HAL_OUT)
        panel[name] = value
    panel.ready()
    for name in signals:
        hal.connect("panel." + name, name)
    driven.update(signals)


def stopped_homing(joint, switch, begin):
    """Begins the homing of a joint whose switch is far away, and opens the door."""
    was = hal.get_value(f"{switch}.home-pos")
    hal.set_p(f"{switch}.home-pos", "200")
    begin()
    wait("the homing", lambda: hal.get_value(f"joint.{joint}.homing"))
    put("door", False)
    wait("the end of the homing", lambda: not hal.get_value(f"joint.{joint}.homing"))
    stood = at_rest(lambda: hal.get_value(f"joint.{joint}.pos-fb"))
    check(stood < 150 and not hal.get_value(f"joint.{joint}.homed"), "an open door has not stopped a homing")
    hal.set_p(f"{switch}.home-pos", str(was))
    put("door", True)


def abort_cut_short():
    """The mode changes while LinuxCNC does what belongs to an abort: the RESET that this gave ends."""
    for mode in (linuxcnc.MODE_MANUAL, linuxcnc.MODE_MDI):
        command.abort()
        set_mode(mode)
        scans(5)
        pins(key_reset=False)


def put(name, value):
    """A signal of the machine, or an input of the program that nothing drives."""
    if name in driven:
        panel[name] = value
    else:
        hal.set_p("rung." + name, str(int(value)))


@functools.cache
def period_us():
    """From one scan of the program to the next."""
    state = program_state()
    return state["us"] // state["scans"]


def press(key, until=None):
    """Holds the key until the program has seen it; again until this comes of it."""
    if until:
        return again_until(f"what {key} is pressed for", lambda: press(key), until)
    begin = pin("scans")
    put(key, True)
    scans(max(SCANS, PRESS_US // period_us()), begin)
    put(key, False)
    scans(1)
