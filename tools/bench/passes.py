"""What each pass of the optimiser gains: programs built without it."""
import sys
import tempfile
from pathlib import Path

import machines
import real
from callgrind import counted, run, self_costs

PASSES = ("inline", "fold", "reuse", "dead", "transient", "versions")
ALL = "-"
HEAD = """## What each pass gains

Instructions of the compiled rungs in a scan or slot, if the pipeline runs without this pass: LLVM's
own passes remain, and do a part of its work. The machines execute their part program; the programs
of real machines have random inputs. In brackets: how many more than with all passes.

| program | all passes | {titles} |
| --- | --- | {rules} |"""


def machine_scan(machine, tools, program, folder):
    path = machines.recording(machine, machines.PROFILED)
    parts = machines.parts_of(path)
    profile = folder / "profile"
    counted(profile, tools / "rung-bench-scan", program, path, 0, parts)
    return sum(cost for name, cost in self_costs(profile).items() if name and name.endswith(program.name)) / parts


def of_machine(tools, machine, folder):
    program = folder / "program.so"

    def scan(name):
        run(tools / "rung-bench-passes", program, name, "rung.toml", cwd=machines.ROOT / "examples" / machine)
        return machine_scan(machine, tools, program, folder)
    return scan


def of_real(tools, files, folder):
    program, reference = folder / "program.so", folder / "straight.so"
    real.build_straight(files, reference)

    def scan(name):
        run(tools / "rung-bench-passes", program, name, *files)
        return real.instructions(tools, program, reference, real.RANDOM, "ours")[0]
    return scan


def measured(scan):
    """Instructions, by the pass that is left out."""
    return {name: round(scan(name)) for name in (ALL, *PASSES)}


def measure(tools):
    with tempfile.TemporaryDirectory() as made:
        folder = Path(made)
        rows = {machine: measured(of_machine(tools, machine, folder)) for machine in machines.MACHINES}
        rows.update({name: measured(of_real(tools, files, folder)) for name, files in real.extracted(folder).items()})
    return rows


def text_of(rows):
    lines = [HEAD.format(titles=" | ".join(f"without {name}" for name in PASSES), rules=" | ".join("---" for _ in PASSES))]
    for name, row in rows.items():
        cells = [f"{row[each]:,} ({row[each] - row[ALL]:+,})" for each in PASSES]
        lines.append(f"| {name} | {row[ALL]:,} | {' | '.join(cells)} |")
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    print(text_of(measure(Path(sys.argv[1]))), end="")
