// The cells that the host of an instance has looked up by name: a number for each, and its place in the running
// program. A replacement has a second table, for its own program, made outside real time; cells that are looked up
// later are entered in both.
#pragma once
#include <array>
#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "rtlib/api/environment.h"
#include "rtlib/core/memory.h"
#include "rung/runtime.h"

namespace rung::api {

// Whether a cell can be used in the running program, or why not.
enum class CellState : uint8_t {
  Good,
  Gone,        // the program does not have the name
  Overwritten, // cannot be written: another place is copied over it
  Constant,    // cannot be written
  Controls,    // cannot be written: the control itself writes it
  Released,    // its number is not in use
  Retyped,     // its type differs from when it was looked up: real, text or neither
};

// The type of one element.
rung_type typeOf(const runtime::Ref& ref);

struct LocatedCell {
  CellState state = CellState::Gone;
  bool writes = false; // looked up for writing, too
  rung_type type = RUNG_TYPE_BIT;
  runtime::Ref ref;
  core::Place place; // of the first element
};

struct CellName {
  std::string name;
  int32_t access = RUNG_READ; // enum rung_access, combined
  auto operator<=>(const CellName&) const = default;
};

// The places of the cells in one program. The scan thread reads the table while other threads enter cells.
class CellTable {
public:
  static constexpr uint32_t kMostCells = 1 << 16;

  // `copies` belongs to this program; its lists outlive the table.
  CellTable(const rung_program& program, const core::NeededCopies& copies) : program_(&program), copies_(copies) {}
  const rung_program& program() const { return *program_; }

  // Whether a cell lies where process-image copies leave bytes out.
  bool seesLeftOut() const noexcept { return seesLeftOut_.load(std::memory_order_relaxed); }

  // The cell with this number, or null.
  const LocatedCell* at(rung_cell cell) const noexcept {
    if (cell >= count_.load(std::memory_order_acquire)) return nullptr;
    return &(*blocks_[cell / kBlock])[cell % kBlock];
  }
  void add(const LocatedCell& cell);
  // Replaces the cell of a number that is not in use.
  void set(rung_cell number, const LocatedCell& cell);

private:
  static constexpr uint32_t kBlock = 256;
  using Block = std::array<LocatedCell, kBlock>;

  const rung_program* program_;
  core::NeededCopies copies_;
  std::atomic<bool> seesLeftOut_{false};
  std::array<std::unique_ptr<Block>, kMostCells / kBlock> blocks_;
  std::atomic<uint32_t> count_{0};
};

// The names of the cells, and every table that has their places. Any thread, but not in real time: the look-up locks.
class CellNames {
public:
  // Looks up a name, adds a user to its cell, and enters its place in every table. If `state` says that the cell cannot
  // be used in the program, it is not entered and gets no user. False: there are too many cells.
  bool find(const Environment& environment, const rung_program& program, const CellName& name, CellState& state,
            rung_cell& cell);
  // Add or remove a user of a cell. False: no cell has this number.
  bool hold(rung_cell cell);
  bool release(rung_cell cell);
  // The type of the cell when it was looked up; nothing if no cell has this number.
  std::optional<rung_type> typeOf(rung_cell cell);
  std::string nameOf(rung_cell cell); // the cell must exist
  // The place of a cell in a program; nothing if no cell has this number.
  std::optional<LocatedCell> locate(const Environment& environment, const rung_program& program, rung_cell cell);
  // From now on the table contains all cells.
  void join(const Environment& environment, CellTable& table);
  void leave(CellTable& table);

private:
  struct Entry {
    CellName name;
    rung_type type = RUNG_TYPE_BIT; // at the look-up
    uint32_t users = 0;             // 0: the number is free
  };
  bool isUsed(rung_cell cell) const { return cell < entries_.size() && entries_[cell].users != 0; }
  bool takeNumber(rung_cell& cell);

  std::mutex mutex_;
  std::map<CellName, rung_cell> numbers_; // of the numbers in use
  std::vector<Entry> entries_;            // by number
  std::vector<rung_cell> free_;
  std::vector<CellTable*> tables_;
};

// The place of a name in a program; `as`: its type at the look-up.
LocatedCell locateCell(const Environment& environment, const rung_program& program, const CellName& name,
                       const rung_type* as = nullptr);

} // namespace rung::api
