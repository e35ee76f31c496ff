// The pallet management table (man. 6.27.1, l.5305-5430): magazine 1 is the pool, 10 the working space, 11 the
// loading-unloading point; 0 is virtual, for the data of pallets that have left the machine. A place contains a pallet
// if it has an identifier; the status belongs to the place.
//
// Invariant: an identifier is in at most one place.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/nct/parameters.h"
#include "sim/nct/retained.h"
#include "sim/nct/topic.h"

namespace rung::sim::nct {

// Columns are the data numbers of MW 306 and MR 307 (l.5669-5682).
using PalletColumn = uint32_t;
inline constexpr PalletColumn kPalletId = 1;
inline constexpr PalletColumn kPalletStatus = 2;
inline constexpr PalletColumn kPalletPriority = 3;
inline constexpr PalletColumn kPalletExecuted = 4;
inline constexpr PalletColumn kPalletAssigned = 5;
inline constexpr PalletColumn kPalletPrograms = 6;
inline constexpr PalletColumn kPalletCustom1 = 7; // 8 bits; the next ones are doubles
inline constexpr PalletColumn kPalletColumns = 10;

inline constexpr uint32_t kPalletRows = 128; // of all magazines, l.5339
inline constexpr uint32_t kMaxPrograms = 64;
inline constexpr int32_t kMaxPalletId = 99'999'999;
inline constexpr int32_t kMaxPriority = 128;

// Status (l.5349-5379).
inline constexpr int32_t kPlaceEmpty = 1;
inline constexpr int32_t kPalletReady = 4;

inline constexpr uint32_t kVirtualMagazine = 0;
inline constexpr uint32_t kPoolMagazine = 1;
inline constexpr uint32_t kWorkingSpace = 10;
inline constexpr uint32_t kLoadingPoint = 11;

constexpr bool isRealPalletColumn(PalletColumn column) { return column > kPalletCustom1; }
constexpr uint32_t palletColumnWords(PalletColumn column) { return isRealPalletColumn(column) ? 2 : 1; }
// ID, STATUS, PRIORITY, EXECUTED, ASSIGNED, CUSTOM1-4; 0: no such column.
PalletColumn palletColumn(std::string_view name);

struct PalletRow {
  std::array<int32_t, kPalletCustom1 + 1> words{}; // by column
  std::array<double, 3> customs{};                 // columns 8 to 10
  std::array<int32_t, kMaxPrograms> programs{};

  PalletRow() { words[kPalletStatus] = kPlaceEmpty; }
  int32_t word(PalletColumn column) const { return words[column]; }
  bool hasPallet() const { return words[kPalletId] != 0; }

  template <class Archive>
  void state(Archive& archive) {
    archive(words, customs, programs);
  }
};

struct PalletPlace {
  uint32_t magazine = 0;
  uint32_t place = 0;
  bool operator==(const PalletPlace&) const = default;
};

// The magazines of the machine (N3300, N3301).
struct PalletPlan {
  bool enabled = false;
  bool loadingPoint = false;
  uint32_t pool = 0;

  // The places of a magazine are 1 to places(magazine).
  uint32_t places(uint32_t magazine) const;
  bool hasMagazine(uint32_t magazine) const { return places(magazine) != 0; }
  bool has(PalletPlace place) const { return place.place >= 1 && place.place <= places(place.magazine); }
};

class PalletTable {
public:
  // The row of a place in the plan.
  PalletRow& row(PalletPlace place);
  const PalletRow& row(PalletPlace place) const;

  // Searches the places in the plan.
  std::optional<PalletPlace> find(const PalletPlan& plan, int32_t identifier) const;
  std::optional<PalletPlace> freeVirtual(const PalletPlan& plan) const;

  void clear();
  void retain(Retained& retained);
  template <class Archive>
  void state(Archive& archive) {
    archive(rows_);
  }

private:
  uint32_t index(PalletPlace place) const;

  // Rows are fixed and independent of the plan: working space, loading point, pool, virtual magazine.
  static constexpr uint32_t kFirstPool = 2;
  static constexpr uint32_t kFirstVirtual = kFirstPool + kPalletRows;
  std::array<PalletRow, kFirstVirtual + kPalletRows> rows_;
};

// Pallet management of the simulated NCT control (man. 6.27): the table, the services MW 300 to MR 309 and MW 41, and
// changes of the table by the operator and the configuration. Parameters: N3300 #0 PAL, MNT (printed as #1, l.5311, and
// as #2, l.5335: either bit), #3 PRI; N3301 length of the pool; N3302 number of custom columns.

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
  void retain(Retained& retained) override { table_.retain(retained); }

  const PalletTable& table() const { return table_; }

  template <class Archive>
  void state(Archive& archive) {
    archive(table_, editing_);
  }
  PalletPlan plan() const;

private:
  struct Setting { // from the configuration, applied at every cold start
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
  // Number of columns in a record of `words` words (from the identifier on); 0: code 2.
  uint32_t columnsOfRecord(int64_t words) const;
  int32_t checkWord(PalletColumn column, int32_t value, PalletPlace place) const;
  int32_t writePrograms(Block& block, PalletRow& row);
  // Sets the identifier of a place: data of a pallet that the virtual magazine contains are restored, and the old data
  // are moved there (l.5525).
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
