// Random modules (see random.h): declarations, routines and transfers. Rungs are filled by random_rung.cpp.
#include <algorithm>
#include <fmt/format.h>

#include "ir/core/ops.h"
#include "ir/core/parts.h"
#include "ir/support/check.h"
#include "tests/random/random.h"
#include "tests/random/random_rung.h"

namespace rung::ir {
namespace {

constexpr uint32_t kBackJumps = 3; // of one run of a routine
constexpr uint32_t kSpaceBytes = 64;

class RandomModule {
public:
  RandomModule(uint64_t seed, const RandomOptions& options) : random_(seed), options_(options) {
    RUNG_CHECK(options.routines >= 1 && options.rungs >= 1, "a module has a routine and a rung");
    module_.name = fmt::format("random {}", seed);
    module_.dialect = "random";
    module_.files = {"random.lad"};
  }

  Module run() {
    addSpaces();
    addSlots();
    module_.faults = {"budget", "trap 1", "trap 2"};
    module_.services = {"READ", "WRITE"};
    module_.messages = {{1, "first"}, {2, "second \"quoted\"\n"}};
    for (uint32_t i = 0; i < options_.routines; ++i)
      module_.routines.push_back({.name = fmt::format("R{}", i), .rungs = {}});
    for (uint32_t i = 0; i < options_.routines; ++i) fillRoutine(i);
    addTasks();
    return std::move(module_);
  }

private:
  // Small spaces, so that accesses overlap. X and Y are the ones whose bits may be expanded.
  void addSpaces() {
    const auto add = [&](std::string_view name, uint32_t unit, uint32_t flags, bool packed) {
      module_.spaces.push_back({.name = std::string(name),
                                .unitBytes = unit,
                                .units = kSpaceBytes / unit,
                                .flags = flags,
                                .packedOnly = packed});
    };
    add("X", 1, RUNG_SPACE_INPUT, false);
    add("Y", 1, RUNG_SPACE_OUTPUT, false);
    add("B", 1, 0, false);
    add("W", 2, 0, false);
    add("M", 4, 0, false);
    add("Q", 8, 0, true);
    add("@X", 1, RUNG_SPACE_HIDDEN, false);
    add("@mask", 1, RUNG_SPACE_HIDDEN, true);
    for (uint32_t i = 0; i < module_.spaces.size(); ++i)
      for (uint32_t n = random_.below(3); n > 0; --n) addInit(SpaceId{i});
    module_.retains.push_back({SpaceId{2}, random_.below(32), random_.between(1, 32)});
    module_.safeSpans.push_back({SpaceId{1}, 0, kSpaceBytes});
    addSymbols();
  }

  void addInit(SpaceId space) {
    Init init{.space = space, .byte = random_.below(kSpaceBytes - 8), .data = {}};
    for (uint32_t n = random_.between(1, 8); n > 0; --n) init.data.push_back(static_cast<uint8_t>(random_.next()));
    module_.inits.push_back(std::move(init));
  }

  void addSymbols() {
    for (uint32_t i = 0; i < 6; ++i) {
      Symbol symbol{
          .name = fmt::format("S{}", i), .comment = i == 0 ? "a comment" : "", .space = SpaceId{random_.below(6)}};
      const bool bit = random_.chance(70);
      symbol.byte = random_.below(kSpaceBytes - 8);
      symbol.bit = bit ? random_.below(8) : 0;
      symbol.type = bit ? uint32_t{RUNG_TYPE_BIT} : random_.between(RUNG_TYPE_I8, RUNG_TYPE_F64);
      module_.symbols.push_back(std::move(symbol));
    }
    module_.symbols.push_back({.name = "LIMIT", .type = RUNG_TYPE_I64, .flags = RUNG_SYMBOL_CONST, .value = -5});
  }

  void addSlots() {
    for (uint32_t i = 0; i < 10; ++i) {
      Slot slot;
      slot.type = randomType();
      slot.init = static_cast<int64_t>(random_.chance(50) ? random_.pick(boundaryValues(slot.type)) : 0);
      slot.key = fmt::format("slot {}", i);
      module_.slots.push_back(std::move(slot));
    }
    for (uint32_t i = 0; i < 4; ++i)
      module_.slots.push_back({.type = randomType(), .transient = true, .key = fmt::format("register {}", i)});
    firstCounter_ = static_cast<uint32_t>(module_.slots.size());
    for (uint32_t i = 0; i < options_.routines; ++i)
      module_.slots.push_back({.type = Type::I32, .key = fmt::format("jumps {}", i)});
  }

  Type randomType() {
    return static_cast<Type>(random_.between(static_cast<uint32_t>(Type::Bit),
                                             static_cast<uint32_t>(options_.floats ? Type::F64 : Type::I64)));
  }

  void fillRoutine(uint32_t routine) {
    const uint32_t count = random_.between(1, options_.rungs);
    for (uint32_t i = 0; i < count; ++i) {
      Rung rung;
      if (random_.chance(50)) rung.title = fmt::format("rung {}.{}", routine, i);
      if (random_.chance(20)) rung.sourceText = "--| |--\n  (S) \"Y0.1\"";
      rung.begin = {.file = FileIndex{0}, .line = 10 * i + 1, .column = random_.below(4)};
      rung.lastLine = 10 * i + random_.between(1, 9);
      rung.key = random_.next();
      rung.weight = random_.between(1, 9);
      RungBuilder builder(module_, rung);
      // Transient slots and the counter of backward jumps have a value before anything reads them.
      if (i == 0) reset(builder, routine);
      RandomRung filler(random_, options_, builder, slotsOf(firstCounter_));
      filler.fill();
      if (options_.jumps && random_.chance(40)) addTransfer(filler, builder, routine, i, count);
      setBranchWeights(rung);
      module_.routines[routine].rungs.push_back(std::move(rung));
    }
  }

