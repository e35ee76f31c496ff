#!/usr/bin/env python3
"""Edits of every kind on the example machines, put in while the machine works. machines_test.py RUNGC [--long]

With --long on all engines, and all scenarios of the examples while their program is replaced; without it on the interpreter
and the JIT, and one scenario of each example. Each case changes a few lines of a machine's sources, replaces the running program by the result, and says
what the report has, no more and no less, and how the machine goes on: its timers have counted on, its counters and what
it retains are as they were, and its outputs do not change in the scan after.
"""
import re
import shutil
import subprocess
import sys
import tempfile
import tomllib
import unittest
from pathlib import Path

RUNGC = ""
LONG = False
ROOT = Path(__file__).resolve().parents[2]
PATIENCE = 3000  # seconds, of a busy machine: each program is compiled for every engine


def engines():
    return "all" if LONG else "jit,interp"


class Edit:
    """In a file, `old` becomes `new`, wherever it is; or a whole file that is added to the program."""

    def __init__(self, file, old, new):
        self.file, self.old, self.new = file, old, new

    def apply(self, folder):
        path = folder / self.file
        text = path.read_text(encoding="utf-8")
        assert self.old in text, f"{self.file} does not have: {self.old}"
        path.write_text(text.replace(self.old, self.new), encoding="utf-8")


def word(file, old, new):
    """A name, wherever it is a whole word."""
    class Word(Edit):
        def apply(self, folder):
            path = folder / file
            text, count = re.subn(rf"\b{old}\b", new, path.read_text(encoding="utf-8"))
            assert count > 0, f"{file} does not have {old}"
            path.write_text(text, encoding="utf-8")
    return Word(file, old, new)


class Added(Edit):
    def __init__(self, file, text):
        super().__init__(file, None, text)

    def apply(self, folder):
        (folder / self.file).write_text(self.new, encoding="utf-8")


class Machine(unittest.TestCase):
    folder = ""      # in examples
    start = ("", "")  # a scenario of it, and the line of that at which the machine is on
    works = ""       # from there to the moment at which the program is replaced
    goes_on = ""     # after a scan: everything as it was
    until = ""       # then: timers end when they should
    outputs = ()     # that must not change in the scan after

    @classmethod
    def setUpClass(cls):
        if not cls.folder:
            raise unittest.SkipTest("what the machines have in common")
        cls.scratch = tempfile.TemporaryDirectory()
        cls.now = Path(cls.scratch.name) / "now"
        shutil.copytree(ROOT / "examples" / cls.folder, cls.now)
        for scenario in cls.now.glob("*.scn"):
            scenario.unlink()
        cls.files = tomllib.loads((cls.now / "rung.toml").read_text(encoding="utf-8"))["files"]

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def head(self):
        """The scenario's lines, without its program, until the machine is on."""
        name, on = self.start
        lines = (ROOT / "examples" / self.folder / name).read_text(encoding="utf-8").splitlines()
        lines = [line for line in lines[:lines.index(on) + 1] if not line.startswith("program ")]
        return "\n".join(lines)

    def edited(self, name, edits):
        """The files of the edited program, as a scenario in the machine's folder names them."""
        folder = self.now.parent / name
        shutil.copytree(self.now, folder)
        files = list(self.files)
        for edit in edits:
            edit.apply(folder)
            if edit.old is None:
                files.append(edit.file)
        return " ".join(f"../{name}/{file}" for file in files)

    def case(self, edits, changes, goes_on=None, until=None, released=()):
        name = self.id().rsplit(".", 1)[1]
        unchanged = "\n".join(f"expect {output} {value}" for output, value in self.outputs)
        after = "\n".join(f"expect {output} {0 if output in released else value}" for output, value in self.outputs)
        report = "\n".join(f"expect_change {change}" for change in changes)
        goes_on = self.goes_on if goes_on is None else goes_on
        until = self.until if until is None else until
        text = (f"program {' '.join(self.files)}\n{self.head()}\n{self.works}\n{unchanged}\n{self.goes_on}\n"
                f"replace {self.edited(name, edits)}\n{report}\nexpect_no_change\n"
                f"{goes_on}\n{after}\nscan\n{goes_on}\n{after}\n{until}\n")
        scenario = self.now / f"{name}.scn"
        scenario.write_text(text, encoding="utf-8")
        done = subprocess.run([RUNGC, "test", str(scenario), "--engine", engines(), "-O", "0"], capture_output=True,
                              text=True, timeout=PATIENCE)
        self.assertEqual((done.returncode, done.stderr), (0, ""), done.stdout)


