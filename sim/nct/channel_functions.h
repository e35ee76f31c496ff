// M, S, T and auxiliary functions of a block on their way from the channel handler to the PLC (man. l.9440-9560,
// 10500-10772), by the control's handshake; with S goes the range of the spindle, with T the place of the tool.
#pragma once
#include <array>

#include "rtlib/nc/control/nct/nct_functions.h"
#include "sim/nct/channel_program.h"
#include "sim/nct/channel_signals.h"
#include "sim/nct/topic.h"

namespace rung::sim::nct {

// What one block hands over; a function that is not in the block is negative.
struct BlockFunctions {
  std::array<int32_t, kCodesOfABlock> codes{};
  int32_t speed = -1;
  uint32_t spindle = 0; // CN_SSEL, from 1
  int32_t tool = -1;
  std::array<int32_t, 3> auxiliary{};

  BlockFunctions() {
    codes.fill(-1);
    auxiliary.fill(-1);
  }
  bool has(int32_t code) const;
  bool any() const;
};

class ChannelFunctions {
public:
  ChannelFunctions(Links& links, uint32_t channel) : links_(links), channel_(channel), handshake_(channel) {}

  // One bit a line of the handshake.
  static constexpr uint32_t kSpeed = 1 << nc::NctFunctions::kSpeed;
  static constexpr uint32_t kTool = 1 << nc::NctFunctions::kTool;
  static uint32_t mask(const BlockFunctions& functions);

  // Codes and strobes of those in the mask.
  void issue(const BlockFunctions& functions, uint32_t mask, bool turning);
  // At the beginning of a PLC cycle: the strobes of the last one fall.
  void dropStrobes() { handshake_.dropStrobes(links_.signals); }
  // Those whose acknowledge is 0.
  uint32_t unacknowledged(uint32_t mask) const;

private:
  int32_t codeOf(const BlockFunctions& functions, uint32_t line, bool turning) const;
  void selectRange(const BlockFunctions& functions);
  void showPlace(int32_t type);

  Links& links_;
  uint32_t channel_;
  nc::NctFunctions handshake_;
  WordSignal spindle_{"CN_SSEL"}, range_{"CN_RNGREQ"}, magazine_{"CN_MGZNO"}, pot_{"CN_POTNO"};
  BitSignal toolExpired_{"CN_TLLE"};
  ChannelParameters parameters_;
};

} // namespace rung::sim::nct
