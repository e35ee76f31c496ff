// Pallet management of the simulated NCT control: the services MW 300 to MR 309 and MW 41 (man. 6.27, l.5287-5932).
#include <gtest/gtest.h>

#include <map>
#include <random>

#include "rtlib/nc/nct/service_functions.h"
#include "sim/nct/channels.h"
#include "sim/nct/pallets.h"
#include "tests/unit/sim/nct_block.h"

namespace rung::sim::nct {
namespace {

using test::TestBlock;

class Pallets : public testing::Test {
protected:
  Pallets() {
    links_.parameters = &parameters_;
    links_.channels = &channels_;
    parameter(3300, 3);
    parameter(3301, 5);
    parameter(3302, 4);
    pallets_.powerOn(nc::PowerOn::Cold);
  }
  void parameter(uint32_t number, double value) {
    EXPECT_EQ(parameters_.setQuantity("PARAM." + std::to_string(number), value), "");
  }
  int32_t ask(uint32_t function, TestBlock& request) {
    Block block = request.block();
    const std::optional<int32_t> code = pallets_.service(function, block);
    EXPECT_TRUE(code && nc::nct::findServiceFunction(function)->hasCode(static_cast<uint32_t>(*code)))
        << "function " << function << " has no code " << code.value_or(-1);
    return code.value_or(-1);
  }
  int32_t ask(uint32_t function, TestBlock&& request) { return ask(function, request); }
  static std::string name(uint32_t magazine, uint32_t place, const char* column) {
    return "PALLET." + std::to_string(magazine) + "." + std::to_string(place) + "." + column;
  }
  void set(uint32_t magazine, uint32_t place, const char* column, double value) {
    EXPECT_EQ(pallets_.setQuantity(name(magazine, place, column), value), "") << column;
  }
  double value(uint32_t magazine, uint32_t place, const char* column) {
    return pallets_.quantity(name(magazine, place, column)).value_or(-1);
  }
  void pallet(uint32_t magazine, uint32_t place, int32_t id, int32_t status = 4, int32_t priority = 1) {
    set(magazine, place, "ID", id);
    set(magazine, place, "STATUS", status);
    set(magazine, place, "PRIORITY", priority);
  }
  void program(int32_t number) {
    EXPECT_EQ(channels_.event("program",
                              {{.key = "number", .integer = number}, {.key = "blocks", .isText = true, .text = "M30"}}),
              "");
  }

