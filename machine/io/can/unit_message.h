// What the control says about a unit on the CAN bus. The manual has no numbers for that (l.9615-9653 are of drives).
#pragma once
#include <string>

#include "machine/io/can/bounded_queue.h"
#include "machine/io/can/sdo.h"

namespace rung::io {

struct UnitMessage {
  enum class Kind : uint8_t {
    Silent,     // time-out
    Answers,    // again
    Error,      // `code` is its error register 1001h
    SilentSdo,  // it does not answer the request for `object`
    RefusesSdo, // nor carry it out: `code` is that of the abort (CiA 301)
  };
  Kind kind = Kind::Silent;
  uint8_t group = 0, board = 0; // from 1
  sdo::Object object;
  uint32_t code = 0;

  bool operator==(const UnitMessage&) const = default;
};
using UnitMessages = BoundedQueue<UnitMessage, 64>; // of more the newest are lost

// As the log has it.
std::string textOf(const UnitMessage& message);

} // namespace rung::io
