// Calls of rung/runtime.h in any order and with any arguments: each gives a status of the header, errors a sentence,
// and nothing crashes.
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <iterator>
#include <random>

#include "tests/unit/runtime/test_image.h"

namespace {

using rung::test::adopted;
using rung::test::TestProgram;

constexpr int kCalls = 60'000;
constexpr size_t kStatuses = RUNG_FAULTED - RUNG_FAILED + 1;

uint32_t work(uint8_t* mem, rung_ctx* ctx, uint32_t) {
  const rung_message message{RUNG_MESSAGE_SHOW, 20, 0, 0, mem[0], 0, 0};
  ctx->host->message(ctx, &message);
  const int64_t argument = mem[0];
  ctx->host->service_request(ctx, mem[0] & 1u, &argument, 1);
  return ++mem[0] == 20 ? RUNG_PC_FAULT : rung::test::popChunk(ctx);
}

void build(TestProgram& program, uint32_t byte) {
  program.instrumented = true;
  program.addPacked("R", 1, 64, 0);
  program.addPacked("IN", 1, 64, 64);
  program.addSymbol("COUNT", 0, 0, RUNG_TYPE_I8);
  program.addSymbol("WORDS", 0, byte, RUNG_TYPE_I16, 0, 3);
  program.addSymbol("NOTE", 0, byte + 8, RUNG_TYPE_TEXT, 0, 8);
  program.addSymbol("SPEED", 0, byte + 16, RUNG_TYPE_F64);
  program.addSymbol("LATCHED", 1, 0, RUNG_TYPE_BIT);
  program.addConstant("LIMIT", 4);
  program.addTask("MAIN", program.addChunk(&work));
  program.addBeginCopy(0, {RUNG_COPY_ALL, 32, 64, 0, 16});
  program.writes = {{0, 1, 255}};
  program.scan = {{RUNG_STEP_ADVANCE, RUNG_NONE, 1000}, {RUNG_STEP_ADVANCE, RUNG_NONE, 1000}, {RUNG_STEP_RUN, 0, 1}};
  program.link();
}

class RandomCalls {
public:
  // `counts`: how many calls gave each status.
  RandomCalls(uint32_t seed, rung::Image& one, rung::Image& two, std::array<int, kStatuses>& counts)
      : random_(seed), images_{&one, &two}, statuses_(counts) {}
  ~RandomCalls() {
    endTraces();
    for (rung_watch* watch : watches_) rung_watch_free(watch);
    for (rung_forces* forces : forces_) rung_forces_free(forces);
    for (rung_shadow* shadow : shadows_) rung_shadow_free(shadow);
    for (rung_replacement* replacement : replacements_) rung_replacement_free(replacement);
    for (rung_instance* instance : instances_) rung_instance_free(instance);
  }

  void call() {
    const int32_t status = any();
    ASSERT_TRUE(status >= RUNG_FAILED && status <= RUNG_FAULTED) << last_ << " gives " << status;
    if (status < 0) {
      ASSERT_STRNE(rung_error_text(), "") << last_;
    }
    ++statuses_[static_cast<size_t>(status - RUNG_FAILED)];
  }

private:
  uint32_t below(uint32_t end) { return static_cast<uint32_t>(random_() % end); }
  bool chance(uint32_t percent) { return below(100) < percent; }
  // Mostly good ones.
  uint32_t number() { return chance(80) ? below(4) : static_cast<uint32_t>(random_()); }
  int64_t time() { return chance(90) ? below(5'000'000) : static_cast<int64_t>(random_()); }
  const char* name() {
    constexpr const char* kNames[] = {"COUNT", "WORDS", "WORDS[1]", "WORDS[9]", "NOTE",   "SPEED", "LATCHED", "LIMIT",
                                      "R+3",   "R+3.9", "R+63:4",   "IN+0.1",   "NOBODY", "",      "[",       "R+-1"};
    return chance(2) ? nullptr : kNames[below(std::size(kNames))];
  }
  template <class Struct>
  std::array<Struct, 2> sized() {
    std::array<Struct, 2> out{}; // its `size` may say that there is more than one
    out[0].size = chance(90) ? sizeof(Struct) : below(2 * sizeof(Struct));
    return out;
  }
  template <class T>
  T* place(T& value) {
    return chance(98) ? &value : nullptr;
  }
  template <class Handle>
  Handle* one(const std::vector<Handle*>& handles) {
    if (handles.empty() || chance(2)) return nullptr;
    if (chance(2)) return reinterpret_cast<Handle*>(none_.data());
    return handles[below(static_cast<uint32_t>(handles.size()))];
  }
  rung_image* image() { return chance(97) ? images_[below(2)]->handle() : nullptr; }

