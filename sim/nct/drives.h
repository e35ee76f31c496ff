// The drives: display data that the program writes with MW 81 (man. 6.24), the values of SCP's NCTDriveMess, and the
// status signals DN_… of drives that belong to an axis or a spindle (man. 7.7).
#pragma once
#include <array>
#include <vector>

#include "sim/nct/parameters.h"
#include "sim/nct/seen_signals.h"
#include "sim/nct/topic.h"

namespace rung::sim::nct {

inline constexpr uint32_t kDrives = 48;
// 0 speed [1/min], 1 current [A], 2 load [%], 3 bus voltage [V], 4 temperature [°C], 5 power [kW] (l.3383, l.4230).
inline constexpr uint32_t kDriveData = 6;

class Drives final : public Topic {
public:
  using Topic::Topic;

  // `drive` counts from 1. Returns the value that the program has written, otherwise that of the drive itself.
  double datum(uint32_t drive, uint32_t datum) const;

  bool serves(bool write, uint32_t function) const override;
  std::optional<int32_t> service(uint32_t function, Block& block) override;
  std::span<const std::string_view> events() const override {
    static constexpr std::string_view kEvents[] = {"drive"};
    return kEvents;
  }
  Handled event(std::string_view name, const std::vector<NcArgument>& keys) override;
  std::optional<double> quantity(std::string_view name) const override;
  void powerOn(nc::PowerOn kind) override;
  void timeSlice() override;

  template <class Archive>
  void state(Archive& archive) {
    archive(drives_);
    if constexpr (Archive::kLoads) seen_.forget();
  }

private:
  struct Drive {
    std::array<double, kDriveData> given{};
    std::array<bool, kDriveData> isGiven{};
    uint32_t errors = 0; // DN_ERR
    template <class Archive>
    void state(Archive& archive) {
      archive(given, isGiven, errors);
    }
  };
  void readAddresses();
  bool addressed(uint32_t drive) const;
  double speed(uint32_t drive) const;

  std::array<Drive, kDrives> drives_{};
  std::array<bool, kDrives> addressed_{}; // valid for `revision_`
  uint32_t revision_ = 0;
  SeenSignals seen_{WordSignal("DP_CTRL"), WordSignal("DN_STAT"), WordSignal("DN_ERR")};
  ParameterPlace axisAddress_{501};
  ParameterPlace spindleAddress_{601};
  BitSignal enable1_{"DP_ENA1"};
  BitSignal enable2_{"DP_ENA2"};
  BitSignal table1_{"DP_PRM1"};
  BitSignal table2_{"DP_PRM2"};
  BitSignal clearError_{"DP_ERRCLR"};
  BitSignal enabled_{"DN_ENA"};
  BitSignal ready_{"DN_RDY"};
  BitSignal activeTable1_{"DN_PRM1"};
  BitSignal activeTable2_{"DN_PRM2"};
  WordSignal errors_{"DN_ERR"};
  uint32_t written_ = BitSignal::masks({enabled_, ready_, activeTable1_, activeTable2_});
};

// The machine wiring: inputs that follow outputs or other inputs, such as a valve whose switch responds after a delay.
//   config follow.INP001.03 OUT010.00          the input is the output
//   config follow.INP001.04 /OUT010.00@100ms   its inverse, 100 ms later; shorter pulses are suppressed

class Wiring final : public Topic {
public:
  using Topic::Topic;
  Handled config(std::string_view key, std::string_view value) override;
  void powerOn(nc::PowerOn kind) override;
  void timeSlice() override;

  template <class Archive>
  void state(Archive& archive) {
    archive.each(wires_);
  }

private:
  struct Place {
    uint32_t word = 0;
    uint32_t bit = 0;
  };
  struct Wire {
    Place input, source;
    bool inverted = false;
    int64_t delayUs = 0;
    bool level = false; // of the source, since sinceUs
    int64_t sinceUs = 0;
    template <class Archive>
    void state(Archive& archive) {
      archive(level, sinceUs);
    }
  };
  static std::optional<Place> place(std::string_view name);

  std::vector<Wire> wires_;
};

} // namespace rung::sim::nct
