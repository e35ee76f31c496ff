"""Instructions that the example machines execute per part: a scan, for FANUC and GSK a slot of 8 ms."""
import tempfile
from pathlib import Path

from callgrind import BY_ADDRESS, TARGET, code_lines, counted, run, self_costs

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
RECORDINGS = HERE / "machines" / "recordings"
IDLE_PARTS = (200, 500)  # the first one that is counted, and how many
SEEN_PART = 100  # the one whose cache lines of code are counted

MACHINES = {
    "fanuc-vmc": {"part program": "nc-program.scn", "tool change": "tool-change.scn"},
    "gsk-mill": {"part program": "nc-program.scn", "tool change": "tool-change.scn"},
    "nct-turning-centre": {"part program": "nc-program.scn", "tool change": "nc-tools.scn"},
    "technol-machining-centre": {"part program": "part-program.scn", "tool change": "tool-change.scn"},
}
PROFILED = "part program"
HEAD = """## Instructions of the example machines

Exact counts by callgrind: a program built by `rungc build`, in a host of the runtime library with
the control of its dialect. What the machine does comes from a recording; writing it into the
program's memory is not counted. The unit is a scan, for FANUC and GSK a slot of 8 ms. After each
one a hash of the program's memory is compared with the interpreter's. `./dev bench --count` prints
this table and the next ones only. "With its profile": built with `--profile-use` from the counts
that `rungc profile -o` took of the part program. Cache lines of code: lines of 64 bytes that the
compiled rungs execute in one scan or slot; a scan after a sleep loads each of them.
"""


def recording(machine, situation):
    return RECORDINGS / f"{machine}-{situation.replace(' ', '-')}.txt"


def parts_of(path):
    """A line begins with a hash, or repeats the line before it N times (*N)."""
    lines = path.read_text(encoding="ascii").splitlines()[1:]
    return sum(int(line[1:]) if line.startswith("*") else 1 for line in lines)


def record(tools):
    RECORDINGS.mkdir(exist_ok=True)
    for machine, situations in MACHINES.items():
        for situation, scenario in situations.items():
            text = run(tools / "rung-bench-record", f"examples/{machine}/{scenario}", cwd=ROOT)
            recording(machine, situation).write_text(text, encoding="ascii")


def count(tools, program, path, parts, folder):
    """Per part: instructions of the program's code, all instructions, cache lines of the program's code."""
    profile = Path(folder) / "profile"
    first, number = parts
    run(tools / "rung-bench-scan", program, path)
    counted(profile, tools / "rung-bench-scan", program, path, first, number)
    costs = self_costs(profile)
    rungs = sum(cost for name, cost in costs.items() if name and name.endswith(program.name))
    counted(profile, tools / "rung-bench-scan", program, path, min(SEEN_PART, first + number - 1), 1, options=BY_ADDRESS)
    return round(rungs / number), round(sum(costs.values()) / number), code_lines(profile, program.name)


def build(tools, machine, program, *options):
    run(tools / "rungc", "build", "--target", TARGET, *options, "-o", program, cwd=ROOT / "examples" / machine)


def built_with_profile(tools, machine, scenario, program):
    branches = program.with_suffix(".prof")
    run(tools / "rungc", "profile", "--repeat", "1", "-o", branches, scenario, cwd=ROOT / "examples" / machine)
    build(tools, machine, program, "--profile-use", branches)


def measure(tools):
    rows = {}
    with tempfile.TemporaryDirectory() as folder:
        nothing = Path(folder) / "nothing.txt"
        nothing.write_text("recording of nothing\n", encoding="ascii")
        for machine, situations in MACHINES.items():
            program = Path(folder) / f"{machine}.so"
            build(tools, machine, program)
            rows[f"{machine}, after cold start"] = count(tools, program, nothing, IDLE_PARTS, folder)
            for situation in situations:
                path = recording(machine, situation)
                rows[f"{machine}, {situation}"] = count(tools, program, path, (0, parts_of(path)), folder)
            built_with_profile(tools, machine, situations[PROFILED], program)
            path = recording(machine, PROFILED)
            rows[f"{machine}, {PROFILED}, with its profile"] = count(tools, program, path, (0, parts_of(path)), folder)
    return rows


def text_of(rows):
    lines = [HEAD, "| machine | compiled rungs | runtime | instructions per scan or slot | cache lines of code |", "| --- | --- | --- | --- | --- |"]
    for name, (rungs, total, code) in rows.items():
        lines.append(f"| {name} | {rungs:,} | {total - rungs:,} | {total:,} | {code:,} |")
    return "\n".join(lines) + "\n"
