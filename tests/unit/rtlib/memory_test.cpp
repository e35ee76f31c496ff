// Logical access over both representations, and typed access through a Ref.
#include "rtlib/core/memory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "rtlib/load/ref.h"
#include "tests/unit/rtlib/test_program.h"

namespace {

using namespace rung::runtime;
using namespace rung::core;
using rung::test::TestProgram;

// Space 0: bytes 0..3 packed at 0, 4..5 expanded at 64, 6..9 packed at 4. Space 1: 16 packed bytes at 128.
class MemoryTest : public testing::Test {
protected:
  MemoryTest() {
    test.addSpace("R", 1,
                  {{0, 4, 0, RUNG_REPR_PACKED}, {4, 2, 64, RUNG_REPR_BYTE_PER_BIT}, {6, 4, 4, RUNG_REPR_PACKED}});
    test.addPacked("D", 1, 16, 128);
    test.link();
  }
  TestProgram test;
  std::vector<uint8_t> block = std::vector<uint8_t>(256, 0);
  Memory memory{test.program, block.data()};
};

TEST_F(MemoryTest, PackedBytesLieWhereTheRangeSays) {
  memory.writeByte(0, 3, 0xAB);
  memory.writeByte(0, 6, 0xCD);
  EXPECT_EQ(block[3], 0xAB);
  EXPECT_EQ(block[4], 0xCD);
  EXPECT_EQ(memory.readByte(0, 3), 0xAB);
  EXPECT_EQ(memory.readByte(0, 6), 0xCD);
}

TEST_F(MemoryTest, ExpandedBytesScatterAndGather) {
  memory.writeByte(0, 5, 0b10010110);
  const std::vector<uint8_t> bits(block.begin() + 72, block.begin() + 80);
  EXPECT_EQ(bits, (std::vector<uint8_t>{0, 1, 1, 0, 1, 0, 0, 1}));
  EXPECT_EQ(memory.readByte(0, 5), 0b10010110);
  EXPECT_EQ(memory.readByte(0, 4), 0);
}

TEST_F(MemoryTest, BitsInBothRepresentations) {
  memory.writeBit(0, 2, 7, true);
  EXPECT_EQ(block[2], 0x80);
  memory.writeBit(0, 4, 3, true);
  EXPECT_EQ(block[67], 1);
  EXPECT_TRUE(memory.readBit(0, 4, 3));
  EXPECT_FALSE(memory.readBit(0, 4, 2));
  memory.writeBit(0, 2, 7, false);
  EXPECT_EQ(block[2], 0);
}

TEST_F(MemoryTest, PlacesOfBits) {
  const Place packed = memory.locateBit(0, 1, 6);
  const Place expanded = memory.locateBit(0, 5, 6);
  EXPECT_EQ(packed.offset(), 1u);
  EXPECT_EQ(packed.bit(), 6u);
  EXPECT_EQ(expanded.offset(), 78u);
  EXPECT_EQ(expanded.bit(), 0u);
  for (const Place& place : {packed, expanded, memory.locateBit(1, 15, 7)}) {
    EXPECT_EQ(place.width(), 1u);
    memory.write(place, 1);
    EXPECT_EQ(memory.read(place), 1u);
    EXPECT_EQ(block[place.offset()], 1u << place.bit());
    memory.write(place, 0xFE);
    EXPECT_EQ(memory.read(place), 0u);
  }
  EXPECT_EQ(block, std::vector<uint8_t>(256, 0));
  EXPECT_TRUE(memory.locateBit(0, 10, 0).outside());
  EXPECT_TRUE(memory.locateBit(0, 0, 8).outside());
}

// At every alignment, expanded, over borders of ranges and at the end of the block, of every size: the same bytes as by
// single bytes, and no other is written.
TEST_F(MemoryTest, PlacesOfIntegers) {
  test.addSpace("END", 1, {{0, 3, 160, RUNG_REPR_BYTE_PER_BIT}, {3, 12, 244, RUNG_REPR_PACKED}});
  test.link();
  constexpr uint64_t kValue = 0xF1E2D3C4B5A69788;
  for (const uint32_t space : {0u, 1u, 2u})
    for (uint32_t byte = 0; byte < test.spaces[space].byte_count; ++byte)
      for (const uint32_t size : {1u, 2u, 4u, 8u}) {
        SCOPED_TRACE(std::to_string(space) + " " + std::to_string(byte) + " " + std::to_string(size));
        const Place place = memory.locate(space, byte, size);
        ASSERT_EQ(place.outside(), !memory.contains(space, byte, size));
        memory.write(place, kValue);
        for (uint32_t i = 0; i < test.spaces[space].byte_count; ++i)
          ASSERT_EQ(memory.readByte(space, i), !place.outside() && i >= byte && i - byte < size
                                                   ? static_cast<uint8_t>(kValue >> 8 * (i - byte))
                                                   : 0);
        if (place.outside()) continue;
        ASSERT_EQ(place.width(), 8 * size);
        ASSERT_EQ(memory.read(place), kValue & (~uint64_t{0} >> (64 - 8 * size)));
        memory.write(place, static_cast<uint64_t>(-2));
        ASSERT_EQ(memory.readSigned(place), -2);
        memory.write(place, 0);
        ASSERT_EQ(block, std::vector<uint8_t>(256, 0));
      }
  EXPECT_TRUE(memory.locate(1, 0, 0).outside());
  EXPECT_TRUE(memory.locate(1, 0, 9).outside());
}

TEST_F(MemoryTest, APlaceOutsideReadsZeroAndTakesNothing) {
  std::ranges::fill(block, 0xFF);
  const Place outside;
  memory.write(outside, 0x55);
  memory.writeReal(outside, 1.5);
  EXPECT_EQ(memory.read(outside), 0u);
  EXPECT_EQ(memory.readSigned(outside), 0);
  EXPECT_EQ(memory.readReal(outside), 0);
  EXPECT_EQ(block, std::vector<uint8_t>(256, 0xFF));
}

// The block of a program that needs less has eight bytes.
TEST(SmallMemory, HasPlacesToo) {
  TestProgram test;
  test.memorySize = 3;
  test.addPacked("D", 1, 3, 0);
  test.link();
  std::vector<uint8_t> block(Memory::kLeastBlock, 0);
  const Memory memory(test.program, block.data());
  memory.write(memory.locate(0, 1, 2), 0xABCD);
  EXPECT_EQ(memory.read(memory.locateBit(0, 2, 7)), 1u);
  std::vector<uint8_t> expected(block.size(), 0);
  expected[1] = 0xCD, expected[2] = 0xAB;
  EXPECT_EQ(block, expected);
}

TEST_F(MemoryTest, OneCallForAListOfPlaces) {
  const std::vector<ListedPlace> places = {{memory.locateBit(0, 5, 1), ValueForm::Raw},
                                           {memory.locate(1, 1, 2), ValueForm::Signed},
                                           {memory.locate(1, 3, 4), ValueForm::Raw},
                                           {locate(memory, realRef(1, 8)), ValueForm::Real, 0.5},
                                           {memory.locate(0, 3, 2), ValueForm::Real, 1000}};
  const std::vector<uint64_t> values = {1, static_cast<uint64_t>(-3), 0xFFFFFFFE, std::bit_cast<uint64_t>(2.5),
                                        std::bit_cast<uint64_t>(-0.25)};
  writePlaces(memory, places, values);
  EXPECT_EQ(readSigned(memory, intRef(1, 1, 16)), -3);
  EXPECT_EQ(readReal(memory, realRef(1, 8)), 1.25);
  EXPECT_EQ(readSigned(memory, intRef(0, 3, 16)), -250);
  std::vector<uint64_t> read(values.size());
  readPlaces(memory, places, read);
  EXPECT_EQ(read, values);
}

TEST_F(MemoryTest, WordsOverARangeBorder) {
  memory.write(0, 2, 8, 0x8877665544332211);
  EXPECT_EQ(block[2], 0x11);
  EXPECT_EQ(block[4], 0x55);
  EXPECT_EQ(memory.readByte(0, 4), 0x33);
  EXPECT_EQ(memory.read(0, 2, 8), 0x8877665544332211u);
  EXPECT_EQ(memory.read(0, 4, 2), 0x4433u);
}

TEST_F(MemoryTest, OutsideReadsZeroAndWritesNothing) {
  EXPECT_TRUE(memory.contains(0, 9, 1));
  EXPECT_FALSE(memory.contains(0, 9, 2));
  EXPECT_FALSE(memory.contains(0, 0xFFFFFFFF, 2));
  EXPECT_FALSE(memory.contains(2, 0, 1));
  memory.writeByte(0, 10, 1);
  memory.write(0, 8, 4, 0xFFFFFFFF);
  memory.writeBit(7, 0, 0, true);
  EXPECT_EQ(memory.read(0, 8, 4), 0u);
  EXPECT_EQ(block, std::vector<uint8_t>(256, 0));
}

TEST_F(MemoryTest, IntegersOfEachWidth) {
  for (const uint32_t width : {8u, 16u, 32u, 64u}) {
    const Ref ref = intRef(1, 4, width);
    writeRaw(memory, ref, 0xF123456789ABCDEF);
    EXPECT_EQ(readRaw(memory, ref), 0xF123456789ABCDEF & (~uint64_t{0} >> (64 - width)));
    EXPECT_EQ(memory.readByte(1, 4 + width / 8), 0);
    writeRaw(memory, ref, static_cast<uint64_t>(-2));
    EXPECT_EQ(readSigned(memory, ref), -2);
    writeRaw(memory, ref, 0);
  }
}

TEST_F(MemoryTest, RealsAndConversions) {
  const Ref real = realRef(1, 0);
  writeReal(memory, real, -2.5);
  EXPECT_EQ(readReal(memory, real), -2.5);
  const Ref word = intRef(1, 8, 16);
  writeReal(memory, word, -3.6);
  EXPECT_EQ(readSigned(memory, word), -4);
  EXPECT_EQ(readReal(memory, word), -4.0);
  writeReal(memory, word, 1e9);
  EXPECT_EQ(readSigned(memory, word), 32767);
  writeReal(memory, word, -1e9);
  EXPECT_EQ(readSigned(memory, word), -32768);
  writeReal(memory, word, std::nan(""));
  EXPECT_EQ(readSigned(memory, word), 0);
  const Ref wide = intRef(1, 8, 64);
  writeReal(memory, wide, 1e300);
  EXPECT_EQ(readSigned(memory, wide), std::numeric_limits<int64_t>::max());
  writeReal(memory, wide, -9223372036854775808.0);
  EXPECT_EQ(readSigned(memory, wide), std::numeric_limits<int64_t>::min());
}

TEST_F(MemoryTest, ARealHasTheWidthThatItsCellDeclares) {
  EXPECT_EQ(asReal(memory, intRef(1, 8, 64)), realRef(1, 8));
  EXPECT_FALSE(asReal(memory, intRef(1, 0, 32))) << "its neighbour is another cell";
  EXPECT_FALSE(asReal(memory, intRef(1, 0, 8)));
  EXPECT_FALSE(asReal(memory, bitRef(1, 0, 0)));
}

TEST_F(MemoryTest, TwoWordsAreARealWhereAddressesCountWords) {
  const uint32_t words = test.addPacked("M", 4, 16, 160);
  test.link();
  EXPECT_EQ(asReal(memory, intRef(words, 8, 32)), realRef(words, 8));
  EXPECT_FALSE(asReal(memory, intRef(words, 12, 32))) << "there is no second word";
  EXPECT_FALSE(asReal(memory, intRef(words, 8, 8)));
}

TEST_F(MemoryTest, TextsAreCutAndEnded) {
  Ref text = intRef(1, 2, 8);
  text.kind = RefKind::Text;
  text.count = 4;
  block[134] = 0xEE;
  writeText(memory, text, "AB");
  EXPECT_EQ(readText(memory, text), "AB");
  writeText(memory, text, "ABCDEF");
  EXPECT_EQ(readText(memory, text), "ABCD");
  EXPECT_EQ(block[134], 0xEE);
}

TEST_F(MemoryTest, ElementsAndBits) {
  Ref words = intRef(1, 2, 16);
  words.count = 3;
  EXPECT_EQ(element(words, 2)->byte, 6u);
  EXPECT_EQ(element(words, 2)->count, 1u);
  EXPECT_FALSE(element(words, 3));
  Ref bits = bitRef(1, 1, 6);
  bits.count = 4;
  EXPECT_EQ(*element(bits, 3), bitRef(1, 2, 1));
  EXPECT_EQ(*bitOf(words, 11), bitRef(1, 3, 3));
  EXPECT_FALSE(bitOf(words, 16));
  EXPECT_FALSE(bitOf(bits, 0));
}

TEST_F(MemoryTest, ConstantsAreReadOnly) {
  Ref constant;
  constant.kind = RefKind::Constant;
  constant.constant = -7;
  writeRaw(memory, constant, 1);
  writeReal(memory, constant, 1);
  writeText(memory, constant, "x");
  EXPECT_EQ(readSigned(memory, constant), -7);
  EXPECT_EQ(readReal(memory, constant), -7.0);
}

} // namespace
