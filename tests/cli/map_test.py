#!/usr/bin/env python3
"""rungc map as a user sees it: templates without mistakes, and every mistake of a mapping file. map_test.py RUNGC"""
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from patience import patience
from root import go_to_root

RUNGC = None
OK, WRONG, USAGE, ENVIRONMENT = 0, 1, 2, 3
EXAMPLES = ("fanuc-vmc", "gsk-mill", "gsk-panel", "nct-turning-centre", "technol-machining-centre", "technol-magazine", "technol-mill")


class Map(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def path(self, name):
        return Path(self.folder.name) / name

    def map(self, *args):
        return subprocess.run([RUNGC, "map", *map(str, args)], capture_output=True, text=True, timeout=patience(300))

    def expect(self, done, status, out="", err=""):
        self.assertEqual((done.returncode, done.stdout, done.stderr), (status, out, err))

    def test_a_template_has_no_mistakes(self):
        for name in EXAMPLES:
            with self.subTest(example=name):
                made = self.path("made.map")
                self.expect(self.map(f"examples/{name}", "--template", "-o", made), OK, f"wrote {made}\n")
                text = made.read_text()
                self.assertIn("\n[in]\n", text)
                self.assertIn("\n[out]\n", text)
                done = self.map(f"examples/{name}", "--check", made)
                self.assertRegex(done.stdout, r"^\S+: \d+ pins, no mistakes\n$")
                self.assertEqual((done.returncode, done.stderr), (OK, ""))
                self.expect(self.map(f"examples/{name}", "--template"), OK, text)

    def test_the_mark_of_dos_ends_the_file(self):
        made = self.path("made.map")
        self.map("examples/gsk-panel", "--template", "-o", made)
        made.write_text(made.read_text() + "\x1a\0[")
        self.assertEqual(self.map("examples/gsk-panel", "--check", made).returncode, OK)

    def test_signals_have_the_direction_of_the_nc_interface(self):
        """NCT's memory is both sides'; what its outputs are, the table of signals says, also where rungs read them."""
        text = self.map("tests/cnc/handshake.lad", "--template").stdout
        inputs, outputs = text.split("[out]")
        self.assertIn('estop-ok = { type = "bit", name = "ESTOP_OK" }', inputs)
        self.assertIn('\nenable = { type = "bit", name = "ENABLE" } # OUT000.00, to the CNC: 0 stops\n', outputs)
        self.assertIn('\ncp-m1ack = { type = "bit", name = "CP_M1ACK" }', outputs)

    def test_pins_of_a_template_have_the_comments_of_the_program(self):
        text = self.map("examples/gsk-mill", "--template").stdout
        self.assertIn('lube-level = { type = "bit", name = "LUBE_LEVEL" } # X10.1, oil level is good\n', text)
        self.assertLess(text.index("[in]"), text.index("lube-level"))
        self.assertLess(text.index("[out]"), text.index("spindle-cw = "))

    def test_the_maps_of_the_examples(self):
        for path in sorted(Path("examples").glob("**/*.map")):
            program = path.parent.parent if path.parent.name == "linuxcnc" else path.parent
            self.assertEqual(self.map(program, "--check", path).returncode, OK, path)

    def test_a_shared_object(self):
        program = self.path("mill.so")
        subprocess.run([RUNGC, "build", "-q", "examples/gsk-mill", "-o", program], check=True)
        self.expect(self.map(program, "--check", "examples/gsk-mill/mill.map", "-q"), OK)
        done = self.map(program, "--template")
        self.assertEqual((done.returncode, done.stdout), (USAGE, ""))
        self.assertIn("map --template needs the sources: a compiled program does not say which names its rungs use", done.stderr)

    def test_what_a_template_leaves_out(self):
        """Constants and clocks of the control, relays that rungs write as bytes, names that rung_hal has itself."""
        program = self.path("p.lad")
        program.write_text("dialect nct\nsymbol reset 5100.00\nsymbol lamp 5100.01\nmodule MAIN\nrung\n|--[N_ON]--[/N_P1S]--[reset]--(lamp)\nrung\n|--{END}\n")
        text = self.map(program, "--template").stdout
        for name in ("N_ON", "N_P1S"):
            self.assertNotIn(name, text)
        self.assertIn('reset-2 = { type = "bit", name = "reset" }', text)
        relays = self.path("p.pmc")
        relays.write_text("dialect gsk\nFUNC END1\nLD X0.0\nFUNC MOVB\nPRM X1\nPRM R10\nLD R10.3\nOUT Y0.0\nFUNC END2\n")
        text = self.map(relays, "--template").stdout
        for name in ("R10", "R10.3"):
            self.assertNotIn(f'name = "{name}"', text)

    def test_what_is_no_input(self):
        program = self.path("p.pmc")
        program.write_text("dialect gsk\nsymbol RELAY R5.0\nFUNC END1\nLD X0.0\nOUT RELAY\nLD RELAY\nOUT Y0.0\nFUNC END2\n")
        wrong = self.path("p.map")
        wrong.write_text('[in]\nrelay = { type = "bit", name = "RELAY" }\na = { type = "bit", name = "X0.0" }\nb = { type = "u32", name = "X0" }\n'
                         'fault = { type = "bit", name = "X3.0" }\n' + "l" * 43 + ' = { type = "bit", name = "X3.1" }\n'
                         'number = { type = "s32", name = "D10:2" }\n')
        done = self.map(program, "--check", wrong)
        self.assertEqual((done.returncode, done.stdout), (WRONG, ""))
        for text in ("4:28: in.b.name: found X0, where in.a.name writes, too, expected bits that no other pin writes",
                     "in.relay: found RELAY, which rungs write, expected a name that no rung writes; move the pin to [out], or to [io]",
                     "in.fault: found a pin that rung_hal makes for every program, expected another name; write for example fault-plc",
                     "43 characters, expected 42 at most, what HAL takes; shorten the name",
                     "7:33: warning: in.number.name: type s32 has 32 bits, D10:2 has 16: a number that does not fit loses its upper bits"):
            self.assertIn(text, done.stderr)

    def test_a_constant_where_a_pin_writes(self):
        program = self.path("p.pmc")
        program.write_text("dialect gsk\nFUNC END1\nLD X0.0\nOUT Y0.0\nFUNC END2\n")
        both = self.path("p.map")
        both.write_text('[in]\na = { type = "bit", name = "X0.0" }\nb = { type = "bit", name = "X3", bits = 8 }\n[const]\n"X0.0" = true\n"X3.7" = false\n"X0.1" = true\n')
        self.expect(self.map(program, "--check", both), OK, f"{both}: 9 pins, no mistakes, 2 warnings\n",
                    f"{both}:5:1: warning: const.X0.0: the constant counts, and in.a.name (X0.0) has no effect there\n"
                    f"{both}:6:1: warning: const.X3.7: the constant counts, and in.b.name (X3) has no effect there\n")
        self.expect(self.map(program, "--check", both, "-q"), OK, "", self.map(program, "--check", both).stderr)
        both.write_text('[const]\nX0 = 3\n"X0.0" = true\n')
        self.expect(self.map(program, "--check", both), WRONG, "",
                    f"{both}:3:1: const.X0.0: found X0.0, where const.X0 writes, too, expected bits that no other constant writes; remove one of the two\n")

    def test_mistakes_are_explained(self):
        technol = "examples/technol-mill"
        for program, text, said in (
                ("examples/gsk-mill", '[rungctl]\npermissions = ["set", "forc"]\n', '2:23: rungctl.permissions: found "forc" in the list, expected a list of "set", "force", '
                 '"reload", "start", "stop", "reset", "profile", "serve" and "acknowledge"; did you mean force?'),
                ("examples/gsk-mill", "[m-groups]\n70 = 10\n", "2:1: m-groups: found M70 in group 10, expected none, because a control of the dialect gsk has no groups of M functions; "
                 "remove the table [m-groups]"),
                (technol, "[m-groups]\n70 = 15\n", "2:1: m-groups: found M70 in group 15, expected a group from 1 to 14; write for example 70 = 1"),
                (technol, "[m-groups]\n3 = 12\n", "2:1: m-groups: found M3 in group 12, expected an M function whose group a machine may choose with the dialect technol; remove the line"),
                ("examples/gsk-mill", '[[send]]\npins = "m3"\nedge = "rise"\nfunction = "M"\ncode = 3\n',
                 "2:1: send: found an unknown key pins, expected pin, edge, function, code, done, channel; did you mean pin?"),
                (technol, '[[send]]\npin = "m3"\nedge = "rise"\nfunction = "M"\ncode = 300\n',
                 "1:1: send.code: found M300, expected at most M99, what the signals of the dialect technol hold; write such a code, or the name of a pin that has it")):
            with self.subTest(said=said):
                wrong = self.path("wrong.map")
                wrong.write_text(text)
                self.expect(self.map(program, "--check", wrong), WRONG, "", f"{wrong}:{said}\n")

    def test_every_mistake(self):
        self.path("part.map").write_text('in.c = { type = "bit", name = "NOWHERE" }\n')
        wrong = self.path("wrong.map")
        wrong.write_text('include = "part.map"\n[in]\na = { type = "bit", name = "X0.0" }\nb = { type = "bitt", name = "X0.1" }\n')
        done = self.map("examples/gsk-mill", "--check", wrong)
        self.assertEqual((done.returncode, done.stdout), (WRONG, ""))
        lines = done.stderr.splitlines()
        self.assertEqual(len(lines), 2, done.stderr)
        self.assertTrue(lines[0].startswith(f'{wrong}:4:14: in.b.type: found "bitt", expected "bit"'), lines[0])
        self.assertTrue(lines[1].startswith(f"{self.path('part.map')}:1:31: in.c.name: found an unknown name NOWHERE"), lines[1])

    def test_every_mistake_of_a_pin(self):
        wrong = self.path("wrong.map")
        wrong.write_text('[in]\na = { type = "bitt", name = "NOWHERE" }\nb = { type = "bit", name = ["X0.1", "SPINDEL_CW"], scale = 2 }\nc = { name = "Y0.0" }\n'
                         '"d/e" = { type = "bits", name = "X0.2" }\n[out]\nf = { type = "u32", name = "NOWHERE", safe = "stay" }\n')
        done = self.map("examples/gsk-mill", "--check", wrong)
        self.assertEqual((done.returncode, done.stdout), (WRONG, ""))
        said = sorted(line.removeprefix(f"{wrong}:").split(", expected")[0] for line in done.stderr.splitlines())
        self.assertEqual(said, ['2:14: in.a.type: found "bitt"', "2:29: in.a.name: found an unknown name NOWHERE",
                                "3:37: in.b.name: found an unknown name SPINDEL_CW", "3:60: in.b.scale: found a scale of type bit",
                                "4:14: in.c.name: found Y0.0, an output of the program", "4:5: in.c: found no key type",
                                '5:18: in.d/e.type: found "bits"', '5:1: in.d/e: found "d/e"',
                                '7:28: out.f.name: found an unknown name NOWHERE', '7:46: out.f.safe: found "stay"'])

    def test_a_map_in_the_place_of_the_program(self):
        done = self.map("examples/gsk-mill/mill.map", "--check", "examples/gsk-mill")
        self.assertEqual((done.returncode, done.stdout), (USAGE, ""))
        self.assertIn("'examples/gsk-mill/mill.map' is a mapping file, not a program: "
                      "`rungc map --check examples/gsk-mill/mill.map PROGRAM` checks it\n", done.stderr)

    def test_a_file_that_cannot_be_read(self):
        none = self.path("none.map")
        self.expect(self.map("examples/gsk-mill", "--check", none), ENVIRONMENT, "",
                    f"rungc: cannot read {none}: No such file or directory\n")

    def test_usage(self):
        for words in ([], ["--template", "--check", "x.map"], ["--check", "x.map", "-o", "y.map"]):
            done = self.map("examples/gsk-mill", *words)
            self.assertEqual((done.returncode, done.stdout), (USAGE, ""), words)
        self.assertEqual(self.map("/nowhere.pmc", "--template").returncode, ENVIRONMENT)


if __name__ == "__main__":
    go_to_root()
    RUNGC = sys.argv.pop(1)
    unittest.main()