  Links links_;
  Parameters parameters_{links_};
  Channels channels_{links_};
  PalletManagement pallets_{links_};
};

TEST_F(Pallets, MagazinesAndPlaces) {
  EXPECT_EQ(pallets_.plan().places(0), 121U); // 128 rows without 5 + 1 + 1
  EXPECT_EQ(ask(307, {4, 1, 5, 2}), 0);
  EXPECT_EQ(ask(307, {4, 1, 6, 2}), 301);
  EXPECT_EQ(ask(307, {4, 1, 0, 2}), 301);
  EXPECT_EQ(ask(307, {4, 10, 1, 2}), 0);
  EXPECT_EQ(ask(307, {4, 10, 2, 2}), 301);
  EXPECT_EQ(ask(307, {4, 11, 1, 2}), 0);
  EXPECT_EQ(ask(307, {4, 0, 121, 2}), 0);
  EXPECT_EQ(ask(307, {4, 0, 122, 2}), 301);
  EXPECT_EQ(ask(307, {4, 2, 1, 2}), 300);
  parameter(3300, 1); // without loading point
  EXPECT_EQ(ask(307, {4, 11, 1, 2}), 300);
  EXPECT_EQ(ask(307, {4, 0, 122, 2}), 0);
  parameter(3300, 5); // MNT as printed in l.5335
  EXPECT_EQ(ask(307, {4, 11, 1, 2}), 0);
  parameter(3300, 2);
  EXPECT_EQ(ask(307, {4, 10, 1, 2}), 300);
  EXPECT_EQ(ask(308, {6, 2, 4, 1, 0}), 301);
}

TEST_F(Pallets, Interchange) {
  pallet(1, 3, 12);
  set(1, 3, "CUSTOM4", 2.5);
  pallet(10, 1, 13, 6);
  EXPECT_EQ(ask(300, {3, 1, 3, 10}), 0);
  EXPECT_EQ(value(10, 1, "ID"), 12);
  EXPECT_EQ(value(10, 1, "CUSTOM4"), 2.5);
  EXPECT_EQ(value(1, 3, "ID"), 13);
  EXPECT_EQ(value(1, 3, "STATUS"), 6);
  EXPECT_EQ(ask(300, {3, 1, 3, 11}), 0);
  EXPECT_EQ(value(11, 1, "ID"), 13);
  EXPECT_EQ(value(1, 3, "ID"), 0);
  EXPECT_EQ(ask(300, {3, 11, 1, 0}), 0);
  EXPECT_EQ(value(11, 1, "ID"), 0);
  EXPECT_EQ(value(11, 1, "STATUS"), 1);
  EXPECT_EQ(value(0, 1, "ID"), 13);
  EXPECT_EQ(ask(300, {3, 10, 1, 0}), 0);
  EXPECT_EQ(value(0, 2, "ID"), 12);
  EXPECT_EQ(ask(300, {3, 10, 1, 0}), 0); // nothing there: nothing moves
  EXPECT_EQ(value(0, 3, "ID"), 0);

  EXPECT_EQ(ask(300, {2, 1, 3, 10}), 2);
  EXPECT_EQ(ask(300, {4, 1, 3, 10}), 2);
  EXPECT_EQ(ask(300, {3, 0, 1, 10}), 300);
  EXPECT_EQ(ask(300, {3, 2, 1, 10}), 300);
  EXPECT_EQ(ask(300, {3, 1, 6, 10}), 301);
  EXPECT_EQ(ask(300, {3, 11, 2, 0}), 301);
  EXPECT_EQ(ask(300, {3, 1, 3, 1}), 302);
  EXPECT_EQ(ask(300, {3, 10, 1, 10}), 302);
  EXPECT_EQ(ask(300, {3, 1, 3, 12}), 302);
  parameter(3300, 1);
  EXPECT_EQ(ask(300, {3, 1, 3, 11}), 302);
}

TEST_F(Pallets, RecordOfAPallet) {
  pallet(1, 2, 5);
  TestBlock write{14, 1, 2, 77, 3, 128, 2, 64, 0x1FF};
  write.real(10, 1.5).real(12, -2.5).real(14, 1e300);
  EXPECT_EQ(ask(303, write), 0);
  TestBlock read{14, 1, 2};
  EXPECT_EQ(ask(304, read), 0);
  for (uint32_t n = 2; n <= 15; ++n) EXPECT_EQ(read[n], n == 9 ? 0xFF : write[n]) << n;
  EXPECT_FALSE(read.answered(3));
  EXPECT_TRUE(read.answered(15));
  EXPECT_EQ(value(1, 2, "ASSIGNED"), 64);
  EXPECT_EQ(ask(303, {3, 1, 2, 78}), 0); // the rest stays
  EXPECT_EQ(value(1, 2, "CUSTOM3"), -2.5);
  for (uint32_t function : {303u, 304u}) {
    for (int32_t amount = -1; amount <= 16; ++amount) {
      TestBlock request{amount, 1, 2, 78, 3, 1, 2, 3};
      EXPECT_EQ(ask(function, request), nc::nct::findServiceFunction(function)->allowsAmount(amount) ? 0 : 2) << amount;
    }
    EXPECT_EQ(ask(function, {3, 3, 1, 1}), 300);
    EXPECT_EQ(ask(function, {3, 1, 6, 1}), 301);
    EXPECT_EQ(ask(function, {3, 1, 1, 1}), 339);
  }
  parameter(3302, 1);
  EXPECT_EQ(ask(304, {8, 1, 2}), 0);
  EXPECT_EQ(ask(304, {10, 1, 2}), 2);
  parameter(3302, 0);
  EXPECT_EQ(ask(304, {7, 1, 2}), 0);
  EXPECT_EQ(ask(304, {8, 1, 2}), 2);
}

// Limits as printed (l.5553-5557).
TEST_F(Pallets, RecordRefuses) {
  pallet(1, 2, 5);
  pallet(1, 3, 6);
  const auto code = [&](int32_t id, int32_t status, int32_t priority, int32_t executed, int32_t assigned) {
    return ask(303, {7, 1, 2, id, status, priority, executed, assigned});
  };
  EXPECT_EQ(code(0, 4, 1, 0, 0), 305);
  EXPECT_EQ(code(100'000'000, 4, 1, 0, 0), 305);
  EXPECT_EQ(code(99'999'999, 4, 1, 0, 0), 0);
  EXPECT_EQ(code(6, 4, 1, 0, 0), 305); // in another place
  EXPECT_EQ(code(5, 9, 1, 0, 0), 0);
  EXPECT_EQ(code(5, 10, 1, 0, 0), 306);
  EXPECT_EQ(code(5, -1, 1, 0, 0), 306);
  EXPECT_EQ(code(5, 4, 129, 0, 0), 307);
  EXPECT_EQ(code(5, 4, 1, 3, 2), 308);
  EXPECT_EQ(code(5, 4, 1, 2, 2), 0);
  EXPECT_EQ(code(5, 4, 1, 2, 65), 309);
  EXPECT_EQ(code(5, 4, 1, 2, 64), 0);
  EXPECT_EQ(ask(303, {6, 1, 2, 5, 4, 1, 65}), 308); // against those assigned before
}

TEST_F(Pallets, VirtualMagazineKnowsAPallet) {
  pallet(11, 1, 50);
  set(11, 1, "CUSTOM2", 7.5);
  set(11, 1, "PRIORITY", 9);
  EXPECT_EQ(ask(300, {3, 11, 1, 0}), 0);
  EXPECT_EQ(value(0, 1, "CUSTOM2"), 7.5);
  // It comes back: its identifier is read at the loading point.
  EXPECT_EQ(ask(306, {4, 11, 1, 1, 50}), 0);
  EXPECT_EQ(value(11, 1, "CUSTOM2"), 7.5);
  EXPECT_EQ(value(11, 1, "PRIORITY"), 9);
  EXPECT_EQ(value(0, 1, "ID"), 0);
  EXPECT_EQ(ask(300, {3, 11, 1, 0}), 0);
  // The record of a place with another pallet: the data of the two change places, then come the columns of the block.
  pallet(1, 4, 51, 6, 3);
  EXPECT_EQ(ask(303, {4, 1, 4, 50, 3}), 0);
  EXPECT_EQ(value(1, 4, "ID"), 50);
  EXPECT_EQ(value(1, 4, "STATUS"), 3);
  EXPECT_EQ(value(1, 4, "CUSTOM2"), 7.5);
  EXPECT_EQ(value(0, 1, "ID"), 51);
  EXPECT_EQ(value(0, 1, "PRIORITY"), 3);
  // An identifier that nobody knows: a new name.
  EXPECT_EQ(ask(306, {4, 1, 4, 1, 52}), 0);
  EXPECT_EQ(value(1, 4, "CUSTOM2"), 7.5);
}

TEST_F(Pallets, OneDatum) {
  EXPECT_EQ(ask(306, {4, 10, 1, 2, 3}), 0); // status of a place without a pallet
  TestBlock status{4, 10, 1, 2};
  EXPECT_EQ(ask(307, status), 0);
  EXPECT_EQ(status[5], 3);
  for (int32_t number : {3, 4, 5, 6, 7}) {
    EXPECT_EQ(ask(306, {4, 10, 1, number, 0}), 339) << number;
    EXPECT_EQ(ask(307, {4, 10, 1, number}), 339) << number;
  }
  EXPECT_EQ(ask(307, {4, 10, 1, 1}), 339);
  EXPECT_EQ(ask(306, {4, 10, 1, 1, 8}), 0);
  const struct {
    int32_t number, value;
  } kWords[] = {{3, 128}, {5, 64}, {4, 64}, {7, 200}, {2, 10}};
  for (const auto& c : kWords) {
    EXPECT_EQ(ask(306, {4, 10, 1, c.number, c.value}), 0) << c.number;
    TestBlock read{4, 10, 1, c.number};
    EXPECT_EQ(ask(307, read), 0);
    EXPECT_EQ(read[5], c.value);
    EXPECT_FALSE(read.answered(6));
    EXPECT_EQ(ask(306, {5, 10, 1, c.number, c.value}), 2);
    EXPECT_EQ(ask(307, {5, 10, 1, c.number}), 2);
  }
  for (int32_t number = 8; number <= 10; ++number) {
    TestBlock write{5, 10, 1, number};
    EXPECT_EQ(ask(306, write.real(5, number * 0.5)), 0);
    TestBlock read{5, 10, 1, number};
    EXPECT_EQ(ask(307, read), 0);
    EXPECT_EQ(read.block().real(5), number * 0.5);
    EXPECT_EQ(ask(307, {4, 10, 1, number}), 2);
  }
  for (uint32_t function : {306u, 307u}) {
    EXPECT_EQ(ask(function, {3, 10, 1, 1, 1}), 2);
    EXPECT_EQ(ask(function, {4, 10, 1, 11, 1}), 2);
    EXPECT_EQ(ask(function, {4, 10, 1, 0, 1}), 2);
    EXPECT_EQ(ask(function, {4, 9, 1, 1, 1}), 300);
    EXPECT_EQ(ask(function, {4, 10, 2, 1, 1}), 301);
  }
  parameter(3302, 1);
  EXPECT_EQ(ask(307, {4, 10, 1, 7}), 0);
  EXPECT_EQ(ask(307, {5, 10, 1, 8}), 2);
}

TEST_F(Pallets, OneDatumRefuses) {
  pallet(10, 1, 8);
  pallet(1, 1, 9);
  const auto code = [&](int32_t number, int32_t to) { return ask(306, {4, 10, 1, number, to}); };
  EXPECT_EQ(code(1, 0), 305);
  EXPECT_EQ(code(1, 100'000'000), 305);
  EXPECT_EQ(code(1, 9), 305);
  EXPECT_EQ(code(2, 11), 306);
  EXPECT_EQ(code(3, 129), 307);
  EXPECT_EQ(code(4, 1), 308);
  EXPECT_EQ(code(5, 65), 309);
  EXPECT_EQ(code(5, 2), 0);
  EXPECT_EQ(code(4, 2), 0);
  EXPECT_EQ(code(5, 1), 308);
}

TEST_F(Pallets, ProgramsOfAPallet) {
  pallet(1, 1, 9);
  EXPECT_EQ(ask(306, {4, 1, 1, 6, 1234}), 0); // one program needs no number of programs
  EXPECT_EQ(value(1, 1, "ASSIGNED"), 1);
  EXPECT_EQ(ask(306, {4, 1, 1, 5, 3}), 0);
  EXPECT_EQ(ask(306, {4, 1, 1, 6, 1, 2, 3}), 2);
  EXPECT_EQ(ask(306, {6, 1, 1, 6, 100, 200, 300}), 0);
  EXPECT_EQ(value(1, 1, "PROGRAM3"), 300);
  TestBlock read{6, 1, 1, 6};
  EXPECT_EQ(ask(307, read), 0);
  EXPECT_EQ(read[5], 100);
  EXPECT_EQ(read[7], 300);
  EXPECT_EQ(ask(307, {5, 1, 1, 6}), 2);
  EXPECT_EQ(ask(306, {4, 1, 1, 5, 64}), 0);
  TestBlock most{67, 1, 1, 6};
  for (uint32_t i = 0; i < 64; ++i) most.word(5 + i, static_cast<int32_t>(1000 + i));
  EXPECT_EQ(ask(306, most), 0);
  EXPECT_EQ(value(1, 1, "PROGRAM64"), 1063);
  EXPECT_EQ(ask(306, {68, 1, 1, 6}), 2);
  parameter(3300, 11); // PRI: by file name
  EXPECT_EQ(ask(306, most), 3);
  EXPECT_EQ(ask(307, {67, 1, 1, 6}), 3);
  EXPECT_EQ(ask(308, {6, 6, 1000, 1, 0}), 12);
  EXPECT_EQ(ask(309, {4, 6, 1, 1}), 12);
}

TEST_F(Pallets, SearchForExchange) {
  pallet(1, 1, 11, 4, 5);
  pallet(1, 2, 12, 4, 2);
  pallet(1, 4, 14, 4, 2);
  pallet(1, 5, 15, 3, 1);
  const auto found = [&](int32_t start, int32_t direction) {
    TestBlock request{6, 2, 4, start, direction};
    EXPECT_EQ(ask(308, request), 0);
    return std::pair{request[6], request[7]};
  };
  EXPECT_EQ(found(3, 0), (std::pair{4, 1})); // same priority, same distance: forwards
  EXPECT_EQ(found(3, 2), (std::pair{2, 2}));
  EXPECT_EQ(found(1, 0), (std::pair{2, 1}));
  EXPECT_EQ(found(5, 0), (std::pair{4, 2}));
  EXPECT_EQ(found(5, 1), (std::pair{2, 1})); // round the end
  set(1, 1, "PRIORITY", 1);
  EXPECT_EQ(found(3, 0), (std::pair{1, 2}));
}

TEST_F(Pallets, SearchOfOtherData) {
  EXPECT_EQ(ask(308, {6, 1, 12, 1, 0}), 339); // no pallet at all
  EXPECT_EQ(ask(308, {6, 2, 4, 1, 0}), 341);  // but places with a status
  TestBlock empty{6, 2, 1, 3, 0};
  EXPECT_EQ(ask(308, empty), 0);
  EXPECT_EQ(empty[6], 3);
  pallet(1, 2, 12, 4, 2);
  pallet(1, 4, 14, 4, 7);
  set(1, 4, "CUSTOM1", 9);
  set(1, 4, "ASSIGNED", 2);
  set(1, 4, "PROGRAM2", 300);
  const auto found = [&](int32_t number, int32_t value) {
    TestBlock request{6, number, value, 1, 0};
    return ask(308, request) == 0 ? request[6] : -1;
  };
  EXPECT_EQ(found(1, 14), 4);
  EXPECT_EQ(found(3, 2), 2);
  EXPECT_EQ(found(5, 2), 4);
  EXPECT_EQ(found(6, 300), 4);
  EXPECT_EQ(found(7, 9), 4);
  TestBlock none{6, 1, 99, 1, 0};
  none.word(6, 77);
  EXPECT_EQ(ask(308, none), 341);
  EXPECT_EQ(none[6], 0);
  for (const int32_t number : {0, 8, 11, -1}) EXPECT_EQ(ask(308, {6, number, 1, 1, 0}), 12);
  EXPECT_EQ(ask(308, {6, 1, 12, 6, 0}), 301);
  EXPECT_EQ(ask(308, {6, 1, 12, 0, 0}), 301);
  EXPECT_EQ(ask(308, {5, 1, 12, 1, 0}), 2);
}

// l.5852-5866
TEST_F(Pallets, ColumnOfAMagazine) {
  const int32_t kIds[] = {123, 456, 789, 12'345'679, 98'764};
  for (uint32_t i = 0; i < 5; ++i) pallet(1, i + 1, kIds[i]);
  TestBlock request{10, 1, 1, 4};
  EXPECT_EQ(ask(309, request), 0);
  const int32_t kExpected[] = {12'345'679, 98'764, 123, 456, 789, 12'345'679, 98'764};
  for (uint32_t i = 0; i < 7; ++i) EXPECT_EQ(request[5 + i], kExpected[i]);
  EXPECT_FALSE(request.answered(12));
  set(10, 1, "CUSTOM2", 2.5);
  TestBlock real{7, 8, 10, 1};
  EXPECT_EQ(ask(309, real), 0);
  EXPECT_EQ(real.block().real(5), 2.5);
  EXPECT_EQ(real.block().real(7), 2.5);
  EXPECT_EQ(ask(309, {6, 8, 10, 1}), 2); // half a double
  EXPECT_EQ(ask(309, {3, 1, 1, 1}), 2);
  EXPECT_EQ(ask(309, {4, 11, 1, 1}), 12);
  EXPECT_EQ(ask(309, {4, 1, 3, 1}), 300);
  EXPECT_EQ(ask(309, {4, 1, 1, 6}), 301);
}

TEST_F(Pallets, SelectsTheNextProgram) {
  EXPECT_EQ(ask(41, {2, 8, 1}), 342);
  pallet(10, 1, 8);
  EXPECT_EQ(ask(41, {2, 8, 1}), 47);
  EXPECT_EQ(ask(306, {4, 10, 1, 5, 2}), 0);
  EXPECT_EQ(ask(306, {5, 10, 1, 6, 100, 200}), 0);
  EXPECT_EQ(ask(41, {2, 8, 1}), 45);
  program(100);
  EXPECT_EQ(ask(41, {2, 8, 1}), 0);
  EXPECT_EQ(channels_.quantity("PROGRAM.1"), 100);
  EXPECT_EQ(ask(306, {4, 10, 1, 4, 1}), 0);
  EXPECT_EQ(ask(41, {2, 8, 3}), 45);
  program(200);
  EXPECT_EQ(ask(41, {2, 8, 3}), 0);
  EXPECT_EQ(channels_.quantity("PROGRAM.3"), 200);
  EXPECT_EQ(ask(306, {4, 10, 1, 4, 2}), 0);
  EXPECT_EQ(ask(41, {2, 8, 3}), 47);
  EXPECT_EQ(ask(41, {2, 9, 3}), 342); // another pallet
  EXPECT_EQ(ask(41, {1, 8, 1}), 2);
  EXPECT_EQ(ask(41, {2, 8, 0}), 41);
  EXPECT_EQ(ask(41, {2, 8, 9}), 41);
}

TEST_F(Pallets, WaitsWhileTheOperatorEdits) {
  EXPECT_EQ(pallets_.event("pallet", {{.key = "edit", .integer = 1}}), "");
  TestBlock request{4, 1, 1, 2};
  Block block = request.block();
  EXPECT_EQ(pallets_.service(307, block), std::nullopt);
  EXPECT_EQ(pallets_.event("pallet", {{.key = "edit", .integer = 0}}), "");
  EXPECT_EQ(pallets_.service(307, block), 0);
}

TEST_F(Pallets, AFullVirtualMagazineTakesNoMore) {
  parameter(3301, 126);
  EXPECT_EQ(pallets_.plan().places(0), 0U);
  pallet(1, 126, 5);
  EXPECT_EQ(ask(300, {3, 1, 126, 0}), 302); // there is none
  parameter(3301, 125);
  pallet(1, 1, 1);
  pallet(1, 2, 2);
  EXPECT_EQ(ask(300, {3, 1, 1, 0}), 0);
  EXPECT_EQ(ask(300, {3, 1, 2, 0}), 3);
  EXPECT_EQ(value(1, 2, "ID"), 2);
}

// Any sequence of services: no pallet is lost or doubled but by a change of its identifier, failed requests change
// nothing, limits hold.
class RandomPallets : public Pallets, public testing::WithParamInterface<uint32_t> {
protected:
  int32_t number(int32_t low, int32_t high) { return std::uniform_int_distribution<int32_t>(low, high)(random_); }
  int32_t magazine() {
    constexpr int32_t kMagazines[] = {1, 1, 1, 10, 11, 0, 2};
    return kMagazines[static_cast<size_t>(number(0, 6))];
  }
  TestBlock request(uint32_t function) {
    const int32_t m = magazine(), p = m >= 10 ? number(1, 10) / 10 + 1 : number(0, 6);
    switch (function) {
    case 300: return {3, m, p, magazine()};
    case 303:
      return {number(2, 10), m, p, number(0, 9), number(0, 10), number(0, 130), number(0, 3), number(0, 66),
              number(0, 300)};
    case 304: return {number(2, 15), m, p};
    case 306: return {number(4, 6), m, p, number(0, 8), number(0, 12), number(0, 12), number(0, 12)};
    case 307: return {number(4, 6), m, p, number(0, 11)};
    case 308: return {6, number(0, 8), number(0, 10), number(0, 6), number(0, 2)};
    default: return {number(3, 12), number(0, 11), m, p};
    }
  }
  using Ids = std::map<int32_t, int>;
  std::vector<PalletPlace> places() const {
    std::vector<PalletPlace> all;
    for (const uint32_t m : {0u, 1u, 10u, 11u})
      for (uint32_t p = 1; p <= pallets_.plan().places(m); ++p) all.push_back({m, p});
    return all;
  }
  std::vector<int32_t> contents() const {
    std::vector<int32_t> all;
    for (const PalletPlace& place : places())
      for (const int32_t word : pallets_.table().row(place).words) all.push_back(word);
    return all;
  }
  Ids ids() const {
    Ids all;
    for (const PalletPlace& place : places())
      if (const int32_t id = pallets_.table().row(place).word(kPalletId); id != 0) ++all[id];
    return all;
  }

  std::mt19937 random_{GetParam()};
};

TEST_P(RandomPallets, TablesStayConsistent) {
  size_t done = 0;
  for (int step = 0; step < 4000 && !HasFailure(); ++step) {
    constexpr uint32_t kFunctions[] = {300, 303, 304, 306, 307, 308, 309, 300, 306};
    const uint32_t function = kFunctions[static_cast<size_t>(number(0, 8))];
    TestBlock block = request(function);
    const std::vector<int32_t> before = contents();
    const Ids idsBefore = ids();
    const int32_t code = ask(function, block);
    const Ids now = ids();
    for (const auto& [id, count] : now) EXPECT_EQ(count, 1) << "pallet " << id << " after " << function;
    if (code != 0 || nc::nct::findServiceFunction(function)->access == nc::nct::FunctionAccess::Read) {
      EXPECT_EQ(contents(), before);
    }
    if (function == 300) {
      EXPECT_EQ(now, idsBefore);
    }
    const bool named = function == 303 || (function == 306 && block[4] == 1);
    if (!named) {
      EXPECT_EQ(now, idsBefore) << function;
    }
    if (named && code == 0) {
      EXPECT_EQ(now.contains(function == 303 ? block[4] : block[5]), true);
      EXPECT_GE(now.size(), idsBefore.size());
    }
    for (const PalletPlace& place : places()) {
      const PalletRow& row = pallets_.table().row(place);
      EXPECT_LE(row.word(kPalletExecuted), row.word(kPalletAssigned));
      EXPECT_LE(row.word(kPalletAssigned), 64);
      EXPECT_LE(row.word(kPalletPriority), 128);
      EXPECT_LE(row.word(kPalletStatus), 10);
    }
    done += code == 0 ? 1 : 0;
  }
  EXPECT_GT(done, 400U);
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomPallets, testing::Range(1U, 7U));

} // namespace
} // namespace rung::sim::nct
