// Handshake of GSK's functions (see gsk_functions.h).
#include "rtlib/nc/control/gsk/gsk_functions.h"

#include <algorithm>

namespace rung::nc {
namespace {

struct Bit {
  uint8_t byte, bit;
};
struct Signals {
  uint8_t code; // F
  Bit strobe;   // F
  Bit done;     // G, high-speed mode
};

// By GskFunctions::Line.
constexpr Signals kSignals[] = {
    {10, {7, 0}, {5, 0}}, // M, MF, MFIN
    {14, {7, 5}, {4, 4}}, // second M, MF2, MFIN2
    {18, {7, 6}, {4, 5}}, // third M, MF3, MFIN3
    {22, {7, 2}, {5, 2}}, // S, SF, SFIN
    {26, {7, 3}, {5, 3}}, // T, TF, TFIN
    {30, {7, 4}, {5, 7}}, // B, BF, SFIN2
    {0, {8, 0}, {4, 3}},  // EF: always FIN, and its falling edge (l.9450-9454)
};
constexpr uint32_t kManyM = 3;
constexpr uint32_t kExternal = static_cast<uint32_t>(GskFunctions::Line::External);
constexpr Bit kFin = {4, 3};

// M00, M01, M02 and M30 have a bit of their own in F9 (l.5803-5807).
struct Decoded {
  uint32_t code;
  uint8_t bit;
};
constexpr uint8_t kDecodedByte = 9;
constexpr Decoded kDecoded[] = {{0, 7}, {1, 6}, {2, 5}, {30, 4}};

void setDecoded(const gsk::SignalsIo& io, uint32_t code) {
  for (const Decoded& d : kDecoded)
    if (d.code == code) io.setF(kDecodedByte, d.bit, true);
}

// S, T and B codes stay (l.5762).
void dropCodes(const gsk::SignalsIo& io) {
  for (uint32_t i = 0; i < kManyM; ++i) io.setFDword(kSignals[i].code, 0);
  for (const Decoded& d : kDecoded) io.setF(kDecodedByte, d.bit, false);
}

GskFunctions::Line lineOf(FunctionKind kind) {
  constexpr GskFunctions::Line kLinesOfKinds[] = {GskFunctions::Line::M, GskFunctions::Line::S, GskFunctions::Line::T,
                                                  GskFunctions::Line::B};
  return kLinesOfKinds[static_cast<size_t>(kind)];
}

} // namespace

bool GskFunctions::start(const gsk::SignalsIo& io, Line line, uint32_t code) {
  const auto index = static_cast<uint32_t>(line);
  if (running_[index].phase != Phase::Idle) return false;
  const bool fast = highSpeed_ && line != Line::External;
  const auto blocks = [&](const Running& other) {
    return other.phase != Phase::Idle && (other.fast != fast || (!fast && other.phase != Phase::Code));
  };
  if (std::ranges::any_of(running_, blocks)) return false;
  if (index != kExternal) io.setFDword(kSignals[index].code, code);
  if (index < kManyM) setDecoded(io, code);
  running_[index] = {Phase::Code, fast, false};
  handedOver_ = true;
  return true;
}

bool GskFunctions::busy() const {
  return std::ranges::any_of(running_, [](const Running& each) { return each.phase != Phase::Idle; });
}

void GskFunctions::step(const gsk::SignalsIo& io) {
  for (uint32_t i = 0; i < kLines; ++i) {
    Running& one = running_[i];
    switch (one.phase) {
    case Phase::Idle: break;
    case Phase::Code: giveStrobe(io, i); break;
    case Phase::Strobe:
      if (!answered(io, i)) {
        one.absent = true;
      } else if (one.absent && one.fast) {
        end(io, i);
      } else if (one.absent) {
        io.setF(kSignals[i].strobe.byte, kSignals[i].strobe.bit, false);
        one.phase = Phase::Release;
      }
      break;
    case Phase::Release:
      if (!answered(io, i)) end(io, i);
      break;
    }
  }
}

// In high-speed mode the strobe toggles.
void GskFunctions::giveStrobe(const gsk::SignalsIo& io, uint32_t line) {
  const Bit strobe = kSignals[line].strobe;
  Running& one = running_[line];
  io.setF(strobe.byte, strobe.bit, !one.fast || !io.f(strobe.byte, strobe.bit));
  one.phase = Phase::Strobe;
  one.absent = counts_ == Answer::ByLevel || !answered(io, line);
}

bool GskFunctions::answered(const gsk::SignalsIo& io, uint32_t line) const {
  const Signals& s = kSignals[line];
  if (running_[line].fast) return io.g(s.done.byte, s.done.bit) == io.f(s.strobe.byte, s.strobe.bit);
  return io.g(kFin.byte, kFin.bit);
}

void GskFunctions::end(const gsk::SignalsIo& io, uint32_t line) {
  running_[line].phase = Phase::Idle;
  if (!busy()) dropCodes(io);
}

void GskFunctions::abort(const gsk::SignalsIo& io) {
  for (const Signals& s : kSignals) io.setF(s.strobe.byte, s.strobe.bit, false);
  dropCodes(io);
  running_ = {};
}

std::optional<uint32_t> GskFunctions::start(FunctionKind kind, uint32_t code) {
  if (!io_) return std::nullopt;
  const Line line = lineOf(kind);
  // The new function replaces an M code that stayed during a function of another kind.
  if (line == Line::M && running_[0].phase == Phase::Idle && highSpeed_) dropCodes(*io_);
  return start(*io_, line, code) ? std::optional(static_cast<uint32_t>(line)) : std::nullopt;
}

} // namespace rung::nc
