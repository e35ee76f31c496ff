"""Programs of real machines (real/programs.py): from the sources to code, instructions and cold scans, beside the same
networks in straight-line C++, where FANUC_PROGRAMS names them."""
import statistics
import sys
import tempfile
from pathlib import Path

from callgrind import TARGET, counted, run, self_costs
from generated import percentile

sys.path.append(str(Path(__file__).resolve().parent / "real"))
import ladder  # noqa: E402
import programs  # noqa: E402
import start  # noqa: E402
import straight  # noqa: E402

HERE = Path(__file__).resolve().parent
IDLE, RANDOM = 0, 1  # seeds
FIRST, COUNT = 20, 100  # scans that are counted
COLD_SCANS, RUNS = 1000, 5
HEAD = """## Programs of real machines

FANUC programs that others wrote ([tests/fanuc-programs](../tests/fanuc-programs/README.md) says
where they are): eight versions of a builder's program of grinding machines, by the first digits of
their hashes, and FANUC's base program. The reference is the same networks in straight-line C++,
made by a reader of its own from the mnemonic files (tools/bench/real): a bit that only contacts and
coils use is a byte, functions are inline code, and clang++ compiles it at -O3. Both get the same
inputs, and all that the program can write is compared after each scan. A scan is level 1 and the
whole of level 2, in the host's runner, without a control. "Idle": all inputs and the retained
memory are 0. "Random": retained memory and inputs are random, and 4 bytes of inputs change before
each scan.
"""
START_HEAD = """Programs start as in `rungc run` (see [Start](#start)), here with medians of {runs} runs.

| program | commands | rungs | check, ms | to the first scan, ms of CPU | until optimised, ms of CPU | until optimised, ms of real time | memory, MB | memory block, kB |
| --- | --- | --- | --- | --- | --- | --- | --- | --- |"""
COUNT_HEAD = """Instructions of a scan by callgrind, as above.

| program | idle: compiled rungs | with the runner | reference | rungs / reference | random: compiled rungs | with the runner | reference | rungs / reference |
| --- | --- | --- | --- | --- | --- | --- | --- | --- |"""
COLD_HEAD = """A scan after a sleep of 1 ms, as in [Cold scans](#cold-scans), in microseconds; random inputs.

| program | 10 %: ours, reference, ratio | median: ours, reference, ratio |
| --- | --- | --- |"""


def build_straight(files, target):
    source = target.with_suffix(".cpp")
    source.write_text(straight.source(ladder.read(files)), encoding="utf-8")
    run("clang++-19", "-std=c++20", "-O3", "-shared", "-fPIC", "-fvisibility=hidden", f"-I{HERE / 'real'}", "-o", target, source)


def instructions(tools, program, reference, seed, which):
    """Of a scan: in the code of the program or the reference, and with all that it calls and that calls it."""
    profile = program.with_suffix(".profile")
    counted(profile, tools / "rung-bench-real", program, reference, seed, FIRST + COUNT, which, FIRST, COUNT)
    costs = self_costs(profile)
    code = sum(cost for name, cost in costs.items() if name and name.endswith((program.name, reference.name)))
    return round(code / COUNT), round(sum(costs.values()) / COUNT)


def commands_of(files):
    """Statements of the ladder, without the ends of levels and subprograms."""
    read = ladder.read(files)
    return sum(len(part) for part in [*read.levels.values(), *read.subprograms.values()])


def measured(tools, files, folder):
    program, reference = folder / "program.so", folder / "straight.so"
    run(tools / "rungc", "build", "--no-project", "-q", "--target", TARGET, "-o", program, *files)
    build_straight(files, reference)
    run(tools / "rung-bench-real", program, reference, RANDOM, COUNT)
    times = [tuple(map(float, line.split())) for line in run(tools / "rung-bench-real", program, reference, RANDOM, COLD_SCANS, "cold").splitlines()]
    return {
        "commands": commands_of(files),
        "start": start.measured(tools, files, RUNS),
        "counts": {seed: [instructions(tools, program, reference, seed, which) for which in ("ours", "straight")] for seed in (IDLE, RANDOM)},
        "cold": list(zip(*times)),
    }


def pair(ours, theirs):
    return f"{ours:.1f}, {theirs:.1f}, {ours / theirs:.2f}"


def text_of(rows):
    if not rows:
        return ""
    out = [HEAD, START_HEAD.format(runs=RUNS)]
    for name, row in rows.items():
        begin = row["start"]
        out.append(f"| {name} | {row['commands']:,} | {begin['rungs']:,} | {begin['stages']['check']:.0f} | {begin['first']:.0f} | {begin['optimised']:,.0f} "
                   f"| {begin['real']:,.0f} | {begin['resident']:.0f} | {begin['block'] / 1000:.0f} |")
    out += ["", COUNT_HEAD]
    for name, row in rows.items():
        cells = [f"{ours[0]:,} | {ours[1]:,} | {theirs[1]:,} | {ours[0] / theirs[1]:.2f}" for ours, theirs in row["counts"].values()]
        out.append(f"| {name} | {' | '.join(cells)} |")
    out += ["", COLD_HEAD]
    for name, row in rows.items():
        ours, theirs = row["cold"]
        out.append(f"| {name} | {pair(percentile(ours, 10), percentile(theirs, 10))} | {pair(statistics.median(ours), statistics.median(theirs))} |")
    return "\n".join(out) + "\n"


def extracted(folder):
    """The files of each program; none where they are not on this machine."""
    return {} if programs.folder() is None else programs.extract(folder)


def measure(tools):
    with tempfile.TemporaryDirectory() as made:
        folder = Path(made)
        return {name: measured(tools, files, folder) for name, files in extracted(folder).items()}


if __name__ == "__main__":
    print(text_of(measure(Path(sys.argv[1]))), end="")
