#!/usr/bin/python3
"""Runs inside LinuxCNC in place of its display: has the PLC program move its axis, and read and write data of LinuxCNC."""
import os
import signal
import subprocess
import time
from pathlib import Path

import hal
import linuxcnc

import drive
from drive import check, command, done, mdi, scans, pin, pins, process, set_mode, state, wait

RAPID, FEED, FEED_PER_TURN, DWELL, CONTINUOUS, REFERENCE_1, REFERENCE_2 = 0, 1, 2, 4, 6, 7, 8
SPEED, AUXILIARY, MACHINE = 16, 18, 32
UNITS = 10000  # of a length in the program, in a mm
BAD_NUMBER = 3


def put(**values):
    for name, value in values.items():
        hal.set_p("rung." + name.replace("_", "-"), str(int(value)))


def table():
    return hal.get_value("joint.3.motor-pos-cmd")


def near(value, wanted, within=0.001):
    return abs(value - wanted) < within


def order(code, data_1=0, data_2=0):
    """The program hands a block to its group, and the control has taken it."""
    put(command=code, data_1=data_1, data_2=data_2)
    put(order=True)
    pins(taken=True)
    put(order=False)
    pins(taken=False)


def at_rest():
    pins(selected=False, moving=False, in_place=True, distributed=True, controlled=False)


def clear():
    put(clear=True)
    at_rest()
    put(clear=False)


def go_back():
    """With all alarms cleared, to the reference point."""
    clear()
    order(REFERENCE_1, 6000)
    wait("the reference point", lambda: near(table(), 0))
    at_rest()


def distances():
    at_rest()
    order(FEED, 240, 10 * UNITS)  # two and a half seconds
    pins(selected=True, moving=True, in_place=False, distributed=False, controlled=True)
    order(DWELL, 0, 100)
    order(RAPID, 6000, -4 * UNITS)
    check(pin("full"), "three blocks leave the input buffer empty")
    wait("the first block", lambda: near(table(), 10))
    pins(full=False)
    wait("the third block", lambda: near(table(), 6))
    at_rest()


def held():
    """ESTP holds the axis, and it continues."""
    order(MACHINE, 240, 0)
    wait("motion", lambda: table() < 5.9)
    put(pause=True)
    pins(moving=False, selected=True, distributed=False)
    here = drive.at_rest(table)
    scans(10)
    check(near(table(), here), "the axis moves while it is held")
    check(here > 0.1, "it has come to its end before it was held")
    put(pause=False)
    wait("machine zero", lambda: near(table(), 0))
    at_rest()


def continuous():
    """Until ECLR; a new block changes the speed."""
    order(CONTINUOUS, 120, 1)
    wait("motion", lambda: table() < -1)
    order(CONTINUOUS, 480, 1)
    wait("faster motion", lambda: hal.get_value("table.current-vel") < -7)
    clear()
    here = table()
    scans(10)
    check(near(table(), here), "the axis moves after ECLR")
    order(SPEED, 1)  # 360 degrees a minute
    wait("the other direction", lambda: table() > here + 0.5)
    go_back()


def auxiliary():
    order(AUXILIARY, 0, 77)
    pins(auxiliary=77)
    at_rest()


def refused():
    """What LinuxCNC cannot do is an alarm of the group until ECLR."""
    for code in (FEED_PER_TURN, REFERENCE_2):
        order(code, 100, UNITS)
        pins(alarm=True)
        check(near(table(), 0), "the axis has moved")
        clear()
        pins(alarm=False)
    order(FEED, 6000, 2 * UNITS)
    wait("a good block after it", lambda: near(table(), 2))
    at_rest()


def nobody_serves():
    """The axis stops, nothing says that it stands where it should, and it does not go on by itself later."""
    order(CONTINUOUS, 300, 1)
    wait("motion", lambda: table() < 1.5)

    def stopped():
        check(not pin("in-place") and not pin("distributed"), "an axis that nobody serves is said to stand")

    drive.services_hang(table, stopped)
    go_back()


def machine_off():
    """What was ordered ends as an alarm, and nothing goes on when the machine is on again."""
    order(CONTINUOUS, 300, 0)
    wait("motion", lambda: table() > 0.5)
    command.state(linuxcnc.STATE_OFF)
    pins(alarm=True)
    here = drive.at_rest(table)
    drive.switch_on()
    scans(50)
    check(near(table(), here), "the axis goes on by itself")
    go_back()


def faulted():
    """The program faults while its axis moves: it stands after the reset, too."""
    order(CONTINUOUS, 300, 0)
    wait("motion", lambda: table() > 0.5)
    put(stick=True)
    pins(fault=True, enable=False)
    drive.is_state(linuxcnc.STATE_ESTOP)
    put(stick=False)
    put(reset=True)
    pins(fault=False)
    put(reset=False)
    here = drive.at_rest(table)
    drive.switch_on()
    scans(50)
    check(near(table(), here), "the axis goes on by itself")
    go_back()


def write(function, number, attribute, data):
    """The end code."""
    put(write_function=function, write_length=4, write_number=number, write_attribute=attribute, write_data=data)
    put(ask_write=True)
    pins(written=True)
    end = pin("write-end")
    put(ask_write=False)
    pins(written=False)
    return end


def read(function, number=0, attribute=0):
    """The end code and what was read."""
    put(read_function=function, read_length=4, read_number=number, read_attribute=attribute)
    put(ask_read=True)
    pins(read=True)
    answer = pin("read-end"), pin("read-data")
    put(ask_read=False)
    pins(read=False)
    return answer


