// Event procedures.
#include "sim/technol/events.h"

#include <algorithm>
#include <string>

#include "rtlib/nc/control/technol/cells.h"
#include "rtlib/nc/control/technol/operation.h"
#include "rtlib/nc/technol/services.h"
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

// Calls a procedure, unless the program is stopped.
void call(runtime::Instance& instance, std::string_view procedure, uint64_t dr, bool rlo) {
  if (!instance.stopped()) nc::technol::runWith(instance, procedure, dr, rlo);
}

// Keys: CODE=n or the name of a constant, STATE=1 pressed, 0 released.
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

// Answers that arrive later.

namespace {

using nc::technol::writeCell;

constexpr int64_t kDriveAnswer = 0x580; // object of the answer (man. l.9203)
constexpr uint64_t kPacketBytes = 8;

// Names of bits have X, Y, Z, and numbers from 4 on (man. l.6243, l.6347).
std::string bitOfAxis(std::string_view before, int64_t axis, std::string_view after) {
  constexpr std::string_view kLetters[] = {"X", "Y", "Z"};
  const std::string number = axis <= 3 ? std::string(kLetters[axis - 1]) : std::to_string(axis);
  return std::string(before) + number + std::string(after);
}

void positioned(runtime::Instance& instance, int64_t axis) {
  writeCell(instance, bitOfAxis("POLOHV_", axis, ""), 0);
  writeCell(instance, bitOfAxis("PO_OS", axis, "PI"), 0);
}

void driveAnswered(runtime::Instance& instance, int64_t axis, std::string_view bytes) {
  const std::string packet = "CAN_AX_RECV_PACKET.";
  writeCell(instance, packet + "CAN_ID", static_cast<uint64_t>(kDriveAnswer + axis));
  writeCell(instance, packet + "CAN_RTR", 0);
  writeCell(instance, packet + "CAN_LEN", kPacketBytes);
  for (uint64_t i = 0; i < kPacketBytes; ++i)
    writeCell(instance, packet + (i == 0 ? "CAN_DATA" : "CAN_DATA_" + std::to_string(i)),
              i < bytes.size() ? static_cast<uint8_t>(bytes[i]) : 0u);
  writeCell(instance, "CAN_AX_BUSY", 0);
}

} // namespace

void showLateAnswer(runtime::Instance& instance, const core::ServiceRequest& request, std::string_view bytes) {
  using nc::technol::ServiceKind;
  const auto kind = static_cast<ServiceKind>(request.name->kind);
  constexpr int64_t kMostAxes = 16;
  const auto isAxis = [](int64_t axis) { return axis >= 1 && axis <= kMostAxes; };
  if (kind == ServiceKind::ToAxis && isAxis(request.args[4])) positioned(instance, request.args[4]);
  if (kind == ServiceKind::CanDrive && isAxis(request.args[0])) driveAnswered(instance, request.args[0], bytes);
}

} // namespace rung::sim::technol
