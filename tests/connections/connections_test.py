#!/usr/bin/env python3
"""Pins of rung-run by Modbus TCP and shared memory, and what goes wrong at the other side: connections_test.py BIN"""
import mmap
import os
import random
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

from pymodbus.client import ModbusTcpClient

from sides import PINS, Cable, Client, Device, Host, frame, free_port, writing_client
from patience import patience, wait_until
from root import go_to_root

BIN = None
OK, WRONG, USAGE, ENVIRONMENT = 0, 1, 2, 3
SERVER = """[modbus-server]
port = {port}
timeout = 1
status = "ok"
[modbus-server.coils]
run = 0
door = {{ at = 1, safe = true }}
other-is = 2
[modbus-server.discrete-inputs]
lamp = 0
door-is = 1
[modbus-server.holding-registers]
speed = {{ at = 0, safe = -5 }}
turns = {{ at = 1, format = "s32", order = "high-first" }}
load = {{ at = 3, format = "f32", order = "low-first", safe = "hold" }}
[modbus-server.input-registers]
speed-is = 0
turns-is = {{ at = 1, format = "s32", order = "low-first" }}
load-is = {{ at = 3, format = "f32", order = "high-first" }}
"""
FUNCTION, ADDRESS, VALUE = 1, 2, 3  # exceptions of Modbus
# TECHNOL: at its end RUNS goes off, and the program waits until ANSWERS is off, too.
ENDING = """DATA
        DFM RUNS,ANSWERS
DATA_END
MODULE_INPUT
MODULE_INPUT_END
MODULE_BLOCK_INIT
MODULE_BLOCK_INIT_END
MODULE_BLOCK_DONE
MODULE_BLOCK_DONE_END
MODULE_MAIN
        MECH_BEGIN SHUT
        FL 0,RUNS
        EX
        LDR ANSWERS
        EX1
        MODULE_DONE_FINISHED
        MECH_END SHUT
MODULE_MAIN_END
MODULE_INIT
        FL 1,RUNS
MODULE_INIT_END
MODULE_DONE
        FL 1,SHUT
MODULE_DONE_END
MODULE_CLEAR
MODULE_CLEAR_END
MODULE_HALT
MODULE_HALT_END
STOP
"""


class WithHost(unittest.TestCase):
    def begin(self, connections, options=()):
        self.host = Host(BIN, PINS + connections, options=options)
        self.addCleanup(self.end_host)

    def end_host(self):
        log = self.host.logged()
        self.assertEqual(self.host.end(), OK, log)

    def sees(self, value, *names, again=lambda: None):
        """The program has these values before long; `again` is done before each look, by a side that is not to fall silent."""
        def seen():
            again()
            return self.host.get(*names) == value

        self.assertTrue(wait_until(seen), f"{names} are {self.host.get(*names)}, expected {value}\n{self.host.logged()}")

    def connection(self):
        return self.host.status()["connections"][0]


class WithServer(WithHost):
    def server(self, more="timeout = 1"):
        self.port = free_port()
        self.begin(SERVER.format(port=self.port).replace("timeout = 1", more))

    def client(self, port=None):
        made = Client(port or self.port)
        self.addCleanup(made.close)
        return made

    def keeps_working(self, client=None):
        """Somebody else is served as ever."""
        client = client or self.client()
        for value in (11, 12):
            self.assertEqual(client.write(0, value), struct.pack(">BHH", 16, 0, 1))
            self.assertTrue(wait_until(lambda: client.read(0, 1) == (value,)))


