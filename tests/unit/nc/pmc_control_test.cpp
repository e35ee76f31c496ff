// The control of the PMC family beside a program by hand: what FANUC's does that GSK's does not. Tests play the
// program.
#include <gtest/gtest.h>

#include "rtlib/change/replacement.h"
#include "rtlib/load/program_info.h"
#include "rtlib/nc/control/pmc/pmc_control.h"
#include "rtlib/nc/fanuc/model.h"
#include "rtlib/nc/fanuc/services.h"
#include "rtlib/nc/fanuc/window_functions.h"
#include "tests/unit/rtlib/test_program.h"

namespace rung::nc {
namespace {

uint32_t nothing(uint8_t*, rung_ctx* ctx, uint32_t) { return test::popChunk(ctx); }

class FanucControl : public testing::Test {
protected:
  static constexpr uint32_t kF = 0, kG = 1, kA = 2, kDisplay = 3, kK = 4; // spaces

  // Keys are 8·byte + bit + 1; the last text is that of A0.1 in the language with a shift of 400 bits.
  static void build(test::TestProgram& program, uint32_t messageBytes = 64) {
    program.dialect = "fanuc";
    program.memorySize = 4096;
    program.addPacked("F", 1, 768, 0);
    program.addPacked("G", 1, 768, 768);
    program.addPacked("A", 1, messageBytes, 1536);
    program.addPacked("@DISPB", 1, 1, 1600);
    program.addPacked("K", 1, 1000, 1604);
    program.texts = {{2, 0, "1000 DOOR OPEN"},
                     {9, 0, "2005 OIL LEVEL LOW"},
                     {16, 0, "2100 COOLANT ON"},
                     {402, 0, "1000 TUER OFFEN"}};
    program.services = {fanuc::service(pmc::ServiceKind::ReadWindow).text.data()};
    program.addTask("LEVEL2", program.addChunk(&nothing));
    program.scan = {{RUNG_STEP_ADVANCE, RUNG_NONE, 8000}, {RUNG_STEP_RUN, 0, 1}};
  }

  FanucControl() {
    build(program_);
    build(other_);
    instance_.emplace(program_.link(), &control_);
    control_.powerOn(*instance_, PowerOn::Cold);
  }

  void set(uint32_t space, uint32_t byte, uint32_t bit, bool value) {
    instance_->memory().writeBit(space, byte, bit, value);
  }
  bool f(uint32_t byte, uint32_t bit) const { return (instance_->memory().readByte(kF, byte) >> bit & 1) != 0; }
  std::vector<std::string> shown() const {
    std::vector<std::string> texts;
    for (const ShownMessage& message : control_.messages(*instance_)) texts.push_back(control_.text(message));
    EXPECT_TRUE(control_.shows(*instance_, control_.messages(*instance_)));
    return texts;
  }
  std::vector<std::string> changes() {
    std::vector<std::string> lines;
    for (rung_message message; control_.nextChange(*instance_, message);) {
      char line[100];
      const size_t size = control_.describe(instance_->program(), message, line);
      const bool begins = message.op == RUNG_MESSAGE_SHOW;
      lines.push_back(begins ? "+" + std::string(line, size) : "-" + std::to_string(message.number));
    }
    return lines;
  }
  // Rungs that the test plays go on requesting these messages in the next program.
  void replaceBy(const test::TestProgram& next) {
    runtime::Replacement replacement(instance_->program(), {next.program});
    ASSERT_EQ(instance_->replace(replacement), runtime::ReplaceResult::Replaced);
    for (const auto& [byte, bit] : {std::pair{0u, 1u}, {1u, 0u}, {1u, 7u}}) set(kA, byte, bit, true);
  }