class GskMill(Machine):
    """The part counter has counted, the coolant has just gone off, and air blows for two seconds."""
    folder = "gsk-mill"
    start = ("coolant-lubrication.scn", "expect READY 1")
    works = """
set F10:4 8
set MF 1
scan
set MF 0
scan
expect COOLANT_PUMP 1
set D122:2 41
set DM30 1
scan
set DM30 0
run 1s
"""
    goes_on = "expect D122:2 42\nexpect BLOW_OFF 1\nexpect POCKETS:2 12"
    outputs = (("AIR_BLOW", 1), ("COOLANT_PUMP", 0), ("HYDRAULICS", 1), ("DOOR_LOCK", 1), ("ON_LAMP", 1))
    until = """
run 800ms
expect AIR_BLOW 1
run 300ms
expect AIR_BLOW 0
set DM30 1
scan
expect D122:2 43
set DM30 0
# the interval of the lubrication has gone on, too
expect LUBE_PUMP 0
run 2700ms
expect LUBE_PUMP 1
"""

    def test_rung_added(self):
        rung = "; warning 41\nLD   R54.1\n"
        self.case([Edit("mill.pmc", rung, f"LD   BLOW_OFF\nFUNC DIFU\nPRM  99\nOUT  R54.7\n\n{rung}")],
                  ["new state \"P12/DIFU 99/edge\""])

    def test_rung_removed(self):
        self.case([Edit("mill.pmc", "LDI  LUBE_LEVEL\nFUNC TMRB\nPRM  36\nPRM  1000\nOUT  R54.1\n", "")],
                  ["removed state \"P12/TMRB 36/elapsed\"", "removed state \"P12/TMRB 36/last\""])

    def test_output_released(self):
        self.case([Edit("mill.pmc", "LD   AIR_ORDER\nOR   BLOW_OFF\nAND  DOOR_CLOSED\nOUT  AIR_BLOW\n", "")],
                  ["released AIR_BLOW"], until="run 800ms\nexpect AIR_BLOW 0", released=("AIR_BLOW",))

    def test_symbol_renamed(self):
        self.case([word("mill.pmc", "BLOW_OFF", "AIR_AFTER")], ["renamed BLOW_OFF AIR_AFTER"],
                  self.goes_on.replace("BLOW_OFF", "AIR_AFTER"))

    def test_time_changed(self):
        self.case([Edit("mill.pmc", "PRM  34\nPRM  2000", "PRM  34\nPRM  3000")], [],
                  until="run 1800ms\nexpect AIR_BLOW 1\nrun 300ms\nexpect AIR_BLOW 0")

    def test_cell_moved(self):
        self.case([Edit("mill.pmc", "symbol BLOW_OFF       R53.1", "symbol BLOW_OFF       R53.3")], ["moved BLOW_OFF"],
                  self.goes_on + "\nexpect R53.1 0")

    def test_cell_retyped(self):
        self.case([word("mill.pmc", "SCRATCH", "R99.0"),
                   Edit("mill.pmc", "symbol R99.0        R99.0", "symbol SCRATCH R99")], ["retyped SCRATCH"])

    def test_module_added(self):
        self.case([Edit("mill.pmc", "FUNC CALLU\nPRM  P12\n", "FUNC CALLU\nPRM  P12\n\nFUNC CALLU\nPRM  P90\n"),
                   Edit("mill.pmc", "FUNC SP\nPRM  P12\n",
                        "FUNC SP\nPRM  P90\n\nLD   BLOW_OFF\nFUNC TMRB\nPRM  90\nPRM  480\nOUT  R150.0\n\nFUNC SPE\n\n"
                        "FUNC SP\nPRM  P12\n")],
                  ["new state \"P90/TMRB 90/elapsed\"", "new state \"P90/TMRB 90/last\""],
                  until="expect R150.0 0\nrun 500ms\nexpect R150.0 1" + self.until.replace("run 800ms", "run 300ms"))