class Server(WithServer):
    def setUp(self):
        self.server()

    def test_values_go_both_ways_by_pymodbus(self):
        client = ModbusTcpClient("127.0.0.1", port=self.port)
        self.assertTrue(client.connect())
        self.addCleanup(client.close)
        client.write_coils(0, [True, True], slave=1)
        self.assertFalse(client.write_registers(0, [0xFFFE, 0x1234, 0x5678], slave=1).isError())
        low, high = struct.unpack(">HH", struct.pack(">f", 1.5))[::-1]
        client.write_registers(3, [low, high], slave=1)
        self.sees((True, True, -2, 0x12345678, 150, True), "X0.0", "X0.1", "D8:2", "D12:4", "D16:4", "X0.7")
        client.write_coil(0, True, slave=1)
        self.assertTrue(wait_until(lambda: client.read_discrete_inputs(0, 2, slave=1).bits[:2] == [True, True]))
        outputs = [0xFFFE, 0x5678, 0x1234, *struct.unpack(">HH", struct.pack(">f", 1.5))]
        self.assertTrue(wait_until(lambda: client.read_input_registers(0, 5, slave=1).registers == outputs))
        self.assertEqual(client.read_coils(0, 3, slave=1).bits[:3], [True, True, False])

    def test_values_by_mbpoll(self):
        def mbpoll(*words):
            return subprocess.run(["mbpoll", "-m", "tcp", "-p", str(self.port), "-0", "-1", *words], capture_output=True, text=True, timeout=patience())
        self.assertEqual(mbpoll("-r", "0", "-t", "4", "127.0.0.1", "321").returncode, 0)
        self.sees(321, "D8:2")
        mbpoll("-r", "0", "-t", "4", "127.0.0.1", "322")
        self.assertTrue(wait_until(lambda: "322" in mbpoll("-r", "0", "-t", "3", "127.0.0.1").stdout or mbpoll("-r", "0", "-t", "4", "127.0.0.1", "322") is None))
        done = mbpoll("-r", "0", "-t", "1:", "127.0.0.1", "1")  # no such kind: its own mistake
        self.assertNotEqual(done.returncode, 0)

    def test_only_inputs_are_written(self):
        client = self.client()
        for pdu, exception in (
            (struct.pack(">BHH", 5, 2, 0xFF00), ADDRESS),                   # the coil of an output
            (struct.pack(">BHHBB", 15, 0, 3, 1, 7), ADDRESS),               # with inputs before it
            (struct.pack(">BHH", 5, 3, 0xFF00), ADDRESS),                   # no coil
            (struct.pack(">BHH", 6, 5, 1), ADDRESS),                        # no register
            (struct.pack(">BHH", 6, 1, 1), ADDRESS),                        # half a value
            (struct.pack(">BHHBHH", 16, 0, 2, 4, 1, 2), ADDRESS),           # a value and a half
            (struct.pack(">BHHBHHH", 16, 2, 3, 6, 1, 2, 3), ADDRESS),
            (struct.pack(">BHHBHH", 16, 3, 2, 4, 0, 0x7FC0), VALUE),        # not a number
            (struct.pack(">BHH", 1, 0, 4), ADDRESS),
            (struct.pack(">BHH", 4, 0, 6), ADDRESS),
            (struct.pack(">BHH", 3, 0xFFFF, 2), ADDRESS),
            (struct.pack(">BHH", 3, 0, 0), VALUE),
            (struct.pack(">BHH", 3, 0, 126), VALUE),
            (struct.pack(">BHH", 1, 0, 2001), VALUE),
            (struct.pack(">BHH", 5, 0, 1), VALUE),
            (struct.pack(">BHHBB", 15, 0, 2, 2, 3), VALUE),                 # wrong lengths
            (struct.pack(">BHHBH", 16, 0, 1, 4, 3), VALUE),
            (struct.pack(">BHHB", 16, 0, 1, 2), VALUE),
            (struct.pack(">BH", 3, 0), VALUE),
            (struct.pack(">B", 3), VALUE),
            (struct.pack(">BHH", 3, 0, 1) + b"x", VALUE),
            (struct.pack(">BHHH", 22, 0, 1, 1), FUNCTION),
            (struct.pack(">BHHHHBH", 23, 0, 1, 0, 1, 2, 1), FUNCTION),
            (b"\x2b\x0e\x01\x00", FUNCTION),
            (b"\x00", FUNCTION),
            (b"\x7f" + b"x" * 200, FUNCTION),
        ):
            self.assertEqual(client.ask(pdu), bytes([pdu[0] & 0xFF | 0x80, exception]), pdu.hex())
        self.assertEqual(self.host.get("D8:2", "D12:4", "D16:4", "X0.0", "X0.1", "Y0.2"), (-5, 0, 0, False, True, False))
        self.assertFalse(self.connection()["alive"])  # nothing was written
        self.keeps_working(client)
        for wrong in (frame(b"\xff\x00"), b"\0\1\0\1\0\6" + bytes(6), b"\0\1\0\0\0\1" + bytes(6), b"\0\1\0\0\1\0" + bytes(6), b"GET / HTTP"):
            lost = self.client()
            lost.socket.sendall(wrong)
            self.assertIsNone(lost.answer(), wrong)

    def test_a_client_that_is_killed(self):
        writing = writing_client(self.port)
        self.addCleanup(writing.kill)
        self.sees((True, 100, True), "X0.0", "D8:2", "X0.7")
        writing.kill()
        writing.wait()
        self.sees((False, -5, True, False), "X0.0", "D8:2", "X0.1", "X0.7")
        self.assertTrue(wait_until(lambda: "lost; its inputs have their safe values" in self.host.logged()))
        self.assertEqual((self.connection()["alive"], self.connection()["losses"]), (False, 1))
        # Who comes back has not written all of them yet: the others are safe, not as they were.
        client = self.client()
        self.sees((False, 7, True), "X0.0", "D8:2", "X0.7", again=lambda: client.write(0, 7))

    def test_a_client_that_is_stopped(self):
        writing = writing_client(self.port)
        self.addCleanup(writing.kill)
        self.sees((True, 100), "X0.0", "D8:2")
        writing.send_signal(signal.SIGSTOP)
        self.sees((False, -5, False), "X0.0", "D8:2", "X0.7")
        self.keeps_working()
        writing.send_signal(signal.SIGCONT)
        self.sees((True, 100, True), "X0.0", "D8:2", "X0.7")
        writing.kill()
        writing.wait()

    def test_a_cable_that_is_pulled(self):
        cable = Cable(self.port)
        self.addCleanup(cable.close)
        client = self.client(cable.port)
        self.assertIn(f"pin load holds its last value while modbus-server 127.0.0.1:{self.port} is lost\n", self.host.logged())
        client.write(3, 0, 0x3F80)  # a value that is held
        self.sees((9, 100, True), "D8:2", "D16:4", "X0.7", again=lambda: client.write(0, 9))
        cable.pulled.set()
        self.sees((-5, 100, False), "D8:2", "D16:4", "X0.7")
        cable.pulled.clear()
        self.sees((10, 100, True), "D8:2", "D16:4", "X0.7", again=lambda: client.write(0, 10))

    def test_a_reader_does_not_keep_a_dead_writer_alive(self):
        writer, reader = self.client(), self.client()
        self.sees(9, "D8:2", again=lambda: writer.write(0, 9))
        self.assertTrue(wait_until(lambda: reader.read(0, 1) and self.host.get("D8:2", "X0.7") == (-5, False)))

    def is_read(self, client):
        """Whether the server has taken all bytes of the client from its socket, as the kernel tells."""
        ends = [f"0100007F:{port:04X}" for port in (self.port, client.socket.getsockname()[1])]
        rows = [line.split() for line in Path("/proc/net/tcp").read_text().splitlines()]
        return next(row[4].endswith(":00000000") for row in rows if row[1:3] == ends)

    def test_bytes_in_pieces_are_one_message(self):
        client = self.client()
        for byte in frame(struct.pack(">BHHBH", 16, 0, 1, 2, 78)):
            client.socket.sendall(bytes([byte]))
            self.assertTrue(wait_until(lambda: self.is_read(client)))
        self.assertEqual(client.answer(), struct.pack(">BHH", 16, 0, 1))
        self.sees(78, "D8:2")

    def test_messages_together_are_answered_one_by_one(self):
        client = self.client()
        client.socket.sendall(b"".join(frame(struct.pack(">BHH", 4, 0, 1), transaction=i) for i in range(100)))
        for _ in range(100):
            self.assertEqual(len(client.answer()), 4)

    def test_mutated_messages_do_no_harm(self):
        """From a seed: bytes of good messages changed, removed, doubled."""
        chance = random.Random(4711)
        good = [frame(pdu) for pdu in (struct.pack(">BHH", 3, 0, 5), struct.pack(">BHH", 4, 1, 2), struct.pack(">BHH", 1, 0, 3),
                                       struct.pack(">BHHBB", 15, 0, 2, 1, 3), struct.pack(">BHHBHHH", 16, 0, 3, 6, 1, 2, 3),
                                       struct.pack(">BHH", 5, 0, 0xFF00), struct.pack(">BHH", 6, 0, 1))]
        for _ in range(600):
            data = bytearray(chance.choice(good))
            for _ in range(chance.randint(1, 4)):
                at = chance.randrange(len(data))
                change = chance.randrange(4)
                if change == 0:
                    data[at] = chance.randrange(256)
                elif change == 1:
                    data[at] ^= 1 << chance.randrange(8)
                elif change == 2 and len(data) > 1:
                    del data[at]
                else:
                    data[at:at] = data[at:at + chance.randrange(1, 9)]
            client = Client(self.port)
            client.socket.sendall(bytes(data) + good[0])
            client.socket.shutdown(socket.SHUT_WR)
            client.socket.settimeout(patience())
            try:
                while client.socket.recv(4096):
                    pass
            except (ConnectionError, TimeoutError):
                pass
            client.close()
        self.assertEqual(self.host.get("Y0.2"), False)  # not an input
        self.keeps_working()


