// Bytes of devices (see device_bytes.h).
#include "tools/scenario/device_bytes.h"

#include <algorithm>
#include <bit>

#include "rtlib/nc/technol/code_page.h"
#include "rtlib/nc/technol/services.h"
#include "sim/hex_bytes.h"

namespace rung::scenario {

std::optional<std::string> bytesOf(const Value& value, bool isHex) {
  if (value.kind == ValueKind::Text)
    return isHex ? sim::bytesOfHex<std::string>(value.text) : nc::memoryText(value.text);
  const auto bits =
      value.kind == ValueKind::Real ? std::bit_cast<uint64_t>(value.real) : static_cast<uint64_t>(value.integer);
  std::string bytes;
  for (int shift = 0; shift < 64; shift += 8) bytes += static_cast<char>(bits >> shift & 0xFF);
  return bytes;
}

std::string bytesAt(const runtime::Instance& instance, int64_t argument, bool isText) {
  const nc::technol::ArgumentBytes at = nc::technol::bytesOfArgument(argument);
  std::string bytes;
  for (uint32_t i = 0; i < at.count; ++i) {
    const auto byte = static_cast<char>(instance.read(runtime::intRef(at.space, at.first + i, 8)));
    if (isText && byte == 0) break;
    bytes += byte;
  }
  return bytes;
}

void putPart(std::string_view bytes, const core::ServiceRequest& request, core::ServiceReply& reply) {
  reply.ticket = request.ticket;
  reply.resultCount = RUNG_MAX_SERVICE_ARGS;
  const auto first = static_cast<uint64_t>(request.args[1]) * nc::technol::kDataBytes;
  if (first >= bytes.size()) return;
  const std::string_view part = bytes.substr(first, nc::technol::kDataBytes);
  for (size_t i = 0; i < part.size(); ++i)
    reply.results[i / 8] |= static_cast<int64_t>(uint64_t{static_cast<uint8_t>(part[i])} << i % 8 * 8);
}

} // namespace rung::scenario
