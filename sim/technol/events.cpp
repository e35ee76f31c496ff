// Event procedures (see events.h).
#include "sim/technol/events.h"

#include "rtlib/nc/control/technol/cells.h"
#include "rtlib/nc/control/technol/operation.h"
#include "rtlib/text/letters.h"

namespace rung::sim::technol {
namespace {

using nc::technol::PlcEvent;

constexpr std::string_view kCommand = "PLCCOMMAND";

struct NamedEvent {
  std::string_view name;
  PlcEvent event;
};
constexpr NamedEvent kEvents[] = {
    {"PLCEVENT_STOP_REQ", PlcEvent::StopRequest},
    {"PLCEVENT_STOP_EMERGENCY_REQ", PlcEvent::EmergencyStopRequest},
    {"PLCEVENT_STOP", PlcEvent::Stop},
    {"PLCEVENT_START", PlcEvent::Start},
    {"PLCEVENT_START_REQ", PlcEvent::StartRequest},
};

// A program that is stopped takes no part.
void call(runtime::Instance& instance, std::string_view procedure, uint64_t dr, bool rlo) {
  if (!instance.stopped()) nc::technol::runWith(instance, procedure, dr, rlo);
}

// CODE=n or the name of a constant, STATE=1 pressed, 0 released.
std::string command(runtime::Instance& instance, std::span<const NcArgument> keys, const ConstantOf& constantOf) {
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
  call(instance, "_ON_CMD", commandRegister(*code), *state == 1);
  return {};
}

} // namespace

std::vector<std::string_view> programEvents() {
  std::vector<std::string_view> names{kCommand};
  for (const NamedEvent& named : kEvents) names.push_back(named.name);
  return names;
}

std::optional<std::string> callEvent(runtime::Instance& instance, std::string_view name,
                                     std::span<const NcArgument> keys, const ConstantOf& constantOf) {
  if (text::equalsIgnoringCase(name, kCommand)) return command(instance, keys, constantOf);
  for (const NamedEvent& named : kEvents) {
    if (!text::equalsIgnoringCase(name, named.name)) continue;
    // The procedure may set it again, and the start waits (man. l.6463-6467).
    if (named.event == PlcEvent::StartRequest)
      if (const auto suspend = nc::technol::signalPlace(instance.program(), "START_SUSPEND"))
        runtime::writeRaw(instance.memory(), *suspend, 0);
    call(instance, "_ON_EVENT", static_cast<uint64_t>(named.event), false);
    return std::string();
  }
  return std::nullopt;
}

} // namespace rung::sim::technol
