"""Instructions a scan of TECHNOL programs with the services of devices: at work, at rest, and without them. The simulated
control answers; what it does itself, devices and answers, is counted apart."""
import tempfile
from pathlib import Path

from callgrind import TARGET, Failure, counted, inclusive_cost, run, self_costs

HERE = Path(__file__).resolve().parent / "services"
SCANS = 100
MOST_AT_REST = 200  # instructions that all services together may add to a scan while none is used

SERVICES = {"can": "32 CAN units: an item of each read, a packet to each sent",
            "positions": "6 positioning units: POS_CONTROL of each",
            "serial": "4 serial ports: 4 characters of each read, one sent, the state",
            "ethercat": "8 EtherCAT slaves: an object of each read in every other scan"}
WITHOUT, ALL = "without services", "all of them"
# Where the runtime enters the simulation; none calls another one.
SIMULATION = ("rung::sim::SimulatedNc::respond(", "rung::sim::technol::SimulatedDevices::beforeInput(",
              "rung::sim::technol::Exchange::onHook(")
HEAD = f"""## Instructions of TECHNOL's device services

Counted by callgrind, exactly, as above: programs of tools/bench/services, whose devices are simulated; a scan is the average of {SCANS}. "At rest": the mechanisms that use a service are in the
program and not started. "At work": what the line says is done in every scan, where it does not name another number. What simulated devices do and how they answer is not the program's, it is in the last column.
"""


def build(tools, folder, services):
    program = Path(folder) / f"{'-'.join(services) or 'base'}.so"
    run(tools / "rungc", "build", "--no-project", "--target", TARGET, "-o", program,
        *(HERE / f"{name}.plc" for name in ("base", *services)))
    return program


def count(tools, program, scenario, seen):
    """Instructions a scan: of the program's code, of that and the runtime, of the simulation. `seen`: its functions."""
    profile = program.with_suffix(".profile")
    counted(profile, tools / "rung-bench-services", program, HERE / scenario, SCANS)
    costs = self_costs(profile)
    simulation, found = inclusive_cost(profile, SIMULATION)
    seen.update(found)
    rungs = sum(cost for name, cost in costs.items() if name and name.endswith(program.name))
    return tuple(round(each / SCANS) for each in (rungs, sum(costs.values()) - simulation, simulation))


def measure(tools):
    """By name: those three numbers."""
    seen = set()
    with tempfile.TemporaryDirectory() as folder:
        rows = {WITHOUT: count(tools, build(tools, folder, ()), "idle.scn", seen)}
        for names, title, scenario in [*(((name,), title, f"{name}.scn") for name, title in SERVICES.items()),
                                       (tuple(SERVICES), ALL, "all.scn")]:
            program = build(tools, folder, names)
            rows[f"{title}; at rest"] = count(tools, program, "idle.scn", seen)
            rows[f"{title}; at work"] = count(tools, program, scenario, seen)
    if seen != set(SIMULATION):
        raise Failure(f"services.py: the simulation has no function {', '.join(set(SIMULATION) - seen)}")
    return rows


def names_of(rows):
    return {f"technol-services, {name}": total for name, (_, total, _) in rows.items()}


def excess(rows):
    """"" or what is wrong with services at rest."""
    more = rows[f"{ALL}; at rest"][1] - rows[WITHOUT][1]
    return f"services at rest add {more} instructions to a scan, at most {MOST_AT_REST} are allowed" if more > MOST_AT_REST else ""


def text_of(rows):
    lines = [HEAD, "| services | compiled rungs | around them | instructions a scan | more than without | simulated devices |",
             "|" + " --- |" * 6]
    without = rows[WITHOUT][1]
    for name, (rungs, total, simulation) in rows.items():
        lines.append(f"| {name} | {rungs:,} | {total - rungs:,} | {total:,} | {total - without:,} | {simulation:,} |")
    return "\n".join(lines) + "\n"
