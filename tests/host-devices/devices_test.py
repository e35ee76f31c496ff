#!/usr/bin/env python3
"""rung-run with devices of this machine, and the programs of the scenarios: devices_test.py BIN

A serial port is a pseudo terminal, a PLC table a file, a shared area a file that this process maps, too."""
import fcntl
import mmap
import os
import pty
import random
import re
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import termios
import time
import unittest
import xml.etree.ElementTree as xml
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "connections"))
from sides import Host
from patience import patience, wait_until
from root import go_to_root

BIN = None
OK, USAGE, ENVIRONMENT = 0, 2, 3
PROGRAMS = Path("tests/scenarios/technol")
MAP = '[rungctl]\npermissions = ["set"]\n'


def word(text):
    """Four characters as the program's memory has them."""
    return struct.unpack("<I", text.encode())[0]


class WithHost(unittest.TestCase):
    def begin(self, program, *options):
        self.host = Host(BIN, MAP, options=options, program=PROGRAMS / program)
        self.addCleanup(self.host.end)
        self.host.pass_by(2)  # edges count from the first scan on

    def set(self, name, value):
        self.host.ctl("set", name, str(value))

    def sees(self, value, *names):
        self.assertTrue(wait_until(lambda: self.host.get(*names) == value),
                        f"{names} are {self.host.get(*names)}, expected {value}\n{self.host.logged()}")

    def says(self, text):
        self.assertTrue(wait_until(lambda: text in self.host.logged()), f"no '{text}' in {self.host.logged()}")


class Com(WithHost):
    def setUp(self):
        self.master, self.slave = pty.openpty()
        os.set_blocking(self.master, False)
        self.begin("com.plc", "--com", f"1={os.ttyname(self.slave)}")

    def tearDown(self):
        for end in (self.master, self.slave):
            if end is not None:
                os.close(end)

    def read(self, count):
        got = b""
        def more():
            nonlocal got
            try:
                got += os.read(self.master, 1024)
            except BlockingIOError:
                pass
            return len(got) >= count
        wait_until(more)
        return got

    def unread(self):
        """How many bytes the port's thread has not taken yet."""
        return struct.unpack("i", fcntl.ioctl(self.slave, termios.FIONREAD, bytes(4)))[0]

    def test_bytes_go_both_ways(self):
        self.set("DWRD.LINE", word("ABCD"))
        self.set("COUNT", 3)
        self.set("DO1", 1)
        self.assertEqual(self.read(5), b"A\rABC")
        os.write(self.master, b"12")
        self.assertTrue(wait_until(lambda: self.unread() == 0))
        self.host.pass_by(10)
        self.set("DO2", 1)
        self.sees((0x31, 0x32, False, False), "CODE", "GOT", "NONE1", "NONE2")
        self.set("DO2", 1)
        self.sees((True, True), "NONE1", "NONE2")

    def test_bytes_that_the_program_does_not_take(self):
        os.write(self.master, b"x" * 1500)
        self.says("bytes were lost, because the program does not read them")

    def test_a_device_that_goes(self):
        os.close(self.master)
        os.close(self.slave)
        self.master = self.slave = None
        self.says("has gone: Input/output error")
        self.set("DO3", 1)
        self.sees(9, "CODE")  # it continues


