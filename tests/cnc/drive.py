#!/usr/bin/python3
"""Runs inside LinuxCNC in place of its display: commands functions and looks at the pins of the PLC program."""
import json
import os
import re
import signal
import subprocess
import sys
import time
import traceback
from pathlib import Path

import hal
import linuxcnc

from patience import PATIENCE, patience, wait_until

command = linuxcnc.command()
status = linuxcnc.stat()
errors = linuxcnc.error_channel()


def pin(name):
    return hal.get_value("rung." + name)


def wait(what, condition, seconds=PATIENCE):
    check(wait_until(condition, seconds, step=0.001), f"never came: {what}")


def again_until(what, act, condition):
    """LinuxCNC looks at its keys now and then: where the machine is busy it may miss one, and an operator presses it again."""
    def tried():
        act()
        end = time.monotonic() + 3  # then he does, however busy the machine is
        while not (seen := condition()) and time.monotonic() < end:
            time.sleep(0.001)
        return seen

    wait(what, tried)


def scans(count, since=None):
    """Waits until the program has run as often, since it had run `since` times: the thread of a busy machine may sleep for
    longer than a key is held."""
    begin = pin("scans") if since is None else since
    wait(f"{count} scans of the program", lambda: pin("scans") - begin >= count)


def program_state():
    return json.loads(rungctl("status", "--json"))


def program_time():
    """Seconds of the program's own clock: that of a busy machine passes while a thread waits for its turn."""
    return program_state()["us"] / 1e6


def at_rest(place):
    """Where an axis is once it does not move any more."""
    while True:
        before = place()
        scans(5)
        if abs(place() - before) < 1e-6:
            return before


def pins(**expected):
    """Waits for all the pins to have these values."""
    for name, value in expected.items():
        name = name.replace("_", "-")
        wait(f"{name} = {value}", lambda: pin(name) == value)


def polled():
    status.poll()
    return status


def state(name):
    return getattr(polled(), name)


def check(condition, what):
    if not condition:
        raise AssertionError(f"{what}; LinuxCNC says {errors.poll()}")


def done(what):
    check(command.wait_complete(patience()) == linuxcnc.RCS_DONE, f"{what} was not done")


def mdi(line):
    command.mdi(line)
    done(line)
    status.poll()


def switch_on():
    command.state(linuxcnc.STATE_ESTOP_RESET)
    done("e-stop reset")
    pins(enable=True)
    is_state(linuxcnc.STATE_ESTOP_RESET)
    command.state(linuxcnc.STATE_ON)
    done("machine on")
    command.mode(linuxcnc.MODE_MANUAL)
    done("manual mode")
    command.home(-1)
    wait("homed", lambda: state("homed")[:3] == (1, 1, 1))


def is_state(what):
    wait(f"task state {what}", lambda: state("task_state") == what)


def idle():
    wait("the program's end", lambda: state("interp_state") == linuxcnc.INTERP_IDLE)


def progress():
    """How far a part program is; it changes with each single block."""
    polled()
    return status.interp_state, status.current_line, status.motion_line


def process(name):
    """Of the program of this session that has the name."""
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            words = (folder / "cmdline").read_bytes().split(b"\0")
        except OSError:
            continue
        if any(word.decode(errors="replace").endswith("/" + name) or word == name.encode() for word in words[:2]):
            return int(folder.name)
    raise AssertionError(f"no process {name}")


def services_hang(place, stopped):
    """While the program's axis moves: it stops, and does not go on by itself when they are back."""
    services = process("rung-services")
    os.kill(services, signal.SIGSTOP)
    pins(serving=False)
    here = at_rest(place)
    stopped()
    os.kill(services, signal.SIGCONT)
    pins(serving=True)
    scans(50)
    check(abs(place() - here) < 0.001, "the axis goes on by itself")


def operator(text):
    """LinuxCNC's user interface shows it."""
    shown = []

    def comes():
        shown.append(errors.poll())
        return any(error and text in error[1] for error in shown)

    wait(f"'{text}' at the operator", comes)


def set_mode(mode):
    command.mode(mode)
    done("mode")


