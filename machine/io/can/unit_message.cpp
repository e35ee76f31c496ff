// Sentences about units (see unit_message.h).
#include "machine/io/can/unit_message.h"

#include "machine/io/can/unit.h"
#include "rtlib/text/hex.h"

namespace rung::io {
namespace {

std::string hex(uint32_t value, uint32_t bytes) { return text::hexOfNumber(value, bytes) + "h"; }

std::string nameOf(sdo::Object object) { return hex(object.index, 2) + ":" + std::to_string(object.subindex); }

std::string sentenceOf(const UnitMessage& message) {
  switch (message.kind) {
  case UnitMessage::Kind::Silent: return "does not answer";
  case UnitMessage::Kind::Answers: return "answers again";
  case UnitMessage::Kind::Error: return "reports an error, register 1001h is " + hex(message.code, 1);
  case UnitMessage::Kind::SilentSdo: return "does not answer the request for object " + nameOf(message.object);
  case UnitMessage::Kind::RefusesSdo:
    return "rejects the value of object " + nameOf(message.object) + ", abort code " + hex(message.code, 4);
  }
  return {};
}

} // namespace

std::string textOf(const UnitMessage& message) {
  return std::string("CAN unit ") + kUnitGroupNames[message.group - 1].unit + " " + std::to_string(message.board) +
         " (node " + hex(nodeOf(message.group, message.board), 1) + ") " + sentenceOf(message);
}

} // namespace rung::io
