// Places that input copies overwrite: found whatever their representation, and named with the place to write.
#include "rtlib/host/overwritten.h"

#include <gtest/gtest.h>

#include "rtlib/host/instance.h"
#include "rtlib/host/names.h"
#include "tests/unit/rtlib/test_program.h"

namespace {

using namespace rung::host;
using rung::test::TestProgram;

class OverwrittenPlaces : public testing::Test {
protected:
  OverwrittenPlaces() {
    m = test.addSpace("M", 4, {{0, 8, 0, RUNG_REPR_PACKED}, {8, 2, 8, RUNG_REPR_BYTE_PER_BIT}});
    ts = test.addSpace("TS", 4, {{0, 8, 32, RUNG_REPR_PACKED}, {8, 2, 40, RUNG_REPR_BYTE_PER_BIT}});
    test.dialect = "nct";
    task = test.addTask("MAIN", test.addChunk([](uint8_t*, rung_ctx* ctx) { return rung::test::popChunk(ctx); }));
    test.addSymbol("BUTTON", m, 4, RUNG_TYPE_BIT, 3);
    test.addSymbol("FREE", m, 0, RUNG_TYPE_I32);
  }
  uint32_t m, ts, task;
  TestProgram test;
};

TEST_F(OverwrittenPlaces, AreThoseOfInputCopies) {
  test.addBeginCopy(task, {RUNG_COPY_ALL, 36, 4, 0, 20});
  const Overwritten overwritten(test.link());
  EXPECT_EQ(overwritten.source(intRef(m, 0, 32)), std::nullopt);
  EXPECT_EQ(overwritten.source(bitRef(m, 4, 3)), bitRef(ts, 4, 3));
  EXPECT_EQ(overwritten.source(intRef(m, 4, 32)), intRef(ts, 4, 32));
  EXPECT_EQ(overwritten.source(intRef(m, 2, 32)), intRef(ts, 2, 32)) << "two bytes of it are";
  EXPECT_EQ(overwritten.source(bitRef(m, 9, 7)), bitRef(ts, 9, 7)) << "a byte for each bit";
  EXPECT_EQ(overwritten.source(bitRef(ts, 4, 3)), std::nullopt);
  Ref constant;
  constant.kind = RefKind::Constant;
  EXPECT_EQ(overwritten.source(constant), std::nullopt);
}

TEST_F(OverwrittenPlaces, AreNotThoseThatTheTaskGivesBack) {
  test.addBeginCopy(task, {RUNG_COPY_ALL, 4, 120, 0, 4});
  test.addBeginCopy(task, {RUNG_COPY_ALL, 124, 4, 0, 4});
  test.addEndCopy(task, {RUNG_COPY_ALL, 120, 4, 0, 4});
  EXPECT_EQ(Overwritten(test.link()).source(bitRef(m, 4, 3)), std::nullopt);
}

TEST_F(OverwrittenPlaces, AreNotThoseOfMaskedCopies) {
  test.addBeginCopy(task, {RUNG_COPY_MASKED, 36, 4, 64, 4});
  EXPECT_EQ(Overwritten(test.link()).source(bitRef(m, 4, 3)), std::nullopt);
}

TEST_F(OverwrittenPlaces, AreNamedWithThePlaceToWrite) {
  test.addBeginCopy(task, {RUNG_COPY_ALL, 36, 4, 0, 4});
  Instance instance(test.link());
  const std::string lost = "a value written to BUTTON is lost: !BUTTON is copied over it before the program reads it; "
                           "write !BUTTON";
  EXPECT_EQ(instance.write(*instance.resolve("BUTTON"), 1), lost);
  EXPECT_EQ(instance.write("BUTTON", 1), lost);
  EXPECT_EQ(instance.read(*instance.resolve("BUTTON")), 0u) << "nothing is written then";
  EXPECT_EQ(instance.write("!BUTTON", 1), "");
  EXPECT_EQ(instance.read(*instance.resolve("!BUTTON")), 1u);
  EXPECT_EQ(instance.write("0001.04", 1),
            "a value written to 0001.04 is lost: !0001.04 is copied over it before the program reads it; write "
            "!0001.04");
  EXPECT_EQ(instance.write("FREE", 7), "");
  EXPECT_EQ(instance.write("BUTON", 1), "the program has no name or address 'BUTON'");
}

TEST_F(OverwrittenPlaces, AreFoundForRealsAndTextsToo) {
  test.addBeginCopy(task, {RUNG_COPY_ALL, 36, 4, 0, 4});
  Instance instance(test.link());
  EXPECT_NE(instance.writeReal(realRef(m, 0), 1.5), "");
  EXPECT_EQ(instance.writeReal(realRef(ts, 0), 1.5), "");
  Ref text = intRef(m, 0, 8);
  text.kind = RefKind::Text;
  text.count = 4;
  EXPECT_EQ(instance.writeText(text, "abcd"), "");
  text.count = 5;
  EXPECT_NE(instance.writeText(text, "abcde"), "");
}

} // namespace