  // Each kind, whether it is so or not.
  static void setBranchWeights(Rung& rung) {
    for (size_t i = 0; i < rung.ops.size(); ++i)
      if (rung.ops[i].code == OpCode::If) rung.ops[i].ref = static_cast<uint32_t>(i % (kSeldom + 1));
  }

  static std::vector<SlotId> slotsOf(uint32_t count) {
    std::vector<SlotId> slots;
    for (uint32_t i = 0; i < count; ++i) slots.push_back(SlotId{i});
    return slots;
  }

  void reset(RungBuilder& builder, uint32_t routine) {
    builder.slotStore(SlotId{firstCounter_ + routine}, builder.i32(0));
    if (routine != 0 && routine + 1 != options_.routines) return; // only the entries of tasks
    for (uint32_t i = 0; i < firstCounter_; ++i)
      if (module_.slots[i].transient) builder.slotStore(SlotId{i}, builder.constant(module_.slots[i].type, 0));
  }

  void addTransfer(RandomRung& filler, RungBuilder& builder, uint32_t routine, uint32_t at, uint32_t count) {
    const bool isKnown = options_.known && random_.chance(50);
    const ValueId cond = isKnown ? filler.known() : random_.chance(80) ? filler.value(Type::Bit) : ValueId{};
    const uint32_t ahead = random_.between(at, count - 1);
    switch (random_.below(6)) {
    case 0:
      if (at + 1 < count) builder.gotoRung(std::max(ahead, at + 1), cond);
      break;
    case 1:
      if (at > 0) jumpBack(filler, builder, routine, random_.between(1, at));
      break;
    case 2:
      if (routine + 1 < options_.routines)
        builder.call(RoutineId{random_.between(routine + 1, options_.routines - 1)}, cond);
      break;
    case 3:
      if (random_.chance(30)) builder.ret(cond);
      break;
    case 4:
      if (random_.chance(30)) builder.end(cond);
      break;
    default:
      if (at + 1 < count) switchAhead(filler, builder, at, count);
      break;
    }
  }

  // Not to rung 0, which resets the counter.
  void jumpBack(RandomRung& filler, RungBuilder& builder, uint32_t routine, uint32_t target) {
    const SlotId counter{firstCounter_ + routine};
    const ValueId jumps = builder.slotLoad(counter);
    builder.slotStore(counter, builder.add(jumps, builder.i32(1)));
    const ValueId wanted = filler.value(Type::Bit);
    builder.gotoRung(target, builder.and_(wanted, builder.ltU(jumps, builder.i32(kBackJumps))));
  }

  void switchAhead(RandomRung& filler, RungBuilder& builder, uint32_t at, uint32_t count) {
    std::vector<uint32_t> targets;
    for (uint32_t n = random_.between(1, 4); n > 0; --n) targets.push_back(random_.between(at + 1, count - 1));
    // Mostly in range.
    const ValueId value = filler.value(Type::I32);
    builder.switchTo(random_.chance(70) ? builder.and_(value, builder.i32(3)) : value, std::move(targets));
  }

  void addTasks() {
    Task main{.name = "MAIN", .entry = RoutineId{0}, .periodUs = 8000, .budget = 1 << 26, .budgetFault = FaultId{0}};
    cutTask(module_, main, random_.between(1, 3));
    // The inputs as they were when the run began; and what the program wrote over them, where the mask says so.
    main.begin.push_back({.from = {SpaceId{0}, 0, kSpaceBytes}, .to = SpaceId{6}});
    main.end.push_back({.masked = true,
                        .from = {SpaceId{6}, 8, 16},
                        .to = SpaceId{5},
                        .toByte = 24,
                        .mask = SpaceId{7},
                        .maskByte = 4});
    module_.tasks.push_back(std::move(main));
    module_.mainTask = TaskId{0};
    module_.scan = {{RUNG_STEP_ADVANCE, {}, 4000}, {RUNG_STEP_RUN, TaskId{0}, 1}, {RUNG_STEP_SLOT, {}, 0}};
    if (options_.routines == 1) return;
    module_.tasks.push_back({.name = "FAST",
                             .entry = RoutineId{options_.routines - 1},
                             .periodUs = 1000,
                             .budget = 1 << 26,
                             .budgetFault = FaultId{0}});
    module_.fastTask = TaskId{1};
    module_.fast = {{RUNG_STEP_RUN, TaskId{1}, 1}};
    module_.scan = {{RUNG_STEP_ADVANCE, {}, 4000},
                    {RUNG_STEP_PART, TaskId{0}, 1},
                    {RUNG_STEP_RUN, TaskId{1}, 2},
                    {RUNG_STEP_SLOT, {}, 0}};
    module_.slices = {{RUNG_STEP_ADVANCE, {}, 2000},
                      {RUNG_STEP_RUN, TaskId{1}, 1},
                      {RUNG_STEP_PART, TaskId{0}, 1},
                      {RUNG_STEP_ADVANCE, {}, 2000},
                      {RUNG_STEP_RUN, TaskId{1}, 1}};
  }

  RandomSource random_;
  const RandomOptions options_;
  Module module_;
  uint32_t firstCounter_ = 0;
};

} // namespace

Module randomModule(uint64_t seed, const RandomOptions& options) { return RandomModule(seed, options).run(); }

} // namespace rung::ir
