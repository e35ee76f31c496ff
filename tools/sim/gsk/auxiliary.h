// The handshake of the auxiliary functions M, S, T, B of a block (man. §7, l.5732-6131): codes in one slot, strobes in
// the next, then the answer of the PLC: FIN for all of them, or a completion signal each in the high-speed mode.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "rtlib/nc/control/gsk/signals_io.h"
#include "tools/sim/gsk/tables.h"

namespace rung::sim::gsk {

// What a block asks of the PLC.
struct AuxiliaryCodes {
  std::vector<uint32_t> m; // at most three
  std::optional<uint32_t> s, t, b;
  bool external = false; // EF of G81 (l.9450)
  // AFL lets only M00, M01, M02, M30 through (l.5947-5952).
  void lock();
  bool any() const { return !m.empty() || s || t || b || external; }
};

class Auxiliary {
public:
  // The codes are in F from now on.
  void start(const AuxiliaryCodes& codes, const nc::gsk::SignalsIo& io, const Tables& tables);
  void step(const nc::gsk::SignalsIo& io);
  // Strobes fall at once, codes of M go away (l.5257).
  void reset(const nc::gsk::SignalsIo& io);
  bool busy() const { return phase_ != Phase::Idle; }

private:
  enum class Phase : uint8_t { Idle, Codes, Strobes, FinFalls, FastStrobes };
  // M, second and third M, S, T, B, external operation.
  static constexpr uint32_t kChannels = 7;

  void dropCodes(const nc::gsk::SignalsIo& io) const;
  bool fastDone(const nc::gsk::SignalsIo& io) const;

  Phase phase_ = Phase::Idle;
  bool fast_ = false;
  std::array<bool, kChannels> used_ = {};
};

} // namespace rung::sim::gsk
