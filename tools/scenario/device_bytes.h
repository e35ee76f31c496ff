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

// What a value means as bytes: `isHex` of a text in pairs of digits, else of its characters; of a number its eight
// bytes, the lowest first.
std::optional<std::string> bytesOf(const Value& value, bool isHex);
// Those in the memory of a program that an argument names; of a text up to its terminator.
std::string bytesAt(const runtime::Instance& instance, int64_t argument, bool isText);
// One part of an answer's bytes, for a request that fetches them.
void putPart(std::string_view bytes, const core::ServiceRequest& request, core::ServiceReply& reply);

// A request that a scenario may look at, with the bytes of its arguments as they were when it was made.
struct Asked {
  core::ServiceRequest request;
  std::vector<std::string> bytes; // by argument; empty: of a request without bytes
  bool complete = false;          // it has been answered
};

} // namespace rung::scenario
