// What an operation reads or writes of the program's spaces.
#pragma once
#include <cstdint>
#include <optional>

#include "ir/core/module.h"

namespace rung::ir {

// Bits of a space, counted from its beginning.
struct BitRange {
  SpaceId space;
  uint32_t first = 0;
  uint32_t count = 1;
  bool operator==(const BitRange&) const = default;
};
bool overlap(const BitRange& a, const BitRange& b);
inline BitRange bitsOf(const SpaceSpan& span) { return {span.space, span.byte * 8, span.size * 8}; }
inline BitRange targetOf(const Copy& copy) { return bitsOf({copy.to, copy.toByte, copy.from.size}); }

struct Use {
  BitRange place; // computed: all that the address can reach
  Type type = Type::Bit;
  bool writes = false;
  bool computed = false; // somewhere in `place`, at an address that is computed
  bool operator==(const Use&) const = default;
};

// What an operation touches; nothing when it touches no memory.
std::optional<Use> useOf(const Module& module, const Op& op);

template <class Visit>
void forUses(const Module& module, const Routine& routine, Visit visit) {
  for (const Rung& rung : routine.rungs)
    for (const Op& op : rung.ops)
      if (const std::optional<Use> use = useOf(module, op)) visit(*use);
}

} // namespace rung::ir
