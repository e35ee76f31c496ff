// Reports: order, figures, both renderings.
#include "rtlib/profile/profile.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "rtlib/core/ticks.h"
#include "tests/unit/rtlib/test_program.h"

namespace {

using namespace rung::profile;
using rung::test::TestProgram;
using testing::HasSubstr;

class ProfileTest : public testing::Test {
protected:
  ProfileTest() {
    for (int i = 0; i < 5; ++i) test.addChunk([](uint8_t*, rung_ctx*) { return RUNG_PC_DONE; });
    test.link();
  }
  TestProgram test;
  // Rung 2 never ran; 1 and 4 took the same time.
  std::vector<rung_prof> counters = {{10, 100, 20, 0}, {4, 300, 90, 0}, {}, {1, 1200, 1200, 0}, {8, 300, 40, 0}};
};

TEST_F(ProfileTest, RowsAreSortedByTimeThenExecutions) {
  const Report report = makeReport(test.program, counters, 2.0);
  ASSERT_EQ(report.rows.size(), 4u);
  EXPECT_EQ(report.rows[0].rung, 3u);
  EXPECT_EQ(report.rows[1].rung, 4u);
  EXPECT_EQ(report.rows[2].rung, 1u);
  EXPECT_EQ(report.rows[3].rung, 0u);
  EXPECT_EQ(report.rungs, 5u);
  EXPECT_DOUBLE_EQ(report.totalNs, 3800);
}

TEST_F(ProfileTest, FiguresOfARow) {
  const Report report = makeReport(test.program, counters, 2.0);
  const Row& row = report.rows[2];
  EXPECT_EQ(row.executions, 4u);
  EXPECT_DOUBLE_EQ(row.totalNs, 600);
  EXPECT_DOUBLE_EQ(row.meanNs, 150);
  EXPECT_DOUBLE_EQ(row.maxNs, 180);
  EXPECT_DOUBLE_EQ(row.share, 600.0 / 3800);
  EXPECT_EQ(row.file, "main.pmc");
  EXPECT_EQ(row.line, 20u);
  EXPECT_EQ(row.routine, "MAIN");
  EXPECT_EQ(report.rows[0].title, "title");
}

TEST_F(ProfileTest, TextIsATable) {
  const Report report = makeReport(test.program, counters, 1.0);
  EXPECT_EQ(reportText(report, 2),
            "test (test): 4 of 5 rungs ran\n"
            "  rung   executions     total us    mean ns     max ns   share  place\n"
            "     3            1        1.200     1200.0     1200.0   63.2%  main.pmc:40  title\n"
            "     4            8        0.300       37.5       40.0   15.8%  main.pmc:50\n"
            "  ... and 2 more\n");
  EXPECT_THAT(reportText(report), testing::Not(HasSubstr("more")));
}

TEST_F(ProfileTest, ARungWithoutAFileIsTheCompilers) {
  test.rungs[3].file = RUNG_NONE;
  EXPECT_THAT(reportText(makeReport(test.program, counters, 1.0)), HasSubstr("63.2%  added by the compiler to MAIN"));
}

TEST_F(ProfileTest, JsonHasTheSameFigures) {
  test.rungs[3].title = "bad \xff byte";
  const auto json = nlohmann::json::parse(reportJson(makeReport(test.program, counters, 2.0)));
  EXPECT_EQ(json["program"], "test");
  EXPECT_EQ(json["rung_count"], 5);
  ASSERT_EQ(json["rungs"].size(), 4u);
  EXPECT_EQ(json["rungs"][0]["rung"], 3);
  EXPECT_EQ(json["rungs"][0]["line"], 40);
  EXPECT_EQ(json["rungs"][2]["mean_ns"], 150.0);
  EXPECT_EQ(json["rungs"][2]["executions"], 4);
}

TEST_F(ProfileTest, ProgramWithoutCounters) {
  const Report report = makeReport(test.program, {}, 1.0);
  EXPECT_TRUE(report.rows.empty());
  EXPECT_EQ(report.totalNs, 0);
  EXPECT_THAT(reportText(report), HasSubstr("0 of 5 rungs ran"));
}

TEST(Ticks, CalibratedAgainstTheClock) {
  const double scale = nsPerTick();
  EXPECT_GT(scale, 0.01); // 100 GHz
  EXPECT_LT(scale, 200);  // 5 MHz
  const uint64_t before = rung::rt::readTicks();
  timespec pause = {0, 5'000'000};
  nanosleep(&pause, nullptr);
  EXPECT_GE(static_cast<double>(rung::rt::readTicks() - before) * scale, 4'500'000);
}

} // namespace