def spindle():
    pins(spindle_cw=False, up_to_speed=False)
    begin = program_time()
    mdi("M3 S1000")
    mdi("G1 X5 F6000")  # 50 ms of motion, after the spindle's 400 ms
    took = program_time() - begin
    check(took >= 0.4, f"the feed did not wait for the spindle: {took:.3f} s")
    check(pin("up-to-speed"), "feed without speed")
    pins(spindle_cw=True, spindle_ccw=False)
    mdi("M4 S1000")
    pins(spindle_cw=False, spindle_ccw=True)
    mdi("M5")
    pins(spindle_cw=False, spindle_ccw=False, up_to_speed=False)
    mdi("G1 X0 F6000")  # a spindle that is off holds nothing up


def coolant():
    pins(coolant_pump=False, coolant_lamp=False)
    mdi("M8")
    pins(coolant_pump=True, coolant_lamp=True)
    mdi("M9")
    pins(coolant_pump=False, coolant_lamp=False)


def tools():
    check(pin("tool") != 2, "the tool too early")
    begin = program_time()
    mdi("T2 M6")
    took = program_time() - begin
    check(took >= 0.36, f"the magazine and the arm were not waited for: {took:.3f} s")
    check(status.tool_in_spindle == 2, f"tool {status.tool_in_spindle} in the spindle")
    pins(tool=2, tool_changed=False, tool_prepared=False)


def part():
    with open("part.ngc", "w", encoding="ascii") as file:
        file.write("G21 G90 T1 M6\nM3 S500\nM8\nG1 X10 F6000\nM9\nM5\nG0 X0\nM2\n")
    set_mode(linuxcnc.MODE_AUTO)
    command.program_open("part.ngc")
    done("program open")
    command.auto(linuxcnc.AUTO_RUN, 0)
    seen = set()

    def finished():
        status.poll()
        seen.update(name for name in ("spindle-cw", "coolant-lamp") if pin(name))
        return status.interp_state == linuxcnc.INTERP_IDLE and pin("tool") == 1 and not pin("spindle-cw")

    wait("part program", finished)
    check(seen == {"spindle-cw", "coolant-lamp"}, f"during the part program only {seen} came on")
    check(status.tool_in_spindle == 1, f"tool {status.tool_in_spindle} in the spindle")
    pins(coolant_lamp=False, coolant_pump=False)


def counters():
    check(not pin("fault"), "a fault")
    check(pin("functions-lost") == 0, "functions were lost")
    check(pin("scans") > 100, f"only {pin('scans')} scans")
    before = program_state()
    scans(50)
    after = program_state()
    ran, took = (after[name] - before[name] for name in ("scans", "us"))
    check(ran >= 50 and abs(took - 8000 * ran) <= 8000, f"{ran} scans in {took} us, not one in 8 ms")
    check(0 < pin("scan.time") <= hal.get_value("rung.scan.tmax"), "the times that HAL measures")


def rungctl(*words, refused=False):
    """What it prints."""
    ran = subprocess.run(["rungctl", *words], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=patience())
    check((ran.returncode != 0) == refused, f"rungctl {' '.join(words)}: {ran.stdout}")
    return ran.stdout


class Recording:
    """Bits that `rungctl` watches and traces beside the session."""

    def __init__(self, names):
        self.names = names
        self.tracing = subprocess.Popen(["rungctl", "trace", *names, "-o", "cut.vcd"])
        wait("the trace begins", lambda: os.path.exists("cut.vcd") and os.path.getsize("cut.vcd") > 0)
        with open("watched.txt", "w", encoding="utf-8") as file:
            self.watching = subprocess.Popen(["rungctl", "watch", *names], stdout=file)
        wait("the watch begins", lambda: all(map(self.watched, names)))

    @staticmethod
    def watched(name):
        """The values of a bit, as the watch has printed them."""
        with open("watched.txt", encoding="utf-8") as file:
            return re.findall(f" {re.escape(name)} = (true|false)\n", file.read())

    def end(self):
        """The changes of each bit, as sigrok-cli prints them of the trace; before its first value all is 0."""
        for process in (self.tracing, self.watching):
            process.send_signal(signal.SIGINT)
            check(process.wait(patience()) == 0, f"{process.args[1]} of {self.names}")
        read = subprocess.run(["sigrok-cli", "-I", "vcd:downsample=1000", "-i", "cut.vcd", "-O", "csv:header=false:label=off"],
                              capture_output=True, text=True, timeout=patience())
        check(read.returncode == 0, f"sigrok-cli: {read.stderr}")
        columns = zip(*(row.split(",") for row in read.stdout.split() if re.fullmatch("[01](,[01])*", row)))
        return {name: [("false", "true")[int(bit)] for bit in re.sub(r"(.)\1+", r"\1", "".join(column))]
                for name, column in zip(self.names, columns, strict=True)}


