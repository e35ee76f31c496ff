// Size: many rungs, long lines, many branches; tests/growth counts what they cost.
#include <gtest/gtest.h>

#include "ladder_testing.h"

namespace rung::frontend::ladder {
namespace {

TEST(Scale, HundredThousandRungs) {
  std::string text = "dialect t\nmodule M\n";
  for (int i = 0; i < 100'000; ++i) text += "rung \"r\"\n|--[A]--+--[/B]--(X)\n|--[C]--+\n\n";
  const Parsed parsed(std::move(text));
  EXPECT_EQ(parsed.errors(), "");
  EXPECT_EQ(parsed.ladder.rungs.size(), 100'000u);
  EXPECT_EQ(parsed.ladder.rungs.back().elements.size(), 4u);
}

TEST(Scale, LineOfTenMegabytes) {
  std::string drawing = "|--";
  while (drawing.size() < 10'000'000) drawing += "[A]--";
  drawing += "(X)\n";
  const Parsed parsed = parseDrawing(drawing);
  EXPECT_EQ(parsed.errors(), "");
  EXPECT_GT(parsed.ladder.rungs.at(0).elements.size(), 1'900'000u);
}

TEST(Scale, ManyOneWordBoxesBelowEachOther) {
  std::string line = "|--[A]";
  for (int i = 0; i < 20'000; ++i) line += "--{XX }";
  const std::string shifted = "|---[A]" + line.substr(6);
  const Parsed parsed = parseDrawing(line + "\n" + shifted + "\n");
  EXPECT_GT(parsed.diags.errorCount(), 0u);
}

TEST(Scale, NestedBranches) {
  // A staircase: branch i begins in column of the i-th '+' and every one ends in a coil.
  constexpr size_t kDepth = 1'500;
  std::string drawing = "|--[A]";
  for (size_t i = 0; i < kDepth; ++i) drawing += "-+-[B]";
  drawing += "-(X)\n";
  for (size_t i = kDepth; i-- > 0;) {
    std::string line(7 + 6 * i, ' ');
    for (size_t j = 0; j < i; ++j) line[7 + 6 * j] = '|';
    drawing += line + "+-[C]-(Y)\n";
  }
  const Parsed parsed = parseDrawing(drawing);
  EXPECT_EQ(parsed.errors(), "");
  EXPECT_EQ(parsed.ladder.rungs.at(0).elements.size(), 2u + kDepth + 2u * kDepth);
}

TEST(Scale, ErrorInEveryLine) {
  std::string text = "dialect t\nmodule M\n";
  for (int i = 0; i < 200'000; ++i) text += "rung\n|--[A\n";
  const Parsed parsed(std::move(text));
  EXPECT_EQ(parsed.diags.errorCount(), 200'000u);
}

TEST(Scale, RubbishOfManyKinds) {
  for (const char c : std::string("|+-[](){}\";@/% A\n\x7F")) {
    const Parsed lines(std::string("dialect t\nmodule M\nrung\n") + std::string(100'000, c));
    std::string spread = "dialect t\nmodule M\nrung\n";
    for (int i = 0; i < 50'000; ++i) spread += std::string(1, c) + "\n";
    const Parsed columns(std::move(spread));
    EXPECT_GT(lines.diags.errorCount() + columns.diags.errorCount(), 0u);
  }
}

} // namespace
} // namespace rung::frontend::ladder
