"""Runs inside LinuxCNC in place of its display: what the drivers of the soak tests share, beside drive.py of tests/cnc."""
import hal
import linuxcnc

import drive
from drive import command, is_state, polled, set_mode, state, wait


def switch_on():
    command.state(linuxcnc.STATE_ESTOP_RESET)
    wait("e-stop is reset", lambda: hal.get_value("iocontrol.0.emc-enable-in")
         and polled().task_state == linuxcnc.STATE_ESTOP_RESET)
    command.state(linuxcnc.STATE_ON)
    is_state(linuxcnc.STATE_ON)
    if state("homed")[:3] != (1, 1, 1):
        set_mode(linuxcnc.MODE_MANUAL)
        command.home(-1)
        wait("homed", lambda: state("homed")[:3] == (1, 1, 1))


def run(main):
    """What `main` raises is the result of the session."""
    component = hal.component("driver")  # get_value needs one
    component.ready()
    drive.run(main)
