// M, S, T and auxiliary functions on their way from the channel handler to the PLC (man. l.9440-9560, 10500-10772): the
// codes, then the strobes for one PLC cycle; the PLC takes its acknowledge away and gives it back when it is done, and
// CP_FIN when all are.
#pragma once
#include <array>

#include "tools/sim/nct/channel_program.h"
#include "tools/sim/nct/channel_signals.h"
#include "tools/sim/nct/topic.h"

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
  ChannelFunctions(Links& links, uint32_t channel) : links_(links), channel_(channel) {}

  // One bit a function: M 0-7, S 8, T 9, auxiliary 10-12.
  static constexpr uint32_t kSpeed = 1 << 8;
  static constexpr uint32_t kTool = 1 << 9;
  static uint32_t mask(const BlockFunctions& functions);

  // Codes and strobes of those in the mask.
  void issue(const BlockFunctions& functions, uint32_t mask, bool turning);
  // At the beginning of a PLC cycle: the strobes of the last one fall.
  void dropStrobes();
  // Those whose acknowledge is 0.
  uint32_t unacknowledged(uint32_t mask) const;

private:
  void giveSpeed(const BlockFunctions& functions);
  void giveTool(int32_t code, bool turning);

  Links& links_;
  uint32_t channel_;
  uint32_t strobes_ = 0;

  BitSignal strobe_[13] = {BitSignal("CN_M1STB"),  BitSignal("CN_M2STB"),   BitSignal("CN_M3STB"),
                           BitSignal("CN_M4STB"),  BitSignal("CN_M5STB"),   BitSignal("CN_M6STB"),
                           BitSignal("CN_M7STB"),  BitSignal("CN_M8STB"),   BitSignal("CN_SSTB"),
                           BitSignal("CN_TSTB"),   BitSignal("CN_AUX1STB"), BitSignal("CN_AUX2STB"),
                           BitSignal("CN_AUX3STB")};
  BitSignal acknowledge_[13] = {BitSignal("CP_M1ACK"),  BitSignal("CP_M2ACK"),   BitSignal("CP_M3ACK"),
                                BitSignal("CP_M4ACK"),  BitSignal("CP_M5ACK"),   BitSignal("CP_M6ACK"),
                                BitSignal("CP_M7ACK"),  BitSignal("CP_M8ACK"),   BitSignal("CP_SACK"),
                                BitSignal("CP_TACK"),   BitSignal("CP_AUX1ACK"), BitSignal("CP_AUX2ACK"),
                                BitSignal("CP_AUX3ACK")};
  WordSignal code_[8] = {WordSignal("CN_M1C"), WordSignal("CN_M2C"), WordSignal("CN_M3C"), WordSignal("CN_M4C"),
                         WordSignal("CN_M5C"), WordSignal("CN_M6C"), WordSignal("CN_M7C"), WordSignal("CN_M8C")};
  WordSignal auxiliary_[3] = {WordSignal("CN_AUX1C"), WordSignal("CN_AUX2C"), WordSignal("CN_AUX3C")};
  WordSignal speed_{"CN_SC"}, spindle_{"CN_SSEL"}, range_{"CN_RNGREQ"};
  WordSignal tool_{"CN_TC"}, magazine_{"CN_MGZNO"}, pot_{"CN_POTNO"};
  BitSignal toolExpired_{"CN_TLLE"};
  ChannelParameters parameters_;
};

} // namespace rung::sim::nct
