// Sequences side by side.
#include "rtlib/change/rung_alignment.h"

#include <gmock/gmock.h>

namespace rung::runtime {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::Pair;

std::vector<std::pair<uint32_t, uint32_t>> aligned(std::string_view before, std::string_view after) {
  const std::vector<uint64_t> a(before.begin(), before.end()), b(after.begin(), after.end());
  return align(a, b);
}

TEST(Alignment, PairsWhatBeginsAndEndsBoth) {
  EXPECT_THAT(aligned("", ""), IsEmpty());
  EXPECT_THAT(aligned("ab", "cd"), IsEmpty());
  EXPECT_THAT(aligned("abc", "abc"), ElementsAre(Pair(0, 0), Pair(1, 1), Pair(2, 2)));
  EXPECT_THAT(aligned("ac", "abc"), ElementsAre(Pair(0, 0), Pair(1, 2)));
  EXPECT_THAT(aligned("aa", "aaa"), ElementsAre(Pair(0, 0), Pair(1, 1)));
}

TEST(Alignment, PairsWhatIsOnceOnEachSide) {
  EXPECT_THAT(aligned("xuy", "vuw"), ElementsAre(Pair(1, 1)));
  EXPECT_THAT(aligned("xuvy", "zvuw"), testing::SizeIs(1)) << "one of them has moved";
}

// The sections before, between and after such pairs are aligned separately, each from its beginning.
TEST(Alignment, DividesAtPairs) {
  EXPECT_THAT(aligned("xuddvy", "zudddvw"), ElementsAre(Pair(1, 1), Pair(2, 2), Pair(3, 3), Pair(4, 5)));
  EXPECT_THAT(aligned("ddxuy", "dddzuw"), ElementsAre(Pair(0, 0), Pair(1, 1), Pair(3, 4)));
  EXPECT_THAT(aligned("xuddy", "zudddw"), ElementsAre(Pair(1, 1), Pair(2, 2), Pair(3, 3)));
}

} // namespace
} // namespace rung::runtime
