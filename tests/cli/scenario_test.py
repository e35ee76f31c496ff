#!/usr/bin/env python3
"""What rungc test says about a failing scenario, and the traces it writes. scenario_test.py RUNGC"""
import csv
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from patience import patience

RUNGC = None
OK, WRONG, USAGE, ENVIRONMENT = 0, 1, 2, 3

DOOR = """dialect nct
module MAIN

symbol CLOSED  5100.00
symbol START   5100.01
symbol LOCK    5101.00
symbol T_LOCK  5200
symbol COUNT   5300

rung "lock the door a second after it has closed"
|--[CLOSED]--{TOND T_LOCK #1000 #0}--(LOCK)

rung "openings"
|--[@START]--{ADD COUNT COUNT #1}
"""
PASSES = """program door.lad
set CLOSED 1
scan 3
expect LOCK 0
set START 1
run 1s
expect LOCK 1
expect COUNT 1
"""
FAILS = PASSES.replace("expect LOCK 1", "expect LOCK 0")


CELLS = """DATA
LONG:   DS 4
NEXT:   DS 4
VALUE:  DS 8
LAST:   DS 4
DATA_END
MODULE_MAIN
        LOD  DWRD.NEXT
        STO  DWRD.LAST
MODULE_MAIN_END
""" + "".join(f"MODULE_{name}\nMODULE_{name}_END\n" for name in
              ("INPUT", "BLOCK_INIT", "BLOCK_DONE", "INIT", "CLEAR", "HALT")) + "STOP\n"


def read_vcd(path):
    """Names with their type and width, and the values of each at its times: {name: [(us, value), ...]}."""
    scopes, variables, changes, now = [], {}, {}, None
    words = iter(Path(path).read_text().split())
    header = {}
    for word in words:
        if word == "$enddefinitions":
            assert next(words) == "$end"
            break
        body = []
        while (part := next(words)) != "$end":
            body.append(part)
        if word == "$scope":
            scopes.append(body[1])
        elif word == "$upscope":
            scopes.pop()
        elif word == "$var":
            kind, width, code, name = body
            variables[code] = ".".join(scopes + [name])
            header[variables[code]] = (kind, int(width))
            changes[variables[code]] = []
        else:
            header[word] = " ".join(body)
    assert not scopes, "all scopes are closed"
    for word in words:
        if word[0] == "#":
            assert now is None or int(word[1:]) > now, "time goes on"
            now = int(word[1:])
        elif word in ("$dumpvars", "$end"):
            continue
        else:
            if word[0] in "01":
                value, code = int(word[0]), word[1:]
            else:
                code = next(words)
                value = int(word[1:], 2) if word[0] == "b" else float(word[1:]) if word[0] == "r" else word[1:]
            samples = changes[variables[code]]
            assert not samples or samples[-1][1] != value, "changes only"
            samples.append((now, value))
    return header, changes, now


