// What rung/runtime.h marks with [rt] neither allocates nor enters the kernel, errors included.
#include <gtest/gtest.h>

#include <array>

#include "rung/runtime.hpp"
#include "tests/support/count_allocations.h"
#include "tests/support/count_system_calls.h"
#include "tests/unit/runtime/test_image.h"

namespace {

using rung::test::adopted;
using rung::test::allocationsOf;

uint32_t work(uint8_t* mem, rung_ctx* ctx, uint32_t) {
  const rung_message message{RUNG_MESSAGE_SHOW, 20, 0, 0, mem[0], 0, 0};
  ctx->host->message(ctx, &message);
  const int64_t argument = 1;
  ctx->host->service_request(ctx, 0, &argument, 1);
  return ++mem[0] == 50 ? RUNG_PC_FAULT : rung::test::popChunk(ctx);
}

void build(rung::test::TestProgram& program, uint32_t byte) {
  program.addPacked("R", 1, 64, 0);
  program.addSymbol("COUNT", 0, 0, RUNG_TYPE_I8);
  program.addSymbol("WORDS", 0, byte, RUNG_TYPE_I16, 0, 3);
  program.addSymbol("DOOR", 0, 20, RUNG_TYPE_BIT);
  program.retains = {{8, 8}};
  program.addTask("MAIN", program.addChunk(&work));
  program.scan = {{RUNG_STEP_ADVANCE, RUNG_NONE, 8000}, {RUNG_STEP_RUN, 0, 1}};
  program.link();
}

TEST(RuntimeInRealTime, NeitherAllocatesNorEntersTheKernel) {
  rung::test::TestProgram one, two;
  build(one, 8);
  build(two, 10);
  const rung::Image first = adopted(one), second = adopted(two);
  auto options = rung::sized<rung_instance_options>();
  options.flags = RUNG_QUEUE_REQUESTS;
  rung::Instance plc(first, &options);
  bool input = true;
  uint8_t output = 0;
  plc.bindInput("DOOR", input);
  plc.bindOutput("COUNT", output);
  struct {
    uint32_t head, tail;
    bool door;
  } block{1, 1, false};
  const rung_member member{"DOOR", "door", 8, 1, RUNG_HOST_BOOL, RUNG_TO_PROGRAM, 0, 0, 0};
  const rung_layout layout{sizeof layout, sizeof block, "Block", "", 1, &member, 1, 4, 0, 4, nullptr};
  rung::check(rung_instance_bind_struct(plc.handle(), &layout, &block));
  plc.keep(testing::TempDir() + "rung_runtime_no_allocation");
  plc.powerOn();
  const rung_cell cells[] = {plc.find("COUNT"), plc.find("WORDS", rung::Access::Write)};
  rung::Replacement change(plc, second);
  const std::array<rung_forced_cell, 2> cellsToForce{
      {{"DOOR", nullptr, {.integer = 1}}, {"WORDS", "me", {.integer = 3}}}};
  rung::Forces forces(plc, cellsToForce);
  auto force = rung::sized<rung_force_info>();
  auto message = rung::sized<rung_message_info>();
  auto request = rung::sized<rung_request>();
  auto reply = rung::sized<rung_reply>();
  auto state = rung::sized<rung_state>();
  const auto use = [&] {
    rung_instance* p = plc.handle();
    rung_value values[3] = {};
    for (int i = 0; i < 100; ++i) { // to the fault, and after it
      rung_instance_run_due_fast(p, 8'000'000), rung_instance_run_due(p, 8'000'000);
      rung_instance_slice(p), rung_instance_scan(p), rung_instance_slot(p), rung_instance_fast(p);
      rung_instance_read(p, cells[1], 0, 3, values), rung_instance_write(p, cells[1], 0, 3, values);
      rung_instance_read_all(p, cells, 2, values), rung_instance_write_all(p, cells + 1, 1, values);
      rung_instance_write_all(p, cells, 2, values); // COUNT was found for reading
      rung_instance_force(p, i % 3 != 0 ? forces.handle() : nullptr), rung_instance_forced(p, 0, &force);
      rung_instance_state(p, &state), rung_instance_limit(p, 0);
      rung_instance_prefetch(p, INT64_MAX);
      block.head += i % 2; // torn, now and then
      rung_instance_inconsistent(p, &block, &reply.ticket);
      rung_instance_stop(p), rung_instance_start(p);
      while (rung_instance_next_message(p, &message) == RUNG_OK) {
      }
      while (rung_instance_next_request(p, &request) == RUNG_OK) {
        reply.ticket = request.ticket;
        rung_instance_answer(p, &reply);
      }
      rung_instance_begin_function(p, 0, RUNG_FUNCTION_M, 3, &reply.ticket);
      rung_instance_function_done(p, 0, 0), rung_instance_abort_functions(p, 0);
      rung_instance_supports_function(p, 0, RUNG_FUNCTION_M, 3);
      rung_instance_replace(p, change.handle());
    }
  };
  int calls = 0;
  const int counted = allocationsOf([&] { calls = systemCallsOf(use).value_or(0); });
  EXPECT_EQ(counted, 0);
  EXPECT_EQ(calls, 0);
  EXPECT_TRUE(plc.fault());
  EXPECT_GT(plc.state().generation, 10u);
}

// The controls have their places in the new program beforehand, and room for its messages.
class ReplacingInRealTime : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Dialects, ReplacingInRealTime, testing::Values("gsk", "nct", "technol"),
                         [](const auto& dialect) { return std::string(dialect.param); });

