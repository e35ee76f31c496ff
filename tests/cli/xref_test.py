#!/usr/bin/env python3
"""rungc xref as a user sees it: who reads and writes what, whatever the spelling. xref_test.py RUNGC"""
import json
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from patience import patience
from root import go_to_root

RUNGC = None
OK, WRONG = 0, 1

NCT = """dialect nct
module MAIN
symbol START 7000.00
symbol MOTOR 7001.00
symbol COUNT 7010
symbol IDX 7020
symbol SPARE 7030.05

rung "a switch"
|--[START]--(MOTOR)

rung "another spelling, and a double"
|--[7000.00]--[7000.00,#1]--+--{MOVF 7200 *1.5}
                            +--{MOV COUNT 7201}

rung "computed"
|--[START]--{MOV COUNT,IDX 7202}

rung
|--{END}
"""
GIVEN = """dialect nct
module MAIN

rung
|--[TN_TS1]--(7003.00)

rung
|--{END}
"""
GSK = """        LD X0.0
        FUNC MOVN
        PRM 4
        PRM D10
        PRM D20
        LD X0.1
        OUT Y0.0
        FUNC END1
        FUNC END2
"""
IMMEDIATE = """dialect nct
symbol LIMIT INP000.05 ; allow(never-written)
module INT0
rung
|--[!LIMIT]--(!OUT000.03)
rung
|--[/!INP000.05]--(S 7003.01)

module MAIN
rung
|--[OUT000.03]--(7000.00)
rung
|--[7000.00]--[7003.01]--(R 7003.01)
rung
|--{END}
"""
LATCHES = {
    "latch.pmc": """dialect gsk
symbol FLAG R5.0
symbol HELD R5.1
FUNC 0
LD X0.0
SET FLAG
SET HELD
LD X0.1
AND HELD
RST HELD
OUT Y0.0
FUNC 1
""",
    "latch.lad": """dialect nct
symbol FLAG 7001.00
symbol HELD 7001.01
module MAIN
rung
|--[7000.00]--+--(S FLAG)
              +--(S HELD)
rung
|--[7000.01]--[HELD]--+--(R HELD)
                      +--(7000.02)
rung
|--{END}
""",
    "latch.plc": """DATA
        DFM  FLAG,HELD,OUT
DATA_END
MODULE_INPUT
MODULE_INPUT_END
MODULE_MAIN
        LDR  OUT
        FL1  1,FLAG
        FL1  1,HELD
        LDR  HELD
        FL1  0,HELD
        WR   OUT
MODULE_MAIN_END
""" + "".join(f"MODULE_{name}\nMODULE_{name}_END\n" for name in ("BLOCK_INIT", "BLOCK_DONE", "INIT", "CLEAR", "HALT")) + "STOP\n",
}
NAMES = """DATA
        DFM  B0,B1
WORDS:  DS 8
DATA_END
MODULE_INPUT
MODULE_INPUT_END
MODULE_MAIN
        LOD  WORD.WORDS+2
        STO  BYTE.WORDS+5
        LDR  WORDS+1.B1
        WR   B1
MODULE_MAIN_END
""" + "".join(f"MODULE_{name}\nMODULE_{name}_END\n" for name in ("BLOCK_INIT", "BLOCK_DONE", "INIT", "CLEAR", "HALT")) + "STOP\n"