  using Lines = std::vector<std::string>;
  test::TestProgram program_, other_;
  PmcControl control_{fanuc::model()};
  std::optional<runtime::Instance> instance_;
};

TEST_F(FanucControl, MessagesNeedTheirBitAndTheDisplay) {
  set(kA, 0, 1, true);
  EXPECT_EQ(shown(), Lines{});
  EXPECT_EQ(changes(), Lines{});
  EXPECT_FALSE(control_.showsAlarm(*instance_));
  set(kDisplay, 0, 0, true);
  EXPECT_EQ(shown(), Lines{"message EX1000 \"DOOR OPEN\""});
  EXPECT_EQ(changes(), Lines{"+EX1000 DOOR OPEN"});
  EXPECT_EQ(changes(), Lines{});
  EXPECT_TRUE(control_.showsAlarm(*instance_));
  set(kDisplay, 0, 0, false);
  EXPECT_EQ(shown(), Lines{});
  EXPECT_EQ(changes(), Lines{"-1000"});
}

TEST_F(FanucControl, NumbersDecideTheKind) {
  set(kDisplay, 0, 0, true);
  set(kA, 1, 0, true);
  set(kA, 1, 7, true);
  EXPECT_EQ(shown(),
            (Lines{"message 2005 \"OIL LEVEL LOW\"", "message 2100 \"COOLANT ON\", shown without its number"}));
  EXPECT_EQ(changes(), (Lines{"+2005 OIL LEVEL LOW", "+2100 COOLANT ON"}));
  EXPECT_FALSE(control_.showsAlarm(*instance_));
  set(kA, 1, 0, false);
  EXPECT_EQ(changes(), Lines{"-2005"});
}

TEST_F(FanucControl, RequestsWithoutATextAreNotShown) {
  set(kDisplay, 0, 0, true);
  set(kA, 0, 0, true);
  set(kA, 60, 7, true);
  EXPECT_EQ(shown(), Lines{});
  EXPECT_EQ(changes(), Lines{});
}

// K918 shifts to the texts of another language; what it does not have stays.
TEST_F(FanucControl, Languages) {
  set(kDisplay, 0, 0, true);
  instance_->memory().writeByte(kK, 918, 400 & 0xFF);
  instance_->memory().writeByte(kK, 919, 400 >> 8);
  set(kA, 0, 1, true);
  set(kA, 1, 0, true);
  EXPECT_EQ(shown(), (Lines{"message EX1000 \"TUER OFFEN\"", "message 2005 \"OIL LEVEL LOW\""}));
  EXPECT_EQ(changes(), (Lines{"+EX1000 TUER OFFEN", "+2005 OIL LEVEL LOW"}));
  instance_->memory().writeByte(kK, 918, 0);
  instance_->memory().writeByte(kK, 919, 0);
  EXPECT_EQ(changes(), (Lines{"-1000", "+EX1000 DOOR OPEN"}));
  EXPECT_EQ(changes(), Lines{});
}

// All ends come first, because a number may go to another bit.
TEST_F(FanucControl, AnotherProgramChangesNumbersAndTexts) {
  other_.texts = {{2, 0, "2005 DOOR OPEN"}, {9, 0, "1000 OIL LEVEL LOW"}, {16, 0, "2100 COOLANT ON"}};
  other_.link();
  set(kDisplay, 0, 0, true);
  for (const auto& [byte, bit] : {std::pair{0u, 1u}, {1u, 0u}, {1u, 7u}}) set(kA, byte, bit, true);
  EXPECT_EQ(changes(), (Lines{"+EX1000 DOOR OPEN", "+2005 OIL LEVEL LOW", "+2100 COOLANT ON"}));
  replaceBy(other_);
  EXPECT_EQ(changes(), (Lines{"-1000", "-2005", "+2005 DOOR OPEN", "+EX1000 OIL LEVEL LOW"}));
  EXPECT_EQ(changes(), Lines{});
}

TEST_F(FanucControl, AnotherProgramChangesATextAlone) {
  other_.texts[1].text = "2005 OIL LEVEL VERY LOW";
  other_.texts.erase(other_.texts.begin() + 2);
  other_.link();
  replaceBy(program_);
  set(kDisplay, 0, 0, true);
  EXPECT_EQ(changes(), (Lines{"+EX1000 DOOR OPEN", "+2005 OIL LEVEL LOW", "+2100 COOLANT ON"}));
  replaceBy(other_);
  EXPECT_EQ(changes(), (Lines{"-2005", "-2100", "+2005 OIL LEVEL VERY LOW"}));
}

// That of a smaller type of the PMC.
TEST_F(FanucControl, AnotherProgramHasFewerMessages) {
  test::TestProgram smaller;
  build(smaller, 1);
  smaller.link();
  set(kDisplay, 0, 0, true);
  set(kA, 0, 1, true);
  set(kA, 1, 0, true);
  EXPECT_EQ(changes(), (Lines{"+EX1000 DOOR OPEN", "+2005 OIL LEVEL LOW"}));
  runtime::Replacement replacement(instance_->program(), {smaller.program});
  ASSERT_EQ(instance_->replace(replacement), runtime::ReplaceResult::Replaced);
  set(kA, 0, 1, true);
  EXPECT_EQ(changes(), Lines{"-2005"});
  instance_.reset();
}

// As when the new program faults at once: what the host knows is right again.
TEST_F(FanucControl, TheFormerProgramIsBackBeforeTheHostHears) {
  other_.texts[1].text = "2006 OTHERWISE";
  other_.link();
  set(kDisplay, 0, 0, true);
  set(kA, 0, 1, true);
  EXPECT_EQ(changes(), Lines{"+EX1000 DOOR OPEN"});
  replaceBy(other_);
  replaceBy(program_);
  EXPECT_EQ(changes(), (Lines{"+2005 OIL LEVEL LOW", "+2100 COOLANT ON"}));
  control_.powerOn(*instance_, PowerOn::Cold);
  EXPECT_EQ(changes(), Lines{}) << "after a power-on the host knows that none is shown";
}

// Code in one slot, strobe in the next, until FIN has risen and fallen.
TEST_F(FanucControl, FunctionsOfABlock) {
  PmcFunctions& functions = *control_.functions(0);
  const pmc::SignalsIo& io = *control_.signals();
  using Line = PmcFunctions::Line;
  ASSERT_TRUE(functions.start(io, Line::M, 30));
  ASSERT_TRUE(functions.start(io, Line::M2, 7));
  ASSERT_TRUE(functions.start(io, Line::M5, 70'000));
  ASSERT_TRUE(functions.start(io, Line::B, 5));
  EXPECT_EQ(instance_->memory().read(kF, 10, 4), 30u);
  EXPECT_EQ(instance_->memory().read(kF, 14, 2), 7u);
  EXPECT_EQ(instance_->memory().read(kF, 572, 4), 70'000u);
  EXPECT_TRUE(f(9, 4)); // DM30
  EXPECT_FALSE(f(7, 0));
  functions.step();
  for (const auto& [byte, bit] : {std::pair{7u, 0u}, {8u, 4u}, {8u, 7u}, {7u, 7u}}) EXPECT_TRUE(f(byte, bit)) << bit;
  EXPECT_FALSE(f(8, 5));
  EXPECT_FALSE(functions.start(io, Line::T, 1)) << "others wait";
  set(kG, 4, 3, true);
  functions.step(); // has been absent
  functions.step();
  EXPECT_EQ(instance_->memory().readByte(kF, 8), 0);
  set(kG, 4, 3, false);
  functions.step();
  EXPECT_FALSE(functions.busy());
  EXPECT_EQ(instance_->memory().read(kF, 572, 4), 0u);
}

TEST_F(FanucControl, HighSpeedFunctionsFinishByTheirOwnSignals) {
  Functions& functions = *control_.functions(0);
  ASSERT_TRUE(functions.useHighSpeed());
  const auto tool = functions.start(FunctionKind::T, 12);
  const auto second = functions.start(FunctionKind::B, 3);
  ASSERT_TRUE(tool && second);
  functions.step();
  EXPECT_TRUE(f(7, 3));
  set(kG, 5, 7, true); // BFIN
  functions.step();
  EXPECT_FALSE(functions.busy(*second));
  EXPECT_TRUE(functions.busy(*tool));
  set(kG, 5, 3, true); // TFIN
  functions.step();
  EXPECT_FALSE(functions.busy(*tool));
}

TEST_F(FanucControl, WithoutACncWindowsEndWithNoSuchFunction) {
  core::ServiceName name{fanuc::service(pmc::ServiceKind::ReadWindow).text.data(),
                         static_cast<uint32_t>(pmc::ServiceKind::ReadWindow)};
  const core::ServiceReply reply = control_.refuse({.ticket = 3, .name = &name});
  EXPECT_EQ(reply.state, uint32_t{RUNG_SERVICE_DONE});
  EXPECT_EQ(reply.resultCount, fanuc::kReadDataAt + fanuc::kWindowWords);
  EXPECT_EQ(reply.results[0], fanuc::kWindowNoFunction);
  EXPECT_EQ(reply.results[1], 0);
}

TEST_F(FanucControl, SignalsByName) {
  EXPECT_EQ(control_.readPlace(instance_->program(), "*sstp"), runtime::bitRef(kG, 29, 6));
  EXPECT_EQ(control_.readPlace(instance_->program(), "S00~S31"), runtime::intRef(kF, 22, 32));
  EXPECT_EQ(control_.readPlace(instance_->program(), "KEY_AUTO"), std::nullopt); // GSK's
}

// The groups are A to D.
TEST_F(FanucControl, AxisGroups) {
  EXPECT_TRUE(control_.setAxisGroup(7, 3));
  EXPECT_FALSE(control_.setAxisGroup(0, 4));
  EXPECT_FALSE(control_.setAxisGroup(8, 0));
}

} // namespace
} // namespace rung::nc
