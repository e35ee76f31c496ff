// Everything that changes a program while it runs, at the same time and at random: its code arrives in tiers, cells are
// forced, other programs take over and go, faults and restarts. One thread scans, one prepares the changes, others
// compile. The interpreter does the same afterwards, at the same scans, and every state is equal.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <optional>
#include <random>
#include <thread>

#include "compiler/recompiler.h"
#include "compiler/tiered.h"
#include "ir/support/hash.h"
#include "rtlib/change/forcing.h"
#include "rtlib/change/replacement.h"
#include "rtlib/run/instance.h"
#include "tests/random/random.h"
#include "tests/support/differential.h"
#include "tests/support/long_run.h"

namespace rung::compiler {
namespace {

using Random = std::mt19937_64;

constexpr uint32_t kVariants = 3;
constexpr int kEvents = 40;

// A program beside others of its kind: some of its rungs do nothing, and its memory lies elsewhere.
ir::Module variantOf(ir::Module module, uint32_t variant) {
  for (uint32_t i = 0; i < variant; ++i)
    module.slots.insert(module.slots.end(), {.type = ir::Type::I64, .key = "variant " + std::to_string(i)});
  for (ir::Routine& routine : module.routines)
    for (size_t i = 0; i < routine.rungs.size(); ++i) {
      ir::Rung& rung = routine.rungs[i];
      const bool plain = rung.transfer.kind == ir::TransferKind::Next && !rung.transfer.cond.valid();
      if (variant == 0 || !plain || i % kVariants != variant) continue;
      rung.ops.clear();
      rung.args.clear();
      rung.values.clear();
    }
  return module;
}

struct Variant {
  Variant(const ir::Module& module, EngineKind engineKind)
      : kind(engineKind), compiled(testing::compiledFromBuilt(module, {.partition = {.maxChunkRungs = 4}})),
        engine(makeEngine(kind, compiled, {}).value()) {}
  const rung_program& program() const { return engine->program(); }

  EngineKind kind;
  Compiled compiled;
  std::unique_ptr<runtime::Engine> engine;
};

enum class What : uint8_t { Force, EndForces, Replace, Restart, Halt };

struct Event {
  What what = What::EndForces;
  uint32_t variant = 0; // Replace
  std::vector<runtime::ForcedCell> cells;
  uint64_t scan = 0; // before which it happened
  bool done = false;
};

// An event, ready for a program of one kind of engine.
struct Prepared {
  std::optional<runtime::Forcing> forcing;
  std::unique_ptr<ForcedCode> code;
  std::unique_ptr<runtime::Replacement> replacement;
};

// The programs of one kind of engine, and one instance.
class Machine {
public:
  Machine(const std::vector<ir::Module>& modules, EngineKind kind) {
    for (const ir::Module& module : modules) variants_.push_back(std::make_unique<Variant>(module, kind));
    instance_.emplace(*variants_[0]->engine);
  }

  // Any thread. `running`: the variant that runs.
  Prepared& prepare(const Event& event, uint32_t running) {
    Prepared& prepared = *prepared_.emplace_back(std::make_unique<Prepared>());
    const Variant& now = *variants_[running];
    if (event.what == What::Force) {
      prepared.forcing.emplace(now.program(), now.engine->context(), event.cells);
      if (prepared.forcing->needsCode()) {
        Result<std::unique_ptr<ForcedCode>> made =
            makeForcedCode(now.compiled, now.kind, {}, now.program(), now.engine->context(), prepared.forcing->bytes());
        EXPECT_TRUE(made.ok()) << made.error();
        prepared.code = std::move(made).value();
        prepared.forcing->setCode(prepared.code->code());
      }
    }
    if (event.what == What::Replace) {
      const Variant& next = *variants_[event.variant];
      prepared.replacement = std::make_unique<runtime::Replacement>(
          now.program(), runtime::Runnable{next.program(), next.engine->context()});
    }
    return prepared;
  }

  // The thread that scans.
  bool apply(const Event& event, Prepared& prepared) {
    switch (event.what) {
    case What::Force: return instance_->force(*prepared.forcing);
    case What::EndForces: instance_->endForces(); return true;
    case What::Replace: return instance_->replace(*prepared.replacement) == runtime::ReplaceResult::Replaced;
    case What::Restart: instance_->coldStart(); return true;
    case What::Halt: return instance_->halt(instance_->program().faults[0]);
    }
    return false;
  }

  // Of all that can be seen.
  uint64_t scan(uint64_t number) {
    for (uint32_t byte = 0; byte < std::min(8u, instance_->program().spaces[0].byte_count); ++byte)
      EXPECT_EQ(instance_->write(runtime::intRef(0, byte, 8), number * 13 + uint64_t{byte} * 7), std::nullopt);
    instance_->scan();
    const auto block = std::as_const(*instance_).block();
    std::string seen(reinterpret_cast<const char*>(block.data()), block.size());
    seen += std::to_string(instance_->nowUs()) + (instance_->faulted() ? instance_->faultText() : "");
    return hashBytes(seen);
  }

