// Sentences about units (see unit_message.h).
#include "tools/devices/can/unit_message.h"

#include "rtlib/text/hex.h"
#include "tools/devices/can/unit.h"

namespace rung::devices {
namespace {

constexpr const char* kGroupNames[kUnitGroups] = {"INOUT08", "KLA50", "Knob"};

std::string hexOf(uint32_t value, uint32_t bytes) {
  uint8_t digits[4];
  for (uint32_t i = 0; i < bytes; ++i) digits[i] = static_cast<uint8_t>(value >> 8 * (bytes - 1 - i));
  return text::hexOf(std::span(digits).first(bytes)) + "h";
}

std::string nameOf(sdo::Object object) { return hexOf(object.index, 2) + ":" + std::to_string(object.subindex); }

std::string sentenceOf(const UnitMessage& message) {
  switch (message.kind) {
  case UnitMessage::Kind::Silent: return "does not answer";
  case UnitMessage::Kind::Answers: return "answers again";
  case UnitMessage::Kind::Error: return "reports an error, register 1001h is " + hexOf(message.code, 1);
  case UnitMessage::Kind::SilentSdo: return "does not answer the request for its object " + nameOf(message.object);
  case UnitMessage::Kind::RefusesSdo:
    return "refuses what its object " + nameOf(message.object) + " is to be, abort " + hexOf(message.code, 4);
  }
  return {};
}

} // namespace

std::string textOf(const UnitMessage& message) {
  const uint32_t node = kFirstNode[message.group - 1] + message.board - 1;
  return std::string("CAN unit ") + kGroupNames[message.group - 1] + " " + std::to_string(message.board) + " (node " +
         hexOf(node, 1) + ") " + sentenceOf(message);
}

} // namespace rung::devices
