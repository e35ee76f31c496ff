// Inputs, comparison, and what is left over (see golden.h).
#include "tests/support/golden.h"

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <gtest/gtest.h>
#include <iostream>
#include <iterator>
#include <string_view>

namespace rung::test {

namespace fs = std::filesystem;

namespace {

bool updating() {
  const char* wanted = std::getenv("RUNG_UPDATE");
  return wanted != nullptr && std::string_view(wanted) == "1";
}

std::vector<fs::path> filesIn(const fs::path& folder) {
  std::error_code missing;
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, missing)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

} // namespace

Golden::Golden(fs::path folder, const std::vector<std::string>& extensions) : folder_(std::move(folder)) {
  for (const fs::path& file : filesIn(folder_))
    if (std::find(extensions.begin(), extensions.end(), file.extension()) != extensions.end()) inputs_.push_back(file);
  known_.insert(inputs_.begin(), inputs_.end());
  EXPECT_FALSE(inputs_.empty()) << folder_ << " has no inputs; run in the root of the repository";
}

Golden::~Golden() {
  // A test that ended early has failed, and has not said what its other inputs become.
  if (std::uncaught_exceptions() != 0 || testing::Test::HasFatalFailure()) return;
  for (const fs::path& file : filesIn(folder_)) {
    if (known_.contains(file)) continue;
    if (updating() && fs::is_regular_file(file) && fs::remove(file))
      std::cout << "removed " << file.string() << ", which no input becomes\n";
    else
      ADD_FAILURE() << file << " is not what any input becomes; remove it";
  }
}

std::string Golden::read(const fs::path& file) const {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void Golden::expect(const std::string& name, std::string_view text) {
  const fs::path file = folder_ / name;
  known_.insert(file);
  if (updating()) std::ofstream(file, std::ios::binary) << text;
  EXPECT_TRUE(fs::exists(file)) << file << " is missing; RUNG_UPDATE=1 writes it";
  EXPECT_EQ(read(file), text) << file;
}

void Golden::expect(const fs::path& input, std::string_view extension, std::string_view text) {
  expect(fs::path(input.filename()).replace_extension(extension).string(), text);
}

} // namespace rung::test
