#!/usr/bin/env python3
"""Every fix that `rungc check --json` offers is right: sources with one slip each, of the examples and the scenarios' programs.
Where a fix is applied nothing is wrong at that place any more; and a program that compiles then is the one without the slip,
but perhaps for the rung that has it: rungs of `emit ir` are compared, without their places in the source.
usage: fixes_test.py RUNGC [COUNT]     RUNG_TRUTH=large: 500 sources with a fix"""
import json
import os
import random
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
import root  # noqa: E402

root.go_to_root()
RUNGC = sys.argv.pop(1)
LARGE = os.environ.get("RUNG_TRUTH") == "large"
COUNT = int(sys.argv.pop(1)) if len(sys.argv) > 1 and sys.argv[1].isdigit() else 500 if LARGE else 120
SEED = 20261
ROUNDS = 12  # of all fixes: what was read wrongly may hide another mistake

DIALECTS = {"nct": [".lad"], "gsk": [".pmc", ".lad"], "technol": [".plc"], "fanuc": [".mne", ".lad"]}
PROJECTS = {"nct": ["examples/nct-lathe", "examples/nct-turning-centre"],
            "gsk": ["examples/gsk-mill", "examples/gsk-panel", "examples/first-cnc"],
            "technol": ["examples/technol-magazine", "examples/technol-mill", "examples/technol-machining-centre"],
            "fanuc": ["examples/fanuc-vmc"]}

# What users of other controls write, by dialect: here, there; and whether it means the same.
FOREIGN = {
    "gsk": [("LDI", "LDN"), ("ANI", "ANDN"), ("ANI", "AND NOT"), ("ORI", "ORN"), ("OUT", "ST"), ("SET", "ST"), ("LD", "ST"), ("SET", "RSET"), ("RST", "RSET"), ("OUTI", "STN"), ("SET", "S"),
            ("RST", "R"), ("LD", "RD"), ("OUT", "WRT"), ("ANB", "AND.STK"), ("ORB", "OR.STK"), ("OUT", "="), ("ORB", "OR LD"),
            ("OUTI", "WRT.NOT"), ("LDI", "RD.NOT"), ("OUT", "WR"), ("(S ", "(SET "), ("[/", "[NOT ")],
    "nct": [("TOND", "TON"), ("TOFFD", "TOF"), ("CEQ", "EQ"), ("CGT", "GT"), ("FLEQ", "EQ"), ("FLGT", "GT"), ("MOVF", "MOV"), ("SBS", "CALL"), ("JME", "LBL"), ("(S ", "(SET "),
            ("(R ", "(RESET "), ("[/", "[NOT ")],
    "technol": [("LDR", "LD"), ("WR", "ST"), ("PROC_CALL", "CAL"), ("JL1", "JMPC"), ("JL0", "JMPCN"), ("WR", "WRT"),
                ("LDR -", "LDR NOT "), ("LA -", "LA NOT "), ("LO -", "LO NOT ")],
    "fanuc": [("WRT", "OUT"), ("WRT", "ST"), ("WRT", "="), ("WRT.NOT", "OUTI"), ("WRT.NOT", "STN"), ("AND.NOT", "AND NOT"), ("AND.NOT", "ANI"), ("AND.NOT", "ANDN"), ("OR.NOT", "ORI"),
              ("OR.NOT", "OR NOT"), ("AND.STK", "ANB"), ("OR.STK", "ORB"), ("RST", "RESET"), ("RD", "LD"), ("RD.NOT", "LDI"), ("SUB", "FUNC"), ("(S ", "(SET "), ("[/", "[NOT ")],
}
LOOK_ALIKES = {"A": "А", "B": "В", "C": "С", "E": "Е", "H": "Н", "K": "К", "M": "М", "O": "О", "P": "Р", "T": "Т", "X": "Х",
               "-": "–", " ": "\u00a0", "(": "（", ")": "）", ".": "．", "0": "０"}
WORD = re.compile(r"[A-Za-z_][A-Za-z0-9_]*")


