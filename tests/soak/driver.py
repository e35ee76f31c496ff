"""Runs inside LinuxCNC in place of its display: what the drivers of the soak tests share."""
import sys
import time
import traceback

import hal
import linuxcnc

PATIENCE = 10.0  # seconds until something counts as never happening

command = linuxcnc.command()
status = linuxcnc.stat()
errors = linuxcnc.error_channel()


def pin(name):
    return hal.get_value("rung." + name)


def check(condition, what):
    if not condition:
        raise AssertionError(f"{what}; LinuxCNC says {errors.poll()}")


def wait(what, condition, patience=PATIENCE):
    end = time.monotonic() + patience
    while not condition():
        check(time.monotonic() < end, f"never came: {what}")
        time.sleep(0.001)


def polled():
    status.poll()
    return status


def done(what):
    check(command.wait_complete(PATIENCE) == linuxcnc.RCS_DONE, f"{what} was not done")


def mdi(line):
    command.mdi(line)
    done(line)


def set_mode(mode):
    command.mode(mode)
    done("mode")


def switch_on():
    command.state(linuxcnc.STATE_ESTOP_RESET)
    wait("e-stop is reset", lambda: hal.get_value("iocontrol.0.emc-enable-in")
         and polled().task_state == linuxcnc.STATE_ESTOP_RESET)
    command.state(linuxcnc.STATE_ON)
    wait("the machine is on", lambda: polled().task_state == linuxcnc.STATE_ON)
    if polled().homed[:3] != (1, 1, 1):
        set_mode(linuxcnc.MODE_MANUAL)
        command.home(-1)
        wait("homed", lambda: polled().homed[:3] == (1, 1, 1))


def run(main):
    """What `main` raises is the result of the session."""
    component = hal.component("driver")  # get_value needs one
    component.ready()
    try:
        main()
        result = "passed"
    except BaseException:  # pylint: disable=broad-exception-caught
        result = traceback.format_exc()
    with open("result.txt", "w", encoding="utf-8") as out:
        out.write(result)
    sys.exit(0 if result == "passed" else 1)
