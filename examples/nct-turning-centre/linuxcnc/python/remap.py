"""Codes of the part program that the PLC program executes."""
import json
import os

from interpreter import INTERP_OK

ADDED = 200  # to the number of an M function that LinuxCNC itself uses: M251 is the machine's M51
SHARED = range(500, 1000)  # variables that the PLC program may request
PUBLISHED = "variables.json"


def publish(params):
    """LinuxCNC does not give out its variables while a part program runs: rung-services reads them in this file."""
    values = {str(number): params[number] for number in SHARED if params[number] != 0}
    with open(PUBLISHED + ".new", "w", encoding="ascii") as file:
        json.dump(values, file)
    os.replace(PUBLISHED + ".new", PUBLISHED)


def plc_code(self, **_words):
    """The number of the M function to execute, for subroutines/plc_m.ngc."""
    name = self.blocks[self.remap_level].executing_remap.name
    self.params["code"] = int(name[1:]) % ADDED
    if self.task:
        publish(self.params)
    return INTERP_OK