class FanucVmc(Machine):
    """The conveyor has backed off twice, the lubrication counts its seconds, and a part has been counted."""
    folder = "fanuc-vmc"
    start = ("chips.scn", "include on.part")
    works = """
set CHIP_FIT 1
set M_CODE 31
set MF 1
scan
set MF 0
set TOTAL:4 41
set CHIP_OK 0
run 300ms
set CHIP_OK 1
run 3100ms
set CHIP_OK 0
run 300ms
set CHIP_OK 1
set M_CODE 30
set MF 1
scan
set MF 0
run 1s
"""
    goes_on = "expect TOTAL:4 42\nexpect CHIP_REV 1\nexpect C5000:2 2"
    outputs = (("CHIP_REV", 1), ("CHIP_FWD", 0), ("HYD_PUMP", 1), ("DOOR_LOCK", 1), ("MC_ON_LAMP", 1))
    until = """
run 1700ms
expect CHIP_REV 1
run 400ms
expect CHIP_REV 0
expect CHIP_FWD 1
set CHIP_OK 0
run 300ms
expect_message 2004
"""

    def test_rung_added(self):
        rung = "(* lamp: chip conveyor *)\n"
        self.case([Edit("vmc.mne", rung, f"(* new *)\nRD CHIP_FWD\nDIFU 99\nWRT R150.7\n{rung}")],
                  ["new state @edge/99"])

    def test_rung_removed(self):
        self.case([Edit("vmc.mne", "RD         CHIP_FWD\nAND        CHIP_OK\nTMRB\n36\n30000\nWRT        CHIP_GOOD\n", "")],
                  ["removed state \"P13/TMRB 36/elapsed\"", "removed state \"P13/TMRB 36/last\""])

    def test_output_released(self):
        self.case([Edit("vmc.mne", "WRT        L_CHIP\n", "WRT        R150.6\n")], ["released L_CHIP"],
                  released=("L_CHIP",))

    def test_symbol_renamed(self):
        self.case([word("vmc.mne", "CHIP_FREE", "CHIP_BACK")], ["renamed CHIP_FREE CHIP_BACK"])

    def test_time_changed(self):
        self.case([Edit("vmc.mne", "TMRB\n35\n3000\n", "TMRB\n35\n4000\n")], [],
                  until="run 2700ms\nexpect CHIP_REV 1\nrun 400ms\nexpect CHIP_REV 0\nexpect CHIP_FWD 1")

    def test_cell_moved(self):
        self.case([Edit("vmc.mne", "CHIP_FREE,R0031.2,", "CHIP_FREE,R0150.3,")], ["moved CHIP_FREE"],
                  self.goes_on + "\nexpect R31.2 0")


