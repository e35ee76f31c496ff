// Handshake of the family's functions (see pmc_functions.h).
#include "rtlib/nc/control/pmc/pmc_functions.h"

#include <algorithm>

namespace rung::nc {
namespace {

constexpr pmc::BitPlace kFin = {4, 3}; // G

// M00, M01, M02 and M30 have a bit of their own in F9 (l.5803-5807).
struct Decoded {
  uint32_t code;
  uint8_t bit;
};
constexpr uint8_t kDecodedByte = 9;
constexpr Decoded kDecoded[] = {{0, 7}, {1, 6}, {2, 5}, {30, 4}};

void setDecoded(const pmc::SignalsIo& io, uint32_t code) {
  for (const Decoded& d : kDecoded)
    if (d.code == code) io.setF(kDecodedByte, d.bit, true);
}

PmcFunctions::Line lineOf(FunctionKind kind) {
  constexpr PmcFunctions::Line kLinesOfKinds[] = {PmcFunctions::Line::M, PmcFunctions::Line::S, PmcFunctions::Line::T,
                                                  PmcFunctions::Line::B};
  return kLinesOfKinds[static_cast<size_t>(kind)];
}

} // namespace

void PmcFunctions::putCode(const pmc::SignalsIo& io, uint32_t line, uint32_t code) const {
  const pmc::FunctionSignals& signals = model_->functions[line];
  if (signals.codeBytes == 4)
    io.setFDword(signals.code, code);
  else if (signals.codeBytes == 2)
    io.setFWord(signals.code, static_cast<uint16_t>(code));
}

// S, T and B codes stay (l.5762).
void PmcFunctions::dropCodes(const pmc::SignalsIo& io) const {
  for (uint32_t i = 0; i < pmc::kMostM; ++i) putCode(io, i, 0);
  for (const Decoded& d : kDecoded) io.setF(kDecodedByte, d.bit, false);
}

bool PmcFunctions::start(const pmc::SignalsIo& io, Line line, uint32_t code) {
  const auto index = static_cast<uint32_t>(line);
  if (running_[index].phase != Phase::Idle) return false;
  const bool fast = highSpeed_ && line != Line::External;
  const auto blocks = [&](const Running& other) {
    return other.phase != Phase::Idle && (other.fast != fast || (!fast && other.phase != Phase::Code));
  };
  if (std::ranges::any_of(running_, blocks)) return false;
  putCode(io, index, code);
  if (index < pmc::kMostM) setDecoded(io, code);
  running_[index] = {Phase::Code, fast, false};
  handedOver_ = true;
  return true;
}

bool PmcFunctions::busy() const {
  return std::ranges::any_of(running_, [](const Running& each) { return each.phase != Phase::Idle; });
}

void PmcFunctions::step(const pmc::SignalsIo& io) {
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
        io.setF(model_->functions[i].strobe.byte, model_->functions[i].strobe.bit, false);
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
void PmcFunctions::giveStrobe(const pmc::SignalsIo& io, uint32_t line) {
  const pmc::BitPlace strobe = model_->functions[line].strobe;
  Running& one = running_[line];
  io.setF(strobe.byte, strobe.bit, !one.fast || !io.f(strobe.byte, strobe.bit));
  one.phase = Phase::Strobe;
  one.absent = counts_ == Answer::ByLevel || !answered(io, line);
}

bool PmcFunctions::answered(const pmc::SignalsIo& io, uint32_t line) const {
  const pmc::FunctionSignals& s = model_->functions[line];
  if (running_[line].fast) return io.g(s.done.byte, s.done.bit) == io.f(s.strobe.byte, s.strobe.bit);
  return io.g(kFin.byte, kFin.bit);
}

void PmcFunctions::end(const pmc::SignalsIo& io, uint32_t line) {
  running_[line].phase = Phase::Idle;
  if (!busy()) dropCodes(io);
}

void PmcFunctions::abort(const pmc::SignalsIo& io) {
  for (const pmc::FunctionSignals& s : model_->functions)
    if (s.strobe.byte != 0) io.setF(s.strobe.byte, s.strobe.bit, false);
  dropCodes(io);
  running_ = {};
}

std::optional<uint32_t> PmcFunctions::start(FunctionKind kind, uint32_t code) {
  if (!io_) return std::nullopt;
  const Line line = lineOf(kind);
  // The new function replaces an M code that stayed during a function of another kind.
  if (line == Line::M && running_[0].phase == Phase::Idle && highSpeed_) dropCodes(*io_);
  return start(*io_, line, code) ? std::optional(static_cast<uint32_t>(line)) : std::nullopt;
}

} // namespace rung::nc
