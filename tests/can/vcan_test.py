#!/usr/bin/env python3
"""rung-run at a CAN interface of the kernel, vcan0: vcan_test.py BIN FOLDER

For a machine of its own (in_uml.py), as root: interfaces are made and switched off. FOLDER has the programs of the scenarios of
CAN, compiled."""
import json
import os
import socket
import struct
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

BIN = FOLDER = None
PATIENCE = 20
BUS_OFF, RESTARTED = 0x40, 0x100  # classes of error frames (linux/can/error.h)
FRAME = struct.Struct("=IB3x8s")


def tool(*words):
    subprocess.run(words, check=True)


def soon(condition):
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end:
        if value := condition():
            return value
        time.sleep(0.01)
    return None


class Vcan(unittest.TestCase):
    program = "can"
    options = ()
    constants = ""

    def setUp(self):
        tool("ip", "link", "add", "dev", "vcan0", "type", "vcan")
        self.addCleanup(lambda: subprocess.run(["ip", "link", "delete", "vcan0"], check=False, stderr=subprocess.DEVNULL))
        tool("ip", "link", "set", "vcan0", "up")
        self.peer = self.open_peer()
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        folder = Path(self.folder.name)
        (folder / "can.map").write_text('[rungctl]\npermissions = ["set", "reload"]\n' + self.constants, encoding="utf-8")
        self.log = open(folder / "log", "w+", encoding="utf-8")
        self.addCleanup(self.log.close)
        self.process = subprocess.Popen([BIN / "rung-run", FOLDER / f"{self.program}.so", folder / "can.map", "--can", "2=vcan0", *self.options],
                                        stderr=self.log)
        self.addCleanup(self.end)
        self.says("listening at")

    def open_peer(self):
        peer = socket.socket(socket.PF_CAN, socket.SOCK_RAW, socket.CAN_RAW)
        self.addCleanup(peer.close)
        peer.bind(("vcan0",))
        peer.settimeout(PATIENCE)
        return peer

    def end(self):
        self.process.terminate()
        self.assertEqual(self.process.wait(PATIENCE), 0, self.logged())

    def logged(self):
        return Path(self.log.name).read_text(encoding="utf-8")

    def says(self, text, times=1):
        self.assertTrue(soon(lambda: self.logged().count(text) >= times or self.process.poll() is not None), f"'{text}' in {self.logged()}")
        self.assertGreaterEqual(self.logged().count(text), times, self.logged())

    def ctl(self, *words):
        done = subprocess.run([BIN / "rungctl", *words, "--json"], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return json.loads(done.stdout)

    def get(self, name):
        return self.ctl("get", name)["values"][name]

    def order(self, bit):
        """The program does it in its next scan, and resets the bit."""
        self.ctl("set", bit, "1")
        self.assertTrue(soon(lambda: self.get(bit) is False))

    def sends(self, code):
        """CAN_SEND gives it before long."""
        def sent():
            self.order("DO1")
            return self.get("CODE") == code
        self.assertTrue(soon(sent), f"CODE is {self.get('CODE')}, expected {code}\n{self.logged()}")

    def put(self, identifier, data=b""):
        self.peer.send(FRAME.pack(identifier, len(data), data))

    def next(self, wanted):
        """The next frame with this identifier: its length and data."""
        while True:
            identifier, length, data = FRAME.unpack(self.peer.recv(16))
            if identifier == wanted:
                return length, data


class Packets(Vcan):
    def test_frames_go_both_ways(self):
        self.order("DO1")
        self.assertEqual(self.next(0x7FA | socket.CAN_RTR_FLAG)[0], 2)
        self.put(0x12345 | socket.CAN_EFF_FLAG, b"long")  # programs know 11 bits
        self.put(0x123, b"\x09\x08")
        time.sleep(0.2)
        self.order("DO2")
        self.assertEqual((self.get("CODE"), self.get("WORD.INBUF"), self.get("BYTE.INBUF+3")), (0, 0x123, 2))
        self.order("DO2")
        self.assertEqual(self.get("CODE"), 2)

    def test_an_order_runs_its_procedure(self):
        self.order("DO3")
        self.assertTrue(self.get("GIVEN"))
        self.put(0x5A1, b"\x40\x08\x10")
        self.assertTrue(soon(lambda: self.get("CALLS") == 1))
        self.assertEqual((self.get("CHANNEL"), self.get("WORD.ORDER")), (2, 0x5A1))

    def test_error_frames(self):
        self.put(socket.CAN_ERR_FLAG | BUS_OFF, bytes(8))
        self.says("CAN channel 2 is off the bus after too many errors")
        self.sends(1)
        self.put(socket.CAN_ERR_FLAG | RESTARTED, bytes(8))
        self.says("CAN channel 2 works again")
        self.sends(0)

    def test_the_interface_is_switched_off_and_goes(self):
        gone = "CAN channel 2: its interface is not there, or switched off"
        tool("ip", "link", "set", "vcan0", "down")
        self.says(gone)
        self.sends(1)
        tool("ip", "link", "set", "vcan0", "up")
        self.says("CAN channel 2 works again")
        self.sends(0)
        tool("ip", "link", "delete", "vcan0")
        self.says(gone, 2)
        tool("ip", "link", "add", "dev", "vcan0", "type", "vcan")
        tool("ip", "link", "set", "vcan0", "up")
        self.says("CAN channel 2 works again", 2)
        self.peer = self.open_peer()
        self.sends(0)


class Units(Vcan):
    """With units the control itself sends, in each millisecond."""
    options = ("--config", "CAN[1].InOut08Cnt=2")

    def test_the_control_is_the_master_of_its_units(self):
        self.next(0x80)
        self.assertEqual(self.next(0x621)[0], 8)
        self.put(0x1A1, b"\x5a\0\0\0\0\0\0\0")
        self.assertTrue(soon(lambda: self.get("P1IN") == 0x5A))
        self.assertEqual(self.next(0x221)[0], 8)
        self.says("CAN unit INOUT08 2 (node 22h) does not answer")


class Replaced(Vcan):
    """Orders of packets while one program takes the place of another."""
    program = "can-orders-1"

    def test_orders_continue_as_long_as_they_have_a_buffer(self):
        self.put(0x5A1, b"\x01\x02")
        self.assertTrue(soon(lambda: self.get("CALLS") == 1), self.logged())
        self.ctl("reload", FOLDER / "can-orders-2.so", "--yes")
        self.put(0x5A1, b"\x03\x04")
        self.assertTrue(soon(lambda: self.get("CALLS") == 2), self.logged())
        self.assertEqual((self.get("WORD.ORDER+4"), self.get("DWRD.MORE+4"), self.get("OTHERS")), (0x0403, 0, 0))
        self.ctl("reload", FOLDER / "can-orders-3.so", "--yes")
        self.says("CAN_RECV_REQ: the order with the handle 1 has ended, as the new program does not have its buffer")
        self.put(0x5A1, b"\x05\x06")
        self.assertTrue(soon(lambda: self.order("DORECV") or self.get("WORD.INBUF") == 0x5A1))
        self.assertEqual(self.get("CALLS"), 2)


class FullQueue(Vcan):
    """A packet of the program in each scan, beside those of the control, to an interface that sends little."""
    options = ("--config", "CAN[1].InOut08Cnt=1")
    constants = "[const]\nDO1 = true\n"

    def is_code(self, code):
        self.assertTrue(soon(lambda: self.get("CODE") == code), f"CODE is {self.get('CODE')}, expected {code}\n{self.logged()}")

    def test_it_is_the_error_of_the_instruction(self):
        tool("tc", "qdisc", "add", "dev", "vcan0", "root", "tbf", "rate", "8kbit", "burst", "160", "limit", "1600")
        self.says("CAN channel 2: the queue of the interface is full, packets wait")
        self.is_code(1)
        tool("tc", "qdisc", "delete", "dev", "vcan0", "root")
        self.is_code(0)


if __name__ == "__main__":
    BIN = Path(sys.argv.pop(1)).resolve()
    FOLDER = Path(sys.argv.pop(1)).resolve()
    unittest.main(verbosity=2)