class Tables(WithHost):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.file = Path(self.folder.name) / "tools.PlcT"
        shutil.copy(PROGRAMS / "tools.PlcT", self.file)

    def run_tables(self):
        self.begin("tables.plc", "--config", f"PlcTableDef3={PROGRAMS}/tools.PlcTDef", "--config", f"PlcTable3={self.file}")

    def element(self, line, column):
        """Of the file, which parses at any time."""
        found = xml.parse(self.file).find(f"Line[@No='{line}']/Col[@ColID='{column}']")
        return None if found is None else found.text

    def write(self, text):
        """The last of what the program writes into Life of line 1."""
        self.set("DWRD.BYTES", word(text))
        for edge in (0, 1):
            self.set("GO_SET", edge)
            self.host.pass_by(2)
        self.sees(False, "SETS")

    def test_reading_and_writing(self):
        self.run_tables()
        self.set("LINE", 1)
        self.set("COL", 1)
        self.set("GO_INT", 1)
        self.sees((100, False), "POS", "FAILED")
        self.set("GO_STR", 1)
        self.sees((word("DrDr"), 0x6C69), "DWRD.NAME", "WORD.NAME+4")  # Drill, and Dril from the third character on
        self.set("GO_COL", 1)
        self.sees((2, 2), "COL", "KIND")
        self.write("ABCD")
        self.assertTrue(wait_until(lambda: self.element(1, "Life") == str(word("ABCD"))), self.file.read_text())

    def test_a_table_that_is_not_there(self):
        self.begin("tables.plc")
        self.set("GO_INT", 1)
        self.sees((1, True), "CODE", "FAILED")

    def test_a_file_that_does_not_parse_is_left_alone(self):
        self.file.write_text("<PLCTable>")
        before = self.file.read_bytes()
        self.run_tables()
        self.says(f"{self.file}:1:")
        self.set("GO_INT", 1)
        self.sees((1, True), "CODE", "FAILED")
        self.assertEqual(self.host.end(), OK)
        self.assertEqual(self.file.read_bytes(), before)

    def test_it_is_stored_at_most_once_a_second_and_at_the_end(self):
        self.run_tables()
        versions = set()
        begin = time.monotonic()
        number = 0
        while number <= 5 or time.monotonic() - begin < 3.5:
            number += 1
            self.write("".join(random.choice("ABCDEFGH") for _ in range(4)))
            versions.add(self.file.stat().st_mtime_ns)
        self.assertLessEqual(len(versions), time.monotonic() - begin + 1.5)
        self.write("ZZZZ")
        self.assertEqual(self.host.end(), OK)
        self.assertEqual(self.element(1, "Life"), str(word("ZZZZ")))

    def test_a_host_that_is_killed_leaves_a_whole_file(self):
        last = 100
        for _ in range(8):
            self.run_tables()
            text = "".join(random.choice("ABCDEFGH") for _ in range(4))
            self.write(text)
            time.sleep(random.uniform(0, 1.2))
            self.host.process.send_signal(signal.SIGKILL)
            self.assertEqual(self.host.end(), -signal.SIGKILL)
            self.assertEqual(self.element(0, "Life"), "-5")
            self.assertIn(int(self.element(1, "Life")), (last, word(text), -128, 0))  # or what it has written before
            last = int(self.element(1, "Life"))


class Areas(WithHost):
    """The layout is that of machine/io/shared/shared_areas.h; two areas of 32000 bytes."""
    BYTES = 32000

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.path = Path(self.folder.name) / "areas"
        self.begin("shared-area.plc", "--sa-file", str(self.path))
        self.file = open(self.path, "r+b")
        self.addCleanup(self.file.close)
        fcntl.flock(self.file, fcntl.LOCK_SH)
        self.map = mmap.mmap(self.file.fileno(), 0)
        self.assertEqual(self.map[:8], b"RUNG-SA\0")
        _, size, areas, each, _, self.first = struct.unpack_from("<8x6I", self.map)
        self.assertEqual((size, areas, each), (len(self.map), 2, self.BYTES))

    def test_both_sides_see_what_the_other_writes(self):
        struct.pack_into("<d", self.map, self.first + 100, 2.5)
        second = self.first + self.BYTES
        self.map[second + 100:second + 106] = b"ABCDEF"
        self.set("OFFS", 100)
        self.set("SIZE", 6)
        self.set("GO1", 1)
        bits = struct.unpack("<q", struct.pack("<d", 2.5))[0]
        self.sees((bits, word("ABCD"), 0x4645), "FEED", "DWRD.NAME", "WORD.NAME+4")
        self.set("OFFS", 200)
        self.set("DWRD.NAME", word("XYZ\0"))
        self.set("SIZE", 3)
        self.set("GO2", 1)
        self.assertTrue(wait_until(lambda: self.map[second + 200:second + 204] == b"XYZ\0"))
        self.assertEqual(struct.unpack_from("<d", self.map, self.first + 200)[0], 2.5)

    def test_a_file_that_is_shortened(self):
        self.set("SIZE", 6)
        os.truncate(self.path, 100)
        self.set("GO1", 1)
        self.sees(3, "CODE")
        self.says("the file of the shared areas was written over or shortened")


