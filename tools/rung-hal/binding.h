// The entries of a mapping file with their names looked up in a program: plain places, ready for the scan.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "rtlib/host/instance.h"
#include "rtlib/nc/control/control.h"
#include "tools/rung-hal/map_file.h"

namespace rung::hal {

struct PinLink {
  uint32_t pin = 0; // in MapFile::pins
  PinType type = PinType::Bit;
  host::Ref place;
  double scale = 1; // float: the program's units in one of HAL's
};

struct ConstLink {
  PinType type = PinType::Bit;
  host::Ref place;
  double value = 0;
};

struct Binding {
  std::vector<PinLink> inputs;
  std::vector<PinLink> outputs;
  std::vector<ConstLink> constants;
};

// Every name that does not exist or does not suit its entry is one text in `errors`, "PATH:LINE:COLUMN: what is wrong";
// so are functions that the control does not hand over.
Binding bindMap(const MapFile& map, const host::Instance& instance, nc::Control& control,
                std::vector<std::string>& errors);

} // namespace rung::hal
