// Pallet management of the simulated NCT control (man. 6.27): the table, the services MW 300 to MR 309 and MW 41, and
// what the operator and the configuration write into the table. Parameters: N3300 #0 PAL, MNT (printed as #1, l.5311,
// and as #2, l.5335: either bit), #3 PRI; N3301 length of the pool; N3302 number of custom columns.
#pragma once
#include <string>
#include <vector>

#include "sim/nct/pallet_table.h"
#include "sim/nct/parameters.h"
#include "sim/nct/topic.h"

namespace rung::sim::nct {

class PalletManagement final : public Topic {
public:
  using Topic::Topic;

  bool serves(bool write, uint32_t function) const override;
  std::optional<int32_t> service(uint32_t function, Block& block) override;
  Handled config(std::string_view key, std::string_view value) override;
  std::span<const std::string_view> events() const override {
    static constexpr std::string_view kEvents[] = {"pallet"};
    return kEvents;
  }
  Handled event(std::string_view name, const std::vector<NcArgument>& keys) override;
  std::optional<double> quantity(std::string_view name) const override;
  Handled setQuantity(std::string_view name, double value) override;
  void powerOn(nc::PowerOn kind) override;
  void cycle() override;
  void keep(Kept& kept) override { table_.keep(kept); }

  const PalletTable& table() const { return table_; }
  PalletPlan plan() const;

private:
  struct Setting { // of the configuration, again at every cold start
    std::string name;
    double value;
  };

  bool locked() const; // P_PTTAB
  bool programsByNumber() const;
  bool hasColumn(int32_t number) const;
  int32_t checkPlace(PalletPlace place) const;

  int32_t interchange(Block& block);
  int32_t writePallet(Block& block);
  int32_t readPallet(Block& block);
  int32_t writeDatum(Block& block);
  int32_t readDatum(Block& block);
  int32_t search(Block& block);
  int32_t readColumn(Block& block);
  int32_t selectProgram(Block& block);
  // Columns of a record of so many words (from the identifier on); 0: code 2.
  uint32_t columnsOfRecord(int64_t words) const;
  int32_t checkWord(PalletColumn column, int32_t value, PalletPlace place) const;
  int32_t writePrograms(Block& block, PalletRow& row);
  // The identifier of a pallet that the virtual magazine knows brings its data, and takes the old ones there (l.5525).
  void identify(PalletPlace place, int32_t identifier);
  bool matches(PalletColumn column, int32_t value, const PalletRow& row) const;

  std::string editPlace(PalletPlace place, const std::vector<NcArgument>& keys);
  std::string setColumn(PalletPlace place, std::string_view name, double value);

  PalletTable table_;
  std::vector<Setting> settings_;
  bool editing_ = false; // N_PTEDT: the operator has a row open

  ParameterPlace control3300_{3300};
  ParameterPlace poolLength_{3301};
  ParameterPlace customColumns_{3302};
  BitSignal editingSignal_{"N_PTEDT"};
  BitSignal lockedSignal_{"P_PTTAB"};
  BitSignal automatic_{"CN_AUTO"};
};

} // namespace rung::sim::nct
