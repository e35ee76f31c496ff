#!/usr/bin/env python3
"""rungc xref as a user sees it: who reads and writes what, whatever the spelling. xref_test.py RUNGC"""
import json
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
        names = self.entries(self.program("p.lad", NCT), "--odd")
        self.assertEqual(names["SPARE"]["odd"], "used by no rung")
        self.assertEqual(names["START"]["odd"], "read, but written by no rung")
        self.assertEqual(names["MOTOR"]["odd"] if "MOTOR" in names else "", "")

    def test_examples(self):
        for example in ("gsk-mill", "nct-turning-centre", "technol-machining-centre"):
            text = self.xref(f"examples/{example}")
            self.assertIn("\n  written  rung ", text)

    def test_unknown(self):
        done = subprocess.run([RUNGC, "xref", self.program("p.lad", NCT), "--place", "NOBODY"], capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stdout, done.stderr),
                         (WRONG, "", "rungc: 'NOBODY' is not a place of the program; write a symbol or an address of the dialect\n"))


if __name__ == "__main__":
    go_to_root()
    RUNGC = sys.argv.pop(1)
    unittest.main()
