// Timers and counters (man. ch. 3.11).
#include "frontend/dialects/technol/lower/lower.h"
#include "frontend/dialects/technol/lower/lowering.h"
#include "frontend/lower/edge.h"

namespace rung::frontend::technol {

using ir::Type;
using ir::ValueId;

// RLO = 0 clears the count; else it counts up to the preset in DR, and RLO says that it is there (man. l.884-916).
void lowerTimer(Lowering& l, std::span<const Operand> o, int) {
  ir::RungBuilder& b = l.b();
  const CountCell cell = l.countCell(o[0]);
  const ValueId rlo = l.r().rlo();
  const ValueId preset = l.r().dr(cell.type);
  const auto run = [&] {
    const ValueId count = l.state.load(cell);
    const auto further = [&] {
      l.state.store(cell, b.add(count, b.constant(cell.type, 1)));
      return b.bit(false);
    };
    return b.choose(b.ltU(count, preset), further, [&] { return b.bit(true); });
  };
  const auto clear = [&] {
    l.state.store(cell, b.constant(cell.type, 0));
    return b.bit(false);
  };
  l.r().setRlo(b.choose(rlo, run, clear));
}

// Counts on 0 -> 1 of RLO; then RLO says whether the count is the preset in DR, and DR is the count (man. l.955-977).
void lowerCounter(Lowering& l, std::span<const Operand> o, int kind) {
  ir::RungBuilder& b = l.b();
  const CountCell cell = l.countCell(o[0]);
  const ir::SlotId former = l.ownSlot(Type::Bit);
  const ValueId rlo = l.r().rlo();
  const ValueId rises = edge(b, b.slotLoad(former), rlo);
  b.slotStore(former, rlo);
  const ValueId count = l.state.load(cell);
  const auto step = [&] {
    const ValueId one = b.constant(cell.type, 1);
    ValueId next = kind == kCountDown ? b.sub(count, one) : b.add(count, one);
    if (kind == kCountUpBcd) next = b.bcdEncode(b.add(b.bcdDecode(count), one));
    l.state.store(cell, next);
    return next;
  };
  const ValueId now = b.choose(rises, step, [&] { return count; });
  l.r().setRlo(b.eq(now, l.r().dr(cell.type)));
  l.r().setDr(b.zextOrTrunc(Type::I64, now));
}

} // namespace rung::frontend::technol
