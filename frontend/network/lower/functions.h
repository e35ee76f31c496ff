// Functions that several languages of this family have, for their rows. The parameters are in the order of GSK's
// inventory, which is FANUC's; § and P numbers are GSK's. Flags and the remainder of a division go to the result
// registers of the level (P22).
#pragma once
#include <functional>
#include <optional>
#include <vector>

#include "frontend/network/lower/lower_function.h"

namespace rung::frontend::network {

// Timers, counters, edges.

// The time that a timer runs.
struct Preset {
  std::optional<Address> word; // 2 bytes, in units; nothing: `us`
  std::optional<Address> code; // 2 bytes, which select the unit; a code that no unit has counts as 0. Nothing: as 0
  std::vector<int64_t> units = {1}; // microseconds
  int64_t us = 0;
};

// On-delay: W is 1 when ACT has been 1 for the preset, which is read only while ACT is 1 (P23).
void onDelay(Lowering& f, const Preset& preset);
// Off-delay: W is 1 while ACT is 1, and then for the preset.
void offDelay(Lowering& f, const Preset& preset);

// A ring counter with the conditions CN0, UPDOWN, RST, ACT.
struct RingCounter {
  std::function<ir::ValueId()> preset; // i16, unsigned
  Address value;                       // 2 bytes
  bool keepsEdge = false;              // bit 0 after the value holds ACT of the last run (P28); otherwise a slot does
};
void ringCounter(Lowering& f, const RingCounter& counter);

// The variant is a frontend::Edge.
void lowerEdge(Lowering& f);

// Transfers and bits.

void lowerDecode(Lowering& f);
void lowerMoveMasked(Lowering& f);
void lowerMoveOr(Lowering& f);
// The variant is the number of bytes.
void lowerMove(Lowering& f);
void lowerMoveBlock(Lowering& f);
void lowerNumber(Lowering& f);
// The variant is a frontend::Logic.
void lowerLogic(Lowering& f);
void lowerNot(Lowering& f);
void lowerShift(Lowering& f);
void lowerParity(Lowering& f);

// Arithmetic.

// Stores the flags zero, negative and overflow; the whole byte is rewritten. An invalid value is 0.
void storeFlags(Lowering& f, ir::ValueId zero, ir::ValueId negative, ir::ValueId overflow);
// The variant is a frontend::Arithmetic.
void lowerArithmetic(Lowering& f);
void lowerDivision(Lowering& f);
void lowerBcd(Lowering& f);

// Tables.

// The way of a turret or magazine (§7.5). Numbers are i64, positions are counted from 0.
struct Rotation {
  ir::ValueId count, current, target;
  ir::ValueId base; // number of the first position, for the result
  // Bits.
  ir::ValueId shorter; // the shorter way, otherwise always forward
  ir::ValueId before;  // one position before the target
  ir::ValueId asSteps; // the result is a number of steps
};
// Stores the result of one that is possible (P31); returns W, whether the way is reverse, otherwise as it was.
ir::ValueId rotate(Lowering& f, const Rotation& rotation, const std::function<void(ir::ValueId)>& store);
void lowerRotation(Lowering& f);
void lowerCodeTable(Lowering& f);
void lowerSearch(Lowering& f);
void lowerIndexedMove(Lowering& f);

} // namespace rung::frontend::network
