// A rung has one number and one title: those of the drawing are those of the module, and so of profiles and faults.
#include <algorithm>
#include <filesystem>

#include <gtest/gtest.h>

#include "tests/unit/view/drawn.h"

namespace rung::view::test {
namespace {

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