class NctTurningCentre(Machine):
    """An axis has asked for lubrication; the pump has run for three of ten seconds, for the first time."""
    folder = "nct-turning-centre"
    start = ("lubrication.scn", "expect READY 1")
    works = """
set AN_LUBR,ZB 1
scan
set AN_LUBR,ZB 0
set LUBE_PRESS 1
run 3s
set TOTAL 7
"""
    goes_on = "expect LUB_DONE 1\nexpect TOTAL 7\nexpect LUB_ON 1\nexpect READY 1"
    outputs = (("LUBE_PUMP", 1), ("HYD_PUMP", 1), ("COOL_PUMP", 0))
    until = """
run 6800ms
expect LUBE_PUMP 1
run 300ms
expect LUBE_PUMP 0
expect LUB_ON 0
set AN_LUBR,ZB 1
scan
set AN_LUBR,ZB 0
expect LUB_DONE 2
expect F_LUBE 0
"""
    level = "rung\n|--[N_MONST]--[/LUBE_LEVEL]--{TOND T_LEVEL #2 SEC}--(OIL_LOW)\n"

    def test_rung_added(self):
        self.case([Edit("fluids.lad", self.level, self.level + "\nrung\n|--[READY]--{TOND 6440 #1 SEC}--(6130.00)\n")],
                  ["new state \"MAIN.SBN42/TOND 6440/active\"", "new state \"MAIN.SBN42/TOND 6440/since\""])

    def test_rung_removed(self):
        self.case([Edit("fluids.lad", self.level, "")],
                  ["removed state \"MAIN.SBN42/TOND T_LEVEL/active\"", "removed state \"MAIN.SBN42/TOND T_LEVEL/since\""])

    def test_symbol_renamed(self):
        files = ("channels.lad", "memory.lad", "nc.lad")
        self.case([word(file, "TOTAL", "PIECE") for file in files], ["renamed TOTAL PIECE"],
                  self.goes_on.replace("TOTAL", "PIECE"))

    def test_time_changed(self):
        """A pulse that is under way keeps the time that it began with; the next one has the new time."""
        self.case([Edit("fluids.lad", "T_LUBE P_LUBSEC SEC", "T_LUBE #12 SEC")], [],
                  until=self.until + "run 11800ms\nexpect LUBE_PUMP 1\nrun 300ms\nexpect LUBE_PUMP 0")

    def test_cell_moved(self):
        self.case([Edit("memory.lad", "symbol LUB_DONE   PLCNVRAM,#13", "symbol LUB_DONE   PLCNVRAM,#20")],
                  ["moved LUB_DONE"], self.goes_on + "\nexpect PLCNVRAM,#13 0")

    def test_timer_moved(self):
        self.case([Edit("memory.lad", "symbol T_LUBE     6429", "symbol T_LUBE     6440")], ["moved T_LUBE"])

    def test_cell_retyped(self):
        self.case([word("fluids.lad", "OIL_LOW", "6130.00"), word("messages.lad", "OIL_LOW", "6130.00"),
                   Edit("memory.lad", "symbol OIL_LOW    6020.26", "symbol OIL_LOW    6131")], ["retyped OIL_LOW"])

    def test_file_added(self):
        extra = ("; one more\ndialect nct\nmodule MAIN\n\nsection \"90: one more\"\n\nrung\n|--{SBN #90}\n\n"
                 "rung\n|--[LUBE_PUMP]--{TOND 6440 #1 SEC}--(6130.00)\n\nrung\n|--[N_ON]--{RET}\n")
        self.case([Added("extra.lad", extra), Edit("main.lad", "           +--{SBS #42}\n",
                                                   "           +--{SBS #42}\n           +--{SBS #90}\n")],
                  ["new state \"MAIN.SBN90/TOND 6440/active\"", "new state \"MAIN.SBN90/TOND 6440/since\""],
                  until="expect 6130.00 0\nrun 1100ms\nexpect 6130.00 1" + self.until.replace("6800ms", "5700ms"))


