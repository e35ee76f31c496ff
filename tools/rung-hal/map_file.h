// The mapping file: which HAL pins there are, and which names of the PLC program they refer to. docs/linuxcnc.md
// describes the lines. This is the text alone; binding.h looks the names up in a program.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rtlib/nc/control/functions.h"

namespace rung::hal {

enum class PinType : uint8_t { Bit, S32, U32, Float };

// A HAL pin to make. A pin that several lines mention is made once.
struct MapPin {
  std::string name;
  PinType type = PinType::Bit;
  bool output = false; // PLC -> HAL
};

// in, out: the pin and the name are the same quantity.
struct MapLink {
  uint32_t pin = 0; // in MapFile::pins
  std::string name;
  double scale = 1; // float: the program's units in one of HAL's
  uint32_t line = 0;
};

struct MapConst {
  PinType type = PinType::Bit;
  std::string name;
  double value = 0; // holds every 32-bit integer exactly
  uint32_t line = 0;
};

// A pin at a level that it has not had before.
struct MapEdge {
  uint32_t pin = 0; // in MapFile::pins
  bool rising = true;
};

// send: an edge of a pin hands a function to the program.
struct MapSend {
  MapEdge edge;
  nc::FunctionKind kind = nc::FunctionKind::M;
  uint32_t channel = 0; // of the control, from 0; the map counts from 1
  int32_t code = 0;
  std::optional<uint32_t> codePin; // instead of `code`
  std::optional<uint32_t> donePin;
  uint32_t line = 0;
};

struct MapFile {
  std::string path; // for messages
  std::vector<MapPin> pins;
  std::vector<MapLink> inputs;
  std::vector<MapLink> outputs;
  std::vector<MapConst> constants;
  std::vector<MapSend> sends;
  std::vector<MapEdge> aborts; // reset, emergency stop: every function ends
  int64_t timeoutNs = 0;       // of a function; 0: none
  uint32_t highSpeedLine = 0;  // where the high-speed handshake is asked for; 0: nowhere
};

// Every mistake is one entry of `errors`, "PATH:LINE: what is wrong"; the lines without mistakes are in the result.
MapFile parseMap(std::string_view text, std::string path, std::vector<std::string>& errors);

std::string_view pinTypeName(PinType type);

} // namespace rung::hal
