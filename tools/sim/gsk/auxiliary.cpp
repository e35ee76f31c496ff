// Handshake of the auxiliary functions (see auxiliary.h).
#include "tools/sim/gsk/auxiliary.h"

namespace rung::sim::gsk {
namespace {

struct Bit {
  uint8_t byte, bit;
};
struct Channel {
  uint8_t code; // F
  Bit strobe;   // F
  Bit done;     // G, high-speed mode
};

constexpr Channel kTable[] = {
    {10, {7, 0}, {5, 0}}, // M, MF, MFIN
    {14, {7, 5}, {4, 4}}, // second M, MF2, MFIN2
    {18, {7, 6}, {4, 5}}, // third M, MF3, MFIN3
    {22, {7, 2}, {5, 2}}, // S, SF, SFIN
    {26, {7, 3}, {5, 3}}, // T, TF, TFIN
    {30, {7, 4}, {5, 7}}, // B, BF, SFIN2
    {0, {8, 0}, {4, 3}},  // EF: always FIN, and FIN's fall (l.9450-9454)
};
constexpr uint32_t kManyM = 3;
constexpr uint32_t kExternal = 6;
constexpr Bit kFin = {4, 3};

struct Decoded {
  uint32_t code;
  uint8_t bit; // of F9
};
constexpr Decoded kDecoded[] = {{0, 7}, {1, 6}, {2, 5}, {30, 4}}; // l.5803-5807

bool isDecoded(uint32_t code) { return code <= 2 || code == 30; }

} // namespace

void AuxiliaryCodes::lock() {
  std::erase_if(m, [](uint32_t code) { return !isDecoded(code); });
  s.reset();
  t.reset();
  b.reset();
}

void Auxiliary::start(const AuxiliaryCodes& codes, const nc::gsk::SignalsIo& io, const Tables& tables) {
  fast_ = tables.parameterBit(kParamGuard, 7) && !codes.external;
  used_ = {};
  const auto put = [&](uint32_t channel, uint32_t code) {
    used_[channel] = true;
    io.setFDword(kTable[channel].code, code);
  };
  for (uint32_t i = 0; i < codes.m.size() && i < kManyM; ++i) {
    put(i, codes.m[i]);
    for (const Decoded& d : kDecoded)
      if (d.code == codes.m[i]) io.setF(9, d.bit, true);
  }
  if (codes.s) put(3, *codes.s);
  if (codes.t) put(4, *codes.t);
  if (codes.b) put(5, *codes.b);
  used_[kExternal] = codes.external;
  phase_ = Phase::Idle;
  for (bool used : used_)
    if (used) phase_ = Phase::Codes;
}

void Auxiliary::step(const nc::gsk::SignalsIo& io) {
  switch (phase_) {
  case Phase::Idle: return;
  case Phase::Codes:
    for (uint32_t i = 0; i < kChannels; ++i) {
      if (!used_[i]) continue;
      const Bit strobe = kTable[i].strobe;
      io.setF(strobe.byte, strobe.bit, !fast_ || !io.f(strobe.byte, strobe.bit));
    }
    phase_ = fast_ ? Phase::FastStrobes : Phase::Strobes;
    return;
  case Phase::Strobes:
    if (!io.g(kFin.byte, kFin.bit)) return;
    for (uint32_t i = 0; i < kChannels; ++i)
      if (used_[i]) io.setF(kTable[i].strobe.byte, kTable[i].strobe.bit, false);
    phase_ = Phase::FinFalls;
    return;
  case Phase::FinFalls:
    if (io.g(kFin.byte, kFin.bit)) return;
    dropCodes(io);
    phase_ = Phase::Idle;
    return;
  case Phase::FastStrobes:
    if (!fastDone(io)) return;
    dropCodes(io);
    phase_ = Phase::Idle;
    return;
  }
}

bool Auxiliary::fastDone(const nc::gsk::SignalsIo& io) const {
  for (uint32_t i = 0; i < kChannels; ++i) {
    const Channel& c = kTable[i];
    if (used_[i] && io.g(c.done.byte, c.done.bit) != io.f(c.strobe.byte, c.strobe.bit)) return false;
  }
  return true;
}

// S, T and B codes stay (l.5762).
void Auxiliary::dropCodes(const nc::gsk::SignalsIo& io) const {
  for (uint32_t i = 0; i < kManyM; ++i) io.setFDword(kTable[i].code, 0);
  for (const Decoded& d : kDecoded) io.setF(9, d.bit, false);
}

void Auxiliary::reset(const nc::gsk::SignalsIo& io) {
  for (const Channel& c : kTable) io.setF(c.strobe.byte, c.strobe.bit, false);
  dropCodes(io);
  phase_ = Phase::Idle;
}

} // namespace rung::sim::gsk
