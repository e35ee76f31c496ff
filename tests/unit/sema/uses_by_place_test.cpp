#include <gtest/gtest.h>
#include <string>

#include "frontend/sema/analysis.h"

namespace rung::frontend {
namespace {

struct Use {
  SourceRange range;
  char name = ' ';
};

Use use(char name, uint32_t begin, uint32_t end) { return {{{begin}, {end}}, name}; }

UsesByPlace<Use> settled(std::initializer_list<Use> uses, bool once = false) {
  UsesByPlace<Use> result;
  for (const Use& one : uses) result.add(one);
  result.settle(once);
  return result;
}

// The name of what each position from 1 on belongs to; '.' of nothing.
std::string namesOf(const UsesByPlace<Use>& uses, uint32_t end) {
  std::string names;
  for (uint32_t at = 1; at < end; ++at) {
    const Use* found = uses.at(SourcePos{at});
    names += found == nullptr ? '.' : found->name;
  }
  return names;
}

TEST(UsesByPlace, FindsWhatHoldsAPosition) {
  EXPECT_EQ(namesOf(settled({}), 4), "...");
  EXPECT_EQ(namesOf(settled({use('b', 6, 8), use('a', 2, 5)}), 10), ".aaa.bb..") << "in any order; the end is outside";
  EXPECT_EQ(namesOf(settled({use('a', 1, 3), use('b', 3, 5)}), 6), "aabb.");
}

TEST(UsesByPlace, TheInnermostCounts) {
  EXPECT_EQ(namesOf(settled({use('o', 1, 12), use('i', 3, 5), use('j', 6, 10), use('k', 7, 8)}), 14), "ooiiojkjjoo..");
  EXPECT_EQ(namesOf(settled({use('o', 1, 6), use('i', 1, 3)}), 7), "iiooo.") << "both begin there";
  EXPECT_EQ(namesOf(settled({use('o', 1, 9), use('i', 2, 3), use('b', 11, 12)}), 13), "oioooooo..b.");
}

TEST(UsesByPlace, OfOneRangeTheFirst) {
  const auto uses = {use('a', 2, 4), use('b', 2, 4)};
  EXPECT_EQ(namesOf(settled(uses), 5), ".aa.");
  EXPECT_EQ(settled(uses).all().size(), 2u);
  EXPECT_EQ(settled(uses, true).all().size(), 1u);
  EXPECT_EQ(settled(uses, true).all()[0].name, 'a');
}

TEST(UsesByPlace, FindsARangeExactly) {
  const UsesByPlace<Use> uses = settled({use('a', 2, 6), use('b', 8, 9)});
  ASSERT_NE(uses.at(SourceRange{{2}, {6}}), nullptr);
  EXPECT_EQ(uses.at(SourceRange{{2}, {6}})->name, 'a');
  EXPECT_EQ(uses.at(SourceRange{{2}, {5}}), nullptr);
  EXPECT_EQ(uses.at(SourceRange{{3}, {6}}), nullptr);
}

} // namespace
} // namespace rung::frontend
