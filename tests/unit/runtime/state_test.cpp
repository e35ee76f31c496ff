// The state of an instance as bytes, through the API: of a hand-made program.
#include <gtest/gtest.h>

#include <span>

#include "tests/unit/runtime/test_image.h"

namespace {

using rung::test::adopted;
using rung::test::popChunk;
using rung::test::TestProgram;
using State = std::vector<uint8_t>;

constexpr uint32_t kSum = 8, kBits = 16, kTicket = 24;

// Sums up what it reads; asks for a service again and again; faults at 200.
uint32_t work(uint8_t* mem, rung_ctx* ctx, uint32_t) {
  uint32_t ticket = 0;
  std::memcpy(&ticket, mem + kTicket, sizeof ticket);
  if (ctx->host->service_poll(ctx, ticket) != RUNG_SERVICE_PENDING) {
    mem[kSum] = static_cast<uint8_t>(mem[kSum] + ctx->host->service_result(ctx, ticket, 0));
    const int64_t arg = mem[kSum];
    ticket = ctx->host->service_request(ctx, 0, &arg, 1);
    std::memcpy(mem + kTicket, &ticket, sizeof ticket);
  }
  mem[kSum] = static_cast<uint8_t>(mem[kSum] + mem[0]);
  mem[kBits] = mem[kSum] & 1;
  if (mem[0] == 200) {
    ctx->fault = {1, 0, 10, 0};
    return RUNG_PC_FAULT;
  }
  return popChunk(ctx);
}

struct Program : TestProgram {
  explicit Program(uint32_t symbols = 2) {
    addPacked("R", 1, 16, 0);
    addSpace("B", 1, {{0, 1, kBits, RUNG_REPR_BYTE_PER_BIT}});
    addSymbol("IN", 0, 0, RUNG_TYPE_I8);
    if (symbols == 2) addSymbol("SUM", 0, kSum, RUNG_TYPE_I8);
    addTask("MAIN", addChunk(&work));
    scan = {{RUNG_STEP_ADVANCE, RUNG_NONE, 4000}, {RUNG_STEP_ADVANCE, RUNG_NONE, 4000}, {RUNG_STEP_RUN, 0, 1}};
    link();
    program.code_hash = program.layout_hash = symbols;
  }
};

class States : public testing::Test {
protected:
  States() : image_(adopted(program_)), plc_(image_, &options_), again_(image_, &options_) {
    plc_.powerOn();
    again_.powerOn();
  }
  static rung_instance_options queued() { // requests
    auto options = rung::sized<rung_instance_options>();
    options.flags = RUNG_QUEUE_REQUESTS;
    return options;
  }
  static State saved(const rung::Instance& plc) { return plc.save().value(); }
  static void scan(rung::Instance& plc, int64_t in) {
    plc.write(plc.find("IN", rung::Access::Write), in);
    plc.scan();
  }
  static int64_t sum(rung::Instance& plc) { return plc.read<int64_t>(plc.find("SUM")); }
  static int32_t load(rung::Instance& plc, std::span<const uint8_t> state) {
    return rung_instance_load(plc.handle(), state.data(), state.size());
  }

