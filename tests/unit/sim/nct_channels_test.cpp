// Part programs of the simulated NCT control: the reader, what channels refuse, codes handed over (man. 7.15). What the
// reader says about mistakes is a golden (golden_test.cpp).
#include <gtest/gtest.h>

#include <random>

#include "sim/nct/axes.h"
#include "sim/nct/channels.h"
#include "sim/nct/parameters.h"
#include "sim/nct/spindles.h"
#include "sim/nct/tool_management.h"

namespace rung::sim::nct {
namespace {

ChannelProgram read(std::string_view text) {
  ChannelProgram program;
  EXPECT_EQ(readChannelProgram(text, program), "") << text;
  return program;
}

TEST(ChannelProgram, Words) {
  const ChannelProgram program = read("O12 N1 G0 x-1.5 Y+2;; (nothing) ;\nN20 m3 S3=1000 T#500 P2");
  ASSERT_EQ(program.blocks.size(), 2U);
  EXPECT_EQ(program.blocks[0].sequence, 1U);
  ASSERT_EQ(program.blocks[0].words.size(), 3U);
  EXPECT_EQ(program.blocks[0].words[1].letter, 'X');
  EXPECT_EQ(program.blocks[0].words[1].value.number, -1.5);
  EXPECT_EQ(program.blocks[0].words[2].value.number, 2);
  EXPECT_EQ(program.blocks[1].words[1].letter, 'S');
  EXPECT_EQ(program.blocks[1].words[1].spindle, 3U);
  EXPECT_EQ(program.blocks[1].words[1].value.number, 1000);
  EXPECT_EQ(program.blocks[1].words[2].value.variable, 500U);
}

TEST(ChannelProgram, ConditionsAssignmentsJumps) {
  const ChannelProgram program = read("/ M1; /8 #100 = 2.5 #101=#100; N7 IF #1025 EQ 1 GOTO 7; #5NE#6GOTO7; GOTO 7 M8");
  EXPECT_EQ(program.blocks[0].condition, 1U);
  EXPECT_EQ(program.blocks[1].condition, 8U);
  ASSERT_EQ(program.blocks[1].assignments.size(), 2U);
  EXPECT_EQ(program.blocks[1].assignments[0].value.number, 2.5);
  EXPECT_EQ(program.blocks[1].assignments[1].value.variable, 100U);
  const auto jump = [&](size_t block) { return program.blocks[block].jump.value_or(ProgramJump{}); };
  EXPECT_EQ(jump(2).test, ProgramJump::Test::Eq);
  EXPECT_EQ(jump(2).variable, 1025U);
  EXPECT_EQ(jump(3).test, ProgramJump::Test::Ne);
  EXPECT_EQ(jump(3).value.variable, 6U);
  EXPECT_EQ(jump(4).test, ProgramJump::Test::Always);
  EXPECT_EQ(jump(4).target, 7U);
}

// No text makes the reader do anything but answer.
TEST(ChannelProgram, AnyText) {
  constexpr std::string_view kPieces[] = {"M", "3", "#",  "=", ";", "GOTO", "IF", "EQ",  "(",   ")", "/",
                                          "9", "N", "G1", "X", "-", ".",    " ",  "S3=", "1e9", "T5"};
  std::mt19937 random(7);
  size_t good = 0;
  for (int i = 0; i < 20000; ++i) {
    std::string text;
    for (uint32_t n = random() % 12; n > 0; --n) text += kPieces[random() % std::size(kPieces)];
    ChannelProgram program;
    if (readChannelProgram(text, program).empty()) {
      ++good;
      EXPECT_FALSE(program.blocks.empty()) << text;
    }
  }
  EXPECT_GT(good, 200U);
}

class ChannelsTest : public testing::Test {
protected:
  ChannelsTest() {
    parameters_.powerOn(nc::PowerOn::Cold);
    channels_.powerOn(nc::PowerOn::Cold);
  }
  static NcArgument number(std::string key, int64_t value) { return {.key = std::move(key), .integer = value}; }
  static NcArgument text(std::string key, std::string value) {
    return {.key = std::move(key), .isText = true, .text = std::move(value)};
  }
  std::string load(const std::vector<NcArgument>& keys) {
    return channels_.event("program", keys).value_or("not an event");
  }

