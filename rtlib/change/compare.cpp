// Fast where all is equal (one memcmp), explicit where it is not.
#include "rtlib/change/compare.h"

#include <algorithm>
#include <cstring>

#include "rtlib/load/program_info.h"

namespace rung::runtime {

namespace {

using Difference = std::optional<std::string>;

std::string values(uint64_t here, uint64_t there) {
  return ": " + std::to_string(here) + " here, " + std::to_string(there) + " there";
}

// Names the byte, or its bit when only one differs.
std::string byteDifference(const rung_program& program, LogicalByte at, uint8_t here, uint8_t there,
                           DescribePlace describe) {
  const uint32_t changed = here ^ there;
  for (uint32_t bit = 0; bit < 8; ++bit)
    if (changed == 1u << bit)
      return describe(program, bitRef(at.space, at.byte, bit)) + values((here >> bit) & 1, (there >> bit) & 1);
  return describe(program, intRef(at.space, at.byte, 8)) + values(here, there);
}

Difference rawDifference(const Instance& here, const Instance& there, DescribePlace describe) {
  const auto a = here.block();
  const auto b = there.block();
  if (std::memcmp(a.data(), b.data(), a.size()) == 0) return std::nullopt;
  const auto place = std::mismatch(a.begin(), a.end(), b.begin());
  const auto offset = static_cast<uint32_t>(place.first - a.begin());
  if (const std::optional<LogicalByte> at = byteAt(here.program(), offset)) {
    const uint8_t valueHere = here.memory().readByte(at->space, at->byte);
    const uint8_t valueThere = there.memory().readByte(at->space, at->byte);
    if (valueHere != valueThere) return byteDifference(here.program(), *at, valueHere, valueThere, describe);
  }
  // A slot of the compiler, or equal as bits and yet not equal: an expanded bit holds more than 0 or 1.
  return "memory at offset " + std::to_string(offset) + values(a[offset], b[offset]);
}

Difference logicalDifference(const Instance& here, const Instance& there, DescribePlace describe) {
  const rung_program& p = here.program();
  if (p.space_count != there.program().space_count) return "the programs have different spaces";
  for (uint32_t s = 0; s < p.space_count; ++s) {
    if (p.spaces[s].byte_count != there.program().spaces[s].byte_count)
      return "space " + std::string(p.spaces[s].name) + " has different sizes";
    for (uint32_t byte = 0; byte < p.spaces[s].byte_count; ++byte) {
      const uint8_t a = here.memory().readByte(s, byte);
      const uint8_t b = there.memory().readByte(s, byte);
      if (a != b) return byteDifference(p, {s, byte}, a, b, describe);
    }
  }
  return std::nullopt;
}

// Compilers may put rungs in another order.
uint64_t rungKey(const Instance& instance, uint32_t rung) {
  return rung < instance.program().rung_count ? instance.program().rungs[rung].key : 0;
}

Difference faultDifference(const Instance& here, const Instance& there) {
  const rung_fault& a = here.fault();
  const rung_fault& b = there.fault();
  if (here.faulted() == there.faulted() && a.code == b.code && a.line == b.line && a.task == b.task &&
      rungKey(here, a.rung) == rungKey(there, b.rung))
    return std::nullopt;
  const auto text = [](const Instance& i) { return i.faulted() ? i.faultText() : std::string("no fault"); };
  return "fault: " + text(here) + " here, " + text(there) + " there";
}

bool sameText(const rung_message& a, const rung_message& b) {
  return a.op == b.op && a.number == b.number && a.channel == b.channel && a.index == b.index && a.value == b.value &&
         a.real == b.real;
}

Difference messageDifference(const Instance& one, const Instance& other) {
  const core::MessageQueue& here = one.messages();
  const core::MessageQueue& there = other.messages();
  if (here.size() != there.size()) return "waiting messages" + values(here.size(), there.size());
  if (here.lost() != there.lost()) return "lost messages" + values(here.lost(), there.lost());
  for (uint32_t i = 0; i < here.size(); ++i) {
    const rung_message& a = *here.peek(i);
    const rung_message& b = *there.peek(i);
    if (a.number != b.number) return "number of message " + std::to_string(i) + values(a.number, b.number);
    if (!sameText(a, b) || rungKey(one, a.rung) != rungKey(other, b.rung))
      return "message " + std::to_string(a.number) + ": contents differ";
  }
  return std::nullopt;
}

Difference serviceDifference(const Instance& here, const Instance& there) {
  const core::ServiceQueue& a = here.services();
  const core::ServiceQueue& b = there.services();
  if (a.waiting() != b.waiting()) return "waiting service requests" + values(a.waiting(), b.waiting());
  if (a.refused() != b.refused()) return "refused service requests" + values(a.refused(), b.refused());
  for (uint32_t i = 0; i < a.waiting(); ++i)
    if (*a.peek(i) != *b.peek(i))
      return "service request " + std::to_string(i) + " (" +
             std::string(serviceName(here.program(), a.peek(i)->service)) + "): contents differ";
  for (uint32_t i = 0; i < core::ServiceQueue::kRecords; ++i)
    if (a.record(i) != b.record(i))
      return "service ticket " + std::to_string(a.record(i).ticket) + ": state or results differ";
  return std::nullopt;
}

} // namespace

std::optional<std::string> firstDifference(const Instance& here, const Instance& there, DescribePlace describe) {
  const bool sameLayout = here.program().layout_hash == there.program().layout_hash &&
                          here.program().memory_size == there.program().memory_size;
  if (Difference d = faultDifference(here, there)) return d;
  if (Difference d = sameLayout ? rawDifference(here, there, describe) : logicalDifference(here, there, describe))
    return d;
  if (here.nowUs() != there.nowUs())
    return "clock: " + std::to_string(here.nowUs()) + " us here, " + std::to_string(there.nowUs()) + " us there";
  if (Difference d = messageDifference(here, there)) return d;
  return serviceDifference(here, there);
}

} // namespace rung::runtime
