"""Instructions per scan of TECHNOL programs with device services: in use, idle, and without them. The simulated control
answers; its own work, devices and answers, is counted separately."""
import tempfile
from pathlib import Path

from callgrind import TARGET, Failure, counted, inclusive_cost, run, self_costs

HERE = Path(__file__).resolve().parent / "services"
SCANS = 100
MOST_IDLE = 200  # instructions that all services together may add to a scan in which none is used

SERVICES = {"can": "32 CAN units: from each an item read, to each a packet sent",
            "positions": "6 positioning units: POS_CONTROL for each",
            "serial": "4 serial ports: on each 4 characters read, one sent, the state read",
            "ethercat": "8 EtherCAT slaves: from each an object read in every other scan"}
WITHOUT, ALL = "without services", "all services"
# Where the runtime enters the simulation; none calls another one.
SIMULATION = ("rung::sim::SimulatedNc::respond(", "rung::sim::technol::SimulatedDevices::beforeInput(",
              "rung::sim::technol::Exchange::onHook(")
HEAD = f"""## Instructions of TECHNOL's device services

Exact counts by callgrind, as above: programs of tools/bench/services, whose devices are simulated;
a scan is the average of {SCANS}. "Idle": the mechanisms that use a service are in the program but
not started. "In use": each scan does what the row says, unless the row names another rate. The last
column is the cost of the simulated devices and their answers; no other column includes it.
"""


def build(tools, folder, services):
    program = Path(folder) / f"{'-'.join(services) or 'base'}.so"
    run(tools / "rungc", "build", "--no-project", "--target", TARGET, "-o", program,
        *(HERE / f"{name}.plc" for name in ("base", *services)))
    return program


def count(tools, program, scenario, seen):
    """Instructions per scan: of the program's code, of that and the runtime, of the simulation. `seen`: its functions."""
    profile = program.with_suffix(".profile")
    counted(profile, tools / "rung-bench-services", program, HERE / scenario, SCANS)
    costs = self_costs(profile)
    simulation, found = inclusive_cost(profile, SIMULATION)
    seen.update(found)
    rungs = sum(cost for name, cost in costs.items() if name and name.endswith(program.name))
    return tuple(round(each / SCANS) for each in (rungs, sum(costs.values()) - simulation, simulation))


def measure(tools):
    """By name: the three numbers of `count`."""
    seen = set()
    with tempfile.TemporaryDirectory() as folder:
        rows = {WITHOUT: count(tools, build(tools, folder, ()), "idle.scn", seen)}
        for names, title, scenario in [*(((name,), title, f"{name}.scn") for name, title in SERVICES.items()),
                                       (tuple(SERVICES), ALL, "all.scn")]:
            program = build(tools, folder, names)
            rows[f"{title}; idle"] = count(tools, program, "idle.scn", seen)
            rows[f"{title}; in use"] = count(tools, program, scenario, seen)
    if seen != set(SIMULATION):
        raise Failure(f"services.py: the simulation has no function {', '.join(set(SIMULATION) - seen)}")
    return rows


def names_of(rows):
    return {f"technol-services, {name}": total for name, (_, total, _) in rows.items()}


def excess(rows):
    """"" or what is wrong with idle services."""
    more = rows[f"{ALL}; idle"][1] - rows[WITHOUT][1]
    return f"idle services add {more} instructions to a scan; at most {MOST_IDLE} are allowed" if more > MOST_IDLE else ""


def text_of(rows):
    lines = [HEAD, "| services | compiled rungs | runtime | instructions per scan | more than without services | simulated devices |",
             "|" + " --- |" * 6]
    without = rows[WITHOUT][1]
    for name, (rungs, total, simulation) in rows.items():
        lines.append(f"| {name} | {rungs:,} | {total - rungs:,} | {total:,} | {total - without:,} | {simulation:,} |")
    return "\n".join(lines) + "\n"
