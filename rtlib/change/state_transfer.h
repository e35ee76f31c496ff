// Transfers the state of a running program to another program of its dialect that replaces it. Cells of spaces keep
// their contents by address; a cell with a name keeps them at the new place of its name; state that the compiler made
// for an instruction (edges, times) follows its rung (rung_alignment.h). Cells that only the new program has start with
// their initial contents. So does everything without a name in a space whose addresses the compiler assigns
// (RUNG_SPACE_ALLOCATED).
//
// The plan is made outside real time and reports what it will do. Running it only copies bytes, in time proportional to
// the bytes of state.
//
// If a name has moved, its contents move with it, including all bytes that instructions reach through it
// (rung_symbol::reach); inputs are an exception, because the machine or the NC writes them. The former place starts
// anew, unless another name stays there. A new name starts anew if other names were at its place; if no name was there,
// or one of the same extent that is gone (it was renamed), it keeps the contents.
//
// An output that the old program wrote and the new one does not write starts anew, because no code would ever switch it
// off. Outputs are the spaces that only the program writes for the machine or the NC, and the safe-state spans.
//
// State whose key begins with @ is shared by all instructions, and held by one at a time: the instruction whose own
// slot, whose key ends with that key, is not 0. When that instruction is removed, the state is free again.
//
// Retained contents of an address that the new program does not retain are lost, unless a name takes them along: the
// report has them by areas.
//
// A mechanism continues at the same instruction. While it waits at an instruction that the new program does not have,
// the new program cannot take over.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rtlib/change/rung_alignment.h"
#include "rtlib/load/naming.h"
#include "rung/program.h"

namespace rung::runtime {

enum class ChangeKind : uint8_t {
  New,      // starts with its initial contents
  Removed,  // its contents are lost
  Moved,    // a cell at another place: keeps its contents; a shortened array or text keeps what fits
  Renamed,  // a cell with a new name: keeps its contents
  Retyped,  // a cell of another type: starts with its initial contents
  Released, // an output that the old program wrote and the new one does not: starts with its initial contents
  Cut,      // a cell at another place with less room: bytes that instructions reached past it are lost
};

inline constexpr std::string_view kChangeKinds[] = {"new", "removed", "moved", "renamed", "retyped", "released", "cut"};

struct StateChange {
  ChangeKind kind = ChangeKind::New;
  bool slot = false;      // made by the compiler; else a cell with a name
  std::string name;       // in the new program; if it was removed, in the old one: a name, or addresses, "D10 to D20"
  std::string formerName; // Renamed
};

class StateTransfer {
public:
  // Both programs have passed checkProgram and outlive the plan. Throws std::length_error if the spaces of one have 512
  // MB or more.
  StateTransfer(const rung_program& from, const rung_program& to, const Naming& naming = {});

  const rung_program& from() const { return *from_; }

  // The changes: cells sorted by name, then slots. State that keeps both contents and place is left out.
  std::span<const StateChange> changes() const { return changes_; }
  // The changed rungs in the order of the new program, then the removed ones.
  std::span<const RungChange> rungs() const { return rungs_; }
  uint32_t keptCells() const { return keptCells_; } // names that keep their place
  uint32_t keptSlots() const { return keptSlots_; }

  // The key of a mechanism of the old program that waits at an instruction which the new one does not have; null if
  // there is none. Allocates nothing.
  const char* waiting(const uint8_t* from) const noexcept;
  // Copies from the memory block of the old program to that of the new one, which holds its initial contents. Between
  // two scans, while no request waits. Allocates nothing.
  void run(const uint8_t* from, uint8_t* to) const noexcept;
  // The number of bytes that `run` writes.
  uint64_t bytes() const { return bytes_; }

  // For each of the first `bytes` bytes of the new program's block, whether `run` writes all of it.
  std::vector<bool> written(uint32_t bytes) const;
  // For each of the first `bytes` bytes of a block, whether it keeps its contents at its place.
  std::vector<bool> staying(uint32_t bytes) const;
  // This transfer without the bytes that stay: for two programs that share one block.
  StateTransfer without(const std::vector<bool>& staying) const;
  // The maximal spans of bytes that do not stay, within `count` bytes from `first`.
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

  // A mechanism's continuation: the new numbers that replace the number in its cell.
  struct Points {
    const char* key = nullptr;
    uint32_t from = 0; // offsets in the memory blocks; to: RUNG_NONE when the new program has no such mechanism
    uint32_t to = 0;
    uint32_t first = 0; // in numbers_
    uint32_t count = 0;
  };

  // A removed instruction, and the shared state that it may have held.
  struct Holder {
    uint32_t slot = 0; // in the former program's memory block
    uint32_t slotBytes = 0;
    uint32_t held = 0; // in the new program's
    uint32_t heldBytes = 0;
  };

  void countBytes();

  const rung_program* from_;
  std::vector<Holder> holders_;
  std::vector<Points> points_;
  std::vector<uint32_t> numbers_; // continuation points of the new program; RUNG_NONE: it has no such point
  std::vector<Move> moves_;
  std::vector<StateChange> changes_;
  std::vector<RungChange> rungs_;
  uint32_t keptCells_ = 0;
  uint32_t keptSlots_ = 0;
  uint64_t bytes_ = 0;
};

} // namespace rung::runtime
