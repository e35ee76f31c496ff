// Every kind of difference between two instances is found and named.
#include "rtlib/change/shadow.h"

#include <gtest/gtest.h>

#include "tests/unit/rtlib/test_program.h"

namespace {

using namespace rung::runtime;
using namespace rung::core;
using rung::test::TestProgram;

std::string shown(const rung_program& program, const Ref& place) {
  const std::string byte = program.spaces[place.space].name + std::to_string(place.byte);
  return place.kind == RefKind::Bit ? byte + "." + std::to_string(place.bit) : byte;
}

class CompareTest : public testing::Test {
protected:
  struct Made : TestProgram {
    Made() { make(*this); }
  };
  static void make(TestProgram& program) {
    program.addSpace("R", 1, {{0, 8, 0, RUNG_REPR_PACKED}, {8, 4, 64, RUNG_REPR_BYTE_PER_BIT}});
    program.addChunk([](uint8_t*, rung_ctx*, uint32_t) { return RUNG_PC_FAULT; });
    program.addTask("MAIN", 0);
    program.link();
  }
  std::string difference() { return firstDifference(a, b, shown).value_or("none"); }
  Made test;
  Instance a{test.program};
  Instance b{test.program};
};

TEST_F(CompareTest, EqualInstances) { EXPECT_EQ(difference(), "none"); }

TEST_F(CompareTest, PackedByte) {
  EXPECT_EQ(a.write(intRef(0, 4, 8), 3), std::nullopt);
  EXPECT_EQ(b.write(intRef(0, 4, 8), 4), std::nullopt);
  EXPECT_EQ(difference(), "R4: 3 here, 4 there");
}

TEST_F(CompareTest, PackedBit) {
  EXPECT_EQ(b.write(bitRef(0, 5, 7), 1), std::nullopt);
  EXPECT_EQ(difference(), "R5.7: 0 here, 1 there");
}

TEST_F(CompareTest, ExpandedBit) {
  EXPECT_EQ(a.write(bitRef(0, 9, 2), 1), std::nullopt);
  EXPECT_EQ(difference(), "R9.2: 1 here, 0 there");
}

TEST_F(CompareTest, SlotsOfTheCompiler) {
  b.block()[200] = 5;
  EXPECT_EQ(difference(), "memory at offset 200: 0 here, 5 there");
}

TEST_F(CompareTest, ExpandedBitThatIsNoBit) {
  a.block()[66] = 1;
  b.block()[66] = 3;
  EXPECT_EQ(difference(), "memory at offset 66: 1 here, 3 there");
}

TEST_F(CompareTest, LayoutsThatDiffer) {
  TestProgram other;
  other.addPacked("R", 1, 12, 32);
  other.link();
  other.program.layout_hash = 1;
  Instance c(other.program);
  EXPECT_EQ(a.write(bitRef(0, 9, 2), 1), std::nullopt);
  EXPECT_EQ(firstDifference(a, c, shown).value_or("none"), "R9.2: 1 here, 0 there");
  EXPECT_EQ(c.write(bitRef(0, 9, 2), 1), std::nullopt);
  EXPECT_EQ(firstDifference(a, c, shown).value_or("none"), "none");
}

TEST_F(CompareTest, Clock) {
  b.advanceClock(7);
  EXPECT_EQ(difference(), "clock: 0 us here, 7 us there");
}

TEST_F(CompareTest, Faults) {
  b.runTask("MAIN");
  EXPECT_EQ(difference(), "fault: no fault here, undescribed fault (unknown rung) there");
}

TEST_F(CompareTest, Messages) {
  rung_message message{};
  message.number = 5;
  a.messages().push(message);
  EXPECT_EQ(difference(), "waiting messages: 1 here, 0 there");
  message.index = 2;
  b.messages().push(message);
  EXPECT_EQ(difference(), "message 5: contents differ");
  rung_message out;
  a.messages().pop(out);
  message.number = 6;
  a.messages().push(message);
  EXPECT_EQ(difference(), "number of message 0: 6 here, 5 there");
}

TEST_F(CompareTest, LostMessages) {
  for (uint32_t i = 0; i < kMessageCapacity; ++i) {
    a.messages().push({});
    b.messages().push({});
  }
  a.messages().push({});
  EXPECT_EQ(difference(), "lost messages: 1 here, 0 there");
}

TEST_F(CompareTest, Services) {
  int64_t arg = 1;
  a.services().request(0, &arg, 1);
  EXPECT_EQ(difference(), "waiting service requests: 1 here, 0 there");
  arg = 2;
  b.services().request(0, &arg, 1);
  EXPECT_EQ(difference(), "service request 0 (WINDR): contents differ");
  ServiceRequest request;
  a.services().take(request);
  b.services().take(request);
  EXPECT_EQ(difference(), "none");
  ServiceReply reply;
  reply.ticket = request.ticket;
  b.services().complete(reply);
  b.services().deliver();
  EXPECT_EQ(difference(), "service ticket 1: state or results differ");
}

TEST_F(CompareTest, ProfileDoesNotCount) {
  test.program.instrumented = 1;
  Instance c(test.program);
  Instance d(test.program);
  c.context().prof[0].count = 1;
  EXPECT_FALSE(firstDifference(c, d, shown));
}

} // namespace
