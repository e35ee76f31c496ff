// Totals, merging, the two written forms.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tools/report/coverage_report.h"

namespace rung::report {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

Rung lamp() {
  return {.number = 1,
          .routine = "MAIN",
          .title = "lamp",
          .file = "a.lad",
          .line = 3,
          .runs = 2,
          .conditions = {{"[A]", 4, 3, true, true, true},
                         {"[B]", 4, 9, true, true, false},
                         {"{T}", 4, 15, false, true, true}},
          .outputs = {{"(L)", 4, 21, true, true, true}, {"{T}", 4, 15, false, true, false}},
          .decisions = {{{0}, {{0, kOpenOff | kClosedOn}, {1, 0}, {2, kClosedOn}}}}};
}
CoverageReport reportOf(std::vector<Rung> rungs, std::vector<std::string> files = {"a.lad"}) {
  return {{{std::move(files), std::move(rungs)}}};
}

TEST(CoverageReport, CountsWhatIsComplete) {
  Rung idle = lamp();
  idle.number = 2;
  idle.runs = 0;
  const Totals totals = totalsOf(reportOf({lamp(), idle}));
  EXPECT_EQ(totals.rungs.seen, 1u);
  EXPECT_EQ(totals.rungs.all, 2u);
  EXPECT_EQ(totals.contacts.seen, 2u); // [A] of both
  EXPECT_EQ(totals.contacts.all, 4u);  // the box's result is none
  EXPECT_EQ(totals.coils.seen, 2u);
  EXPECT_EQ(totals.coils.all, 2u);
  EXPECT_EQ(totals.decided.seen, 2u);
  EXPECT_EQ(totals.decided.all, 6u);
  EXPECT_EQ(totals.oneWay, 2u);
  EXPECT_DOUBLE_EQ(totals.rungs.percent(), 50);
  EXPECT_DOUBLE_EQ(totalsOf(CoverageReport{}).rungs.percent(), 100);
}

TEST(CoverageReport, MergesEqualPrograms) {
  CoverageReport report = reportOf({lamp()});
  Rung other = lamp();
  other.conditions[1].closed = true;
  other.decisions[0].by[2].alone = kOpenOff;
  merge(report, reportOf({other}));
  ASSERT_EQ(report.programs.size(), 1u);
  const Rung& rung = report.programs[0].rungs[0];
  EXPECT_EQ(rung.runs, 4u);
  EXPECT_TRUE(rung.conditions[1].closed);
  EXPECT_TRUE(rung.decisions[0].by[2].bothWays());
}

TEST(CoverageReport, KeepsOtherProgramsApart) {
  CoverageReport report = reportOf({lamp()});
  merge(report, reportOf({lamp()}, {"b.lad"}));
  Rung moved = lamp();
  moved.conditions[0].text = "[C]";
  merge(report, reportOf({moved}));
  EXPECT_EQ(report.programs.size(), 3u);
}

// Of a former run only the rungs count that are still there.
TEST(CoverageReport, AFormerRunOfAChangedProgram) {
  Rung second = lamp();
  second.number = 2;
  Rung changed = lamp();
  changed.outputs[0].text = "(M)";
  CoverageReport report = reportOf({changed, second});
  mergeFormer(report, reportOf({lamp(), second}));
  ASSERT_EQ(report.programs.size(), 1u);
  EXPECT_EQ(report.programs[0].rungs[0].runs, 2u);
  EXPECT_EQ(report.programs[0].rungs[1].runs, 4u);
  mergeFormer(report, reportOf({lamp()}, {"b.lad"}));
  EXPECT_EQ(report.programs.size(), 2u);
}

TEST(CoverageReport, JsonReadsBack) {
  Rung strange = lamp();
  strange.number = 2;
  strange.title = "\"quoted\" \\ ž";
  const std::string text = toJson(reportOf({lamp(), strange}));
  const Result<CoverageReport> read = fromJson(text);
  ASSERT_TRUE(read.ok()) << read.error();
  EXPECT_EQ(toJson(read.value()), text);
}

TEST(CoverageReport, JsonThatIsNone) {
  EXPECT_FALSE(fromJson("").ok());
  EXPECT_FALSE(fromJson("[]").ok());
  EXPECT_FALSE(fromJson("{}").ok());
  EXPECT_FALSE(fromJson(R"({"format":"rung-coverage","version":2,"programs":[]})").ok());
  EXPECT_TRUE(fromJson(R"({"format":"rung-coverage","version":1,"programs":[]})").ok());
  std::string text = toJson(reportOf({lamp()}));
  const std::string index = "\"condition\": 2";
  text.replace(text.find(index), index.size(), "\"condition\": 3");
  EXPECT_FALSE(fromJson(text).ok()); // there are 0 to 2
}

TEST(CoverageReport, TextSaysWhatIsMissing) {
  Rung idle = lamp();
  idle.number = 2;
  idle.runs = 0;
  const std::string text = toText(reportOf({lamp(), idle}), {});
  EXPECT_THAT(text, HasSubstr("rungs run                      1 of 2       50.0 %\n"));
  EXPECT_THAT(text, HasSubstr("contacts open and closed       2 of 4       50.0 %\n"));
  EXPECT_THAT(text, HasSubstr("  rung 1 \"lamp\" (a.lad:3)\n"
                              "    [B] (line 4) never closed\n"
                              "    {T} (line 4) never on\n"
                              "    {T} (line 4) was shown to switch (L) on, but never off\n"
                              "  rung 2 \"lamp\" (a.lad:3) never ran\n"));
  EXPECT_THAT(text, Not(HasSubstr("[B] (line 4) was"))); // it never closed; that says enough
}

// A box that gets no power gives none.
TEST(CoverageReport, TextSaysOnceThatABoxHasNoPower) {
  const Output input{.text = "{T}", .line = 4, .column = 9, .coil = false, .off = true};
  const Condition result{.text = "{T}", .line = 4, .column = 9, .contact = false, .open = true};
  Rung rung{.number = 1, .file = "a.lad", .line = 4, .runs = 3, .conditions = {result}, .outputs = {input}};
  EXPECT_THAT(toText(reportOf({rung}), {}),
              testing::EndsWith("not covered\n  rung 1 (a.lad:4)\n    {T} (line 4) never on\n"));
  rung.outputs[0].on = true;
  EXPECT_THAT(toText(reportOf({rung}), {}),
              testing::EndsWith("not covered\n  rung 1 (a.lad:4)\n    {T} (line 4) never on\n"));
  rung.conditions[0].closed = true;
  EXPECT_THAT(toText(reportOf({rung}), {}), Not(HasSubstr("never on")));
}

TEST(CoverageReport, TextIsBounded) {
  std::vector<Rung> rungs;
  for (uint32_t i = 1; i <= 50; ++i) {
    rungs.push_back(lamp());
    rungs.back().number = i;
    rungs.back().runs = 0;
  }
  EXPECT_THAT(toText(reportOf(rungs), {.missing = 10}), HasSubstr("  … 40 more lines: --coverage-all\n"));
  EXPECT_THAT(toText(reportOf(rungs), {.missing = 0}), HasSubstr("rung 50 "));
}

} // namespace
} // namespace rung::report
