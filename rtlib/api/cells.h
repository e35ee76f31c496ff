// The cells of an instance that its host has found by name: a number for each, and where it lies in the program that
// runs. A replacement has a second table for its program, made outside real time; what is found later is entered in
// both.
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

// How a cell is used in the program that runs.
enum class CellState : uint8_t {
  Good,
  Gone,        // the program does not have the name
  Overwritten, // for writing: another place is copied over it
  Constant,    // for writing
  Controls,    // for writing: the control itself writes it
  Released,    // nobody has its number
  Retyped,     // it was a real, a text or neither when it was found, and is not any more
};

// The type of one element.
rung_type typeOf(const runtime::Ref& ref);

struct LocatedCell {
  CellState state = CellState::Gone;
  bool writes = false; // as it was found
  rung_type type = RUNG_TYPE_BIT;
  runtime::Ref ref;
  core::Place place; // of the first element
};

struct CellName {
  std::string name;
  int32_t access = RUNG_READ; // enum rung_access, added up
  auto operator<=>(const CellName&) const = default;
};

// Where the cells of one program lie. Read by the scan thread while others are entered.
class CellTable {
public:
  static constexpr uint32_t kMostCells = 1 << 16;

  // `copies`: of this program; their lists outlive the table.
  CellTable(const rung_program& program, const core::NeededCopies& copies) : program_(&program), copies_(copies) {}
  const rung_program& program() const { return *program_; }

  // One of the cells lies where the copies leave something out.
  bool seesLeftOut() const noexcept { return seesLeftOut_.load(std::memory_order_relaxed); }

  // Null: no cell has this number.
  const LocatedCell* at(rung_cell cell) const noexcept {
    if (cell >= count_.load(std::memory_order_acquire)) return nullptr;
    return &(*blocks_[cell / kBlock])[cell % kBlock];
  }
  void add(const LocatedCell& cell);
  // Of a number that nobody uses.
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

// The names, and every table that has their places. For any thread, but not in real time: names are looked up under a
// lock.
class CellNames {
public:
  // The cell of this name, which has one more user; it is located in every table. `state` says what is wrong with it in
  // the program: then it is not entered, and gets no user. False: there are too many cells.
  bool find(const Environment& environment, const rung_program& program, const CellName& name, CellState& state,
            rung_cell& cell);
  // It has one more user, or one less. False: no cell has this number.
  bool hold(rung_cell cell);
  bool release(rung_cell cell);
  // As it was found; nothing where no cell has this number.
  std::optional<rung_type> typeOf(rung_cell cell);
  std::string nameOf(rung_cell cell); // of a cell that there is
  // Where it lies in the program; nothing where no cell has this number.
  std::optional<LocatedCell> locate(const Environment& environment, const rung_program& program, rung_cell cell);
  // From now on the table has all cells.
  void join(const Environment& environment, CellTable& table);
  void leave(CellTable& table);

private:
  struct Entry {
    CellName name;
    rung_type type = RUNG_TYPE_BIT; // as it was found
    uint32_t users = 0;             // 0: the number is free
  };
  bool isUsed(rung_cell cell) const { return cell < entries_.size() && entries_[cell].users != 0; }
  bool takeNumber(rung_cell& cell);

  std::mutex mutex_;
  std::map<CellName, rung_cell> numbers_; // of those that are used
  std::vector<Entry> entries_;            // by number
  std::vector<rung_cell> free_;
  std::vector<CellTable*> tables_;
};

// Where the name lies in a program; `as`: what it was when it was found.
LocatedCell locateCell(const Environment& environment, const rung_program& program, const CellName& name,
                       const rung_type* as = nullptr);

} // namespace rung::api