  int32_t powerOff(rung_instance* plc) {
    return chance(50) ? rung_instance_power_off(plc) : rung_instance_begin_power_off(plc);
  }
  int32_t define(rung_instance* plc) {
    return rung_instance_define_message(plc, number(), number(), chance(90) ? "text %d" : nullptr);
  }

  int32_t any() {
    rung_instance* plc = one(instances_);
    rung_value values[8] = {};
    values[0].integer = static_cast<int64_t>(random_());
    rung_cell cells[4] = {number(), number(), number(), number()};
    char text[16] = "text";
    const uint32_t which = below(47);
    last_ = which;
    switch (which) {
    case 0: return make();
    case 1: return change();
    case 2: return watch();
    case 3: return end();
    case 4: return rung_instance_power_on(plc, static_cast<int32_t>(number()));
    case 5: return chance(20) ? powerOff(plc) : rung_instance_start(plc);
    case 6: return chance(20) ? rung_instance_stop(plc) : rung_instance_start(plc);
    case 7: return rung_instance_run_due_fast(plc, time());
    case 8: return rung_instance_run_due(plc, time());
    case 9:
    case 10: return rung_instance_slice(plc);
    case 11:
    case 12: return rung_instance_scan(plc);
    case 13: return rung_instance_slot(plc);
    case 14: return rung_instance_fast(plc);
    case 15:
      return chance(50) ? rung_instance_prefetch(plc, time()) : rung_instance_limit(plc, chance(90) ? 0 : time());
    case 16: return withStruct<rung_state>([&](rung_state* s) { return rung_instance_state(plc, s); });
    case 17:
      withStruct<rung_program_info>([&](rung_program_info* s) { return rung_instance_program(plc, s); });
      return withStruct<rung_fault_info>([&](rung_fault_info* s) { return rung_instance_fault(plc, s); });
    case 18:
    case 19: return rung_instance_find(plc, name(), static_cast<int32_t>(below(3)), place(cells[0]));
    case 20: return withStruct<rung_cell_info>([&](rung_cell_info* s) { return rung_instance_cell(plc, cells[0], s); });
    case 21: return rung_instance_read(plc, cells[0], number(), below(5), place(values[0]));
    case 22: return rung_instance_write(plc, cells[0], number(), below(5), place(values[0]));
    case 23: return rung_instance_read_all(plc, place(cells[0]), below(5), place(values[0]));
    case 24: return rung_instance_write_all(plc, place(cells[0]), below(5), place(values[0]));
    case 25: return rung_instance_read_text(plc, cells[0], place(text[0]), below(sizeof text + 1));
    case 26: return rung_instance_write_text(plc, cells[0], place(text[0]));
    case 27: return bind(plc);
    case 28:
      return withStruct<rung_message_info>([&](rung_message_info* s) { return rung_instance_next_message(plc, s); });
    case 29:
      if (chance(50)) return define(plc);
      return withStruct<rung_message_info>([&](rung_message_info* s) { return rung_instance_shown(plc, number(), s); });
    case 30: return withStruct<rung_request>([&](rung_request* s) { return rung_instance_next_request(plc, s); });
    case 31: {
      auto reply = sized<rung_reply>();
      reply[0].ticket = number();
      reply[0].result_count = number();
      return rung_instance_answer(plc, place(reply[0]));
    }
    case 32:
      return rung_instance_begin_function(plc, number(), static_cast<int32_t>(number()), number(), place(cells[0]));
    case 33: return rung_instance_function_done(plc, number(), number());
    case 34: return rung_instance_abort_functions(plc, number());
    case 35: return chance(2) ? rung_instance_flush(plc) : rung_instance_unsaved(plc, text, number());
    case 36:
      withStruct<rung_timer_info>([&](rung_timer_info* s) { return rung_instance_timer(plc, number(), s); });
      return withStruct<rung_profile>([&](rung_profile* s) { return rung_instance_profile(plc, number(), s); });
    case 37: return withStruct<rung_profile>([&](rung_profile* s) { return rung_instance_worst_rung(plc, s); });
    case 38: return rung_instance_replace(plc, one(replacements_));
    case 39:
      return withStruct<rung_symbol_info>([&](rung_symbol_info* s) { return rung_image_symbol(image(), number(), s); });
    case 40: return force();
    case 41: return rung_instance_force(plc, one(forces_));
    case 42:
      return withStruct<rung_force_info>([&](rung_force_info* s) { return rung_instance_forced(plc, number(), s); });
    case 43: return trace();
    case 44: return shadow();
    case 45: return rung_instance_shadow(plc, chance(70) ? one(shadows_) : nullptr);
    case 46: {
      withStruct<rung_shadow_info>([&](rung_shadow_info* s) { return rung_shadow_report(one(shadows_), s); });
      withStruct<rung_difference>(
          [&](rung_difference* s) { return rung_shadow_difference(one(shadows_), number(), s); });
      return rung_shadow_work(one(shadows_));
    }
    default: return RUNG_OK;
    }
  }

