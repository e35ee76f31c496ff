// Draws the random elements of a work (see work.h).
#include "tools/bench/generated/work.h"

#include <algorithm>
#include <array>
#include <random>

#include "ir/support/check.h"

namespace rung::bench {
namespace {

constexpr uint64_t kSeed = 20260101;
constexpr uint32_t kInputs = 1024;
constexpr uint32_t kIndices = 16;
constexpr uint32_t kOperands = 48;
constexpr uint32_t kResults = 192;     // shared by further elements
constexpr uint32_t kArray = 50;        // number of rungs
constexpr uint32_t kPresetStepMs = 40; // a whole number of scans in each dialect
constexpr uint32_t kPresets = 8;       // number of different presets of counters
constexpr uint32_t kLongMs = 800'000;  // longer than any bench runs

constexpr std::array kKinds = {
    KindRow{Kind::Bits, "bits", "bit logic"},
    KindRow{Kind::Arrays, "arrays", "bit logic of arrays"},
    KindRow{Kind::TimersIdle, "timers-idle", "timers, idle"},
    KindRow{Kind::TimersRunning, "timers-running", "timers, running"},
    KindRow{Kind::Counters, "counters", "counters"},
    KindRow{Kind::Integers, "integers", "integer arithmetic"},
    KindRow{Kind::Reals, "reals", "floating-point arithmetic"},
    KindRow{Kind::Indexed, "indexed", "indexed addressing"},
    KindRow{Kind::Signals, "signals", "bit logic on NC signals"},
    KindRow{Kind::MechanismsIdle, "mechanisms-idle", "mechanisms, idle"},
    KindRow{Kind::MechanismsWaiting, "mechanisms-waiting", "mechanisms, waiting"},
    KindRow{Kind::Mechanisms, "mechanisms", "mechanisms"},
    KindRow{Kind::Full, "full", "full"},
};

// Random values of an element: initialised in braces, whose order of evaluation is the same for every compiler.
struct Two {
  Contact first{}, second{};
};
struct Timed {
  Contact in{};
  uint32_t presetMs = 0;
};

class Drawing {
public:
  explicit Drawing(Kind kind) : random_(kSeed) {
    work_.kind = kind;
    work_.inputs = kInputs;
  }

  Work run(uint32_t size) {
    switch (work_.kind) {
    case Kind::Bits:
    case Kind::Signals: many(size, [&] { logic(); }); break;
    case Kind::Arrays: arrays(size); break;
    case Kind::TimersIdle: resting(false, size, [&] { timer({firstHalf(), longMs()}); }); break;
    case Kind::TimersRunning: resting(true, size, [&] { timer({firstHalf(), longMs()}); }); break;
    case Kind::Counters: many(size, [&] { counter({input(), input()}); }); break;
    case Kind::Integers: many(size, [&] { integer(input()); }); break;
    case Kind::Reals: many(size, [&] { real(); }); break;
    case Kind::Indexed: many(size, [&] { indexed(); }); break;
    case Kind::MechanismsIdle: resting(false, size, [&] { mechanism({firstHalf(), secondHalf()}); }); break;
    case Kind::MechanismsWaiting: resting(true, size, [&] { mechanism({firstHalf(), secondHalf()}); }); break;
    case Kind::Mechanisms: many(size, [&] { mechanism({input(), input()}); }); break;
    case Kind::Full: full(size); break;
    }
    return std::move(work_);
  }

private:
  template <class Draw>
  void many(uint32_t size, Draw draw) {
    for (uint32_t i = 0; i < size; ++i) draw();
  }
  template <class Draw>
  void resting(bool first, uint32_t size, Draw draw) {
    work_.changes = false;
    work_.firstHalf = first;
    many(size, draw);
  }
  // Rungs of alarms and of their lamps in turn.
  void arrays(uint32_t size) {
    for (uint32_t i = 0; i < size; ++i) {
      if (i % kArray == 0) array_ = {.inputs = below(kInputs - kArray), .first = input(), .second = input()};
      const uint32_t coil = newCoil();
      if (i / kArray % 2 == 0)
        add({.op = Op::Logic,
             .parallel = true,
             .first = {array_.inputs + i % kArray},
             .second = {coil},
             .third = {array_.first.bit, true},
             .coil = coil});
      else
        add({.op = Op::Logic,
             .parallel = true,
             .first = {coil - kArray},
             .second = array_.first,
             .third = array_.second,
             .coil = coil});
    }
  }
  void full(uint32_t size) {
    for (uint32_t i = 0; i < size; ++i) {
      logic();
      if (i % 10 == 2) timer({any(), kPresetStepMs * (1 + below(25))});
      if (i % 10 == 4) counter({any(), any()});
      if (i % 10 == 6 || i % 10 == 8) integer(any());
    }
  }