  Program program_;
  rung::Image image_;
  rung_instance_options options_ = queued();
  rung::Instance plc_, again_;
};

TEST_F(States, ContinueWithClockTicketsAndRequests) {
  for (int64_t i = 0; i < 5; ++i) scan(plc_, i);
  again_.load(saved(plc_));
  EXPECT_EQ(saved(again_), saved(plc_));
  EXPECT_EQ(again_.state().now_us, plc_.state().now_us);
  EXPECT_EQ(again_.state().scans, 5u);
  for (rung::Instance* each : {&plc_, &again_}) {
    const auto request = each->nextRequest();
    ASSERT_TRUE(request);
    each->answer({.size = sizeof(rung_reply), .ticket = request->ticket, .result_count = 1, .results = {7}});
    EXPECT_FALSE(each->nextRequest());
  }
  EXPECT_EQ(saved(again_), saved(plc_)) << "with a reply that waits";
  plc_.load(saved(again_));
  for (rung::Instance* each : {&plc_, &again_}) {
    scan(*each, 1);
    EXPECT_EQ(sum(*each), 0 + 1 + 2 + 3 + 4 + 7 + 1);
  }
}

TEST_F(States, HaveTheFaultAndTheStop) {
  scan(plc_, 200);
  const State faulted = saved(plc_);
  EXPECT_NE(again_.state().flags & RUNG_STATE_FAULTED, RUNG_STATE_FAULTED);
  again_.load(faulted);
  EXPECT_EQ(again_.state().flags & RUNG_STATE_FAULTED, RUNG_STATE_FAULTED);
  ASSERT_TRUE(again_.fault());
  EXPECT_EQ(again_.fault()->line, 10u);
  again_.powerOn();
  again_.stop();
  const State stopped = saved(again_);
  plc_.load(stopped);
  EXPECT_EQ(plc_.state().flags & (RUNG_STATE_FAULTED | RUNG_STATE_STOPPED), uint32_t{RUNG_STATE_STOPPED});
}

TEST_F(States, AreSavedBetweenScansOnly) {
  plc_.slice();
  EXPECT_FALSE(plc_.save());
  plc_.slice();
  ASSERT_TRUE(plc_.save());
  again_.slice();
  again_.load(saved(plc_)); // whatever it was doing
  EXPECT_EQ(saved(again_), saved(plc_));
}

TEST_F(States, SayTheirSize) {
  size_t size = 0;
  ASSERT_EQ(rung_instance_save(plc_.handle(), nullptr, 0, &size), RUNG_OK);
  State state(size);
  size_t used = 0;
  EXPECT_EQ(rung_instance_save(plc_.handle(), state.data(), size - 1, &used), RUNG_BAD_ARGUMENT);
  EXPECT_EQ(used, size);
  EXPECT_EQ(rung_instance_save(plc_.handle(), state.data(), size, &used), RUNG_OK);
  EXPECT_EQ(rung_instance_save(plc_.handle(), nullptr, 1, &used), RUNG_BAD_ARGUMENT);
  EXPECT_EQ(rung_instance_save(plc_.handle(), state.data(), size, nullptr), RUNG_BAD_ARGUMENT);
  EXPECT_EQ(rung_instance_load(plc_.handle(), nullptr, 0), RUNG_BAD_ARGUMENT);
}

TEST_F(States, OfOtherProgramsAreRefusedAndChangeNothing) {
  const Program other(1);
  const rung::Image image = adopted(other);
  rung::Instance plc(image);
  plc.powerOn();
  scan(again_, 3);
  const State before = saved(again_);
  EXPECT_EQ(load(again_, saved(plc)), RUNG_REFUSED);
  EXPECT_STREQ(rung_error_text(), "the state is that of another program, or of another version of it");
  EXPECT_EQ(saved(again_), before);
}

TEST_F(States, ThatAreCutOffOrImpossibleAreRefused) {
  scan(plc_, 3);
  const State state = saved(plc_);
  for (size_t size = 0; size < state.size(); ++size) {
    again_.powerOn();
    ASSERT_EQ(load(again_, std::span(state).first(size)), RUNG_REFUSED) << size;
  }
  State longer = state;
  longer.push_back(0);
  again_.powerOn();
  EXPECT_EQ(load(again_, longer), RUNG_REFUSED);
  EXPECT_EQ(again_.state().flags & RUNG_STATE_ON, 0u);
  EXPECT_EQ(load(again_, state), RUNG_WRONG_STATE) << "it is off";
  // Whatever one byte says, the state is refused, or a program can run with it.
  for (size_t at = 0; at < state.size(); ++at)
    for (const uint8_t value : {uint8_t{1}, uint8_t{0x80}, uint8_t{0xFF}}) {
      State changed = state;
      changed[at] = static_cast<uint8_t>(changed[at] ^ value);
      again_.powerOn();
      if (load(again_, changed) == RUNG_OK) again_.scan();
    }
}

TEST_F(States, NeedTheProgramToBeOn) {
  const State state = saved(plc_);
  plc_.powerOff();
  size_t size = 0;
  EXPECT_EQ(rung_instance_save(plc_.handle(), nullptr, 0, &size), RUNG_WRONG_STATE);
  EXPECT_EQ(load(plc_, state), RUNG_WRONG_STATE);
}

TEST_F(States, ClockAdvances) {
  plc_.setClock(1'000'000);
  EXPECT_EQ(plc_.state().now_us, 1'000'000);
  EXPECT_EQ(rung_instance_set_clock(plc_.handle(), 999'999), RUNG_BAD_ARGUMENT);
  EXPECT_EQ(rung_instance_set_clock(plc_.handle(), 1'000'000 + 3'600'000'001), RUNG_BAD_ARGUMENT);
  EXPECT_EQ(plc_.state().now_us, 1'000'000);
}

} // namespace