def run(arguments, cwd):
    return subprocess.run([RUNGC, *arguments], cwd=cwd, capture_output=True, timeout=120)


def replaced(line, match, text):
    return line[:match.start()] + text + line[match.end():]


def exchange(word, rng):
    places = [i for i in range(len(word) - 1) if word[i] != word[i + 1]]
    if not places:
        return None
    i = rng.choice(places)
    return word[:i] + word[i + 1] + word[i] + word[i + 2:]


def slip(word, rng):
    """A word typed wrongly; None where this way does not change it."""
    i = rng.randrange(len(word))
    kind = rng.choice(["case", "exchange", "exchange", "double", "less", "more", "other", "mark", "digit"])
    if kind == "case":
        other = word.swapcase()
    elif kind == "exchange":
        other = exchange(word, rng)
    elif kind == "double":
        other = word[:i] + word[i] + word[i:]
    elif kind == "less":
        other = word[:i] + word[i + 1:]
    elif kind == "more":
        other = word[:i] + rng.choice("ABEGNRSX1") + word[i:]
    elif kind == "other":
        other = word[:i] + rng.choice("ABEGNRSX12") + word[i + 1:]
    elif kind == "mark":
        other = word.replace("_", "", 1) if "_" in word else word[:i] + "_" + word[i:]
    else:
        other = re.sub(r"\d", lambda digit: str((int(digit[0]) + 1) % 10), word, count=1)
    return None if not other or other == word else other


def mutated(line, dialect, rng):
    """The line with one mistake, or None."""
    mark = line.find(";")
    code, rest = (line, "") if mark < 0 else (line[:mark], line[mark:])
    if not code.strip():
        return None
    kind = rng.choice(["word"] * 6 + ["foreign"] * 3 + ["look-alike"] * 2 + ["number", "operand", "quote", "hexadecimal"])
    if kind == "word":
        words = list(WORD.finditer(code))
        if not words:
            return None
        word = rng.choice(words)
        other = slip(word[0], rng)
        return other and replaced(code, word, other) + rest
    if kind == "foreign":
        here, there = rng.choice(FOREIGN[dialect])
        found = re.search(re.escape(here) if here[0] in "[(" else rf"\b{here}\b", code)
        return found and replaced(code, found, there) + rest
    if kind == "look-alike":
        places = [i for i, c in enumerate(code) if c in LOOK_ALIKES]
        if not places:
            return None
        i = rng.choice(places)
        return code[:i] + LOOK_ALIKES[code[i]] + code[i + 1:] + rest
    if kind == "number":
        digits = list(re.finditer(r"\d", code))
        return replaced(code, rng.choice(digits), rng.choice("0123456789O")) + rest if digits else None
    if kind == "operand":
        return " ".join(code.split()[:-1]) + rest if len(code.split()) > 1 and "|" not in code else None
    if kind == "hexadecimal":
        found = re.search(r"\b0x([0-9A-F]+)\b|\b(0[0-9A-F]+)h\b|#\$([0-9A-F]+)\b", code, re.IGNORECASE)
        digits = found and (found[1] or found[3] or found[2].lstrip("0"))
        forms = ["#0x{}", "#16#{}", "#0{}h", "0x{}"] if dialect == "nct" else ["0x{}", "16#{}", "${}", "0{}h"]
        return found and replaced(code, found, rng.choice(forms).format(digits or "0")) + rest
    quotes = [i for i, c in enumerate(code) if c in "\"'"]
    return code[:quotes[-1]] + code[quotes[-1] + 1:] + rest if quotes else None


class Source:
    """A program that compiles: a file alone, or a project, of which one file is changed."""

    def __init__(self, dialect, path, file):
        self.dialect, self.path, self.file = dialect, path, file
        self.text = file.read_text(encoding="utf-8").splitlines(keepends=True)
        self.is_project = path.is_dir()

    def copied(self, folder):
        """Gives what rungc is called with, and the file in it."""
        if self.is_project:
            shutil.copytree(self.path, folder, dirs_exist_ok=True)
            return ".", folder / self.file.relative_to(self.path)
        shutil.copy(self.path, folder / self.path.name)
        return self.path.name, folder / self.path.name