class Limits(WithServer):
    def test_a_client_that_stops_in_mid_message(self):
        self.server("timeout = 3")
        half = self.client()
        whole = frame(struct.pack(">BHHBH", 16, 0, 1, 2, 77))
        half.socket.sendall(whole[:9])
        self.keeps_working()
        half.socket.setblocking(False)
        with self.assertRaises(BlockingIOError, msg="the others were served after it"):
            half.socket.recv(1)
        half.socket.settimeout(patience())
        self.assertNotEqual(self.host.get("D8:2"), 77)
        self.assertIsNone(half.answer(), "it is not waited for")

    def test_as_many_clients_as_may_be(self):
        self.server("timeout = 1\nconnections = 2")
        first, second = self.client(), self.client()
        first.write(0, 1)
        second.write(0, 2)
        third = self.client()
        self.assertIsNone(third.write(0, 3), "there are two")
        self.sees(2, "D8:2", again=lambda: second.write(0, 2))

        def comes_in():
            second.write(0, 2)
            return self.client().write(0, 4) == struct.pack(">BHH", 16, 0, 1)

        self.assertTrue(wait_until(comes_in), "the place of one that is silent for longer is not free")
        self.assertIsNone(first.write(0, 1))
        self.assertEqual(second.write(0, 2), struct.pack(">BHH", 16, 0, 1))

    def test_no_more_requests_than_may_be(self):
        self.server("timeout = 0.5\nrequests = 100")
        client = self.client()

        def enough():
            """In a second. A busy machine may leave the client less, and nothing lets it have more."""
            begin, count = time.monotonic(), 0
            while time.monotonic() - begin < 1:
                client.write(0, count)
                count += 1
            self.assertLess(count, 30 + 100 * (time.monotonic() - begin))
            return count > 70

        self.assertTrue(wait_until(enough))

    def test_a_client_that_floods(self):
        """It sends without end and takes no answers; another one is served, and the scans come as ever."""
        self.server("timeout = 0.5\nrequests = 500")
        client = self.client()
        client.write(0, 0)
        flood = socket.create_connection(("127.0.0.1", self.port))
        self.addCleanup(flood.close)
        flood.setblocking(False)
        data = frame(struct.pack(">BHH", 4, 0, 5)) * 200

        def as_ever():
            """In a second of the flood. A busy machine may leave the host and the client less, which is no fault of theirs."""
            nonlocal flood
            steps = self.host.status()["clock"]["steps"]
            begin, served = time.monotonic(), 0
            while time.monotonic() - begin < 1:
                try:
                    flood.send(data)
                except BlockingIOError:
                    pass
                except ConnectionError:
                    flood = socket.create_connection(("127.0.0.1", self.port))
                    self.addCleanup(flood.close)
                    flood.setblocking(False)
                self.assertIsNotNone(client.write(0, served % 100))
                served += 1
            return served > 100 and self.host.status()["clock"]["steps"] - steps > 500  # of 1000

        self.assertTrue(wait_until(as_ever))
        self.sees(True, "X0.7", again=lambda: client.write(0, 0))


CLIENT = """[[modbus-client]]
host = "127.0.0.1"
port = {port}
period = 0.02
timeout = 1
status = "ok"
[modbus-client.discrete-inputs]
door = {{ at = 4, safe = true }}
[modbus-client.coils]
run = 0
lamp = 1
[modbus-client.holding-registers]
speed = {{ at = 0, safe = -5 }}
turns = {{ at = 1, format = "s32", order = "high-first" }}
speed-is = 10
turns-is = {{ at = 11, format = "s32", order = "low-first" }}
load-is = {{ at = 20, format = "f32", order = "high-first" }}
[modbus-client.input-registers]
load = {{ at = 0, format = "u16", safe = "hold" }}
"""


class ClientSide(WithHost):
    def panel(self, port):
        """Another client of the device, who sees and sets what is in it."""
        made = ModbusTcpClient("127.0.0.1", port=port)
        self.assertTrue(made.connect())
        self.addCleanup(made.close)
        return made

    def registers(self, panel, first, count):
        return panel.read_holding_registers(first, count, slave=1).registers


