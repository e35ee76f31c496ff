"""From sources to the first scan, and until all code is optimised."""
import json
import statistics
import tempfile
from pathlib import Path

from callgrind import run
from generated import ENDINGS
from machines import MACHINES, ROOT

RUNS = 9
LARGE_RUNS = 3
GENERATED = (("nct", 1000), ("nct", 10_000), ("nct", 50_000), ("gsk", 1000), ("technol", 1000), ("technol", 10_000), ("technol", 50_000))
LARGE = 10_000
STAGES = ("process", "check", "lowering", "verifier", "uses", "passes", "layout", "hash", "engine and scan")
HEAD = """## Start

Programs start as in `rungc run`: interpreted, while one thread per core compiles them with all
optimisations. CPU time, in ms, is that of all threads: for the start of the process, for each stage
of the compiler, and for the creation of the engine with the first scan. Real time is from `main`
until the last code unit is optimised, on {cores} cores, and includes the loading of LLVM. Medians
of {runs} runs ({large_runs} for programs of {large:,} rungs and more). The generated programs are
bit logic. Memory is the peak of the process.
"""


def measured(tools, paths, runs):
    """Medians of what rung-bench-start prints."""
    made = [json.loads(run(tools / "rung-bench-start", *paths)) for _ in range(runs)]
    row = {key: statistics.median(one[key] for one in made) for key in ("first", "optimised", "real", "resident", "rungs", "block")}
    row["stages"] = {stage: statistics.median(one["stages"][stage] for one in made) for stage in STAGES}
    return row


def measure(tools):
    rows = {name: measured(tools, [ROOT / "examples" / name / "rung.toml"], RUNS) for name in MACHINES}
    with tempfile.TemporaryDirectory() as folder:
        for dialect, size in GENERATED:
            path = Path(folder) / f"{dialect}-{size}.{ENDINGS[dialect]}"
            path.write_text(run(tools / "rung-bench-generated", "source", dialect, "bits", str(size)), encoding="utf-8")
            rows[f"{dialect.upper()}, {size:,} rungs"] = measured(tools, [path], LARGE_RUNS if size >= LARGE else RUNS)
    return rows


def text_of(rows, cores):
    titles = ["program", *STAGES, "all to the first scan", "of these after the check", "all until optimised", "real time until optimised", "memory, MB"]
    lines = [HEAD.format(cores=cores, runs=RUNS, large_runs=LARGE_RUNS, large=LARGE), f"| {' | '.join(titles)} |", "|" + " --- |" * len(titles)]
    for name, row in rows.items():
        stages = row["stages"]
        after = row["first"] - stages["process"] - stages["check"]
        times = [*(stages[stage] for stage in STAGES), row["first"], after, row["optimised"], row["real"]]
        lines.append(f"| {name} | {' | '.join(f'{ms:.1f}' if ms < 100 else f'{ms:,.0f}' for ms in times)} | {row['resident']:.0f} |")
    return "\n".join(lines) + "\n"
