#!/usr/bin/env python3
"""Runs rungc as a user does: exit statuses, streams, diagnostics, hostile input. cli_test.py RUNGC"""
import json
import os
import re
import subprocess
import sys
import tempfile
import time
import unittest
import xml.etree.ElementTree as xml
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from patience import patience, seconds_of_children, wait_until
from root import go_to_root

RUNGC = None
OK, WRONG, USAGE, ENVIRONMENT = 0, 1, 2, 3

LAMP = """dialect nct
module MAIN

rung "start/stop latch"
|--[5100.00]--+--[/5100.01]--(5101.00)
|--[5101.00]--+
"""

LISTED = """DATA
CELL:   DS 1
DATA_END
MODULE_INPUT
MODULE_INPUT_END
MODULE_MAIN
        FL   1,M
        MECH_BEGIN M
        EX
        TIM  -,50           ; waits here
        MECH_END M
MODULE_MAIN_END
MODULE_BLOCK_INIT
MODULE_BLOCK_INIT_END
MODULE_BLOCK_DONE
MODULE_BLOCK_DONE_END
MODULE_INIT
MODULE_INIT_END
MODULE_CLEAR
MODULE_CLEAR_END
MODULE_HALT
MODULE_HALT_END

STOP
"""
GSK = "LD X0.0\nFUNC 0\n"  # a network that is not closed, and no END2
# Counts its scans in D0 (4 bytes); what stands behind `TAIL` changes how the program uses K, C, T and D.
COUNTER = """FUNC END1
LD   K0.0
LDI  K0.0
FUNC ADDB
PRM  0004
PRM  D0
PRM  1
PRM  D0
OUT  R0.0
{tail}FUNC END2
"""
SETS = "".join(f"LDI  K0.0\nSET  {bit}\n" for bit in ("K1.3", "K31.7", "D4.1", "D1859.6"))
MOVES = "".join(f"LDI  K0.0\nFUNC MOVB\nPRM  {a}\nPRM  {b}\n" for a, b in (("K1", "R10"), ("K31", "R11"), ("D4", "R12"), ("D1859", "R13")))
TECHNOL_NULL = "DATA\nDATA_END\n" + "".join(
    f"MODULE_{m}\nMODULE_{m}_END\n" for m in ("INPUT", "BLOCK_INIT", "BLOCK_DONE", "MAIN", "INIT", "CLEAR", "HALT")) + "STOP\n"


def rungc(*args, stdin=None):
    return subprocess.run([RUNGC, *args], input=stdin, capture_output=True, timeout=patience())


def wait(condition):
    if not wait_until(condition):
        raise AssertionError("it has not come")


def made(folder):
    """Whether it could be made: for a moment there may be a file of this name."""
    try:
        folder.mkdir()
    except FileExistsError:
        return False
    return True


def generation(images):
    """How often they have been stored; each time it is something new."""
    return max((int.from_bytes(path.read_bytes()[16:24], "little") for path in images if path.exists()), default=0)


def kill_after_stores(command, stores, delay, images):
    """Runs it until it has stored its images as often, kills it `delay` seconds later. It must not complain."""
    before = generation(images)
    with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE) as process:
        try:
            wait(lambda: generation(images) >= before + stores)
            time.sleep(delay)
        finally:
            process.kill()
        errors = process.stderr.read()
    if errors:
        raise AssertionError(errors.decode(errors="replace"))