class ClientOfDevice(ClientSide):
    def begin_with(self, port):
        self.begin(CLIENT.format(port=port))

    def set(self, panel, speed):
        panel.write_registers(0, [speed & 0xFFFF, 0xFFFF, 0xFFF0], slave=1)
        panel.write_coil(0, True, slave=1)

    def test_values_go_both_ways(self):
        device = Device()
        self.addCleanup(device.kill)
        self.begin_with(device.port)
        panel = self.panel(device.port)
        self.set(panel, -300)
        self.sees((True, -300, -16, True), "X0.0", "D8:2", "D12:4", "X0.7")
        self.assertTrue(wait_until(lambda: self.registers(panel, 10, 3) == [0xFED4, 0xFFF0, 0xFFFF]))
        self.assertTrue(wait_until(lambda: panel.read_coils(1, 1, slave=1).bits[0]))  # with a later exchange, perhaps

    def test_a_device_that_is_killed_and_comes_back(self):
        device = Device()
        self.addCleanup(device.kill)
        self.begin_with(device.port)
        self.set(self.panel(device.port), 3)
        self.sees((True, 3, False, True), "X0.0", "D8:2", "X0.1", "X0.7")
        device.kill()
        self.sees((False, -5, True, False), "X0.0", "D8:2", "X0.1", "X0.7")
        self.assertIn("cannot connect: Connection refused", self.connection()["problem"])
        again = Device(device.port)
        self.addCleanup(again.kill)
        self.sees((0, True), "D8:2", "X0.7")
        self.set(self.panel(device.port), 4)
        self.sees((True, 4), "X0.0", "D8:2")
        self.assertEqual(self.connection()["losses"], 1)

    def test_a_device_that_hangs(self):
        device = Device()
        self.addCleanup(device.kill)
        self.begin_with(device.port)
        self.sees(True, "X0.7")
        device.process.send_signal(signal.SIGSTOP)
        self.sees((-5, False), "D8:2", "X0.7")
        steps = self.host.status()["clock"]["steps"]
        self.assertTrue(wait_until(lambda: self.host.status()["clock"]["steps"] > steps + 100))  # the scan waits for nobody
        device.process.send_signal(signal.SIGCONT)
        self.sees((0, True), "D8:2", "X0.7")

    def test_a_cable_that_is_pulled(self):
        device = Device()
        self.addCleanup(device.kill)
        cable = Cable(device.port)
        self.addCleanup(cable.close)
        self.begin_with(cable.port)
        self.sees(True, "X0.7")
        cable.pulled.set()
        self.sees((-5, False), "D8:2", "X0.7")
        cable.pulled.clear()
        self.sees((0, True), "D8:2", "X0.7")

    def test_another_unit_answers(self):
        device = Device()
        self.addCleanup(device.kill)
        cable = Cable(device.port, lambda data: data[:6] + b"\x04" + data[7:])
        self.addCleanup(cable.close)
        self.begin_with(cable.port)
        self.set(self.panel(device.port), 3)
        self.assertTrue(wait_until(lambda: self.connection()["problem"].endswith(": Response not from requested slave")), self.connection())
        self.assertEqual(self.host.get("D8:2", "X0.7"), (-5, False))
        cable.answer = lambda data: data
        self.sees((3, True), "D8:2", "X0.7")

    def test_a_device_that_answers_too_slowly(self):
        """Each answer in time, but not an exchange; then each answer too late."""
        device = Device()
        self.addCleanup(device.kill)
        cable = Cable(device.port, lambda data: time.sleep(0.4) or data)
        self.addCleanup(cable.close)
        self.begin_with(cable.port)
        slow = "the device answers, but too slowly: an exchange took "
        self.assertTrue(wait_until(lambda: self.connection()["problem"].startswith(slow)), self.connection())
        self.assertRegex(self.connection()["problem"], slow + r"\d{4,} ms, longer than its timeout of 1000 ms$")
        self.assertTrue(wait_until(lambda: ": lost; its inputs have their safe values\n" in self.host.logged() and slow in self.host.logged()), self.host.logged())
        cable.answer = lambda data: data
        self.assertTrue(wait_until(lambda: self.connection()["problem"] == ""), self.connection())
        cable.answer = lambda data: time.sleep(1.5) or data
        late = ": no answer within 1000 ms; the device answers, but later than that"
        self.assertTrue(wait_until(lambda: self.connection()["problem"].endswith(late)), self.connection())
        cable.answer = lambda data: data
        self.sees(True, "X0.7")

    def test_a_device_without_a_register(self):
        device = Device()
        self.addCleanup(device.kill)
        self.begin(CLIENT.format(port=device.port).replace("speed-is = 10", "speed-is = 100"))
        self.assertTrue(wait_until(lambda: "cannot write holding register 100: Illegal data address" == self.connection()["problem"]),
                        self.connection()["problem"])
        self.assertEqual(self.host.get("D8:2", "X0.7"), (-5, False))

    def test_a_device_that_answers_nonsense(self):
        """From a seed: anything but answers."""
        chance = random.Random(4711)
        with socket.create_server(("127.0.0.1", 0)) as listening:
            listening.settimeout(patience())
            self.begin_with(listening.getsockname()[1])
            for _ in range(12):
                made, _ = listening.accept()
                with made:
                    made.settimeout(patience())
                    asked = made.recv(300)
                    answer = bytearray(asked[:8] + bytes(chance.randrange(256) for _ in range(chance.randrange(260))))
                    for _ in range(chance.randrange(4)):
                        answer[chance.randrange(len(answer))] = chance.randrange(256)
                    made.sendall(answer)
            self.assertEqual(self.host.get("D8:2", "X0.7"), (-5, False))

    def test_the_device_has_safe_outputs_at_the_end(self):
        device = Device()
        self.addCleanup(device.kill)
        self.begin(CLIENT.format(port=device.port))
        panel = self.panel(device.port)
        self.set(panel, 3)
        self.assertTrue(wait_until(lambda: self.registers(panel, 10, 1) == [3]))
        self.host.process.terminate()
        self.host.process.wait(patience())
        self.assertEqual(self.registers(panel, 10, 1), [0])
        self.assertFalse(panel.read_coils(1, 1, slave=1).bits[0])


MEMORY = """[shared-memory]
name = "{name}"
period = 0.005
timeout = 1
status = "ok"
[shared-memory.pins]
run = 0
door = {{ at = 1, safe = true }}
speed = {{ at = 4, safe = -5 }}
load = 8
lamp = 0
door-is = 1
speed-is = 4
load-is = 8
"""