class TechnolMachiningCentre(Machine):
    """A stroke of lubrication has run for 5 of its 15 seconds; its counts lie in memory that the compiler gives out."""
    folder = "technol-machining-centre"
    start = ("lubrication.scn", "expect READY 1")
    works = """
set PLC_MEM_BACKUP+24:4 41
event PLCCOMMAND CODE=CMD_LUBRICATE STATE=1
run 1100ms
expect O_LUB 1
set P6IN.I_LUB_PRESS 1
run 5s
block start M30_PID=1 AUTPI=1
block done
scan 3
"""
    goes_on = """expect_range LUB_RUN 5 6
expect LUB_GOT 1
expect LUB_PAUSE 20
expect PLC_MEM_BACKUP+24:4 42
expect Machine.Parts 42
expect Machine.Status "READY"
expect PLC.Output.Lamp.Yellow 1"""
    outputs = (("O_LUB", 1), ("P4OUT.1", 1), ("O_CHIP_BACK", 0))
    until = """
run 8s
expect O_LUB 1
run 3s
expect O_LUB 0
expect STOP_AFTER 0
expect Machine.Status "READY"
"""
    low = "        LDR  -I_LUB_LEVEL\n        LA   POWER\n        WR   LUB_LOW\n"

    def data_after(self, file, cell):
        """The cells with names that come after one, in the order in which the compiler gives addresses out."""
        names, after = [], False
        for source in self.files[self.files.index(file):]:
            text = (self.now / source).read_text(encoding="utf-8")
            data = re.search(r"^DATA\n(.*?)^DATA_END", text, re.S | re.M).group(1)
            for line in data.splitlines():
                line = line.split(";")[0]
                label = re.match(r"(\w+):", line)
                found = [label.group(1)] if label else []
                if bits := re.search(r"\bDFM\s+(\S+)", line):
                    found += [bit for bit in bits.group(1).split(",") if bit]
                if after:
                    names += found
                after = after or cell in found
        return names

    def test_rung_added(self):
        self.case([Edit("fluids.plc", self.low, f"        EDGE_H O_LUB\n{self.low}")], ["new state \"MODULE_MAIN.EDGE_H O_LUB\""])

    def test_rung_removed(self):
        lines = "        EDGE_H K_RESET\n        JL0  CHIPS_END\n        FL   0,CHIP_JAM\n        LOD  0\n        STO  CHIP_TRIPS\n"
        self.case([Edit("fluids.plc", lines, "")], ["removed state \"MODULE_MAIN.EDGE_H K_RESET~1\""])

    def test_symbol_renamed(self):
        """Contents go by names alone."""
        self.case([word("fluids.plc", "LUB_DRY", "DRY_TIME")], ["new DRY_TIME", "removed LUB_DRY"])

    def test_time_changed(self):
        self.case([Edit("fluids.plc", "        LOD  LUB_TIME\n", "        LOD  CNST.20\n")], [],
                  until="run 13s\nexpect O_LUB 1\nrun 3s\nexpect O_LUB 0")

    def test_cells_moved(self):
        """So are the texts that the screens share, and a lamp whose connection goes along."""
        self.case([Edit("fluids.plc", "LUB_RUN:    DS 2\n", "STROKES:    DS 2\nLUB_RUN:    DS 2\n")],
                  ["new STROKES"] + [f"moved {name}" for name in self.data_after("fluids.plc", "LUB_SECS")])

    def test_cell_retyped(self):
        self.works += "set CHIP_TRIPS 2\n"
        self.case([Edit("fluids.plc", "CHIP_TRIPS: DS 1", "CHIP_TRIPS: DS 2")],
                  ["retyped CHIP_TRIPS"] + [f"moved {name}" for name in self.data_after("fluids.plc", "CHIP_TRIPS")],
                  self.goes_on + "\nexpect CHIP_TRIPS 0")

    def test_file_added(self):
        extra = ("        T_INCLUDE centre.inc\nDATA\nEXTRA: DS 2\nDATA_END\n\nMODULE_MAIN\n        LOD  EXTRA\n        INR\n"
                 "        STO  EXTRA\nMODULE_MAIN_END\n")
        self.case([Added("extra.plc", extra)], ["new EXTRA"], until="expect EXTRA 1\nscan 2\nexpect EXTRA 3" + self.until)

    def test_a_connected_input_that_is_gone(self):
        """Its connection ends; the program declares it anew when it is started again."""
        self.works += "set P8IN 0x0A\n"
        self.goes_on += "\nexpect P8IN 0x0A"
        self.case([word("panel.plc", "K_LIGHT", "LIGHT_KEY")],
                  ["new LIGHT_KEY", "removed K_LIGHT", "removed state \"MODULE_MAIN.EDGE_H K_LIGHT\"",
                   "new state \"MODULE_MAIN.EDGE_H LIGHT_KEY\""],
                  self.goes_on + "\nexpect LIGHT_KEY 0", "plc stop\nplc start\nscan 2\nexpect LIGHT_KEY 1")


