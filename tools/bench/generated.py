"""Generated programs: each dialect's beside the straight-line C++ of the same work.

The programs are built once in a folder (`Programs`), and counted, timed and looked at from there."""
import hashlib
import json
import os
import subprocess
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from callgrind import TARGET, Failure, counted, run, self_costs, touched
from peers import Peers

DIALECTS = ("nct", "gsk", "technol")
KINDS = ("bits", "arrays", "timers-idle", "timers-running", "counters", "integers", "reals", "indexed", "signals",
         "mechanisms-idle", "mechanisms-waiting", "mechanisms", "full")
SIZES = (100, 1000)
LARGE_SIZES = (10_000, 50_000)
LARGE_KINDS = ("bits", "full")  # of these the usual report has large ones, too
ARITHMETIC = ("integers", 200)  # of the full program of 1,000 rungs; 100 timers and 100 counters are in SIZES
SMALL_WORKS = [(kind, SIZES[0]) for kind in KINDS]
NO_ROOM = 4  # status of rung-bench-generated
COMPILERS = {"g++": "g++", "clang++": "clang++-19"}
FORMS = ("byte", "packed")
LIMIT_S = 1800  # for a compiler


def works(large_kinds=()):
    return [(kind, size) for kind in KINDS for size in SIZES + (LARGE_SIZES if kind in large_kinds else ())] + [ARITHMETIC]


class Programs:
    def __init__(self, tools, folder):
        self.tools, self.folder = tools, Path(folder)
        self.program = tools / "rung-bench-generated"
        self.peers = Peers(self.program, folder)

    def build(self, name, source, ending):
        path = self.folder / f"{name}.so"
        text = self.folder / f"{name}.{ending}"
        text.write_text(source, encoding="utf-8")
        run(self.tools / "rungc", "build", "--target", TARGET, "-o", path, text)
        return path

    def ours(self, dialect, kind, size):
        """The shared object; None where the control has no room for so many."""
        name = f"{dialect}-{kind}-{size}"
        if (self.folder / f"{name}.so").exists():
            return self.folder / f"{name}.so"
        made = subprocess.run([self.program, "source", dialect, kind, str(size)], capture_output=True, text=True, check=False)
        if made.returncode == NO_ROOM:
            return None
        if made.returncode != 0:
            raise Failure(made.stderr)
        return self.build(name, made.stdout, ENDINGS[dialect])

    def straight(self, kind, size):
        """(form, compiler): shared object, of each. They are kept from run to run: compilers take an hour for the large
        ones, and their sources are frozen."""
        made = {}
        kept = self.tools.parent / "bench-straight"
        kept.mkdir(exist_ok=True)
        for form in FORMS:
            source = self.folder / f"straight-{kind}-{size}-{form}.cpp"
            if not source.exists():
                source.write_text(run(self.program, "straight", kind, size, form), encoding="ascii")
            for name, compiler in COMPILERS.items():
                version = run(compiler, "--version").splitlines()[0]
                key = hashlib.sha256(source.read_bytes() + version.encode()).hexdigest()[:16]
                path = kept / f"{key}.so"
                if not path.exists():
                    fresh = kept / f"{key}.part"
                    run(compiler, "-std=c++20", "-O3", "-shared", "-fPIC", "-o", fresh, source, timeout=LIMIT_S)
                    fresh.rename(path)
                made[form, name] = path
        return made

    def others(self, kind, size):
        return self.straight(kind, size) | self.peers.forms(kind, size)

    def words(self, command, dialect, work, forms):
        kind, size = work
        paths = [word for (form, _), path in forms.items() for word in (form, path)]
        return [self.program, command, dialect, kind, size, self.ours(dialect, kind, size), *paths]

    def count(self, dialect, work, forms):
        """Instructions a scan: of our compiled rungs, of all of ours, of each straight-line form, of each peer."""
        run(*self.words("check", dialect, work, forms))
        profile = self.folder / f"profile-{dialect}-{work[0]}-{work[1]}"
        scans = int(counted(profile, *self.words("count", dialect, work, forms)))
        costs = [self_costs(Path(f"{profile}.{i + 1}")) for i in range(1 + len(forms))]
        rungs = sum(cost for name, cost in costs[0].items() if name and name.endswith(f"{dialect}-{work[0]}-{work[1]}.so"))
        totals = [round(sum(each.values()) / scans) for each in costs]
        others = dict(zip(forms, totals[1:]))
        return {"rungs": round(rungs / scans), "ours": totals[0],
                "straight": {key: total for key, total in others.items() if key[0] in FORMS},
                "peers": {name: total for (form, name), total in others.items() if form not in FORMS}}

    def counts(self, all_works, with_straight):
        """By dialect, kind, size. Where there is no room: None."""
        def one(work):
            rows = {}
            forms = self.others(*work) if with_straight and any(self.ours(d, *work) for d in DIALECTS) else {}
            for dialect in DIALECTS:
                if self.ours(dialect, *work) is None:
                    rows[dialect, *work] = None
                    continue
                rows[dialect, *work] = self.count(dialect, work, forms)
            return rows
        with ThreadPoolExecutor(os.cpu_count()) as pool:
            return {key: row for rows in pool.map(one, all_works) for key, row in rows.items()}

    def fastest(self, row, work):
        """The straight-line form with the fewest instructions, as `words` wants it."""
        best = min(row["straight"], key=row["straight"].get)
        return {best: self.straight(*work)[best]}

    def times(self, dialect, work, form):
        """Nanoseconds of each wake-up: (hot, after a sleep, after other work) of ours, then of the straight-line form; then of
        ours after a sleep that ends early, with what a scan reads touched."""
        return json.loads(run(*self.words("cold", dialect, work, form)))

    def footprint(self, dialect, work, forms):
        """(lines of code, of data), (pages of code, of data) that one scan touches; of the last form, without one of ours."""
        return [touched(bytes_, self.folder, *self.words("touch", dialect, work, forms)) for bytes_ in (64, 4096)]


ENDINGS = {"nct": "lad", "gsk": "pmc", "technol": "plc"}


class Instructions:
    """What each instruction of a dialect costs: a program of equal rungs less the empty one, divided by their number."""
    RUNGS = 100

    def __init__(self, programs, dialect):
        self.programs, self.dialect = programs, dialect
        self.titles = run(programs.program, "instructions", dialect).splitlines()

    def program(self, index, rungs):
        name = f"{self.dialect}-instruction-{index}-{rungs}"
        source = run(self.programs.program, "instruction", self.dialect, index, rungs)
        return self.programs.build(name, source, ENDINGS[self.dialect])

    def one(self, index, rungs):
        """Instructions a scan; nanoseconds hot, and cold."""
        words = [self.dialect, index, rungs, self.program(index, rungs)]
        profile = self.programs.folder / "profile-instruction"
        scans = int(counted(profile, self.programs.program, "count-rungs", *words))
        hot, cold, *_ = json.loads(run(self.programs.program, "cold-rungs", *words))
        return sum(self_costs(profile).values()) / scans, median(hot), percentile(cold, 10)

    def rows(self):
        """(title, instructions, ns hot, ns cold) of one."""
        empty = self.one(0, 0)
        return [(title, *((full - none) / self.RUNGS for full, none in zip(self.one(index, self.RUNGS), empty)))
                for index, title in enumerate(self.titles)]


def percentile(values, percent):
    ordered = sorted(values)
    return ordered[min(len(ordered) - 1, len(ordered) * percent // 100)]


def median(values):
    return percentile(values, 50)
