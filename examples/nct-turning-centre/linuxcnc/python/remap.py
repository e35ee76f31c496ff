"""Codes of the part program that the PLC program carries out."""
import json
import os

from interpreter import INTERP_OK

ADDED = 200  # to the number of an M function that LinuxCNC itself has: M251 is the machine's M51
SHARED = range(500, 1000)  # variables that the PLC program may ask for
PUBLISHED = "variables.json"


def publish(params):
    """LinuxCNC gives nobody its variables while a part program runs: rung-services finds them in this file."""
    values = {str(number): params[number] for number in SHARED if params[number] != 0}
    with open(PUBLISHED + ".new", "w", encoding="ascii") as file:
        json.dump(values, file)
    os.replace(PUBLISHED + ".new", PUBLISHED)


def plc_code(self, **_words):
    """The number of the M function that is carried out, for subroutines/plc_m.ngc."""
    name = self.blocks[self.remap_level].executing_remap.name
    self.params["code"] = int(name[1:]) % ADDED
    if self.task:
        publish(self.params)
    return INTERP_OK
