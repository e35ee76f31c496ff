// Images by address: they survive another layout, and do not survive another set of kept addresses.
#include "rtlib/retain/retained_cells.h"

#include <gtest/gtest.h>

#include "rtlib/run/instance.h"
#include "tests/unit/rtlib/test_program.h"

namespace {

using namespace rung::runtime;
using rung::test::TestProgram;
using Bytes = std::vector<uint8_t>;

// Space K with 4 bytes, all kept; byte 1 is a byte a bit in the second layout, and lies elsewhere.
void onePiece(TestProgram& test) {
  test.addPacked("K", 1, 4, 8);
  test.retains = {{8, 4}};
  test.link();
}

void threePieces(TestProgram& test) {
  test.addSpace("K", 1,
                {{0, 1, 64, RUNG_REPR_PACKED}, {1, 1, 96, RUNG_REPR_BYTE_PER_BIT}, {2, 2, 70, RUNG_REPR_PACKED}});
  test.retains = {{64, 1}, {96, 8}, {70, 2}};
  test.link();
}

Bytes imageOf(const RetainMap& map, const Instance& instance) {
  Bytes raw(map.rawSize());
  Bytes image(map.size());
  instance.copyRetained(raw);
  map.pack(raw, image);
  return image;
}

TEST(RetainMap, AnImageFitsEveryLayoutOfTheSameAddresses) {
  TestProgram packed;
  onePiece(packed);
  TestProgram mixed;
  threePieces(mixed);
  mixed.program.layout_hash = packed.program.layout_hash + 1;
  const RetainMap from(packed.program);
  const RetainMap to(mixed.program);
  EXPECT_EQ(from.layout().hash, to.layout().hash);
  EXPECT_EQ(from.size(), 4u);
  EXPECT_EQ(to.size(), 4u);
  EXPECT_EQ(to.rawSize(), 11u);

  Instance first(packed.program);
  first.memory().write(0, 0, 4, 0x80FFA501);
  const Bytes image = imageOf(from, first);
  EXPECT_EQ(image, (Bytes{0x01, 0xA5, 0xFF, 0x80}));
  Instance second(mixed.program);
  Bytes raw(to.rawSize());
  to.unpack(image, raw);
  ASSERT_TRUE(second.restoreRetained(raw));
  EXPECT_EQ(second.memory().read(0, 0, 4), 0x80FFA501u);
  EXPECT_EQ(imageOf(to, second), image);
}

TEST(RetainMap, OtherAddressesDialectsAndNamesDiffer) {
  TestProgram test;
  onePiece(test);
  const uint64_t hash = RetainMap(test.program).layout().hash;
  const auto other = [](auto change) {
    TestProgram changed;
    changed.addPacked("K", 1, 4, 8);
    changed.retains = {{8, 4}};
    change(changed);
    changed.link();
    return RetainMap(changed.program).layout().hash;
  };
  EXPECT_EQ(other([](TestProgram&) {}), hash);
  EXPECT_EQ(other([](TestProgram& t) { t.retains = {{8, 2}, {10, 2}}; }), hash); // in two pieces
  EXPECT_NE(other([](TestProgram& t) { t.retains = {{8, 3}}; }), hash);
  EXPECT_NE(other([](TestProgram& t) { t.retains = {{9, 3}}; }), hash);
  EXPECT_NE(other([](TestProgram& t) { t.dialect = "else"; }), hash);
  EXPECT_NE(other([](TestProgram& t) { t.spaces[0].name = "D"; }), hash);
}

// Whatever an image holds, the byte of a bit becomes 0 or 1.
TEST(RetainMap, ExpandedBitsAreZeroOrOne) {
  TestProgram mixed;
  threePieces(mixed);
  const RetainMap map(mixed.program);
  Bytes raw(map.rawSize(), 0xEE);
  map.unpack(Bytes(map.size(), 0xFF), raw);
  for (uint32_t i = 1; i < 9; ++i) EXPECT_EQ(raw[i], 1) << i;
}

} // namespace