  const rung_program& program(uint32_t variant) const { return variants_[variant]->program(); }

private:
  std::vector<std::unique_ptr<Variant>> variants_;
  std::vector<std::unique_ptr<Prepared>> prepared_;
  std::optional<runtime::Instance> instance_;
};

Event randomEvent(Random& random, const rung_program& program) {
  Event event;
  constexpr What kWhat[] = {What::Force,   What::Force,   What::Force,   What::EndForces, What::Replace,
                            What::Replace, What::Replace, What::Restart, What::Halt};
  event.what = kWhat[random() % std::size(kWhat)];
  event.variant = static_cast<uint32_t>(random() % kVariants);
  for (int i = 0; event.what == What::Force && i < 4; ++i) {
    const auto space = static_cast<uint32_t>(random() % program.space_count);
    const uint32_t bytes = program.spaces[space].byte_count;
    if (bytes < 8) continue;
    const auto byte = static_cast<uint32_t>(random() % (bytes - 7));
    const runtime::Ref ref = random() % 2 == 0 ? runtime::bitRef(space, byte, static_cast<uint32_t>(random() % 8))
                                               : runtime::intRef(space, byte, 16);
    event.cells.push_back({.ref = ref, .bits = random()});
  }
  return event;
}

// What the scanning thread takes from the one that prepares.
struct Mail {
  Event* event = nullptr;
  Prepared* prepared = nullptr;
};

struct Counts {
  uint32_t done[5] = {};
  uint32_t scans = 0;
};

void runSeed(uint64_t seed, Counts& counts) {
  std::vector<ir::Module> modules;
  for (uint32_t v = 0; v < kVariants; ++v)
    modules.push_back(variantOf(ir::randomModule(seed, {.traps = seed % 3 == 0}), v));
  Machine tested(modules, EngineKind::Tiered);
  std::vector<Event> events(kEvents);
  std::vector<uint64_t> seen;
  std::atomic<Mail*> mail{nullptr};
  std::atomic<bool> end{false};
  std::thread scanning([&] {
    for (uint64_t scan = 0; !end.load() || scan < 4; ++scan) {
      if (Mail* taken = mail.load(std::memory_order_acquire)) {
        taken->event->scan = scan;
        taken->event->done = tested.apply(*taken->event, *taken->prepared);
        mail.store(nullptr, std::memory_order_release);
      }
      seen.push_back(tested.scan(scan));
      // As others do it: the interpreter does each scan again, and who compiles needs the processor.
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  });
  Random random(seed);
  uint32_t running = 0;
  for (Event& event : events) {
    event = randomEvent(random, tested.program(running));
    if (event.what == What::Replace && event.variant == running) event.variant = (running + 1) % kVariants;
    const runtime::Forcing asked(tested.program(running), nullptr, event.cells);
    if (!asked.problem().empty()) event = {.what = What::EndForces};
    Mail post{&event, &tested.prepare(event, running)};
    mail.store(&post, std::memory_order_release);
    while (mail.load(std::memory_order_acquire) != nullptr) std::this_thread::yield();
    if (event.what == What::Replace && event.done) running = event.variant;
  }
  end = true;
  scanning.join();

  Machine expected(modules, EngineKind::Interp);
  uint32_t there = 0;
  auto event = events.begin();
  for (uint64_t scan = 0; scan < seen.size(); ++scan) {
    for (; event != events.end() && event->scan == scan; ++event) {
      Prepared& prepared = expected.prepare(*event, there);
      ASSERT_EQ(expected.apply(*event, prepared), event->done) << "event of scan " << scan;
      if (event->what == What::Replace && event->done) there = event->variant;
      counts.done[static_cast<size_t>(event->what)] += event->done ? 1 : 0;
    }
    ASSERT_EQ(expected.scan(scan), seen[scan]) << "scan " << scan << " of program " << there;
  }
  counts.scans += static_cast<uint32_t>(seen.size());
}

TEST(Changes, OfEveryKindAtTheSameTime) {
  Counts counts;
  for (uint64_t seed = 0; seed < testing::howMany(4, 12) && !::testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE(seed);
    runSeed(seed, counts);
  }
  for (const What what : {What::Force, What::EndForces, What::Replace, What::Restart, What::Halt})
    EXPECT_GT(counts.done[static_cast<size_t>(what)], 5u) << static_cast<int>(what);
  EXPECT_GT(counts.scans, 1000u);
}

} // namespace
} // namespace rung::compiler
