// Answers that come later (see late_answers.h).
#include "sim/technol/late_answers.h"

#include <algorithm>
#include <string>

#include "rtlib/load/program_info.h"
#include "rtlib/nc/control/technol/cells.h"

namespace rung::sim::technol {
namespace {

using nc::technol::writeCell;

constexpr int64_t kDriveAnswer = 0x580; // object of the answer (man. l.9203)
constexpr uint64_t kPacketBytes = 8;

// Bits are named X, Y, Z and by the numbers from 4 on (man. l.6243, l.6347).
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
  std::string_view service = runtime::serviceName(instance.program(), request.service);
  service = service.substr(0, service.find(' '));
  constexpr int64_t kMostAxes = 16;
  const auto isAxis = [](int64_t axis) { return axis >= 1 && axis <= kMostAxes; };
  if (service == "SPI_AX" && isAxis(request.args[4])) positioned(instance, request.args[4]);
  if (service == "CAN_AX_SEND" && isAxis(request.args[0])) driveAnswered(instance, request.args[0], bytes);
}

} // namespace rung::sim::technol