def unplaced(line):
    line = re.sub(r" @\d+", "", line)
    line = re.sub(r' ; ".*', "", line)
    line = re.sub(r"loc\([^)]*\)", "", line)
    line = re.sub(r"key\([^)]*\)", "", line)
    return re.sub(r'"(?:[^"\\]|\\.)*"', '""', line)


class Rungs:
    """Of `emit ir`: head, and rungs with their routine, text without places, file and first line."""

    def __init__(self, ir):
        self.head, self.rungs = [], []
        for line in ir.splitlines():
            if re.match(r"(symbol|slot|message|file|module|#) ?", line):
                continue
            if line.lstrip().startswith(("source ", "note ")) or not line.strip():
                continue
            start = re.match(r'  rung \d+ .*loc\("(?P<file>[^"]*)":(?P<line>\d+)', line)
            if start or re.match(r"(routine|task|scan|\}|  rung )", line):
                self.rungs.append(([], Path(start["file"]).name if start else "", int(start["line"]) if start else 0))
            (self.rungs[-1][0] if self.rungs else self.head).append(unplaced(line))

    def texts(self):
        return ["\n".join(lines) for lines, _, _ in self.rungs]

    def at(self, name, line):
        """Indices of the rungs that a line may belong to: the last one that begins there or above, in each routine."""
        before = [(start, i) for i, (_, file, start) in enumerate(self.rungs) if file == name and 0 < start <= line]
        last = max((start for start, _ in before), default=0)
        return {i for start, i in before if start == last}


def difference(old, new):
    """Indices of the rungs of `old` that are others in `new`."""
    old, new = old.texts(), new.texts()
    first = 0
    while first < min(len(old), len(new)) and old[first] == new[first]:
        first += 1
    end = 0
    while end < min(len(old), len(new)) - first and old[-1 - end] == new[-1 - end]:
        end += 1
    return set(range(first, max(len(old), len(new)) - end))


def diagnostics(argument, folder):
    return json.loads(run(["check", argument, "--json"], folder).stdout or "[]")


def applied(text, fixes):
    """Lines with the fixes, the last one first; columns count characters."""
    lines = list(text)
    for fix in sorted(fixes, key=lambda fix: (fix["line"], fix["column"]), reverse=True):
        line = lines[fix["line"] - 1]
        lines[fix["line"] - 1] = line[:fix["column"] - 1] + fix["replacement"] + line[fix["endColumn"] - 1:]
    return lines


