// Timers, counters and edges (§7.2, §7.4, §7.13).
#include "frontend/dialects/gsk/config.h"
#include "frontend/dialects/gsk/lower/lower.h"
#include "frontend/lower/edge.h"

namespace rung::gsk {
namespace {

using ir::Type;
using ir::ValueId;

constexpr int64_t kNotRunning = -1; // as the elapsed time

// The preset in microseconds.
ValueId presetOf(FunctionLowering& f) {
  constexpr int64_t kUsPerMs = 1000;
  constexpr int64_t kAccuracyMs[] = {8, 48, 1000}; // man. l.1199-1202
  const auto word = [&](const network::Address& address, int64_t unitMs) {
    return f.b.mul(f.b.zextOrTrunc(Type::I64, f.load(Type::I16, address)), f.b.constant(Type::I64, unitMs * kUsPerMs));
  };
  const int64_t first = f.param(0).value;
  switch (f.variant()) {
  case kTimerPage: return word(timerPreset(first), timerUnitMs(first));
  case kTimerMemory: return word(f.param(1).address, kAccuracyMs[first]);
  default: return f.b.constant(Type::I64, f.param(1).value / 8 * 8 * kUsPerMs); // man. l.1152
  }
}

// P23. A timer gains the time since it ran in this or in the last scan: not always the scan's, for a jump may bring it
// into another part of Level 2. When it was not reached for a while it gains one scan's time (P19).
ValueId gainOf(FunctionLowering& f) {
  if (f.onceEachRun()) return f.scanTime();
  ir::RungBuilder& b = f.b;
  const ir::SlotId last = f.slot("last", Type::I64);
  const ValueId since = b.sub(b.now(), b.slotLoad(last));
  b.slotStore(last, b.now());
  return b.select(b.leS(since, f.sinceLastRun()), since, f.scanTime());
}

} // namespace

void lowerTimer(FunctionLowering& f) {
  ir::RungBuilder& b = f.b;
  const ir::SlotId elapsed = f.slot("elapsed", Type::I64, kNotRunning);
  const auto grow = [&] {
    const ValueId preset = presetOf(f);
    const ValueId gain = gainOf(f);
    const ValueId before = b.slotLoad(elapsed);
    const ValueId zero = b.constant(Type::I64, 0);
    const ValueId grown = b.add(before, gain);
    const ValueId time = b.select(b.ltS(before, zero), zero, grown);
    b.slotStore(elapsed, time);
    return b.leS(preset, time);
  };
  f.setOutput(b.choose(f.act(), grow, [&] {
    b.slotStore(elapsed, b.constant(Type::I64, kNotRunning));
    return b.bit(false);
  }));
}

void lowerCounter(FunctionLowering& f) {
  ir::RungBuilder& b = f.b;
  const bool inMemory = f.variant() == kCounterMemory;
  const network::Address preset = inMemory ? f.param(0).address : counterPreset(f.param(0).value);
  network::Address value = inMemory ? f.param(1).address : counterValue(f.param(0).value);
  const ValueId cn0 = f.condition(0), down = f.condition(1), reset = f.condition(2);

  // P28: the edge is followed in every scan; CTRC keeps it in bit 0 of register +2.
  ValueId before;
  if (inMemory) {
    const network::Address edge{value.area, value.byte + 2, 0, true};
    before = f.load(Type::Bit, edge);
    f.store(edge, f.act());
  } else {
    before = frontend::exchange(b, f.slot("edge", Type::Bit), f.act());
  }
  const ValueId pulse = frontend::edge(b, before, f.act());
  const ir::SlotId w = f.slot("W", Type::Bit);
  const ValueId keep = b.slotLoad(w);

  const auto step = [&] {
    const ValueId top = f.load(Type::I16, preset);
    const ValueId bottom = b.zextOrTrunc(Type::I16, cn0); // P26
    const ValueId old = f.load(Type::I16, value);
    const ValueId one = b.constant(Type::I16, 1);
    const ValueId up = b.select(b.leU(top, old), bottom, b.add(old, one));
    const ValueId downward = b.select(b.leU(old, bottom), top, b.sub(old, one));
    const ValueId next = b.select(down, downward, up);
    const ValueId arrived = b.eq(next, b.select(down, bottom, top)); // P27
    f.store(value, b.select(reset, b.select(down, top, bottom), next));
    const ValueId out = b.and_(arrived, b.not_(reset));
    b.slotStore(w, out);
    return out;
  };
  f.setOutput(b.choose(b.or_(reset, pulse), step, [&] { return keep; }));
}

// P39: the memory belongs to the instruction.
void lowerEdge(FunctionLowering& f) {
  f.setOutput(frontend::pulse(f.b, f.slot("edge", Type::Bit), f.act(), f.variant() == kRising));
}

} // namespace rung::gsk
