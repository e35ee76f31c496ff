// Bytes and texts that a program and the devices of its control exchange (rtlib/nc/technol/services.h), as scenarios
// write them: data="0F 00", Val="text", or a number.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "rtlib/core/queues.h"
#include "rtlib/run/instance.h"
#include "tools/scenario/scenario.h"

namespace rung::scenario {

// The bytes of a value: if `isHex`, a text is pairs of hexadecimal digits, else its characters count; a number has
// eight bytes, the lowest first.
std::optional<std::string> bytesOf(const Value& value, bool isHex);
// The bytes in the program's memory to which an argument points; of a text, up to its terminator.
std::string bytesAt(const runtime::Instance& instance, int64_t argument, bool isText);
// Puts the requested part of an answer's bytes into the reply, for a request that fetches them.
void putPart(std::string_view bytes, const core::ServiceRequest& request, core::ServiceReply& reply);

// A request that a scenario may check, with the bytes of its arguments at the time when it was made.
struct Asked {
  core::ServiceRequest request;
  std::vector<std::string> bytes; // by argument; empty for a request without bytes
  bool complete = false;          // whether it has been answered
};

} // namespace rung::scenario
