// Names as each dialect writes them.
#include "rtlib/nc/names/names.h"

#include <gtest/gtest.h>

#include <tuple>

#include "rtlib/nc/nct/signals.h"

#include "tests/unit/rtlib/test_program.h"

namespace {

using namespace rung::runtime;
using namespace rung::nc;
using rung::test::TestProgram;

class GskNames : public testing::Test {
protected:
  GskNames() {
    test.dialect = "gsk";
    test.memorySize = 512;
    x = test.addSpace("X", 1, {{0, 16, 0, RUNG_REPR_BYTE_PER_BIT}});
    d = test.addPacked("D", 1, 32, 128);
    test.addSymbol("START", x, 2, RUNG_TYPE_BIT, 1);
    test.addSymbol("COUNT", d, 10, RUNG_TYPE_I8);
    test.addSymbol("D5", d, 20, RUNG_TYPE_I8); // a symbol goes before an address
    test.addSymbol("@NEXT", d, 30, RUNG_TYPE_I16);
    test.link();
  }
  std::optional<Ref> at(std::string_view name) const { return resolve(test.program, name); }
  TestProgram test;
  uint32_t x, d;
};

TEST_F(GskNames, Addresses) {
  EXPECT_EQ(at("X002.1"), bitRef(x, 2, 1));
  EXPECT_EQ(at("X2.1"), bitRef(x, 2, 1));
  EXPECT_EQ(at("D10"), intRef(d, 10, 8));
  EXPECT_EQ(at("D10:2"), intRef(d, 10, 16));
  EXPECT_EQ(at("D10:4"), intRef(d, 10, 32));
  EXPECT_EQ(at("D28:4"), intRef(d, 28, 32));
}

TEST_F(GskNames, Symbols) {
  EXPECT_EQ(at("START"), bitRef(x, 2, 1));
  EXPECT_EQ(at("COUNT"), intRef(d, 10, 8));
  EXPECT_EQ(at("COUNT.3"), bitRef(d, 10, 3));
  EXPECT_EQ(at("COUNT:2"), intRef(d, 10, 16));
  EXPECT_EQ(at("D5"), intRef(d, 20, 8));
  EXPECT_EQ(at("@NEXT"), intRef(d, 30, 16));
}

TEST_F(GskNames, WhatIsNoPlace) {
  for (const char* name :
       {"",        "X",   "X16", "X2.8",  "X2.1.1", "D10:3", "D10:8", "D29:4", "D32",          "Q1",
        "START.1", "D-1", "D 1", "start", "D10:",   "D10.",  ".1",    ":2",    "D99999999999", "D4294967297"})
    EXPECT_FALSE(at(name)) << name;
}

TEST_F(GskNames, FallbackServesWhatTheProgramDoesNotKnow) {
  const NameFallback signals = [&](std::string_view name) -> std::optional<Ref> {
    if (name == "SIGNAL" || name == "START") return intRef(d, 4, 8);
    return std::nullopt;
  };
  EXPECT_EQ(resolve(test.program, "SIGNAL", signals), intRef(d, 4, 8));
  EXPECT_EQ(resolve(test.program, "SIGNAL.2", signals), bitRef(d, 4, 2));
  EXPECT_EQ(resolve(test.program, "START", signals), bitRef(x, 2, 1)); // the program's own goes before
}

TEST_F(GskNames, Descriptions) {
  EXPECT_EQ(describe(test.program, bitRef(x, 2, 1)), "X2.1 (START)");
  EXPECT_EQ(describe(test.program, bitRef(x, 2, 2)), "X2.2");
  EXPECT_EQ(describe(test.program, intRef(d, 10, 8)), "D10 (COUNT)");
  EXPECT_EQ(describe(test.program, intRef(d, 11, 8)), "D11");
  EXPECT_EQ(describe(test.program, intRef(d, 31, 8)), "D31 (@NEXT)");
  EXPECT_EQ(describe(test.program, bitRef(9, 2, 1)), "no space");
}

TEST_F(GskNames, OfPlaces) {
  EXPECT_EQ(placeName(test.program, bitRef(x, 2, 1)), "START");
  EXPECT_EQ(placeName(test.program, bitRef(x, 2, 2)), "X2.2");
  EXPECT_EQ(placeName(test.program, intRef(d, 10, 16)), "D10");
  EXPECT_EQ(cellAddress(test.program, intRef(d, 10, 16)), "D10:2");
  EXPECT_EQ(cellAddress(test.program, intRef(d, 10, 8)), "D10");
  EXPECT_EQ(cellAddress(test.program, bitRef(x, 2, 1)), "X2.1");
  EXPECT_TRUE(hasAddresses(test.program));
}

class FanucNames : public testing::Test {
protected:
  FanucNames() {
    test.dialect = "fanuc";
    test.memorySize = 64;
    r = test.addPacked("R", 1, 32, 0);
    test.addSymbol("*-L1_P01", r, 2, RUNG_TYPE_BIT, 1);
    test.addSymbol("mSP_Run", r, 3, RUNG_TYPE_BIT, 0);
    test.addSymbol("Mode", r, 4, RUNG_TYPE_I8);
    test.addSymbol("MODE", r, 5, RUNG_TYPE_I8); // not by a FANUC compiler
    test.link();
  }
  std::optional<Ref> at(std::string_view name) const { return resolve(test.program, name); }
  TestProgram test;
  uint32_t r;
};

TEST_F(FanucNames, EitherCase) {
  EXPECT_EQ(at("msp_RUN"), bitRef(r, 3, 0));
  EXPECT_EQ(at("*-l1_p01"), bitRef(r, 2, 1));
  EXPECT_EQ(at("Mode"), intRef(r, 4, 8)); // the exact name goes before
  EXPECT_EQ(at("MODE"), intRef(r, 5, 8));
  EXPECT_EQ(at("Mode.3"), bitRef(r, 4, 3));
  EXPECT_EQ(at("r7.1"), bitRef(r, 7, 1));
  EXPECT_EQ(at("r7:2"), intRef(r, 7, 16));
  EXPECT_FALSE(at("q7"));
  EXPECT_FALSE(at("mod"));
}

TEST_F(FanucNames, AreShownAsWritten) {
  EXPECT_EQ(placeName(test.program, bitRef(r, 3, 0)), "mSP_Run");
  EXPECT_EQ(describe(test.program, bitRef(r, 2, 1)), "R2.1 (*-L1_P01)");
}

class NctNames : public testing::Test {
protected:
  NctNames() {
    test.dialect = "nct";
    test.memorySize = 50000;
    m = test.addPacked("M", 4, 40000, 0);
    ts = test.addPacked("TS", 4, 400, 40000);
    test.addTask("MAIN", test.addChunk([](uint8_t*, rung_ctx* ctx, uint32_t) { return rung::test::popChunk(ctx); }));
    test.addBeginCopy(0, {RUNG_COPY_ALL, 40000 + 4, 4, 0, 4 * 80 - 4}); // synchronised: up to word 0079
    test.addSymbol("APPLE", m, 4 * 56, RUNG_TYPE_I32);
    test.addSymbol("READY", m, 4 * 60 + 2, RUNG_TYPE_BIT, 1); // bit 17
    test.addSymbol("FAR", m, 4 * 6000, RUNG_TYPE_I32);
    test.addConstant("THREE", 3);
    test.addConstant("BACK", -2);
    test.link();
  }
  std::optional<Ref> at(std::string_view name) const { return resolve(test.program, name); }
  TestProgram test;
  uint32_t m, ts;
};

TEST_F(NctNames, WordsAndBits) {
  EXPECT_EQ(at("0056"), intRef(m, 224, 32));
  EXPECT_EQ(at("9999"), intRef(m, 39996, 32));
  EXPECT_EQ(at("0056.17"), bitRef(m, 226, 1));
  EXPECT_EQ(at("0056.00"), bitRef(m, 224, 0));
  EXPECT_EQ(at("APPLE"), intRef(m, 224, 32));
  EXPECT_EQ(at("APPLE.05"), bitRef(m, 224, 5));
  EXPECT_EQ(at("READY"), bitRef(m, 242, 1));
}

TEST_F(NctNames, Offsets) {
  EXPECT_EQ(at("7100,#3"), intRef(m, 4 * 7103, 32));
  EXPECT_EQ(at("APPLE,#3"), intRef(m, 4 * 59, 32));
  EXPECT_EQ(at("APPLE,THREE"), intRef(m, 4 * 59, 32));
  EXPECT_EQ(at("APPLE,BACK"), intRef(m, 4 * 54, 32));
  EXPECT_EQ(at("0056.17,#3"), bitRef(m, 4 * 59 + 2, 1));
  EXPECT_EQ(at("READY,#1"), bitRef(m, 246, 1));
}

TEST_F(NctNames, TimeSliceCopy) {
  EXPECT_EQ(at("!APPLE.05"), bitRef(ts, 224, 5));
  EXPECT_EQ(at("!READY"), bitRef(ts, 242, 1));
  EXPECT_EQ(at("!0056,#3"), intRef(ts, 236, 32));
  EXPECT_EQ(at("!0001"), intRef(ts, 4, 32));
  EXPECT_EQ(at("!0000"), intRef(ts, 0, 32));
  EXPECT_EQ(at("!0079"), intRef(ts, 4 * 79, 32));
  EXPECT_EQ(at("!0080"), intRef(m, 4 * 80, 32)); // not synchronised: the two memories are one there
  EXPECT_FALSE(at("!FAR"));                      // user memory exists once
  EXPECT_FALSE(at("!THREE"));
}

TEST_F(NctNames, Reals) {
  EXPECT_EQ(at("REAL.0056"), realRef(m, 224));
  EXPECT_EQ(at("REAL.APPLE"), realRef(m, 224));
  EXPECT_EQ(at("REAL.APPLE,#3"), realRef(m, 236));
  EXPECT_EQ(at("REAL.!0056"), realRef(ts, 224));
  EXPECT_EQ(at("!REAL.0056"), realRef(ts, 224));
  EXPECT_EQ(at("REAL.9998"), realRef(m, 39992));
  for (const char* name : {"REAL.", "REAL.9999", "REAL.READY", "REAL.0056.01", "REAL.THREE", "REAL.56", "real.0056",
                           "REAL.05", "!REAL.FAR"})
    EXPECT_FALSE(at(name)) << name;
  EXPECT_EQ(placeName(test.program, realRef(m, 224)), "REAL.APPLE");
  EXPECT_EQ(placeName(test.program, realRef(m, 236)), "REAL.ANINPUTS,#13");
  EXPECT_EQ(cellAddress(test.program, realRef(m, 224)), "REAL.ANINPUTS,#10");
  EXPECT_EQ(meant(test.program, intRef(m, 224, 64)), realRef(m, 224)); // it has no such integers
  EXPECT_EQ(meant(test.program, intRef(m, 224, 32)), intRef(m, 224, 32));
}

TEST_F(NctNames, ABitOfASymbolThatIsCalledReal) {
  test.addSymbol("REAL", m, 4 * 6000, RUNG_TYPE_I32);
  test.link();
  EXPECT_EQ(at("REAL.05"), bitRef(m, 24000, 5));
  EXPECT_EQ(at("REAL.REAL"), realRef(m, 24000));
}

TEST(NamesOfParts, LoseWhatIsAroundThem) {
  for (const char* name :
       {"SYM", "SYM.3", "SYM,#2", "SYM[2]", "!SYM", "SYM:2", "SYM+4", "REAL.SYM", "REAL.!SYM", "!REAL.SYM,#2"})
    EXPECT_EQ(headOf(name), "SYM") << name;
}

TEST_F(NctNames, Constants) {
  ASSERT_TRUE(at("BACK"));
  EXPECT_EQ(at("BACK")->kind, RefKind::Constant);
  EXPECT_EQ(at("BACK")->constant, -2);
}

TEST_F(NctNames, WhatIsNoPlace) {
  for (const char* name : {"56", "00056", "0056.5", "0056.32", "0056.017", "9999,#1", "APPLE,APPLE", "APPLE,#", "apple",
                           "READY.01", "0056:0058", "!", ",#1", "0000,BACK", "APPLE,#99999999999999999999", "0056.1x"})
    EXPECT_FALSE(at(name)) << name;
}

TEST_F(NctNames, FallbackGetsTheNameWithoutModifierAndBit) {
  const NameFallback signals = [&](std::string_view name) -> std::optional<Ref> {
    return name == "OUT000" ? std::optional<Ref>(intRef(m, 40, 32)) : std::nullopt;
  };
  EXPECT_EQ(resolve(test.program, "!OUT000.03", signals), bitRef(ts, 40, 3));
  EXPECT_EQ(resolve(test.program, "OUT000,#2", signals), intRef(m, 48, 32));
}

TEST_F(NctNames, Descriptions) {
  EXPECT_EQ(describe(test.program, bitRef(m, 24002, 1)), "6000.17 (FAR)");
  EXPECT_EQ(describe(test.program, bitRef(ts, 4, 5)), "!0001.05");
  EXPECT_EQ(describe(test.program, intRef(m, 24000, 8)), "6000 (FAR)");
  EXPECT_EQ(describe(test.program, intRef(m, 24003, 8)), "6000 byte 3 (FAR)");
  EXPECT_EQ(describe(test.program, intRef(m, 24007, 8)), "6001 byte 3");
}

// The manual has no addresses for the NC area: what stands at a terminal, and in a source, is a name.
TEST_F(NctNames, PlacesOfTheNcAreaAreItsSignals) {
  for (const char* name : {"INP000.11", "OUT000.03", "INP071.31", "MKBTNS0.05", "MKBTNS0.05,#1", "MKFOVER,#3",
                           "MKFOVER,#0", "AN_PLCA", "AN_PLCA,#2", "SP_SOVER,#4", "N_ACTMSG", "HWMOVE,#0"}) {
    const std::optional<Ref> place = at(name);
    ASSERT_TRUE(place) << name;
    EXPECT_EQ(cellAddress(test.program, *place), name);
  }
  EXPECT_EQ(at("MKFOVER")->count, 4u);
  EXPECT_EQ(at("MKFOVER,#1")->count, 1u);
  EXPECT_EQ(cellAddress(test.program, *at("MKFOVER")), "MKFOVER"); // all its elements
  const uint32_t real = at("SP_SOVER")->byte;
  EXPECT_EQ(at(cellAddress(test.program, intRef(m, real, 32))), intRef(m, real, 32)); // half a double has no name
  EXPECT_EQ(at(cellAddress(test.program, intRef(m, real + 4, 32))), intRef(m, real + 4, 32));
}

TEST_F(NctNames, EveryPlaceOfTheNcAreaIsFoundByItsAddress) {
  const uint32_t end = rung::nc::areaBytes(rung::nc::nctSignals(), "M");
  for (uint32_t byte = 0; byte < end; byte += 4) {
    EXPECT_EQ(at(cellAddress(test.program, intRef(m, byte, 32))), intRef(m, byte, 32)) << byte;
    for (uint32_t bit = 0; bit < 32; ++bit) {
      const Ref place = bitRef(m, byte, bit);
      EXPECT_EQ(at(cellAddress(test.program, place)), place) << byte << '.' << bit;
    }
  }
}

TEST_F(NctNames, SymbolsOfTheNcAreaWithTheirSignals) {
  const Ref top = *at("INP000.11");
  test.addSymbol("LS_TOP", m, top.byte, RUNG_TYPE_BIT, top.bit);
  test.addSymbol("INP000", m, at("INP000")->byte, RUNG_TYPE_I32);
  test.link();
  EXPECT_EQ(describe(test.program, top), "INP000.11 (LS_TOP)");
  EXPECT_EQ(describe(test.program, *at("INP000.12")), "INP000.12");
  Ref copy = top;
  copy.space = ts;
  EXPECT_EQ(address(test.program, copy), "!INP000.11");
}

TEST_F(NctNames, OfPlaces) {
  EXPECT_EQ(placeName(test.program, bitRef(ts, 242, 1)), "!READY");
  EXPECT_EQ(placeName(test.program, bitRef(ts, 242, 2)), "!ANINPUTS.18,#14");
  EXPECT_EQ(placeName(test.program, *at("BACK")), "-2");
  EXPECT_EQ(cellAddress(test.program, intRef(ts, 224, 32)), "!ANINPUTS,#10");
  EXPECT_EQ(address(test.program, intRef(m, 227, 8)), "ANINPUTS,#10 byte 3");
  EXPECT_TRUE(hasAddresses(test.program));
}

constexpr char kLong31[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZ01234";

class TechnolNames : public testing::Test {
protected:
  TechnolNames() {
    test.dialect = "technol";
    test.memorySize = 512;
    data = test.addPacked("DATA", 1, 128, 0);
    nci = test.addPacked("NCI", 1, 64, 128);
    test.addSymbol("CELL", data, 4, RUNG_TYPE_I16);
    test.addSymbol("OTHER", data, 6, RUNG_TYPE_I8);
    test.addSymbol("WEIGHT", data, 9, RUNG_TYPE_BIT, 5);
    test.addSymbol("TABLE", data, 16, RUNG_TYPE_I32, 0, 4);
    test.addSymbol("TEXT", data, 40, RUNG_TYPE_TEXT, 0, 10);
    test.addSymbol("SPEED", nci, 8, RUNG_TYPE_F64);
    test.addSymbol("BLK[0].M3", nci, 3, RUNG_TYPE_BIT, 3);
    test.addSymbol("@DR", data, 100, RUNG_TYPE_I32);
    test.addSymbol(kLong31, data, 60, RUNG_TYPE_I8);
    test.addSymbol("B234567890123456789012345678901_TAIL", data, 61, RUNG_TYPE_I8);
    test.addSymbol("LAST", data, 124, RUNG_TYPE_I32);
    test.link();
  }
  std::optional<Ref> at(std::string_view name) const { return resolve(test.program, name); }
  TestProgram test;
  uint32_t data, nci;
};

TEST_F(TechnolNames, SymbolsIgnoreCase) {
  EXPECT_EQ(at("CELL"), intRef(data, 4, 16));
  EXPECT_EQ(at("Cell"), intRef(data, 4, 16));
  EXPECT_EQ(at("speed"), realRef(nci, 8));
  EXPECT_EQ(at("@dr"), intRef(data, 100, 32));
  EXPECT_EQ(at("blk[0].m3"), bitRef(nci, 3, 3));
}

TEST_F(TechnolNames, BitsOfCells) {
  EXPECT_EQ(at("CELL.0"), bitRef(data, 4, 0));
  EXPECT_EQ(at("CELL.15"), bitRef(data, 5, 7));
  EXPECT_EQ(at("CELL.WEIGHT"), bitRef(data, 4, 5));
  EXPECT_EQ(at("WEIGHT.WEIGHT"), bitRef(data, 9, 5));
}

TEST_F(TechnolNames, Arrays) {
  EXPECT_EQ(at("TABLE[0]"), intRef(data, 16, 32));
  EXPECT_EQ(at("Table[3]"), intRef(data, 28, 32));
  EXPECT_EQ(at("TABLE[3].31"), bitRef(data, 31, 7));
  EXPECT_EQ(at("TABLE")->count, 4u);
  EXPECT_EQ(at("TEXT")->kind, RefKind::Text);
  EXPECT_EQ(at("TEXT[2]"), intRef(data, 42, 8));
}

TEST_F(TechnolNames, WidthsAndOffsets) {
  EXPECT_EQ(at("CELL:4"), intRef(data, 4, 32));
  EXPECT_EQ(at("table+6:8"), intRef(data, 22, 64));
  EXPECT_EQ(at("CELL+3"), intRef(data, 7, 16));
  EXPECT_EQ(at("CELL+3.2"), bitRef(data, 7, 2));
  EXPECT_EQ(at("TEXT+9"), intRef(data, 49, 8));
  EXPECT_EQ(at("WORD.TEXT+4"), intRef(data, 44, 16));
  EXPECT_EQ(at("BYTE.CELL"), intRef(data, 4, 8));
  EXPECT_EQ(at("SPEED:8"), intRef(nci, 8, 64));
  EXPECT_EQ(at("REAL.TABLE+8"), realRef(data, 24));
  EXPECT_EQ(at("real.speed"), realRef(nci, 8));
  EXPECT_EQ(at("QWRD.SPEED"), intRef(nci, 8, 64));
  for (const char* name : {"CELL:3", "CELL:", "WEIGHT:1", "CELL+", "CELL+-1", "+1", ":2", "WORD.", "WORD.WEIGHT",
                           "REAL.", "REAL.WEIGHT", "REAL.TABLE+121", "TABLE+111:2", "TABLE+4294967295", "CELL+2+"})
    EXPECT_FALSE(at(name)) << name;
}

TEST_F(TechnolNames, OnlyWhatIsAccessedHasToBeInTheSpace) {
  EXPECT_EQ(at("LAST+2:2"), intRef(data, 126, 16));
  EXPECT_EQ(at("WORD.LAST+2"), intRef(data, 126, 16));
  EXPECT_EQ(at("LAST+3:1"), intRef(data, 127, 8));
  EXPECT_EQ(at("LAST+3.7"), bitRef(data, 127, 7));
  EXPECT_EQ(at("LAST+2.12"), bitRef(data, 127, 4));
  EXPECT_EQ(at("LAST+3.WEIGHT"), bitRef(data, 127, 5));
  for (const char* name : {"LAST+1", "LAST+3:2", "LAST+4:1", "LAST+3.8", "LAST+4.0", "LAST+2.16", "LAST+4.WEIGHT"})
    EXPECT_FALSE(at(name)) << name;
}

TEST_F(TechnolNames, ThirtyOneCharactersCount) {
  const std::string longer = std::string(kLong31) + "XYZ";
  EXPECT_EQ(at(longer), intRef(data, 60, 8));
  EXPECT_EQ(at(longer + ".3"), bitRef(data, 60, 3));
  EXPECT_EQ(at(std::string(kLong31) + ".3"), bitRef(data, 60, 3));
  EXPECT_EQ(at("B234567890123456789012345678901"), intRef(data, 61, 8));
  EXPECT_EQ(at("B234567890123456789012345678901_HEAD"), intRef(data, 61, 8));
  EXPECT_FALSE(at("B23456789012345678901234567890")); // 30: another name
}

TEST_F(TechnolNames, WhatIsNoPlace) {
  for (const char* name : {"CELL.16", "CELL.OTHER", "CELL.NONE", "TABLE[4]", "TABLE[]", "TABLE[-1]", "TABLE]",
                           "NONE[0]", "CELL.", ".3", "WEIGHT.0", "A.B.C.D.E.F.G.H.I.J.K", "]", "["})
    EXPECT_FALSE(at(name)) << name;
}

TEST_F(TechnolNames, FallbackSeesUpperCaseAndTheWholeNameFirst) {
  std::vector<std::string> asked;
  const NameFallback signals = [&](std::string_view name) -> std::optional<Ref> {
    asked.emplace_back(name);
    return name == "P1OUT" ? std::optional<Ref>(intRef(nci, 0, 8)) : std::nullopt;
  };
  EXPECT_EQ(resolve(test.program, "p1out.0", signals), bitRef(nci, 0, 0));
  EXPECT_EQ(asked, (std::vector<std::string>{"P1OUT.0", "P1OUT"}));
}

TEST_F(TechnolNames, Descriptions) {
  EXPECT_EQ(describe(test.program, intRef(data, 4, 8)), "CELL");
  EXPECT_EQ(describe(test.program, intRef(data, 5, 8)), "CELL+1");
  EXPECT_EQ(describe(test.program, bitRef(data, 5, 2)), "CELL.10");
  EXPECT_EQ(describe(test.program, bitRef(data, 9, 5)), "WEIGHT");
  EXPECT_EQ(describe(test.program, bitRef(data, 21, 1)), "TABLE[1].9");
  EXPECT_EQ(describe(test.program, intRef(data, 24, 32)), "TABLE[2]");
  EXPECT_EQ(describe(test.program, intRef(data, 110, 8)), "DATA+110"); // no symbol lies there
}

TEST_F(TechnolNames, OfPlaces) {
  EXPECT_EQ(placeName(test.program, intRef(data, 4, 16)), "CELL");
  EXPECT_EQ(cellAddress(test.program, intRef(data, 4, 16)), "CELL");
  EXPECT_EQ(cellAddress(test.program, intRef(data, 4, 8)), "BYTE.CELL");
  EXPECT_EQ(address(test.program, bitRef(data, 9, 5)), "WEIGHT");
  EXPECT_FALSE(hasAddresses(test.program));
}

// What is printed of a place can be written in a program, and is that place.
TEST_F(TechnolNames, AddressesLeadBack) {
  for (const Ref& place :
       {intRef(data, 4, 16), intRef(data, 4, 8), intRef(data, 5, 8), intRef(data, 6, 32), intRef(data, 20, 32),
        intRef(data, 22, 16), intRef(data, 42, 8), intRef(data, 44, 64), intRef(nci, 8, 64), intRef(nci, 10, 16),
        bitRef(data, 5, 7), bitRef(data, 22, 3), bitRef(data, 41, 1), bitRef(nci, 9, 2), realRef(nci, 8)}) {
    const std::string text = cellAddress(test.program, place);
    const std::optional<Ref> found = at(text);
    ASSERT_TRUE(found) << text;
    EXPECT_EQ(std::tuple(found->space, found->byte, found->bit, found->width),
              std::tuple(place.space, place.byte, place.bit, place.width))
        << text;
  }
}

// A weight follows the last point of a name that is nothing else.
TEST_F(TechnolNames, WeightsOfPartsOfNames) {
  EXPECT_EQ(at("TABLE[1].WEIGHT"), bitRef(data, 20, 5));
  EXPECT_EQ(at("CELL+3.WEIGHT"), bitRef(data, 7, 5));
  EXPECT_FALSE(at("CELL:2.WEIGHT"));
  EXPECT_FALSE(at("CELL.WEIGHT:1"));
}

TEST(NamesOfAnUnknownDialect, AreSymbolsAndTheirParts) {
  TestProgram test;
  const uint32_t area = test.addPacked("R", 1, 32, 0);
  test.addSymbol("CELL", area, 4, RUNG_TYPE_I16);
  test.addSymbol("TABLE", area, 8, RUNG_TYPE_I16, 0, 4);
  test.link();
  EXPECT_EQ(resolve(test.program, "CELL"), intRef(area, 4, 16));
  EXPECT_EQ(resolve(test.program, "CELL.3"), bitRef(area, 4, 3));
  EXPECT_EQ(resolve(test.program, "CELL:4"), intRef(area, 4, 32));
  EXPECT_EQ(resolve(test.program, "TABLE[2]"), intRef(area, 12, 16));
  EXPECT_EQ(resolve(test.program, "CELL+1"), intRef(area, 5, 16));
  for (const char* name : {"cell", "CELL:8", "R4", "0001", "TABLE[4]", "CELL+31"})
    EXPECT_FALSE(resolve(test.program, name)) << name;
  EXPECT_EQ(describe(test.program, bitRef(area, 4, 3)), "R+4.3 (CELL)");
}

} // namespace
