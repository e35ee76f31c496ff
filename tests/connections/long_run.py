#!/usr/bin/env python3
"""rung-run at 1 ms with everything connected, for a while: long_run.py BIN SECONDS

mbpoll reads a server of rung-run, pymodbus writes there and reads what the program makes of it, and a client of rung-run
exchanges with pymodbus as a device. What is checked: every value that is read is one that was written, and two values
that are written together are read together; no connection is lost; and the connections cost no overruns. The machine
need not be a real-time one, so that is measured against a rung-run without connections that runs beside it."""
import re
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

from pymodbus.client import ModbusTcpClient

from sides import Device, Host, free_port

# The server's side has D8 and D10, the client's D20 and D22: the program has always both of one exchange.
MAP = """[in]
a = {{ type = "u32", name = "D8:2" }}
b = {{ type = "u32", name = "D10:2" }}
c = {{ type = "u32", name = "D20:2" }}
d = {{ type = "u32", name = "D22:2" }}
[out]
a-is = {{ type = "u32", name = "D8:2" }}
b-is = {{ type = "u32", name = "D10:2" }}
c-is = {{ type = "u32", name = "D20:2" }}
d-is = {{ type = "u32", name = "D22:2" }}
[modbus-server]
port = {port}
timeout = 2
holding-registers = {{ a = 0, b = 1 }}
input-registers = {{ a-is = 0, b-is = 1 }}
[[modbus-client]]
host = "127.0.0.1"
port = {device}
period = 0.01
timeout = 2
holding-registers = {{ c = 0, d = 1, c-is = 10, d-is = 11 }}
"""
PERIOD_MS = 1


def partner(value):
    return value ^ 0x5A5A


class Panel:
    """Writes pairs and reads them back, at a server."""

    def __init__(self, port, first, function):
        self.client = ModbusTcpClient("127.0.0.1", port=port)
        assert self.client.connect()
        self.first, self.read = first, getattr(self.client, function)
        self.value, self.round_trips, self.longest = 0, 0, 0.0

    def turn(self):
        self.value = self.value % 60000 + 1
        begin = time.monotonic()
        written = self.client.write_registers(0, [self.value, partner(self.value)], slave=1)
        assert not written.isError(), written
        while True:
            got = self.read(self.first, 2, slave=1).registers
            if got == [self.value, partner(self.value)]:
                break
            former = self.value - 1
            assert got in ([0, 0], [former, partner(former)], [60000, partner(60000)]), f"wrote {self.value} after {former}, read {got}"
            assert time.monotonic() - begin < 5, f"{self.value} does not come back"
        self.round_trips += 1
        self.longest = max(self.longest, time.monotonic() - begin)


def polled(lines):
    """How many pairs mbpoll has read; each is one that was written together."""
    count, first = 0, None
    for line in lines:
        if match := re.match(r"\[(\d)\]:\s+(\d+)", line):
            place, value = int(match[1]), int(match[2])
            if place == 1:
                assert value == partner(first) or (first, value) == (0, 0), f"mbpoll read {first} with {value}"
                count += 1
            first = value
    return count


def run(programs, seconds):
    device = Device()
    port = free_port()
    host = Host(programs, MAP.format(port=port, device=device.port), options=["--period", str(PERIOD_MS * 1000)])
    alone = Host(programs, "", name="alone", options=["--period", str(PERIOD_MS * 1000)])
    panels = [Panel(port, 0, "read_input_registers"), Panel(device.port, 10, "read_holding_registers")]
    for panel in panels:
        panel.turn()
    mbpoll = subprocess.Popen(["stdbuf", "-oL", "mbpoll", "-m", "tcp", "-p", str(port), "-0", "-r", "0", "-c", "2", "-t", "3", "-l", "100", "127.0.0.1"],
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    output = []
    reading = threading.Thread(target=lambda: output.extend(mbpoll.stdout))
    reading.start()
    begin = time.monotonic()
    while time.monotonic() - begin < seconds:
        for panel in panels:
            panel.turn()
    status, reference = host.status(), alone.status()["clock"]
    mbpoll.send_signal(signal.SIGINT)
    reading.join()
    device.kill()
    log, _ = host.logged(), (host.end(), alone.end())
    return status, reference, panels, polled(output), log


def main():
    programs, seconds = Path(sys.argv[1]).resolve(), float(sys.argv[2])
    status, reference, panels, pairs, log = run(programs, seconds)
    clock = status["clock"]
    for name, figures in (("with connections", clock), ("without", reference)):
        print(f"{name}: {figures['steps']} steps of {PERIOD_MS} ms, {figures['overruns']} overruns, 99% start within "
              f"{figures['late_99_us']:.0f} us, the latest {figures['latest_us']:.0f} us, a step takes {figures['mean_us']:.1f} us, "
              f"the longest {figures['worst'][0]['us']:.0f} us")
    for one in status["connections"]:
        print(f"{one['name']}: {one['exchanges']} exchanges, lost {one['losses']} times")
    for name, panel in zip(("pymodbus at the server", "pymodbus at its device"), panels):
        print(f"{name}: {panel.round_trips} values there and back, the longest in {panel.longest * 1000:.0f} ms")
    print(f"mbpoll: {pairs} pairs read")
    assert all(one["alive"] and one["losses"] == 0 for one in status["connections"]), log
    assert pairs >= seconds * 4, f"mbpoll reads ten times a second; found {pairs} in {seconds} s"
    assert all(panel.round_trips > seconds * 3 for panel in panels)
    # What the machine does to a thread that sleeps and wakes up, it does to both.
    allowed = 3 * reference["overruns"] + clock["steps"] // 100
    assert clock["overruns"] <= allowed, f"{clock['overruns']} overruns, expected at most {allowed}"
    assert clock["steps"] + clock["overruns"] >= 0.8 * seconds * 1000 / PERIOD_MS, "steps were lost"


if __name__ == "__main__":
    main()
