// Reports: order, figures, sums, tables; and what calibrates the clock.
#include "tools/report/profile_rungs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rtlib/core/ticks.h"
#include "tests/unit/rtlib/test_program.h"

namespace {

using namespace rung::report;
using rung::test::TestProgram;
using testing::HasSubstr;

class ReportingProfile : public testing::Test {
protected:
  ReportingProfile() {
    for (int i = 0; i < 5; ++i) test.addChunk([](uint8_t*, rung_ctx*, uint32_t) { return RUNG_PC_DONE; });
    test.routines = {"MAIN", "MAIN.SBN5", "LEVEL1"};
    test.link();
    test.rungs[1].routine = 1;
    test.rungs[4].routine = 2;
  }
  // Each rung takes so much in each of `scans` scans; rung 2 never runs.
  void run(ProfileCollector& collector, const std::vector<uint64_t>& perScan, uint64_t scans) {
    counters.assign(counters.size(), {});
    collector.started(counters);
    for (uint64_t scan = 0; scan < scans; ++scan) {
      for (size_t i = 0; i < perScan.size(); ++i) {
        counters[i].count += perScan[i] == 0 ? 0 : 1;
        counters[i].total += perScan[i];
      }
      collector.scanned(counters);
    }
  }
  ProfileReport report(Order order) { return makeReport(test.program, &operations, &ticks, {2.0, 0}, order); }
  static std::vector<uint32_t> rungsOf(const ProfileReport& report) {
    std::vector<uint32_t> rungs;
    for (const Row& row : report.rows) rungs.push_back(row.rung);
    return rungs;
  }

