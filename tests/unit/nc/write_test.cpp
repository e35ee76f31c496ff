// What a person reads who writes to a place that an input copy overwrites.
#include "rtlib/nc/names/write.h"

#include <gtest/gtest.h>

#include "rtlib/nc/names/names.h"
#include "tests/unit/rtlib/test_program.h"

namespace {

using namespace rung;

// The second word of M is copied from TS before each run.
class WrittenByName : public testing::Test {
protected:
  WrittenByName() {
    test.dialect = "nct";
    const uint32_t m = test.addPacked("M", 4, 8, 0), ts = test.addPacked("TS", 4, 8, 32);
    const uint32_t task = test.addTask(
        "MAIN", test.addChunk([](uint8_t*, rung_ctx* ctx, uint32_t) { return rung::test::popChunk(ctx); }));
    test.addSymbol("BUTTON", m, 4, RUNG_TYPE_BIT, 3);
    test.addSymbol("FREE", m, 0, RUNG_TYPE_I32);
    test.addBeginCopy(task, {RUNG_COPY_ALL, 36, 4, 0, 4});
    real = runtime::realRef(m, 0);
    realCopy = runtime::realRef(ts, 0);
    instance.emplace(test.link());
  }
  runtime::Ref at(std::string_view name) const { return nc::resolve(test.program, name).value(); }
  test::TestProgram test;
  runtime::Ref real, realCopy;
  std::optional<runtime::Instance> instance;
};

TEST_F(WrittenByName, IsRefusedWithTheNameToWrite) {
  EXPECT_EQ(nc::write(*instance, at("BUTTON"), 1),
            "a value written to BUTTON is lost: !BUTTON is copied over it before the program reads it; write !BUTTON");
  EXPECT_EQ(instance->read(at("BUTTON")), 0u) << "nothing is written then";
  EXPECT_EQ(nc::write(*instance, at("!BUTTON"), 1), "");
  EXPECT_EQ(instance->read(at("!BUTTON")), 1u);
  EXPECT_EQ(nc::write(*instance, at("0001.04"), 1),
            "a value written to 0001.04 is lost: !0001.04 is copied over it before the program reads it; write "
            "!0001.04");
  EXPECT_EQ(nc::write(*instance, at("FREE"), 7), "");
  EXPECT_EQ(instance->read(at("FREE")), 7u);
}

TEST_F(WrittenByName, RealsAndTextsToo) {
  EXPECT_EQ(nc::writeReal(*instance, real, 1.5),
            "a value written to REAL.FREE is lost: REAL.!FREE is copied over it before the program reads it; write "
            "REAL.!FREE");
  EXPECT_EQ(nc::writeReal(*instance, realCopy, 1.5), "");
  runtime::Ref text = at("FREE");
  text.kind = runtime::RefKind::Text;
  text.width = 8;
  text.count = 4;
  EXPECT_EQ(nc::writeText(*instance, text, "abcd"), "");
  EXPECT_EQ(instance->readText(text), "abcd");
  text.count = 5;
  EXPECT_NE(nc::writeText(*instance, text, "abcde"), "");
}

} // namespace
