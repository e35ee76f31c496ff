// The program files of the examples, damaged: each is refused with a reason, and none takes the host with it.
// RUNG_MUTATIONS=N tries N of each file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <random>

#include "ir/support/temporary_folder.h"
#include "rtlib/load/seal.h"
#include "rtlib/load/so_engine.h"
#include "tests/fuzz/mutations.h"

namespace {

using namespace rung::runtime;
namespace fs = std::filesystem;

// What disks, links and copies do to a file.
class Damage {
public:
  explicit Damage(std::string file) : file_(std::move(file)) {}

  std::string next() {
    std::string damaged = file_;
    while (damaged == file_)
      for (size_t edits = 1 + below(3); edits > 0; --edits) edit(damaged);
    return damaged;
  }

private:
  size_t below(size_t n) { return n == 0 ? 0 : random_() % n; }

  void edit(std::string& bytes) {
    const size_t at = below(below(3) == 0 ? std::min<size_t>(bytes.size(), 4096) : bytes.size()); // tables come first
    const size_t length = std::min(1 + below(below(2) == 0 ? 16 : 8192), bytes.size() - at);
    switch (below(8)) {
    case 0: bytes.resize(at); return;
    case 1: bytes.erase(at, length); return;
    case 2: bytes.insert(at, length, static_cast<char>(below(256))); return;
    case 3: bytes.replace(at, length, length, '\0'); return;
    case 4: bytes.replace(at, length, bytes.substr(below(bytes.size()), length)); return;
    case 5: bytes += bytes.substr(at, length); return;
    default:
      if (!bytes.empty()) bytes[at] = static_cast<char>(bytes[at] ^ 1 << below(8));
    }
  }

  std::string file_;
  std::mt19937_64 random_{20260101};
};

class ProgramFile : public testing::TestWithParam<const char*> {};

TEST_P(ProgramFile, DamageIsRefusedWithAReason) {
  const rung::TemporaryFolder folder;
  const std::string path = (folder / "program.so").string();
  const std::string build = std::string(RUNG_TEST_RUNGC) + " build -q -g " + GetParam() + " -o " + path;
  ASSERT_EQ(std::system(build.c_str()), 0) << build;
  std::string error;
  ASSERT_NE(SoEngine::open(path, error), nullptr) << error;
  Damage damage(folder.contentsOf("program.so").value());
  for (long i = 0; i < rung::fuzz::mutationsOfEach(300); ++i) {
    ASSERT_EQ(replaceFile(path, damage.next(), {.mode = kProgramMode}), "");
    ASSERT_EQ(SoEngine::open(path, error), nullptr) << "mutation " << i;
    ASSERT_THAT(error, testing::MatchesRegex("cannot load .*: its? .+")) << "mutation " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Examples, ProgramFile,
                         testing::Values("examples/fanuc-vmc", "examples/first-cnc", "examples/gsk-mill",
                                         "examples/gsk-panel", "examples/nct-lathe", "examples/nct-turning-centre",
                                         "examples/technol-machining-centre", "examples/technol-magazine",
                                         "examples/technol-mill"),
                         [](const auto& tested) {
                           std::string name = fs::path(tested.param).filename();
                           std::erase(name, '-');
                           return name;
                         });

// No example is forgotten.
TEST(ProgramFiles, AreThoseOfAllExamples) {
  int folders = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator("examples"))
    folders += entry.is_directory() && fs::exists(entry.path() / "rung.toml") ? 1 : 0;
  EXPECT_EQ(folders, 9);
}

} // namespace