class Folder(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.file("door.lad", DOOR)
        self.file("passes.scn", PASSES)
        self.file("fails.scn", FAILS)

    def file(self, name, content):
        (Path(self.folder.name) / name).write_text(content)

    def path(self, name):
        return Path(self.folder.name) / name

    def run_tests(self, *args, engine="interp"):
        return subprocess.run([RUNGC, "test", *args, "--engine", engine], cwd=self.folder.name, capture_output=True,
                              timeout=patience(), text=True)


class Failure(Folder):
    def test_the_message_has_scan_and_time_and_what_led_to_the_value(self):
        done = self.run_tests("fails.scn")
        self.assertEqual(done.returncode, WRONG)
        lines = done.stdout.splitlines()
        first = next(i for i, line in enumerate(lines) if "fails.scn:7:" in line)
        self.assertRegex(lines[first], r"fails\.scn:7: LOCK is 1, expected 0 \(scan 103, 1\.030 s\)$")
        self.assertEqual(lines[first + 1], "    LOCK (5101.00) = 1, since scan 101, 1.010 s")
        self.assertRegex(lines[first + 2],
                         r'^        written by rung \d+ "lock the door a second after it has closed", door\.lad:11$')
        self.assertEqual(lines[first + 3], "          TOND T_LOCK has run out: 1.000 s")
        self.assertEqual(lines[first + 4], "          CLOSED (5100.00) = 1, unchanged since the start")
        self.assertIn("          fails.scn:2: set CLOSED 1", lines)
        self.assertLessEqual(len(lines), 20, done.stdout)

    def test_a_timer_that_has_not_run_out_is_named_with_its_time(self):
        self.file("early.scn", "program door.lad\nset CLOSED 1\nscan 20\nexpect LOCK 1\n")
        done = self.run_tests("early.scn")
        self.assertEqual(done.returncode, WRONG)
        self.assertRegex(done.stdout, r"\n +TON\w* T_LOCK runs: 0\.190 s of 1\.000 s\n")
        self.assertRegex(done.stdout, r"it would be different with the time of TON\w* T_LOCK over\n")
        self.assertRegex(done.stdout, r"\n +early\.scn:2: set CLOSED 1\n")

    def test_a_long_chain_is_cut_and_the_rest_has_a_command(self):
        rungs = "".join(f"rung\n|--[5100.0{i}]--(5100.0{i + 1})\n" for i in range(8))
        self.file("chain.lad", "dialect nct\nmodule MAIN\n" + rungs)
        self.file("chain.scn", "program chain.lad\nscan 2\nset 5100.00 1\nscan 3\nexpect 5100.08 0\n")
        done = self.run_tests("chain.scn")
        self.assertEqual(done.returncode, WRONG)
        self.assertIn("      all of it: rungc replay chain.scn --why 5100.08\n", done.stdout)
        self.assertNotIn("chain.scn:3: set", done.stdout)
        whole = subprocess.run([RUNGC, "replay", "chain.scn", "--why", "5100.08"], cwd=self.folder.name,
                               capture_output=True, timeout=patience(), text=True)
        self.assertIn("chain.scn:3: set 5100.00 1", whole.stdout)

    def test_the_explanation_is_of_the_program_that_the_scenario_runs(self):
        """It is run a second time for it: what it writes and prints is that of the first."""
        self.file("prints.scn", "program door.lad\nscan\nprint LOCK\nexpect LOCK 1\n")
        done = self.run_tests("prints.scn", engine="interp,jit")
        self.assertEqual(done.stdout.count("LOCK = 0\n"), 1, done.stdout)
        self.assertIn("    LOCK (5101.00) = 0, unchanged since the start\n", done.stdout)

    def test_places_are_called_as_on_the_wiring_diagram(self):
        self.file("press.lad", """dialect nct
module MAIN
symbol LS_TOP INP000.11 ; ram at top
symbol Y_UP   OUT000.05
symbol T_UP   5200
rung "up"
|--[LS_TOP]--[INP000.12]--{TOND T_UP #500 #0}--(Y_UP)
""")
        self.file("press.scn", "program press.lad\nset INP000.11 1\nscan\nexpect Y_UP 1\n")
        done = self.run_tests("press.scn")
        self.assertEqual(done.returncode, WRONG)
        self.assertRegex(done.stdout, r"    Y_UP \(OUT000\.05\) = 0, unchanged since the start\n"
                         r'        written by rung 1 "up", press\.lad:7\n'
                         r"          INP000\.12 = 0")
        self.assertNotRegex(done.stdout, r"\b0\d\d\d\.")
        self.assertNotIn("takes over", done.stdout)  # the clock of all timers is no rung of the program

    def test_a_real_needs_a_cell_of_its_width(self):
        """It used to be written over the neighbours of a shorter one."""
        self.file("cells.plc", CELLS)
        self.file("cells.scn", "program cells.plc\nset NEXT 7\nset LONG 1.5\n")
        done = self.run_tests("cells.scn")
        self.assertEqual(done.returncode, WRONG)
        self.assertIn("cells.scn:3: this name is an integer of 32 bits, so it cannot be 1.5: expected a whole "
                      "number, or a name of 64 bits, which a real has", done.stdout)
        self.file("cells.scn", "program cells.plc\nset NEXT 7\nset VALUE 1.5\nexpect VALUE 1.5\nexpect NEXT 7\n")
        self.assertEqual(self.run_tests("cells.scn").returncode, OK)

    def test_all_engines_say_the_same(self):
        done = self.run_tests("fails.scn", engine="interp,jit")
        self.assertIn("[interp] LOCK is 1, expected 0 (scan 103, 1.030 s)", done.stdout)
        self.assertIn("CLOSED (5100.00) = 1, unchanged since the start", done.stdout)


DEFINITION = """<PLCTableDef><Definition><DefinitionID>T</DefinitionID><ColsCount>1</ColsCount></Definition>
<Col No="0"><ColID>A</ColID><ColType>INT</ColType></Col></PLCTableDef>"""
TABLE = """<PLCTable><Definition><DefinitionID>T</DefinitionID><LinesCount>2</LinesCount></Definition></PLCTable>"""

TABLES = "config PlcTableDef0 t.PlcTDef\nconfig PlcTable0 t.PlcT\n"


class Mistakes(Folder):
    def said(self, text, status=WRONG):
        self.file("wrong.scn", text)
        done = self.run_tests("wrong.scn")
        self.assertEqual(done.returncode, status, done.stdout)
        return [line.strip() for line in done.stdout.splitlines() if line.startswith("  wrong.scn:")]

    def test_all_are_said_at_once(self):
        self.assertEqual(self.said("program door.lad\nset START 2\nset NOBODY 1\nwait 1s\nscan\nset COUNT on\nunforce NOTHING\nexpect_range COUNT 5 1\nset LOCK 3\n"),
                         ["wrong.scn:2: a bit takes 0 or 1, not 2", "wrong.scn:3: 'NOBODY' is not a name of this program",
                          "wrong.scn:4: unknown statement 'wait'; did you mean: run 250ms",
                          "wrong.scn:6: this name is not a bit, so it cannot be on: expected a number",
                          "wrong.scn:7: 'NOTHING' is not a name of this program",
                          "wrong.scn:8: no value is in the range from 5 to 1: write expect_range COUNT 1 5", "wrong.scn:9: a bit takes 0 or 1, not 3"])
        self.assertEqual([line.split(":")[1] for line in self.said("program door.lad\nconfig nobody 1\nconfig nothing 2\nscan\n")], ["2", "3"])

    def test_a_range_of_one_value(self):
        self.assertEqual(self.said("program door.lad\nscan\nexpect_range COUNT 0 0\nexpect_range COUNT -1.5 0x10\n", status=OK), [])

    def test_the_mark_of_dos_ends_the_file(self):
        self.assertEqual(self.said(PASSES + "\x1a\0 and what was in the sector", status=OK), [])

    def test_other_kinds_of_files(self):
        for name in ("door.map", "door.so", "door.toml", "door.bind"):
            self.file(name, "")
        for words, message in ((["test", "door.map"], "'door.map' is a mapping file, not a scenario: `rungc map --check door.map PROGRAM` checks it"),
                               (["test", "door.so"], "'door.so' is a compiled program, not a scenario: `rungc run door.so` runs it"),
                               (["test", "door.lad"], "'door.lad' is a program, not a scenario: `rungc check door.lad` checks it; a scenario is a file of its own that "
                                                      "begins with: program door.lad"),
                               *((command, "'passes.scn' is a scenario, not a program: `rungc test passes.scn` runs it") for command in
                                 (["check", "passes.scn"], ["diff", "door.lad", "passes.scn"], ["view", "passes.scn", "-o", "x.html"], ["xref", "passes.scn"], ["run", "passes.scn"])),
                               (["check", "door.toml"], "'door.toml' is a project file, not a program: `rungc check --project door.toml` checks its program"),
                               (["check", "door.bind"], "'door.bind' is a binding file, not a program: `rungc bind --members door.bind` connects its members"),
                               (["map", "door.map", "door.lad"], "'door.map' is a mapping file, not a program: `rungc map --check door.map PROGRAM` checks it"),
                               (["map", "--no-project", "--check", "door.lad", "door.lad"], "'door.lad' is a program, not a mapping file: `rungc check door.lad` checks it")):
            done = subprocess.run([RUNGC, *words], cwd=self.folder.name, capture_output=True, timeout=patience(), text=True, check=False)
            self.assertEqual((done.returncode, done.stderr), (USAGE, f"rungc: {message}\n"), words)

    def test_a_file_that_no_command_takes(self):
        self.file("door.csv", "START,7000.00\n")
        done = subprocess.run([RUNGC, "check", "door.csv"], cwd=self.folder.name, capture_output=True, timeout=patience(), text=True, check=False)
        self.assertEqual(done.returncode, WRONG)
        self.assertIn("the file is not one of a program by its name; those have the extensions .lad, ", done.stderr)


class WrongDevices(Folder):
    """Devices of TECHNOL's control that do not exist or are configured wrongly."""

    def setUp(self):
        super().setUp()
        self.file("cells.plc", CELLS)
        self.file("t.PlcTDef", DEFINITION)
        self.file("t.PlcT", TABLE)

    def complaint(self, statements):
        self.file("w.scn", "program cells.plc\n" + statements + "\n")
        done = self.run_tests("w.scn")
        self.assertEqual(done.returncode, WRONG, done.stdout + done.stderr)
        return done.stdout

    def test_axes(self):
        for line, message in (
                ("config axis.9.Feed 5\nscan", "'axis.9.Feed' is for axis 9; the axes are XYZC, 1 to 4 (config axes)"),
                ("config switch.P1IN.2 9 1 2\nscan", "'switch 9 1 2' is for axis 9"),
                ("config axis.1.Position 1e300", "w.scn:3: 'Position' needs a number of -1e9 to 1e9; found '1e300'"),
                ("set NC.MPOS.1 1e300", "w.scn:3: a place is a number of -1e9 to 1e9"),
                ("event handwheel", "w.scn:3: handwheel: 'pulses' is missing"),
                ("event handwheel pulses=0.5", "w.scn:3: handwheel: 'pulses' takes "),
                ("event handwheel pulses=1 wheel=3", "w.scn:3: handwheel: 'wheel' takes 1 to 2")):
            self.assertIn(message, self.complaint("config nc simulated\n" + line), line)

    def test_tables(self):
        for line, message in (
                ("set PlcTable0[2].A 1", "w.scn:4: PLC table 0 has no line 2; its lines are 0 to 1"),
                ("set PlcTable0[0].B 1", "w.scn:4: PLC table 0 has no column 'B'"),
                ("set PlcTable0[0].A 1.5", "w.scn:4: column 'A' is '1.5', expected an integer"),
                ("expect PlcTable7[0].A 1", "w.scn:4: there is no PLC table 7"),
                ("set PlcTable0.SelLine 2", "w.scn:4: PLC table 0 has no line 2; its lines are 0 to 1"),
                ("set PlcTable0.SelLine -1", "w.scn:4: a line is a number from 0"),
                ("expect PlcTable0.Lines 2", "w.scn:4: PLC table 0 has LinesCount and SelLine"),
                ("event PLCT table=0", "w.scn:4: PLCT: either add=1, or remove with the number of a line"),
                ("config PlcTable-1 t.PlcT", "w.scn:4: 'PlcTable-1' is not a configuration key")):
            self.assertIn(message, self.complaint(TABLES + line), line)

    def test_a_table_file(self):
        self.file("t.PlcT", TABLE.replace("LinesCount>2", "LinesCount>many"))
        found = self.complaint(TABLES + "scan")
        self.assertRegex(found, r"w\.scn:3: .*t\.PlcT:1:\d+: <LinesCount> is 'many', expected 0 to 65535\n")

    def test_shared_areas(self):
        for name in ("SA0+31999:2", "SA2+0:1", "SA0+0:3", "SA1+0"):
            self.assertIn("w.scn:2: a cell of a shared area is SA0+OFFSET:WIDTH or SA1+OFFSET:WIDTH",
                          self.complaint(f"set {name} 1"), name)
        self.assertIn("w.scn:2: SA_LOCK: 'area' is missing", self.complaint("event SA_LOCK"))


class Trace(Folder):
    def test_vcd(self):
        done = self.run_tests("passes.scn", "--trace", "t.vcd")
        self.assertEqual(done.returncode, OK, done.stdout + done.stderr)
        header, changes, end = read_vcd(self.path("t.vcd"))
        self.assertEqual(header["$timescale"], "1 us")
        self.assertEqual(header["door.M.LOCK"], ("wire", 1))
        self.assertEqual(header["door.M.COUNT"], ("wire", 32))
        flags = {"FL_ER", "FL_UF", "FL_OF", "FL_CY"}  # of the addition
        self.assertEqual({name.split(".", 2)[2] for name in changes}, {"CLOSED", "START", "LOCK", "T_LOCK", "COUNT"} | flags)
        self.assertEqual(changes["door.M.CLOSED"], [(0, 0), (10000, 1)])
        self.assertEqual(changes["door.M.LOCK"], [(0, 0), (1010000, 1)])
        self.assertEqual(changes["door.M.COUNT"], [(0, 0), (40000, 1)])
        self.assertEqual(changes["door.M.T_LOCK"][:3], [(0, 0), (10000, 1000), (20000, 990)])
        self.assertEqual(end, 1030000)

    def test_csv(self):
        done = self.run_tests("passes.scn", "--trace", "t.csv", "--watch", "LOCK", "T_LOCK", "COUNT")
        self.assertEqual(done.returncode, OK, done.stdout + done.stderr)
        with open(self.path("t.csv"), newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(list(rows[0]), ["time_s", "scan", "LOCK", "T_LOCK", "COUNT"])
        self.assertEqual([row["scan"] for row in rows], [str(n) for n in range(104)])
        self.assertEqual(rows[0], {"time_s": "0.000000", "scan": "0", "LOCK": "0", "T_LOCK": "0", "COUNT": "0"})
        self.assertEqual([row["LOCK"] for row in rows].index("1"), 101)
        self.assertEqual(rows[101]["time_s"], "1.010000")
        self.assertEqual([row["COUNT"] for row in rows].index("1"), 4)

    def test_a_failing_scenario_leaves_its_trace(self):
        done = self.run_tests("fails.scn", "--trace", "t.vcd", "--watch", "LOCK")
        self.assertEqual(done.returncode, WRONG)
        _, changes, end = read_vcd(self.path("t.vcd"))
        self.assertEqual((changes["door.M.LOCK"], end), ([(0, 0), (1010000, 1)], 1030000))

    def test_quantities_of_the_nc_are_real(self):
        self.file("gsk.pmc", "FUNC END1\nLD   X1.0\nOUT  Y1.0\nFUNC END2\n")
        self.file("gsk.scn", "program gsk.pmc\nset NC.MPOS.1 2.5\nset X1.0 1\nscan\nexpect Y1.0 1\n")
        done = self.run_tests("gsk.scn", "--trace", "t.vcd", "--watch", "NC.MPOS.1", "Y1.0")
        self.assertEqual(done.returncode, OK, done.stdout + done.stderr)
        header, changes, _ = read_vcd(self.path("t.vcd"))
        self.assertEqual(header["gsk.NC.NC.MPOS.1"], ("real", 64))
        self.assertEqual(changes["gsk.NC.NC.MPOS.1"][-1][1], 2.5)
        self.assertEqual(changes["gsk.Y.Y1.0"][-1][1], 1)

    def test_reals_of_programs_are_real(self):
        """Without names, what rungs read and write, as what they take it for; by name, as the name says."""
        self.file("sum.lad", "dialect nct\nmodule MAIN\nsymbol SPEED 7002\nrung\n|--[7100.00]--{MOVF 7000 *2.5}\n"
                             "rung\n|--[7100.00]--{+F SPEED 7000 *0.25}\n")
        self.file("sum.scn", "program sum.lad\nset 7100.00 1\nscan\nexpect SPEED 2.75\n")
        self.file("cells.plc", CELLS.replace("MODULE_MAIN\n", "MODULE_MAIN\n        LOD  CNST.0.1\n        STO  REAL.VALUE\n"))
        self.file("cells.scn", "program cells.plc\nscan\nexpect VALUE 0.1\n")
        for scenario, names, last in (("sum.scn", (), {"REAL.7000": "2.5", "REAL.7002": "2.75"}),
                                      ("sum.scn", ("REAL.SPEED", "SPEED"), {"REAL.SPEED": "2.75", "SPEED": "0"}),
                                      ("cells.scn", (), {"REAL.VALUE": "0.1", "NEXT": "0", "LAST": "0"}),
                                      ("cells.scn", ("REAL.VALUE", "QWRD.VALUE"), {"REAL.VALUE": "0.1", "QWRD.VALUE": str(0x3FB999999999999A)})):
            watched = ["--watch", *names] if names else []
            done = self.run_tests(scenario, "--trace", "t.csv", *watched)
            self.assertEqual(done.returncode, OK, done.stdout + done.stderr)
            with open(self.path("t.csv"), newline="") as file:
                row = list(csv.DictReader(file))[-1]
            self.assertLessEqual(last.items(), row.items())
            self.run_tests(scenario, "--trace", "t.vcd", *watched)
            header, changes, _ = read_vcd(self.path("t.vcd"))
            for name, value in last.items():
                if name.startswith("REAL."):
                    (full,) = [shown for shown in header if shown.endswith("." + name)]
                    self.assertEqual((header[full], changes[full][-1][1]), (("real", 64), float(value)))

    def test_what_cannot_be_traced_is_a_usage_error(self):
        for args, message in ((["passes.scn", "--trace", "t.txt"], "its name must end in .vcd or .csv"),
                              (["passes.scn", "fails.scn", "--trace", "t.vcd"], "--trace takes one scenario, not 2"),
                              (["passes.scn", "--trace", "t.vcd", "--watch", "LOKC"],
                               "'LOKC' is not a name of this program; did you mean LOCK?"),
                              (["passes.scn", "--watch", "LOCK"], "requires --trace")):
            done = self.run_tests(*args)
            self.assertEqual(done.returncode, USAGE, f"{args}: {done.stdout}{done.stderr}")
            self.assertIn(message, done.stdout + done.stderr)
            self.assertFalse(self.path("t.vcd").exists())

    def test_a_file_that_cannot_be_written_is_an_error_of_the_environment(self):
        done = self.run_tests("passes.scn", "--trace", "missing/t.vcd")
        self.assertEqual(done.returncode, ENVIRONMENT)
        self.assertIn("cannot write 'missing/t.vcd'", done.stdout + done.stderr)


if __name__ == "__main__":
    RUNGC = Path(sys.argv.pop(1)).resolve()
    unittest.main()
