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

A program starts as `rungc run` starts it: interpreted, while a thread for each core compiles it with all optimisations. CPU time is that of all threads, in ms: of the start of the
process, the stages of the compiler, and the making of the engine with the first scan; then real time from `main` until the last piece is optimised, on {cores} cores, in which LLVM is loaded. Medians of {runs} runs ({large_runs} of the programs of {large:,} rungs and more, which are bit logic). Memory is the most that the process ever had.
"""


def measured(tools, path, runs):
    """Medians of what rung-bench-start prints."""
    made = [json.loads(run(tools / "rung-bench-start", path)) for _ in range(runs)]
    row = {key: statistics.median(one[key] for one in made) for key in ("first", "optimised", "real", "resident")}
    row["stages"] = {stage: statistics.median(one["stages"][stage] for one in made) for stage in STAGES}
    return row


def measure(tools):
    rows = {name: measured(tools, ROOT / "examples" / name / "rung.toml", RUNS) for name in MACHINES}
    with tempfile.TemporaryDirectory() as folder:
        for dialect, size in GENERATED:
            path = Path(folder) / f"{dialect}-{size}.{ENDINGS[dialect]}"
            path.write_text(run(tools / "rung-bench-generated", "source", dialect, "bits", str(size)), encoding="utf-8")
            rows[f"{dialect.upper()}, {size:,} rungs"] = measured(tools, path, LARGE_RUNS if size >= LARGE else RUNS)
    return rows


def text_of(rows, cores):
    titles = ["program", *STAGES, "to the first scan", "of it after the check", "until all is optimised", "the same, real time", "memory, MB"]
    lines = [HEAD.format(cores=cores, runs=RUNS, large_runs=LARGE_RUNS, large=LARGE), f"| {' | '.join(titles)} |", "|" + " --- |" * len(titles)]
    for name, row in rows.items():
        stages = row["stages"]
        after = row["first"] - stages["process"] - stages["check"]
        times = [*(stages[stage] for stage in STAGES), row["first"], after, row["optimised"], row["real"]]
        lines.append(f"| {name} | {' | '.join(f'{ms:.1f}' if ms < 100 else f'{ms:,.0f}' for ms in times)} | {row['resident']:.0f} |")
    return "\n".join(lines) + "\n"
