// Logical access over both representations, and typed access through a Ref.
#include "rtlib/core/memory.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "rtlib/host/ref.h"
#include "tests/unit/rtlib/test_program.h"

namespace {

using namespace rung::host;
using rung::rt::BitPlace;
using rung::rt::Memory;
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

TEST_F(MemoryTest, PlacesServeBothRepresentations) {
  const BitPlace packed = memory.bitPlace(0, 1, 6);
  const BitPlace expanded = memory.bitPlace(0, 5, 6);
  EXPECT_EQ(packed.offset, 1u);
  EXPECT_EQ(packed.mask, 0x40);
  EXPECT_EQ(expanded.offset, 78u);
  EXPECT_EQ(expanded.mask, 1);
  for (const BitPlace place : {packed, expanded}) {
    memory.writePlace(place, true);
    EXPECT_TRUE(memory.readPlace(place));
    memory.writePlace(place, false);
    EXPECT_FALSE(memory.readPlace(place));
  }
  EXPECT_EQ(memory.bitPlace(0, 10, 0).offset, RUNG_NONE);
  EXPECT_EQ(memory.bitPlace(0, 0, 8).offset, RUNG_NONE);
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

TEST_F(MemoryTest, AsRealTakesEightBytesFromThere) {
  ASSERT_TRUE(asReal(memory, intRef(1, 8, 32)));
  EXPECT_EQ(asReal(memory, intRef(1, 8, 32))->kind, RefKind::Real);
  EXPECT_FALSE(asReal(memory, intRef(1, 9, 32)));
  EXPECT_FALSE(asReal(memory, bitRef(1, 0, 0)));
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
