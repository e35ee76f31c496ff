// The handshake of NCT's functions, rule by rule (man. l.9440-9566, 10180-10317). The test plays the PLC.
#include "rtlib/nc/control/nct/nct_functions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <memory>

#include "rtlib/nc/control/nct/nct_control.h"
#include "tests/unit/rtlib/test_program.h"

namespace rung::nc {
namespace {

using nct::BitSignal;
using nct::WordSignal;
using ::testing::ElementsAre;
using ::testing::Optional;

constexpr uint32_t kSlices = 5;
constexpr FunctionKind M = FunctionKind::M, S = FunctionKind::S, T = FunctionKind::T, B = FunctionKind::B;

class NctHandshake : public ::testing::Test {
protected:
  NctHandshake() {
    constexpr uint32_t kBytes = 16000;
    program_.dialect = "nct";
    program_.memorySize = 2 * kBytes;
    program_.addPacked("M", 4, kBytes, 0);
    program_.addPacked("TS", 4, kBytes, kBytes);
    program_.addTask("MAIN", program_.addChunk([](uint8_t*, rung_ctx* ctx, uint32_t) { return test::popChunk(ctx); }));
    for (uint32_t i = 0; i < kSlices; ++i) {
      program_.scan.push_back({RUNG_STEP_ADVANCE, RUNG_NONE, 2000});
      program_.scan.push_back({RUNG_STEP_HOOK, RUNG_NONE, 0});
    }
    program_.scan.push_back({RUNG_STEP_RUN, 0, 1});
    instance_ = std::make_unique<runtime::Instance>(program_.link(), &control_);
    control_.powerOn(*instance_, PowerOn::Cold);
    signals_ = nct::SignalMemory(*instance_);
    for (uint32_t channel : {0u, 1u}) atRest(channel);
  }

  // The program initialises its acknowledges (l.10271).
  void atRest(uint32_t channel) {
    for (const char* name : {"CP_M1ACK", "CP_M2ACK", "CP_M3ACK", "CP_M4ACK", "CP_M5ACK", "CP_M6ACK", "CP_M7ACK",
                             "CP_M8ACK", "CP_SACK", "CP_TACK", "CP_AUX1ACK", "CP_FIN"})
      set(name, true, channel);
  }
  void set(const char* name, bool value, uint32_t channel = 0) { signals_.set(nct::BitSignal(name), channel, value); }
  bool get(const char* name, uint32_t channel = 0) { return signals_.get(nct::BitSignal(name), channel); }
  int32_t word(const char* name, uint32_t channel = 0) { return signals_.get(nct::WordSignal(name), channel); }

  NctFunctions& functions(uint32_t channel = 0) { return *control_.functions(channel); }
  void slices(uint32_t count) {
    for (uint32_t i = 0; i < count; ++i) {
      instance_->slice();
      control_.afterSlice(*instance_);
      functions(0).step();
      functions(1).step();
    }
  }
  // Rest of the PLC cycle, then what MAIN does at its end, and the beginning of the next.
  void cycle(const std::function<void()>& plc = [] {}) {
    do {
      instance_->slice();
      control_.afterSlice(*instance_);
      if (instance_->atListStart()) plc();
      functions(0).step();
      functions(1).step();
    } while (!instance_->atListStart());
  }