def same(found, wanted, what):
    check(found == wanted, f"{what}: {found} instead of {wanted}")


def written():
    """Work offsets, tool data, the tool in the spindle."""
    same(write(4, 2, 1, 12 * UNITS + 5000), 0, "G55, Y")
    same(read(3, 2, 1), (0, 12 * UNITS + 5000), "G55, Y")
    mdi("G55")
    check(near(state("g5x_offset")[1], 12.5), f"G55 is {state('g5x_offset')}")
    mdi("G54")
    same(write(2, 1, 0, 30 * UNITS), 0, "length of tool 2")
    same(write(2, 1, 2, 4 * UNITS), 0, "radius of tool 2")
    wait("the tool table", lambda: any(entry.id == 2 and near(entry.zoffset, 30) and near(entry.diameter, 8)
                                       for entry in state("tool_table")))
    same(read(1, 1, 2), (0, 4 * UNITS), "radius of tool 2")
    same(write(31, 0, 0, 2 * UNITS), 0, "tool in the spindle")
    wait("M61", lambda: state("tool_in_spindle") == 2)
    same(write(31, 0, 0, 9 * UNITS), BAD_NUMBER, "a tool that is not there")
    same(write(10, 500, 0, 7 * UNITS), 0, "macro variable")
    same(read(9, 500), (0, 7 * UNITS), "macro variable")
    check(state("task_mode") == linuxcnc.MODE_MDI, "another mode than before")


def at_once():
    """The line of the part program and positions, while it runs."""
    mdi("G0 X1.5 Y-2")
    wait("the position", lambda: read(17, 0, 2) == (0, -2000))
    same(read(14), (0, 0), "no part program")
    with open("part.ngc", "w", encoding="ascii") as file:
        file.write("G21 G90\nG1 X0 F6000\nG4 P5\nM2\n")
    set_mode(linuxcnc.MODE_AUTO)
    command.program_open(os.path.abspath("part.ngc"))
    done("program open")
    command.auto(linuxcnc.AUTO_RUN, 0)
    wait("the line", lambda: read(14) in ((0, 2 * UNITS), (0, 3 * UNITS)))
    same(read(1, 1, 0), (0, 30 * UNITS), "the tool table while a part program runs")
    wait("the end of the block", lambda: read(17, 0, 1) == (0, 0))
    drive.end_motion()  # of the dwell, which takes its time only
    drive.idle()
    same(read(17, 0, 1), (0, 0), "the position")


NETS = "net target {0}.target\nnet wanted {0}.speed\nnet position {0}.position\nnet active {0}.moving\n"


def end_services(signal_number):
    """In the middle of a motion; where the axis has come to rest."""
    order(CONTINUOUS, 300, 0)
    wait("motion", lambda: table() > 0.5)
    os.kill(process("rung-services"), signal_number)
    pins(serving=False)
    return drive.at_rest(table)


def start_services(*words):
    subprocess.Popen(["rung-services", "--host", "rung", "--axis", "4", *words])


def it_serves_again(here):
    pins(serving=True)
    scans(50)
    check(near(table(), here), f"the axis has moved by itself, from {here} to {table()}")
    go_back()


def started_again():
    """Without its lines nothing is served, whatever the signal has kept; with them the axis stays where it is."""
    here = end_services(signal.SIGTERM)
    start_services()
    scans(150)
    check(not pin("serving") and near(table(), here), "a target that nobody has set moves the axis")
    for line in NETS.format("rung-services.axis-4").splitlines():
        subprocess.run(["halcmd", *line.split()], check=True)
    it_serves_again(here)


def killed():
    """Its pins remain: the next one has others."""
    here = end_services(signal.SIGKILL)
    taken = subprocess.run(["rung-services", "--host", "rung", "--axis", "4"], capture_output=True, text=True, check=False)
    check(taken.returncode == 1 and "HAL has a component rung-services already" in taken.stderr, taken.stderr)
    Path("again.hal").write_text("".join(f"unlinkp rung-services.axis-4.{pin}\n" for pin in ("target", "speed")) + NETS.format("again.axis-4"))
    start_services("--name", "again", "--hal", "again.hal")
    it_serves_again(here)


def task_killed():
    """Then LinuxCNC is no more, and what served the program with it; its axis stands."""
    order(CONTINUOUS, 300, 0)
    wait("motion", lambda: table() > 0.5)
    os.kill(process("milltask"), signal.SIGKILL)
    pins(serving=False)
    here = drive.at_rest(table)
    scans(50)
    check(near(table(), here), "the axis goes on by itself")
    check(not pin("in-place") and not pin("distributed"), "an axis that nobody serves is said to stand")


STEPS = (distances, held, continuous, auxiliary, refused, machine_off, faulted, nobody_serves, started_again, killed, written, at_once, task_killed)


def session():
    component = hal.component("driver")  # get_value needs one
    component.ready()
    drive.switch_on()
    wait("the program's axis is homed", lambda: state("homed")[:4] == (1, 1, 1, 1))
    for step in STEPS:
        set_mode(linuxcnc.MODE_MDI)
        begin = time.monotonic()
        step()
        print(f"driver: {step.__name__} ok, {time.monotonic() - begin:.1f} s", flush=True)
    check(not pin("fault"), "a fault")


if __name__ == "__main__":
    drive.run(session)
