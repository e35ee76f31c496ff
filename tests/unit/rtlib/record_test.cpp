// A recording, played again, gives what the program did: whatever comes from outside, and wherever it is begun.
#include <gtest/gtest.h>

#include <random>

#include "rtlib/record/bytes_player.h"
#include "rtlib/record/recorder.h"
#include "rtlib/run/instance.h"
#include "tests/unit/rtlib/test_program.h"

namespace {

using namespace rung;
using namespace rung::runtime;
using test::TestProgram;

// Bytes 0 to 15 are inputs, 16 to 31 outputs, 32 to 63 memory, of which 40 is the host's, too, and 48 the ticket.
uint32_t mix(uint8_t* mem, rung_ctx* ctx, uint32_t chunk) {
  for (uint32_t i = 0; i < 8; ++i) mem[16 + i] = static_cast<uint8_t>(mem[16 + i] * 3 + mem[i] + mem[40] + chunk);
  mem[32] = static_cast<uint8_t>(mem[32] + static_cast<uint8_t>(ctx->now_us / 1000));
  return chunk + 1;
}
uint32_t ask(uint8_t* mem, rung_ctx* ctx, uint32_t) {
  uint32_t ticket = 0;
  std::memcpy(&ticket, mem + 48, sizeof ticket);
  if (ticket == 0) {
    const int64_t arg = mem[0];
    ticket = ctx->host->service_request(ctx, mem[1] & 1u, &arg, 1);
  } else if (const uint32_t state = ctx->host->service_poll(ctx, ticket); state != RUNG_SERVICE_PENDING) {
    mem[24] = static_cast<uint8_t>(mem[24] + ctx->host->service_result(ctx, ticket, 0) + state);
    ticket = 0;
  }
  std::memcpy(mem + 48, &ticket, sizeof ticket);
  if (mem[2] == 255) return ctx->fault.code = 1, RUNG_PC_FAULT;
  return RUNG_PC_DONE;
}
uint32_t extra(uint8_t* mem, rung_ctx*, uint32_t) {
  mem[33] = static_cast<uint8_t>(mem[33] * 5 + mem[8] + 1);
  mem[40] = static_cast<uint8_t>(mem[40] + 1);
  return RUNG_PC_DONE;
}

void build(TestProgram& program) {
  program.addSpace("X", 1, {{0, 16, 0, RUNG_REPR_PACKED}}, RUNG_SPACE_INPUT);
  program.addSpace("Y", 1, {{0, 16, 16, RUNG_REPR_PACKED}}, RUNG_SPACE_OUTPUT);
  program.addPacked("R", 1, 32, 32);
  program.memorySize = 64;
  program.addChunk(mix);
  program.addChunk(mix);
  program.addChunk(ask);
  const uint32_t main = program.addTask("MAIN", 0, 1000, {1, RUNG_PC_DONE});
  const uint32_t other = program.addTask("EXTRA", program.addChunk(extra));
  program.writes = {{16, 16, 255}, {32, 32, 255}};
  program.addReads(main, {{0, 8}, {16, 48}});
  program.addReads(other, {{8, 1}, {33, 8}});
  program.safeSpans = {{16, 16}};
  program.scan = {{RUNG_STEP_ADVANCE, RUNG_NONE, 4000}, {RUNG_STEP_HOOK, RUNG_NONE, 1}, {RUNG_STEP_PART, main, 0},
                  {RUNG_STEP_ADVANCE, RUNG_NONE, 4000}, {RUNG_STEP_HOOK, RUNG_NONE, 2}, {RUNG_STEP_PART, main, 0}};
  program.fast = {{RUNG_STEP_RUN, other, 2}};
  EXPECT_EQ(checkProgram(program.link()), "");
}

// The world of a program: what it does depends on a seed only.
class World final : public ScheduleHooks {
public:
  explicit World(uint32_t seed) : random_(seed) {}

  bool chance(uint32_t percent) { return random_() % 100 < percent; }
  uint8_t byte() { return static_cast<uint8_t>(random_()); }
  uint8_t input() { return static_cast<uint8_t>(random_() % 255); } // does not fault

  uint32_t works() const override { return 1u << 2 | 1u << 1; }
  void onHook(Instance& instance, uint32_t) override {
    if (chance(20)) instance.block()[random_() % 16] = input();
    if (chance(20)) instance.runTask(1);
    if (chance(20)) instance.block()[40] = byte();
    if (chance(10)) {
      const int64_t args[] = {7, -1};
      (void)instance.services().request(9, args, 2);
    }
    if (chance(10)) instance.runTask(1);
  }
  void onFault(Instance& instance) override { instance.runTask(1); }
  void onLatch(Instance& instance, uint32_t) override {
    if (chance(30)) instance.block()[3] = byte();
  }
  bool respond(Instance&, const core::ServiceRequest& request, core::ServiceReply& reply) override {
    if (chance(50)) return false;
    reply.ticket = request.ticket;
    reply.resultCount = 1;
    reply.results[0] = -static_cast<int64_t>(random_());
    reply.state = chance(20) ? RUNG_SERVICE_PENDING : RUNG_SERVICE_DONE;
    if (reply.state == RUNG_SERVICE_PENDING) kept_.push_back(request.ticket);
    return true;
  }