TEST_P(ReplacingInRealTime, NeitherAllocatesNorEntersTheKernel) {
  constexpr uint32_t kBytesOfABox = 8, kBoxes = 500;
  rung::test::TestProgram one, two;
  for (rung::test::TestProgram* program : {&one, &two}) {
    const uint32_t boxes = program == &one ? 1 : kBoxes;
    program->dialect = GetParam();
    program->memorySize = 8192;
    program->addPacked("@SHOWN", 4, boxes * kBytesOfABox, 0);
    program->addPacked("TS", 4, 64, 4096);
    program->addTask("MAIN",
                     program->addChunk([](uint8_t*, rung_ctx* ctx, uint32_t) { return rung::test::popChunk(ctx); }));
    program->scan = {{RUNG_STEP_ADVANCE, RUNG_NONE, 8000}, {RUNG_STEP_RUN, 0, 1}};
    program->link();
  }
  const rung::Image first = adopted(one), second = adopted(two);
  rung::Instance plc(first);
  plc.powerOn();
  rung::Replacement change(plc, second);
  int32_t status = RUNG_OK;
  int calls = 0;
  const auto use = [&] {
    for (int i = 0; i < 3 && status == RUNG_OK; ++i) {
      status = plc.replace(change);
      rung_instance_scan(plc.handle());
    }
  };
  const int counted = allocationsOf([&] { calls = systemCallsOf(use).value_or(0); });
  EXPECT_EQ(status, RUNG_OK);
  EXPECT_EQ(counted, 0);
  EXPECT_EQ(calls, 0);
}

TEST_P(ReplacingInRealTime, BeforeThePowerOnToo) {
  rung::test::TestProgram one, two;
  for (rung::test::TestProgram* program : {&one, &two}) {
    program->dialect = GetParam();
    build(*program, 8);
  }
  const rung::Image first = adopted(one), second = adopted(two);
  rung::Instance plc(first);
  {
    rung::Replacement change(plc, second);
    for (int i = 0; i < 2; ++i) EXPECT_EQ(plc.replace(change), RUNG_OK);
  }
  EXPECT_EQ(plc.powerOn(), RUNG_OK);
  EXPECT_EQ(plc.scan(), RUNG_OK);
}

} // namespace
