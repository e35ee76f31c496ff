// States of mechanisms and of the block modules (man. ch. 4; §11.2 of the inventory has the formulas).
#include "frontend/dialects/technol/lower/lower.h"
#include "frontend/dialects/technol/lower/lowering.h"

namespace rung::frontend::technol {

using ir::Type;
using ir::ValueId;

namespace {

// Whether the unit waits: it is then left without changing its continuation, and its line shows the step it has
// reached.
ValueId waits(Lowering& l, int level) { return level == 0 ? l.b().not_(l.r().rlo()) : l.r().rlo(); }

// The time, limited to the width of the count: the wait ends at the latest when the count reaches its maximum.
ValueId timeFor(Lowering& l, const CountCell& cell, const Operand& operand) {
  const ValueId time = l.b().zextOrTrunc(Type::I32, l.memory.value(operand));
  if (cell.type != Type::I8 || operand.isConstant()) return time;
  const ValueId most = l.b().i32(UINT8_MAX);
  return l.b().select(l.b().ltU(most, time), most, time);
}

void showLineIf(Lowering& l, const Sequence& sequence, ValueId cond) {
  l.b().when(cond, [&] { l.sequences.storeLine(sequence, l.statement().line); });
}

} // namespace

void lowerMechInit(Lowering& l, std::span<const Operand> o, int) { l.sequences.initialise(o[0].index); }

void lowerEx(Lowering& l, std::span<const Operand>, int) {
  Sequence& s = l.sequences.current();
  const uint32_t next = l.sequences.newState(s);
  l.sequences.storeState(s, l.b().i32(next));
  l.sequences.storeLine(s, l.statement().line);
  l.emitter.out().jump(s.leave);
  l.emitter.out().bind(s.states[next]);
}

void lowerBex(Lowering& l, std::span<const Operand>, int) {
  Sequence& s = l.sequences.current();
  const uint32_t next = l.sequences.newState(s);
  l.sequences.storeState(s, l.b().i32(next));
  l.emitter.out().bind(s.states[next]);
}

void lowerExWhile(Lowering& l, std::span<const Operand>, int level) {
  Sequence& s = l.sequences.current();
  const uint32_t next = l.sequences.newState(s);
  const ValueId wait = waits(l, level);
  l.b().when(
      wait, [&] { l.sequences.storeLine(s, l.statement().line); }, [&] { l.sequences.storeState(s, l.b().i32(next)); });
  l.emitter.out().jump(s.leave, wait);
  l.emitter.out().bind(s.states[next]);
}

// TEX: at the t-th failure control continues at the error label, with the code, if any, in DR (man. l.2107-2131).
void lowerTimedEx(Lowering& l, std::span<const Operand> o, int level) {
  Sequence& s = l.sequences.current();
  const uint32_t error = l.jumpTarget(o[2]);
  ir::RungBuilder& b = l.b();
  const CountCell cell = l.countCell(o[0]);
  if (!cell.access.indexed) s.cells.push_back(cell);
  const uint32_t next = l.sequences.newState(s);
  const uint32_t errorState = l.sequences.stateOf(s, error);
  const ValueId wait = waits(l, level);
  const ValueId count = b.add(l.state.load(cell), b.constant(cell.type, 1));
  const ValueId time = timeFor(l, cell, o[1]);
  l.addTimer(cell, time);
  const ValueId late = b.and_(wait, b.leU(time, b.zextOrTrunc(Type::I32, count)));
  const ValueId stays = b.and_(wait, b.not_(late));
  l.state.store(cell, b.select(stays, count, b.constant(cell.type, 0)));
  l.sequences.storeState(s, b.select(stays, l.sequences.loadState(s), b.select(late, b.i32(errorState), b.i32(next))));
  if (o[3].given()) l.r().setDr(b.select(late, b.constant(Type::I64, o[3].value), l.r().dr(Type::I64)));
  showLineIf(l, s, stays);
  l.emitter.out().select(b.select(stays, b.i32(1), b.select(late, b.i32(2), b.i32(0))),
                         {s.states[next], s.leave, error});
  l.emitter.out().bind(s.states[next]);
}

// TIM: while the time runs, the continuation is the instruction itself (§11.2).
void lowerWait(Lowering& l, std::span<const Operand> o, int) {
  Sequence& s = l.sequences.current();
  const CountCell arriving = l.countCell(o[0]);
  if (!arriving.access.indexed) s.cells.push_back(arriving);
  const uint32_t waiting = l.sequences.newState(s, "waiting"), next = l.sequences.newState(s, "next");
  l.state.store(arriving, l.b().constant(arriving.type, 0));
  l.sequences.storeState(s, l.b().i32(waiting));
  l.sequences.storeLine(s, l.statement().line);
  l.emitter.out().jump(s.leave);
  l.emitter.out().bind(s.states[waiting]);

  ir::RungBuilder& b = l.b();
  CountCell cell = arriving;
  if (o[0].given()) cell.access = l.memory.reach(o[0]); // the index must be computed in this rung
  const ValueId count = b.add(l.state.load(cell), b.constant(cell.type, 1));
  const ValueId time = timeFor(l, cell, o[1]);
  l.addTimer(cell, time);
  const ValueId runs = b.ltU(b.zextOrTrunc(Type::I32, count), time);
  l.state.store(cell, b.select(runs, count, b.constant(cell.type, 0)));
  l.sequences.storeState(s, b.select(runs, b.i32(waiting), b.i32(next)));
  showLineIf(l, s, runs);
  l.emitter.out().jump(s.leave, runs);
  l.emitter.out().bind(s.states[next]);
}

} // namespace rung::frontend::technol
