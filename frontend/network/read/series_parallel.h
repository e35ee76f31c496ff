// Contacts between the left rail and a net as a tree of series and parallel groups (§5, P14), which a command list can
// express. The tree does not depend on command lists or lowering, so that both directions of a conversion can use it.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "frontend/ladder/rung.h"

namespace rung::frontend::network {

struct SpTree {
  enum class Kind : uint8_t { Contact, Series, Parallel };
  struct Node {
    Kind kind = Kind::Contact;
    ladder::ElementId contact;      // Contact
    std::vector<uint32_t> children; // Series: left to right; Parallel: upper branch first; never of the same kind
  };
  std::vector<Node> nodes;
  uint32_t root = 0;
};

// The network before `target`; nullopt if it is not series-parallel. `target` must not be the rail, and all its drivers
// must be contacts. The time is linear in the contacts except for the sorting of branches.
std::optional<SpTree> decompose(const ladder::Rung& rung, ladder::NetId target);

} // namespace rung::frontend::network
