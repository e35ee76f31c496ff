// The parameters of the control: MR 31, 32, MW 34, 35 (man. 6.20) and the PLC constants in the NC area (man. 7.11).
// Other topics read the parameters that concern them. A warm start keeps values that the program wrote.
#pragma once
#include <array>
#include <vector>

#include "rtlib/nc/nct/parameters.h"
#include "sim/nct/topic.h"

namespace rung::sim::nct {

// A parameter that a topic reads in the scan, looked up once.
class ParameterPlace {
public:
  explicit ParameterPlace(uint32_t number);

private:
  friend class Parameters;
  uint32_t first_ = 0; // index into Parameters::values_
  uint32_t count_ = 0;
};

class Parameters final : public Topic {
public:
  explicit Parameters(Links& links);

  // `index` counts axes, spindles, channels … from 0; global parameters have only index 0. Outside the table the value
  // is 0.
  int32_t dword(const ParameterPlace& place, uint32_t index = 0) const {
    return index < place.count_ ? static_cast<int32_t>(values_[place.first_ + index]) : 0;
  }
  bool bit(const ParameterPlace& place, uint32_t bit, uint32_t index = 0) const {
    return ((static_cast<uint32_t>(dword(place, index)) >> bit) & 1) != 0;
  }
  double real(const ParameterPlace& place, uint32_t index = 0) const {
    return index < place.count_ ? values_[place.first_ + index] : 0;
  }
  // Increases with each change: values computed from parameters must then be computed again.
  uint32_t revision() const { return revision_; }
  // Only for Topic::config: sets values that a topic determines while it is configured (the axes that exist).
  void setInitial(uint32_t number, uint32_t index, double value);

  bool serves(bool write, uint32_t function) const override;
  std::optional<int32_t> service(uint32_t function, Block& block) override;
  Handled config(std::string_view key, std::string_view value) override;
  std::span<const std::string_view> events() const override {
    static constexpr std::string_view kEvents[] = {"damage_parameters"};
    return kEvents;
  }
  Handled event(std::string_view name, const std::vector<NcArgument>& keys) override;
  std::optional<double> quantity(std::string_view name) const override;
  Handled setQuantity(std::string_view name, double value) override;
  void powerOn(nc::PowerOn kind) override;
  void retain(Retained& retained) override;

  template <class Archive>
  void state(Archive& archive) {
    archive(checksum_);
    archive.each(values_);
    if constexpr (Archive::kLoads) ++revision_;
  }

private:
  struct Found {
    const nc::nct::ParameterRow* row = nullptr;
    uint32_t first = 0; // index into values_
    uint32_t count = 0; // number of values from the index on
    int32_t code = 0;   // execution code; 0: found
  };
  Found find(int32_t number, int32_t index) const;
  std::string setConfigured(const std::vector<uint32_t>& key, double value, std::vector<double>& values);
  uint32_t checksum() const;
  void changed();
  void writeConstants() const;

  // A double holds every value of a double word or of bits exactly.
  std::vector<double> values_;
  std::vector<double> initial_;         // as delivered, with the configuration applied
  uint32_t checksum_ = 0;               // of values_; recomputed after every change
  uint32_t revision_ = 1;               // initially unseen by all users
  std::vector<BitSignal> constantBits_; // N_P00 to N_P77
  WordSignal constantWords_{"N_PDW1"};
  RealSignal constantReals_{"N_PDB1"};
};

// The common macro variables of the channels, #100-#499 volatile, #500-#999 non-volatile (man. 6.16), and the variables
// that are signals: #1000-#1035 from the PLC, #1100-#1135 to it (man. 7.15).

class Macros final : public Topic {
public:
  using Topic::Topic;

  // MACR and MACW: variables 100 to 999, channels from 0. Nothing, false: wrong variable or channel. The instruction
  // itself checks that P_MAC permits writing (l.8121), because it must use the bit of the current cycle.
  std::optional<double> read(int64_t variable, int64_t channel) const;
  bool write(int64_t variable, int64_t channel, double value);

  // Variables for part programs: #100-#999, #1000-#1035 (read only), #1100-#1135.
  std::optional<double> programRead(uint32_t variable, uint32_t channel) const;
  bool programWrite(uint32_t variable, uint32_t channel, double value);

  std::optional<double> quantity(std::string_view name) const override;
  Handled setQuantity(std::string_view name, double value) override;
  void powerOn(nc::PowerOn kind) override;
  void retain(Retained& retained) override;

  template <class Archive>
  void state(Archive& archive) {
    archive(volatile_, retained_);
  }

private:
  static constexpr uint32_t kFirst = 100;
  static constexpr uint32_t kFirstRetained = 500;
  static constexpr uint32_t kLast = 999;
  static constexpr uint32_t kVolatile = kFirstRetained - kFirst;
  static constexpr uint32_t kRetainedVariables = kLast - kFirstRetained + 1;

  double& place(uint32_t variable, uint32_t channel) {
    return variable < kFirstRetained ? volatile_[channel][variable - kFirst]
                                     : retained_[channel][variable - kFirstRetained];
  }

  std::array<std::array<double, kVolatile>, nc::nct::kChannels> volatile_{};
  std::array<std::array<double, kRetainedVariables>, nc::nct::kChannels> retained_{};
  WordSignal bitsToProgram_{"CP_1032"};
  RealSignal toProgram_[3] = {RealSignal("CP_1033"), RealSignal("CP_1034"), RealSignal("CP_1035")};
  WordSignal bitsToPlc_{"CN_1132"};
  RealSignal toPlc_[3] = {RealSignal("CN_1133"), RealSignal("CN_1134"), RealSignal("CN_1135")};
};

// The 1024 non-volatile double words of controls that do not retain PLCNVRAM themselves: MR 10 and MW 11 (man. 6.19).

inline constexpr int32_t kNvramWords = 1024;

class Nvram final : public Topic {
public:
  explicit Nvram(Links& links);

  bool serves(bool write, uint32_t function) const override;
  std::optional<int32_t> service(uint32_t function, Block& block) override;
  std::span<const std::string_view> events() const override {
    static constexpr std::string_view kEvents[] = {"damage_nvram"};
    return kEvents;
  }
  Handled event(std::string_view name, const std::vector<NcArgument>& keys) override;
  std::optional<double> quantity(std::string_view name) const override;
  Handled setQuantity(std::string_view name, double value) override;
  void powerOn(nc::PowerOn kind) override;
  void retain(Retained& retained) override;

  template <class Archive>
  void state(Archive& archive) {
    archive(words_, checksum_);
  }

private:
  std::array<int32_t, kNvramWords> words_{};
  uint32_t checksum_ = 0;
};

// MW 40: selects a part program by its number for automatic mode (man. 6.21).

class ProgramSelection final : public Topic {
public:
  using Topic::Topic;
  bool serves(bool write, uint32_t function) const override;
  std::optional<int32_t> service(uint32_t function, Block& block) override;

private:
  BitSignal start_{"CN_START"};
  BitSignal stop_{"CN_STOP"};
};

} // namespace rung::sim::nct
