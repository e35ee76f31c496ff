// The common macro variables of the channels, #100-#499 volatile, #500-#999 kept (man. 6.16), and the variables that
// are signals: #1000-#1035 from the PLC, #1100-#1135 to it (man. 7.15).
#pragma once
#include <array>

#include "rtlib/nc/nct/parameters.h"
#include "sim/nct/topic.h"

namespace rung::sim::nct {

class Macros final : public Topic {
public:
  using Topic::Topic;

  // MACR and MACW: variables 100 to 999, channels from 0. Nothing, false: wrong variable or channel. That P_MAC forbids
  // writing (l.8121) is the instruction's own check: it sees the bit of this very cycle.
  std::optional<double> read(int64_t variable, int64_t channel) const;
  bool write(int64_t variable, int64_t channel, double value);

  // As a part program sees them: #100-#999, #1000-#1035 (read only), #1100-#1135.
  std::optional<double> programRead(uint32_t variable, uint32_t channel) const;
  bool programWrite(uint32_t variable, uint32_t channel, double value);

  std::optional<double> quantity(std::string_view name) const override;
  Handled setQuantity(std::string_view name, double value) override;
  void powerOn(nc::PowerOn kind) override;
  void keep(Kept& kept) override;

private:
  static constexpr uint32_t kFirst = 100;
  static constexpr uint32_t kFirstKept = 500;
  static constexpr uint32_t kLast = 999;
  static constexpr uint32_t kVolatile = kFirstKept - kFirst;
  static constexpr uint32_t kKeptVariables = kLast - kFirstKept + 1;

  double& place(uint32_t variable, uint32_t channel) {
    return variable < kFirstKept ? volatile_[channel][variable - kFirst] : kept_[channel][variable - kFirstKept];
  }

  std::array<std::array<double, kVolatile>, nc::nct::kChannels> volatile_{};
  std::array<std::array<double, kKeptVariables>, nc::nct::kChannels> kept_{};
  WordSignal bitsToProgram_{"CP_1032"};
  RealSignal toProgram_[3] = {RealSignal("CP_1033"), RealSignal("CP_1034"), RealSignal("CP_1035")};
  WordSignal bitsToPlc_{"CN_1132"};
  RealSignal toPlc_[3] = {RealSignal("CN_1133"), RealSignal("CN_1134"), RealSignal("CN_1135")};
};

} // namespace rung::sim::nct
