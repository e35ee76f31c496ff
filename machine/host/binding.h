// The entries of a mapping file with their names looked up in a program, ready to be bound to the program's cells.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "machine/host/mapping_file.h"
#include "rung/runtime.h"

namespace rung::host {

struct PinLink {
  uint32_t pin = 0; // index into File::pins; the first of `bits`
  PinType type = PinType::Bit;
  Direction direction = Direction::In;
  std::string name;
  double scale = 1;            // float: program units per HAL unit
  bool words = false;          // the name is a real stored in words
  std::vector<uint32_t> bits;  // pins of the cell's bits, lowest first; the cell is of type U32 then
  std::optional<double> value; // initial value of a parameter
};

struct ConstLink {
  PinType type = PinType::Bit;
  std::string name;
  double value = 0;
  bool words = false;
};

struct Binding {
  std::vector<PinLink> links;
  std::vector<ConstLink> constants;
  std::vector<std::string> warnings; // formatted as `errors`: entries that work, but probably not as intended
};

// Looks up all names. Every name that does not exist or does not suit its entry is one text in `errors`,
// "PATH:LINE:COLUMN: what is wrong"; so are functions that the control does not support. `program`: the tables of the
// instance's image.
Binding bindMap(const File& map, rung_instance* instance, const rung_program& program,
                std::vector<std::string>& errors);

// The same for the new program of a replacement, whose tables are `program`. Entries that concern the control are
// skipped, because the control does not change.
Binding bindMap(const File& map, rung_instance* instance, const rung_replacement* replacement,
                const rung_program& program, std::vector<std::string>& errors);

} // namespace rung::host