  TestProgram test;
  std::vector<rung_prof> counters = std::vector<rung_prof>(5);
  ProfileCollector operations{5, 0};
  ProfileCollector ticks{5, 0};
};

TEST_F(ReportingProfile, TheOrderIsThatOfTheOperations) {
  run(operations, {10, 30, 0, 5, 30}, 10);
  run(ticks, {100, 20, 0, 300, 50}, 30);
  const ProfileReport byOperations = report(Order::Operations);
  EXPECT_EQ(rungsOf(byOperations), (std::vector<uint32_t>{1, 4, 0, 3}));
  EXPECT_EQ(byOperations.operations, 750u);
  EXPECT_DOUBLE_EQ(byOperations.rows[0].share, 300.0 / 750);
  ASSERT_EQ(byOperations.never.size(), 1u);
  EXPECT_EQ(byOperations.never[0].rung, 2u);
  EXPECT_EQ(rungsOf(report(Order::Time)), (std::vector<uint32_t>{3, 0, 4, 1}));
}

TEST_F(ReportingProfile, FiguresOfARow) {
  run(operations, {10, 0, 0, 0, 0}, 10);
  run(ticks, {50, 0, 0, 0, 0}, 20);
  run(ticks, {52, 0, 0, 0, 0}, 5);
  run(ticks, {40, 0, 0, 0, 0}, 4);
  run(ticks, {900, 0, 0, 0, 0}, 1);
  const Row row = report(Order::Time).rows.at(0);
  EXPECT_EQ(row.executions, 10u) << "of one run, though the times are of three";
  EXPECT_EQ(row.operations, 100u);
  EXPECT_EQ(row.scans, 10u);
  EXPECT_DOUBLE_EQ(row.minNs, 80);
  EXPECT_NEAR(row.medianNs, 100, 1);
  EXPECT_NEAR(row.meanNs, (20 * 50 + 5 * 52 + 4 * 40) / 29.0 * 2, 0.01) << "without the slowest";
  EXPECT_DOUBLE_EQ(row.maxNs, 1800);
  EXPECT_DOUBLE_EQ(row.time, 10 * row.meanNs);
  EXPECT_EQ(row.file, "main.pmc");
  EXPECT_EQ(row.line, 10u);
  EXPECT_EQ(row.routine, "MAIN");
  EXPECT_EQ(row.number, 1u) << "as drawn: from 1";
  EXPECT_DOUBLE_EQ(row.share, 1);
}

TEST_F(ReportingProfile, TheCostOfMeasuringIsSubtracted) {
  ProfileCollector costly(5, 24.5);
  run(operations, {1, 1, 0, 1, 1}, 4);
  run(costly, {24, 74, 0, 25, 20}, 2); // a clock that steps
  run(costly, {49, 74, 0, 24, 20}, 2);
  run(costly, {49, 74, 0, 24, 20}, 1);
  const ProfileReport made = makeReport(test.program, &operations, &costly, {2.0, 24.5}, Order::Time);
  EXPECT_EQ(rungsOf(made), (std::vector<uint32_t>{1, 0, 3, 4}));
  EXPECT_DOUBLE_EQ(made.rows[0].meanNs, 99);
  EXPECT_DOUBLE_EQ(made.rows[1].minNs, 0) << "never below nothing";
  EXPECT_DOUBLE_EQ(made.rows[1].meanNs, 24) << "less than a step of the clock, out of many scans";
  EXPECT_DOUBLE_EQ(made.rows[3].meanNs, 0);
}

TEST_F(ReportingProfile, OnePreemptionDoesNotChangeTheOrder) {
  run(operations, {1, 1, 0, 1, 1}, 100);
  run(ticks, {50, 40, 0, 30, 20}, 300);
  const std::vector<uint32_t> before = rungsOf(report(Order::Time));
  EXPECT_EQ(before, (std::vector<uint32_t>{0, 1, 3, 4}));
  run(ticks, {50, 40, 0, 30, 400'000}, 1); // more than all else together
  EXPECT_EQ(rungsOf(report(Order::Time)), before);
}

TEST_F(ReportingProfile, ARungThatRanInOneScanOfEachRunIsNotMovedByOnePreemptionEither) {
  run(operations, {0, 0, 0, 1, 0}, 1);
  run(operations, {1, 0, 0, 0, 0}, 9);
  run(ticks, {0, 0, 0, 20, 0}, 4);
  run(ticks, {0, 0, 0, 400'000, 0}, 1);
  run(ticks, {30, 0, 0, 0, 0}, 45);
  EXPECT_EQ(rungsOf(report(Order::Time)), (std::vector<uint32_t>{0, 3}));
}

TEST_F(ReportingProfile, RungsOfTheCompilerAreOneLine) {
  test.rungs[3].number = 0;
  test.rungs[4].number = 0;
  test.rungs[2].number = 0; // never ran: of no interest
  run(operations, {10, 30, 0, 5, 55}, 1);
  run(ticks, {10, 30, 0, 5, 55}, 1);
  const ProfileReport made = report(Order::Operations);
  EXPECT_EQ(rungsOf(made), (std::vector<uint32_t>{1, 0}));
  EXPECT_EQ(made.added.size(), 2u);
  EXPECT_TRUE(made.never.empty());
  EXPECT_THAT(rungTable(made, 0), HasSubstr("           2           60   60.0%        -        -        -        -  "
                                            "outside of the rungs: clock of timers, "
                                            "starts and ends of modules\n"));
}

TEST_F(ReportingProfile, TextIsATable) {
  run(operations, {10, 30, 0, 5, 55}, 1);
  run(ticks, {10, 30, 0, 5, 55}, 1);
  const std::string text = rungTable(report(Order::Operations), 2);
  EXPECT_THAT(text, HasSubstr("           1           55   55.0%    110.0    110.0    110.0    110.0  main.pmc:50\n"));
  EXPECT_THAT(text, HasSubstr("  ... and 2 more\n"));
  EXPECT_THAT(rungTable(report(Order::Operations), 0), testing::Not(HasSubstr("more")));
  EXPECT_THAT(rungTable(report(Order::Operations), 0), HasSubstr("main.pmc:40  title\n"));
}

TEST_F(ReportingProfile, SumsBySubprogramModuleAndFile) {
  test.rungs[3].file = RUNG_NONE;
  test.rungs[3].number = 0;
  run(operations, {10, 30, 0, 5, 55}, 2);
  run(ticks, {10, 30, 0, 5, 55}, 2);
  const ProfileReport made = report(Order::Operations);
  const std::vector<Sum> routines = sums(made, SumBy::Routine);
  ASSERT_EQ(routines.size(), 3u);
  EXPECT_EQ(routines[0].name, "LEVEL1");
  EXPECT_EQ(routines[1].name, "MAIN.SBN5");
  EXPECT_EQ(routines[2].name, "MAIN");
  EXPECT_EQ(routines[2].rungs, 3u) << "one of them never ran, one is the compiler's";
  EXPECT_EQ(routines[2].ran, 2u);
  EXPECT_EQ(routines[2].operations, 30u);
  EXPECT_EQ(routines[2].executions, 4u);
  EXPECT_DOUBLE_EQ(routines[2].share, 0.15);
  const std::vector<Sum> modules = sums(made, SumBy::Module);
  ASSERT_EQ(modules.size(), 2u);
  EXPECT_EQ(modules[1].name, "MAIN");
  EXPECT_EQ(modules[1].operations, 90u);
  EXPECT_DOUBLE_EQ(modules[1].time, 180);
  const std::vector<Sum> files = sums(made, SumBy::File);
  ASSERT_EQ(files.size(), 2u);
  EXPECT_EQ(files[0].name, "main.pmc");
  EXPECT_EQ(files[1].name, "");
  EXPECT_THAT(sumTable(files, "file", 0),
              HasSubstr("  outside of the rungs: clock of timers, starts and ends of modules\n"));
}

TEST_F(ReportingProfile, AHostHasTimesWithoutOperations) {
  run(ticks, {10, 30, 0, 5, 55}, 4);
  const ProfileReport made = makeReport(test.program, nullptr, &ticks, {1.0, 0}, Order::Operations);
  EXPECT_EQ(made.order, Order::Time);
  EXPECT_EQ(rungsOf(made), (std::vector<uint32_t>{4, 1, 0, 3}));
  EXPECT_EQ(made.rows[0].executions, 4u);
}

TEST_F(ReportingProfile, AProgramWithoutCountersHasNoRows) {
  const ProfileReport made = makeReport(test.program, nullptr, nullptr, {}, Order::Time);
  EXPECT_TRUE(made.rows.empty());
  EXPECT_TRUE(made.never.empty()) << "nobody looked";
}

TEST(ProfileClock, IsCalibratedAgainstTheClock) {
  const rung::runtime::ProfileClock& found = rung::runtime::calibratedClock();
  EXPECT_GT(found.nsPerTick, 0.01); // 100 GHz
  EXPECT_LT(found.nsPerTick, 200);  // 5 MHz
  const uint64_t before = rung::core::readTicks();
  timespec pause = {0, 5'000'000};
  nanosleep(&pause, nullptr);
  EXPECT_GE(static_cast<double>(rung::core::readTicks() - before) * found.nsPerTick, 4'500'000);
}

TEST(ProfileClock, ReadingItHasACost) {
  EXPECT_GE(rung::runtime::calibratedClock().costNs(), 0);
  EXPECT_LT(rung::runtime::calibratedClock().costNs(), 10'000);
}

} // namespace
