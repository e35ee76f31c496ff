// Tool management of the simulated NCT control (man. 6.26): the tables, the services MW 100 to MR 108, changes of the
// tables by the operator and the configuration, and the signals of life management. Channels use it to find a tool.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "sim/nct/parameters.h"
#include "sim/nct/tool_life.h"
#include "sim/nct/tool_table.h"
#include "sim/nct/topic.h"

namespace rung::sim::nct {

struct ToolSignals {
  BitSignal searching{"N_TLSRCH"};
  BitSignal modified{"N_TLMD"};
  BitSignal saving{"N_TLSV"};
  BitSignal editing{"N_TLEDT"};
  BitSignal locked{"P_TLTAB"};
  BitSignal individual{"SN_TLCHI"};
  BitSignal group{"SN_TLCH"};
  BitSignal skipDone{"SN_TLSKPA"};
  BitSignal notice{"SN_TLNL"};
  BitSignal individualDone{"SP_TLCHIA"};
  BitSignal groupDone{"SP_TLCHA"};
  BitSignal skip{"SP_TLSKP"};
  BitSignal countDisabled{"SP_TLCD"};
  uint32_t requests = BitSignal::masks({individual, group, skipDone, notice});
};

class ToolManagement final : public Topic {
public:
  explicit ToolManagement(Links& links);

  bool serves(bool write, uint32_t function) const override;
  std::optional<int32_t> service(uint32_t function, Block& block) override;
  Handled config(std::string_view key, std::string_view value) override;
  std::span<const std::string_view> events() const override {
    static constexpr std::string_view kEvents[] = {"tool"};
    return kEvents;
  }
  Handled event(std::string_view name, const std::vector<NcArgument>& keys) override;
  std::optional<double> quantity(std::string_view name) const override;
  Handled setQuantity(std::string_view name, double value) override;
  void powerOn(nc::PowerOn kind) override;
  void cycle() override;
  void retain(Retained& retained) override;

  // For the channels. `spindle` counts from 0.
  bool managed() const;                     // N2900 #0 TMU
  ToolPick pick(int32_t type);              // for a T code; N_TLSRCH is set in the next cycle
  bool countsT() const { return countsT_; } // uses are counted at T instead of M06
  void countUse(uint32_t spindle) { life_.countUse(spindle); }
  void countTime(uint32_t spindle, int64_t us) { life_.countTime(spindle, us); }

  const ToolTables& tables() const { return tables_; }

  template <class Archive>
  void state(Archive& archive) {
    archive(tables_, life_, editing_, searching_, modified_, saving_);
  }

private:
  struct Setting { // from the configuration, applied at every cold start
    std::string name;
    double value;
  };

  void build();
  bool exists(uint32_t cartridge) const;
  int32_t checkPlace(PotPlace place, int32_t firstCode) const;
  // Finds the tool in the pot of words 2 and 3; returns an execution code.
  int32_t findTool(const Block& block, uint32_t& tool) const;
  bool locked() const; // P_TLTAB

  int32_t exchange(Block& block);
  int32_t searchPot(Block& block);
  int32_t registerTool(Block& block);
  int32_t writeTool(Block& block);
  int32_t readTool(Block& block);
  int32_t deleteTool(Block& block);
  bool hasDatumAmount(const Block& block) const;
  int32_t writeDatum(Block& block);
  int32_t readDatum(Block& block);
  int32_t searchUser(Block& block);
  int32_t checkRecord(const Block& block, ToolColumn columns) const;
  void writeRecord(const Block& block, ToolColumn columns, uint32_t dataNumber);
  bool sameDatum(ToolColumn column, const ToolRow& row, const Block& block) const;

  std::string configCartridge(uint32_t number, std::string_view value);
  std::string configTables(std::string_view key, double value);
  std::string editPattern(const std::vector<NcArgument>& keys);
  std::string editTool(const std::vector<NcArgument>& keys);
  std::string editRow(uint32_t dataNumber, const std::vector<NcArgument>& keys);
  std::string placeTool(uint32_t dataNumber, const std::vector<NcArgument>& keys);
  std::string setColumn(uint32_t dataNumber, ToolColumn column, double value);
  void showBusy();

  ToolTables tables_;
  ToolLife life_{tables_};
  PotFinder finder_;

  ToolSignals signals_;
  ParameterPlace programConfig_{1274};
  ParameterPlace toolConfig_{2900};
  ParameterPlace spindleMagazines_{2922};

  // Configuration
  uint32_t rows_ = 100;
  ToolLimits limits_;
  double increment_ = 0.001; // ISB, l.5247
  bool countsT_ = false;
  std::array<CartridgeShape, kMagazines> magazines_; // no pots: does not exist
  std::vector<Setting> settings_;

  bool editing_ = false;   // N_TLEDT: the operator has the tables open
  bool searching_ = false; // in the previous cycle
  bool modified_ = false;
  bool saving_ = false;
};

} // namespace rung::sim::nct