class Recorded(WithHost):
    """What devices and a simulated control write is in the recording, so that rungc plays it without them."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.recording = Path(folder.name) / "recording"
        self.map = MAP + f'[recording]\nfolder = "{self.recording}"\n'

    def replay(self, *words, commands=""):
        done = subprocess.run([BIN / "rungc", "replay", self.recording, *words], input=commands, capture_output=True, text=True, timeout=patience())
        self.assertEqual(done.returncode, OK, done.stdout + done.stderr)
        return done.stdout

    def is_played(self):
        """Ends the host, and plays all of its scans."""
        scans = self.host.status()["scans"]
        self.assertEqual(self.host.end(), OK)
        segment, = self.recording.glob("*.rec")
        self.assertEqual(struct.unpack_from("<I", segment.read_bytes(), 12), (2,))
        said = re.search(r"(\d+) scans do what was recorded", self.replay(commands="compare\n"))
        self.assertIsNotNone(said)
        self.assertGreaterEqual(int(said[1]), scans)

    def test_a_serial_port(self):
        master, slave = pty.openpty()
        self.addCleanup(os.close, master)
        self.addCleanup(os.close, slave)
        self.host = Host(BIN, self.map, options=["--com", f"1={os.ttyname(slave)}"], program=PROGRAMS / "com.plc")
        self.addCleanup(self.host.end)
        self.host.pass_by(2)
        os.write(master, b"12")
        self.host.pass_by(10)
        self.set("DO2", 1)
        self.sees((0x31, 0x32), "CODE", "GOT")
        self.set("DO2", 1)
        self.sees((True, True), "NONE1", "NONE2")
        self.is_played()
        self.assertIn("0x32", self.replay("--show", "GOT"))

    def test_a_simulated_control(self):
        self.host = Host(BIN, self.map, options=["--simulate", "--config", "param.2402=0"],
                         program=Path("tests/scenarios/gsk/nc-mst.pmc").read_text())
        self.addCleanup(self.host.end)
        self.host.pass_by(2)
        self.set("X8.4", 1)  # no emergency stop
        self.sees((0x20, False), "F3", "F1.1")
        self.host.ctl("event", "program", "blocks=O12 N10 M3 S1500; N20 T5; N30 M30")
        for value in (1, 0):
            self.set("X7.2", value)
            self.host.pass_by(12)
        self.sees((3, 1500), "F10:4", "F22:4")
        self.host.pass_by(12)
        self.is_played()
        self.assertRegex(self.replay("--find", "rises F7.0"), r"scan \d+")  # the strobe of M3


class Mistakes(unittest.TestCase):
    def refused(self, options, status, text, program=PROGRAMS / "com.plc"):
        host = Host(BIN, MAP, options=options, program=program)
        log = host.logged()
        self.assertEqual(host.end(), status, log)
        self.assertIn(text, log)

    def test_options(self):
        for options, status, text in ((["--can", "3=can0"], USAGE, "--can: a CAN channel is 1=INTERFACE or 2=INTERFACE, not '3=can0'"),
                                      (["--com", "1"], USAGE, "--com: a serial port is NUMBER=DEVICE with a number of 0 to 15, not '1'"),
                                      (["--com", "1=/dev/null", "--config", "COM[1].ComSpeed=12345"], ENVIRONMENT, "COM 1: /dev/null: no serial port has 12345 bit/s"),
                                      (["--config", "axes=XYZ"], USAGE, "--config: 'axes' is not a key of a device"),
                                      (["--config", "COM"], USAGE, "--config: found COM, expected KEY=VALUE"),
                                      (["--com", "1=/dev/null", "--simulate"], USAGE, "--simulate")):
            self.refused(options, status, text)

    def test_other_dialects(self):
        with tempfile.TemporaryDirectory() as folder:
            program = Path(folder) / "p.pmc"
            program.write_text("dialect gsk\nFUNC END1\nFUNC END2\n")
            self.refused(["--com", "1=/dev/null"], USAGE, "are only for programs of TECHNOL; this one is of gsk", program)


if __name__ == "__main__":
    go_to_root()
    BIN = Path(sys.argv.pop(1)).resolve()
    unittest.main()