  template <class Struct, class Use>
  int32_t withStruct(Use use) {
    std::array<Struct, 2> out = sized<Struct>();
    return use(place(out[0]));
  }

  int32_t make() {
    if (instances_.size() >= 3) return RUNG_OK;
    auto options = sized<rung_instance_options>();
    options[0].flags = below(4);
    rung_instance* made = nullptr;
    const int32_t status = rung_instance_new(image(), chance(50) ? options.data() : nullptr, place(made));
    if (made != nullptr) instances_.push_back(made);
    return status;
  }
  int32_t change() {
    rung_replacement* made = nullptr;
    const int32_t status = rung_replacement_new(one(instances_), image(), nullptr, 0, place(made));
    if (made != nullptr) replacements_.push_back(made);
    withStruct<rung_replacement_info>(
        [&](rung_replacement_info* s) { return rung_replacement_report(one(replacements_), s); });
    withStruct<rung_rung_change>(
        [&](rung_rung_change* s) { return rung_replacement_rung(one(replacements_), number(), s); });
    withStruct<rung_change>([&](rung_change* s) { return rung_replacement_change(one(replacements_), number(), s); });
    if (chance(20)) rung_replacement_allow_late(one(replacements_));
    if (replacements_.size() > 6) {
      rung_replacement_free(replacements_.back());
      replacements_.pop_back();
    }
    return status;
  }
  int32_t trace() {
    rung_trace* made = nullptr;
    const int32_t status = rung_trace_new(one(watches_), chance(90) ? "/dev/null" : "/nowhere/x.vcd", place(made));
    if (made != nullptr) traces_.push_back(made);
    rung_trace_write(one(traces_));
    return status;
  }
  void endTraces() {
    while (!traces_.empty()) rung_trace_free(traces_.back()), traces_.pop_back();
  }
  int32_t shadow() {
    rung_shadow* made = nullptr;
    const int32_t status = rung_shadow_new(one(instances_), image(), number(), below(8), place(made));
    if (made != nullptr) shadows_.push_back(made);
    if (shadows_.size() > 4) {
      rung_shadow_free(shadows_.front());
      shadows_.erase(shadows_.begin());
    }
    return status;
  }
  int32_t force() {
    std::array<rung_forced_cell, 4> cells{};
    for (rung_forced_cell& cell : cells)
      cell = {name(), chance(50) ? "me" : nullptr, {.integer = static_cast<int64_t>(random_())}};
    rung_forces* made = nullptr;
    rung_replacement* change = chance(70) ? nullptr : one(replacements_);
    const int32_t status =
        rung_forces_new(one(instances_), change, place(cells[0]), chance(60) ? 1 : below(5), place(made));
    if (made != nullptr) forces_.push_back(made);
    if (forces_.size() > 6) {
      rung_forces_free(forces_.front());
      forces_.erase(forces_.begin());
    }
    return status;
  }
  int32_t watch() {
    std::array<rung_cell, 4> cells{number(), number(), number(), number()};
    std::array<rung_value, 4> values{};
    rung_watch* made = nullptr;
    const int32_t status =
        rung_watch_new(one(instances_), place(cells[0]), below(5), chance(90) ? below(5) : number(), place(made));
    if (made != nullptr) watches_.push_back(made);
    withStruct<rung_sample>([&](rung_sample* s) { return rung_watch_newest(one(watches_), place(values[0]), s); });
    withStruct<rung_sample>([&](rung_sample* s) { return rung_watch_next(one(watches_), place(values[0]), s); });
    return status;
  }
  // Watches at any time, an instance with all that belongs to it seldom.
  int32_t end() {
    endTraces();
    if (!watches_.empty()) {
      rung_watch_free(watches_.back());
      watches_.pop_back();
    }
    if (!chance(3)) return RUNG_OK;
    while (!watches_.empty()) rung_watch_free(watches_.back()), watches_.pop_back();
    while (!forces_.empty()) rung_forces_free(forces_.back()), forces_.pop_back();
    while (!shadows_.empty()) rung_shadow_free(shadows_.back()), shadows_.pop_back();
    while (!replacements_.empty()) rung_replacement_free(replacements_.back()), replacements_.pop_back();
    while (!instances_.empty()) rung_instance_free(instances_.back()), instances_.pop_back();
    return RUNG_OK;
  }
  int32_t bind(rung_instance* plc) {
    if (!chance(10)) return RUNG_OK; // they stay
    rung_variable variable{name(), place(bound_), number() + (chance(80) ? 1 : 0), below(3), chance(50) ? 0.0 : 2.5};
    rung_block block{name(), place(block_), below(20), below(3)};
    if (chance(30)) return rung_instance_bind_blocks(plc, place(block), below(2));
    return rung_instance_bind(plc, place(variable), below(2));
  }

