// A control beside a program that another one replaces: a function that is under way is finished by the new program.
#include <gtest/gtest.h>

#include "rtlib/load/program_info.h"
#include "rtlib/nc/control/nct/nct_control.h"
#include "rtlib/nc/control/pmc/pmc_control.h"
#include "rtlib/nc/gsk/model.h"
#include "rtlib/nc/nct/messages.h"
#include "tests/unit/rtlib/test_program.h"

namespace rung::nc {
namespace {

using runtime::Replacement;
using runtime::ReplaceResult;

uint32_t nothing(uint8_t*, rung_ctx* ctx, uint32_t) { return test::popChunk(ctx); }

void schedule(test::TestProgram& program) {
  program.addTask("MAIN", program.addChunk(&nothing));
  program.scan = {{RUNG_STEP_ADVANCE, RUNG_NONE, 8000}, {RUNG_STEP_HOOK, RUNG_NONE, 0}, {RUNG_STEP_RUN, 0, 1}};
}

void buildGsk(test::TestProgram& program, uint32_t offset, uint32_t repr) {
  program.dialect = "gsk";
  program.memorySize = 8192;
  program.addPacked("X", 1, 64, offset);
  program.addSpace("F", 1, {{0, 64, offset + 64, RUNG_REPR_PACKED}}, RUNG_SPACE_INPUT);
  program.addSpace("G", 1, {{0, 64, offset + 128, repr}});
  schedule(program);
  program.link();
}

TEST(ControlReplace, GskFinishesItsFunction) {
  test::TestProgram one, two;
  buildGsk(one, 0, RUNG_REPR_PACKED);
  buildGsk(two, 256, RUNG_REPR_BYTE_PER_BIT);
  PmcControl control(gsk::model());
  runtime::Instance instance(one.program, &control);
  control.powerOn(instance, PowerOn::Cold);
  Functions& functions = *control.functions(0);
  const auto byte = [&](const char* area, uint32_t number) {
    return instance.memory().readByte(runtime::findSpace(instance.program(), area), number);
  };
  ASSERT_TRUE(functions.start(FunctionKind::M, 5));
  functions.step();
  Replacement replacement(one.program, {two.program});
  ASSERT_EQ(instance.replace(replacement), ReplaceResult::Replaced);
  EXPECT_EQ(byte("F", 10), 5);
  EXPECT_EQ(byte("F", 7) & 1, 1) << "the strobe MF";
  const uint32_t g = runtime::findSpace(two.program, "G");
  functions.step();
  instance.memory().writeBit(g, 4, 3, true); // FIN
  functions.step();
  EXPECT_EQ(byte("F", 7) & 1, 0);
  instance.memory().writeBit(g, 4, 3, false);
  functions.step();
  EXPECT_FALSE(functions.busy(0));
  EXPECT_EQ(byte("F", 10), 0);
}

void buildNct(test::TestProgram& program, uint32_t offset) {
  constexpr uint32_t kBytes = 16000;
  program.dialect = "nct";
  program.memorySize = 3 * kBytes;
  program.addPacked("M", 4, kBytes, offset);
  program.addPacked("TS", 4, kBytes, offset + kBytes);
  schedule(program);
  program.link();
}

TEST(ControlReplace, NctFinishesItsFunction) {
  test::TestProgram one, two;
  buildNct(one, 0);
  buildNct(two, 4000);
  NctControl control;
  runtime::Instance instance(one.program, &control);
  control.powerOn(instance, PowerOn::Cold);
  Functions& functions = *control.functions(0);
  const auto signals = [&] { return nct::SignalMemory(instance); };
  const nct::BitSignal strobe("CN_M1STB"), acknowledge("CP_M1ACK"), finished("CP_FIN"), on("N_ON");
  signals().set(acknowledge, true);
  signals().set(finished, true);
  ASSERT_TRUE(functions.start(FunctionKind::M, 5));
  Replacement replacement(one.program, {two.program});
  ASSERT_EQ(instance.replace(replacement), ReplaceResult::Replaced);
  EXPECT_TRUE(signals().get(strobe));
  EXPECT_TRUE(signals().get(on));
  EXPECT_TRUE(functions.busy(0));
  signals().set(acknowledge, false);
  instance.scan();
  functions.step();
  EXPECT_FALSE(signals().get(strobe)) << "taken away in the program that runs now";
  EXPECT_TRUE(functions.busy(0));
  signals().set(acknowledge, true);
  instance.scan();
  functions.step();
  EXPECT_FALSE(functions.busy(0));
}

// The list on the screen stays the same; for the host the message ends and begins anew.
TEST(ControlReplace, NctChangesATextOfAMessage) {
  const auto build = [](test::TestProgram& program, const char* text) {
    program.texts = {{5, 0, text}, {6, 0, "THE SAME"}};
    program.addPacked(nct::kMessageSpace, 4, 2 * nct::kMessageWords * 4, 2 * 16000);
    buildNct(program, 0);
  };
  test::TestProgram one, two;
  build(one, "OIL");
  build(two, "OIL LEVEL");
  NctControl control;
  runtime::Instance instance(one.program, &control);
  control.powerOn(instance, PowerOn::Cold);
  const uint32_t cells = runtime::findSpace(one.program, nct::kMessageSpace);
  for (const uint32_t number : {5u, 6u}) {
    control.accept({.op = RUNG_MESSAGE_SHOW, .number = number});
    instance.memory().write(cells, 4 * ((number - 5) * nct::kMessageWords + nct::kWantedWord), 4, 100 * number);
  }
  rung_message message{};
  EXPECT_FALSE(control.nextChange(instance, message));
  Replacement replacement(one.program, {two.program});
  ASSERT_EQ(instance.replace(replacement), ReplaceResult::Replaced);
  for (const uint32_t op : {RUNG_MESSAGE_CLEAR, RUNG_MESSAGE_SHOW}) {
    ASSERT_TRUE(control.nextChange(instance, message));
    EXPECT_EQ(message.op, op);
    EXPECT_EQ(message.number, 5u);
  }
  EXPECT_FALSE(control.nextChange(instance, message));
  ASSERT_EQ(control.messages(instance).size(), 2u);
  EXPECT_EQ(control.messages(instance)[0].text, "OIL LEVEL");
}

} // namespace
} // namespace rung::nc
