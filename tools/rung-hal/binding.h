// The entries of a mapping file with their names looked up in a program: what is to be bound to its cells.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "rung/runtime.h"
#include "tools/rung-hal/map_file.h"

namespace rung::hal {

// A value of a pin, or of a constant.
union Value {
  bool bit;
  int32_t s32;
  uint32_t u32;
  double real = 0;
};

struct PinLink {
  uint32_t pin = 0; // in MapFile::pins
  PinType type = PinType::Bit;
  std::string name;
  double scale = 1;   // float: the program's units in one of HAL's
  bool words = false; // the real that words of the program hold
};

struct ConstLink {
  PinType type = PinType::Bit;
  std::string name;
  double value = 0;
  bool words = false;
};

struct Binding {
  std::vector<PinLink> inputs;
  std::vector<PinLink> outputs;
  std::vector<ConstLink> constants;
};

// Every name that does not exist or does not suit its entry is one text in `errors`, "PATH:LINE:COLUMN: what is wrong";
// so are functions that the control does not hand over. `program`: the tables of the instance's image.
Binding bindMap(const MapFile& map, rung_instance* instance, const rung_program& program,
                std::vector<std::string>& errors);

} // namespace rung::hal
