#!/usr/bin/python3
"""Runs inside LinuxCNC in place of its display: the PLC program's positioning unit moves an extra joint."""
import time

import hal
import linuxcnc

import drive
from drive import at_rest, check, command, done, scans, pin, pins, state, wait

HOME = 7       # of joint 3 in the INI file, mm
FEED = 6000    # mm/min: 100 mm/s
SLOW = 600     # for what is done in a motion
UNITS = 65536  # of a feed, in a mm/min (l.12258)


def put(**values):
    for name, value in values.items():
        hal.set_p("rung." + name, str(int(value)))


def place():
    return hal.get_value("joint.3.posthome-cmd")


def near(value, wanted, within=1e-6):
    return abs(value - wanted) < within


def watch():
    """From now on the extremes of what the drive is told are kept."""
    for name in ("places", "speeds", "accelerations"):
        hal.set_p(f"{name}.reset", "1")
    scans(5)
    for name in ("places", "speeds", "accelerations"):
        hal.set_p(f"{name}.reset", "0")


def extremes(name):
    return hal.get_value(f"{name}.min"), hal.get_value(f"{name}.max")


def go(length, feed=FEED):
    put(length=length, feed=feed * UNITS, allow=True)
    put(go=True)


def ends(**expected):
    pins(**expected)
    put(go=False)
    pins(arrived=False, failed=False)


def not_homed():
    """The axis is LinuxCNC's: the command is where it is, and POS_INIT is refused."""
    go(10000)
    ends(failed=True, arrived=False)
    check(near(place(), 0), f"the command is {place()}")


def homing():
    """The joint gets its reference at another place than 0, and its motor does not move for that."""
    watch()
    command.home(-1)
    wait("homed", lambda: state("homed")[:4] == (1, 1, 1, 1))
    pins(**{"table.homed": True})
    scans(10)
    check(near(place(), HOME), f"the command is {place()}")
    least, most = extremes("places")
    check(near(least, most), f"the motor moved from {least} to {most}")


def distances():
    """By the trapezoid of the unit, within the feed and the acceleration of the program."""
    watch()
    go(60000)
    ends(arrived=True, failed=False)
    check(near(place(), HOME + 60), f"it is at {place()}")
    go(-80000)
    ends(arrived=True, failed=False)
    check(near(place(), HOME - 20), f"it is at {place()}")
    for name, most in (("speeds", 100), ("accelerations", 500)):
        found = extremes(name)
        check(near(found[0], -most, 0.1) and near(found[1], most, 0.1), f"{name} of {found}")


def held():
    """Without its permission it brakes, and continues with it."""
    go(50000, SLOW)
    pins(wanted=True)
    wait("motion", lambda: place() > HOME - 19)
    put(allow=False)
    here = at_rest(place)
    scans(10)
    check(place() == here and here < HOME + 30, f"it is not held at {here}, but at {place()}")
    put(allow=True, feed=FEED * UNITS)
    ends(arrived=True, failed=False)
    check(near(place(), HOME + 30), f"it is at {place()}")


def switched_off():
    """The machine goes off in a motion: ERR, and no jump when it is on again."""
    go(-60000, SLOW)
    wait("motion", lambda: place() < HOME + 28)
    command.state(linuxcnc.STATE_OFF)
    done("machine off")
    ends(failed=True, arrived=False)
    here = place()
    command.state(linuxcnc.STATE_ON)
    done("machine on")
    pins(**{"table.enabled": True})
    scans(10)
    check(near(place(), here), f"it jumped from {here} to {place()}")
    go(5000)
    ends(arrived=True, failed=False)
    check(near(place(), here + 5), f"it is at {place()}")


def faulted():
    """A fault of its drive, by which LinuxCNC switches the machine off."""
    go(-60000, SLOW)
    pins(wanted=True)
    hal.set_p("joint.3.amp-fault-in", "1")
    ends(failed=True, arrived=False)
    hal.set_p("joint.3.amp-fault-in", "0")


def session():
    component = hal.component("driver")  # get_value needs one
    component.ready()
    command.state(linuxcnc.STATE_ESTOP_RESET)
    done("e-stop reset")
    pins(enable=True)
    drive.is_state(linuxcnc.STATE_ESTOP_RESET)
    command.state(linuxcnc.STATE_ON)
    done("machine on")
    command.mode(linuxcnc.MODE_MANUAL)
    done("manual mode")
    pins(**{"table.enabled": True, "table.homed": False})
    for step in (not_homed, homing, distances, held, switched_off, faulted):
        begin = time.monotonic()
        step()
        print(f"driver: {step.__name__} ok, {time.monotonic() - begin:.1f} s", flush=True)
    check(not pin("fault"), "a fault")


if __name__ == "__main__":
    drive.run(session)
