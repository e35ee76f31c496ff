#!/usr/bin/env python3
"""Checks README.md, CONTRIBUTING.md and docs/ against the tree and the program. docs_test.py RUNGC

A block ```sh is what a reader types, one command after the other, each page from the root of the repository. All commands
succeed, but for the last one of a block ```sh exit=N, which ends with N. A block ```text is what the commands of the block
before it print; wall-clock times and the widths of columns do not count, and a line … is any number of lines. With
RUNG_UPDATE=1 these blocks and the pictures of README.md and first-machine.md are written anew.
"""
import csv
import os
import re
import shutil
import subprocess
import sys
import tempfile
import textwrap
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from patience import patience
from picture import picture

RUNGC = None
ROOT = Path(__file__).resolve().parents[2]
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").rglob("*.md"))]
# Pages whose commands are run, in the order in which a newcomer reads them; all write into the scratch folder alone.
RUN_PAGES = [ROOT / "README.md", *(ROOT / "docs" / name for name in ("first-machine.md", "guide.md", "importing.md", "fanuc-ladder.md", "ir.md", "linuxcnc.md", "rung-run.md", "embedding.md", "bind.md", "security.md", "replay.md"))]
SCRATCH = "out"
# Not run: what builds, what is interactive, and what tests/debug runs.
SKIPPED_COMMANDS = ("./dev", "gdb", "valgrind", "callgrind_annotate", "perf")
# What differs from run to run.
WALL_CLOCK = (
    # rungc test
    (re.compile(r"(?<= scans, )[\d.]+ m?s(?=\)$)|(?<= failed in )[\d.]+ m?s$"), "TIME"),
    # the hosts of embedding.md
    (re.compile(r"(?<=the worst rung is ).*"), "RUNG"),
    # rungc profile: tables of times, of sums, of rungs
    (re.compile(r"(?<=\d)( +[\d.e+]+ [num]?s){4}( +[\d.]+%(?= of ))?"), " TIMES"),
    (re.compile(r"(?<=% ) *[\d.]+(?=  [^\d\s])"), "TIME"),
    (re.compile(r"(?<=%)( +[\d.]+){4}(?=  \S+:\d+  )"), " TIMES"),
)
# Pictures of the README: rungs of a page that a command writes, by their numbers.
PICTURES = {
    "page.svg": (("view", "examples/first-cnc", "-o"), (2, 3, 6)),
    "coverage.svg": (("test", "examples/first-cnc", "--coverage-html"), (1, 6, 8)),
}
UPDATE = os.environ.get("RUNG_UPDATE") == "1"


def shown(path):
    return path.relative_to(ROOT)


