// See component_pins.h.
#include "machine/host/component_pins.h"

#include <algorithm>
#include <iterator>

#include "machine/host/mapping_file.h"

namespace rung::host {

bool isOwnPin(std::string_view name) {
  return std::ranges::find(kOwnPins, name, &OwnPinRow::name) != std::end(kOwnPins);
}

void checkPinNames(const File& map, std::vector<std::string>& errors) {
  for (const Pin& pin : map.pins) {
    const std::string where = std::string(tableName(pin.direction)) + "." + pin.name + ": ";
    if (isOwnPin(pin.name))
      errors.push_back(map.message(pin.at, where + Mistake{"a pin that rung_hal makes for every program",
                                                           "another name", "write for example " + pin.name + "-plc"}
                                                       .text()));
    else if (pin.name.size() > kLongestPinName)
      errors.push_back(map.message(pin.at, where + Mistake{std::to_string(pin.name.size()) + " characters",
                                                           std::to_string(kLongestPinName) + " at most, what HAL takes",
                                                           "shorten the name"}
                                                       .text()));
  }
}

} // namespace rung::host
