// Timers, counters and edges (§7.2, §7.4, §7.13).
#include <string>
#include <utility>

#include "frontend/lower/operations.h"
#include "frontend/network/lower/functions.h"

namespace rung::frontend::network {
namespace {

using ir::Type;
using ir::ValueId;

constexpr int64_t kNotRunning = INT64_MIN / 2; // elapsed time of an idle timer: adding any gain leaves it negative
constexpr int64_t kLongAgo = INT64_MAX / 2;

// Time that a timer gains (P23): the time since it ran in this or the last scan. That is not always the time of a scan,
// because a jump may move the timer into another part of Level 2. If it was not reached for longer, it gains one scan
// time (P19).
ValueId gainOf(Lowering& f) {
  if (f.onceEachRun()) return f.scanTime();
  ir::RungBuilder& b = f.b;
  const ir::SlotId last = f.slot("last", Type::I64);
  const ValueId since = b.sub(b.now(), b.slotLoad(last));
  b.slotStore(last, b.now());
  return b.select(b.leS(since, f.sinceLastRun()), since, f.scanTime());
}

ValueId unitOf(Lowering& f, const Preset& preset) {
  ir::RungBuilder& b = f.b;
  if (!preset.code) return b.constant(Type::I64, preset.units.front());
  std::string bytes;
  for (const int64_t unit : preset.units)
    for (uint32_t i = 0; i < 8; ++i) bytes += static_cast<char>(unit >> (8 * i));
  const ValueId code = b.zextOrTrunc(Type::I32, f.load(Type::I16, *preset.code));
  const ValueId known = b.select(b.ltU(code, b.i32(static_cast<int64_t>(preset.units.size()))), code, b.i32(0));
  return b.loadAt(Type::I64, f.constants(bytes, static_cast<uint32_t>(bytes.size() - 7)), b.mul(known, b.i32(8)));
}

// In microseconds.
ValueId valueOf(Lowering& f, const Preset& preset) {
  if (!preset.word) return f.b.constant(Type::I64, preset.us);
  const ValueId unit = unitOf(f, preset);
  return f.b.mul(f.b.zextOrTrunc(Type::I64, f.load(Type::I16, *preset.word)), unit);
}

// For displays.
void describe(Lowering& f, ir::SlotId elapsed, const Preset& preset) {
  ir::Timer timer{.time = {.type = Type::I64, .slot = elapsed}};
  if (preset.word)
    timer.preset = f.wordCell(*preset.word);
  else
    timer.constant = preset.us;
  if (preset.code) timer.unit = f.wordCell(*preset.code);
  timer.unitsUs.assign(preset.units.begin(), preset.units.end());
  f.addTimer(std::move(timer));
}

// Whether `condition` has been 1 for the preset. `elapsed` is the time that it has been.
ValueId lasts(Lowering& f, ValueId condition, ir::SlotId elapsed, const Preset& preset) {
  ir::RungBuilder& b = f.b;
  describe(f, elapsed, preset);
  const auto grow = [&] {
    const ValueId limit = valueOf(f, preset);
    const ValueId gain = gainOf(f);
    const ValueId grown = b.add(b.slotLoad(elapsed), gain);
    b.slotStore(elapsed, grown);
    const ValueId zero = b.constant(Type::I64, 0);
    const auto begin = [&] {
      b.slotStore(elapsed, zero);
      return zero;
    };
    return b.leS(limit, b.choose(b.ltS(grown, zero), begin, [&] { return grown; }, ir::kSeldom));
  };
  return b.choose(condition, grow, [&] {
    b.slotStore(elapsed, b.constant(Type::I64, kNotRunning));
    return b.bit(false);
  });
}

} // namespace

void onDelay(Lowering& f, const Preset& preset) {
  f.setOutput(lasts(f, f.act(), f.slot("elapsed", Type::I64, kNotRunning), preset));
}

// W is 0 when ACT has been 0 for the preset, and after power-on.
void offDelay(Lowering& f, const Preset& preset) {
  f.setOutput(f.b.not_(lasts(f, f.b.not_(f.act()), f.slot("elapsed", Type::I64, kLongAgo), preset)));
}

void ringCounter(Lowering& f, const RingCounter& counter) {
  ir::RungBuilder& b = f.b;
  const Address value = counter.value;
  const ValueId cn0 = f.condition(0), down = f.condition(1), reset = f.condition(2);

  // P28: the edge is evaluated in every scan; CTRC keeps it in bit 0 of register +2.
  ValueId before;
  if (counter.keepsEdge) {
    const Address edge{value.area, value.byte + 2, 0, true};
    before = f.load(Type::Bit, edge);
    f.store(edge, f.act());
  } else {
    before = frontend::exchange(b, f.slot("edge", Type::Bit), f.act());
  }
  const ValueId pulse = frontend::edge(b, before, f.act());
  const ir::SlotId w = f.slot("W", Type::Bit);

  // These are branches because the direction of a counter rarely changes.
  const auto bottom = [&] { return b.zextOrTrunc(Type::I16, cn0); }; // P26
  const auto& top = counter.preset;
  const auto startAgain = [&] {
    f.store(value, b.choose(down, top, bottom));
    return b.bit(false);
  };
  // Counts from one end to the other, then starts again.
  const auto count = [&](ValueId from, ValueId to, ValueId isOver, ValueId next) {
    const ValueId now = b.select(isOver, from, next);
    f.store(value, now);
    return b.eq(now, to); // P27
  };
  const auto step = [&] {
    const ValueId old = f.load(Type::I16, value);
    const ValueId one = b.constant(Type::I16, 1);
    const auto up = [&] {
      const ValueId end = top();
      return count(bottom(), end, b.leU(end, old), b.add(old, one));
    };
    const auto downward = [&] {
      const ValueId end = bottom();
      return count(top(), end, b.leU(old, end), b.sub(old, one));
    };
    return b.choose(down, downward, up);
  };
  const auto kept = [&](ValueId out) {
    b.slotStore(w, out);
    return out;
  };
  const auto go = [&] {
    return b.choose(pulse, [&] { return kept(step()); }, [&] { return b.slotLoad(w); }, ir::kSeldom);
  };
  f.setOutput(b.choose(reset, [&] { return kept(startAgain()); }, go, ir::kSeldom));
}

// P39: the edge state belongs to the instruction.
void lowerEdge(Lowering& f) { f.setOutput(frontend::pulse(f.b, f.slot("edge", Type::Bit), f.act(), f.variant())); }

} // namespace rung::frontend::network
