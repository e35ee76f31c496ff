// Tool management of the simulated NCT control: the services MW 100 to MR 108, room in the cartridges, which tool a T
// code gets, life (man. 6.26, l.4297-5283; 7.14.1).
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

#include "rtlib/nc/nct/service_functions.h"
#include "sim/nct/tool_management.h"
#include "tests/unit/sim/nct_block.h"

namespace rung::sim::nct {
namespace {

using test::TestBlock;

constexpr int32_t kPlain = 0x11; // V C N E S

class Tools : public testing::Test {
protected:
  Tools() {
    links_.parameters = &parameters_;
    parameters_.powerOn(nc::PowerOn::Cold);
    tools_.powerOn(nc::PowerOn::Cold);
  }

  int32_t ask(uint32_t function, TestBlock& request) {
    Block block = request.block();
    const std::optional<int32_t> code = tools_.service(function, block);
    EXPECT_TRUE(code.has_value());
    EXPECT_TRUE(code && nc::nct::findServiceFunction(function)->hasCode(static_cast<uint32_t>(*code)))
        << "function " << function << " has no code " << *code;
    return code.value_or(-1);
  }
  int32_t ask(uint32_t function, TestBlock&& request) { return ask(function, request); }
  void set(std::string_view name, double value) { EXPECT_EQ(tools_.setQuantity(name, value), "") << name; }
  void config(std::string_view key, std::string_view value) { EXPECT_EQ(tools_.config(key, value), "") << key; }
  void tool(uint32_t data, int32_t type, int32_t status = 0, int32_t counter = 0, int32_t life = 0,
            int32_t info = kPlain) {
    const std::string row = "TOOL." + std::to_string(data) + ".";
    set(row + "TYPE", type);
    set(row + "INFO", info);
    set(row + "STATUS", status);
    set(row + "COUNTER", counter);
    set(row + "LIFE", life);
  }
  void put(uint32_t data, uint32_t cartridge, uint32_t pot) {
    set("POT." + std::to_string(cartridge) + "." + std::to_string(pot), data);
  }
  double value(std::string_view name) { return tools_.quantity(name).value_or(-1); }

