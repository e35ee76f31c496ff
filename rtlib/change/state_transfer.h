// How the state of a running program goes over to another program of its dialect that takes its place. Cells of spaces
// keep their contents by address; a cell with a name keeps them where the name has gone; what the compiler made for an
// instruction (edges, times) goes where its rung has gone (rung_alignment.h). What the new program has and the old one
// had not starts with its initial contents. So does what has no name in a space whose addresses the compiler gives out
// (RUNG_SPACE_ALLOCATED).
//
// A plan is made outside real time and reports what it will do. Running it copies bytes, and nothing else: its time is
// in proportion to the bytes of state.
//
// A name whose cell was elsewhere takes its contents along, with all bytes that instructions reach through it
// (rung_symbol::reach), but for inputs, which the machine or the NC writes. Its
// former place starts anew, unless another name stays there. A name that is new starts anew where other names were
// before; where none was, or one of the same extent that is gone (it was renamed), it keeps what is there.
//
// An output that the old program wrote and the new one does not write starts anew: nobody would ever switch it off.
// Outputs are the spaces that the program alone writes for the machine or the NC, and what a fault clears.
//
// What all instructions share under a key that begins with @, and one of them holds at a time, is free again when that
// one is gone: it holds it while its own slot, whose key ends with that key, is not 0.
//
// A mechanism continues at the same instruction. While it waits at one that the new program does not have, the new
// program cannot take over.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rtlib/change/rung_alignment.h"
#include "rtlib/load/ref.h"
#include "rung/program.h"

namespace rung::runtime {

enum class ChangeKind : uint8_t {
  New,      // starts with its initial contents
  Removed,  // its contents are lost
  Moved,    // a cell that is elsewhere now: keeps its contents; of an array or text that is shorter now, those that fit
  Renamed,  // a cell that had another name: keeps its contents
  Retyped,  // of another type now: its contents are lost, it starts with its initial contents
  Released, // an output that the old program wrote and the new one does not: starts with its initial contents
  Cut,      // a cell that is elsewhere now, with less room there: what instructions reached beyond it is lost
};

inline constexpr std::string_view kChangeKinds[] = {"new", "removed", "moved", "renamed", "retyped", "released", "cut"};

struct StateChange {
  ChangeKind kind = ChangeKind::New;
  bool slot = false;      // made by the compiler; else a cell with a name
  std::string name;       // in the new program; of what is removed, in the old one
  std::string formerName; // Renamed
};

// A rung as drawn that is not the same in both programs.
struct RungChange {
  RungKind kind = RungKind::Changed; // of one that both have
  uint32_t before = RUNG_NONE;       // in the former program's table; RUNG_NONE: it is new
  uint32_t after = RUNG_NONE;        // in the new one's; RUNG_NONE: it was removed
};

// What a user of the program's dialect calls a place of it that has no name of its own.
using PlaceName = std::string (*)(const rung_program& program, const Ref& place);
// "Y+3", "Y+3.5".
std::string plainPlaceName(const rung_program& program, const Ref& place);

class StateTransfer {
public:
  // Both have passed checkProgram and outlive the plan. Throws std::length_error when the spaces of one have 512 MB or
  // more.
  StateTransfer(const rung_program& from, const rung_program& to, PlaceName nameOf = plainPlaceName);

  const rung_program& from() const { return *from_; }

  // Cells in the order of their names, then slots; what keeps its contents and its place is not among them.
  std::span<const StateChange> changes() const { return changes_; }
  // In the order of the new program, then those that were removed.
  std::span<const RungChange> rungs() const { return rungs_; }
  uint32_t keptCells() const { return keptCells_; } // names that stay where they are
  uint32_t keptSlots() const { return keptSlots_; }

  // The key of a mechanism of the old program that waits where the new one has no place for it; null: there is none.
  const char* waiting(const uint8_t* from) const noexcept;
  // From the block of the old program to that of the new one, which holds its initial contents. Between two passes of
  // the schedule; nothing waits. Allocates nothing.
  void run(const uint8_t* from, uint8_t* to) const noexcept;
  // What `run` writes.
  uint64_t bytes() const { return bytes_; }

  // Of the first `bytes` of the new program's block: which `run` writes as a whole.
  std::vector<bool> written(uint32_t bytes) const;
  // Of the first `bytes` of a block: which keep their contents where they are.
  std::vector<bool> staying(uint32_t bytes) const;
  // The same but for what stays at these: for two programs in one block.
  StateTransfer without(const std::vector<bool>& staying) const;
  // The longest spans of those of `count` bytes from `first` that do not stay.
  static std::vector<rung_span> leaving(const std::vector<bool>& staying, uint32_t first, uint32_t count);

private:
  friend class TransferPlanner;
  enum class MoveKind : uint8_t {
    Copy,   // `count` bytes
    Pack,   // `count` logical bytes, from eight bytes each
    Unpack, // `count` logical bytes, to eight bytes each
    Bit,    // bit `fromBit` of a byte to bit `toBit` of a byte, alone
  };
  struct Move {
    MoveKind kind = MoveKind::Copy;
    uint8_t fromBit = 0;
    uint8_t toBit = 0;
    uint32_t from = 0; // offsets in the memory blocks
    uint32_t to = 0;
    uint32_t count = 0;
  };
  static uint64_t bytesOf(const Move& move) {
    return move.kind == MoveKind::Unpack ? 8 * uint64_t{move.count} : move.count;
  }

  // By what the number in a continuation's cell is replaced.
  struct Points {
    const char* key = nullptr;
    uint32_t from = 0; // offsets in the memory blocks; to: RUNG_NONE when the new program has no such mechanism
    uint32_t to = 0;
    uint32_t first = 0; // in numbers_
    uint32_t count = 0;
  };

  // Of an instruction that is gone, and what it may have held.
  struct Holder {
    uint32_t slot = 0; // in the former program's memory block
    uint32_t slotBytes = 0;
    uint32_t held = 0; // in the new one's
    uint32_t heldBytes = 0;
  };

  void countBytes();

  const rung_program* from_;
  std::vector<Holder> holders_;
  std::vector<Points> points_;
  std::vector<uint32_t> numbers_; // of points in the new program; RUNG_NONE: it has none like it
  std::vector<Move> moves_;
  std::vector<StateChange> changes_;
  std::vector<RungChange> rungs_;
  uint32_t keptCells_ = 0;
  uint32_t keptSlots_ = 0;
  uint64_t bytes_ = 0;
};

} // namespace rung::runtime