  uint32_t below(uint32_t n) { return static_cast<uint32_t>(random_() % n); }
  Contact input() { return {below(kInputs), false}; }
  Contact any() { return {below(work_.bits()), false}; }                 // an input, or an earlier coil
  Contact contact() { return {below(work_.bits() + 1), below(3) == 0}; } // or the rung's own coil
  Contact firstHalf() { return {below(kInputs / 2), false}; }
  Contact secondHalf() { return {kInputs / 2 + below(kInputs / 2), false}; }
  uint32_t longMs() { return kLongMs + kPresetStepMs * below(1000); }
  void add(Element element) { work_.elements.push_back(element); }
  uint32_t newCoil() { return work_.inputs + work_.coils++; }

  void logic() {
    Element e{.op = Op::Logic};
    e.first = contact();
    e.second = contact();
    e.third = contact();
    e.parallel = below(2) == 0;
    e.coil = newCoil();
    add(e);
  }
  void timer(const Timed& drawn) {
    add({.op = Op::Timer, .first = drawn.in, .coil = newCoil(), .number = work_.timers++, .preset = drawn.presetMs});
  }
  void counter(const Two& drawn) {
    const uint32_t preset = 3 + below(kPresets);
    add({.op = Op::Counter,
         .first = drawn.first,
         .second = drawn.second,
         .coil = newCoil(),
         .number = work_.counters++,
         .preset = preset});
  }
  void needWords() {
    work_.indices = kIndices;
    work_.operands = kOperands;
  }
  uint32_t operand() { return kIndices + below(kOperands + work_.results); }
  uint32_t nextResult() {
    if (work_.results < kResults) return kIndices + kOperands + work_.results++;
    return kIndices + kOperands + results_++ % kResults;
  }
  void integer(Contact enable) {
    needWords();
    Element e{.first = enable, .a = operand(), .b = operand()};
    const uint32_t which = below(10);
    if (which < 8) {
      e.op = which < 4 ? Op::Add : which < 7 ? Op::Subtract : Op::Multiply;
      e.to = nextResult();
    } else {
      e.op = Op::Less;
      e.coil = newCoil();
    }
    add(e);
  }
  // From operands only, so that no result exceeds the range of a double, however long it runs.
  void real() {
    work_.realOperands = kOperands;
    Element e{.first = input(), .a = below(kOperands), .b = below(kOperands)};
    const uint32_t which = below(3);
    e.op = which == 0 ? Op::RealAdd : which == 1 ? Op::RealSubtract : Op::RealMultiply;
    if (work_.realResults < kResults)
      e.to = kOperands + work_.realResults++;
    else
      e.to = kOperands + results_++ % kResults;
    add(e);
  }
  void indexed() {
    needWords();
    work_.hasTables = true;
    Element e{.first = input(), .a = below(kIndices), .b = below(kTables)};
    if (below(2) == 0) {
      e.op = Op::TableRead;
      e.to = nextResult();
    } else {
      e.op = Op::TableWrite;
      e.to = operand();
    }
    add(e);
  }
  void mechanism(const Two& drawn) {
    add({.op = Op::Mechanism,
         .first = drawn.first,
         .second = drawn.second,
         .coil = newCoil(),
         .number = work_.mechanisms++});
  }

  struct Array {
    uint32_t inputs = 0; // index of the first of neighbours
    Contact first{}, second{};
  };

  std::mt19937_64 random_;
  Array array_;
  uint32_t results_ = 0;
  Work work_;
};

} // namespace

std::optional<Kind> kindFromName(std::string_view name) {
  for (const KindRow& row : kKinds)
    if (name == row.name) return row.kind;
  return std::nullopt;
}

const KindRow& rowOf(Kind kind) {
  const auto found = std::find_if(kKinds.begin(), kKinds.end(), [&](const KindRow& row) { return row.kind == kind; });
  RUNG_CHECK(found != kKinds.end(), "each kind has a row");
  return *found;
}

Work drawWork(Kind kind, uint32_t size) { return Drawing(kind).run(size); }

} // namespace rung::bench