  NctControl control_;
  test::TestProgram program_;
  std::unique_ptr<runtime::Instance> instance_;
  nct::SignalMemory signals_;
};

TEST_F(NctHandshake, TheStrobeIsThereForOnePlcCycle) {
  EXPECT_THAT(functions().start(M, 8), Optional(0u));
  for (uint32_t i = 0; i < kSlices; ++i) {
    EXPECT_EQ(word("CN_M1C"), 8);
    EXPECT_TRUE(get("CN_M1STB")) << i;
    slices(1);
  }
  EXPECT_FALSE(get("CN_M1STB"));
  EXPECT_EQ(word("CN_M1C"), 8);
}

TEST_F(NctHandshake, ItEndsWhenTheAcknowledgeIsBack) {
  functions().start(M, 8);
  cycle([&] { set("CP_M1ACK", false), set("CP_FIN", false); });
  EXPECT_TRUE(functions().busy(0));
  cycle();
  EXPECT_TRUE(functions().busy(0));
  cycle([&] { set("CP_M1ACK", true), set("CP_FIN", true); });
  EXPECT_FALSE(functions().busy(0));
}

// The acknowledge from before is not an answer while MAIN has not seen the strobe.
TEST_F(NctHandshake, AnAcknowledgeOfBeforeIsNoAnswer) {
  functions().start(T, 5);
  for (uint32_t i = 1; i < kSlices; ++i) {
    slices(1);
    EXPECT_TRUE(functions().busy(NctFunctions::kTool)) << i;
  }
}

// A function that the program carries out in the cycle of the strobe, or does not know (l.9494).
TEST_F(NctHandshake, TheAcknowledgeNeedNotGoAway) {
  functions().start(M, 99);
  cycle();
  EXPECT_FALSE(functions().busy(0));
}

TEST_F(NctHandshake, WithoutAnAnswerItStays) {
  functions().start(M, 6);
  cycle([&] { set("CP_M1ACK", false); });
  for (int i = 0; i < 1000; ++i) cycle();
  EXPECT_TRUE(functions().busy(0));
  EXPECT_FALSE(get("CN_M1STB"));
}

// CP_FIN: from the program's side nothing suspends the part program (l.10180-10192).
TEST_F(NctHandshake, CpFinMayBeKeptBack) {
  functions().start(M, 6);
  cycle([&] { set("CP_FIN", false); });
  cycle();
  EXPECT_TRUE(functions().busy(0));
  cycle([&] { set("CP_FIN", true); });
  EXPECT_FALSE(functions().busy(0));
}

// Two kinds side by side: CP_FIN is 0 for the tool, the acknowledge of M is there for M.
TEST_F(NctHandshake, OtherKindsAreNotWaitedFor) {
  functions().start(T, 5);
  cycle([&] { set("CP_TACK", false), set("CP_FIN", false); });
  EXPECT_THAT(functions().start(M, 5), Optional(0u));
  EXPECT_EQ(functions().start(T, 6), std::nullopt);
  cycle([&] { set("CP_M1ACK", false); });
  EXPECT_TRUE(functions().busy(0));
  cycle([&] { set("CP_M1ACK", true); });
  EXPECT_FALSE(functions().busy(0));
  EXPECT_TRUE(functions().busy(NctFunctions::kTool));
  EXPECT_EQ(word("CN_TC"), 5);
}

// Eight lines of M codes; one begins in a PLC cycle, so that the program has their order.
TEST_F(NctHandshake, MCodesTakeFreeLines) {
  std::vector<uint32_t> lines;
  for (uint32_t i = 0; i < NctFunctions::kCodes; ++i) {
    lines.push_back(functions().start(M, 20 + i).value_or(99));
    EXPECT_EQ(functions().start(M, 40), std::nullopt);
    const std::string acknowledge = "CP_M" + std::to_string(i + 1) + "ACK";
    cycle([&] { set(acknowledge.c_str(), false), set("CP_FIN", false); });
  }
  EXPECT_THAT(lines, ElementsAre(0u, 1u, 2u, 3u, 4u, 5u, 6u, 7u));
  EXPECT_EQ(functions().start(M, 40), std::nullopt);
  EXPECT_EQ(word("CN_M8C"), 27);
  cycle([&] { set("CP_M5ACK", true); });
  EXPECT_FALSE(functions().busy(4));
  EXPECT_THAT(functions().start(M, 40), Optional(4u));
  EXPECT_EQ(word("CN_M5C"), 40);
}

TEST_F(NctHandshake, NothingBeginsWithinACycle) {
  slices(2);
  EXPECT_EQ(functions().start(M, 3), std::nullopt);
  EXPECT_FALSE(get("CN_M1STB"));
  slices(kSlices - 2);
  EXPECT_THAT(functions().start(M, 3), Optional(0u));
}

TEST_F(NctHandshake, AnAbortDropsTheStrobe) {
  functions().start(M, 3);
  slices(2);
  functions().abort();
  EXPECT_FALSE(get("CN_M1STB"));
  EXPECT_FALSE(functions().busy(0));
  slices(kSlices - 2);
  EXPECT_FALSE(functions().busy(0));
}

// The program still carries out what was aborted: its answer to that is not one to the next function.
TEST_F(NctHandshake, AfterAnAbortALineIsFreeWhenItsAcknowledgeIsBack) {
  functions().start(M, 3);
  functions().start(T, 5);
  cycle([&] { set("CP_M1ACK", false), set("CP_TACK", false); });
  functions().abort();
  EXPECT_FALSE(functions().busy(0));
  EXPECT_FALSE(functions().busy(NctFunctions::kTool));
  EXPECT_THAT(functions().start(M, 5), Optional(1u));
  EXPECT_EQ(functions().start(T, 6), std::nullopt);
  cycle([&] { set("CP_TACK", true); });
  EXPECT_THAT(functions().start(T, 6), Optional(NctFunctions::kTool));
}

TEST_F(NctHandshake, NothingBeginsBeforeTheAcknowledgesAreInitialised) {
  set("CP_SACK", false);
  EXPECT_EQ(functions().start(S, 1000), std::nullopt);
  cycle([&] { set("CP_SACK", true); });
  EXPECT_THAT(functions().start(S, 1000), Optional(NctFunctions::kSpeed));
}

TEST_F(NctHandshake, SpeedGoesToASpindle) {
  functions().start(S, 1500);
  EXPECT_EQ(word("CN_SC"), 1500);
  EXPECT_EQ(word("CN_SSEL"), 1);
  EXPECT_EQ(word("CN_RNGREQ"), 11);
  EXPECT_TRUE(get("CN_SSTB"));
  cycle();
  signals_.set(WordSignal("CN_SSEL"), 0, 2);
  signals_.set(WordSignal("CN_RNGREQ"), 0, 14);
  functions().start(S, 100);
  EXPECT_EQ(word("CN_SSEL"), 2);
  EXPECT_EQ(word("CN_RNGREQ"), 14);
}

TEST_F(NctHandshake, BIsAuxiliaryFunction1) {
  EXPECT_THAT(functions().start(B, 0xFFFFFFFF), Optional(NctFunctions::kAuxiliary));
  EXPECT_EQ(word("CN_AUX1C"), -1);
  EXPECT_TRUE(get("CN_AUX1STB"));
}

TEST_F(NctHandshake, ChannelsHaveTheirOwnSignals) {
  functions(1).start(M, 51);
  EXPECT_EQ(word("CN_M1C", 1), 51);
  EXPECT_TRUE(get("CN_M1STB", 1));
  EXPECT_FALSE(get("CN_M1STB", 0));
  cycle([&] { set("CP_M1ACK", false, 1), set("CP_FIN", false, 1); });
  EXPECT_THAT(functions(0).start(M, 3), Optional(0u));
  cycle();
  EXPECT_FALSE(functions(0).busy(0));
  EXPECT_TRUE(functions(1).busy(0));
  functions(0).abort();
  EXPECT_TRUE(functions(1).busy(0));
  EXPECT_NE(control_.functions(7), nullptr);
  EXPECT_EQ(control_.functions(8), nullptr);
}

TEST_F(NctHandshake, APowerOnLeavesNoneUnderWay) {
  functions().start(M, 3);
  control_.powerOn(*instance_, PowerOn::Cold);
  EXPECT_FALSE(functions().busy(0));
}

} // namespace
} // namespace rung::nc