class ToAndFro(unittest.TestCase):
    """Every scenario of the examples does what it does without, while its program is replaced again and again: by one
    whose memory lies otherwise and whose services have other numbers, and back."""
    statements = 5  # between two replacements

    def with_replacements(self, scenario, programs):
        lines, count = [], 0
        for line in scenario.read_text(encoding="utf-8").splitlines():
            if line.split(" ")[0] in ("set", "scan", "run", "expect", "event", "block"):
                count += 1
                if count % self.statements == 0:
                    programs = programs[::-1]
                    lines.append(f"replace {programs[0]}")
            lines.append(line)
        scenario.write_text("\n".join(lines) + "\n", encoding="utf-8")

    def check(self, name, short, *edits):
        """`short`: the scenario of a run without --long."""
        with tempfile.TemporaryDirectory() as scratch:
            folder = Path(scratch) / name
            shutil.copytree(ROOT / "examples" / name, folder)
            shutil.copytree(folder, Path(scratch) / "other")
            for edit in edits:
                edit.apply(Path(scratch) / "other")
            files = tomllib.loads((folder / "rung.toml").read_text(encoding="utf-8"))["files"]
            for scenario in list(folder.glob("*.scn")):
                text = scenario.read_text(encoding="utf-8")
                # No program, or passes that do not end.
                if "expect_error" in text or "\nslot" in text or not (LONG or scenario.stem == short):
                    scenario.unlink()
                    continue
                program = re.search(r"^program (.*)", text, re.M)
                words = program.group(1).split() if program else files
                programs = (" ".join(words), " ".join(f"../other/{word}" for word in words))
                fro = scenario.with_suffix(".fro.scn")  # so that each statement meets both programs
                shutil.copy(scenario, fro)
                self.with_replacements(scenario, programs)
                self.with_replacements(fro, programs[::-1])
            self.assertTrue(list(folder.glob("*.fro.scn")), "there is no such scenario")
            done = subprocess.run([RUNGC, "test", str(folder), "--engine", "jit,interp", "-O", "0"], capture_output=True,
                                  text=True, timeout=PATIENCE)
            self.assertEqual((done.returncode, done.stderr), (0, ""), done.stdout)

    def test_gsk_mill(self):
        self.check("gsk-mill", "coolant-lubrication", Edit("mill.pmc", "FUNC END1\n", "FUNC END1\nLD   R199.0\nFUNC WINDW\nPRM  D900\n"
                                                               "PRM  R198\nOUT  R199.1\n"))

    def test_fanuc_vmc(self):
        self.check("fanuc-vmc", "coolant", Edit("vmc.mne", "\nEND1\n", "\nEND1\nRD R199.0\nWINDW\nD900\nWRT R199.1\n"))

    def test_gsk_panel(self):
        self.check("gsk-panel", "panel", Edit("panel.lad", "module LEVEL2\n", "module LEVEL2\n\nrung\n|--[R199.0]--(R199.1)\n"))

    mr = "\n\nrung\n|--[6199.00]--{MR 6150 #10}--(6199.01)\n"

    def test_nct_lathe(self):
        self.check("nct-lathe", "turret", Edit("main.lad", "section \"Start-up\"\n", "section \"Start-up\"" + self.mr))

    def test_nct_turning_centre(self):
        order = "section \"Order of a scan\""
        self.check("nct-turning-centre", "lubrication", Edit("main.lad", order, order + self.mr))

    @staticmethod
    def padded(file):
        return (Edit(file, "\nDATA\n", "\nDATA\nPADDING: DS 4\n        DFM  PAD_IN,PAD_OUT,,,,,,\n"),
                Edit(file, "\nMODULE_MAIN\n", "\nMODULE_MAIN\n        LDR  PAD_IN\n        WR   PAD_OUT\n"))

    def test_technol_mill(self):
        self.check("technol-mill", "tool-change", *self.padded("mill.plc"))

    def test_technol_machining_centre(self):
        lamp = "\nMODULE_INIT\n        DEF_OUT L_PAD,'Lamp.Pad',TYPE_BIT\n"
        self.check("technol-machining-centre", "lubrication", *self.padded("main.plc"), Edit("main.plc", "\nMODULE_INIT\n", lamp))


def main():
    global RUNGC, LONG
    RUNGC = sys.argv.pop(1)
    if "--long" in sys.argv:
        sys.argv.remove("--long")
        LONG = True
    unittest.main()


if __name__ == "__main__":
    main()