  std::mt19937_64 random_;
  std::array<rung::Image*, 2> images_;
  std::vector<rung_instance*> instances_;
  std::vector<rung_replacement*> replacements_;
  std::vector<rung_watch*> watches_;
  std::vector<rung_forces*> forces_;
  std::vector<rung_shadow*> shadows_;
  std::vector<rung_trace*> traces_;
  std::array<uint64_t, 128> none_{};
  double bound_ = 0;
  std::array<uint8_t, 64> block_{};
  uint32_t last_ = 0;
  std::array<int, kStatuses>& statuses_;
};

TEST(RuntimeCalls, InAnyOrderWithAnything) {
  TestProgram one, two;
  build(one, 8);
  build(two, 10);
  rung::Image first = adopted(one), second = adopted(two);
  std::array<int, kStatuses> counts{};
  for (uint32_t seed = 1; seed <= 5; ++seed) {
    SCOPED_TRACE(seed);
    RandomCalls calls(seed, first, second, counts);
    for (int i = 0; i < kCalls && !testing::Test::HasFatalFailure(); ++i) calls.call();
  }
  for (const int32_t status : {RUNG_OK, RUNG_EMPTY, RUNG_LATER, RUNG_FAULTED, RUNG_BAD_HANDLE, RUNG_BAD_ARGUMENT,
                               RUNG_WRONG_STATE, RUNG_NOT_FOUND, RUNG_WRONG_TYPE, RUNG_OVERWRITTEN, RUNG_REFUSED})
    EXPECT_GT(counts[static_cast<size_t>(status - RUNG_FAILED)], 0) << status;
}

} // namespace
