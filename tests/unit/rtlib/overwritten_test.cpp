// Places that input copies overwrite: found whatever their representation, and not written.
#include "rtlib/run/loaded_program.h"

#include <gtest/gtest.h>

#include "rtlib/run/instance.h"
#include "tests/unit/rtlib/test_program.h"

namespace {

using namespace rung::runtime;
using rung::test::TestProgram;

class OverwrittenPlaces : public testing::Test {
protected:
  OverwrittenPlaces() {
    m = test.addSpace("M", 4, {{0, 8, 0, RUNG_REPR_PACKED}, {8, 2, 8, RUNG_REPR_BYTE_PER_BIT}});
    ts = test.addSpace("TS", 4, {{0, 8, 32, RUNG_REPR_PACKED}, {8, 2, 40, RUNG_REPR_BYTE_PER_BIT}});
    task = test.addTask("MAIN",
                        test.addChunk([](uint8_t*, rung_ctx* ctx, uint32_t) { return rung::test::popChunk(ctx); }));
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

TEST_F(OverwrittenPlaces, AreNotWritten) {
  test.addBeginCopy(task, {RUNG_COPY_ALL, 36, 4, 0, 4});
  Instance instance(test.link());
  const Ref button = bitRef(m, 4, 3), copied = bitRef(ts, 4, 3);
  EXPECT_EQ(instance.write(button, 1), copied);
  EXPECT_EQ(instance.read(button), 0u);
  EXPECT_EQ(instance.write(copied, 1), std::nullopt);
  EXPECT_EQ(instance.read(copied), 1u);
}

TEST_F(OverwrittenPlaces, AreFoundForRealsAndTextsToo) {
  test.addBeginCopy(task, {RUNG_COPY_ALL, 36, 4, 0, 4});
  Instance instance(test.link());
  EXPECT_EQ(instance.writeReal(realRef(m, 0), 1.5), realRef(ts, 0));
  EXPECT_EQ(instance.readReal(realRef(m, 0)), 0);
  EXPECT_EQ(instance.writeReal(realRef(ts, 0), 1.5), std::nullopt);
  EXPECT_EQ(instance.readReal(realRef(ts, 0)), 1.5);
  Ref text = intRef(m, 0, 8);
  text.kind = RefKind::Text;
  text.count = 4;
  EXPECT_EQ(instance.writeText(text, "abcd"), std::nullopt);
  EXPECT_EQ(instance.readText(text), "abcd");
  text.count = 5;
  EXPECT_NE(instance.writeText(text, "vwxyz"), std::nullopt);
  EXPECT_EQ(instance.readText(text), "abcd");
}

} // namespace
