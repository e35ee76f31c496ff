// The analogue outputs of a TECHNOL program as pins of a host.
#pragma once
#include "rung/program.h"
#include "tools/mapping/file.h"

namespace rung::host_devices {

// analog-out-1 to analog-out-16, floats: SU_OUT_PLC, 1 is 10 V (man. l.14639). For a program with instructions of
// analogue outputs, and where the map has no pin of that name.
void addAnalogPins(mapping::File& map, const rung_program& program);

} // namespace rung::host_devices
