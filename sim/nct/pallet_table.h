// The pallet management table (man. 6.27.1, l.5305-5430): magazine 1 is the pool, 10 the working space, 11 the
// loading-unloading point; 0 is virtual: data of pallets that left the machine. A place holds a pallet if it has an
// identifier; the status belongs to the place.
//
// Invariant: an identifier is in one place at most.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "sim/nct/kept.h"

namespace rung::sim::nct {

// Columns are the data numbers of MW 306 and MR 307 (l.5669-5682).
using PalletColumn = uint32_t;
inline constexpr PalletColumn kPalletId = 1;
inline constexpr PalletColumn kPalletStatus = 2;
inline constexpr PalletColumn kPalletPriority = 3;
inline constexpr PalletColumn kPalletExecuted = 4;
inline constexpr PalletColumn kPalletAssigned = 5;
inline constexpr PalletColumn kPalletPrograms = 6;
inline constexpr PalletColumn kPalletCustom1 = 7; // 8 bits; then double
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
// ID, STATUS, PRIORITY, EXECUTED, ASSIGNED, CUSTOM1-4; 0: none such.
PalletColumn palletColumn(std::string_view name);

struct PalletRow {
  std::array<int32_t, kPalletCustom1 + 1> words{}; // by column
  std::array<double, 3> customs{};                 // columns 8 to 10
  std::array<int32_t, kMaxPrograms> programs{};

  PalletRow() { words[kPalletStatus] = kPlaceEmpty; }
  int32_t word(PalletColumn column) const { return words[column]; }
  bool hasPallet() const { return words[kPalletId] != 0; }
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

  // Places 1 to places(magazine).
  uint32_t places(uint32_t magazine) const;
  bool hasMagazine(uint32_t magazine) const { return places(magazine) != 0; }
  bool has(PalletPlace place) const { return place.place >= 1 && place.place <= places(place.magazine); }
};

class PalletTable {
public:
  // Of a place of the plan.
  PalletRow& row(PalletPlace place);
  const PalletRow& row(PalletPlace place) const;

  // In the places of the plan.
  std::optional<PalletPlace> find(const PalletPlan& plan, int32_t identifier) const;
  std::optional<PalletPlace> freeVirtual(const PalletPlan& plan) const;

  void clear();
  void keep(Kept& kept);

private:
  uint32_t index(PalletPlace place) const;

  // Fixed places, whatever the plan: working space, loading point, pool, virtual magazine.
  static constexpr uint32_t kFirstPool = 2;
  static constexpr uint32_t kFirstVirtual = kFirstPool + kPalletRows;
  std::array<PalletRow, kFirstVirtual + kPalletRows> rows_;
};

} // namespace rung::sim::nct