class Docs(unittest.TestCase):
    def test_reference_is_what_the_tables_say(self):
        for page in ("fanuc", "gsk", "nct", "technol", "diagnostics", "ir"):
            text = subprocess.run([RUNGC, "doc", page], capture_output=True, check=True).stdout.decode()
            path = ROOT / "docs" / "reference" / f"{page}.md"
            self.assertTrue(path.exists() and path.read_text() == text, f"{shown(path)} is stale: run tests/update")

    def test_gsk_page_has_every_instruction_and_signal(self):
        page = (ROOT / "docs" / "reference" / "gsk.md").read_text()
        headings = re.findall(r"^### (\S+?)(?: \(function (\d+)\))?: ", page.split("\n## Address areas")[0], re.MULTILINE)
        rows = csv.DictReader((ROOT / "tests/unit/gsk/instructions.csv").read_text().splitlines())
        self.assertEqual(sorted(headings), sorted((row["mnemonic"], row["func_number"]) for row in rows))
        found = re.findall(r"^\| ([XYFG]\d+(?:\.\d)?)(?: \((\d) bytes?\))? \| `([^`]+)` \| (.*) \| l\.(\d+) \|$",
                           page.split("\n## Signals")[1], re.MULTILINE)
        wanted = []
        for row in csv.DictReader((ROOT / "rtlib/nc/gsk/signals.csv").read_text().splitlines()):
            place = row["address"][0] + str(int(row["address"][1:])) + (row["bit"] and "." + row["bit"])
            width = {"bit": "", "byte": "1", "word": "2", "dword": "4"}[row["type"]]
            only = {"both": "", "mc": " (GSK25iMc only)", "tc": " (GSK25iTc only)"}[row["mc_or_tc"]]
            meaning, _, note = row["meaning"].partition(" // ")
            text = meaning.replace("|", "\\|") + (f" ({note})" if note else "") + only
            wanted.append((place, width, row["symbol"], text, row["manual_line"].split(";")[0]))
        self.assertIn(f"\n{len(wanted)} names that need no declaration", page)
        self.assertEqual(sorted(found), sorted(wanted))

    def test_configuration_keys_are_told(self):
        for dialect, compiler, control in (("gsk", "tmr.N", "overtravel"), ("nct", "PLCNVRAM", "spindles"), ("technol", "encoding", "PlcErrors")):
            page = (ROOT / "docs" / "reference" / f"{dialect}.md").read_text()
            rows = page.split("\n## Configuration\n")[1].split("\n## ")[0].split("| --- | --- | --- | --- | --- |\n")[1].splitlines()
            read_by = dict(re.match(r"\| `(\S+)` \| .* \| .* \| (compiler|control) \| \S.* \|$", row).groups() for row in rows if row)
            self.assertEqual((read_by[compiler], read_by[control]), ("compiler", "control"))

    def test_pictures_of_the_readme_are_what_the_pages_show(self):
        with tempfile.TemporaryDirectory() as name:
            for file, (command, rungs) in PICTURES.items():
                page = Path(name) / "page.html"
                subprocess.run([RUNGC, *command, page], cwd=ROOT, capture_output=True, check=True)
                drawn = picture(page.read_text(), rungs)
                path = ROOT / "docs" / file
                if UPDATE:
                    path.write_text(drawn)
                self.assertEqual(drawn, path.read_text(), f"{shown(path)} is stale: run tests/update")

    def test_links_lead_somewhere(self):
        for page in PAGES:
            for target in re.findall(r"\]\(([^)#]+)(?:#[^)]*)?\)", page.read_text()):
                if "://" not in target:
                    self.assertTrue((page.parent / target).exists(), f"{shown(page)} links to {target}")

    def test_commands_run_as_written(self):
        self.assertTrue((ROOT / SCRATCH / ".gitignore").is_file(), "a clone has the scratch folder")
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name).resolve()
            for part in ("examples", "docs"):
                shutil.copytree(ROOT / part, folder / part)
            (folder / SCRATCH).mkdir()
            (folder / "build").mkdir()
            (folder / "build" / "bin").symlink_to(Path(RUNGC).parent)
            for page in run_pages():
                Reader(self, folder, page).read()
            picture = (folder / SCRATCH / "pump" / "pump.svg").read_text()
        if UPDATE:
            (ROOT / "docs" / "first-machine.svg").write_text(picture)
        self.assertEqual(picture, (ROOT / "docs" / "first-machine.svg").read_text(), "docs/first-machine.svg is stale: run tests/update")

    def test_outputs_are_compared(self):
        for shown_text, printed, same in (
            ("a\nb\n", "a\nb\n", True),
            ("a\nb\n", "a\nc\n", False),
            ("a\n", "a\nb\n", False),
            ("a\n…\nd\n", "a\nb\nc\nd\n", True),
            ("a\n…\nd\n", "a\nb\nc\n", False),
            ("…\n(x|y)  1\n", "a\n(x|y) 1\n", True),
            ("ok      a.scn (12 scans, 3 ms)\n", "ok      a.scn (12 scans, 1.25 s)\n", True),
            ("ok      a.scn (12 scans, 3 ms)\n", "ok      a.scn (13 scans, 3 ms)\n", False),
            ("1 passed, 0 failed in 3 ms\n", "1 passed, 1 failed in 3 ms\n", False),
            ("T is 0 (scan 2, 0.020 s)\n", "T is 0 (scan 2, 0.030 s)\n", False),
            ("MAIN  276  80.3 ns  79.7 ns  9.7 ns  189.9 ns  0.002% of 10 ms\n", "MAIN  276  1.2 us  1e+03 us  9.7 ns  1.2 ms  12.345% of 10 ms\n", True),
            ("MAIN  276  80.3 ns  79.7 ns  9.7 ns  189.9 ns  0.002% of 10 ms\n", "MAIN  277  80.3 ns  79.7 ns  9.7 ns  189.9 ns  0.002% of 10 ms\n", False),
            ("4  276  6900  33.8%  0.0  9.7  8.3  9.7  a.lad:32  x\n", "4  276  6900  33.8%  10.0  9.0  8.0  9.8  a.lad:32  x\n", True),
            ("4  276  6900  33.8%  0.0  9.7  8.3  9.7  a.lad:32  x\n", "4  276  6901  33.8%  0.0  9.7  8.3  9.7  a.lad:32  x\n", False),
            ("4 4  1104  20426  100.0%  7.8  MAIN\n", "4 4  1104  20426  100.0%  6.1  MAIN\n", True),
        ):
            with self.subTest(shown=shown_text, printed=printed):
                self.assertEqual(same_output(shown_text, printed), same)

    def test_a_here_document_is_one_command(self):
        self.assertEqual(commands_of("a\ncat > x <<'END'\n| b\n\nEND\nc \\\n  d\n"), ["a", "cat > x <<'END'\n| b\n\nEND", "c \\\n  d"])

    def test_files_outside_the_scratch_folder_are_found(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            for part in ("docs", SCRATCH):
                (folder / part).mkdir()
            (folder / "docs" / "a").write_text("a")
            before = files_outside(folder)
            (folder / SCRATCH / "a").write_text("a")
            self.assertEqual(changed_files(before, files_outside(folder)), [])
            (folder / "docs" / "a").write_text("ab")
            (folder / "b").write_text("b")
            self.assertEqual(changed_files(before, files_outside(folder)), ["b", "docs/a"])


def run_pages():
    """Without what a build leaves out: rungc bind, by -DRUNG_CLANG=OFF."""
    has_bind = Path(RUNGC).with_name("rung-layout").exists()
    return [page for page in RUN_PAGES if has_bind or page.name != "bind.md"]


def commands_of(block):
    """The commands of a block: lines, with those that a backslash or a here-document adds."""
    commands, lines = [], iter(block.splitlines())
    for line in lines:
        command = line
        if end := re.search(r"<<'(\w+)'", line):
            for more in lines:
                command += "\n" + more
                if more == end.group(1):
                    break
        while command.endswith("\\"):
            command += "\n" + next(lines)
        if command.strip():
            commands.append(command)
    return commands


def without_times(line):
    for pattern, instead in WALL_CLOCK:
        line = pattern.sub(instead, line)
    return " ".join(line.split())


def same_output(expected, printed):
    """Whether a block shows what was printed."""
    pattern = "".join(r"(?:.*\n)*" if line.strip() == "…" else re.escape(without_times(line)) + r"\n" for line in expected.splitlines())
    return re.fullmatch(pattern, "".join(without_times(line) + "\n" for line in printed.splitlines())) is not None


def files_outside(folder):
    """State of each file but those in the scratch folder and those of the build."""
    files = {}
    for place, folders, names in os.walk(folder):
        if Path(place) == folder:
            folders[:] = [name for name in folders if name not in (SCRATCH, "build")]
        for name in names:
            path = Path(place) / name
            files[path.relative_to(folder).as_posix()] = (path.stat().st_mtime_ns, path.stat().st_size)
    return files


def changed_files(before, after):
    return sorted(name for name in before.keys() | after.keys() if before.get(name) != after.get(name))


class Reader:
    """Types the commands of a page into one shell: the folder and PATH hold from command to command."""

    def __init__(self, test, folder, page):
        self.test, self.folder, self.page = test, folder, page
        self.place, self.path = str(folder), os.environ["PATH"]
        self.files = files_outside(folder)
        self.printed = None

    def read(self):
        text = re.sub(r"^( *)```(sh|text)(?: exit=(\d+))?\n(.*?)^\1```", self.block, self.page.read_text(), flags=re.MULTILINE | re.DOTALL)
        if UPDATE:
            self.page.write_text(text)

    def block(self, match):
        indent, kind, status, body = match.groups()
        body = re.sub(f"^{indent}", "", body, flags=re.MULTILINE)
        if kind == "sh":
            commands = commands_of(body)
            statuses = [0] * (len(commands) - 1) + [int(status or 0)]
            self.printed = "".join(map(self.run, commands, statuses))
            return match.group(0)
        if same_output(body, self.printed):
            return match.group(0)
        if UPDATE and "…" not in body:
            return textwrap.indent(f"```text\n{self.printed}```", indent)
        self.test.fail(f"{shown(self.page)} shows\n{body}\nbut the commands before it print\n{self.printed}\nrun tests/update; a block with … is edited by hand")

    def run(self, command, status):
        if command.startswith(SKIPPED_COMMANDS):
            return ""
        state = self.folder / "build" / "state"
        script = f'{command}\nstatus=$?\nprintf "%s\\n" "$PWD" "$PATH" > "{state}"\nexit $status\n'
        done = subprocess.run(["bash", "-c", script], cwd=self.place, env={**os.environ, "PATH": self.path, "RUNG_SOCKETS": str(self.folder / "build" / "sockets")},
                              stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=patience())
        printed = done.stdout.decode()
        self.test.assertEqual(done.returncode, status, f"{shown(self.page)}: {command}\n{printed[-1600:]}")
        self.place, self.path = state.read_text().splitlines()
        before, self.files = self.files, files_outside(self.folder)
        self.test.assertEqual(changed_files(before, self.files), [], f"{shown(self.page)}: {command}\nchanges files outside {SCRATCH}/")
        return printed


if __name__ == "__main__":
    RUNGC = os.path.abspath(sys.argv.pop(1))
    unittest.main()
