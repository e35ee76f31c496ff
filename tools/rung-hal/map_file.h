// The mapping file: which HAL pins there are, and which names of the PLC program they refer to. It is TOML;
// docs/linuxcnc.md describes its tables. This is the file alone; binding.h looks the names up in a program.
#pragma once
#include <compare>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rung/runtime.h"

namespace rung::hal {

enum class PinType : uint8_t { Bit, S32, U32, Float };

inline constexpr std::string_view kFunctionKinds[] = {"M", "S", "T", "B"}; // by rung_function_kind

// Both from 1; columns count characters.
struct MapPosition {
  uint32_t line = 1;
  uint32_t column = 1;
  auto operator<=>(const MapPosition&) const = default;
};

// A HAL pin to make. A pin that the file names in several places is made once.
struct MapPin {
  std::string name;
  PinType type = PinType::Bit;
  bool output = false; // PLC -> HAL
  MapPosition at;      // the first of these places
};

// in, out: the pin and the name are the same quantity.
struct MapLink {
  uint32_t pin = 0; // in MapFile::pins
  std::string name;
  double scale = 1; // float: the program's units in one of HAL's; not 0, finite
  MapPosition at;   // of the name
};

// true and false are bits; integers are S32 where they are negative and U32 otherwise.
struct MapConst {
  PinType type = PinType::Bit;
  std::string name;
  double value = 0; // holds every 32-bit integer exactly; finite
  MapPosition at;
};

// A pin at a level that it has not had before.
struct MapEdge {
  uint32_t pin = 0; // in MapFile::pins
  bool rising = true;
};

// send: an edge of a pin hands a function to the program.
struct MapSend {
  MapEdge edge;
  rung_function_kind kind = RUNG_FUNCTION_M;
  uint32_t channel = 0; // of the control, from 0; the map counts from 1
  int32_t code = 0;
  std::optional<uint32_t> codePin; // instead of `code`
  std::optional<uint32_t> donePin;
  MapPosition at;
};

// m-groups: the group that the machine has an M function in.
struct MapGroup {
  uint32_t code = 0;
  uint32_t group = 0;
  MapPosition at; // of the code
};

// Everything in the order of the file.
struct MapFile {
  std::string path; // for messages
  std::vector<MapPin> pins;
  std::vector<MapLink> inputs;
  std::vector<MapLink> outputs;
  std::vector<MapConst> constants;
  std::vector<MapSend> sends;
  std::vector<MapGroup> groups;
  std::vector<MapEdge> aborts;          // reset, emergency stop: every function ends
  int64_t timeoutNs = 0;                // of a function; 0: none
  std::optional<MapPosition> highSpeed; // where the high-speed handshake is asked for

  // "PATH:LINE:COLUMN: what"
  std::string message(MapPosition at, std::string_view what) const;
};

// Every mistake is one entry of `errors`, PATH:LINE:COLUMN with what was found, what was expected and how to fix it, in
// the order of the file; the entries without mistakes are in the result. Where the text is not TOML, nothing is in it,
// and there is one error, the first of its syntax.
MapFile parseMap(std::string_view text, std::string path, std::vector<std::string>& errors);

std::string_view pinTypeName(PinType type);

} // namespace rung::hal
