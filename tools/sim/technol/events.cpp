// Event procedures (see events.h).
#include "tools/sim/technol/events.h"

#include "rtlib/nc/control/technol/cells.h"
#include "rtlib/text/letters.h"

namespace rung::sim::technol {
namespace {

struct PlcEvent {
  std::string_view name;
  uint64_t code; // man. l.1638-1644
};
constexpr PlcEvent kStartRequest{"PLCEVENT_START_REQ", 5};
constexpr PlcEvent kEvents[] = {
    {"PLCEVENT_STOP_REQ", 1},
    {"PLCEVENT_STOP_EMERGENCY_REQ", 2},
    {"PLCEVENT_STOP", 3},
    {"PLCEVENT_START", 4},
    kStartRequest,
};

// A program that stands takes no part.
void call(host::Instance& instance, std::string_view procedure, uint64_t dr, bool rlo) {
  if (!instance.stopped()) nc::technol::runWith(instance, procedure, dr, rlo);
}

// CODE=n or the name of a constant, STATE=1 pressed, 0 released.
std::string command(host::Instance& instance, std::span<const NcArgument> keys, const ConstantOf& constantOf) {
  std::optional<int64_t> code, state;
  for (const NcArgument& key : keys) {
    const bool isCode = text::equalsIgnoringCase(key.key, "CODE");
    if (!isCode && !text::equalsIgnoringCase(key.key, "STATE")) return "PLCCOMMAND has no '" + key.key + "'";
    std::optional<int64_t>& value = isCode ? code : state;
    value = key.isText && isCode ? constantOf(key.text) : key.integer;
    if (!value) return "unknown constant '" + key.text + "'";
    if (key.isReal || (key.isText && !isCode)) return "'" + key.key + "' takes a number";
  }
  if (!code) return "PLCCOMMAND needs CODE=n";
  if (!state || (*state != 0 && *state != 1)) return "PLCCOMMAND needs STATE=1 (pressed) or 0 (released)";
  call(instance, "_ON_CMD", static_cast<uint64_t>(static_cast<int64_t>(static_cast<int32_t>(*code))), *state == 1);
  return {};
}

} // namespace

std::optional<std::string> callEvent(host::Instance& instance, std::string_view name, std::span<const NcArgument> keys,
                                     const ConstantOf& constantOf) {
  if (text::equalsIgnoringCase(name, "PLCCOMMAND")) return command(instance, keys, constantOf);
  for (const PlcEvent& event : kEvents) {
    if (!text::equalsIgnoringCase(name, event.name)) continue;
    // The procedure may set it again, and the start waits (man. l.6463-6467).
    if (event.code == kStartRequest.code)
      if (const auto suspend = nc::technol::signalPlace(instance.program(), "START_SUSPEND"))
        host::writeRaw(instance.memory(), *suspend, 0);
    call(instance, "_ON_EVENT", event.code, false);
    return std::string();
  }
  return std::nullopt;
}

} // namespace rung::sim::technol