class Cli(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def file(self, name, content):
        path = Path(self.folder.name) / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return str(path)

    def survives(self, path, *args, limit=60):
        """A clear error or success within a time of the processor that nobody calls a hang."""
        start = seconds_of_children()
        done = rungc("check", path, *args)
        self.assertIn(done.returncode, (OK, WRONG), done.stderr[-2000:])
        self.assertLess(seconds_of_children() - start, limit)
        if done.returncode == WRONG:
            self.assertIn(b"[", done.stderr, "an error without a code")
        return done


class Retained(Cli):
    """rungc run --retain: what a program keeps through power-off."""

    def counter(self, name="counter.pmc", tail=""):
        return self.file(name, COUNTER.format(tail=tail))

    def images(self):
        return [Path(self.folder.name) / f"image.{end}" for end in "ab"]

    def run_it(self, program, *args):
        return rungc("run", program, "--retain", str(Path(self.folder.name) / "image"), "--engine", "interp", *args)

    def read(self, program, *names):
        """The values at the end of one scan; --watch prints every name at its first value."""
        done = self.run_it(program, "--scans", "1", *(word for name in names for word in ("--watch", name)))
        self.assertEqual(done.returncode, OK, done.stderr)
        found = dict(line.split(" ms ")[1].split(" = ") for line in done.stdout.decode().splitlines() if " = " in line)
        # A negative number stands in brackets behind its form without a sign.
        return [int({key.strip(): value for key, value in found.items()}[name].split("(")[-1].rstrip(")")) for name in names]

    def running(self, program):
        """A process that runs it on the machine's clock until it is stopped."""
        command = [RUNGC, "run", program, "--retain", str(Path(self.folder.name) / "image"), "--engine", "interp",
                   "--realtime", "--for", "3600s", "--watch", "D0:4"]
        process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.addCleanup(process.kill)
        self.started()
        return process

    def scan_by(self, process, count):
        """Waits for that many scans, each of which shows its number."""
        for _ in range(count):
            self.assertIn(b" D0:4 = ", process.stdout.readline())

    def obstruct(self):
        for path in self.images():
            place = Path(f"{path}.tmp")
            wait(lambda: made(place))

    def clear(self):
        for path in self.images():
            Path(f"{path}.tmp").rmdir()

    def started(self):
        """Waits for the image that a program writes when it starts."""
        wait(lambda: any(path.exists() for path in self.images()))

    def test_goes_on_where_it_stopped(self):
        program = self.counter()
        self.assertEqual(self.run_it(program, "--scans", "70000").returncode, OK)
        self.assertEqual(self.read(program, "D0:4"), [70001])
        self.assertEqual(self.read(program, "D0:4"), [70002])

    def test_a_changed_program_keeps_all_areas(self):
        # Bits alone are laid out a byte a bit, bytes are packed: the image must not know.
        done = self.run_it(self.counter("bits.pmc", SETS), "--scans", "5")
        self.assertEqual((done.returncode, done.stderr), (OK, b""))
        names = ("K1", "K31", "D4", "D1859", "R10", "R11", "R12", "R13", "D0:4")
        self.assertEqual(self.read(self.counter("bytes.pmc", MOVES), *names), [8, -128, 2, 64, 8, -128, 2, 64, 6])
        self.assertEqual(self.read(self.counter("bits.pmc", SETS), "K1", "K31", "D4", "D1859", "D0:4"), [8, -128, 2, 64, 7])

    def test_presets_of_the_configuration_are_those_of_the_first_start(self):
        program = self.counter()
        self.run_it(program, "--config", "tmr.1=480")
        done = self.run_it(program, "--config", "tmr.1=960", "--watch", "T0:2")
        self.assertIn(b"T0:2 = 10", done.stdout)

    def test_a_changed_program_finds_its_cells_by_name(self):
        def named(place):
            return self.file("named.pmc", f"dialect gsk\nsymbol COUNT {place}\n" + COUNTER.format(tail="").replace("D0", "COUNT"))
        self.run_it(named("D0"), "--scans", "5")
        done = self.run_it(named("D20"), "--scans", "1", "--watch", "COUNT", "--watch", "D0")
        self.assertEqual(done.returncode, OK, done.stderr)
        self.assertIn(b"made by a program with other retained cells; its cells are taken by name and address: moved COUNT", done.stderr)
        self.assertIn(b"COUNT = 6", done.stdout)
        self.assertIn(b"D0 = 0", done.stdout)
        self.assertEqual(self.run_it(named("D20"), "--scans", "1").stderr, b"")

    def test_another_dialect_starts_cold_and_says_so(self):
        self.run_it(self.counter(), "--scans", "5")
        done = self.run_it(self.file("lamp.lad", LAMP))
        self.assertEqual(done.returncode, OK, done.stderr)
        self.assertIn(b"made by a program with other retained cells; that one is of the dialect gsk, this one of nct; starting cold", done.stderr)

    def test_damaged_images(self):
        program = self.counter()
        self.run_it(program, "--scans", "5")
        newest = max(self.images(), key=lambda path: path.read_bytes()[16:24][::-1])
        good = newest.read_bytes()
        newest.write_bytes(good[:100])
        done = self.run_it(program, "--watch", "D0:4")
        self.assertEqual(done.returncode, OK)
        self.assertIn(b"using the other image", done.stderr)
        for path in self.images():
            path.write_bytes(b"junk")
        done = self.run_it(program, "--watch", "D0:4")
        self.assertEqual(done.returncode, OK)
        self.assertIn(b"starting cold", done.stderr)
        self.assertIn(b"D0:4 = 1\n", done.stdout)

    def test_a_place_that_cannot_be_written(self):
        done = rungc("run", self.counter(), "--retain", "/nowhere/image")
        self.assertEqual(done.returncode, ENVIRONMENT)
        self.assertIn(b"cannot write /nowhere/image", done.stderr)

    def test_one_process_at_a_time(self):
        program = self.counter()
        with self.running(program) as process:
            done = self.run_it(program)
            self.assertEqual(done.returncode, ENVIRONMENT)
            self.assertIn(b"image is in use by another process, which holds ", done.stderr)
            process.terminate()
            self.assertEqual(process.wait(), OK)
        self.assertEqual(self.run_it(program).returncode, OK)

    def test_a_disk_that_fails_for_a_while(self):
        """A folder where the temporary file would be takes the place of a failing disk."""
        program = self.counter()
        with self.running(program) as process:
            self.obstruct()
            self.assertRegex(process.stderr.readline(), rb"rungc: warning: cannot write .*/image\..\.tmp: .*; the program continues")
            self.scan_by(process, 60)
            self.clear()
            self.assertRegex(process.stderr.readline(), rb"rungc: .*/image is saved again")
            process.terminate()
            output, errors = process.communicate()
        self.assertEqual((process.returncode, errors), (OK, b""))  # each once
        scans = int(re.search(rb"^(\d+) scans,", output, re.M)[1])
        self.assertEqual(self.read(program, "D0:4"), [scans + 1])

    def test_a_disk_that_fails_to_the_end(self):
        program = self.counter()
        with self.running(program) as process:
            self.obstruct()
            self.assertIn(b"the program continues", process.stderr.readline())
            process.terminate()
            errors = process.communicate()[1]
        self.assertEqual(process.returncode, ENVIRONMENT)
        self.assertRegex(errors, rb"\Arungc: cannot write .*/image\..\.tmp: .*\n\Z")

    def test_a_fault_leaves_the_last_whole_scan(self):
        """The program counts to 50 and does not come to the end of that scan."""
        loop = "FUNC LBL\nPRM  L1\nLD   D0.1\nAND  D0.4\nAND  D0.5\nFUNC JMPB\nPRM  L1\n"
        for clock in ([], ["--realtime"]):
            for path in self.images():
                path.unlink(missing_ok=True)
            done = self.run_it(self.counter("stops.pmc", loop), "--scans", "100", *clock)
            self.assertEqual(done.returncode, WRONG, done.stderr)
            self.assertIn(b"dead-loop", done.stderr)
            self.assertEqual(self.read(self.counter(), "D0:4"), [50])

    def test_killed_at_any_moment(self):
        program = self.counter()
        before = 0
        for delay in (0.31, 0.02, 0.5, 0.27, 0.111, 0.42):
            # In the machine's time, so that the count is a measure of it: 125 scans a second.
            command = [RUNGC, "run", program, "--retain", str(Path(self.folder.name) / "image"), "--engine", "interp",
                       "--realtime", "--for", "3600s"]
            begin = time.monotonic()
            kill_after_stores(command, 3, delay, self.images())
            scans = 125 * (time.monotonic() - begin)
            now = self.read(program, "D0:4")[0]
            self.assertGreaterEqual(now, before + 3)  # a store for each of several counts, and that of reading
            self.assertLess(now, before + scans + 2)
            before = now

    def test_an_ordinary_end_by_signal_saves(self):
        program = self.counter()
        with self.running(program) as process:
            self.scan_by(process, 20)
            process.terminate()
            output = process.communicate()[0].decode()
        scans = int(re.search(r"^(\d+) scans,", output, re.M)[1])
        self.assertEqual(self.read(program, "D0:4"), [scans + 1])


BACKUP = """DATA
SINCE: DS 4
DATA_END
MODULE_INPUT
MODULE_INPUT_END
MODULE_BLOCK_INIT
MODULE_BLOCK_INIT_END
MODULE_BLOCK_DONE
MODULE_BLOCK_DONE_END
MODULE_MAIN
        LOD DWRD.PLC_MEM_BACKUP
        AD  CNST.1
        STO DWRD.PLC_MEM_BACKUP
        LOD SINCE
        AD  CNST.1
        STO SINCE
        EQ  CNST.20
        FL1 1,REQ_BACKUP_MEM
MODULE_MAIN_END
MODULE_INIT
MODULE_INIT_END
MODULE_CLEAR
MODULE_CLEAR_END
MODULE_HALT
MODULE_HALT_END
STOP
"""


class TechnolBackup(Cli):
    """rungc run --retain with a TECHNOL program: saved at the end, and when the program asks."""

    def command(self, *args):
        program = self.file("backup.plc", BACKUP)
        return ["run", program, "--retain", str(Path(self.folder.name) / "image"), "--engine", "interp", *args]

    def count(self):
        """The count at the end of one more scan."""
        done = rungc(*self.command("--scans", "1", "--watch", "PLC_MEM_BACKUP+0:4"))
        self.assertEqual(done.returncode, OK, done.stderr)
        return int(done.stdout.decode().split(" = ")[1].split()[0])

    def test_saved_at_a_regular_end(self):
        self.assertEqual(rungc(*self.command("--scans", "7")).returncode, OK)
        self.assertEqual(self.count(), 8)
        self.assertEqual(self.count(), 9)

    def test_the_request_is_reset(self):
        done = rungc(*self.command("--scans", "30", "--watch", "REQ_BACKUP_MEM"))
        changes = [line.split(" = ")[1] for line in done.stdout.decode().splitlines() if "REQ_BACKUP_MEM" in line]
        self.assertEqual(changes, ["0"])  # saved before anybody looks

    def test_the_request_waits_for_the_disk(self):
        """The first image is written at the start; the folder is in the way of the second."""
        (Path(self.folder.name) / "image.b.tmp").mkdir()
        done = rungc(*self.command("--scans", "30", "--watch", "REQ_BACKUP_MEM"))
        self.assertEqual(done.returncode, ENVIRONMENT)
        changes = [line.split(" = ")[1] for line in done.stdout.decode().splitlines() if "REQ_BACKUP_MEM" in line]
        self.assertEqual(changes, ["0", "1"])
        self.assertEqual(done.stderr.count(b"the program continues"), 1)
        self.assertEqual(done.stderr.count(b"cannot write"), 2)  # and at the end

    def test_killed_behind_the_request(self):
        command = [RUNGC, *self.command("--realtime", "--for", "3600s", "--watch", "REQ_BACKUP_MEM")]
        images = [Path(self.folder.name) / f"image.{end}" for end in "ab"]
        kill_after_stores(command, 2, 0.5, images)  # that of the start, that of the request; and some scans more
        self.assertEqual(self.count(), 21)  # of the 20th scan, not of the last


CONNECTED = BACKUP.replace("MODULE_INIT\n", """MODULE_INIT
        MAP_IN  LIMIT,'Limit'
        MAP_OUT LAMP,'Lamp'
        DEF_IN  FEED,'Feed',TYPE_DWORD
        DEF_IN  TITLE[8],'Title',TYPE_STR
        DEF_OUT SPEED[4],'Speed',TYPE_WORD
""", 1)


class TechnolConnections(Cli):
    """connect: an end that does not exist, or does not fit, fails the scenario with its reason."""

    WRONG = {
        "PLC.Input.Nothing PLC.Input.Feed": "'PLC.Input.Nothing' is not an end of a connection: the program defines no input of this identifier",
        "PLC.Output.Nothing PLC.Input.Feed": "the program defines no output of this identifier",
        "PLC.Output.Speed[4] PLC.Input.Feed": "'PLC.Output.Speed[4]' is not an end of a connection: it has 4 elements",
        "PLC.Output.Speed.Bit[16] LIMIT": "it has no bit 16",
        "PLC.Input.Feed PLC.Output.Speed": "'PLC.Input.Feed' is an input: a connection cannot begin there",
        "P1IN.0 LAMP": "'LAMP' is an output: a connection cannot end there",
        "P129IN.0 LIMIT": "input ports are P1IN to P128IN",
        "LAMP P96OUT.0": "output ports are P0OUT to P95OUT",
        "P1IN.8 LIMIT": "it has no bit 8",
        "CAN[2].INOUT08.IP0.Bit[1] LIMIT": "there are CAN[1].INOUT08[0] to [31]",
        "CAN[1].INOUT08[32].IP0 LIMIT": "there are CAN[1].INOUT08[0] to [31]",
        "CAN[1].INOUT08.OP3 LIMIT": "with IP0 to IP3 and OP0 to OP2",
        "RTM.Axis.Nothing PLC.Input.Feed": "the real-time manager has no such element",
        "LAMP RTM.Control.M03": "'RTM.Control.M03' is an output: a connection cannot end there",
        "LAMP VKeyboard.VKey[256]": "the virtual keyboard has the keys VKey[0] to VKey[255]",
        "ANALOG_INPUT_PHYSICAL[100] PLC.Input.Feed": "channels are 0 to 99",
        "SINCE PLC.Input.Feed": "only variables of MAP_IN, MAP_OUT, MAP_AIN, MAP_AOUT, DEF_IN and DEF_OUT",
        "NOWHERE PLC.Input.Feed": "there is no module, port or variable of this name",
        "LAMP PLC.Input.Title": "do not fit: one is a text",
    }

    def test_wrong_ends(self):
        self.file("program.plc", CONNECTED)
        for ends, reason in self.WRONG.items():
            scenario = self.file("wrong.scn", f"program program.plc\nperiod 20ms\nconnect {ends}\nscan\n")
            done = rungc("test", scenario, "--engine", "interp")
            output = (done.stdout + done.stderr).decode()
            self.assertEqual(done.returncode, WRONG, output)
            self.assertIn("wrong.scn:3: ", output)
            self.assertIn(reason, output)

    def test_attributes_that_are_no_numbers(self):
        self.file("program.plc", CONNECTED)
        scenario = self.file("wrong.scn", "program program.plc\nconfig Limit.Invert yes\nconnect P1IN.0 LIMIT\nscan\n")
        done = rungc("test", scenario, "--engine", "interp")
        self.assertIn("Limit.Invert is not a number: 'yes'", (done.stdout + done.stderr).decode())


class NctRetained(Cli):
    """rungc run --retain with an NCT program: N_NVRAMOK is what the files were like."""

    def start(self, *args, program=LAMP):
        done = rungc("run", self.file("lamp.lad", program), "--retain", str(Path(self.folder.name) / "image"), "--engine",
                     "interp", "--watch", "N_NVRAMOK", *args)
        self.assertEqual(done.returncode, OK, done.stderr)
        return int(done.stdout.decode().split("N_NVRAMOK = ")[1].split()[0])

    def images(self):
        return sorted(Path(self.folder.name).glob("image.[ab]"))

    def test_what_is_lost(self):
        self.assertEqual(self.start(), 1)  # a first start
        self.assertEqual(self.start(), 1)
        newest = max(self.images(), key=lambda path: path.read_bytes()[16:24][::-1])
        newest.write_bytes(b"junk")
        self.assertEqual(self.start(), 1)  # the one before is whole
        for path in self.images():
            path.write_bytes(b"junk")
        self.assertEqual(self.start(), 0)
        self.assertEqual(self.start(), 1)
        for path in self.images():
            path.unlink()
        self.assertEqual(self.start(), 0)

    def test_the_image_of_another_program(self):
        rungc("run", self.file("counter.pmc", COUNTER.format(tail="")), "--retain", str(Path(self.folder.name) / "image"),
              "--engine", "interp")
        self.assertEqual(self.start(), 0)


class RetainedTables(Cli):
    """rungc run --retain with a simulated NCT control: its tables stand beside the program's words."""

    # Reads word 0 of the non-volatile memory at its start and then counts it up, scan by scan.
    PROGRAM = """dialect nct
module MAIN
symbol VALUE 6000
symbol READ  6001.00  ; once: allow(never-reset)
rung
|--[N_FIRSTCC]--+--{MOV 5001 #3}
                +--{MOV 5003 #6000}
                +--{MOV 5004 #1}
                +--{MOV 5011 #3}
                +--{MOV 5013 #6000}
                +--{MOV 5014 #1}
rung
|--[/READ]--{MR 5010 #10}--(S READ)
rung
|--[READ]--[/6001.01]--{ADD VALUE VALUE #1}--{MW 5000 #11}--(6001.01)
"""

    def run_it(self, *args):
        program = self.file("count.lad", self.PROGRAM)
        return rungc("run", program, "--retain", str(Path(self.folder.name) / "image"), "--engine", "interp", "--config",
                     "nc=simulated", *args)

    def value(self):
        """What the next start finds."""
        done = self.run_it("--scans", "2", "--watch", "6000")
        self.assertEqual((done.returncode, done.stderr), (OK, b""))
        return int(done.stdout.decode().split("6000 = ")[-1].splitlines()[0])

    def test_tables_come_back(self):
        self.assertEqual(self.run_it("--scans", "40").returncode, OK)
        first = self.value()
        self.assertGreater(first, 5)
        self.assertGreaterEqual(self.value(), first)
        names = {path.name for path in Path(self.folder.name).glob("image*")}
        self.assertTrue({"image.nc.a", "image.nc.b"} <= names, names)

    def test_damaged_tables_start_as_delivered(self):
        self.run_it("--scans", "40")
        for end in "ab":
            (Path(self.folder.name) / f"image.nc.{end}").write_bytes(b"junk")
        done = self.run_it("--scans", "2", "--watch", "6000")
        self.assertEqual(done.returncode, OK)
        self.assertIn(b"starting cold", done.stderr)

    def test_killed_at_any_moment(self):
        program = self.file("count.lad", self.PROGRAM)
        before = 0
        for delay in (0.31, 0.05, 0.5, 0.27):
            command = [RUNGC, "run", program, "--retain", str(Path(self.folder.name) / "image"), "--engine", "interp",
                       "--config", "nc=simulated", "--realtime", "--for", "3600s"]
            kill_after_stores(command, 4, delay, [Path(self.folder.name) / f"image.nc.{end}" for end in "ab"])
            now = self.value()
            self.assertGreaterEqual(now, before)
            before = now
        self.assertGreater(before, 10)


class Statuses(Cli):
    def test_good_program(self):
        done = rungc("check", self.file("lamp.lad", LAMP))
        self.assertEqual(done.returncode, OK, done.stderr)

    def test_wrong_program_names_file_line_and_column(self):
        path = self.file("bad.pmc", GSK)
        done = rungc("check", path)
        self.assertEqual(done.returncode, WRONG)
        self.assertRegex(done.stderr.decode(), rf"{path}:\d+:\d+: error: .* \[[a-z0-9-]+\]")

    def test_wrong_usage(self):
        for args in ([], ["frobnicate"], ["check"], ["build", "x.lad"], ["test", "x.scn", "--engine", "abacus"]):
            self.assertEqual(rungc(*args).returncode, USAGE, args)

    def test_a_name_that_became_longer_moves_a_join(self):
        path = self.file("moved.lad", "dialect nct\nmodule MAIN\nsymbol BUTTON_CLAMP 5100.00\nsymbol CLAMPED 5100.01\n"
                         "symbol VALVE 5101.00\n\nrung\n|--[BUTTON_CLAMP]--+--[/CLAMPED]--(VALVE)\n|--[VALVE]----+\n")
        done = rungc("check", path)
        self.assertEqual(done.returncode, WRONG)
        self.assertIn("this '+' is in column 20, the end of the branch in column 15", done.stderr.decode())

    def test_missing_file(self):
        done = rungc("check", str(Path(self.folder.name) / "none.lad"))
        self.assertEqual(done.returncode, ENVIRONMENT)
        self.assertIn(b"none.lad", done.stderr)

    def test_help_everywhere(self):
        for command in ("check", "build", "emit", "run", "test", "profile", "explain", "doc"):
            done = rungc(command, "--help")
            self.assertEqual(done.returncode, OK, command)
            self.assertIn(b"Usage", done.stdout)

    def test_standard_input(self):
        self.assertEqual(rungc("check", "-", "--dialect", "nct", stdin=LAMP.encode()).returncode, OK)
        done = rungc("check", "-", stdin=TECHNOL_NULL.encode())
        self.assertEqual(done.returncode, WRONG, "nothing tells the dialect")
        self.assertIn(b"[", done.stderr)
        self.assertEqual(rungc("check", "-", "--dialect", "technol", stdin=TECHNOL_NULL.encode()).returncode, OK)

    def test_json(self):
        done = rungc("check", self.file("bad.pmc", GSK), "--json")
        self.assertEqual(done.returncode, WRONG)
        entries = json.loads(done.stdout)
        self.assertTrue(entries)
        for entry in entries:
            self.assertLessEqual({"code", "severity", "message", "file", "line", "column"}, set(entry))

    def test_color(self):
        path = self.file("bad.pmc", GSK)
        self.assertIn(b"\x1b[", rungc("check", path, "--color", "always").stderr)
        self.assertNotIn(b"\x1b[", rungc("check", path, "--color", "auto").stderr)

    def test_failing_scenario_names_its_line_and_what_it_read(self):
        self.file("lamp.lad", LAMP)
        scenario = self.file("lamp.scn", "program lamp.lad\nscan\nexpect 5101.00 1\n")
        done = rungc("test", scenario, "--engine", "interp")
        self.assertEqual(done.returncode, WRONG)
        self.assertIn(b"lamp.scn:3: 5101.00 is 0, expected 1", done.stdout)
        self.assertIn(b"0 passed, 1 failed", done.stdout)

    def test_junit(self):
        self.file("lamp.lad", LAMP)
        good = self.file("good.scn", "program lamp.lad\nset 5100.00 1\nscan\nexpect 5101.00 1\n")
        bad = self.file("bad.scn", "program lamp.lad\nscan\nexpect 5101.00 1\n")
        report = str(Path(self.folder.name) / "report.xml")
        self.assertEqual(rungc("test", good, bad, "--engine", "interp", "--junit", report).returncode, WRONG)
        text = Path(report).read_text()
        self.assertIn('tests="2" failures="1" errors="0"', text)

    def test_junit_is_xml_whatever_the_texts_hold(self):
        self.file("lamp.lad", LAMP)
        name = str(Path(self.folder.name) / "odd&<\x01\udcff.scn")  # the byte FF is not UTF-8
        Path(name).write_text('program lamp.lad\nscan\nprint "a<b>&\'c ]]> \u4e2d"\nexpect 5101.00 1\n', encoding="utf-8")
        report = str(Path(self.folder.name) / "report.xml")
        self.assertEqual(rungc("test", name, "--engine", "interp", "--junit", report).returncode, WRONG)
        case = xml.parse(report).getroot().find("testcase")
        self.assertTrue(case.get("name").endswith("odd&<?\ufffd.scn"), case.get("name"))
        self.assertIn("a<b>&'c ]]> \u4e2d", case.find("system-out").text)
        failure = case.find("failure")
        self.assertIn("odd&<?\ufffd.scn:4: ", failure.text)
        self.assertEqual(failure.get("message"), failure.text.split("\n")[0])


class Products(Cli):
    def test_shared_objects_of_both_ways_do_the_same(self):
        source = self.file("lamp.lad", LAMP)
        outputs = set()
        for via in ("llvm", "cpp"):
            for level in ("-O0", "-O2"):
                out = str(Path(self.folder.name) / f"lamp-{via}{level}.so")
                done = rungc("build", source, "-o", out, "--via", via, level, "-g")
                self.assertEqual(done.returncode, OK, done.stderr)
                done = rungc("run", out, "--scans", "3", "--watch", "5101.00")
                self.assertEqual(done.returncode, OK, done.stderr)
                outputs.add(done.stdout)
        self.assertEqual(len(outputs), 1)

    def test_emit(self):
        source = self.file("lamp.lad", LAMP)
        for what, mark in (("cpp", "rung_program_table"), ("ir", "rung"), ("llvm", "define"), ("asm", ".text"), ("layout", "space")):
            done = rungc("emit", what, source)
            self.assertEqual(done.returncode, OK, done.stderr)
            self.assertIn(mark, done.stdout.decode())

    def test_listing(self):
        source = self.file("lamp.plc", LISTED)
        out = str(Path(self.folder.name) / "lamp.so")
        name = Path(self.folder.name) / "lamp.ls1"
        done = rungc("build", source, "-o", out, "--listing", str(name))
        self.assertEqual(done.returncode, OK, done.stderr)
        lines = name.read_text().splitlines()
        self.assertEqual(lines[0], "; " + source)
        self.assertEqual(lines[1], "; line rung")
        self.assertEqual(lines[2], "     1        DATA")
        self.assertEqual(lines[-1], "    24        STOP")
        # What name_LINE shows leads to the line of the state.
        done = rungc("run", out, "--scans", "3", "--watch", "M_LINE")
        number = re.findall(r"M_LINE = (\d+)", done.stdout.decode())[-1]
        waiting = [line for line in lines if line.endswith("        TIM  -,50           ; waits here")]
        self.assertEqual([line.split()[0] for line in waiting], [number])

    def test_listing_of_a_ladder(self):
        done = rungc("build", self.file("lamp.lad", LAMP), "-o", str(Path(self.folder.name) / "l.so"), "--listing", str(Path(self.folder.name) / "l.ls1"))
        self.assertEqual(done.returncode, USAGE)
        self.assertIn(b"only technol programs have a listing", done.stderr)

    def test_unwritable_output(self):
        done = rungc("build", self.file("lamp.lad", LAMP), "-o", "/nonexistent/lamp.so")
        self.assertEqual(done.returncode, ENVIRONMENT)

    def test_a_file_that_is_no_program(self):
        done = rungc("run", self.file("text.so", "not an object"))
        self.assertEqual(done.returncode, ENVIRONMENT)
        self.assertIn(b"it is not an ELF file", done.stderr)

    def test_writers_of_one_file_do_not_mix(self):
        out = Path(self.folder.name) / "lamp.so"
        sources = [self.file(f"lamp{i}.lad", LAMP + f'rung "another"\n|--[5100.02]--(51{i:02}.05)\n') for i in range(2, 5)]
        for via in ("llvm", "cpp"):
            writers = [subprocess.Popen([RUNGC, "build", "-q", source, "-o", str(out), "--via", via], stderr=subprocess.PIPE) for source in sources * 2]
            for writer in writers:
                self.assertEqual(writer.communicate()[1], b"")
                self.assertEqual(writer.returncode, OK)
            self.assertEqual(rungc("run", str(out)).returncode, OK)
        self.assertEqual(sorted(path.name for path in Path(self.folder.name).iterdir() if path.suffix != ".lad"), ["lamp.so"])


    def test_a_cache_that_others_may_write(self):
        source = self.file("lamp.lad", LAMP)
        cache = Path(self.folder.name) / "cache"
        done = rungc("run", source, "--cache", str(cache))
        self.assertEqual((done.returncode, done.stderr), (OK, b""))
        self.assertEqual(cache.stat().st_mode & 0o777, 0o700)
        cache.chmod(0o777)
        done = rungc("run", source, "--cache", str(cache))
        self.assertEqual(done.returncode, OK)
        self.assertIn(b"nothing is taken from or kept in the cache: cannot use the folder", done.stderr)
        self.assertIn(b"every user may write to it (mode 0777)", done.stderr)


class Seals(Cli):
    def setUp(self):
        super().setUp()
        self.so = str(Path(self.folder.name) / "lamp.so")
        self.good("build", "-q", self.file("lamp.lad", LAMP), "-o", self.so)

    def good(self, *words):
        done = rungc(*words)
        self.assertEqual(done.returncode, OK, done.stderr)
        return done.stdout.decode()

    def bad(self, status, message, *words):
        done = rungc(*words)
        self.assertEqual(done.returncode, status, done.stderr)
        self.assertIn(message, done.stderr.decode())

    def unsealed(self):
        path = Path(self.folder.name) / "unsealed.so"
        path.write_bytes(Path(self.so).read_bytes()[:-136])
        return str(path)

    def test_build_seals_for_every_way_and_target(self):
        for words in ((), ("--via", "cpp"), ("--target", "aarch64-linux-gnu"), ("--target", "armv7-linux-gnueabihf")):
            self.good("build", "-q", self.file("lamp.lad", LAMP), "-o", self.so, *words)
            self.assertTrue(Path(self.so).read_bytes().endswith(b"RungSeal"))
            self.assertIn("sealed ", self.good("seal", self.so))

    def test_a_file_without_seal(self):
        path = self.unsealed()
        self.bad(ENVIRONMENT, f"cannot load {path}: it has no seal at its end", "run", path)
        self.assertEqual(self.good("run", path, "--unsealed"), self.good("run", self.so))
        self.assertEqual(self.good("seal", path), f"sealed {path}\n")
        self.assertEqual(Path(path).read_bytes(), Path(self.so).read_bytes())
        self.good("run", path)
        self.assertEqual(self.good("seal", "-q", path, self.so), "")
        self.assertEqual(Path(path).read_bytes(), Path(self.so).read_bytes())

    def test_a_damaged_file(self):
        data = bytearray(Path(self.so).read_bytes())
        data[1000] ^= 4
        Path(self.so).write_bytes(data)
        for words in ((), ("--unsealed",)):
            self.bad(ENVIRONMENT, "its content is not what was sealed", "run", self.so, *words)
        self.bad(WRONG, "its seal shows damage", "seal", self.so)
        Path(self.so).write_bytes(data[:5000])
        self.bad(ENVIRONMENT, "it has no seal", "run", self.so)

    def test_a_program_for_another_processor(self):
        target = "riscv64" if os.uname().machine != "riscv64" else "x86_64"
        for other in (target, "armv7"):
            abi = "gnueabihf" if other == "armv7" else "gnu"
            self.good("build", "-q", self.file("lamp.lad", LAMP), "-o", self.so, "--target", f"{other}-linux-{abi}")
            self.bad(ENVIRONMENT, f"it is for processor {other}, and this one is {os.uname().machine}", "run", self.so)

    def test_what_is_not_sealed(self):
        self.bad(WRONG, "it is not an ELF file; expected a shared object (.so)", "seal", self.file("text.so", "not an object"))
        self.bad(WRONG, "but not a shared object", "seal", self.object_of_another_kind())
        self.bad(WRONG, "it exports no symbol rung_program_table", "seal", str(next(Path("/lib").glob("*-linux-gnu*/libm.so.6"))))
        self.bad(ENVIRONMENT, "cannot read /nowhere.so: No such file", "seal", "/nowhere.so")
        self.bad(USAGE, "FILE", "seal")
        # The others are sealed all the same.
        path = self.unsealed()
        self.bad(ENVIRONMENT, "/nowhere.so", "seal", "/nowhere.so", path)
        self.good("run", path)

    def object_of_another_kind(self):
        data = bytearray(Path(self.unsealed()).read_bytes())
        data[16] = 1  # a relocatable object
        path = Path(self.folder.name) / "object.so"
        path.write_bytes(data)
        return str(path)

    def test_keys(self):
        key = Path(self.folder.name) / "maker"
        said = self.good("key", "new", str(key))
        self.assertIn("/etc/rung/keys.d", said)
        self.assertEqual(key.stat().st_mode & 0o777, 0o600)
        self.assertRegex(key.read_text(), r"^rung-secret-key-1 [0-9a-f]{64}\n$")
        self.assertRegex(Path(f"{key}.pub").read_text(), r"^rung-public-key-1 [0-9a-f]{64}\n$")
        before = key.read_text()
        self.bad(ENVIRONMENT, "File exists", "key", "new", str(key))
        Path(f"{key}.pub").unlink()
        self.bad(ENVIRONMENT, "File exists", "key", "new", str(key))
        self.assertFalse(Path(f"{key}.pub").exists())
        self.assertEqual(key.read_text(), before)
        self.bad(USAGE, "new", "key", "old", str(key))
        self.bad(ENVIRONMENT, "cannot write", "key", "new", "/nowhere/maker")

    def test_signing(self):
        key = str(Path(self.folder.name) / "maker")
        name = re.match(r"key ([0-9a-f]{32}):", self.good("key", "new", key)).group(1)
        self.assertEqual(self.good("seal", "--sign", key, self.so), f"sealed {self.so}, signed by key {name}\n")
        self.good("run", self.so)
        self.bad(ENVIRONMENT, "maker.pub is not a secret key", "seal", "--sign", self.private(f"{key}.pub"), self.so)
        os.chmod(key, 0o644)
        self.bad(ENVIRONMENT, f"other users may read this secret key (mode 0644); chmod 600 {key}", "seal", "--sign", key, self.so)
        os.chmod(self.so, 0o757)
        self.bad(ENVIRONMENT, f"every user may write to it (mode 0757); after chmod go-w it may run, and so may one signed with a known key (rungc seal --sign); its signature is by key {name}, which is not among the known keys", "run", self.so)

    def private(self, path):
        os.chmod(path, 0o600)
        return path

    def test_run_for_a_time(self):
        done = rungc("run", self.file("lamp.lad", LAMP), "--for", "100ms")
        self.assertEqual(done.returncode, OK, done.stderr)
        self.assertIn(b"10 scans", done.stdout)

    def test_run_with_a_real_time_priority(self):
        source = self.file("lamp.lad", LAMP)
        for options in (["--priority", "10"], ["--lock-memory"]):
            alone = rungc("run", source, *options)
            self.assertEqual(alone.returncode, USAGE)
            self.assertIn(b"--realtime", alone.stderr)
            done = rungc("run", source, "--for", "50ms", "--realtime", *options)
            if done.returncode == OK:
                self.assertIn(b"5 scans", done.stdout)
            else:  # a system that does not grant it
                self.assertEqual(done.returncode, ENVIRONMENT, done.stderr)
                self.assertRegex(done.stderr, rb"rungc: (real-time priority 10|memory cannot be locked): .*ulimit -[rl]")
        for priority in ("0", "100", "high"):
            self.assertEqual(rungc("run", source, "--realtime", "--priority", priority).returncode, USAGE)

    def test_run_shows_messages(self):
        self.file("texts.txt", '1 "EMERGENCY STOP"\n')
        source = self.file("stop.pmc", "FUNC END1\nLDI X9.0\nOUT A0.0\nFUNC END2\n")
        done = rungc("run", source, "--config", "messages=texts.txt")
        self.assertEqual(done.returncode, OK, done.stderr)
        self.assertIn(b'message 1 "EMERGENCY STOP"', done.stdout)

    def test_run_shows_nct_messages(self):
        source = self.file("tool.lad", 'dialect nct\nmodule MAIN\nmessage 20 "Tool {#0:F0} missing"\nrung\n'
                           '|--[N_P100MS]--{MSG #20 #1 #3 #5}--(7100.00)\n')
        done = rungc("run", source, "--scans", "10", "--watch", "7100.00", "N_ACTMSG")
        self.assertEqual(done.returncode, OK, done.stderr)
        self.assertIn(b'50.000 ms  message 20 (channel 1, index 3) "Tool 5 missing"\n', done.stdout)
        self.assertIn(b"60.000 ms  7100.00 = 1", done.stdout)
        self.assertIn(b"60.000 ms  N_ACTMSG = 1002003", done.stdout)
        self.assertIn(b'"Tool 5 missing" is gone', done.stdout)
        on_the_clock = rungc("run", source, "--for", "80ms", "--realtime", "--watch", "7100.00")
        self.assertEqual(on_the_clock.returncode, OK, on_the_clock.stderr)
        self.assertIn(b"7100.00 = 1", on_the_clock.stdout)

    def test_profile_shows_what_used_up_the_budget(self):
        scenarios = Path(__file__).resolve().parents[2] / "tests/scenarios/nct"
        program = str(scenarios / "int0-timeout.lad")
        for engine in ("jit", "interp"):
            done = rungc("profile", program, "--scenario", str(scenarios / "int0-timeout.scn"), "--engine", engine, "--json")
            self.assertEqual(done.returncode, OK, done.stderr)
            rungs = sorted(json.loads(done.stdout)["rungs"], key=lambda rung: -rung["executions"])
            self.assertEqual({rung["line"] for rung in rungs[:2]}, {35, 38})
            self.assertEqual({rung["line"] for rung in rungs[2:5]}, {14, 17, 20})

    def test_profile_takes_the_files_of_the_scenario(self):
        example = Path(__file__).resolve().parents[2] / "examples/nct-turning-centre"
        done = rungc("profile", "--scenario", str(example / "turret.scn"), "--json")
        self.assertEqual(done.returncode, OK, done.stderr)
        self.assertGreater(len({rung["file"] for rung in json.loads(done.stdout)["rungs"]}), 5)

    def test_explain_signals(self):
        for word in ("MF", "mf", "F7.0", "F007.0"):
            self.assertIn(b"[gsk] MF: F7.0", rungc("explain", word).stdout)
        self.assertIn(b"G8.4", rungc("explain", "*ESP").stdout)

    def test_explain_technol(self):
        self.assertIn(b"[technol] PO_POL: bit", rungc("explain", "po_pol").stdout)
        self.assertIn(b"[technol] BLOCK_MOVE: constant 2", rungc("explain", "BLOCK_MOVE").stdout)
        self.assertIn(b"TIME_INFOS.TIME_SEC: BYTE", rungc("explain", "syst_time_info.time_sec").stdout)
        self.assertIn(b"TIME_INFOS.TIME_SEC: BYTE", rungc("explain", "TIME_SEC").stdout)
        self.assertIn(b"`BLK[n].T`", rungc("explain", "BLK[0].T").stdout)
        self.assertIn(b"a licence of the hardware key", rungc("explain", "FeaturePlc3").stdout)
        self.assertIn(b"`CELL.", rungc("explain", "CAN_AX_READY").stdout)

    def test_explain_other_spellings(self):
        for word in ("MOVCMD", "MOVCMMD", "movcmo"):
            self.assertIn(b"[nct] MOVCMND: axis control", rungc("explain", word).stdout)
        self.assertIn(b"[technol] JL0: jump if 0", rungc("explain", "JLO").stdout)
        self.assertIn(b"Also written JLO.", rungc("explain", "JL0").stdout)

    def test_only_ladders_have_places(self):
        self.assertIn(b"Place: at the left rail.", rungc("explain", "END").stdout)
        for word in ("LDR", "DATA", "STOP"):
            self.assertNotIn(b"Place:", rungc("explain", word).stdout)

    def test_explain_and_doc(self):
        self.assertIn(b"multi-level-output", rungc("explain", "multi-level-output").stdout)
        self.assertIn(b"TOND", rungc("explain", "tond").stdout)
        done = rungc("explain", "no-such-thing")
        self.assertEqual(done.returncode, WRONG)
        self.assertIn(b"; for a name of a program, name its project with --project\n", done.stderr)
        for page in ("gsk", "nct", "technol", "diagnostics", "ir"):
            self.assertEqual(rungc("doc", page).returncode, OK, page)
        self.assertEqual(rungc("doc", "klingon").returncode, USAGE)


class Convert(Cli):
    MILL = "examples/gsk-mill/mill.pmc"

    def test_there_and_back(self):
        ladder, back, again = (str(Path(self.folder.name) / name) for name in ("mill.lad", "mill.pmc", "again.lad"))
        self.assertEqual(rungc("convert", self.MILL, "--to", "ladder", "-o", ladder).returncode, OK)
        self.assertEqual(rungc("convert", ladder, "--to", "list", "-o", back).returncode, OK)
        self.assertEqual(rungc("convert", back, "--to", "ladder", "-o", again).returncode, OK)
        self.assertEqual(Path(ladder).read_text(), Path(again).read_text())
        words = lambda path: [line.split() for line in Path(path).read_text().splitlines() if line.split(";")[0].strip()]
        self.assertEqual(len(words(self.MILL)), len(words(back)))
        for comment in ("springs clamp", "brake of the vertical axis"):
            self.assertIn(comment, Path(ladder).read_text())

    def test_a_mnemonic_file_there_and_back(self):
        program = ("%@2\nX9.0 *ESP\n%\n%@3\nEND1\n(* the lamp *)\nRD.NOT *ESP\nRD.STK X9.1\nAND.STK\nWRT Y9.0\nEND2\nEND\n%\n"
                   "%@4\nA0.0 1000 GUARD\n%\n")
        ladder, back, again, page = (str(Path(self.folder.name) / name) for name in ("a.lad", "b.mnc", "c.lad", "a.html"))
        for source in (self.file("lamp.mne", program), self.file("LAMP.MNC", ("\r\n".join(program.split("\n"))).encode("utf-16-le"))):
            with self.subTest(source=source):
                self.assertEqual(rungc("convert", source, "--to", "ladder", "-o", ladder).returncode, OK)
                self.assertEqual(rungc("convert", ladder, "--to", "list", "-o", back).returncode, OK)
                self.assertEqual(rungc("convert", back, "--to", "ladder", "-o", again).returncode, OK)
                self.assertEqual(Path(ladder).read_bytes(), Path(again).read_bytes())
                self.assertEqual(rungc("view", source, "-o", page).returncode, OK)
                self.assertIn("the lamp", Path(page).read_text())

    def test_the_drawing_runs_as_the_list_does(self):
        done = rungc("convert", self.MILL, "--to", "ladder")
        self.assertEqual(done.returncode, OK)
        self.file("mill.lad", done.stdout)
        self.file("mill.msg", Path("examples/gsk-mill/mill.msg").read_bytes())
        for scenario in ("spindle", "tool-change"):
            text = Path(f"examples/gsk-mill/{scenario}.scn").read_text().replace("program mill.pmc", "program mill.lad")
            done = rungc("test", self.file(f"{scenario}.scn", text))
            self.assertEqual(done.returncode, OK, done.stdout[-800:])

    def test_a_program_with_mistakes(self):
        done = rungc("convert", self.file("wrong.pmc", GSK), "--to", "ladder")
        self.assertEqual((done.returncode, done.stdout), (WRONG, b""))
        self.assertIn(b"missing-end2", done.stderr)

    def converted(self, name, contents, to):
        out = str(Path(self.folder.name) / f"converted-{name}{'.pmc' if to == 'list' else '.lad'}")
        done = rungc("convert", self.file(name, contents), "--to", to, "-o", out)
        self.assertEqual(done.returncode, OK, done.stderr)
        self.assertEqual(rungc("check", out).returncode, OK)
        return Path(out).read_bytes()

    def test_a_file_says_its_encoding_in_the_other_form_too(self):
        said = b"; encoding: gb18030\n"
        program = "LD X0.0 ; \u706f\nOUT Y0.0\nFUNC END1\nFUNC END2\n"
        for head in (said, b"dialect gsk\n" + said, said + b"; a lamp\n"):
            for to in ("list", "ladder"):
                with self.subTest(head=head, to=to):
                    contents = self.converted("lamp.pmc", head + program.encode("gb18030"), to)
                    self.assertTrue(contents.startswith(said), contents)
                    self.assertEqual(contents.count(b"encoding"), 1, contents)
                    self.assertIn("\u706f".encode("gb18030"), contents)
        # A byte order mark says that an editor has made it UTF-8 since then.
        contents = self.converted("marked.pmc", b"\xef\xbb\xbf" + said + program.encode(), "ladder")
        self.assertNotIn(b"encoding", contents)
        self.assertIn("\u706f".encode(), contents)

    def test_a_section_beside_the_word_rung(self):
        for head in ('rung "start" ; section "axes"', '; start\nrung ; section "axes"', '; start\n\nrung ; section "axes"'):
            for to in ("list", "ladder"):
                with self.subTest(head=head, to=to):
                    text = self.converted("axes.lad", f"dialect gsk\nmodule LEVEL1\n\n{head}\n|--[X0.0]--(Y0.0)\n", to)
                    self.assertLess(text.index(b'section "axes"'), text.index(b"start"))

    def test_other_dialects_have_one_form(self):
        done = rungc("convert", self.file("lamp.lad", LAMP), "--to", "list")
        self.assertEqual(done.returncode, WRONG)
        self.assertIn(b"no-conversion", done.stderr)

    def test_what_nobody_could_read_is_not_drawn(self):
        # Branches in branches: each is drawn as long as all that it spans.
        depth = 5900
        text = "FUNC 0\nLD R0.0\n" + "AND R0.1\nOR R0.2\n" * depth + "OUT R1.0\nFUNC 1\n"
        done = rungc("convert", self.file("deep.pmc", text), "--to", "ladder")
        self.assertEqual(done.returncode, WRONG)
        self.assertIn(b"drawing-too-large", done.stderr)

    def test_wrong_usage(self):
        self.assertEqual(rungc("convert", self.MILL).returncode, USAGE)
        self.assertEqual(rungc("convert", self.MILL, "--to", "list", "-o", "x.lad").returncode, USAGE)
        done = rungc("convert", self.MILL, "--to", "ladder", "-o", "x.pmc")
        self.assertEqual(done.returncode, USAGE)
        self.assertIn(b"rungc: 'x.pmc' cannot be ladder text: its name must end in .lad\n", done.stderr)
        done = rungc("convert", self.file("a.mne", "END1\nEND2\nEND\n"), "--to", "list", "-o", "x.lad")
        self.assertEqual((done.returncode, done.stderr),
                         (USAGE, b"rungc: 'x.lad' cannot be a command list: its name must end in .mne or .mnc\n"))
        self.assertEqual(rungc("convert", self.file("a.mne", "END1\nEND2\nEND\n"), "--to", "ladder", "-o", "x.mnc").returncode, USAGE)


class HostileInput(Cli):
    def test_unknown_dialect(self):
        done = rungc("check", self.file("lamp.lad", LAMP), "--dialect", "klingon")
        self.assertEqual(done.returncode, WRONG)
        self.assertIn(b"[unknown-dialect]", done.stderr)

    def test_a_dialect_of_almost_the_right_name(self):
        for name in ("NCT", "nct2xx", "ntc"):
            done = rungc("check", self.file("lamp.lad", LAMP.replace("dialect nct", f"dialect {name}")))
            self.assertEqual(done.returncode, WRONG)
            self.assertIn(b"did you mean nct?", done.stderr)
        done = rungc("check", self.file("lamp.lad", LAMP.replace("dialect nct", "dialect NCT")), "--dialect", "nct")
        self.assertIn(b"did you mean nct?", done.stderr)

    def test_a_list_is_no_ladder_text(self):
        done = rungc("check", self.file("lamp.lad", "LD 5100.00\nOUT 5101.00\n"))
        self.assertIn(b"[missing-dialect]", done.stderr)
        self.assertIn(b"this is a line of an instruction list", done.stderr)

    def test_a_mnemonic_file_of_another_name(self):
        done = rungc("check", self.file("PMC1.TXT", "%@A\n%@3\nRD X8.4\nWRT G8.4\nSUB 1\nSUB 2\nSUB 64\n%\n%@E\n"))
        self.assertIn(b"note: it is a mnemonic file of a FANUC control: name it .mne, or say --dialect fanuc", done.stderr)

    def test_a_file_of_a_control_that_is_no_program_is_named(self):
        for name, contents, said in (("mill.LAD", b"\1\0\2\0LEVEL1.#LR\0\0", b"mill.LAD' is a LADDER-III project (.LAD), which is binary"),
                                     ("PMC1.000", b"PMC\0\0\3\xff\x10", b"PMC1.000' is a binary file, such as a memory card file"),
                                     ("PMC1_PRM.TXT", b"%\nN600000 P6\n%\n", b"PMC1_PRM.TXT' is a list of PMC parameters: `rungc import`")):
            done = rungc("check", self.file(name, contents))
            self.assertEqual(done.returncode, WRONG)
            self.assertIn(said, done.stderr)
            self.assertIn(b"[foreign-file]", done.stderr)

    def test_a_binary_file_of_a_project_is_named_without_its_bytes(self):
        self.file("PMC1.000", b"PMC\0\0\3\xff\x10\x1a more\n")
        done = rungc("check", self.file("rung.toml", 'dialect = "fanuc"\nfiles = ["PMC1.000"]\n'))
        self.assertEqual(done.returncode, WRONG)
        self.assertRegex(done.stderr.decode(), r"\Aerror: '[^']*PMC1\.000' is a binary file, .* \[foreign-file\]\n1 error; .*\n\Z")

    def test_what_a_text_is_whose_name_does_not_say_it(self):
        for name, contents, said in (("CNC-PARA.TXT", "%\nN00000Q1P00000010\nN00001Q1P0\n%\n", "is parameters of the CNC, not of the PMC"),
                                     ("O0001.NC", "%\nO0001 (PART)\nG0 X0\nM30\n%\n", "is a part program (G code)"),
                                     ("ladder.txt", "%PDF-1.4\nstream\n", "is a PDF document: a printed ladder"),
                                     ("main.txt", "LD X0.0\nOUT Y0.0\nFUNC END1\nFUNC END2\n", "is a command list of a GSK control: name it .pmc, or say --dialect gsk")):
            done = rungc("check", self.file(name, contents))
            self.assertEqual(done.returncode, WRONG)
            self.assertIn(f"{name}' {said}".encode(), done.stderr)
            self.assertIn(b"[foreign-file]", done.stderr)

    def test_a_bare_list_says_whose_it_is(self):
        for contents, said in (("(* the lamp *)\nN00001:\nRD X9.0\nWRT Y9.0\nSUB 1\n", b"note: it is a command list of a FANUC control: name it .mne, or say --dialect fanuc"),
                               ("LD X0.0\nOUT Y0.0\n", b"note: it is a command list of a GSK control: name it .pmc, or say --dialect gsk")):
            done = rungc("check", self.file("list.txt", contents))
            self.assertEqual(done.returncode, WRONG)
            self.assertIn(b"[missing-dialect]", done.stderr)
            self.assertIn(said, done.stderr)
        done = rungc("check", self.file("script.txt", "%@ format\nprint %@3\n"))
        self.assertIn(b"[missing-dialect]", done.stderr)
        self.assertNotIn(b"mnemonic file", done.stderr)

    def test_limits_of_sources(self):
        chain = "".join(f"symbol S{i} S{i + 1},#1\n" for i in range(5000))
        done = self.survives(self.file("chain.lad", "dialect nct\n" + chain + "symbol S5000 5100\nmodule MAIN\n"))
        self.assertIn(b"[too-deep]", done.stderr)
        data = TECHNOL_NULL.replace("DATA\n", "DATA\nBIG: DS 10000000\nMORE: DS 10000000\n", 1)
        self.assertIn(b"[too-large]", self.survives(self.file("big.plc", data)).stderr)

    def test_empty_files(self):
        for name in ("empty.lad", "empty.pmc", "empty.plc"):
            self.assertEqual(self.survives(self.file(name, "")).returncode, WRONG)

    def test_binary_junk(self):
        junk = bytes(range(256)) * 64
        for name in ("junk.lad", "junk.pmc", "junk.plc"):
            self.assertEqual(self.survives(self.file(name, junk)).returncode, WRONG)
            with open(RUNGC, "rb") as program:
                self.survives(self.file("elf" + name, program.read(300000)))

    def test_ten_megabytes_in_one_line(self):
        for name, start, piece in (("long.lad", "dialect nct\nmodule MAIN\nrung\n|", "--[5100.00]"), ("long.pmc", "", "LD X0.0 "), ("long.plc", "DATA\n", "LDR A ")):
            self.survives(self.file(name, start + piece * (10_000_000 // len(piece))))

    def test_hundred_thousand_rungs(self):
        ladder = "dialect nct\nmodule MAIN\n" + "".join(f"\nrung\n|--[5100.{i % 32:02}]--[/5101.{i % 32:02}]--{{MOV {5200 + i % 4000} #{i}}}\n" for i in range(100_000))
        self.assertEqual(self.survives(self.file("many.lad", ladder)).returncode, OK)
        listing = "FUNC 0\n" + "".join(f"LD X{i % 128}.0\nOUT R{i % 900}.{i % 8}\n" for i in range(100_000)) + "FUNC 1\n"
        done = self.survives(self.file("many.pmc", listing))
        self.assertEqual(done.returncode, WRONG)
        self.assertIn(b"program-too-large", done.stderr)
        mnemonics = TECHNOL_NULL.replace("DATA\n", "DATA\nCELL: DFM B0,B1,B2,B3,B4,B5,B6,B7\n", 1).replace("MODULE_MAIN\n", "MODULE_MAIN\n" + "LDR B0\nLA B1\nWR B2\n" * 100_000, 1)
        self.assertEqual(self.survives(self.file("many.plc", mnemonics)).returncode, OK)

    def test_deeply_nested_branches(self):
        depth = 1500
        lines = ["|" + "--+" * depth + "--[5100.00]--(5101.00)"]
        for level in range(depth, 0, -1):
            lines.append(" " * (3 * level) + "+--[5100.01]--+" if level == depth else " " * (3 * level) + "+")
        self.survives(self.file("deep.lad", "dialect nct\nmodule MAIN\nrung\n" + "\n".join(lines) + "\n"))
        stack = "FUNC 0\n" + "LD X0.0\n" * 5000 + "ANB\n" * 4999 + "OUT R0.0\nFUNC 1\n"
        self.assertIn(b"stack-overflow", self.survives(self.file("deep.pmc", stack)).stderr)

    def test_an_include_of_itself(self):
        path = self.file("self.plc", "T_INCLUDE self.plc\n" + TECHNOL_NULL)
        self.survives(path)

    def test_the_same_file_twice(self):
        symbols = self.file("symbols.mne", "%@2\nX0.0 BUTTON\n%\n")
        ladder = self.file("ladder.mne", "%@3\nSUB 1\nRD BUTTON\nWRT Y0.0\nSUB 2\nSUB 64\n%\n")
        path = self.file("twice.plc", TECHNOL_NULL)
        other = os.path.join(os.path.dirname(path), ".", "twice.plc")
        for words in ((path, path), (path, other), (symbols, symbols, ladder)):
            done = rungc("check", *words)
            self.assertEqual(done.returncode, WRONG)
            self.assertIn(b"' is named twice [file-twice]\n1 error; try `rungc explain file-twice`\n", done.stderr)

    def test_text_after_the_end_of_a_file(self):
        done = rungc("check", self.file("cut.lad", LAMP + "\x1a\x1a\r\n"))
        self.assertEqual((done.returncode, done.stderr), (OK, b""))
        done = rungc("check", self.file("cut.lad", LAMP + "\x1amodule OTHER\n"))
        self.assertEqual(done.returncode, OK)
        self.assertIn(b"warning: a Ctrl-Z ends the text here, and 13 bytes after it are left out; the file may be incomplete [incomplete-file]", done.stderr)

    def test_a_mnemonic_file_with_the_name_of_another_list(self):
        text = "%@A\n%@3\nRD X8.4\nWRT G8.4\nSUB 1\nSUB 2\nSUB 64\n%\n%@E\n"
        for command in (["check"], ["format", "--stdout"]):
            done = rungc(*command, self.file("mill.pmc", text))
            self.assertEqual(done.returncode, WRONG)
            self.assertIn(b"mill.pmc' is a mnemonic file of a FANUC control: name it .mne, or say --dialect fanuc [foreign-file]\n1 error", done.stderr)
        for command in (["check"], ["format", "--stdout"]):
            done = rungc(*command, self.file("mill.mne", "; a\ndialect gsk\n" + text))
            self.assertEqual(done.returncode, WRONG)
            self.assertIn(b"mill.mne:2:9: error: '", done.stderr)
            self.assertIn(b"a mnemonic file of a FANUC control, but its line `dialect gsk` names another dialect: remove the line, or say --dialect fanuc [foreign-file]", done.stderr)
        self.assertEqual(rungc("check", "--dialect", "fanuc", self.file("mill.mne", "dialect gsk\n" + text)).returncode, OK)

    def test_format_leaves_other_files_alone(self):
        for name, contents in (("mill.mne", b"\1\0\2\0LEVEL1.#LR\0\0"), ("mill.mne", b"FUNC END1\nLD X0.0\nOUT Y0.0\n"), ("O1.mne", b"%\nO0001\nG0 X0\nM30\n%\n")):
            path = self.file(name, contents)
            done = rungc("format", path)
            self.assertEqual(done.returncode, WRONG)
            self.assertIn(b"[foreign-file]", done.stderr)
            with open(path, "rb") as file:
                self.assertEqual(file.read(), contents)


if __name__ == "__main__":
    go_to_root()
    RUNGC = os.path.abspath(sys.argv.pop(1))
    unittest.main()