class Peer:
    """The other side, as docs/mapping-file.md says."""

    def __init__(self, path):
        with open(path, "r+b") as file:
            self.map = mmap.mmap(file.fileno(), 0)
        magic, version, self.outputs, self.outputs_size, self.inputs, self.inputs_size = struct.unpack_from("6I", self.map)
        assert (magic, version) == (0x474E5552, 1)

    def sequence(self, at):
        return struct.unpack_from("I", self.map, at)[0]

    def begin_writing(self):
        struct.pack_into("I", self.map, 28, self.sequence(28) | 1)

    def write(self, run, door, speed, load):
        self.write_as("??xxid", run, door, speed, load)

    def write_bits(self, *values):
        self.write_as("?" * len(values), *values)

    def write_as(self, form, *values):
        self.begin_writing()
        struct.pack_into(form, self.map, self.inputs, *values)
        struct.pack_into("I", self.map, 28, (self.sequence(28) + 1) % 2**32)

    def bit(self, at):
        """Of the outputs."""
        return struct.unpack_from("?", self.map, self.outputs + at)[0]

    def read(self):
        while True:
            before = self.sequence(24)
            values = struct.unpack_from("??xxid", self.map, self.outputs)
            if before % 2 == 0 and self.sequence(24) == before:
                return values

    def close(self):
        self.map.close()