  Links links_;
  Parameters parameters_{links_};
  ToolManagement tools_{links_};
};

TEST_F(Tools, ExchangeMovesDataNumbers) {
  tool(4, 150);
  put(4, 1, 2);
  EXPECT_EQ(ask(100, {4, 1, 2, 11, 1}), 0); // magazine to arm
  EXPECT_EQ(value("POT.1.2"), 0);
  EXPECT_EQ(value("POT.11.1"), 4);
  tool(7, 151);
  put(7, 10, 1);
  EXPECT_EQ(ask(100, {4, 11, 1, 10, 1}), 0); // arm and spindle
  EXPECT_EQ(value("POT.10.1"), 4);
  EXPECT_EQ(value("POT.11.1"), 7);
  EXPECT_EQ(ask(100, {4, 11, 1, 11, 1}), 0); // with itself: nothing
  EXPECT_EQ(value("POT.11.1"), 7);
}

TEST_F(Tools, ExchangeRefuses) {
  EXPECT_EQ(ask(100, {3, 1, 1, 1, 2}), 2);
  EXPECT_EQ(ask(100, {5, 1, 1, 1, 2}), 2);
  EXPECT_EQ(ask(100, {4, 0, 1, 1, 2}), 100);
  EXPECT_EQ(ask(100, {4, 3, 1, 1, 2}), 100);
  EXPECT_EQ(ask(100, {4, 12, 1, 1, 2}), 100);
  EXPECT_EQ(ask(100, {4, 1, 0, 1, 2}), 101);
  EXPECT_EQ(ask(100, {4, 1, 25, 1, 2}), 101);
  EXPECT_EQ(ask(100, {4, 10, 2, 1, 2}), 101);
  EXPECT_EQ(ask(100, {4, 1, 1, -1, 2}), 102);
  EXPECT_EQ(ask(100, {4, 1, 1, 2, 17}), 103);
}

TEST_F(Tools, SpindleCartridgesFollowTheParameter) {
  EXPECT_EQ(parameters_.setQuantity("PARAM.2922.2", 1), "");
  EXPECT_EQ(ask(105, {2, 20, 1}), 139);
  EXPECT_EQ(ask(105, {2, 21, 1}), 100);
  EXPECT_EQ(parameters_.setQuantity("PARAM.2922.2", 0), "");
  EXPECT_EQ(ask(105, {2, 20, 1}), 100);
  EXPECT_EQ(parameters_.setQuantity("PARAM.2922.2", 2), ""); // no standby without a spindle
  EXPECT_EQ(ask(105, {2, 21, 1}), 100);
}

TEST_F(Tools, EmptyPotForANormalTool) {
  for (uint32_t pot : {1u, 2u, 3u, 24u, 23u}) {
    tool(pot, 100);
    put(pot, 1, pot);
  }
  TestBlock both{7, 1, 2, 0, 10, 1};
  EXPECT_EQ(ask(101, both), 0);
  EXPECT_EQ(both[7], 4);
  EXPECT_EQ(both[8], 1);
  TestBlock tie{7, 1, 1, 0, 10, 1}; // pots 4 and 22 are three steps away
  EXPECT_EQ(ask(101, tie), 0);
  EXPECT_EQ(tie[7], 4);
  TestBlock negative{7, 1, 2, 2, 10, 1};
  EXPECT_EQ(ask(101, negative), 0);
  EXPECT_EQ(negative[7], 22); // round the end
  EXPECT_EQ(negative[8], 2);
  TestBlock positive{7, 1, 23, 1, 10, 1};
  EXPECT_EQ(ask(101, positive), 0);
  EXPECT_EQ(positive[7], 4);
  EXPECT_EQ(positive[8], 1);
  TestBlock unset{0, 1, 5, 0, 10, 1}; // the amount need not be set
  EXPECT_EQ(ask(101, unset), 0);
  EXPECT_EQ(unset[1], 7);
  EXPECT_EQ(unset[7], 5);
}

TEST_F(Tools, EmptyPotRefuses) {
  EXPECT_EQ(ask(101, {6, 1, 1, 0, 10, 1}), 2);
  EXPECT_EQ(ask(101, {8, 1, 1, 0, 10, 1}), 2);
  EXPECT_EQ(ask(101, {7, 4, 1, 0, 10, 1}), 100);
  EXPECT_EQ(ask(101, {7, 1, 25, 0, 10, 1}), 101);
  EXPECT_EQ(ask(101, {7, 1, 1, 0, 3, 1}), 102);
  EXPECT_EQ(ask(101, {7, 1, 1, 0, 10, 2}), 103);
  TestBlock spindle{7, 10, 1, 0, 1, 1}; // never searched, though it is empty
  spindle.word(7, 99);
  EXPECT_EQ(ask(101, spindle), 104);
  EXPECT_EQ(spindle[7], 0);
  config("cartridge.1", "2");
  tools_.powerOn(nc::PowerOn::Cold);
  tool(1, 1);
  tool(2, 1);
  put(1, 1, 1);
  put(2, 1, 2);
  EXPECT_EQ(ask(101, {7, 1, 1, 0, 10, 1}), 104);
}

// l.4556-4578: figure 5 takes 4 half pots to the left and 1 to the right.
TEST_F(Tools, LargeToolsInAChain) {
  config("cartridge.1", "12@5"); // pots 5 to 16
  tools_.powerOn(nc::PowerOn::Cold);
  set("PATTERN.5.LEFT", 4);
  set("PATTERN.5.RIGHT", 1);
  tool(1, 10, 0, 0, 0, kPlain | kInfoLarge);
  set("TOOL.1.FIGURE", 5);
  put(1, 1, 10); // takes 8, 9, 10 and half of 11
  tool(2, 11);
  put(2, 10, 1);
  const auto found = [&](int32_t start, int32_t direction) {
    TestBlock request{7, 1, start, direction, 10, 1};
    return ask(101, request) == 0 ? request[7] : -1;
  };
  EXPECT_EQ(found(8, 1), 12); // a normal tool does not go into half a pot
  EXPECT_EQ(found(11, 2), 7);
  // An oversize tool that takes half a pot to its left shares pot 11.
  tool(2, 11, 0, 0, 0, kPlain | kInfoLarge);
  set("TOOL.2.FIGURE", 2);
  set("PATTERN.2.LEFT", 1);
  EXPECT_EQ(found(8, 1), 12);
  set("PATTERN.2.LEFT", 2);
  EXPECT_EQ(found(8, 1), 13);
  set("PATTERN.2.LEFT", 0);
  set("PATTERN.2.RIGHT", 1);
  EXPECT_EQ(found(11, 2), 6); // 7 is full: pot 8 belongs to tool 1
  // The ring: pot 5 is the right neighbour of pot 16.
  put(1, 1, 6); // takes 4 half pots to the left: 5 and 16
  EXPECT_EQ(found(16, 2), 14);
  set("PATTERN.2.RIGHT", 0);
  EXPECT_EQ(found(16, 2), 15);
  // Without L the figure does not count (l.4380).
  tool(1, 10);
  EXPECT_EQ(found(5, 1), 5);
  // Figure 0: one pot.
  tool(1, 10, 0, 0, 0, kPlain | kInfoLarge);
  set("TOOL.1.FIGURE", 0);
  EXPECT_EQ(found(6, 2), 5);
  // Wider than the ring.
  set("PATTERN.2.LEFT", 12);
  set("PATTERN.2.RIGHT", 12);
  EXPECT_EQ(found(5, 0), -1);
}

// The tool that is already in the target cartridge does not stand in its own way.
TEST_F(Tools, ALargeToolMovesWithinItsCartridge) {
  set("PATTERN.1.LEFT", 2);
  tool(1, 10, 0, 0, 0, kPlain | kInfoLarge);
  set("TOOL.1.FIGURE", 1);
  put(1, 1, 5);
  TestBlock request{7, 1, 5, 1, 1, 5};
  EXPECT_EQ(ask(101, request), 0);
  EXPECT_EQ(request[7], 5);
}

// l.4600-4611: figure 1 is a rectangle, figure 2 a circle whose corners stay empty.
TEST_F(Tools, LargeToolsInAMatrix) {
  config("cartridge.3", "5x6");
  tools_.powerOn(nc::PowerOn::Cold);
  for (const char* side : {"LEFT", "RIGHT", "UP", "DOWN"}) set(std::string("PATTERN.2.") + side, 3);
  tool(1, 10, 0, 0, 0, kPlain | kInfoLarge);
  set("TOOL.1.FIGURE", 2);
  put(1, 3, 15); // third row, third column
  const auto free = [&] {
    std::set<int32_t> pots;
    for (int32_t pot = 1; pot <= 30; ++pot) {
      TestBlock request{7, 3, pot, 1, 10, 1};
      if (ask(101, request) == 0 && request[7] == pot) pots.insert(pot);
    }
    return pots;
  };
  // Half of the pots two away is taken; column 6 is free.
  EXPECT_EQ(free(), (std::set<int32_t>{6, 12, 18, 24, 30}));
  set("PATTERN.2.ROUND", 1);
  EXPECT_EQ(free(), (std::set<int32_t>{1, 5, 6, 12, 18, 24, 25, 29, 30}));
  set("TOOL.1.FIGURE", 1);
  set("PATTERN.1.LEFT", 1);
  set("PATTERN.1.RIGHT", 3);
  set("PATTERN.1.UP", 2);
  set("PATTERN.1.DOWN", 1);
  // Rows 2 to 4 (half of 4), columns 2 (half) to 5 (half).
  EXPECT_EQ(free(), (std::set<int32_t>{1, 2, 3, 4, 5, 6, 7, 12, 13, 18, 19, 24, 25, 26, 27, 28, 29, 30}));
  // At the edge a tool may stand out.
  put(1, 3, 1);
  EXPECT_EQ(free().count(1), 0U);
  EXPECT_EQ(free().count(4), 1U);
  EXPECT_EQ(free().count(13), 1U);
}

TEST_F(Tools, RegistersATool) {
  tool(1, 9);
  EXPECT_EQ(ask(102, {3, 1, 7, 150}), 0); // the type number alone
  EXPECT_EQ(value("POT.1.7"), 2);
  EXPECT_EQ(value("TOOL.2.TYPE"), 150);
  EXPECT_EQ(value("TOOL.2.INFO"), kPlain);
  TestBlock record{55, 1, 8, 99'999'999, 0x1F, 20, 4, 5, 6, 7, 200, 200, 200, 200, 12500};
  record.real(16, 3000.5).word(18, 255);
  for (uint32_t user = 2; user <= 20; ++user) record.real(15 + 2 * user, user + 0.5);
  EXPECT_EQ(ask(102, record), 0);
  EXPECT_EQ(value("POT.1.8"), 3);
  TestBlock read{55, 1, 8};
  EXPECT_EQ(ask(104, read), 0);
  for (uint32_t n = 2; n <= 56; ++n) EXPECT_EQ(read[n], record[n]) << n;
  EXPECT_FALSE(read.answered(3));
  EXPECT_TRUE(read.answered(4));
  EXPECT_TRUE(read.answered(56));
}

TEST_F(Tools, AnInvalidRowIsFreeEvenInAPot) {
  tool(1, 9);
  put(1, 1, 1);
  EXPECT_EQ(ask(106, {4, 1, 1, 2, kPlain & ~1}), 0);
  EXPECT_EQ(ask(102, {3, 10, 1, 150}), 0);
  EXPECT_EQ(value("POT.10.1"), 1);
  EXPECT_EQ(value("POT.1.1"), 0);
}

TEST_F(Tools, TheTableFillsUp) {
  config("tool.rows", "2");
  tools_.powerOn(nc::PowerOn::Cold);
  EXPECT_EQ(ask(102, {3, 1, 1, 1}), 0);
  EXPECT_EQ(ask(102, {3, 1, 2, 1}), 0);
  EXPECT_EQ(ask(102, {3, 1, 3, 1}), 138);
  EXPECT_EQ(ask(105, {2, 1, 1}), 0);
  EXPECT_EQ(ask(102, {3, 1, 3, 1}), 0);
}

TEST_F(Tools, AmountsAreWholeColumns) {
  tool(1, 9);
  put(1, 1, 1);
  for (uint32_t function : {102u, 103u, 104u})
    for (int32_t amount = -1; amount <= 60; ++amount) {
      TestBlock request{amount, 1, 1, 5, kPlain};
      const bool allowed = nc::nct::findServiceFunction(function)->allowsAmount(amount);
      EXPECT_EQ(ask(function, request), allowed ? 0 : 2) << function << " " << amount;
    }
  config("tool.userdata", "2");
  EXPECT_EQ(ask(103, {19, 1, 1, 5, kPlain}), 0);
  EXPECT_EQ(ask(103, {21, 1, 1, 5, kPlain}), 2);
  EXPECT_EQ(ask(104, {21, 1, 1}), 2);
}

// Every column has a code of its own: 104 + its number.
TEST_F(Tools, WrongValues) {
  const struct {
    ToolColumn column;
    int32_t word;
    double real;
  } kWrong[] = {{1, 0, 0},   {1, 100'000'000, 0}, {1, -5, 0},        {2, 32, 0},   {2, -1, 0},
                {3, 21, 0},  {4, 5, 0},           {4, -1, 0},        {5, -1, 0},   {6, -1, 0},
                {7, -1, 0},  {8, 201, 0},         {9, 201, 0},       {10, 201, 0}, {11, -1, 0},
                {12, -1, 0}, {13, 0, -1},         {13, 0, HUGE_VAL}, {14, 256, 0}, {15, 0, NAN}};
  tool(1, 9);
  put(1, 1, 1);
  for (const auto& c : kWrong) {
    TestBlock single{isRealColumn(c.column) ? 5 : 4, 1, 1, static_cast<int32_t>(c.column), c.word};
    TestBlock record{55, 1, 1, 5, kPlain};
    const uint32_t word = c.column <= 13 ? c.column + 3 : c.column == 14 ? 18 : 19;
    if (isRealColumn(c.column)) {
      single.real(5, c.real);
      record.real(word, c.real);
    } else {
      record.word(word, c.word);
    }
    const int32_t code = 104 + static_cast<int32_t>(c.column);
    EXPECT_EQ(ask(106, single), code) << c.column;
    EXPECT_EQ(ask(103, record), code) << c.column;
    EXPECT_EQ(ask(102, record), code) << c.column;
  }
  for (int32_t user = 2; user <= 20; ++user) {
    TestBlock single{5, 1, 1, 13 + user};
    EXPECT_EQ(ask(106, single.real(5, -HUGE_VAL)), 117 + user);
    TestBlock record{55, 1, 1, 5, kPlain};
    EXPECT_EQ(ask(103, record.real(static_cast<uint32_t>(15 + 2 * user), NAN)), 117 + user);
  }
  EXPECT_EQ(ask(102, {4, 1, 1, 5, kPlain & ~1}), 106); // registered as invalid
  EXPECT_EQ(value("TOOL.1.TYPE"), 9);                  // nothing was written
  EXPECT_EQ(value("POT.1.1"), 1);
  EXPECT_EQ(value("TOOL.2.TYPE"), 0);
}

TEST_F(Tools, PlacesAndToolsMustExist) {
  for (uint32_t function : {102u, 103u, 104u}) {
    EXPECT_EQ(ask(function, {3, 5, 1, 1}), 100);
    EXPECT_EQ(ask(function, {3, 2, 17, 1}), 101);
    if (function != 102) {
      EXPECT_EQ(ask(function, {3, 2, 16, 1}), 139);
    }
  }
  for (uint32_t function : {106u, 107u}) {
    EXPECT_EQ(ask(function, {4, 5, 1, 1, 1}), 100);
    EXPECT_EQ(ask(function, {4, 2, 17, 1, 1}), 101);
    EXPECT_EQ(ask(function, {4, 2, 16, 1, 1}), 139);
  }
  EXPECT_EQ(ask(105, {2, 5, 1}), 100);
  EXPECT_EQ(ask(105, {2, 2, 17}), 101);
  EXPECT_EQ(ask(105, {2, 2, 16}), 139);
  EXPECT_EQ(ask(105, {1, 2, 16}), 2);
  EXPECT_EQ(ask(105, {3, 2, 16}), 2);
}

TEST_F(Tools, OneDatum) {
  tool(1, 9);
  put(1, 10, 1);
  for (int32_t number = 1; number <= 33; ++number) {
    const auto column = static_cast<ToolColumn>(number);
    const int32_t amount = isRealColumn(column) ? 5 : 4;
    const int32_t info = column == kToolInfo ? kPlain : column == kToolStatus ? 2 : number;
    TestBlock write{amount, 10, 1, number, info};
    if (isRealColumn(column)) write.real(5, number * 1.25);
    EXPECT_EQ(ask(106, write), 0) << number;
    TestBlock read{amount, 10, 1, number};
    EXPECT_EQ(ask(107, read), 0) << number;
    EXPECT_EQ(read[5], write[5]) << number;
    EXPECT_EQ(read[6], write[6]) << number;
    EXPECT_EQ(read.answered(6), amount == 5) << number;
    // The other amount.
    TestBlock wrong{9 - amount, 10, 1, number, info};
    EXPECT_EQ(ask(106, wrong), 2) << number;
    EXPECT_EQ(ask(107, wrong), 2) << number;
  }
  for (uint32_t function : {106u, 107u}) {
    EXPECT_EQ(ask(function, {3, 10, 1, 1}), 2);
    EXPECT_EQ(ask(function, {6, 10, 1, 1}), 2);
    for (const int32_t number : {0, 34, -1}) EXPECT_EQ(ask(function, {4, 10, 1, number, 1}), 140);
  }
  config("tool.userdata", "0");
  EXPECT_EQ(ask(107, {4, 10, 1, 14}), 140);
}

TEST_F(Tools, ALockedRow) {
  tool(1, 9, 0, 0, 0, kPlain | kInfoDisabled);
  put(1, 1, 1);
  EXPECT_EQ(ask(103, {3, 1, 1, 5}), 3);
  EXPECT_EQ(ask(105, {2, 1, 1}), 3);
  EXPECT_EQ(ask(106, {4, 1, 1, 1, 5}), 3);
  EXPECT_EQ(ask(107, {4, 1, 1, 1}), 0);
  EXPECT_EQ(ask(100, {4, 1, 1, 10, 1}), 0); // the cartridge table is another one
  EXPECT_EQ(ask(106, {4, 10, 1, 2, kPlain}), 0);
  EXPECT_EQ(ask(106, {4, 10, 1, 1, 5}), 0);
}

TEST_F(Tools, SearchByUserData) {
  for (uint32_t i = 1; i <= 3; ++i) tool(i, 9);
  put(2, 1, 9);
  put(3, 1, 1);
  for (uint32_t i = 1; i <= 3; ++i) {
    set("TOOL." + std::to_string(i) + ".USER1", 0x80);
    set("TOOL." + std::to_string(i) + ".USER20", 2.5);
  }
  TestBlock bits{4, 0, 0, 14, 0x80}; // row 1 is in no pot, row 2 comes before row 3
  EXPECT_EQ(ask(108, bits), 0);
  EXPECT_EQ(bits[2], 1);
  EXPECT_EQ(bits[3], 9);
  TestBlock real{5, 0, 0, 33};
  EXPECT_EQ(ask(108, real.real(5, 2.5009)), 0); // ISB: closer than 0.001
  EXPECT_EQ(real[3], 9);
  EXPECT_EQ(ask(108, TestBlock{5, 0, 0, 33}.real(5, 2.5011)), 141);
  EXPECT_EQ(ask(108, {4, 0, 0, 14, 0x81}), 141);
  EXPECT_EQ(ask(108, {5, 0, 0, 14, 0x80}), 2);
  EXPECT_EQ(ask(108, {4, 0, 0, 33, 0}), 2);
  EXPECT_EQ(ask(108, {3, 0, 0, 14, 0}), 2);
  for (const int32_t number : {0, 13, 34}) EXPECT_EQ(ask(108, {4, 0, 0, number, 0}), 140);
}

TEST_F(Tools, WaitsWhileTheOperatorEdits) {
  EXPECT_EQ(tools_.event("tool", {{.key = "edit", .integer = 1}}), "");
  TestBlock request{7, 1, 1, 0, 10, 1};
  Block block = request.block();
  EXPECT_EQ(tools_.service(101, block), std::nullopt);
  EXPECT_EQ(parameters_.setQuantity("PARAM.1274", 1), ""); // MRW
  EXPECT_EQ(tools_.service(101, block), 0);
  TestBlock other{4, 1, 1, 1, 2};
  Block write = other.block();
  EXPECT_EQ(tools_.service(100, write), std::nullopt);
  EXPECT_EQ(tools_.event("tool", {{.key = "edit", .integer = 0}}), "");
  EXPECT_EQ(tools_.service(100, write), 0);
}

// l.4320-4340 and l.4362-4372: the example of the manual.
TEST_F(Tools, PicksTheMostUsedTool) {
  tool(1, 10'002'001, 3, 150, 150, 0x01);
  tool(2, 10'002'001, 2, 131, 200);
  tool(3, 10'002'001, 1, 0, 170);
  for (uint32_t i = 1; i <= 3; ++i) put(i, 1, i);
  EXPECT_EQ(tools_.pick(10'002'001).dataNumber, 2U);
  EXPECT_EQ(tools_.pick(10'002'001).place, (PotPlace{1, 2}));
  set("TOOL.3.COUNTER", 131);
  EXPECT_EQ(tools_.pick(10'002'001).dataNumber, 2U); // the same: the lower data number
  put(0, 1, 2);
  EXPECT_EQ(tools_.pick(10'002'001).dataNumber, 3U);
  EXPECT_FALSE(tools_.pick(10'002'001).expired);
  set("TOOL.2.STATUS", 4);
  set("TOOL.3.STATUS", 3);
  EXPECT_EQ(tools_.pick(10'002'001).dataNumber, 0U);
  EXPECT_EQ(tools_.pick(10'002'001).place, (PotPlace{0, 0}));
  EXPECT_TRUE(tools_.pick(10'002'001).expired);
  tool(4, 150, 0, 0, 0, 0x01); // U without life management
  put(4, 1, 4);
  EXPECT_EQ(tools_.pick(150).dataNumber, 0U);
  EXPECT_FALSE(tools_.pick(150).expired);
  set("TOOL.4.INFO", kPlain);
  EXPECT_EQ(tools_.pick(150).dataNumber, 4U);
  EXPECT_FALSE(tools_.pick(151).expired);
}

// The status follows counter and life (l.4385-4403).
TEST_F(Tools, StatusFollowsTheCounter) {
  tool(1, 9, 1, 0, 10);
  put(1, 1, 1);
  const auto write = [&](int32_t column, int32_t to) { EXPECT_EQ(ask(106, {4, 1, 1, column, to}), 0); };
  write(5, 3);
  EXPECT_EQ(value("TOOL.1.STATUS"), 2);
  write(5, 10);
  EXPECT_EQ(value("TOOL.1.STATUS"), 3);
  write(6, 11);
  EXPECT_EQ(value("TOOL.1.STATUS"), 2);
  write(5, 0);
  EXPECT_EQ(value("TOOL.1.STATUS"), 1);
  write(4, 4);
  write(5, 5);
  EXPECT_EQ(value("TOOL.1.STATUS"), 4); // broken stays broken
}

// ---- life ----------------------------------------------------------------------------------------------------------

class Life : public testing::Test {
protected:
  Life() {
    tables_.tools.build(10);
    const CartridgeShape shapes[] = {{.number = 1, .columns = 8}, {.number = 10}, {.number = 20}};
    tables_.cartridges.build(shapes, 10);
    life_.cycle(0, {}, true);
  }
  ToolRow& tool(uint32_t data, int32_t counter, int32_t life, int32_t notice = 0, uint32_t info = kPlain) {
    ToolRow& row = tables_.tools.row(data);
    row.setWord(kToolType, 7);
    row.setWord(kToolInfo, static_cast<int32_t>(info));
    row.setWord(kToolStatus, kLifeUsed);
    row.setWord(kToolCounter, counter);
    row.setWord(kToolLife, life);
    row.setWord(kToolNotice, notice);
    return row;
  }
  ToolRequests cycle(const ToolAnswers& answers = {}) { return life_.cycle(0, answers, true); }

