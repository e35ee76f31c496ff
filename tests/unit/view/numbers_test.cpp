// A rung has one number and one title: those of the drawing are those of the module, and so of profiles and faults.
#include <algorithm>
#include <filesystem>

#include <gtest/gtest.h>

#include "tests/unit/view/drawn.h"

namespace rung::view::test {
namespace {

void expectSameNumbers(const Drawn& drawn) {
  size_t compared = 0;
  for (const ir::Routine& routine : drawn.module->routines) {
    for (const ir::Rung& rung : routine.rungs) {
      if (rung.number == 0) continue;
      ASSERT_LE(rung.number, drawn.program.figures.size());
      const Figure& figure = drawn.program.figures[rung.number - 1];
      EXPECT_EQ(figure.number, rung.number);
      EXPECT_EQ(figure.title, rung.title) << "rung " << rung.number;
      EXPECT_EQ(figure.place.line, rung.begin.line) << "rung " << rung.number;
      EXPECT_EQ(drawn.module->files[rung.begin.file.index], drawn.program.files[figure.place.file].path)
          << "rung " << rung.number;
      ++compared;
    }
  }
  EXPECT_GE(compared, drawn.program.figures.size() * 9 / 10); // all that is run, and most of a machine's program is
}

std::vector<std::string> filesIn(const std::filesystem::path& folder, std::string_view extension) {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == extension) files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

class RungNumbers : public testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(RungNumbers, OfTheDrawingAreThoseOfTheModule) {
  const auto& [folder, extension] = GetParam();
  const auto drawn = drawFiles(filesIn(folder, extension));
  ASSERT_NE(drawn, nullptr);
  expectSameNumbers(*drawn);
}

INSTANTIATE_TEST_SUITE_P(Examples, RungNumbers,
                         testing::Values(std::pair("examples/gsk-mill", ".pmc"),
                                         std::pair("examples/gsk-panel", ".lad"),
                                         std::pair("examples/nct-lathe", ".lad"),
                                         std::pair("examples/nct-turning-centre", ".lad")));

} // namespace
} // namespace rung::view::test
