#!/usr/bin/env python3
"""rungc format as a user sees it: which files change and how, exit statuses, encodings. format_test.py RUNGC"""
import os
import shutil
import stat
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

LADDER = """dialect nct
module MAIN
symbol A  7000.00;a bit

rung
|-[A]-+-(7001.00)
|[@A]-+
"""
LAID_OUT = """dialect nct
module MAIN
symbol A 7000.00  ;a bit

rung
|--[A]---+--(7001.00)
|--[@A]--+
"""
BROKEN = "dialect nct\nmodule MAIN\nrung\n|--[A]--(B\n"
LIST = "ld X0.0\nout  Y0.0 ; lamp\n"
LIST_LAID_OUT = "LD   X0.0\nOUT  Y0.0         ; lamp\n"
MNEMONIC = "DATA\nTXT: STR 5,'\u010daj'   ; \u010d\nDATA_END\n"
MNEMONIC_LAID_OUT = "DATA\nTXT:    STR  5,'\u010daj'              ; \u010d\nDATA_END\n"


class Format(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def file(self, name, text):
        path = self.folder / name
        path.parent.mkdir(exist_ok=True)
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return path

    def format(self, *args, status=OK, stdin=b"", cwd=None):
        done = subprocess.run([RUNGC, "format", *map(str, args)], input=stdin, capture_output=True, timeout=patience(), check=False, cwd=cwd)
        self.assertEqual(done.returncode, status, done.stderr)
        return done.stdout.decode("latin-1"), done.stderr.decode()

    def test_only_what_changes_is_written(self):
        changed, same = self.file("a.lad", LADDER), self.file("b.lad", LAID_OUT)
        inode = same.stat().st_ino
        self.assertEqual(self.format(changed, same), (f"formatted {changed}\n", ""))
        self.assertEqual(changed.read_text(), LAID_OUT)
        self.assertEqual(same.stat().st_ino, inode, "a file that is laid out is not written")
        self.assertEqual(self.format(changed, same), ("", ""))

    def test_quiet(self):
        self.assertEqual(self.format("-q", self.file("a.lad", LADDER)), ("", ""))
        self.assertEqual((self.folder / "a.lad").read_text(), LAID_OUT)

    def test_check_writes_nothing(self):
        changed, same = self.file("a.lad", LADDER), self.file("b.lad", LAID_OUT)
        self.assertEqual(self.format("--check", changed, same, status=WRONG), (f"{changed}\n", ""))
        self.assertEqual(changed.read_text(), LADDER)
        self.assertEqual(self.format("--check", same), ("", ""))

    def test_standard_output(self):
        path = self.file("a.lad", LADDER)
        self.assertEqual(self.format("--stdout", path), (LAID_OUT, ""))
        self.assertEqual(path.read_text(), LADDER)
        self.assertEqual(self.format("-", stdin=LADDER.encode()), (LAID_OUT, ""))
        self.assertEqual(self.format("--dialect", "gsk", "-", stdin=LIST.encode()), (LIST_LAID_OUT, ""))
        self.format("--stdout", "--check", path, status=USAGE)

    def test_mistakes(self):
        broken, good = self.file("a.lad", BROKEN), self.file("b.lad", LADDER)
        out, errors = self.format(broken, good, status=WRONG)
        self.assertIn(f"{broken}:4:9: error: this element is not closed", errors)
        self.assertEqual(broken.read_text(), BROKEN)
        self.assertEqual((out, good.read_text()), (f"formatted {good}\n", LAID_OUT), "a file with mistakes does not keep others")
        self.format(self.folder / "none.lad", status=ENVIRONMENT)
        self.assertIn("[unknown-dialect]", self.format("--dialect", "klm", good, status=WRONG)[1])
        self.assertIn("[missing-dialect]", self.format("-", stdin=LIST.encode(), status=WRONG)[1])

    def test_names_need_no_declaration(self):
        self.assertEqual(self.format("--stdout", self.file("part.pmc", "LD  NOT_DECLARED\n"))[0], "LD   NOT_DECLARED\n")

    def test_mode_and_link(self):
        path = self.file("a.lad", LADDER)
        path.chmod(0o640)
        link = self.folder / "link.lad"
        link.symlink_to(path)
        mask = os.umask(0o077)
        self.addCleanup(os.umask, mask)
        self.format(link)
        self.assertTrue(link.is_symlink())
        self.assertEqual((path.read_text(), stat.S_IMODE(path.stat().st_mode)), (LAID_OUT, 0o640))

    def test_line_ends_mark_and_last_line(self):
        path = self.file("a.lad", b"\xef\xbb\xbf" + LADDER.replace("\n", "\r\n").encode().rstrip())
        self.format(path)
        self.assertEqual(path.read_bytes(), b"\xef\xbb\xbf" + LAID_OUT.replace("\n", "\r\n").encode())

    def test_encodings(self):
        for encoding in ("utf-8", "cp1250", "cp852"):
            for end in ("", "\x1a"):
                path = self.file("a.plc", (MNEMONIC + end).encode(encoding))
                self.format(path)
                self.assertEqual(path.read_bytes(), (MNEMONIC_LAID_OUT + end).encode(encoding))
        told = "; encoding: gb18030\ndialect gsk\nFUNC END1\n    LD X0.0   ; 急停 |\n  OUT Y0.0\nFUNC END2\n\x1a"
        path = self.file("c.pmc", told.encode("gb18030"))
        self.format(path)
        text = path.read_bytes().decode("gb18030")
        self.assertIn("; 急停 |\n", text)
        self.assertTrue(text.startswith("; encoding: gb18030\n") and text.endswith("\n\x1a"), text)
        self.format(path, "--check")
        self.assertIn("[bad-encoding]", self.format(self.file("b.plc", b"DATA\0\n"), status=WRONG)[1])
        self.assertIn("[bad-encoding]", self.format(self.file("b.pmc", "LD X0.0 ; č".encode("cp1250")), status=WRONG)[1])

    def test_project(self):
        for where in ("folder", "rung.toml", "inside"):
            project = self.folder / where
            shutil.copytree("examples/technol-machining-centre", project)
            for source in (project / "main.plc", project / "centre.inc"):
                source.write_text(source.read_text() + "\n\n")
            named = {"folder": [project], "rung.toml": [project / "rung.toml"], "inside": []}[where]
            out, _ = self.format(*named, cwd=project if where == "inside" else None)
            base = "" if where == "inside" else f"{project}/"
            self.assertEqual(out, f"formatted {base}main.plc\nformatted {base}centre.inc\n")
            self.assertEqual(self.format("--check", *named, cwd=project if where == "inside" else None), ("", ""))

    def test_included_file_by_its_name(self):
        self.file("rung.toml", 'dialect = "technol"\nfiles = ["a.plc"]\n')
        self.file("a.plc", MNEMONIC)
        part = self.file("part.inc", " EQUI A,1\n")
        self.assertEqual(self.format(part)[0], f"formatted {part}\n")
        self.assertEqual(part.read_text(), "        EQUI A,1\n")
        self.assertEqual((self.folder / "a.plc").read_text(), MNEMONIC)

    def test_what_a_project_includes_from_elsewhere_stays(self):
        self.file("shared/other.inc", " EQUI A,1\n")
        self.file("mine/rung.toml", 'dialect = "technol"\nfiles = ["a.plc"]\n')
        self.file("mine/own.inc", " EQUI B,1\n")
        self.file("mine/a.plc", "        T_INCLUDE own.inc\n        T_INCLUDE ../shared/other.inc\n")
        self.assertEqual(self.format(self.folder / "mine")[0], f"formatted {self.folder}/mine/own.inc\n")

    def test_examples_are_laid_out(self):
        for project in sorted(Path("examples").glob("*/rung.toml")):
            self.format("--check", project)
        others = [path for path in sorted(Path("examples").rglob("*.*")) if path.suffix in (".lad", ".pmc", ".plc", ".inc")]
        self.assertEqual(self.format("--check", *others), ("", ""))


if __name__ == "__main__":
    go_to_root()
    RUNGC = os.path.abspath(sys.argv.pop(1))
    unittest.main()