class Xref(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def xref(self, *args):
        done = subprocess.run([RUNGC, "xref", *map(str, args)], capture_output=True, text=True, timeout=patience(300), check=False)
        self.assertEqual(done.stderr, "", done.stderr)
        self.assertEqual(done.returncode, OK)
        return done.stdout

    def program(self, name, text):
        path = Path(self.folder.name) / name
        path.write_text(text)
        return path

    def entries(self, *args):
        return {entry["name"] or entry["address"]: entry for entry in json.loads(self.xref("--format", "json", *args))}

    def test_text(self):
        path = self.program("p.lad", NCT)
        self.assertEqual(self.xref(path, "--place", "MOTOR", "--place", "7201"), f"""MOTOR (7001.00)
  written  rung 1 "a switch", {path}:9
  read     rung 2 "another spelling, and a double", {path}:12
  perhaps  written by rung 3 "computed", {path}:16, as 7010, indexed

7201
  written  rung 2 "another spelling, and a double", {path}:12, as 7200 to 7201
  read     rung 2 "another spelling, and a double", {path}:12
  perhaps  written by rung 3 "computed", {path}:16, as 7010, indexed
""")

    def test_what_a_place_is_called_does_not_matter(self):
        entries = self.entries(self.program("p.lad", NCT))
        self.assertEqual([use["rung"] for use in entries["START"]["read"]], [1, 2, 3])
        self.assertEqual([use["rung"] for use in entries["7001.00"]["read"]] if "7001.00" in entries else
                         [use["rung"] for use in entries["MOTOR"]["read"]], [2], "7000.00,#1 is the same bit of the next word")

    def test_every_byte_of_an_operand(self):
        entries = self.entries(self.program("p.lad", NCT))
        self.assertEqual([use["rung"] for use in entries["7201"]["written"]], [2], "the second word of a double")
        table = self.program("p.pmc", GSK)
        for address in ("D20", "D22", "D23"):
            entry, = json.loads(self.xref("--format", "json", table, "--place", address))
            self.assertEqual(len(entry["written"]), 1, address)
        entry, = json.loads(self.xref("--format", "json", table, "--place", "D24"))
        self.assertEqual(entry["written"], [])

    def test_an_index(self):
        path = self.program("p.lad", NCT)
        count, = json.loads(self.xref("--format", "json", path, "--place", "COUNT"))
        self.assertEqual([(use["rung"], use.get("indexed", False)) for use in count["written"]], [(2, False), (3, True)])
        spare, = json.loads(self.xref("--format", "json", path, "--place", "SPARE"))
        self.assertEqual(([], [3]), (spare["written"], [use["rung"] for use in spare["perhaps_written"]]))

    def test_inputs_are_read_through_latches(self):
        entry, = json.loads(self.xref("--format", "json", self.program("p.pmc", GSK), "--place", "X0.1"))
        self.assertEqual((len(entry["read"]), entry["control_writes"]), (1, True))
        output, = json.loads(self.xref("--format", "json", self.program("p.pmc", GSK), "--place", "Y0.0"))
        self.assertTrue(output["control_reads"])
        self.assertNotIn("odd", output)
        given, = json.loads(self.xref("--format", "json", self.program("given.lad", GIVEN), "--place", "TN_TS1"))
        self.assertTrue(given["control_writes"])
        self.assertNotIn("control_reads", given)

    def test_odd_ones(self):
        """Those that check warns of: where an index may lead counts as read or written."""
        fixed = NCT.replace("COUNT,IDX", "COUNT")
        names = self.entries(self.program("p.lad", fixed), "--odd")
        self.assertEqual(names["SPARE"]["odd"], "used by no rung")
        self.assertEqual(names["START"]["odd"], "read, but written by no rung")
        self.assertEqual(names["MOTOR"]["odd"] if "MOTOR" in names else "", "")
        self.assertNotIn("START", self.entries(self.program("i.lad", NCT), "--odd"))

    def warned(self, path):
        """Names of places that check warns of, each with what is wrong with it."""
        done = subprocess.run([RUNGC, "check", "--json", path], capture_output=True, text=True, timeout=patience(300), check=False)
        codes = {"unused-name": "used by no rung", "never-written": "read, but written by no rung", "never-read": "written, but read by no rung",
                 "never-reset": "set, but reset by no rung"}
        text = path.read_text().splitlines()
        return {re.match(r"[\w.]+", text[found["line"] - 1][found["column"] - 1:]).group(): codes[found["code"]]
                for found in json.loads(done.stdout) if found["code"] in codes}

    def test_odd_names_are_those_that_check_warns_of(self):
        for name, text in {**LATCHES, "p.lad": NCT, "fixed.lad": NCT.replace("COUNT,IDX", "COUNT"), "given.lad": GIVEN,
                           "immediate.lad": IMMEDIATE}.items():
            path = self.program(name, text)
            odd = {entry["name"]: entry["odd"] for entry in json.loads(self.xref("--format", "json", "--odd", path)) if entry["name"]}
            self.assertEqual(odd, self.warned(path), name)
        self.assertEqual(self.warned(self.program("latch.lad", LATCHES["latch.lad"])), {"FLAG": "written, but read by no rung"})

    def test_addresses_go_by_the_rules_of_names(self):
        """What is odd about a name is odd about its address in a program without the name."""
        names = {"NEEDED": "R6.1", "LOST": "R6.2", "NOBODYS": "R6.3", "KEPT": "R6.4", "LAMP": "Y0.3"}
        text = "LD X0.0\nFUNC TMR\nPRM 1\nOUT NEEDED\nLD X0.1\nOUT LOST\nLD NOBODYS\nSET KEPT\nLD KEPT\nOUT LAMP\nFUNC END1\nFUNC END2\n"
        named = self.program("named.pmc", "".join(f"symbol {name} {address}\n" for name, address in names.items()) + text)
        bare = self.program("bare.pmc", "\n".join(line[:-len(line.split(" ")[-1])] + names.get(line.split(" ")[-1], line.split(" ")[-1]) for line in text.splitlines()) + "\n")
        warned = self.warned(named)
        self.assertEqual(warned, {"LOST": "written, but read by no rung", "NOBODYS": "read, but written by no rung", "KEPT": "set, but reset by no rung"})
        odd = {entry["address"]: entry["odd"] for entry in json.loads(self.xref("--format", "json", "--odd", bare))}
        self.assertEqual(odd, {names[name]: why for name, why in warned.items()})

    def test_what_the_control_has_is_not_odd(self):
        self.assertEqual(self.xref("--odd", "examples/technol-mill"), "", "P0OUT, STOP_REQ and the like")

    def test_outputs_of_technol_are_read_by_the_control(self):
        path = self.program("out.plc", NAMES.replace("        LOD  WORD.WORDS+2\n", "        MOVE P1OUT,BYTE.WORDS\n        LOD  WORD.WORDS+2\n"))
        self.assertRegex(self.xref(path, "--place", "P1OUT"), r"^P1OUT\n  written  rung \d+, .*\n  read     by the control or the machine\n$")

    def test_a_wider_access_of_gsk_has_its_width(self):
        path = self.program("wide.pmc", "dialect gsk\nsymbol N D10\nLD X0.0\nFUNC MOVW\nPRM N\nPRM D30\nFUNC END1\nFUNC END2\n")
        lines = self.xref(path).splitlines()
        self.assertTrue({"N (D10)", "D10:2", "D30:2"} <= set(lines), lines)
        self.assertTrue(self.xref(path, "--place", "D30:2").startswith("D30:2\n  written  rung "))
        self.assertTrue(self.xref(path, "--place", "D30").startswith("D30\n"))

    def test_setting_and_resetting_is_writing(self):
        for name, text in LATCHES.items():
            path = self.program(name, text)
            flag, held = json.loads(self.xref("--format", "json", path, "--place", "FLAG", "--place", "HELD"))
            self.assertEqual((len(flag["written"]), flag["read"]), (1, []), name)
            self.assertEqual(flag["odd"], "written, but read by no rung", name)
            self.assertEqual((len(held["written"]), len(held["read"])), (2, 1), f"{name}: a contact reads it")

    def test_the_time_slice_memory_is_no_other_place(self):
        path = self.program("i.lad", IMMEDIATE)
        limit, out, marked = json.loads(self.xref("--format", "json", path, "--place", "LIMIT", "--place", "OUT000.03", "--place", "!OUT000.03"))
        self.assertEqual([use["rung"] for use in limit["read"]], [1, 2])
        self.assertTrue(limit["control_writes"])
        self.assertTrue(all(use["address"].startswith("!") for use in limit["read"]), "what the rung says is shown")
        self.assertEqual(([use["rung"] for use in out["written"]], [use["rung"] for use in out["read"]]), ([1], [3]))
        self.assertEqual(marked, out)
        lathe, = json.loads(self.xref("--format", "json", "examples/nct-lathe", "--place", "TN_TS1"))
        self.assertGreater(len(lathe["read"]), 3)
        self.assertNotIn("odd", lathe)

    def test_an_index_into_the_time_slice_memory(self):
        text = self.xref("tests/scenarios/nct/SCP.lad", "--place", "3998")
        self.assertIn('perhaps  read by rung 7, tests/scenarios/nct/SCP.lad:28', text)

    def test_names_of_the_control_that_nobody_uses(self):
        path = self.program("given.lad", GIVEN)
        self.assertTrue(self.xref(path).startswith("TN_TS1\n"), "FL_ER to FL_LT, PLCRAM are left out")
        self.assertTrue(self.xref(path, "--place", "FL_ER").startswith("FL_ER (0000.00)"), "who asks is answered")

    def test_places_of_technol_by_their_names(self):
        path = self.program("n.plc", NAMES)
        text = self.xref(path)
        self.assertEqual(re.findall(r"(?m)^([^\s:]+)", text), ["B0", "B1", "WORDS", "WORDS.9", "WORD.WORDS+2", "BYTE.WORDS+5"])
        self.assertIn("rung 1, {0}:7, as WORDS+2 to WORDS+3\n           rung 2, {0}:10, as WORDS.9\n".format(path), text)
        for entry in json.loads(self.xref("--format", "json", path)):
            again, = json.loads(self.xref("--format", "json", path, "--place", entry["address"]))
            self.assertEqual(entry["address"], again["address"])

    def test_examples(self):
        for example in ("fanuc-vmc", "gsk-mill", "nct-turning-centre", "technol-machining-centre"):
            text = self.xref(f"examples/{example}")
            self.assertIn("\n  written  rung ", text)

    def test_a_subprogram_of_both_levels_is_listed_once(self):
        path = self.program("sub.pmc", "".join(f"LD X20.{level}\nFUNC CALL\nPRM P1\nFUNC END{level}\n" for level in (1, 2)) +
                            "FUNC SP\nPRM P1\nLD X20.4\nOUT R10.2\nLD R10.2\nOUT Y0.1\nFUNC SPE\n")
        self.assertEqual(self.xref(path, "--place", "R10.2"), f"R10.2\n  written  rung 3, {path}:11\n  read     rung 4, {path}:13\n")

    def test_unknown(self):
        done = subprocess.run([RUNGC, "xref", self.program("p.lad", NCT), "--place", "NOBODY"], capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stdout, done.stderr),
                         (WRONG, "", "rungc: 'NOBODY' is not a variable of the program; write a symbol or an address of the dialect\n"))


if __name__ == "__main__":
    go_to_root()
    RUNGC = sys.argv.pop(1)
    unittest.main()
