// The pins that LinuxCNC's component (machine/rung-hal) creates for every program besides those of the map, and HAL's
// rules for pin names.
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
  PowerOff, // begins the regular power-off of the program, while its pins are still connected
  PoweredOff,
  Serving, // a client answers the program's requests and sends signs of life
  MaxTime, // maximum time of the program in one call, in microseconds; 0: only its budgets apply
};

struct OwnPinRow {
  std::string_view name;
  PinType type;
  Direction direction; // as in the map: In is written by HAL
};

// Indexed by OwnPin.
inline constexpr OwnPinRow kOwnPins[] = {
    {"fault", PinType::Bit, Direction::Out},          {"fault-line", PinType::U32, Direction::Out},
    {"scans", PinType::U32, Direction::Out},          {"missed", PinType::U32, Direction::Out},
    {"functions-busy", PinType::Bit, Direction::Out}, {"functions-timeout", PinType::Bit, Direction::Out},
    {"functions-lost", PinType::U32, Direction::Out}, {"reset", PinType::Bit, Direction::In},
    {"power-off", PinType::Bit, Direction::In},       {"powered-off", PinType::Bit, Direction::Out},
    {"serving", PinType::Bit, Direction::Out},        {"max-time", PinType::U32, Direction::Parameter},
};

bool isOwnPin(std::string_view name);

// HAL's names have at most 47 characters; the name of a pin follows that of the program and a dot, "rung.".
inline constexpr size_t kLongestPinName = 47 - std::string_view("rung.").size();

// Reports names of pins that the component or HAL does not accept.
void checkPinNames(const File& map, std::vector<std::string>& errors);

} // namespace rung::host
