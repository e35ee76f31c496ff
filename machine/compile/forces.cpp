// A line with the version; the hashes of code and layout (8 bytes each), the number of forced bytes (4), of each space,
// byte, mask and value (4 each); the file. Numbers have the low byte first.
#include "machine/compile/forces.h"

#include <utility>

#include "machine/compile/bytes.h"

namespace rung::compile {
namespace {

constexpr std::string_view kHead = "rung-forces 1\n";
constexpr unsigned kHashBytes = 8;
constexpr unsigned kFieldBytes = 4;

std::pair<uint32_t, uint32_t> placeOf(const rung_forced_byte& byte) { return {byte.space, byte.byte}; }

// What rung_forced_byte says of itself.
bool isForced(const rung_forced_byte& byte) {
  return byte.mask != 0 && byte.mask <= 0xFF && (byte.value & ~byte.mask) == 0;
}

std::string problemOf(const std::vector<rung_forced_byte>& bytes) {
  if (bytes.empty()) return "found no forced byte, expected one at least";
  for (size_t i = 0; i < bytes.size(); ++i) {
    if (!isForced(bytes[i])) return "found a forced byte without bits, or with others than its own";
    if (i != 0 && placeOf(bytes[i - 1]) >= placeOf(bytes[i])) return "found forced bytes that are not in their order";
  }
  return "";
}

} // namespace

std::string packed(const Forces& forces) {
  std::string out(kHead);
  putNumber(out, forces.codeHash, kHashBytes);
  putNumber(out, forces.layoutHash, kHashBytes);
  putNumber(out, forces.bytes.size(), kFieldBytes);
  for (const rung_forced_byte& byte : forces.bytes)
    for (const uint32_t field : {byte.space, byte.byte, byte.mask, byte.value}) putNumber(out, field, kFieldBytes);
  out += forces.program;
  return out;
}

std::optional<Forces> unpackedForces(std::string_view bytes, std::string& problem) {
  ByteReader reader(bytes);
  const bool known = reader.take(kHead.size()) == kHead;
  Forces forces;
  forces.codeHash = reader.takeNumber(kHashBytes);
  forces.layoutHash = reader.takeNumber(kHashBytes);
  const uint64_t count = reader.takeNumber(kFieldBytes);
  const auto field = [&reader] { return static_cast<uint32_t>(reader.takeNumber(kFieldBytes)); };
  for (uint64_t i = 0; i < count && i < kMostForcedBytes && reader.good(); ++i) {
    const uint32_t space = field(), byte = field(), mask = field(), value = field();
    forces.bytes.push_back({space, byte, mask, value});
  }
  forces.program = reader.rest();
  if (!known || !reader.good())
    problem = "found bytes that are not forces, or not all of them";
  else if (count > kMostForcedBytes)
    problem = "found " + std::to_string(count) + " forced bytes, expected at most " + std::to_string(kMostForcedBytes);
  else
    problem = problemOf(forces.bytes);
  return problem.empty() ? std::optional(std::move(forces)) : std::nullopt;
}

} // namespace rung::compile
