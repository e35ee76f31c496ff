// The history on disk: what a crash, a disk that cannot be written, or somebody else's file does to it.
#include "machine/control/history.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
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
const History::Key kDoor{3, 0, 0};

struct HistoryFileTest : ::testing::Test {
  TemporaryFolder folder;
  const std::string path = (folder / "kept.messages").string();
  History history;
  std::unique_ptr<HistoryFile> file;
  int64_t now = kBegin;
  std::vector<std::string> said;

  void open() { file = std::make_unique<HistoryFile>(history, path); }
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
    History read;
    const HistoryFile other(read, path);
    std::vector<std::string> texts;
    for (const History::Entry& entry : read.entries()) texts.push_back(entry.text + (entry.cut ? "!" : ""));
    return texts;
  }
};

TEST_F(HistoryFileTest, WhatHasComeIsThereAfterACrash) {
  open();
  history.come(kDoor, "DOOR", now, false);
  EXPECT_TRUE(writes("\"DOOR\""));
  history.happen("fault", now + 1);
  EXPECT_TRUE(writes("\"fault\""));
  fs::copy_file(path, path + ".crash"); // as it is when the process is killed now
  history.go(kDoor, now + 2);
  file.reset(); // a regular end
  EXPECT_THAT(textsOf(path + ".crash"), ElementsAre("DOOR!", "fault"));
  EXPECT_THAT(textsOf(path), ElementsAre("DOOR", "fault"));
  EXPECT_THAT(said, IsEmpty());
}

TEST_F(HistoryFileTest, ANewHostContinues) {
  open();
  history.happen("one", now);
  file.reset();
  history = History();
  open();
  history.happen("two", now + 1);
  file.reset();
  EXPECT_THAT(textsOf(path), ElementsAre("one", "two"));
}

TEST_F(HistoryFileTest, ALineThatIsTornIsLeftOut) {
  open();
  history.happen("one", now);
  history.happen("two", now);
  file.reset();
  fs::resize_file(path, fs::file_size(path) - 4);
  history = History();
  open();
  history.happen("three", now + 1);
  EXPECT_TRUE(writes("\"three\""));
  file.reset();
  EXPECT_THAT(textsOf(path), ElementsAre("one", "three"));
  EXPECT_THAT(said, IsEmpty()) << "a crash is not a mistake of anybody";
}

// As a full disk: there is no place for it.
TEST_F(HistoryFileTest, WhatCannotBeWrittenIsSaidOnceAndComesLater) {
  fs::create_directory(path);
  open();
  EXPECT_TRUE(says("the history of messages is not kept: cannot read " + path)) << "at once";
  history.happen("one", now);
  now += HistoryFile::kRetryS;
  EXPECT_TRUE(says("the history of messages is not kept: cannot write " + path));
  const size_t reports = said.size();
  for (int i = 0; i < 20; ++i) {
    now += HistoryFile::kRetryS;
    tick();
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  EXPECT_EQ(said.size(), reports) << "it says so once";
  fs::remove(path);
  now += HistoryFile::kRetryS;
  EXPECT_TRUE(says("the history of messages is kept again"));
  EXPECT_THAT(contents(), HasSubstr("\"one\""));
}

TEST_F(HistoryFileTest, AFileOfAnotherKindIsReplacedAndThatIsSaid) {
  std::ofstream(path) << "no history\n";
  open();
  history.happen("one", now);
  EXPECT_TRUE(says("it has lines that do not belong to a history"));
  EXPECT_TRUE(says("the history of messages is kept again"));
  file.reset();
  EXPECT_THAT(textsOf(path), ElementsAre("one"));
}

TEST_F(HistoryFileTest, ALinkIsNotFollowed) {
  std::ofstream((folder / "others")) << "kept\n";
  fs::create_symlink((folder / "others"), path);
  open();
  history.happen("one", now);
  EXPECT_TRUE(says("it is a symbolic link"));
  file.reset();
  std::ifstream others((folder / "others"));
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(others), {}), "kept\n");
}

TEST_F(HistoryFileTest, ItsSizeIsBounded) {
  open();
  const std::string text(1000, 'x');
  size_t most = 0;
  for (int i = 0; i < 4000; ++i, now += i % 10 == 0 ? 1 : 0) {
    history.happen(text, now);
    tick();
    std::error_code none;
    if (const auto size = fs::file_size(path, none); !none) most = std::max(most, static_cast<size_t>(size));
    std::this_thread::sleep_for(std::chrono::microseconds(300));
  }
  EXPECT_LT(most, 2 * HistoryFile::kMostBytes + 64 * 1024);
  file.reset();
  EXPECT_LT(fs::file_size(path), 2 * HistoryFile::kMostBytes);
}

} // namespace
} // namespace rung::control
