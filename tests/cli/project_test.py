#!/usr/bin/env python3
"""Projects as a user meets them: rung.toml, rungc new, configuration keys, help, explain. project_test.py RUNGC"""
import os
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
ROOT = Path(__file__).resolve().parents[2]
OK, WRONG, USAGE, ENVIRONMENT = 0, 1, 2, 3

LAMP = """dialect nct
module MAIN
rung
|--[5100.00]--(5101.00)
"""
TOML = """dialect = "nct"
files = ["lamp.lad"]
scenarios = ["*.scn"]
"""
SCENARIO = "set 5100.00 1\nscan\nexpect 5101.00 1\n"


class Cli(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.path = Path(self.folder.name)

    def write(self, name, text):
        path = self.path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        return str(path)

    def rungc(self, *args, status=OK, cwd=None):
        done = subprocess.run([RUNGC, *args], capture_output=True, timeout=patience(), cwd=cwd or self.path, stdin=subprocess.DEVNULL)
        out, err = done.stdout.decode(), done.stderr.decode()
        self.assertEqual(done.returncode, status, f"rungc {' '.join(args)}\n{out}{err}")
        return out, err

    def project(self, toml=TOML, folder=""):
        self.write(folder + "rung.toml", toml)
        self.write(folder + "lamp.lad", LAMP)
        self.write(folder + "lamp.scn", SCENARIO)


class Discovery(Cli):
    def test_every_command_finds_it_upwards(self):
        self.project()
        below = self.path / "a" / "b"
        below.mkdir(parents=True)
        for cwd in (self.path, below):
            out, err = self.rungc("check", cwd=cwd)
            self.assertRegex(out, r"rung\.toml \(1 file\): \d+ rungs?, no warnings")
            self.assertEqual(err, "")
            self.assertIn("rung_program_table", self.rungc("emit", "cpp", cwd=cwd)[0])
            self.rungc("view", "-o", "lamp.svg", cwd=cwd)
            self.assertIn("1 scan,", self.rungc("run", cwd=cwd)[0])
            self.rungc("build", cwd=cwd)
        self.assertTrue((self.path / (self.path.name + ".so")).exists())

    def test_the_mark_of_dos_ends_the_file(self):
        self.project(TOML + "\x1a\0[")
        self.rungc("check")

    def test_a_drawing_has_its_name(self):
        self.project()
        name = self.path.name
        page = self.path / (name + ".html")
        below = self.path / "below"
        below.mkdir()
        for cwd in (self.path, below):
            out, err = self.rungc("view", cwd=cwd)
            self.assertRegex(out, rf"^wrote (\.\./)?{re.escape(name)}\.html$")
            self.assertEqual(err, "")
            self.assertIn(f"<title>{name}</title>", page.read_text())
            page.unlink()
        self.rungc("view", "--title", "Lamp 7", "-o", "lamp.svg")
        self.assertIn("<title>Lamp 7</title>", (self.path / "lamp.svg").read_text())
        self.rungc("view", "-o", "lamp.svg")
        self.assertIn(f"<title>{name}</title>", (self.path / "lamp.svg").read_text())
        self.assertFalse(page.exists())

    def test_the_program_is_called_after_it(self):
        self.project("name = \"Lamp of hall 3\"\n" + TOML)
        self.assertIn('module "Lamp of hall 3" ', self.rungc("emit", "ir")[0])
        self.assertIn('module "lamp" ', self.rungc("emit", "ir", "lamp.lad", "--no-project")[0])
        self.rungc("test", "--coverage-html", "coverage.html")
        self.rungc("profile", "lamp.scn", "--repeat", "1", "--html", "heat.html")
        for page in ("coverage.html", "heat.html"):
            self.assertIn("<title>Lamp of hall 3</title>", (self.path / page).read_text(), page)
        self.assertIn("Lamp of hall 3", self.rungc("profile", "lamp.scn", "--repeat", "1")[0])
        self.write("alone/lamp.lad", LAMP)
        self.write("alone/lamp.scn", "program lamp.lad\n" + SCENARIO)
        self.rungc("test", "alone/lamp.scn", "--coverage-html", "alone.html")
        self.assertIn("<title>lamp.lad</title>", (self.path / "alone.html").read_text())

    def test_a_folder_and_project_name_it(self):
        self.project(folder="machine/")
        for args in (["machine"], ["machine/rung.toml"], ["--project", "machine"], ["--project", "machine/rung.toml"]):
            self.assertIn("machine/rung.toml (1 file)", self.rungc("check", *args)[0])
        (self.path / "empty").mkdir()
        self.assertIn("the folder 'empty' has no rung.toml", self.rungc("check", "empty", status=USAGE)[1])
        self.assertIn("none.toml", self.rungc("check", "--project", "none.toml", status=ENVIRONMENT)[1])

    def test_without_a_project_files_are_needed(self):
        self.assertIn("no file is named", self.rungc("check", status=USAGE)[1])
        self.assertIn("--no-project needs", self.rungc("check", "--no-project", status=USAGE)[1])
        self.write("lamp.lad", LAMP)
        self.assertIn("-o", self.rungc("build", "lamp.lad", status=USAGE)[1])

    def test_a_file_of_a_project_means_the_project(self):
        changer = "examples/technol-mill/changer.plc"
        out, err = self.rungc("check", changer, cwd=ROOT)
        self.assertIn("belongs to the project examples/technol-mill/rung.toml: all its 2 files are used", err)
        self.assertIn("(2 files)", out)
        self.rungc("check", changer, "--no-project", status=WRONG, cwd=ROOT)
        self.assertEqual(self.rungc("check", changer, "--quiet", cwd=ROOT), ("", ""))

    def test_a_file_beside_a_project_is_alone(self):
        self.project()
        other = self.write("other.lad", LAMP)
        out, err = self.rungc("check", other)
        self.assertEqual(err, "")
        self.assertIn("other.lad: ", out)
        # With --project it takes the configuration of the project.
        self.write("rung.toml", TOML + "[config]\nPLCNVRAM = 3000\n")
        self.assertIn("(1 file)", self.rungc("check", other, "--project", "rung.toml")[0])

    def test_mistakes_of_the_project_file(self):
        self.write("rung.toml", 'dialekt = "nct"\nfiles = ["gone.lad"]\n')
        err = self.rungc("check", status=WRONG)[1]
        self.assertIn("rung.toml:1:1: error: 'dialekt' is not a key of a project file [unknown-project-key]", err)
        self.assertIn("did you mean dialect?", err)
        self.assertIn("rung.toml:2:10: error: 'gone.lad' is not a file [missing-project-file]", err)
        self.assertIn("2 errors; try `rungc explain", err)

    def test_include_paths(self):
        main = (ROOT / "tools/rungc/templates/technol/main.plc").read_text()
        self.write("common/names.inc", "\tEQUI TWO_SECONDS,100\n")
        self.write("machine/main.plc", main)
        self.write("machine/rung.toml", 'dialect = "technol"\nfiles = ["main.plc"]\ninclude = ["../common"]\n')
        self.rungc("check", "machine")
        self.write("machine/rung.toml", 'dialect = "technol"\nfiles = ["main.plc"]\n')
        self.assertIn("include-not-found", self.rungc("check", "machine", status=WRONG)[1])

    def test_a_scenario_without_a_program_is_of_its_project(self):
        self.project()
        inner = self.write("tests/inner.scn", SCENARIO)
        self.assertIn("1 passed", self.rungc("test", inner)[0])
        self.assertIn("1 passed", self.rungc("test", inner, cwd=ROOT)[0])
        self.write("rung.toml", "files = 1\n")
        self.assertIn("the project file has mistakes", self.rungc("test", inner, status=WRONG)[0])
        os.remove(self.path / "rung.toml")
        self.assertIn("a scenario begins with: program FILE", self.rungc("test", inner, status=WRONG)[0])


class New(Cli):
    def test_each_dialect(self):
        for dialect, drawn in (("fanuc", False), ("nct", True), ("gsk", True), ("technol", False)):
            out, _ = self.rungc("new", dialect, f"my-{dialect}")
            self.assertRegex(out, rf"(?m)^try: \S+/rungc test 'my-{dialect}'$")  # rungc as it was called
            cwd = self.path / f"my-{dialect}"
            self.assertIn("*.so", (cwd / ".gitignore").read_text())
            self.assertNotIn("{{NAME}}", "".join(path.read_text() for path in cwd.rglob("*") if path.is_file()))
            out, err = self.rungc("check", "--strict", cwd=cwd)
            self.assertIn("no warnings", out)
            self.assertEqual(err, "")
            self.assertIn("1 passed", self.rungc("test", "--engine", "all", cwd=cwd)[0])
            self.assertIn("1 passed", self.rungc("test", f"my-{dialect}")[0])
            if drawn:
                self.rungc("view", "-o", "page.html", cwd=cwd)
            self.assertIn(f"wrote my-{dialect}.so", self.rungc("build", cwd=cwd)[0])

    def test_refusals(self):
        self.write("full/file", "")
        self.assertIn("is not empty", self.rungc("new", "nct", "full", status=ENVIRONMENT)[1])
        self.assertEqual(os.listdir(self.path / "full"), ["file"])
        self.assertIn("did you mean nct?", self.rungc("new", "nctt", "x", status=USAGE)[1])
        self.assertFalse((self.path / "x").exists())


class Examples(Cli):
    def test_each_has_a_project(self):
        for folder in sorted((ROOT / "examples").iterdir()):
            if folder.is_dir() and not folder.name.startswith("embed-"):  # a host of the program in axis
                with self.subTest(folder.name):
                    self.assertIn("rung.toml", self.rungc("check", cwd=folder)[0])


class Configuration(Cli):
    def test_unknown_keys_are_errors_in_every_command(self):
        mill = str(ROOT / "examples/gsk-mill/mill.pmc")
        for command in (["check"], ["build", "-o", "x.so"], ["emit", "cpp"], ["convert", "--to", "ladder"], ["view", "-o", "x.svg"], ["run"]):
            for key, meant in (("slot_step=300", "slot_steps"), ("mesages=mill.msg", "messages"), ("timr.1=480", "tmr.N"), ("foo=1", "")):
                out, err = self.rungc(*command, mill, "--no-project", "--config", key, status=USAGE)
                self.assertIn(f"'{key.split('=')[0]}' is not a configuration key of gsk programs", err)
                if meant:
                    self.assertIn(f"did you mean {meant}?", err)
                self.assertIn("`rungc explain config` lists them", err)
        self.assertEqual(os.listdir(self.path), [])

    def test_values_are_checked(self):
        lamp = self.write("lamp.lad", LAMP)
        for pair, expected in (("nc=foo", "expected scripted or simulated"), ("timeslice=7", "a duration with its unit such as 2ms"),
                               ("spindles=17", "expected 0 to 16"), ("axes=12", "letters"), ("tool.rows=0", "expected 1 to 9999")):
            self.assertIn(expected, self.rungc("check", lamp, "--config", pair, status=USAGE)[1])
        self.rungc("check", lamp, "--config", "timeslice=2ms", "--config", "nc=simulated", "--config", "param.1209=1")

    def test_in_a_project_they_have_their_place(self):
        self.project(TOML + '[config]\nnetwok = "loopback"\ntimeslice = 7\nPLCNVRAM = 12\n')
        err = self.rungc("check", status=WRONG)[1]
        self.assertRegex(err, r"rung\.toml:5:\d+: error: 'netwok' is not a configuration key of nct programs \[unknown-config-key\]")
        self.assertIn("did you mean network?", err)
        self.assertRegex(err, r"rung\.toml:6:\d+: error: timeslice: expected a duration with its unit such as 2ms.* \[config-value\]")
        self.project(TOML + "[config]\nPLCNVRAM = 12\n")
        self.assertRegex(self.rungc("check", status=WRONG)[1], r"rung\.toml:5:12: error: PLCNVRAM 12 is outside")

    def test_texts_of_nct_are_statements(self):
        self.project(TOML + '[config]\nmessages = "main.msg"\n')
        self.assertIn('in this language: a statement of the program, `message 20 "text"`', self.rungc("check", status=WRONG)[1])

    def test_names_of_a_technol_program(self):
        mill = ["examples/technol-machining-centre"]
        for key in ("PlcError=x", "TOOLLIFE=1"):
            err = self.rungc("check", *mill, "--config", key, status=WRONG, cwd=ROOT)[1]
            self.assertIn("unknown-config-key", err)
        self.rungc("check", *mill, "--config", "TOOL_LIFE=90", cwd=ROOT)

    def test_the_command_line_goes_before_the_project(self):
        self.project(TOML + '[config]\ntimeslice = "2ms"\n')
        self.assertIn("5.000 ms on", self.rungc("run", "--config", "timeslice=1ms")[0])
        self.assertIn("10.000 ms on", self.rungc("run")[0])


class Words(Cli):
    def test_closing_lines(self):
        bad = self.write("bad.lad", LAMP.replace("(5101.00)", "(X"))
        err = self.rungc("check", bad, status=WRONG)[1]
        self.assertRegex(err, r"\d+ errors?; try `rungc explain [a-z-]+`\n$")
        good = self.write("lamp.lad", LAMP)
        self.assertRegex(self.rungc("check", good)[0], r"^.*lamp\.lad: \d+ rungs?, no warnings\n$")
        self.assertRegex(self.rungc("build", good, "-o", "x.so")[0], r"no warnings; wrote x\.so \(\d+ kB\)\n$")
        self.assertEqual(self.rungc("build", good, "-o", "x.so", "-q")[0], "")
        self.assertEqual(self.rungc("check", good, "--json")[0].strip(), "[]")

    def test_emit_writes_a_file(self):
        self.write("lamp.lad", LAMP)
        self.assertEqual(self.rungc("emit", "ir", "lamp.lad", "-o", "lamp.ir")[0], "wrote lamp.ir\n")
        self.assertEqual((self.path / "lamp.ir").read_text(), self.rungc("emit", "ir", "lamp.lad")[0])

    def test_wrong_words_get_one_line(self):
        for args, meant in ((["chek", "x"], "did you mean check?"), (["check", "--strct"], "did you mean --strict?"),
                            (["run", "x.lad", "--scan=3"], "did you mean --scans?"), (["doc"], "PAGE is required"),
                            (["emit", "jit", "x.lad"], "WHAT"), (["help", "buld"], "did you mean build?")):
            err = self.rungc(*args, status=USAGE)[1]
            self.assertIn(meant, err)
            self.assertEqual(err.count("\n"), 1, err)
            self.assertIn("rungc help", err)

    def test_help(self):
        out = self.rungc("help")[0]
        for command in ("new", "check", "build", "run", "test", "explain"):
            self.assertIn(f"rungc {command}", out)
        self.assertIn("--listing", self.rungc("help", "build")[0])
        listed = self.rungc(status=USAGE)[1].splitlines()
        commands = [line for line in listed if line.startswith("  rungc ")]
        self.assertEqual(len(listed), len(commands) + 3, "a line for each command, not the options of all")

    def test_an_unknown_dialect(self):
        err = self.rungc("check", self.write("s.lad", LAMP.replace("nct", "siemens")), status=WRONG)[1]
        self.assertIn("unknown dialect 'siemens'; known are fanuc, gsk, nct and technol", err)

    def test_functions_of_gsk_are_suggested(self):
        program = self.write("f.pmc", "FUNC END1\nLD X0.0\nFUNC TMRR\nPRM 1\nOUT R0.0\nFUNC END2\n")
        self.assertIn("did you mean TMR", self.rungc("check", program, status=WRONG)[1])
        for name, note in (("TON", "in this language: the function TMRB, an on-delay timer"), ("PID", "`rungc explain gsk` lists the instructions")):
            program = self.write("f.pmc", f"FUNC END1\nLD X0.0\nFUNC {name}\nPRM 1\nOUT R0.0\nFUNC END2\n")
            self.assertIn(note, self.rungc("check", program, status=WRONG)[1])


class Explain(Cli):
    def test_topics(self):
        out = self.rungc("explain")[0]
        for topic in ("gsk", "nct", "technol", "diagnostics", "faults", "config"):
            self.assertRegex(out, rf"(?m)^  {topic}\s")
            self.assertGreater(len(self.rungc("explain", topic)[0].splitlines()), 3)

    def test_faults_and_keys(self):
        self.assertIn("[gsk] fault dead-loop", self.rungc("explain", "dead-loop")[0])
        self.assertIn("[technol] fault watchdog", self.rungc("explain", "watchdog")[0])
        self.assertIn("[technol] fault halt-status 13: protection", self.rungc("explain", "halt-status 13")[0])
        self.assertIn("[nct] fault PLC timeout", self.rungc("explain", "plc timeout")[0])
        self.assertIn("1 to 1000000", self.rungc("explain", "slot_steps")[0])
        self.assertIn("[gsk] configuration key tmr.N", self.rungc("explain", "tmr.3")[0])

    def test_every_fault_that_a_program_can_have_is_explained(self):
        sources = "".join(path.read_text() for path in (ROOT / "frontend/dialects").rglob("*.cpp"))
        self.assertNotRegex(sources, r'[^a-z]faults?(\.emplace_back)?\("')  # their texts are in rtlib/nc/faults.h
        for text in re.findall(r'inline constexpr std::string_view k\w+ = "([^"]+)"', (ROOT / "rtlib/nc/faults.h").read_text()):
            self.assertIn("fault " + text.strip(), self.rungc("explain", text.strip())[0])

    def test_a_part_of_a_word_searches(self):
        out = self.rungc("explain", "timer")[0]
        self.assertRegex(out, r"(?m)^  TMRB\s+gsk instruction")
        self.assertRegex(out, r"(?m)^  \S*TON\S*\s+nct instruction")
        self.assertRegex(self.rungc("explain", "ESP")[0], r"gsk signal")

    def test_unknown_words_are_suggested(self):
        self.assertIn("did you mean slot_steps?", self.rungc("explain", "slotsteps", status=WRONG)[1])
        self.assertIn("`rungc explain` lists the topics", self.rungc("explain", "no-such-thing", status=WRONG)[1])

    def test_tables_are_aligned(self):
        lines = self.rungc("explain", "TMRB")[0].splitlines()
        self.assertFalse([line for line in lines if line.startswith("|") or line.startswith("#")])
        self.assertLess(max(len(line) for line in self.rungc("explain", "config")[0].splitlines()), 140)


class Reference(Cli):
    def test_contents_lead_to_headings(self):
        for page in ("gsk", "nct", "technol", "diagnostics"):
            text = self.rungc("doc", page)[0]
            contents = text.split("## Contents")[1].split("\n## ")[0]
            headings = [re.sub(r"[^\w\- ]", "", line.lstrip("# ").lower()).replace(" ", "-") for line in text.splitlines() if line.startswith("#")]
            links = re.findall(r"\]\(#([^)]*)\)", contents)
            self.assertGreater(len(links), 10)
            self.assertEqual([link for link in links if link not in headings], [])


if __name__ == "__main__":
    go_to_root()
    RUNGC = os.path.abspath(sys.argv.pop(1))
    unittest.main()
