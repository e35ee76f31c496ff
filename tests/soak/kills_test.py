#!/usr/bin/env python3
"""Retained memory after kill -9 of its host: kills_test.py BIN [--module rung_hal.so] [--count N] [--hal-count N] [--seed S]

The programs write the number of their scan into every retained cell (counting.py). After a kill at a random moment the files
that are left, read by another process, are those of one whole scan: all cells have the same number. It is not before the one
that the kill before has left, nor older than the interval of saving before the last number that the host has shown.
"""
import argparse
import collections
import contextlib
import json
import os
import queue
import random
import shutil
import signal
import socket
import statistics
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

import counting
from bench import cnc_test, compiled, folder, make_bench, named, session, wait
from patience import load

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
# With other work on the machine all of these are longer, and so is writing to its disk, which is measured beside the hosts.
SLACK = 0.3  # seconds that may be added to the interval of saving
LATEST = 0.6  # seconds from the start of the host to its kill, at most
LATEST_HAL = 2.5  # of rtapi_app, which loads the module in this time
WORKERS = 4


def build(program, rungc, place):
    source = place / (program.dialect + counting.SUFFIX[program.dialect])
    source.write_text(program.text, encoding="utf-8")
    return compiled(rungc, source, source.with_suffix(".so"))


def less(number, other, bits):
    """`number - other` of counters that wrap."""
    difference = (number - other) % (1 << bits)
    return difference - (1 << bits) if difference >> (bits - 1) else difference


class Disk:
    """How long a small file takes until it is on the disk, at most, while others write, too."""

    def __init__(self, place):
        self.path, self.longest, self.ended = place / "probe", 0.0, threading.Event()
        threading.Thread(target=self.work, daemon=True).start()

    def work(self):
        while not self.ended.wait(0.02):
            begin = time.monotonic()
            with open(self.path, "wb") as file:
                file.write(bytes(4096))
                file.flush()
                os.fsync(file.fileno())
            self.longest = max(self.longest, time.monotonic() - begin)


class Memory:
    """The files of one host, over its kills."""

    def __init__(self, rung, program, image, place, disk):
        self.rung, self.program, self.image, self.folder, self.disk = rung, program, image, place, disk
        self.path = place / "memory"
        self.number = None  # after the last kill

    def read(self):
        """The numbers in the cells: in a copy, since reading saves, too."""
        copy = self.folder / "copy"
        for end in (".a", ".b"):
            (self.folder / ("copy" + end)).unlink(missing_ok=True)
            if (self.folder / ("memory" + end)).exists():
                shutil.copy(self.folder / ("memory" + end), self.folder / ("copy" + end))
        messages = []
        with self.rung.Instance(self.image, log=lambda _, text: messages.append(text)) as plc:
            plc.keep(str(copy))
            plc.power_on(self.rung.WARM)
            values = plc.read_all(self.program.cells).values()
        return [value % (1 << self.program.bits) for value in values], messages

    def check(self, shown):
        """After a kill; `shown`: the last number of the host, or None. Gives what is wrong, or "", and the age in scans."""
        numbers, messages = self.read()
        number, former, bits = numbers[0], self.number, self.program.bits
        self.number = number
        if len(set(numbers)) != 1:
            return f"cells of several scans: {collections.Counter(numbers).most_common(3)}, {messages}", None
        if former is not None and less(number, former, bits) < 0:
            return f"scan {number}, before it was {former} already, {messages}", None
        if shown is None:
            return "", None
        age = less(shown, number, bits)
        # The host writes a file, its name and its folder.
        late = SLACK * load() + 3 * self.disk.longest
        most = (self.program.interval + late) / self.program.period + 1
        return (f"scan {number} is {age} scans older than {shown}, at most {most:.0f} expected" if age > most else ""), age


class Client:
    """Asks a host for the number of its scan, again and again, until it is killed."""

    def __init__(self, path, name):
        self.path = path
        self.request = (json.dumps({"do": "get", "names": [name]}) + "\n").encode()

    def last(self, alive):
        """The last answer; None: there was none. `alive()`: the host has not been killed yet."""
        number = None
        while alive():
            with contextlib.suppress(OSError, ValueError, StopIteration), socket.socket(socket.AF_UNIX) as connection:
                connection.connect(str(self.path))
                lines = connection.makefile("r")
                lines.readline()  # its greeting
                while True:
                    connection.sendall(self.request)
                    number = next(iter(json.loads(lines.readline()).get("values", {}).values()), number)
                    time.sleep(0.002)
            time.sleep(0.001)
        return number


def kill_later(moment, kill):
    """Calls `kill` after so many seconds, whatever this thread does; gives a function that is True until then."""
    killed = threading.Event()
    threading.Timer(moment, lambda: (kill(), killed.set())).start()
    return lambda: not killed.is_set()


def kill_rung_run(host, memory, moment):
    """Starts it and kills it `moment` seconds later; gives the last number that it has shown."""
    process = subprocess.Popen([host, memory.image_path, memory.folder / "empty.map", "--name", "plc", "--retain", memory.path],
                               env={**os.environ, "RUNG_SOCKETS": str(memory.folder / "sockets")}, stderr=subprocess.DEVNULL)
    shown = Client(memory.folder / "sockets/plc.sock", memory.program.cells[0]).last(kill_later(moment, process.kill))
    process.wait()
    return shown


