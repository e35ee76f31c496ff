"""Codes of the part program that the PLC program executes."""
from interpreter import INTERP_OK

ADDED = 200  # to the number of an M function that LinuxCNC itself uses: M250 is the machine's M50


def plc_code(self, **_words):
    """The number of the M function to execute, for subroutines/plc_m.ngc."""
    name = self.blocks[self.remap_level].executing_remap.name
    self.params["code"] = int(name[1:]) % ADDED
    return INTERP_OK
