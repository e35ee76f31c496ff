// The analogue outputs of a TECHNOL program as pins of a host.
#pragma once
#include "machine/host/mapping_file.h"
#include "rung/program.h"

namespace rung::io {

// analog-out-1 to analog-out-16, floats: SU_OUT_PLC, 1 is 10 V (man. l.14639). For a program with instructions of
// analogue outputs, and where the map has no pin of that name.
void addAnalogPins(host::File& map, const rung_program& program);

} // namespace rung::io