  Links links() {
    Links control;
    control.parameters = &parameters_;
    control.spindles = &spindles_;
    control.axes = &axes_;
    control.macros = &macros_;
    control.tools = &tools_;
    return control;
  }

  Links links_ = links(); // topics look at each other when they are made
  Parameters parameters_{links_};
  Spindles spindles_{links_};
  Axes axes_{links_};
  Macros macros_{links_};
  ToolManagement tools_{links_};
  Channels channels_{links_};
};

TEST_F(ChannelsTest, LoadsAndSelects) {
  EXPECT_EQ(load({number("number", 100), text("blocks", "M3")}), "");
  EXPECT_EQ(channels_.quantity("PROGRAM.2"), 0);
  EXPECT_TRUE(channels_.hasProgram(100));
  EXPECT_FALSE(channels_.hasProgram(101));
  EXPECT_EQ(load({number("number", 100), number("channel", 2)}), "");
  EXPECT_EQ(channels_.quantity("PROGRAM.2"), 100);
  EXPECT_EQ(load({number("number", 101), number("channel", 2)}),
            "there is no program of that number; blocks=\"…\" makes one");
  EXPECT_EQ(load({number("number", 0), text("blocks", "M3")}), "event program takes number=1 to 99999999");
  EXPECT_EQ(load({number("number", 1), number("channel", 9), text("blocks", "M3")}), "channels are 1 to 8");
  EXPECT_EQ(load({number("number", 1), text("block", "M3")}), "event program does not know 'block'");
  EXPECT_EQ(load({number("number", 1), text("blocks", "M")}), "block 1: a number is missing after M");
  channels_.powerOn(nc::PowerOn::Warm);
  EXPECT_TRUE(channels_.hasProgram(100));
  channels_.powerOn(nc::PowerOn::Cold);
  EXPECT_FALSE(channels_.hasProgram(100));
}

TEST_F(ChannelsTest, RefusesUnknownAddressesAndContradictions) {
  EXPECT_EQ(load({number("number", 1), text("blocks", "K3")}), "the channel has no address K");
  EXPECT_EQ(load({number("number", 1), number("channel", 2), text("blocks", "X3")}), "the channel has no address X");
  EXPECT_EQ(parameters_.setQuantity("PARAM.1333.1", 'K'), "");
  EXPECT_EQ(load({number("number", 1), text("blocks", "K3")}), "");
  EXPECT_EQ(parameters_.setQuantity("PARAM.1341.1", 51), ""); // l.10875
  EXPECT_EQ(parameters_.setQuantity("PARAM.1357.1", 53), "");
  EXPECT_EQ(load({number("number", 1), text("blocks", "M51 M8; M52")}), "");
  EXPECT_EQ(load({number("number", 1), text("blocks", "M51 M53")}), "contradictory M codes");
}

TEST_F(ChannelsTest, EntersBlocks) {
  const auto enter = [&](std::string blocks) {
    return channels_.event("mdi", {text("blocks", std::move(blocks))}).value_or("not an event");
  };
  EXPECT_EQ(enter("M8"), ""); // jog mode after power-on
  EXPECT_EQ(enter("M8; M9"), "the manual modes execute a single block");
  EXPECT_EQ(enter("M"), "block 1: a number is missing after M");
  EXPECT_EQ(enter("K8"), "the channel has no address K");
  EXPECT_EQ(channels_.event("mdi", {}), "event mdi takes channel=1 to 8 and blocks=\"…\"");
  EXPECT_EQ(channels_.event("reset", {number("channel", 0)}), "channels are 1 to 8");
}

TEST_F(ChannelsTest, CountsParts) {
  EXPECT_EQ(channels_.setQuantity("PARTS.3", 7), "");
  EXPECT_EQ(channels_.quantity("PARTS.3"), 7);
  EXPECT_EQ(channels_.setQuantity("PARTSWANTED.9", 7), "channels are 1 to 8");
  EXPECT_EQ(channels_.setQuantity("PARTS.1", 0.5), "parts are counted in whole numbers");
  EXPECT_EQ(channels_.setQuantity("PART.1", 1), std::nullopt);
}

} // namespace
} // namespace rung::sim::nct
