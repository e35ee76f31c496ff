// Functions handed to the PLC (see channel_functions.h).
#include "sim/nct/channel_functions.h"

#include <algorithm>

#include "sim/nct/tool_management.h"

namespace rung::sim::nct {

namespace {
constexpr uint32_t kLines = nc::NctFunctions::kLines;
constexpr uint32_t kFirstAuxiliary = nc::NctFunctions::kAuxiliary;
static_assert(kCodesOfABlock == nc::NctFunctions::kCodes);
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

int32_t ChannelFunctions::codeOf(const BlockFunctions& functions, uint32_t line, bool turning) const {
  if (line < kCodesOfABlock) return functions.codes[line];
  if (line == nc::NctFunctions::kSpeed) return functions.speed;
  if (line == nc::NctFunctions::kTool) return turning ? functions.tool / kOffsetDigits : functions.tool;
  return functions.auxiliary[line - kFirstAuxiliary];
}

void ChannelFunctions::issue(const BlockFunctions& functions, uint32_t mask, bool turning) {
  if ((mask & kSpeed) != 0) selectRange(functions);
  if ((mask & kTool) != 0) showPlace(codeOf(functions, nc::NctFunctions::kTool, turning));
  for (uint32_t line = 0; line < kLines; ++line)
    if ((mask >> line & 1) != 0) handshake_.issue(links_.signals, line, codeOf(functions, line, turning));
}

uint32_t ChannelFunctions::unacknowledged(uint32_t mask) const {
  uint32_t open = 0;
  for (uint32_t line = 0; line < kLines; ++line)
    if ((mask >> line & 1) != 0 && !handshake_.acknowledged(links_.signals, line)) open |= uint32_t{1} << line;
  return open;
}

// The first range that reaches the speed (l.10664-10668), the last one when none does.
void ChannelFunctions::selectRange(const BlockFunctions& functions) {
  const SignalMemory& signals = links_.signals;
  int32_t range = 0;
  while (range < 7 && functions.speed > links_.parameters->real(parameters_.rangeEnd[range], functions.spindle - 1))
    ++range;
  signals.set(spindle_, channel_, static_cast<int32_t>(functions.spindle));
  signals.set(range_, channel_, nc::NctFunctions::kFirstRange + range);
}

// Where the tool is, if tool management works (l.9515-9522, 10732-10772).
void ChannelFunctions::showPlace(int32_t type) {
  const SignalMemory& signals = links_.signals;
  const bool managed = links_.tools->managed();
  const ToolPick pick = managed ? links_.tools->pick(type) : ToolPick{};
  signals.set(magazine_, channel_, static_cast<int32_t>(pick.place.cartridge));
  signals.set(pot_, channel_, static_cast<int32_t>(pick.place.pot));
  signals.set(toolExpired_, channel_, pick.expired);
}

} // namespace rung::sim::nct
