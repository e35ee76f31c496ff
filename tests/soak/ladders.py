"""The same bit logic for ClassicLadder and for GSK: rungs of three contacts and a coil, the first ten with an output."""
import random
from pathlib import Path

INPUTS, OUTPUTS, ROWS, COLUMNS = 256, 10, 6, 10
OPEN, CLOSED, LINE, COIL = 1, 2, 9, 50  # elements of ClassicLadder
BIT, OUTPUT = 0, 60  # its variables %B and %Q
TEMPLATE = Path("/usr/share/doc/linuxcnc/examples/sample-configs/common/configurable_options/ladder/blank.clp")


def logic(rungs, seed=1):
    """Of each rung its contacts: numbers of bits before its coil, and whether they are open at rest."""
    draw = random.Random(seed)
    return [[(draw.randrange(INPUTS + rung), draw.random() < 0.5) for _ in range(3)] for rung in range(rungs)]


def gsk(rungs):
    def bit(number):
        return f"R{number // 8}.{number % 8}"

    lines = ["dialect gsk", "FUNC END1"]
    for rung, contacts in enumerate(logic(rungs)):
        for (at_rest, other), (number, is_open) in zip((("LD", "LDI"), ("AND", "ANI"), ("AND", "ANI")), contacts):
            lines.append(f"{at_rest if is_open else other:4} {bit(number)}")
        lines.append(f"OUT  {bit(INPUTS + rung)}")
        if rung < OUTPUTS:
            lines.append(f"OUT  Y0.{rung}" if rung < 8 else f"OUT  Y1.{rung - 8}")
    return "\n".join([*lines, "FUNC END2"]) + "\n"


def classic_rung(rung, contacts, last):
    def row(elements):
        return " , ".join(f"{kind}-0-{variable}/{number}" for kind, variable, number in elements)

    nothing = [(0, 0, 0)] * COLUMNS
    lines = [(LINE, 0, 0)] * (COLUMNS - 4)
    elements = [(OPEN if is_open else CLOSED, BIT, number) for number, is_open in contacts]
    rows = [row([*elements, *lines, (COIL, BIT, INPUTS + rung)])]
    if rung < OUTPUTS:  # a second coil below the first
        second = [(0, 0, 0)] * (COLUMNS - 1) + [(COIL, OUTPUT, rung)]
        rows.append(row(second).replace(f"{COIL}-0-", f"{COIL}-1-"))
    rows += [row(nothing)] * (ROWS - len(rows))
    head = ["#VER=2.0", "#LABEL=", "#COMMENT=", f"#PREVRUNG={rung - 1}", f"#NEXTRUNG={-1 if rung == last else rung + 1}"]
    return "\n".join([f"_FILE-rung_{rung}.csv", *head, *rows, f"_/FILE-rung_{rung}.csv"])


def classic_ladder(rungs):
    text = TEMPLATE.read_text(encoding="latin-1")
    begin, end = text.index("_FILE-rung_0.csv"), text.index("_/FILE-rung_0.csv") + len("_/FILE-rung_0.csv")
    all_rungs = "\n".join(classic_rung(rung, contacts, rungs - 1) for rung, contacts in enumerate(logic(rungs)))
    text = (text[:begin] + all_rungs + text[end:]).replace("000,0,-1,0,0,0", f"000,0,-1,0,{rungs - 1},0")
    return text.replace("NBR_RUNGS=100", f"NBR_RUNGS={rungs}").replace("NBR_BITS=500", f"NBR_BITS={INPUTS + rungs}")
