// A profile against an older one: rungs are found again, and what changed is in one list at most.
#include "tools/report/profile_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

using namespace rung::report;
using testing::HasSubstr;

Row row(uint32_t number, uint64_t key, std::string title, uint64_t operations, double meanNs) {
  Row made;
  made.rung = number;
  made.number = number;
  made.key = key;
  made.routine = "MAIN";
  made.title = std::move(title);
  made.file = "main.lad";
  made.line = number * 10;
  made.executions = 100;
  made.scans = 100;
  made.operations = operations;
  made.meanNs = meanNs;
  made.time = meanNs * 100;
  return made;
}

Profile profileOf(std::vector<Row> rows) {
  Profile profile;
  profile.report.program = "main";
  profile.scenarios = {"a.scn"};
  profile.scans = 100;
  profile.deadlines = {{"whole scan", 10'000, {100, 1, 1, 1, 1, 1}}};
  for (const Row& r : rows) {
    profile.report.operations += r.operations;
    profile.report.time += r.time;
  }
  profile.report.rows = std::move(rows);
  return profile;
}

Baseline readBack(const Profile& profile) {
  rung::Result<Baseline> read = readBaseline(profileJson(profile, nullptr));
  EXPECT_TRUE(read.ok()) << read.error();
  return read.ok() ? std::move(read).value() : Baseline{};
}

std::vector<uint32_t> numbers(const std::vector<Change>& changes) {
  std::vector<uint32_t> found;
  for (const Change& change : changes) found.push_back(change.row.number);
  return found;
}

using Numbers = std::vector<uint32_t>;

TEST(ProfileBaseline, TheSameProfileHasNoDifference) {
  const Profile profile = profileOf({row(1, 11, "a", 500, 10), row(2, 12, "", 300, 20)});
  const Comparison same = compare(profile.report, readBack(profile));
  for (const auto* list : {&same.more, &same.fewer, &same.slower, &same.faster, &same.added, &same.gone})
    EXPECT_TRUE(list->empty());
  EXPECT_EQ(same.old.scans, 100u);
  EXPECT_EQ(same.old.operations, 800u);
}

TEST(ProfileBaseline, ARungIsFoundByItsKeyThenByItsTitle) {
  const Profile old = profileOf({row(1, 11, "moved", 500, 10), row(2, 12, "changed", 300, 20), row(3, 13, "", 200, 5),
                                 row(4, 14, "renamed to nothing", 100, 5)});
  const Profile now = profileOf({row(1, 21, "new", 50, 10), row(2, 11, "moved", 500, 10),
                                 row(3, 22, "changed", 400, 20), row(4, 23, "", 200, 5)});
  const Comparison found = compare(now.report, readBack(old));
  EXPECT_EQ(numbers(found.more), (Numbers{3}));
  EXPECT_EQ(found.more[0].oldOperations, 300u);
  EXPECT_TRUE(found.fewer.empty());
  EXPECT_EQ(numbers(found.added), (Numbers{4, 1})) << "a rung without a title whose text changed is another rung";
  EXPECT_EQ(numbers(found.gone), (Numbers{3, 4}));
}

TEST(ProfileBaseline, RungsOfOneTextKeepTheirOrder) {
  const Profile old = profileOf({row(1, 11, "", 500, 10), row(2, 11, "", 300, 10)});
  const Profile now = profileOf({row(1, 11, "", 500, 10), row(2, 11, "", 310, 10)});
  const Comparison found = compare(now.report, readBack(old));
  EXPECT_EQ(numbers(found.more), (Numbers{2}));
  EXPECT_EQ(found.more[0].oldOperations, 300u);
}

TEST(ProfileBaseline, ARungThatRanNoMoreHasFewerOperations) {
  const Profile old = profileOf({row(1, 11, "", 500, 10), row(2, 12, "", 300, 10)});
  Profile now = profileOf({row(1, 11, "", 500, 10)});
  now.report.never = {row(2, 12, "", 0, 0)};
  EXPECT_EQ(numbers(compare(now.report, readBack(old)).fewer), (Numbers{2}));
}

TEST(ProfileBaseline, OnlyAClearDifferenceOfTimeCounts) {
  const Profile old =
      profileOf({row(1, 11, "", 5, 1000), row(2, 12, "", 5, 100), row(3, 13, "", 5, 1), row(4, 14, "", 5, 100)});
  const Profile now =
      profileOf({row(1, 11, "", 5, 1100), row(2, 12, "", 5, 200), row(3, 13, "", 5, 9), row(4, 14, "", 5, 50)});
  const Comparison found = compare(now.report, readBack(old));
  EXPECT_EQ(numbers(found.slower), (Numbers{2})) << "1 is 10 % slower, 3 is of no weight";
  EXPECT_EQ(numbers(found.faster), (Numbers{4}));
}

TEST(ProfileBaseline, TextNamesWhatChanged) {
  const Profile old = profileOf({row(1, 11, "lamp", 500, 10)});
  Profile now = profileOf({row(1, 11, "lamp", 750, 10)});
  now.scenarios = {"b.scn"};
  const std::string text = comparisonText(now, compare(now.report, readBack(old)), 0);
  EXPECT_THAT(text, HasSubstr("it is of other scenarios (a.scn; 100 scans)"));
  EXPECT_THAT(text, HasSubstr("operations 500 -> 750 (+50.0%)"));
  EXPECT_THAT(text, HasSubstr("more operations:\n  500 -> 750 (+50.0%): "));
  EXPECT_THAT(text, HasSubstr(": rung 1 \"lamp\", main.lad:10\n"));
}

TEST(ProfileBaseline, SaysWhatIsWrongWithTheFile) {
  EXPECT_THAT(readBaseline("rungs").error(), HasSubstr("not JSON"));
  EXPECT_THAT(readBaseline("[1]").error(), HasSubstr("not a profile"));
  EXPECT_THAT(readBaseline(R"({"profile": 2})").error(), HasSubstr("not a profile"));
  EXPECT_THAT(readBaseline(R"({"profile": 1, "program": 3})").error(), HasSubstr("missing or has another type"));
}

} // namespace
