"""The sides of a connection: rung-run with a program, devices, peers, and a cable that can be pulled."""
import json
import os
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import threading
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from patience import patience, wait_until

# X0.n lights Y0.n; D cells come and go through pins.
PROGRAM = "dialect gsk\nFUNC END1\n" + "".join(f"LD   X0.{n}\nOUT  Y0.{n}\n" for n in range(8)) + "FUNC END2\n"
PINS = """[in]
run = { type = "bit", name = "X0.0" }
door = { type = "bit", name = "X0.1" }
other = { type = "bit", name = "X0.2" }
speed = { type = "s32", name = "D8:2" }
turns = { type = "s32", name = "D12:4" }
load = { type = "float", name = "D16:4", scale = 100 }
ok = { type = "bit", name = "X0.7" }
[out]
lamp = { type = "bit", name = "Y0.0" }
door-is = { type = "bit", name = "Y0.1" }
other-is = { type = "bit", name = "Y0.2" }
speed-is = { type = "s32", name = "D8:2" }
turns-is = { type = "s32", name = "D12:4" }
load-is = { type = "float", name = "D16:4", scale = 100 }
"""


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class Host:
    """A rung-run with a program and a map, in a folder of its own. `program`: the text of a GSK program, or the path of
    another source or project."""

    def __init__(self, programs, map_text, name="plc", options=(), program=PROGRAM):
        self.programs = programs
        self.status_at_end = None
        self.folder = tempfile.TemporaryDirectory()
        self.home = Path(self.folder.name)
        self.environment = {**os.environ, "RUNG_SOCKETS": str(self.home / "sockets")}
        self.name = name
        (self.home / "p.map").write_text(map_text)
        source = program
        if isinstance(program, str):
            source = self.home / "p.pmc"
            source.write_text(program)
        subprocess.run([programs / "rungc", "build", "-q", source, "-o", self.home / "p.so"], check=True)
        self.log = open(self.home / "log", "w+")
        self.process = subprocess.Popen([programs / "rung-run", self.home / "p.so", self.home / "p.map", "--name", name, *options],
                                        stdout=subprocess.DEVNULL, stderr=self.log, env=self.environment)
        if not wait_until(lambda: "listening at" in self.logged() or self.process.poll() is not None):
            self.process.kill()
            raise AssertionError(f"it does not begin: {self.logged()}")

    def logged(self):
        return (self.home / "log").read_text()

    def ctl(self, *words):
        done = subprocess.run([self.programs / "rungctl", *words, "--json"], capture_output=True, text=True, timeout=patience(), env=self.environment)
        if done.returncode != 0:
            raise AssertionError(done.stdout + done.stderr)
        return json.loads(done.stdout)

    def get(self, *names):
        values = self.ctl("get", *names)["values"]
        return values[names[0]] if len(names) == 1 else tuple(values[name] for name in names)

    def status(self):
        return self.ctl("status")

    def pass_by(self, count):
        """Waits for that many scans of the program."""
        end = self.status()["scans"] + count
        if not wait_until(lambda: self.status()["scans"] >= end):
            raise AssertionError(f"it does not run: {self.logged()}")

    def end(self):
        """Its status; a second time as well."""
        if self.status_at_end is not None:
            return self.status_at_end
        if self.process.poll() is None:
            self.process.terminate()
        self.status_at_end = self.process.wait(patience())
        self.log.close()
        self.folder.cleanup()
        return self.status_at_end


class Cable:
    """What is between two sides: passes bytes on until it is pulled; then they are lost, and nobody learns of it.
    `answer`: what becomes of what the far side says."""

    def __init__(self, port, answer=lambda data: data):
        self.target = port
        self.answer = answer
        self.pulled = threading.Event()
        self.listening = socket.create_server(("127.0.0.1", 0))
        self.port = self.listening.getsockname()[1]
        self.open = [self.listening]
        threading.Thread(target=self.accept, daemon=True).start()

    def accept(self):
        while True:
            try:
                near, _ = self.listening.accept()
                far = socket.create_connection(("127.0.0.1", self.target))
            except OSError:
                return
            self.open += [near, far]
            for source, target, change in ((near, far, lambda data: data), (far, near, lambda data: self.answer(data))):
                threading.Thread(target=self.carry, args=(source, target, change), daemon=True).start()

    def carry(self, source, target, change):
        try:
            while data := source.recv(4096):
                if not self.pulled.is_set():
                    target.sendall(change(data))
        except OSError:
            pass
        if not self.pulled.is_set():
            target.close()

    def close(self):
        for one in self.open:
            one.close()


def frame(pdu, transaction=1, unit=1):
    return struct.pack(">HHHB", transaction, 0, len(pdu) + 1, unit) + pdu


class Client:
    """Modbus by hand, right and wrong."""

    def __init__(self, port):
        self.socket = socket.create_connection(("127.0.0.1", port), timeout=patience())
        self.socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)

    def ask(self, pdu):
        """The answer's pdu; None: the connection has ended."""
        self.socket.sendall(frame(pdu))
        return self.answer()

    def answer(self):
        try:
            head = self.take(7)
            return head and self.take(struct.unpack(">H", head[4:6])[0] - 1)
        except ConnectionError:
            return None

    def take(self, size):
        data = b""
        while len(data) < size:
            more = self.socket.recv(size - len(data))
            if not more:
                return None
            data += more
        return data

    def write(self, first, *registers):
        return self.ask(struct.pack(">BHHB", 16, first, len(registers), 2 * len(registers)) + struct.pack(f">{len(registers)}H", *registers))

    def write_coil(self, place, value):
        return self.ask(struct.pack(">BHH", 5, place, 0xFF00 if value else 0))

    def read(self, first, count, function=4):
        answer = self.ask(struct.pack(">BHH", function, first, count))
        return struct.unpack(f">{count}H", answer[2:]) if answer and answer[0] == function else answer

    def close(self):
        self.socket.close()


# A client that writes again and again, in a process that can be stopped and killed.
WRITING = """
import sys, time
sys.path.insert(0, sys.argv[1])
from sides import Client
client = Client(int(sys.argv[2]))
while True:
    client.write_coil(0, True)
    client.write(0, 100)
    time.sleep(0.02)
"""


def writing_client(port):
    return subprocess.Popen([sys.executable, "-c", WRITING, str(Path(__file__).parent), str(port)], stderr=subprocess.DEVNULL)


# pymodbus as a device: a hundred places of each kind.
DEVICE = """
import logging, sys
from pymodbus.datastore import ModbusSequentialDataBlock, ModbusServerContext, ModbusSlaveContext
from pymodbus.server import StartTcpServer
logging.disable(logging.CRITICAL)
block = lambda: ModbusSequentialDataBlock(0, [0] * 100)
slave = ModbusSlaveContext(di=block(), co=block(), hr=block(), ir=block(), zero_mode=True)
StartTcpServer(context=ModbusServerContext(slaves=slave, single=True), address=("127.0.0.1", int(sys.argv[1])),
               allow_reuse_address=True)
"""


class Device:
    def __init__(self, port=None):
        self.port = port or free_port()
        self.process = subprocess.Popen([sys.executable, "-c", DEVICE, str(self.port)], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        if not wait_until(self.answers):
            self.kill()
            raise AssertionError("pymodbus does not begin")

    def answers(self):
        try:
            socket.create_connection(("127.0.0.1", self.port)).close()
            return True
        except OSError:
            return False

    def kill(self):
        self.process.send_signal(signal.SIGCONT)
        self.process.kill()
        self.process.wait()