  ToolTables tables_;
  ToolLife life_{tables_};
};

TEST_F(Life, CountsUsesToNoticeAndExpiry) {
  const ToolRow& row = tool(1, 6, 10, 3);
  tool(2, 0, 10);
  tables_.cartridges.put({10, 1}, 1);
  life_.countUse(0);
  EXPECT_EQ(row.word(kToolCounter), 7);
  EXPECT_TRUE(cycle().notice); // 10 - 7 reaches 3
  EXPECT_FALSE(cycle().notice);
  life_.countUse(0);
  EXPECT_FALSE(cycle().notice); // once
  life_.countUse(0);
  life_.countUse(0);
  EXPECT_EQ(row.status(), kLifeExpired);
  EXPECT_TRUE(cycle().individual);
  EXPECT_TRUE(cycle().individual); // until it is acknowledged
  EXPECT_FALSE(cycle().group);     // tool 2 is left
  EXPECT_FALSE(cycle({.individualDone = true}).individual);
  EXPECT_FALSE(cycle().individual);
  life_.countUse(0);
  EXPECT_EQ(row.word(kToolCounter), 10); // no further
}

TEST_F(Life, TheLastToolOfAGroup) {
  tool(1, 9, 10);
  tool(2, 10, 10).setWord(kToolStatus, kLifeExpired);
  tables_.cartridges.put({10, 1}, 1);
  life_.countUse(0);
  EXPECT_TRUE(cycle().individual);
  EXPECT_TRUE(cycle().group);
  EXPECT_FALSE(cycle({.groupDone = true}).group);
  EXPECT_TRUE(cycle().individual);
}

TEST_F(Life, SkipReportsABrokenTool) {
  const ToolRow& row = tool(1, 1, 10);
  tables_.cartridges.put({10, 1}, 1);
  ToolRequests requests = cycle({.skip = true});
  EXPECT_TRUE(requests.skipDone);
  EXPECT_FALSE(requests.individual); // after the acknowledge
  EXPECT_EQ(row.status(), kLifeBroken);
  requests = cycle({.skip = true});
  EXPECT_TRUE(requests.individual);
  EXPECT_TRUE(requests.group);
  EXPECT_TRUE(requests.skipDone);
  EXPECT_FALSE(cycle({.skip = false}).skipDone);
  life_.countUse(0);
  EXPECT_EQ(row.word(kToolCounter), 1);
}

TEST_F(Life, SkipWithoutATool) {
  EXPECT_TRUE(cycle({.skip = true}).skipDone);
  EXPECT_FALSE(cycle({.skip = true}).individual);
}

TEST_F(Life, CountingCanBeDisabled) {
  const ToolRow& row = tool(1, 1, 10);
  tables_.cartridges.put({10, 1}, 1);
  cycle({.countDisabled = true});
  life_.countUse(0);
  EXPECT_EQ(row.word(kToolCounter), 1);
  life_.cycle(0, {}, false); // without tool management
  life_.countUse(0);
  EXPECT_EQ(row.word(kToolCounter), 1);
  cycle();
  life_.countUse(0);
  EXPECT_EQ(row.word(kToolCounter), 2);
}

TEST_F(Life, WithoutToolManagementNothingIsRequested) {
  tool(1, 9, 10);
  tables_.cartridges.put({10, 1}, 1);
  life_.countUse(0);
  EXPECT_TRUE(cycle().individual);
  EXPECT_FALSE(life_.cycle(0, {.skip = true}, false).individual);
  EXPECT_FALSE(life_.cycle(0, {.skip = true}, false).skipDone);
  EXPECT_EQ(tables_.tools.row(1).status(), kLifeExpired);
}

TEST_F(Life, CountsSecondsOfMachining) {
  const ToolRow& timed = tool(1, 0, 3, 1, kPlain | kInfoTime);
  const ToolRow& counted = tool(2, 0, 3);
  tables_.cartridges.put({10, 1}, 1);
  tables_.cartridges.put({20, 1}, 2);
  life_.cycle(1, {}, true);
  for (int i = 0; i < 3; ++i) {
    life_.countTime(0, 400'000);
    life_.countTime(1, 400'000);
  }
  EXPECT_EQ(timed.word(kToolCounter), 1);
  EXPECT_EQ(counted.word(kToolCounter), 0);
  life_.countUse(0);
  EXPECT_EQ(timed.word(kToolCounter), 1);
  life_.countTime(0, 800'000);
  EXPECT_EQ(timed.word(kToolCounter), 2);
  EXPECT_TRUE(cycle().notice);
  life_.countTime(0, 1'000'000);
  EXPECT_EQ(timed.status(), kLifeExpired);
  EXPECT_TRUE(cycle().individual);
}

TEST_F(Life, WithoutALifeAToolIsCountedForEver) {
  const ToolRow& row = tool(1, 0, 0);
  tables_.cartridges.put({10, 1}, 1);
  for (int i = 0; i < 5; ++i) life_.countUse(0);
  EXPECT_EQ(row.word(kToolCounter), 5);
  EXPECT_EQ(row.status(), kLifeUsed);
}

// ---- random sequences ----------------------------------------------------------------------------------------------

// Any sequence of services leaves consistent tables: a data number in one pot at most and only of the table's rows, no
// tool lost but by MW 105, none doubled; a search's answer is free; a failed request changes nothing.
class RandomTools : public Tools, public testing::WithParamInterface<uint32_t> {
protected:
  RandomTools() {
    config("tool.rows", "12");
    config("cartridge.1", "7@3");
    config("cartridge.2", "3x4");
    tools_.powerOn(nc::PowerOn::Cold);
    for (uint32_t figure = 1; figure <= 20; ++figure)
      for (const char* side : {"LEFT", "RIGHT", "UP", "DOWN"})
        set("PATTERN." + std::to_string(figure) + "." + side, number(0, 3));
  }
  int32_t number(int32_t low, int32_t high) { return std::uniform_int_distribution<int32_t>(low, high)(random_); }
  int32_t cartridge() {
    constexpr int32_t kNumbers[] = {1, 1, 1, 2, 2, 2, 10, 11, 20, 3, 0};
    return kNumbers[static_cast<size_t>(number(0, 10))];
  }
  int32_t pot(int32_t c) {
    return number(0, 9) == 0 ? number(-1, 14) : c >= 10 ? 1 : c == 1 ? number(3, 9) : number(1, 12);
  }

  TestBlock request(uint32_t function) {
    const int32_t c = cartridge(), p = pot(c), d = cartridge();
    switch (function) {
    case 100: return {4, c, p, d, pot(d)};
    case 101: return {7, c, p, number(0, 3), d, pot(d)};
    case 102:
    case 103: {
      TestBlock block{
          number(3, 14), c,           p, number(1, 3), number(0, 31), number(0, 21), number(0, 5), number(0, 20),
          number(0, 10), number(0, 3)};
      return block;
    }
    case 104: return {number(2, 20), c, p};
    case 105: return {2, c, p};
    case 106: return {4, c, p, number(0, 14), number(0, 20)};
    case 107: return {number(4, 5), c, p, number(0, 34)};
    default: return {number(4, 5), 0, 0, number(13, 34), number(0, 2)};
    }
  }
  std::vector<uint32_t> pots() const {
    std::vector<uint32_t> all;
    for (uint32_t serial = 1; serial <= tables().cartridges.size(); ++serial)
      all.push_back(tables().cartridges.dataNumber(tables().cartridges.place(serial)));
    return all;
  }
  std::vector<int32_t> rows() const {
    std::vector<int32_t> all;
    for (uint32_t i = 1; i <= tables().tools.size(); ++i)
      for (ToolColumn column = 1; column <= kToolSpeed; ++column) all.push_back(tables().tools.row(i).word(column));
    return all;
  }
  const ToolTables& tables() const { return tools_.tables(); }
  size_t valid() const {
    size_t count = 0;
    for (uint32_t i = 1; i <= tables().tools.size(); ++i) count += tables().tools.row(i).valid() ? 1 : 0;
    return count;
  }
  void checkTables() const {
    std::set<uint32_t> seen;
    for (uint32_t serial = 1; serial <= tables().cartridges.size(); ++serial) {
      const PotPlace place = tables().cartridges.place(serial);
      const uint32_t tool = tables().cartridges.dataNumber(place);
      if (tool == 0) continue;
      EXPECT_TRUE(tables().tools.has(tool));
      EXPECT_TRUE(seen.insert(tool).second) << "tool " << tool << " stands twice";
      EXPECT_EQ(tables().cartridges.placeOf(tool), place);
    }
    for (uint32_t i = 1; i <= tables().tools.size(); ++i)
      if (!seen.contains(i)) {
        EXPECT_EQ(tables().cartridges.placeOf(i), std::nullopt);
      }
  }

  std::mt19937 random_{GetParam()};
};

TEST_P(RandomTools, TablesStayConsistent) {
  size_t done = 0;
  for (int step = 0; step < 4000 && !HasFailure(); ++step) {
    constexpr uint32_t kFunctions[] = {100, 101, 102, 103, 104, 105, 106, 107, 108, 100, 102, 102};
    const uint32_t function = kFunctions[static_cast<size_t>(number(0, 11))];
    TestBlock block = request(function);
    const std::vector<uint32_t> potsBefore = pots();
    const std::vector<int32_t> rowsBefore = rows();
    const size_t validBefore = valid();
    const int32_t code = ask(function, block);
    checkTables();
    if (code != 0 || nc::nct::findServiceFunction(function)->access == nc::nct::FunctionAccess::Read) {
      EXPECT_EQ(pots(), potsBefore) << function;
      EXPECT_EQ(rows(), rowsBefore) << function;
    }
    if (code != 0) continue;
    ++done;
    if (function == 100) {
      EXPECT_EQ(rows(), rowsBefore);
      EXPECT_EQ(std::multiset<uint32_t>(potsBefore.begin(), potsBefore.end()), [&] {
        const auto now = pots();
        return std::multiset<uint32_t>(now.begin(), now.end());
      }());
    }
    if (function == 102) {
      EXPECT_EQ(valid(), validBefore + 1);
    }
    if (function == 101) {
      const PotPlace found{static_cast<uint32_t>(block[2]), static_cast<uint32_t>(block[7])};
      const PotPlace source{static_cast<uint32_t>(block[5]), static_cast<uint32_t>(block[6])};
      const uint32_t there = tables().cartridges.dataNumber(found);
      EXPECT_TRUE(there == 0 || found == source);
    }
  }
  EXPECT_GT(done, 500U);
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomTools, testing::Range(1U, 9U));

} // namespace
} // namespace rung::sim::nct
