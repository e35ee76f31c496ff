// Damaged files of recordings: what is whole is shown, and right; the rest is named. Seeded, thousands of each kind.
#include <algorithm>
#include <bit>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <random>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "ir/support/temporary_folder.h"
#include "tools/replay/growing_recording.h"
#include "tools/replay/past.h"
#include "tools/replay/record_run.h"
#include "tools/scenario/in_project.h"

namespace rung::replay {
namespace {

namespace fs = std::filesystem;
using Files = std::map<std::string, std::string>; // by name: contents

std::string contentsOf(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// Clock and memory after a part: no two parts have the same.
uint64_t momentOf(const runtime::Instance& instance) {
  uint64_t hash = static_cast<uint64_t>(instance.nowUs());
  const rung_program& program = instance.program();
  for (const rung_written& of : std::span(program.writes, program.write_count))
    for (uint32_t i = 0; i < of.size; ++i) hash = hash * 1099511628211u ^ (instance.block()[of.offset + i] & of.mask);
  return hash;
}

class DamagedFiles : public testing::Test {
protected:
  static constexpr int kTimes = 1000;
  static constexpr int kPlayedEvery = 40; // the others are only read

  DamagedFiles() {
    const std::string panel = "examples/gsk-panel/panel.scn";
    scenario::Scenario scenario = scenario::parse(panel, contentsOf(panel) + "\nscan 4000\n");
    scenario::takeProject(scenario);
    scenario::RunOptions options{.engines = {compiler::EngineKind::Interp}};
    recordInto(folder_ / "made", options);
    EXPECT_TRUE(scenario::run(scenario, options).passed);
    for (const auto& entry : fs::directory_iterator(folder_ / "made"))
      (entry.path().extension() == ".rec" ? file_ : program_) =
          entry.path().filename() == "lock" ? program_ : contentsOf(entry.path());
    std::memcpy(&head_, file_.data(), sizeof head_);
    for (size_t at = sizeof head_; at < file_.size();) {
      runtime::BlockHead block;
      std::memcpy(&block, file_.data() + at, sizeof block);
      blocks_.push_back(file_.substr(at, sizeof block + block.size));
      at += blocks_.back().size();
    }
    EXPECT_GT(blocks_.size(), 8u);
    const Recording whole = readRecording(folder_ / "made").value();
    parts_ = played(whole);
    EXPECT_GT(parts_.size(), 4000u);
    known_ = whole.programs[0];
  }

  std::vector<uint64_t> played(const Recording& recording) {
    std::vector<uint64_t> moments;
    Result<std::unique_ptr<Past>> past = Past::open(recording, {.engine = compiler::EngineKind::Interp});
    if (!past.ok()) return moments;
    while (past.value()->next()) moments.push_back(momentOf(past.value()->instance()));
    (void)past.value()->goTo(past.value()->contents().parts);
    (void)past.value()->flow();
    return moments;
  }

  void check(const Files& files, bool isNamed = true) {
    fs::remove_all(folder_ / "read");
    fs::create_directory(folder_ / "read");
    for (const auto& [name, bytes] : files) std::ofstream(folder_ / "read" / name, std::ios::binary) << bytes;
    const Result<Recording> read = readRecording(folder_ / "read", {known_});
    if (read.ok())
      checkRead(read.value(), isNamed);
    else
      EXPECT_NE(read.error(), "");
  }
  void checkRead(const Recording& recording, bool isNamed) {
    const Contents contents(recording);
    EXPECT_LE(contents.parts, parts_.size());
    const bool named = !recording.problems.empty() || std::ranges::any_of(contents.landmarks, [](const Landmark& l) {
      return l.kind == Landmark::Kind::Damaged || l.kind == Landmark::Kind::Lost;
    });
    if (contents.parts < parts_.size() && isNamed) EXPECT_TRUE(named) << contents.parts;
    if (++checked_ % kPlayedEvery != 0) return;
    auto next = parts_.begin(); // what is shown is what was, in its order
    for (const uint64_t moment : played(recording)) {
      next = std::find(next, parts_.end(), moment);
      if (next == parts_.end()) {
        ADD_FAILURE() << "a part is shown that was not recorded";
        return;
      }
      ++next;
    }
  }

  // A file of these blocks.
  std::string fileOf(std::span<const std::string> blocks, uint64_t number) const {
    runtime::SegmentHead head = head_;
    head.number = number;
    head.checksum = head.sum();
    std::string file(reinterpret_cast<const char*>(&head), sizeof head);
    for (const std::string& block : blocks) file += block;
    return file;
  }
  // The recording in files that each begin with a state.
  std::vector<std::string> segments() const {
    std::vector<std::string> files;
    size_t from = 0;
    for (size_t i = 1; i <= blocks_.size(); ++i) {
      runtime::BlockHead block;
      if (i < blocks_.size()) std::memcpy(&block, blocks_[i].data(), sizeof block);
      if (i < blocks_.size() && block.kind != runtime::BlockKind::State) continue;
      files.push_back(fileOf(std::span(blocks_).subspan(from, i - from), files.size() + 1));
      from = i;
    }
    return files;
  }
  static std::string nameOf(size_t number) { return fmt::format("{:08}.rec", number); }

  const TemporaryFolder folder_;
  std::string file_, program_;
  runtime::SegmentHead head_;
  std::vector<std::string> blocks_;
  std::vector<uint64_t> parts_;
  std::shared_ptr<const compiler::Compiled> known_;
  std::mt19937 random_{29};
  int checked_ = 0;
};

TEST_F(DamagedFiles, WholeOnesHaveAllParts) {
  checked_ = kPlayedEvery - 1;
  check({{nameOf(1), file_}});
  Files several;
  for (const std::string& segment : segments()) several[nameOf(several.size() + 1)] = segment;
  ASSERT_GT(several.size(), 2u);
  checked_ = kPlayedEvery - 1;
  check(several);
  const Result<Recording> read = readRecording(folder_ / "read");
  ASSERT_FALSE(read.ok()); // the program is not among them
}

TEST_F(DamagedFiles, CutOffAtAnyPlace) {
  std::vector<size_t> cuts;
  size_t at = sizeof head_;
  for (const std::string& block : blocks_) {
    for (size_t cut = at - 3; cut <= at + 3; ++cut) cuts.push_back(cut);
    at += block.size();
  }
  while (cuts.size() < kTimes) cuts.push_back(random_() % file_.size());
  size_t boundary = sizeof head_;
  std::vector<size_t> boundaries;
  for (const std::string& block : blocks_) boundaries.push_back(boundary), boundary += block.size();
  for (const size_t cut : cuts) // after a whole block it may have ended there
    check({{nameOf(1), file_.substr(0, cut)}}, std::ranges::find(boundaries, cut) == boundaries.end());
}

TEST_F(DamagedFiles, ChangedBytes) {
  for (int i = 0; i < kTimes; ++i) {
    std::string file = file_;
    for (uint32_t flips = 1 + random_() % 4; flips > 0; --flips)
      file[random_() % file.size()] ^= static_cast<char>(1 + random_() % 255);
    check({{nameOf(1), file}});
  }
}

TEST_F(DamagedFiles, BytesThatAreMissingOrTooMany) {
  for (int i = 0; i < kTimes; ++i) {
    std::string file = file_;
    const size_t at = random_() % file.size(), count = 1 + random_() % 3000;
    if (i % 2 == 0) {
      file.erase(at, count);
    } else {
      std::string junk(count, '\0');
      std::ranges::generate(junk, [&] { return static_cast<char>(random_()); });
      file.insert(at, junk);
    }
    check({{nameOf(1), file}}, false); // the end may be missing as if it had ended there
  }
}

TEST_F(DamagedFiles, BlocksInAnotherOrder) {
  for (int i = 0; i < kTimes; ++i) {
    std::vector<std::string> blocks = blocks_;
    std::swap(blocks[random_() % blocks.size()], blocks[random_() % blocks.size()]);
    if (i % 3 == 0) blocks.erase(blocks.begin() + static_cast<ptrdiff_t>(random_() % blocks.size()));
    std::ofstream(folder_ / "blocks.rec", std::ios::binary) << fileOf(blocks, 1);
    const Result<Recording> read = readRecording(folder_ / "blocks.rec");
    EXPECT_FALSE(read.ok() && read.value().programs.empty());
  }
}

TEST_F(DamagedFiles, SegmentsRenamedCopiedAndMissing) {
  const std::vector<std::string> all = segments();
  for (int i = 0; i < kTimes; ++i) {
    Files files;
    std::vector<size_t> numbers(all.size());
    for (size_t k = 0; k < all.size(); ++k) numbers[k] = k + 1;
    if (i % 2 == 0) std::ranges::shuffle(numbers, random_);
    for (size_t k = 0; k < all.size(); ++k) files[nameOf(numbers[k])] = all[k];
    if (i % 3 == 0) files.erase(nameOf(1 + random_() % all.size()));
    if (i % 5 == 0) files[nameOf(50)] = all[random_() % all.size()]; // a copy
    check(files, false); // of the first and the last ones nothing says that they are missing
  }
}

// A segment in the middle that is missing is named.
TEST_F(DamagedFiles, AMissingSegmentIsNamed) {
  const std::vector<std::string> all = segments();
  for (size_t gone = 1; gone + 1 < all.size(); ++gone) {
    Files files;
    for (size_t k = 0; k < all.size(); ++k)
      if (k != gone) files[nameOf(k + 1)] = all[k];
    checked_ = kPlayedEvery - 1;
    check(files);
  }
}

TEST_F(DamagedFiles, ForeignFilesInTheFolder) {
  runtime::SegmentHead foreign = head_;
  foreign.program ^= 1; // another program, which the folder does not have
  foreign.number = 3;
  foreign.checksum = foreign.sum();
  const std::string bytes(reinterpret_cast<const char*>(&foreign), sizeof foreign);
  for (int i = 0; i < 100; ++i) {
    Files files{{nameOf(1), file_}};
    if (i % 2 == 0) files[nameOf(3)] = bytes + file_.substr(sizeof foreign);
    if (i % 3 == 0) files[nameOf(2)] = file_.substr(random_() % file_.size(), random_() % 200);
    if (i % 5 == 0) files[nameOf(7)] = "";
    if (i % 7 == 0) files["notes.txt"] = "something else";
    if (i % 7 == 1) files["123.rec"] = files["rec"] = ".rec";
    if (i % 11 == 0) files[runtime::programName(head_.program ^ 1)] = program_.substr(0, random_() % program_.size());
    checked_ = i % 20 == 0 ? kPlayedEvery - 1 : 0;
    check(files);
  }
  fs::create_directories(folder_ / "read" / nameOf(9));
  (void)readRecording(folder_ / "read");
}

} // namespace
} // namespace rung::replay
