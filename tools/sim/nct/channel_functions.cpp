// Functions handed to the PLC (see channel_functions.h).
#include "tools/sim/nct/channel_functions.h"

#include <algorithm>

#include "tools/sim/nct/tool_management.h"

namespace rung::sim::nct {

namespace {
constexpr uint32_t kFunctions = 13;
constexpr uint32_t kFirstAuxiliary = 10;
constexpr int32_t kFirstRange = 11;    // CN_RNGREQ, l.10666
constexpr int32_t kOffsetDigits = 100; // a lathe's T is tool and offset number, l.10674
} // namespace

bool BlockFunctions::has(int32_t code) const { return std::ranges::find(codes, code) != codes.end(); }

bool BlockFunctions::any() const { return ChannelFunctions::mask(*this) != 0; }

uint32_t ChannelFunctions::mask(const BlockFunctions& functions) {
  uint32_t mask = 0;
  for (uint32_t i = 0; i < kCodesOfABlock; ++i)
    if (functions.codes[i] >= 0) mask |= uint32_t{1} << i;
  if (functions.speed >= 0) mask |= kSpeed;
  if (functions.tool >= 0) mask |= kTool;
  for (uint32_t i = 0; i < 3; ++i)
    if (functions.auxiliary[i] >= 0) mask |= uint32_t{1} << (kFirstAuxiliary + i);
  return mask;
}

void ChannelFunctions::issue(const BlockFunctions& functions, uint32_t mask, bool turning) {
  const SignalMemory& signals = links_.signals;
  for (uint32_t i = 0; i < kCodesOfABlock; ++i)
    if ((mask >> i & 1) != 0) signals.set(code_[i], channel_, functions.codes[i]);
  for (uint32_t i = 0; i < 3; ++i)
    if ((mask >> (kFirstAuxiliary + i) & 1) != 0) signals.set(auxiliary_[i], channel_, functions.auxiliary[i]);
  if ((mask & kSpeed) != 0) giveSpeed(functions);
  if ((mask & kTool) != 0) giveTool(functions.tool, turning);
  for (uint32_t i = 0; i < kFunctions; ++i)
    if ((mask >> i & 1) != 0) signals.set(strobe_[i], channel_, true);
  strobes_ |= mask;
}

void ChannelFunctions::dropStrobes() {
  for (uint32_t i = 0; i < kFunctions; ++i)
    if ((strobes_ >> i & 1) != 0) links_.signals.set(strobe_[i], channel_, false);
  strobes_ = 0;
}

uint32_t ChannelFunctions::unacknowledged(uint32_t mask) const {
  uint32_t open = 0;
  for (uint32_t i = 0; i < kFunctions; ++i)
    if ((mask >> i & 1) != 0 && !links_.signals.get(acknowledge_[i], channel_)) open |= uint32_t{1} << i;
  return open;
}

// The first range that reaches the speed (l.10664-10668), the last one when none does.
void ChannelFunctions::giveSpeed(const BlockFunctions& functions) {
  const SignalMemory& signals = links_.signals;
  int32_t range = 0;
  while (range < 7 && functions.speed > links_.parameters->real(parameters_.rangeEnd[range], functions.spindle - 1))
    ++range;
  signals.set(speed_, channel_, functions.speed);
  signals.set(spindle_, channel_, static_cast<int32_t>(functions.spindle));
  signals.set(range_, channel_, kFirstRange + range);
}

// Where the tool stands, if tool management works (l.9515-9522, 10732-10772).
void ChannelFunctions::giveTool(int32_t code, bool turning) {
  const SignalMemory& signals = links_.signals;
  const int32_t type = turning ? code / kOffsetDigits : code;
  signals.set(tool_, channel_, type);
  const bool managed = links_.tools->managed();
  const ToolPick pick = managed ? links_.tools->pick(type) : ToolPick{};
  signals.set(magazine_, channel_, static_cast<int32_t>(pick.place.cartridge));
  signals.set(pot_, channel_, static_cast<int32_t>(pick.place.pot));
  signals.set(toolExpired_, channel_, pick.expired);
}

} // namespace rung::sim::nct
