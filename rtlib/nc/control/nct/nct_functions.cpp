// Handshake of NCT's functions (see nct_functions.h).
#include "rtlib/nc/control/nct/nct_functions.h"

#include <algorithm>

namespace rung::nc {
namespace {

constexpr int32_t kFirstSpindle = 1; // CN_SSEL, 1 to 16 (man. l.10592)

} // namespace

void NctFunctions::powerOn(runtime::Instance& instance) {
  instance_ = &instance;
  phases_ = {};
  strobes_ = 0;
}

void NctFunctions::issue(const nct::SignalMemory& signals, uint32_t line, int32_t code) {
  signals.set(code_[line], channel_, code);
  signals.set(strobe_[line], channel_, true);
  strobes_ |= uint32_t{1} << line;
}

void NctFunctions::dropStrobes(const nct::SignalMemory& signals) {
  if (strobes_ == 0) return;
  for (uint32_t line = 0; line < kLines; ++line)
    if ((strobes_ >> line & 1) != 0) signals.set(strobe_[line], channel_, false);
  strobes_ = 0;
}

std::optional<uint32_t> NctFunctions::freeLine(FunctionKind kind) const {
  if (kind == FunctionKind::M) {
    if (std::ranges::count(std::span(phases_).first(kCodes), Phase::Strobe) != 0) return std::nullopt;
    for (uint32_t line = 0; line < kCodes; ++line)
      if (free(line)) return line;
    return std::nullopt;
  }
  constexpr uint32_t kLinesOfKinds[] = {0, kSpeed, kTool, kAuxiliary};
  const uint32_t line = kLinesOfKinds[static_cast<size_t>(kind)];
  return free(line) ? std::optional(line) : std::nullopt;
}

// Not within a PLC cycle, so that INT0 sees the strobe in all its time slices.
std::optional<uint32_t> NctFunctions::start(FunctionKind kind, uint32_t code) {
  if (!instance_->atListStart()) return std::nullopt;
  const std::optional<uint32_t> line = freeLine(kind);
  if (!line) return std::nullopt;
  if (kind == FunctionKind::S) selectSpindle();
  issue(signals_, *line, static_cast<int32_t>(code));
  phases_[*line] = Phase::Strobe;
  return line;
}

void NctFunctions::selectSpindle() const {
  if (signals_.get(spindle_, channel_) == 0) signals_.set(spindle_, channel_, kFirstSpindle);
  if (signals_.get(range_, channel_) == 0) signals_.set(range_, channel_, kFirstRange);
}

// When all acknowledges are 1, the program may still hold CP_FIN at 0, and the NC then takes no further block
// (l.10180-10192). While an acknowledge is 0, CP_FIN does not apply to the others.
void NctFunctions::step() {
  if (!instance_->atListStart()) return;
  dropStrobes(signals_);
  bool open = false;
  for (uint32_t line = 0; line < kLines; ++line) {
    if (phases_[line] == Phase::Idle) continue;
    phases_[line] = Phase::Open;
    open = open || !acknowledged(signals_, line);
  }
  if (!open && !signals_.get(finished_, channel_)) return;
  for (uint32_t line = 0; line < kLines; ++line)
    if (acknowledged(signals_, line)) phases_[line] = Phase::Idle;
}

void NctFunctions::abort() {
  dropStrobes(signals_);
  phases_ = {};
}

} // namespace rung::nc
