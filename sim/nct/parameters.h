// The parameters of the control: MR 31, 32, MW 34, 35 (man. 6.20) and the PLC constants in the NC area (man. 7.11).
// Other topics read what concerns them. A warm start keeps what the program wrote.
#pragma once
#include <vector>

#include "rtlib/nc/nct/parameters.h"
#include "sim/nct/topic.h"

namespace rung::sim::nct {

// A parameter that a topic reads in the scan, found once.
class ParameterPlace {
public:
  explicit ParameterPlace(uint32_t number);

private:
  friend class Parameters;
  uint32_t first_ = 0; // in Parameters::values_
  uint32_t count_ = 0;
};

class Parameters final : public Topic {
public:
  explicit Parameters(Links& links);

  // `index` counts axes, spindles, channels … from 0; global parameters have index 0 alone. Outside the table: 0.
  int32_t dword(const ParameterPlace& place, uint32_t index = 0) const {
    return index < place.count_ ? static_cast<int32_t>(values_[place.first_ + index]) : 0;
  }
  bool bit(const ParameterPlace& place, uint32_t bit, uint32_t index = 0) const {
    return ((static_cast<uint32_t>(dword(place, index)) >> bit) & 1) != 0;
  }
  double real(const ParameterPlace& place, uint32_t index = 0) const {
    return index < place.count_ ? values_[place.first_ + index] : 0;
  }
  // Another number after each change: whoever keeps something made of parameters makes it anew then.
  uint32_t revision() const { return revision_; }
  // Against Topic::config alone: what a topic finds out while it is configured (the axes that exist).
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
  void keep(Kept& kept) override;

private:
  struct Found {
    const nc::nct::ParameterRow* row = nullptr;
    uint32_t first = 0; // in values_
    uint32_t count = 0; // from the index on
    int32_t code = 0;   // execution code; 0: found
  };
  Found find(int32_t number, int32_t index) const;
  std::string setConfigured(const std::vector<uint32_t>& key, double value, std::vector<double>& values);
  uint32_t checksum() const;
  void changed();
  void writeConstants() const;

  // A double holds every value of a double word or of bits exactly.
  std::vector<double> values_;
  std::vector<double> initial_;         // as delivered, with the configuration
  uint32_t checksum_ = 0;               // of values_, made anew by every change
  uint32_t revision_ = 1;               // nobody has seen it at first
  std::vector<BitSignal> constantBits_; // N_P00 to N_P77
  WordSignal constantWords_{"N_PDW1"};
  RealSignal constantReals_{"N_PDB1"};
};

} // namespace rung::sim::nct