  void beforePart(Instance& instance) {
    if (chance(30)) instance.block()[random_() % 16] = input();
    if (chance(10)) (void)instance.write(intRef(2, 8, 8), byte());
    if (chance(5)) instance.advanceClock(random_() % 100'000);
    if (chance(2)) instance.setStopped(!instance.stopped());
    if (chance(1)) instance.block()[2] = 255;
    core::ServiceRequest request;
    while (instance.services().take(request)) kept_.push_back(request.ticket);
    if (!kept_.empty() && chance(50)) {
      instance.services().complete({.ticket = kept_.back(), .resultCount = 1, .results = {byte()}});
      kept_.pop_back();
    }
  }

private:
  std::mt19937 random_;
  std::vector<uint32_t> kept_;
};

struct Forceless final : PlayerOwner {
  bool force(Instance& instance, std::span<const core::ForcedBits> bits) override {
    instance.endForces();
    return bits.empty();
  }
};

class Recording : public testing::Test {
protected:
  void SetUp() override { build(program); }

  RecordedBytes bytes() {
    BlockBytes outputs(program.memorySize);
    std::fill_n(outputs.begin() + 16, 16, true);
    return {.before = WatchedBytes(program.program),
            .within = {program.program, readBytes(program.program)},
            .outputs = {program.program, outputs}};
  }
  // The memory without what the program neither reads nor writes.
  static std::vector<uint8_t> known(const Instance& instance) {
    std::vector<uint8_t> memory(instance.block().begin(), instance.block().end());
    std::fill(memory.begin() + 9, memory.begin() + 16, 0);
    return memory;
  }
  void take(Recorder& recorder) {
    for (auto record = recorder.ring().front(); !record.empty(); record = recorder.ring().front()) {
      events.insert(events.end(), record.begin(), record.end());
      recorder.ring().pop();
    }
  }
  // Runs parts in a world, and keeps what the memory was after each.
  void record(uint32_t seed, uint32_t parts, const RecorderOptions& options = {}) {
    World world(seed);
    Instance instance(program.program, &world);
    instance.setLatching(seed % 2 != 0);
    Recorder recorder(instance, bytes(), options);
    instance.setOutsideWatch(&recorder);
    instance.coldStart();
    for (uint32_t i = 0; i < parts; ++i) {
      world.beforePart(instance);
      if (instance.faulted()) instance.warmStart();
      run(instance, world);
      after.push_back(known(instance));
      if (!loses) take(recorder);
    }
    recorder.flush();
    take(recorder);
  }
  static void run(Instance& instance, World& world) {
    if (world.chance(10))
      instance.fast();
    else if (world.chance(5))
      instance.runTask(1);
    else if (world.chance(1))
      instance.haltOverrun();
    else if (world.chance(50))
      instance.slice();
    else
      instance.scan();
  }

  TestProgram program;
  bool loses = false;
  std::vector<uint8_t> events;
  std::vector<std::vector<uint8_t>> after; // each part
  Forceless owner;
};

TEST_F(Recording, PlayedAgainDoesTheSame) {
  for (uint32_t seed = 0; seed < 200; ++seed) {
    events.clear();
    after.clear();
    record(seed, 500, {.ringBytes = 1 << 16, .stateEveryUs = 100'000});
    Instance instance(program.program);
    BytesPlayer player(instance, owner);
    player.setEvents(events);
    size_t parts = 0, states = 0;
    for (;;) {
      const Played played = player.play();
      ASSERT_FALSE(player.difference()) << "seed " << seed << " part " << parts << " kind "
                                        << static_cast<int>(player.difference()->kind) << " at "
                                        << player.difference()->offset;
      if (played == Played::State) ++states;
      if (played == Played::End) break;
      if (played == Played::State) continue;
      ASSERT_EQ(played, Played::Part) << "seed " << seed << " part " << parts << " at " << player.position();
      ASSERT_LT(parts, after.size());
      ASSERT_EQ(known(instance), after[parts]) << "seed " << seed << " part " << parts;
      ++parts;
    }
    EXPECT_EQ(parts, after.size()) << "seed " << seed;
    EXPECT_GT(states, 10u);
  }
}

// Short forms after that place refer to events before it, which the state has.
TEST_F(Recording, ContinuesFromTheStateOfAPlayer) {
  record(7, 600, {.stateEveryUs = 1'000'000'000});
  Instance instance(program.program);
  BytesPlayer player(instance, owner);
  player.setEvents(events);
  size_t parts = 0, continued = 0;
  for (Played played = player.play(); played != Played::End; played = player.play()) {
    if (played == Played::Part && ++parts % 7 != 0) continue;
    if (player.repeatsLeft() != 0 || !instance.forcedBits().empty()) continue;
    const std::vector<uint8_t> state = player.state();
    if (state.empty()) continue; // within a scan
    Instance another(program.program);
    BytesPlayer other(another, owner);
    other.setEvents(state);
    ASSERT_EQ(other.play(), Played::State);
    ASSERT_EQ(other.play(), Played::End);
    other.setEvents(std::span(events).subspan(player.position()));
    for (size_t part = parts; part < std::min(parts + 20, after.size()); ++part) {
      Played next = other.play();
      if (next == Played::State) next = other.play(); // the program was started again
      ASSERT_EQ(next, Played::Part) << "from part " << parts << " to " << part;
      ASSERT_EQ(known(another), after[part]) << "from part " << parts << " to " << part;
    }
    ++continued;
  }
  EXPECT_EQ(parts, after.size());
  EXPECT_GT(continued, 10u);
}

TEST_F(Recording, AShortFormWithoutWhatItRefersToIsDamage) {
  record(3, 10);
  for (const uint8_t form : {static_cast<uint8_t>(Event::Next), uint8_t{Places::kShort}, uint8_t{255}}) {
    Instance instance(program.program);
    BytesPlayer player(instance, owner);
    player.setEvents(events);
    ASSERT_EQ(player.play(), Played::State);
    const uint8_t alone[] = {form, 0, 0};
    player.setEvents(alone);
    EXPECT_EQ(player.play(), Played::Damaged) << static_cast<int>(form);
  }
}

} // namespace
