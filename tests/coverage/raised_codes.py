"""Which diagnostics are really raised: by expect_error and expect_warning of the scenarios that the tests run, and by the
commands here for what no scenario can show (files, options, project files, programs that are too large). Run by
coverage_test.py."""
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "support"))
from patience import patience

HERE = Path(__file__).resolve().parent
SCENARIOS = ("fanuc", "gsk", "nct", "technol")  # the folders that tests/scenarios/CMakeLists.txt runs

LAMP = "dialect nct\nmodule MAIN\n\nrung\n|--[0000.00]--(5100.00)\n"
PROJECT = 'dialect = "nct"\nfiles = ["a.lad"]\n'


def ladder(drawing):
    return {"a.lad": f"dialect nct\nmodule MAIN\n\nrung\n{drawing}"}


def project(text):
    return {"rung.toml": text, "a.lad": LAMP}


# code: files, and the arguments of rungc in their folder
COMMANDS = {
    "file-twice": ({"a.pmc": "FUNC 0\nFUNC 1\n"}, "check a.pmc ./a.pmc"),
    "too-many-files": ({f"{i}.plc": "; one of too many\n" for i in range(65)}, "check " + " ".join(f"{i}.plc" for i in range(65))),
    "misplaced-dialect": ({"a.lad": "dialect nct\nmodule MAIN\ndialect nct\n"}, "check a.lad"),
    "unknown-statement": ({"a.lad": "dialect nct\nmodul MAIN\n"}, "check a.lad"),
    "stray-drawing": ({"a.lad": "dialect nct\nmodule MAIN\n|--[0000.00]--(5100.00)\n"}, "check a.lad"),
    "stray-text": (ladder("|--A--(5100.00)\n"), "check a.lad"),
    "power-loop": (ladder("|--[5100.00]--+--[5100.01]--+---(5100.02)\n"
                          "              |             +--[5100.03]--+\n"
                          "              +---------------------------+\n"), "check a.lad"),
    "dialect-conflict": ({"a.lad": LAMP, "b.lad": "dialect gsk\nmodule LEVEL1\n"}, "check a.lad b.lad"),
    "unknown-dialect": ({"a.lad": LAMP}, "check a.lad --dialect klingon"),
    "compiled-program": ({"a.lad": "\x7fELF"}, "check a.lad"),
    "unknown-config-key": (project(PROJECT + "[config]\nPLCNVRAN = 4000\n"), "check"),
    "config-value": (project(PROJECT + 'nc = "simulated"\n[config]\naxes = "?"\n'), "check"),
    "file-not-found": ({"a.pmc": "FUNC 0\nFUNC 1\n"}, "check a.pmc --config messages=none.msg"),
    "too-deep": ({"a.lad": "dialect nct\n" + "".join(f"symbol S{i} S{i + 1},#1\n" for i in range(5000)) + "symbol S5000 5100\nmodule MAIN\n"},
                 "check a.lad"),
    "program-too-large": ({"a.pmc": "FUNC 0\n" + "LD X0.0\nOUT R0.0\n" * 100_000 + "FUNC 1\n"}, "check a.pmc"),
    "drawing-too-large": ({"a.pmc": "FUNC 0\nLD R0.0\n" + "AND R0.1\nOR R0.2\n" * 5900 + "OUT R1.0\nFUNC 1\n"}, "convert a.pmc --to ladder"),
    "no-ladder-text": ({"a.mne": "%@3\nEND1\nEND2\nEND\n%\n%@4\nA0.0 1000 3.5\" DISK\n%\n"}, "convert a.mne --to ladder"),
    "no-conversion": ({"a.lad": LAMP}, "convert a.lad --to list"),
    "project-syntax": (project(PROJECT + "= 1\n"), "check"),
    "unknown-project-key": (project(PROJECT + 'dialekt = "nct"\n'), "check"),
    "project-value": (project('dialect = 1\nfiles = ["a.lad"]\n'), "check"),
    "missing-project-key": (project('dialect = "nct"\n'), "check"),
    "missing-project-file": (project('dialect = "nct"\nfiles = ["b.lad"]\n'), "check"),
}

# The same of warnings.
WARNINGS = {
    "incomplete-file": ({"a.mne": "%@3\nSUB 1\nSUB 2\n%\n%@2\nLAMP Y0.0\n"}, "check a.mne"),
    "unused-name": ({"a.lad": LAMP.replace("\n\n", "\nsymbol SPARE 5101\n\n")}, "check a.lad"),
    "never-written": ({"a.lad": LAMP.replace("\n\n", "\nsymbol SWITCH 5101.00\n\n").replace("0000.00", "SWITCH")}, "check a.lad"),
    "never-read": ({"a.lad": LAMP.replace("\n\n", "\nsymbol LAMP 5100.00\n\n")}, "check a.lad"),
}


def listed(name):
    """Names in a list file; after each, why it is there."""
    entries = {}
    for line in (HERE / name).read_text().splitlines():
        if line.strip() and not line.startswith("#"):
            word, _, reason = line.partition(" ")
            entries[word] = reason.strip()
    return entries


def all_codes():
    return {code for path in sorted((ROOT / "ir/support/diag").glob("*.def"))
            for code in re.findall(r'^DIAG\(\w+,\s*"([a-z0-9-]+)"', path.read_text(), re.MULTILINE)}


def expected_codes():
    """What scenarios expect; the runner fails where it is not reported."""
    codes = set()
    for dialect in SCENARIOS:
        for path in (ROOT / "tests/scenarios" / dialect).rglob("*.scn"):
            codes.update(re.findall(r"^\s*expect_(?:error|warning)\s+(?:\d+\s+)?([a-z0-9-]+)", path.read_text(errors="replace"), re.MULTILINE))
    return codes


class RaisedCodes(unittest.TestCase):
    RUNGC = None

    def test_the_commands_raise_their_codes(self):
        for commands, status in ((COMMANDS, 1), (WARNINGS, 0)):
            for code, (files, arguments) in commands.items():
                with self.subTest(code), tempfile.TemporaryDirectory() as folder:
                    for name, text in files.items():
                        (Path(folder) / name).write_text(text)
                    done = subprocess.run([Path(self.RUNGC).resolve(), *arguments.split()], cwd=folder, capture_output=True, timeout=patience())
                    self.assertEqual(done.returncode, status, done.stderr[-2000:])
                    self.assertIn(f"[{code}]", done.stderr.decode())

    def test_every_diagnostic_is_raised(self):
        codes, excused = all_codes(), listed("diagnostics_not_raised.txt")
        self.assertGreater(len(codes), 100)
        raised = expected_codes() | set(COMMANDS) | set(WARNINGS)
        self.assertEqual(sorted(codes - raised - set(excused)), [],
                         "nothing shows that these are raised; add a scenario with expect_error, a command to raised_codes.py, or say why not in diagnostics_not_raised.txt")
        self.assertEqual(sorted(raised & set(excused)), [], "these are raised: take them out of diagnostics_not_raised.txt")
        self.assertEqual(sorted((set(excused) | set(COMMANDS) | set(WARNINGS)) - codes), [], "no such codes")
        self.assertEqual(sorted(set(COMMANDS) & expected_codes()), [], "a scenario shows these: no command is needed")
        self.assertEqual([code for code, reason in excused.items() if not reason], [], "give a reason")
