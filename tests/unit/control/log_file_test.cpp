// The log on disk: what a crash, a disk that cannot be written, or somebody else's file does to it.
#include "machine/control/log_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "ir/support/temporary_folder.h"
#include "tests/support/patience.h"

namespace rung::control {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr int64_t kBegin = 1'700'000'000;
constexpr uint64_t kMost = uint64_t{4} << 20;
const LogEntries::Key kDoor{3, 0, 0};

struct LogFileTest : ::testing::Test {
  TemporaryFolder folder;
  const std::string path = (folder / "kept.log").string();
  LogEntries log;
  std::unique_ptr<LogFile> file;
  int64_t now = kBegin;
  uint64_t most = kMost;
  std::vector<std::string> said;

  void open() { file = std::make_unique<LogFile>(log, path, most); }
  void tick() {
    if (const std::string text = file->tick(now); !text.empty()) said.push_back(text);
  }
  std::string contents() const {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  // Until its thread has written what the text says.
  bool writes(const std::string& text) {
    return test::soon([&] { return tick(), contents().find(text) != std::string::npos; });
  }
  bool says(const std::string& text) {
    return test::soon([&] { return tick(), !said.empty() && said.back().find(text) != std::string::npos; });
  }
  static std::vector<std::string> textsOf(const std::string& path) {
    LogEntries read;
    const LogFile other(read, path, kMost);
    std::vector<std::string> texts;
    for (const LogEntry& entry : read.entries()) texts.push_back(entry.text + (entry.cut ? "!" : ""));
    return texts;
  }
};

TEST_F(LogFileTest, WhatHasComeIsThereAfterACrash) {
  open();
  log.come(kDoor, "DOOR", now, false);
  EXPECT_TRUE(writes("\"DOOR\""));
  log.happen({.text = "fault"}, now + 1);
  EXPECT_TRUE(writes("\"fault\""));
  fs::copy_file(path, path + ".crash"); // as it is when the process is killed now
  log.go(kDoor, now + 2);
  file.reset(); // a regular end
  EXPECT_THAT(textsOf(path + ".crash"), ElementsAre("DOOR!", "fault"));
  EXPECT_THAT(textsOf(path), ElementsAre("DOOR", "fault"));
  EXPECT_THAT(said, IsEmpty());
}

TEST_F(LogFileTest, ANewHostContinues) {
  open();
  log.happen({.text = "one"}, now);
  file.reset();
  log = LogEntries();
  open();
  log.happen({.text = "two"}, now + 1);
  file.reset();
  EXPECT_THAT(textsOf(path), ElementsAre("one", "two"));
}

TEST_F(LogFileTest, ALineThatIsTornIsLeftOut) {
  open();
  log.happen({.text = "one"}, now);
  log.happen({.text = "two"}, now);
  file.reset();
  fs::resize_file(path, fs::file_size(path) - 4);
  log = LogEntries();
  open();
  log.happen({.text = "three"}, now + 1);
  EXPECT_TRUE(writes("\"three\""));
  file.reset();
  EXPECT_THAT(textsOf(path), ElementsAre("one", "three"));
  EXPECT_THAT(said, IsEmpty()) << "a crash is not a mistake of anybody";
}

// As a full disk: there is no place for it.
TEST_F(LogFileTest, WhatCannotBeWrittenIsSaidOnceAndComesLater) {
  fs::create_directory(path);
  open();
  EXPECT_TRUE(says("the log is not kept on disk: cannot read " + path)) << "at once";
  log.happen({.text = "one"}, now);
  now += LogFile::kRetryS;
  EXPECT_TRUE(says("the log is not kept on disk: cannot write " + path));
  const size_t reports = said.size();
  for (int i = 0; i < 20; ++i) {
    now += LogFile::kRetryS;
    tick();
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  EXPECT_EQ(said.size(), reports) << "it says so once";
  fs::remove(path);
  now += LogFile::kRetryS;
  EXPECT_TRUE(says("the log is kept on disk again"));
  EXPECT_TRUE(writes("\"one\""));
}

TEST_F(LogFileTest, LinesOfAnotherKindStayAndAreSaid) {
  std::ofstream(path) << "no log\n";
  open();
  log.happen({.text = "one"}, now);
  EXPECT_TRUE(says("has lines that do not belong to a log: 1"));
  EXPECT_TRUE(writes("\"one\""));
  file.reset();
  EXPECT_THAT(contents(), HasSubstr("no log\n"));
  const LogInFiles read = readLog(path);
  EXPECT_EQ(read.wrongLines, 1u);
  ASSERT_EQ(read.entries.size(), 1u);
  EXPECT_EQ(read.entries[0].text, "one");
}

// As by somebody who needs the room.
TEST_F(LogFileTest, AFileThatIsRemovedBeginsAgain) {
  open();
  log.happen({.text = "one"}, now);
  EXPECT_TRUE(writes("\"one\""));
  fs::remove(path);
  log.happen({.text = "two"}, now);
  EXPECT_TRUE(writes("\"two\""));
  EXPECT_THAT(said, IsEmpty());
}

TEST_F(LogFileTest, ALinkIsNotFollowed) {
  std::ofstream((folder / "others")) << "kept\n";
  fs::create_symlink((folder / "others"), path);
  open();
  log.happen({.text = "one"}, now);
  EXPECT_TRUE(says("it is a symbolic link"));
  file.reset();
  std::ifstream others((folder / "others"));
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(others), {}), "kept\n");
}

TEST_F(LogFileTest, ItsSizeIsBoundedAndWhatIsOnStaysInIt) {
  most = 200'000;
  open();
  log.come(kDoor, "DOOR", now, false);
  uint64_t largest = 0;
  const std::string text(1000, 'x');
  for (int i = 0; i < 2000; ++i, now += i % 10 == 0 ? 1 : 0) {
    log.happen({.text = text + std::to_string(i)}, now);
    tick();
    std::error_code none;
    for (const std::string& name : {path, olderLog(path)})
      if (const auto size = fs::file_size(name, none); !none) largest = std::max<uint64_t>(largest, size);
    std::this_thread::sleep_for(std::chrono::microseconds(300));
  }
  file.reset();
  EXPECT_LE(largest, most / 2 + 60'000) << "a file and the lines of a second";
  EXPECT_THAT(contents(), HasSubstr("\"DOOR\""));
  const LogInFiles read = readLog(path);
  EXPECT_EQ(read.wrongLines, 0u);
  EXPECT_EQ(read.entries.back().text, text + "1999");
  EXPECT_GT(read.entries.size(), 80u);
}

TEST_F(LogFileTest, ACrashWhileTheFileTurnsOver) {
  open();
  log.happen({.text = "one"}, now);
  file.reset();
  fs::rename(path, olderLog(path)); // and the new one is not there yet
  log = LogEntries();
  open();
  log.happen({.text = "two"}, now);
  file.reset();
  EXPECT_THAT(textsOf(path), ElementsAre("one", "two"));
}

TEST_F(LogFileTest, EveryPlaceOfACrashLeavesTheEntriesBefore) {
  open();
  for (int i = 0; i < 5; ++i) log.happen({.kind = LogKind::Set, .text = "set \xc5\x99 " + std::to_string(i)}, now);
  file.reset();
  const std::string whole = contents();
  for (size_t size = 0; size <= whole.size(); ++size) {
    fs::resize_file(path, size);
    const LogInFiles read = readLog(path);
    EXPECT_EQ(read.wrongLines, 0u) << size;
    EXPECT_EQ(read.entries.size(), static_cast<size_t>(std::count(whole.begin(), whole.begin() + size, '\n'))) << size;
    std::ofstream(path, std::ios::binary) << whole;
  }
}

TEST_F(LogFileTest, DamagedBytesHarmOnlyTheirLines) {
  open();
  for (int i = 0; i < 20; ++i) log.happen({.kind = LogKind::Set, .text = "set " + std::to_string(i)}, now);
  file.reset();
  const std::string whole = contents();
  std::mt19937 random(4711); // NOLINT(cert-msc51-cpp): the same each time
  for (int round = 0; round < 300; ++round) {
    std::string damaged = whole;
    const size_t at = random() % whole.size();
    damaged[at] = static_cast<char>(random());
    std::ofstream(path, std::ios::binary) << damaged;
    const LogInFiles read = readLog(path);
    EXPECT_GE(read.entries.size() + read.wrongLines, 19u) << at;
    EXPECT_GE(read.entries.size(), 18u) << at; // a line end that is gone harms two
  }
}

TEST(ReadLog, AFileThatIsNotThere) {
  const TemporaryFolder folder;
  const LogInFiles none = readLog((folder / "none.log").string());
  EXPECT_FALSE(none.found);
  EXPECT_EQ(none.problem, "");
  fs::create_directory(folder / "a.log");
  EXPECT_THAT(readLog((folder / "a.log").string()).problem, HasSubstr("it is not a regular file"));
}

} // namespace
} // namespace rung::control
