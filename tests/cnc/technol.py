#!/usr/bin/python3
"""Works at the machining centre inside LinuxCNC, in place of its display: at the panel, with part programs, by rungctl."""
import time

import hal
import linuxcnc

import drive
from drive import check, command, done, errors, mdi, pin, pins, rungctl, set_mode, status, wait

# What the simulated machine and the panel have as signals: driven by pins of this component.
SIGNALS = {"estop-chain": (hal.HAL_BIT, True), "door": (hal.HAL_BIT, True), "key-reset": (hal.HAL_BIT, False),
           "panel-start": (hal.HAL_BIT, False), "panel-single-block": (hal.HAL_BIT, False),
           "panel-auto": (hal.HAL_BIT, False), "panel-mdi": (hal.HAL_BIT, False), "panel-manual": (hal.HAL_BIT, False),
           "panel-home": (hal.HAL_BIT, False), "panel-x-minus": (hal.HAL_BIT, False), "wheel-x": (hal.HAL_BIT, False),
           "wheel-counts": (hal.HAL_S32, 0)}
panel = hal.component("panel")


def connect():
    for name, (kind, value) in SIGNALS.items():
        panel.newpin(name, kind, hal.HAL_OUT)
        panel[name] = value
    panel.ready()
    for name in SIGNALS:
        hal.connect("panel." + name, name)


def put(name, value):
    """A signal of the machine, or an input of the program that nothing drives."""
    if name in SIGNALS:
        panel[name] = value
    else:
        hal.set_p("rung." + name, str(int(value)))


def press(key, seconds=0.08):
    put(key, True)
    time.sleep(seconds)
    put(key, False)


def state(name):
    status.poll()
    return getattr(status, name)


def is_state(what):
    wait(f"task state {what}", lambda: state("task_state") == what)


def power():
    """The chain, LinuxCNC's own emergency stop, machine on; reference."""
    pins(power=False)
    command.state(linuxcnc.STATE_ESTOP_RESET)
    is_state(linuxcnc.STATE_ESTOP_RESET)
    command.state(linuxcnc.STATE_ON)
    is_state(linuxcnc.STATE_ON)
    pins(main_contactor=True, hydraulics_on=True, drives_ready=True, power=True, hand_enabled=True)
    press("panel-home")
    wait("all are homed", lambda: state("homed")[:4] == (1, 1, 1, 1))
    pins(x_homed=True, y_homed=True, z_homed=True, table_homed=True, table_clamped=True, lamp_homed=True)


STEPS = [power]


def session():
    connect()
    for step in STEPS:
        begin = time.monotonic()
        step()
        print(f"technol: {step.__name__} ok, {time.monotonic() - begin:.1f} s", flush=True)


drive.run(session)