class Case:
    def __init__(self, source, seed):
        self.source, self.seed = source, seed
        self.problems, self.fixes, self.same, self.in_rung, self.open = [], 0, 0, 0, 0

    def mutate(self, rng):
        lines = list(self.source.text)
        for _ in range(40):
            at = rng.randrange(len(lines))
            other = mutated(lines[at].rstrip("\r\n"), self.source.dialect, rng)
            if other:
                self.line = at + 1
                self.before, self.after = lines[at].rstrip(), other
                lines[at] = other + "\n"
                return lines
        return None

    def run(self):
        lines = self.mutate(random.Random(self.seed))
        if lines is None:
            return self
        with tempfile.TemporaryDirectory(prefix="rung-fixes-") as name:
            self.folder = Path(name)
            self.argument, self.file = self.source.copied(self.folder)
            self.try_fixes(lines)
        return self

    def write(self, lines):
        self.file.write_text("".join(lines), encoding="utf-8", newline="")

    def found(self, lines):
        self.write(lines)
        return diagnostics(self.argument, self.folder)

    def ours(self, found):
        return [d for d in found if Path(d["file"]).name == self.file.name]

    def try_fixes(self, lines):
        wrong = self.ours(self.found(lines))
        offered = [d for d in wrong if d["fixes"] and all(Path(fix["file"]).name == self.file.name for fix in d["fixes"])]
        for wrong_one in offered:
            self.fixes += 1
            self.try_one(lines, wrong_one)
        if offered:
            self.compare(self.all_applied(lines, wrong))

    def try_one(self, lines, wrong):
        """The mistake is gone: where something is fixed nothing is wrong, nor with the word that the fix put there."""
        rest = self.ours(self.found(applied(lines, wrong["fixes"])))
        place = (wrong["line"], wrong["column"])
        again = [d for d in rest if d["severity"] == "error" and (d["line"], d["column"]) == place]
        if again:
            self.problem(f"{wrong['fixes'][0]['replacement']!r} in {place} leaves {again[0]['code']}: {again[0]['message']}")

    def all_applied(self, lines, wrong):
        for _ in range(ROUNDS):
            fixes = [fix for d in wrong for fix in d["fixes"]]
            if not fixes:
                return lines
            lines = applied(lines, fixes)
            wrong = self.ours(self.found(lines))
        return lines

    def compare(self, lines):
        self.write(lines)
        done = run(["emit", "ir", self.argument], self.folder)
        if done.returncode != 0:  # the slip had other consequences, for which there is no fix
            self.open += 1
            return
        new = Rungs(done.stdout.decode())
        self.write(self.source.text)
        old = Rungs(run(["emit", "ir", self.argument], self.folder).stdout.decode())
        different = difference(old, new)
        if old.head != new.head:
            self.problem("the fixed program has another head")
        elif different - old.at(self.file.name, self.line):
            self.problem(f"the fixed program differs in rungs {sorted(different)[:5]}")
        self.same += not different
        self.in_rung += bool(different)

    def problem(self, text):
        self.problems.append(f"{self.source.file}:{self.line} (seed {self.seed})\n    {self.before}\n    {self.after}\n    {text}")


def is_text(file):
    """Other code pages are written by bytes."""
    try:
        return bool(file.read_text(encoding="utf-8"))
    except UnicodeDecodeError:
        return False


def sources(dialect):
    """Programs that compile by themselves; every example, and scenarios' programs."""
    found = []
    for project in map(Path, PROJECTS[dialect]):
        for file in sorted(project.rglob("*")):
            if file.suffix in DIALECTS[dialect]:
                found.append(Source(dialect, project, file))
    for file in sorted(Path("tests/scenarios", dialect).iterdir()):
        if file.suffix in DIALECTS[dialect] and not re.search(r"error|limit", file.name) and is_text(file):
            found.append(Source(dialect, file, file))
    return found


class Fixes(unittest.TestCase):
    def test_every_fix_is_right(self):
        workers = ThreadPoolExecutor(max_workers=2)
        for dialect in DIALECTS:
            with self.subTest(dialect):
                self.hold(dialect, workers)

    def usable(self, source, known):
        """Compiles where it is copied to."""
        if source.path not in known:
            with tempfile.TemporaryDirectory(prefix="rung-fixes-") as folder:
                argument, _ = source.copied(Path(folder))
                known[source.path] = run(["check", argument], folder).returncode == 0
        return known[source.path]

    def hold(self, dialect, workers):
        rng = random.Random(f"{SEED} {dialect}")
        candidates, known = sources(dialect), {}
        wanted = COUNT // len(DIALECTS)
        count, mutants, problems = Counter(), 0, []
        while count["sources"] < wanted and mutants < 60 * wanted:
            batch = []
            while len(batch) < 20:
                source = rng.choice(candidates)
                if self.usable(source, known):
                    batch.append(Case(source, rng.randrange(1 << 30)))
            for case in workers.map(Case.run, batch):
                mutants += 1
                problems += case.problems
                count["sources"] += case.fixes > 0
                for name in ("fixes", "same", "in_rung", "open"):
                    count[name] += getattr(case, name)
        print(f"{dialect}: {mutants} sources with a slip, {count['sources']} of them with {count['fixes']} fixes; "
              f"{count['same']} are the same program after them, {count['in_rung']} differ in the rung of the slip, "
              f"{count['open']} have further mistakes; {len(problems)} wrong")
        self.assertEqual(count["sources"] >= wanted, True, "too few sources with a fix")
        self.assertFalse(problems, "\n".join(problems[:20]))


if __name__ == "__main__":
    unittest.main()