class Figures:
    """Of the kills of one host with one program."""

    def __init__(self):
        self.kills, self.ages, self.problems = 0, [], []

    def add(self, what, problem, age):
        self.kills += 1
        if problem:
            self.problems.append(f"{what}: {problem}")
        if age is not None:
            self.ages.append(age)

    def show(self, name, period):
        ages = [age * period * 1000 for age in self.ages] or [0]
        print(f"{name}: {self.kills} kills, {len(self.problems)} wrong; age of the image after {len(self.ages)} of them: "
              f"median {statistics.median(ages):.0f} ms, oldest {max(ages):.0f} ms")
        for problem in self.problems[:5]:
            print("  " + problem)

    def fine(self):
        """Most hosts have come so far that they have shown a number."""
        return not self.problems and len(self.ages) >= self.kills / 2


def work(jobs, options, make_memory, figures, lock):
    """One of several workers, each with files of its own for every dialect."""
    memories = {}
    while True:
        try:
            index, dialect = jobs.get_nowait()
        except queue.Empty:
            break
        if dialect not in memories:
            memories[dialect] = make_memory(dialect)
        memory = memories[dialect]
        moment = random.Random(f"{options.seed} {index}").uniform(0, LATEST) * load()
        shown = kill_rung_run(options.bin / "rung-run", memory, moment)
        problem, age = memory.check(shown)
        with lock:
            figures[dialect].add(f"kill {index} after {moment * 1000:.0f} ms", problem, age)


def rung_run(rung, options, place):
    programs = {make().dialect: make() for make in counting.ALL}
    paths = {dialect: build(program, options.bin / "rungc", place) for dialect, program in programs.items()}
    jobs, lock = queue.Queue(), threading.Lock()
    for index in range(options.count):
        jobs.put((index, list(programs)[index % len(programs)]))
    figures = {dialect: Figures() for dialect in programs}
    disk = Disk(place)

    def make_memory(dialect):
        mine = Path(tempfile.mkdtemp(dir=place))
        (mine / "empty.map").write_text("")
        memory = Memory(rung, programs[dialect], rung.Image(str(paths[dialect])), mine, disk)
        memory.image_path = paths[dialect]
        return memory

    workers = [threading.Thread(target=work, args=(jobs, options, make_memory, figures, lock)) for _ in range(WORKERS)]
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join()
    disk.ended.set()
    print(f"the disk takes {disk.longest * 1000:.0f} ms at most")
    for dialect, program in programs.items():
        figures[dialect].show(f"rung-run, {dialect}", program.period)
    done = sum(figure.kills for figure in figures.values())
    return done == options.count and all(figure.fine() for figure in figures.values())


HAL = """loadrt threads name1=servo period1=1000000
loadrt rung_hal names=plc so=@DIR@/program.so map=@DIR@/empty.map retain=@DIR@/memory
addf plc.scan servo
start
loadusr -w sleep 600
"""


def kill_rtapi_app(bench, memory, moment):
    """The same with LinuxCNC's process, which has root's rights: one that is about to load the module, at the earliest."""
    (bench.home / ".rtapi_fifo").unlink(missing_ok=True)  # of the one before
    with session(bench, "halrun", "test.hal") as process:
        rtapi = wait("rtapi_app", lambda: named(process.pid, "rtapi_app"))
        alive = kill_later(moment, lambda: os.kill(rtapi, signal.SIGKILL))
        return Client(bench.folder / "tmp/rung-65534/plc.sock", memory.program.cells[0]).last(alive)


def hal(rung, options, program, place):
    """Kills of rtapi_app with one dialect's program."""
    bench = make_bench(options, place)
    image = build(program, options.bin / "rungc", bench.home).rename(bench.home / "program.so")
    bench.programs.add(image)
    bench.file("empty.map", "")
    bench.file("test.hal", HAL)
    disk = Disk(place)
    memory, figures = Memory(rung, program, rung.Image(str(image)), bench.home, disk), Figures()
    for index in range(options.hal_count // len(counting.ALL)):
        moment = random.Random(f"{options.seed} hal {index}").uniform(0, LATEST_HAL) * load()
        problem, age = memory.check(kill_rtapi_app(bench, memory, moment))
        figures.add(f"kill {index} after {moment * 1000:.0f} ms", problem, age)
    disk.ended.set()
    figures.show(f"rtapi_app, {program.dialect}", program.period)
    return figures.fine()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bin", type=Path)
    parser.add_argument("--count", type=int, default=1000, help="kills of rung-run")
    parser.add_argument("--module", type=Path, help="rung_hal.so; rtapi_app is killed, too")
    parser.add_argument("--hal-count", type=int, default=30, help="kills of rtapi_app")
    parser.add_argument("--seed", default=str(random.randrange(10**6)))
    options = parser.parse_args()
    print(f"seed {options.seed}", flush=True)
    sys.path.insert(0, str(options.bin.parent / "lib/python"))
    import rung  # pylint: disable=import-outside-toplevel
    with folder() as place:
        fine = rung_run(rung, options, place)
    if options.module:
        cnc_test.check_machine(options.module)
        for make in counting.ALL:
            with folder() as place:
                fine = hal(rung, options, make(), place) and fine
    return 0 if fine else 1


if __name__ == "__main__":
    sys.exit(main())
