"""Programs that write the number of their scan into all of their retained memory, one of each dialect."""
from dataclasses import dataclass


@dataclass(frozen=True)
class Program:
    dialect: str
    text: str
    cells: list      # names of all that it writes, in this order
    bits: int        # of each
    period: float    # seconds between two scans
    interval: float  # seconds between two looks of the saver at what has changed


def doubling(first, size, copy):
    """Fills `size` bytes from the first few on: copy(count, to)."""
    lines = []
    while first < size:
        lines.append(copy(min(first, size - first), first))
        first *= 2
    return "\n".join(lines)


# D, then the values of C, then K; presets (the rest of C, and T) are not the program's.
def gsk():
    move = "LD   R99.0\nFUNC MOVN\nPRM  {}\nPRM  {}\nPRM  {}".format
    chunks = [(to, min(200, 1860 - to)) for to in range(200, 1860, 200)]
    lines = ["dialect gsk", "FUNC END1", "LDI  R99.7\nOUT  R99.0",
             "LD   R99.7\nLD   R99.0\nFUNC ADDB\nPRM  2\nPRM  D0\nPRM  1\nPRM  D0\nOUT  R99.6",
             doubling(2, 200, lambda count, to: move(count, "D0", f"D{to}")),
             *(move(count, "D0", f"D{to}") for to, count in chunks),
             *(move(2, "D0", f"C{to}") for to in range(2, 400, 4)), move(32, "D0", "K0"), "FUNC END2"]
    cells = [*(f"D{i}:2" for i in range(0, 1860, 2)), *(f"C{i}:2" for i in range(2, 400, 4)),
             *(f"K{i}:2" for i in range(0, 32, 2))]
    return Program("gsk", "\n".join(lines) + "\n", cells, 16, 0.008, 0.2)


# D, then the values of C, then the keep relays of the user; T and presets are not the program's.
def fanuc():
    move = "RD R99.0\nMOVN\n{}\n{}\n{}".format
    size, keep = 10000, 20
    lines = ["%@0\n4 0i-F PMC(MEM-B)\n%\n%@3\nEND1", "RD.NOT R99.7\nWRT R99.0",
             "RD R99.7\nRD.STK R99.0\nADDB\n2\nD0\n1\nD0\nWRT R99.6",
             doubling(2, size, lambda count, to: move(count, "D0", f"D{to}")),
             *(move(2, "D0", f"C{to}") for to in range(2, 400, 4)), move(keep, "D0", "K0"), "END2\nEND\n%"]
    cells = [*(f"D{i}:2" for i in range(0, size, 2)), *(f"C{i}:2" for i in range(2, 400, 4)), *(f"K{i}:2" for i in range(0, keep, 2))]
    return Program("fanuc", "\n".join(lines) + "\n", cells, 16, 0.008, 0.2)


# 1024 words, over several time slices of MAIN.
def nct():
    rungs = ["|--[N_ON]--{ADD 4000 4000 #1}"] + [f"|--[N_ON]--{{MOV {word} 4000}}" for word in range(4001, 5024)]
    text = "dialect nct\nmodule MAIN\n" + "".join(f"\nrung\n{rung}\n" for rung in [*rungs, "|--{END}"])
    return Program("nct", text, [f"{word:04}" for word in range(4000, 5024)], 32, 0.010, 0.2)


# 10,000 bytes; it asks again and again for them to be saved.
def technol():
    fill = doubling(4, 10000, lambda count, to: f"        MV   PLC_MEM_BACKUP,PLC_MEM_BACKUP+{to},{count}")
    modules = "".join(f"MODULE_{name}\nMODULE_{name}_END\n" for name in
                      ("INPUT", "BLOCK_INIT", "BLOCK_DONE", "INIT", "CLEAR", "HALT"))
    text = (f"DATA\nDATA_END\n{modules}MODULE_MAIN\n        LOD  DWRD.PLC_MEM_BACKUP\n        AD   CNST.1\n"
            f"        STO  DWRD.PLC_MEM_BACKUP\n{fill}\n        FL   1,REQ_BACKUP_MEM\nMODULE_MAIN_END\nSTOP\n")
    return Program("technol", text, [f"PLC_MEM_BACKUP+{i}:4" for i in range(0, 10000, 4)], 32, 0.020, 0.005)


SUFFIX = {"fanuc": ".mne", "gsk": ".pmc", "nct": ".lad", "technol": ".plc"}
ALL = (fanuc, gsk, nct, technol)
