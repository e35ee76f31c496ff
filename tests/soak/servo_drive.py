#!/usr/bin/python3
"""Moves the machine for a while, then changes each program several times; sampler records every cycle of the servo thread.

plan.json: seconds without a change, changes of each program, and the hosts with the program files that they change to.
With each row goes a mark: 0 nothing, 1 the time without a change, from 2 on each change; seen.json has the
hosts of these, and how many scans each program has made in the time without a change.
"""
import json
import subprocess
import time

import hal
import linuxcnc
from drive import check, command, done, polled, set_mode
from driver import run, switch_on


def make_mark():
    component = hal.component("marks")
    component.newpin("mark", hal.HAL_S32, hal.HAL_OUT)
    component.ready()
    hal.connect("marks.mark", "mark")
    return component


def same_outputs():
    """Of ClassicLadder and of the program with the same rungs."""
    return all(hal.get_value(f"classicladder.0.out-{i:02}") == hal.get_value(f"bits.out-{i}") for i in range(10))


def move(seconds):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        for line in ("G1 X20 Y10 F3000", "G1 X0 Y0"):
            command.mdi(line)
            done(line)


def passes():
    return {host: hal.get_value(f"{host}.scans") for host in ("mill", "turning", "centre", "bits")}


def change(host, program):
    reload = subprocess.run(["rungctl", "reload", program, "--yes", "--late", "--host", host], stdout=subprocess.PIPE,
                            stderr=subprocess.STDOUT, text=True, timeout=30)
    check(reload.returncode == 0, f"rungctl reload of {host}: {reload.stdout}")
    time.sleep(0.03)


def main():
    with open("plan.json", encoding="ascii") as file:
        plan = json.load(file)
    switch_on()
    set_mode(linuxcnc.MODE_MDI)
    check(same_outputs() and any(hal.get_value(f"bits.out-{i}") for i in range(10)), "ClassicLadder computes something else")
    marks = make_mark()
    changed = []
    sampler = subprocess.Popen(["halsampler", "samples.txt"])
    time.sleep(1)
    before = passes()
    marks["mark"] = 1
    move(plan["seconds"])
    marks["mark"] = 0
    made = {host: count - before[host] for host, count in passes().items()}
    for count in range(plan["changes"]):
        for host, programs in plan["hosts"].items():
            changed.append(host)
            marks["mark"] = len(changed) + 1
            change(host, programs[count % 2])
            marks["mark"] = 0
            time.sleep(0.1)
    time.sleep(1)
    sampler.terminate()
    sampler.wait()
    check(polled().inpos, "the machine moves")
    with open("seen.json", "w", encoding="ascii") as file:
        json.dump({"changed": changed, "passes": made}, file)


run(main)
