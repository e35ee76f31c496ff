// Memory that an operation reads or writes in the program's spaces.
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
  BitRange place; // computed: everything that the address can reach
  Type type = Type::Bit;
  bool writes = false;
  bool computed = false; // somewhere in `place`, at a computed address
  bool operator==(const Use&) const = default;
};

// The memory that an operation accesses; nothing if it accesses none.
std::optional<Use> useOf(const Module& module, const Op& op);

template <class Visit>
void forUses(const Module& module, const Routine& routine, Visit visit) {
  for (const Rung& rung : routine.rungs)
    for (const Op& op : rung.ops)
      if (const std::optional<Use> use = useOf(module, op)) visit(*use);
}

} // namespace rung::ir
