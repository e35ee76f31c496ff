// The pins that LinuxCNC's component makes for every program besides those of the map (machine/rung-hal), and what HAL
// takes as a pin's name.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "machine/host/mapping_file.h"

namespace rung::host {

enum class OwnPin : uint8_t {
  Fault,
  FaultLine,
  Scans,
  Missed,
  FunctionsBusy,
  FunctionsTimeout,
  FunctionsLost,
  Reset,    // restarts the program after a fault
  PowerOff, // its regular end begins, while its pins are those of the machine
  PoweredOff,
  Serving, // somebody answers what the program asks, and lives
  MaxTime, // microseconds that the program may run in one call; 0: its budgets alone count
};

struct OwnPinRow {
  std::string_view name;
  PinType type;
  Direction direction; // as of the map: In is written by HAL
};

// By OwnPin.
inline constexpr OwnPinRow kOwnPins[] = {
    {"fault", PinType::Bit, Direction::Out},          {"fault-line", PinType::U32, Direction::Out},
    {"scans", PinType::U32, Direction::Out},          {"missed", PinType::U32, Direction::Out},
    {"functions-busy", PinType::Bit, Direction::Out}, {"functions-timeout", PinType::Bit, Direction::Out},
    {"functions-lost", PinType::U32, Direction::Out}, {"reset", PinType::Bit, Direction::In},
    {"power-off", PinType::Bit, Direction::In},       {"powered-off", PinType::Bit, Direction::Out},
    {"serving", PinType::Bit, Direction::Out},        {"max-time", PinType::U32, Direction::Parameter},
};

bool isOwnPin(std::string_view name);

// HAL's names have 47 characters, with the program's name and a point before the pin's: "rung.".
inline constexpr size_t kLongestPinName = 47 - std::string_view("rung.").size();

// Names of pins that the component or HAL does not take: each is a mistake.
void checkPinNames(const File& map, std::vector<std::string>& errors);

} // namespace rung::host
