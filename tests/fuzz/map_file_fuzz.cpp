// libFuzzer target: any bytes as a mapping file of LinuxCNC's component. What is taken is ready to bind, every mistake
// has its place.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "ir/support/check.h"
#include "tools/rung-hal/map_file.h"

namespace {

using namespace rung::hal;

// Takes a number and what follows it off the text; false: they are not there.
bool skipNumber(std::string_view& text, char after) {
  const size_t digits = std::min(text.find_first_not_of("0123456789"), text.size());
  if (digits == 0 || text[0] == '0' || digits == text.size() || text[digits] != after) return false;
  text.remove_prefix(digits + 1);
  return true;
}

void checkError(std::string_view error) {
  RUNG_CHECK(error.starts_with("f.map:"), "an error names the file");
  error.remove_prefix(6);
  RUNG_CHECK(skipNumber(error, ':') && skipNumber(error, ':'), "an error has a line and a column");
  RUNG_CHECK(error.size() > 1 && error[0] == ' ', "an error says what is wrong");
}

void checkPlace(const MapPosition& at) { RUNG_CHECK(at.line > 0 && at.column > 0, "an entry has a place"); }

void checkMap(const MapFile& map) {
  std::set<std::string_view> names;
  for (const MapPin& pin : map.pins) {
    RUNG_CHECK(!pin.name.empty() && names.insert(pin.name).second, "a pin is made once");
    checkPlace(pin.at);
  }
  const auto pin = [&](uint32_t number) -> const MapPin& {
    RUNG_CHECK(number < map.pins.size(), "an entry's pin is there");
    return map.pins[number];
  };
  for (const auto* links : {&map.inputs, &map.outputs})
    for (const MapLink& link : *links) {
      RUNG_CHECK(pin(link.pin).output == (links == &map.outputs), "a pin has the direction of its entry");
      RUNG_CHECK(std::isfinite(link.scale) && link.scale != 0, "a scale can be divided by");
      RUNG_CHECK(!link.name.empty(), "an entry names a place");
      checkPlace(link.at);
    }
  for (const MapConst& constant : map.constants) {
    RUNG_CHECK(!constant.name.empty() && std::isfinite(constant.value), "a constant has a name and a value");
    checkPlace(constant.at);
  }
  const auto checkEdge = [&](const MapEdge& edge) {
    RUNG_CHECK(!pin(edge.pin).output && pin(edge.pin).type == PinType::Bit, "an edge is of an input bit");
  };
  for (const MapSend& send : map.sends) {
    checkEdge(send.edge);
    if (send.codePin) RUNG_CHECK(!pin(*send.codePin).output, "the code comes from HAL");
    if (send.donePin) RUNG_CHECK(pin(*send.donePin).output, "the answer goes to HAL");
    checkPlace(send.at);
  }
  for (const MapEdge& edge : map.aborts) checkEdge(edge);
  RUNG_CHECK(map.timeoutNs >= 0, "a time is not negative");
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  std::vector<std::string> errors;
  checkMap(parseMap({reinterpret_cast<const char*>(data), size}, "f.map", errors));
  for (const std::string& error : errors) checkError(error);
  return 0;
}