class Memory(WithHost):
    def setUp(self):
        self.name = f"test-{os.getpid()}"
        self.path = Path(f"/dev/shm/rung-{self.name}")

    def begin_with_peer(self):
        self.begin(MEMORY.format(name=self.name))
        self.peer = Peer(self.path)
        self.addCleanup(self.peer.close)

    def refused(self, text):
        host = Host(BIN, PINS + MEMORY.format(name=self.name))
        log = host.logged()
        self.assertEqual(host.end(), ENVIRONMENT, log)
        self.assertIn(text, log)

    def test_values_go_both_ways(self):
        self.begin_with_peer()
        about = os.stat(self.path)
        self.assertEqual((about.st_mode & 0o7777, about.st_uid), (0o600, os.geteuid()))
        self.assertEqual((self.peer.outputs, self.peer.outputs_size, self.peer.inputs, self.peer.inputs_size), (32, 16, 48, 16))
        self.assertEqual(self.host.get("D8:2", "X0.1", "X0.7"), (-5, True, False))
        def exchange():
            self.peer.write(True, False, -77, 2.5)
            return self.peer.read() == (True, False, -77, 2.5)
        self.assertTrue(wait_until(exchange))
        self.assertEqual(self.host.end(), OK)
        self.assertFalse(self.path.exists())
        self.assertEqual(self.peer.read(), (False, False, 0, 0.0))  # safe values
        self.host = Host(BIN, PINS)  # for the end of the test

    def test_a_peer_that_falls_silent_and_comes_back(self):
        self.begin_with_peer()
        def write(speed):
            self.peer.write(True, False, speed, 1)
            return self.host.get("D8:2") == speed
        self.assertTrue(wait_until(lambda: write(5)))
        self.sees((False, True, -5, False), "X0.0", "X0.1", "D8:2", "X0.7")
        self.assertTrue(wait_until(lambda: write(6)))
        self.assertGreaterEqual(self.connection()["losses"], 1)

    def test_a_peer_that_dies_while_it_writes(self):
        self.begin_with_peer()
        self.peer.begin_writing()
        struct.pack_into("i", self.peer.map, self.peer.inputs + 4, 55)
        self.host.pass_by(1500 // 8)  # for longer than it may be silent
        self.assertEqual(self.host.get("D8:2", "X0.7"), (-5, False))
        self.assertTrue(wait_until(lambda: self.peer.write(True, True, 56, 1) or self.host.get("D8:2") == 56))

    def test_a_value_that_is_not_a_number(self):
        self.begin_with_peer()
        self.peer.write(True, True, 57, float("nan"))
        self.assertTrue(wait_until(lambda: self.connection()["problem"] == "the input at 8 is not a number"))
        self.assertEqual(self.host.get("D8:2"), -5)

    def test_memory_that_is_shortened(self):
        self.begin_with_peer()
        self.assertTrue(wait_until(lambda: self.peer.write(True, True, 58, 1) or self.host.get("D8:2") == 58))
        os.truncate(self.path, 0)
        self.peer.close()
        self.assertTrue(wait_until(lambda: self.connection()["problem"] != ""), "it is noticed")
        self.sees((-5, False), "D8:2", "X0.7")
        self.is_made_anew()

    def is_made_anew(self):
        """Another peer finds it as at the beginning, and the host says why it was silent."""
        self.assertTrue(wait_until(lambda: "it was created again" in self.connection()["problem"]), self.connection())
        peer = Peer(self.path)
        self.addCleanup(peer.close)
        self.assertTrue(wait_until(lambda: peer.write(True, True, 59, 1) or self.host.get("D8:2") == 59))
        self.assertEqual(self.connection()["problem"], "")

    def test_memory_that_is_removed(self):
        self.begin_with_peer()
        self.assertTrue(wait_until(lambda: self.peer.write(True, True, 58, 1) or self.host.get("D8:2") == 58))
        self.path.unlink()
        self.is_made_anew()
        self.host.end()
        self.assertFalse(self.path.exists())
        self.host = Host(BIN, PINS)  # for the end of the test

    def test_something_else_in_its_place(self):
        """It says what is there, writes nothing into it, and takes its place again when it has gone."""
        self.begin_with_peer()
        victim = Path("/dev/shm") / f"victim-{os.getpid()}"
        victim.write_text("x" * 100)
        self.addCleanup(victim.unlink)
        for make, remove, what in ((self.path.mkdir, self.path.rmdir, ": it is a folder"),
                                   (lambda: self.path.symlink_to(victim), self.path.unlink, ": it is a symbolic link"),
                                   (lambda: os.link(victim, self.path), self.path.unlink, " is not a file of its own; remove it, or write another name")):
            self.path.unlink()
            make()
            self.assertTrue(wait_until(lambda: self.connection()["problem"].endswith(f"/dev/shm/rung-{self.name}{what}")), self.connection())
            self.host.pass_by(100)
            self.assertTrue(self.connection()["problem"].endswith(what), self.connection())
            self.assertEqual(victim.read_text(), "x" * 100)
            remove()
            self.is_made_anew()

    def test_a_head_that_is_written_over(self):
        self.begin_with_peer()
        struct.pack_into("6I", self.peer.map, 0, 1, 2, 3, 4, 5, 6)
        self.is_made_anew()

    def test_what_a_killed_host_leaves_is_taken_over(self):
        self.begin_with_peer()
        self.host.process.kill()
        self.host.process.wait()
        self.assertTrue(self.path.exists())
        left = self.host
        self.host = Host(BIN, PINS + MEMORY.format(name=self.name))
        self.assertTrue(wait_until(lambda: self.peer.write(True, True, 58, 1) or self.host.get("D8:2") == 58), "the map of before is the same")
        left.end()

    def test_memory_of_others_is_not_used(self):
        victim = Path("/dev/shm") / f"victim-{os.getpid()}"
        victim.write_text("x" * 100)
        self.addCleanup(victim.unlink)
        self.path.symlink_to(victim)
        try:
            self.refused(f"cannot open /dev/shm/rung-{self.name}: it is a symbolic link")
            self.assertEqual(victim.read_text(), "x" * 100)
        finally:
            self.path.unlink()
        self.path.write_text("y" * 100)
        try:
            self.path.chmod(0o644)
            self.refused(f"/dev/shm/rung-{self.name} may be used by others than its user; remove it")
            self.path.chmod(0o600)
            if os.geteuid() == 0:
                os.chown(self.path, 65534, 65534)
                self.refused(f"/dev/shm/rung-{self.name} belongs to user 65534, expected 0, who runs this")
                os.chown(self.path, 0, 0)
            os.link(self.path, str(self.path) + "-2")
            try:
                self.refused("is not a file of its own")
            finally:
                os.unlink(str(self.path) + "-2")
            self.assertEqual(self.path.read_text(), "y" * 100)
        finally:
            self.path.unlink()

    def test_one_host_uses_it(self):
        self.begin_with_peer()
        self.refused(f"another process uses /dev/shm/rung-{self.name}; end it, or give this one another name")
        self.assertTrue(self.path.exists())


class Simulated(unittest.TestCase):
    """A part program against the simulated control, with the program of the scenario tests."""

    def begin(self, map_text, options):
        self.host = Host(BIN, map_text, options=options, program=Path("tests/scenarios/gsk/nc-mst.pmc").read_text())
        self.addCleanup(self.host.end)

    def sees(self, value, *names):
        self.assertTrue(wait_until(lambda: self.host.get(*names) == value), f"{names} are {self.host.get(*names)}, expected {value}")

    def test_the_functions_of_a_part_program(self):
        self.begin("""[rungctl]
permissions = ["set"]
[in]
start = { type = "bit", name = "X7.2" }
estop-ok = { type = "bit", name = "X8.4" }
answer = { type = "bit", name = "X10.0" }
[out]
m-code = { type = "u32", name = "F10:4" }
[shared-memory]
name = "NAME"
timeout = 60
pins = { start = 0, estop-ok = 1, answer = 2, m-code = 0 }
""".replace("NAME", f"test-{os.getpid()}"), ["--simulate", "--config", "param.2402=0"])
        peer = Peer(f"/dev/shm/rung-test-{os.getpid()}")
        self.addCleanup(peer.close)
        inputs = peer.write_bits
        inputs(False, True, False)
        self.sees(True, "F0.6")  # servo ready
        self.sees((0x20, False), "F3", "F1.1")  # automatic mode, the reset has ended
        self.host.ctl("event", "program", "blocks=O12 N10 M3 S1500; N20 T5; N30 M30")
        inputs(True, True, False)
        self.host.pass_by(12)
        inputs(False, True, False)
        self.sees((3, 1500, 5), "F10:4", "F22:4", "F7")  # M3 and S1500, with MF and SF
        self.assertTrue(wait_until(lambda: struct.unpack_from("I", peer.map, peer.outputs)[0] == 3))
        self.host.pass_by(12)
        self.assertEqual(self.host.get("F7"), 5)  # it waits for FIN
        inputs(False, True, True)
        self.sees((5, False), "F26:4", "F0.5")  # T5, and the program has ended

    def begin_machine(self, example, inputs, outputs, config, keys=""):
        """An example's project between bits by shared memory: what sets its inputs, and what waits for an output."""
        table = lambda pins: "".join(f'{pin} = {{ type = "bit", name = "{name}" }}\n' for pin, name in pins.items())
        places = [f"{pin} = {at}" for pins in (inputs, outputs) for at, pin in enumerate(pins)]
        text = (f'{keys}[rungctl]\npermissions = ["set"]\n[in]\n{table(inputs)}[out]\n{table(outputs)}[shared-memory]\nname = "test-{os.getpid()}"\n'
                f'timeout = 60\npins = {{ {", ".join(places)} }}\n')
        options = [word for key, value in config.items() for word in ("--config", f"{key}={value}")]
        self.host = Host(BIN, text, options=["--simulate", *options], program=Path("examples", example))
        self.addCleanup(self.host.end)
        peer = Peer(f"/dev/shm/rung-test-{os.getpid()}")
        self.addCleanup(peer.close)
        values = dict.fromkeys(inputs, False)

        def put(**changed):
            values.update(changed)
            peer.write_bits(*values.values())

        def on(pin, value=True):
            self.assertTrue(wait_until(lambda: peer.bit(list(outputs).index(pin)) == value), f"{pin} is never {value}\n{self.host.logged()}")

        return put, on

    def press(self, put, pin):
        put(**{pin: True})
        self.host.pass_by(4)
        put(**{pin: False})

    def test_a_part_program_of_nct(self):
        """The turning centre: machine on, chuck, automatic mode, S with M3, M5, M30."""
        put, on = self.begin_machine("nct-turning-centre",
            {"key_on": "B_ON", "monitored": "N_MONST", "k1_off": "K1_OFF", "k2_off": "K2_OFF", "pump": "KHYD_ON", "pressure": "HYD_PRESS", "pedal": "PEDAL",
              "chuck_out": "CH_OUT", "chuck_pressure": "CH_PRESS", "key_auto": "MB_AUTO", "key_start": "MB_START"},
            {"request": "P_MONREQ", "ready": "READY", "chuck_ok": "CH_OK", "runs": "CN_START", "spindle": "SP_SSTRT"},
            {"axes": "XZXZWU", "param.2.3": "2", "param.2.4": "2", "param.2.5": "2", "turning.1": "on", "turning.2": "on", "spindles": "2", "param.604.2": "2",
             "param.650.1": "1500", "param.651.1": "4000", "param.2900": "0"})
        put(k1_off=True, k2_off=True, chuck_out=True)
        for name, value in (("INP000", 0x63B31F), ("INP001", 0x227), ("INP010", 0x27), ("TN_TS1", "true"), ("SN_N0", "true"), ("SN_N0,#1", "true"), ("MKFOVER", 12)):
            self.host.ctl("set", name, str(value))
        self.sees(True, "N_ON")
        put(key_on=True)
        on("request")
        put(key_on=False, monitored=True, k1_off=False, k2_off=False)
        self.host.pass_by(60)
        put(pump=True, pressure=True)
        on("ready")
        put(pedal=True)
        self.host.pass_by(4)
        put(pedal=False, chuck_out=False, chuck_pressure=True)
        on("chuck_ok")
        self.press(put, "key_auto")
        self.sees(True, "CN_AUTO")
        self.host.ctl("event", "program", "channel=1", "number=100", "blocks=N10 S1=1200 M3; N20 M5; N30 M30")
        self.press(put, "key_start")
        on("spindle")
        self.sees(1200, "SP_PRG")
        on("runs", False)
        on("spindle", False)
        self.sees(1, "PARTS")

    def test_blocks_of_technol(self):
        """The machining centre: machine on, START, blocks with M10 and M8, texts of messages, the stop of the PLC."""
        folder = Path("examples/technol-machining-centre").resolve()
        put, on = self.begin_machine("technol-machining-centre",
            {"key_on": "P7IN.0", "main_in": "P1IN.1", "pressure": "P1IN.5", "drives_ok": "P1IN.3"},
            {"main": "P0OUT.0", "pump": "P0OUT.1", "drives": "P0OUT.2", "clamp": "P0OUT.5", "coolant": "P3OUT.1"},
            {"PlcConfig": folder / "Channel0.ChannelConfig", "PlcConstants": folder / "centre.PlcConstants"}, f'PlcErrors = "{folder}/Plc0.PlcErrors"\n')
        for name, value in (("P1IN", 0xD5), ("P2IN", 0x7F), ("P3IN", 0x40), ("P4IN", 0x65), ("P5IN", 0x54), ("P6IN", 0xAD), ("P8IN", 0x02), ("HOMING", 0x0F)):
            self.host.ctl("set", name, str(value))
        self.assertIn("part of P1IN is written before every slice, so setting it has no effect there: P1IN.1 by pin main_in, ", self.host.ctl("set", "P1IN", str(0xD5))["note"])
        self.sees(True, "STARTED")
        self.assertIn("message PLC00013 0 0 0 0 The backup memory was empty: check the tool table", self.host.logged())
        self.host.ctl("event", "CONFIRM")
        put(key_on=True)
        for output, answer in (("main", "main_in"), ("pump", "pressure"), ("drives", "drives_ok")):
            on(output)
            put(**{answer: True})
        put(key_on=False)
        self.sees(True, "READY")
        self.host.ctl("event", "PLCEVENT_START_REQ")
        self.sees(False, "START_SUSPEND")
        self.host.ctl("event", "block-start", "AUTPI=1", "M10PID=1", "BLK[0].FirstBlock=1")
        on("clamp")
        self.host.ctl("event", "block-done")
        self.sees(False, "PO_F")
        self.host.ctl("event", "block-start", "AUTPI=1", "ZMM5PI=1", "M08PI=1")
        on("coolant")
        self.host.ctl("event", "block-done")
        self.host.ctl("event", "plc-stop")
        on("main", False)
        put(main_in=False)
        self.assertNotIn("PLC00003", self.host.logged())

    def test_connections_that_do_not_fit_are_named(self):
        with tempfile.TemporaryDirectory() as folder:
            source, config = Path(folder, "p.plc"), Path(folder, "p.ChannelConfig")
            source.write_text(ENDING)
            config.write_text('<Connections>\n<Connection Source="PLC.Output.Nothing" Destination="P2IN.2" Connected="1"/></Connections>')
            host = Host(BIN, "", options=["--simulate", "--config", f"PlcConfig={config}"], program=source)
        self.addCleanup(host.end)
        self.assertIn("p.ChannelConfig:2:1: 'PLC.Output.Nothing' is not an end of a connection", host.logged())

    def test_mistakes(self):
        self.begin("", ["--simulate"])
        def refused(*words):
            done = subprocess.run([BIN / "rungctl", "event", *words], capture_output=True, text=True, env=self.host.environment)
            self.assertNotEqual(done.returncode, OK)
            return done.stderr
        self.assertIn('"set" is not allowed here', refused("reset"))
        self.assertIn("expected KEY=VALUE", refused("program", "G0"))
        self.assertEqual(self.host.end(), OK)
        self.begin('[rungctl]\npermissions = ["set"]\n', ["--simulate"])
        self.assertIn("block 1: a number is missing after 'Y'", refused("program", "blocks=G0 X7 Y"))
        self.assertIn("dance", refused("dance"))

    def test_without_a_simulation_there_are_no_events(self):
        self.begin('[rungctl]\npermissions = ["set"]\n', [])
        done = subprocess.run([BIN / "rungctl", "event", "reset"], capture_output=True, text=True, env=self.host.environment)
        self.assertIn("this host does not simulate a control; use rung-run --simulate", done.stderr)

    def test_wrong_configurations_end_it(self):
        for options, status, text in ((["--config", "a=b"], USAGE, "--simulate"),
                                      (["--simulate", "--config", "dance=1"], USAGE, "--config: "),
                                      (["--simulate", "--config", "messages=a.msg"], USAGE,
                                       "messages is read by the compiler, not by the control: build the program with rungc build --config messages=a.msg"),
                                      (["--simulate", "--config", "param"], USAGE, "--config: found param, expected KEY=VALUE")):
            host = Host(BIN, "", options=options)
            log = host.logged()
            self.assertEqual(host.end(), status, log)
            self.assertIn(text, log)


class End(unittest.TestCase):
    """MODULE_DONE of a TECHNOL program, whose machine moves."""

    def test_the_machine_answers_until_the_program_has_ended(self):
        name = f"end-{os.getpid()}"
        with tempfile.TemporaryDirectory() as folder:
            source = Path(folder, "end.plc")
            source.write_text(ENDING)
            host = Host(BIN, f"""[in]
answers = {{ type = "bit", name = "ANSWERS" }}
[out]
runs = {{ type = "bit", name = "RUNS" }}
[shared-memory]
name = "{name}"
timeout = 60
pins = {{ answers = 0, runs = 0 }}
""", program=source)
        self.addCleanup(host.end)
        peer = Peer(f"/dev/shm/rung-{name}")
        self.addCleanup(peer.close)

        peer.write_bits(True)
        self.assertTrue(wait_until(lambda: peer.bit(0) and host.get("ANSWERS")))
        host.process.terminate()
        self.assertTrue(wait_until(lambda: not peer.bit(0)))
        written = peer.sequence(24)
        self.assertTrue(wait_until(lambda: (peer.sequence(24) - written) % 2**32 >= 2 * 30), "the machine sees no outputs any more")
        self.assertIsNone(host.process.poll(), "it has not waited")
        peer.write_bits(False)
        self.assertEqual(host.end(), OK)


class Early(unittest.TestCase):
    """A thread that wakes before its steps are due."""
    PERIOD_US = 10_000

    def begin(self, *options):
        host = Host(BIN, PINS, options=["--period", str(self.PERIOD_US), *options])
        self.addCleanup(host.end)
        return host

    def seconds_of_processor(self, process):
        ticks = Path(f"/proc/{process.pid}/stat").read_text().rpartition(")")[2].split()[11:13]
        return sum(map(int, ticks)) / os.sysconf("SC_CLK_TCK")

    def share(self, *options):
        """Of the time in which the process has a processor, while 100 steps are done."""
        host = self.begin(*options)
        steps = host.status()["clock"]["steps"]
        used, at = self.seconds_of_processor(host.process), time.monotonic()
        self.assertTrue(wait_until(lambda: host.status()["clock"]["steps"] >= steps + 100))
        return (self.seconds_of_processor(host.process) - used) / (time.monotonic() - at)

    def test_it_is_awake_before_a_step(self):
        """A quarter of the time, of which a busy machine may leave it less."""
        self.assertTrue(wait_until(lambda: self.share("--early", "2500") > self.share() + 0.05))

    def test_steps_count_from_when_they_are_due(self):
        host = self.begin("--early", "2500")
        begun = time.monotonic()
        steps = host.status()["clock"]["steps"]
        self.assertTrue(wait_until(lambda: host.status()["clock"]["steps"] >= steps + 50))
        clock = host.status()["clock"]
        self.assertLessEqual((clock["steps"] - steps - 1) * self.PERIOD_US / 1e6, time.monotonic() - begun)
        self.assertGreater(clock["longest_period_us"], self.PERIOD_US - 2500)
        self.assertEqual(host.end(), OK)

    def test_bad_values(self):
        for options, text in ((["--early", "2501"], "--early: found 2501, expected 0 to 2500, a quarter of --period 10000"),
                              (["--early", "soon"], "--early"), (["--early", "-1"], "--early"), (["--early"], "--early")):
            host = self.begin(*options)
            log = host.logged()
            self.assertEqual(host.end(), USAGE, log)
            self.assertIn(text, log)


class Mistakes(unittest.TestCase):
    def refused(self, connections, status, *texts):
        host = Host(BIN, PINS + connections)
        log = host.logged()
        self.assertEqual(host.end(), status, log)
        for text in texts:
            self.assertIn(text, log)

    def test_mistakes_of_the_map_are_listed(self):
        self.refused('[modbus-server]\nport = 0\ncoils = { lmp = 0 }\n[shared-memory]\n', WRONG,
                     'p.map:17:8: modbus-server.port: found 0, expected the number of a port, 1 to 65535; write for example port = 502\n',
                     "p.map:18:11: modbus-server.coils.lmp: found no pin lmp, expected a pin of this map; did you mean lamp?\n",
                     "p.map:19:1: shared-memory: found no key name, expected")

    def test_a_port_that_is_taken(self):
        with socket.create_server(("127.0.0.1", 0)) as taken:
            port = taken.getsockname()[1]
            self.refused(f"[modbus-server]\nport = {port}\n", ENVIRONMENT,
                         f"modbus-server 127.0.0.1:{port}: cannot listen: Address already in use; another program has this port")

    def test_the_server_is_for_this_machine_alone(self):
        port = free_port()
        host = Host(BIN, PINS + f"[modbus-server]\nport = {port}\n")
        self.addCleanup(host.end)
        listening = [line.split()[3] for line in subprocess.run(["ss", "-Hltn"], capture_output=True, text=True, check=True).stdout.splitlines()]
        self.assertEqual([where for where in listening if where.endswith(f":{port}")], [f"127.0.0.1:{port}"])


if __name__ == "__main__":
    go_to_root()
    BIN = Path(sys.argv.pop(1)).resolve()
    unittest.main()