def change_in_motion(forces, edited):
    """While an axis moves, bits are watched, traced and forced, and an edited program takes over. `forces`: name, value, the
    pin that shows it, its value in the meantime and afterwards."""
    check("running: " in rungctl("status"), "status")
    recording = Recording([name for name, *_ in forces])
    for name, value, shows, meanwhile, afterwards in forces:
        before = recording.watched(name)[-1]
        check(before != value, f"{name} is {value} already")
        rungctl("force", name, value)
        pins(**{shows: meanwhile})
        wait(f"{name} = {value} in the watch", lambda: recording.watched(name)[-1] == value)
        check(f"{name} = {value}" in rungctl("forced"), f"{name} is not forced")
        rungctl("unforce", name)
        pins(**{shows: afterwards})
        wait(f"{name} = {before} in the watch", lambda: recording.watched(name)[-1] == before)
    check("the new program runs" in rungctl("reload", edited), "reload")
    check(not state("inpos"), "the motion was over before the changes")
    for name, traced in recording.end().items():
        watched = recording.watched(name)
        check(traced in (watched, ["false", *watched]), f"{name}: watched {watched}, traced {traced}")


def end_motion():
    """What remains of it takes its time only."""
    command.abort()
    done("abort")


def remote():
    """While an axis moves, the program is changed, and back."""
    with open("flow.txt", encoding="ascii") as file:
        flow = file.read()
    mdi("M8")
    pins(coolant_lamp=True)
    command.mdi("G1 X20 F10")
    change_in_motion([(flow, "false", "coolant_lamp", False, True), ("COOLANT_LAMP", "false", "coolant_lamp", False, True)], "edited.so")
    check("is protected by the mapping file" in rungctl("set", "ESTOP_OK", "false", refused=True), "the emergency stop was set")
    check("\"stop\" is not allowed here" in rungctl("stop", refused=True), "stop")
    pins(coolant_lamp=True, enable=True)
    end_motion()
    mdi("M9")
    pins(coolant_lamp=False, coolant_pump=False)
    check(rungctl("rollback").endswith("the former program runs\n"), "rollback")
    check(rungctl("get", "COOLANT_PUMP") == "COOLANT_PUMP = false\n", "get")
    mdi("G1 X0 F6000")


def alarm():
    """A program that never ends takes over: the machine stops, the operator learns why, and a reset goes back."""
    while errors.poll():
        pass
    check("the new program stopped at once" in rungctl("reload", "endless.so", "--yes", refused=True), "reload")
    pins(fault=True, enable=False)
    is_state(linuxcnc.STATE_ESTOP)
    shown = []

    def reported():
        shown.append(errors.poll())
        return any(error and "the program endless has stopped: dead-loop (rung" in error[1] for error in shown)

    wait("the fault at the operator", reported)
    check("stopped by a fault of endless, which was running then: dead-loop" in rungctl("status"), "status")
    hal.set_p("rung.reset", "1")
    pins(fault=False)
    hal.set_p("rung.reset", "0")
    switch_on()
    set_mode(linuxcnc.MODE_MDI)
    coolant()


def emergency_stop():
    mdi("M3 S1000")
    pins(spindle_cw=True)
    hal.set_p("rung.estop-button", "1")
    pins(enable=False, spindle_cw=False)
    is_state(linuxcnc.STATE_ESTOP)


def session(steps):
    """Switches on and does what steps.txt names, in its order."""
    component = hal.component("driver")  # get_value needs one
    component.ready()
    switch_on()
    set_mode(linuxcnc.MODE_MDI)
    with open("steps.txt", encoding="ascii") as file:
        for name in file.read().split():
            set_mode(linuxcnc.MODE_MDI)
            steps[name]()
            print("driver:", name, "ok", flush=True)


def run(work):
    """Leaves "passed" in result.txt, or what went wrong."""
    try:
        work()
        result = "passed"
    except BaseException:
        result = traceback.format_exc()
    with open("result.txt", "w", encoding="utf-8") as out:
        out.write(result)
    sys.exit(0 if result == "passed" else 1)


if __name__ == "__main__":
    run(lambda: session({step.__name__: step for step in (spindle, coolant, tools, part, counters, remote, alarm, emergency_stop)}))
