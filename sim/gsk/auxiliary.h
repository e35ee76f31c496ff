// What a block of a part program asks of the PLC: its auxiliary functions M, S, T, B (man. §7, l.5732-6131).
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "rtlib/nc/control/gsk/gsk_functions.h"

namespace rung::sim::gsk {

struct AuxiliaryCodes {
  std::vector<uint32_t> m; // at most three
  std::optional<uint32_t> s, t, b;
  bool external = false; // EF of G81 (l.9450)
  // AFL lets only M00, M01, M02, M30 through (l.5947-5952).
  void lock();
  bool any() const { return !m.empty() || s || t || b || external; }
  // All of them in one slot; no other function is under way. Those beside the external one use the common answer.
  void start(nc::GskFunctions& functions, const nc::gsk::SignalsIo& io, bool highSpeed) const;
};

} // namespace rung::sim::gsk
