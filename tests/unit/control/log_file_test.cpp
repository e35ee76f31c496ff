// The log on disk: what a crash, a disk that cannot be written, or somebody else's file does to it.
#include "machine/control/log_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <csignal>
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
  EXPECT_THAT(read.wrong, ElementsAre(path + ": line 1 is not an entry of a log, and is left out"));
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
  EXPECT_THAT(read.wrong, IsEmpty());
  EXPECT_EQ(read.entries.back().text, text + "1999");
  EXPECT_GT(read.entries.size(), 80u);
}

// How often the text is in the file of that name.
size_t countOf(const std::string& path, const std::string& text) {
  std::ifstream in(path, std::ios::binary);
  const std::string all{std::istreambuf_iterator<char>(in), {}};
  size_t count = 0;
  for (size_t at = all.find(text); at != std::string::npos; at = all.find(text, at + 1)) ++count;
  return count;
}

TEST_F(LogFileTest, ANewFileHasWhatIsOnOnce) {
  most = 20'000;
  open();
  log.come(kDoor, "DOOR", now, false);
  EXPECT_TRUE(writes("\"DOOR\""));
  log.happen({.text = std::string(1900, 'x')}, now);
  EXPECT_TRUE(writes("xxx"));
  for (int i = 0; i < 5; ++i) log.happen({.text = std::string(1900, 'x')}, now);
  log.come({4, 0, 0}, "OIL", now, false); // in the text that does not fit any more
  EXPECT_TRUE(test::soon([&] { return tick(), fs::exists(olderLog(path)) && countOf(path, "\"OIL\"") != 0; }));
  EXPECT_EQ(countOf(path, "\"OIL\""), 1u);
  EXPECT_EQ(countOf(path, "\"DOOR\""), 1u);
}

// As many messages as never fit: the file must not turn over with each line, which would leave nothing of before.
TEST_F(LogFileTest, MoreMessagesThanAFileHasRoomFor) {
  most = 20'000;
  open();
  for (int i = 0; i < 40; ++i) log.come({5, 0, i}, std::string(900, 'm'), now, false);
  EXPECT_TRUE(test::soon([&] { return tick(), now += 1, countOf(path, "mmm") + countOf(olderLog(path), "mmm") > 0; }));
  for (int i = 0; i < 6; ++i) {
    log.happen({.text = "event " + std::to_string(i)}, now);
    EXPECT_TRUE(writes("\"event " + std::to_string(i) + "\""));
  }
  const LogInFiles read = readLog(path);
  for (int i = 0; i < 6; ++i)
    EXPECT_EQ(std::ranges::count(read.entries, "event " + std::to_string(i), &LogEntry::text), 1) << i;
}

// Files of at most so many bytes, as on a disk that becomes full.
class Full {
public:
  explicit Full(rlim_t bytes) {
    std::signal(SIGXFSZ, SIG_IGN); // NOLINT(cert-err33-c)
    getrlimit(RLIMIT_FSIZE, &before_);
    rlimit limit = before_;
    limit.rlim_cur = bytes;
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~Full() { setrlimit(RLIMIT_FSIZE, &before_); }
  Full(const Full&) = delete;
  Full& operator=(const Full&) = delete;

private:
  rlimit before_{};
};

TEST_F(LogFileTest, ADiskThatBecomesFullWhileTheFileTurnsOver) {
  most = 20'000;
  open();
  log.come(kDoor, "DOOR", now, false);
  for (int i = 0; i < 4; ++i) log.happen({.text = "first " + std::string(1900, 'x')}, now);
  EXPECT_TRUE(test::soon([&] { return tick(), countOf(path, "first") == 4; }));
  {
    const Full full(1000);
    for (int i = 0; i < 3; ++i) log.happen({.text = "second " + std::string(1900, 'x')}, now);
    EXPECT_TRUE(says("the log is not kept on disk: cannot write"));
    for (int i = 0; i < 3; ++i) {
      now += LogFile::kRetryS;
      tick();
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    EXPECT_LE(fs::file_size(path), 1000u);
  }
  now += LogFile::kRetryS;
  EXPECT_TRUE(says("the log is kept on disk again"));
  file.reset();
  EXPECT_EQ(countOf(olderLog(path), "first"), 4u) << "it has turned over once";
  EXPECT_EQ(countOf(path, "\"second"), 3u);
  EXPECT_EQ(countOf(path, "\"DOOR\""), 1u);
  EXPECT_THAT(readLog(path).wrong, IsEmpty());
}

TEST_F(LogFileTest, AnOlderFileThatCannotBeReplaced) {
  most = 20'000;
  fs::create_directories(olderLog(path) + "/full");
  open();
  for (int i = 0; i < 7; ++i) log.happen({.text = "first " + std::string(1900, 'x')}, now);
  EXPECT_TRUE(says("the log is not kept on disk: cannot"));
  log.happen({.text = "second"}, now);
  fs::remove_all(olderLog(path));
  now += LogFile::kRetryS;
  EXPECT_TRUE(says("the log is kept on disk again"));
  EXPECT_TRUE(writes("\"second\""));
  EXPECT_EQ(countOf(path, "first") + countOf(olderLog(path), "first"), 7u);
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
    EXPECT_THAT(read.wrong, IsEmpty()) << size;
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
    EXPECT_GE(read.entries.size(), 18u) << at; // a line end that is gone harms two
    EXPECT_TRUE(read.entries.size() >= 19 || !read.wrong.empty()) << at;
  }
}

// What a host does with its log in an order that a seed decides: messages, changes, full disks, crashes at any byte of
// the file, new starts. Whatever was written before the last crash and is not turned over is there, once, as it was.
class RandomLog {
public:
  explicit RandomLog(uint32_t seed, const std::string& path) : random_(seed), path_(path) { begin(); }

  void step() {
    switch (below(12)) {
    case 0:
    case 1:
    case 2: log_->come({below(6), 0, 0}, "message " + std::to_string(below(3)), now_, chance(30)); break;
    case 3:
    case 4: log_->go({below(6), 0, 0}, now_); break;
    case 5: log_->acknowledge(now_); break;
    case 6:
    case 7: log_->happen({.kind = LogKind::Set, .text = std::string(below(600), 'x')}, now_, chance(20)); break;
    case 8: now_ += below(12); break;
    case 9: settle(); break;
    case 10:
      if (chance(10)) full_ = full_ ? nullptr : std::make_unique<Full>(below(9000));
      break;
    case 11:
      if (chance(15)) crash();
      break;
    }
    if (chance(40)) file_->tick(now_);
  }
  // The regular end; returns what is wrong.
  std::string end() {
    full_.reset();
    settle();
    file_.reset();
    return compare(*log_);
  }
  const std::string& wrong() const { return wrong_; }

private:
  uint32_t below(uint32_t most) { return static_cast<uint32_t>(random_() % most); }
  bool chance(uint32_t percent) { return below(100) < percent; }

  void begin() {
    log_ = std::make_unique<LogEntries>();
    file_ = std::make_unique<LogFile>(*log_, path_, 30'000);
  }
  // Until all that is due is written, if it can be.
  void settle() {
    for (int i = 0; i < 3 && !full_; ++i) {
      now_ += LogFile::kRetryS;
      file_->tick(now_);
      for (int wait = 0; wait < 5000 && file_->busy(); ++wait)
        std::this_thread::sleep_for(std::chrono::microseconds(20));
    }
  }
  // The process is killed in the middle of its last line: a copy of the files as they are is continued.
  void crash() {
    settle();
    const bool isWhole = !full_;
    std::error_code none;
    fs::copy_file(path_, path_ + ".copy", fs::copy_options::overwrite_existing, none);
    const bool hasOlder = fs::copy_file(olderLog(path_), path_ + ".copy.1", fs::copy_options::overwrite_existing, none);
    if (isWhole && wrong_.empty()) wrong_ = compare(*log_);
    full_.reset();
    file_.reset();
    fs::rename(path_ + ".copy", path_, none);
    fs::remove(olderLog(path_), none);
    if (hasOlder) fs::rename(path_ + ".copy.1", olderLog(path_), none);
    std::ofstream(path_, std::ios::app | std::ios::binary) << std::string("{\"n\":1234567,\"came\":1", below(23));
    begin();
  }
  // The entries of the file are those of memory, as far as both have them.
  std::string compare(const LogEntries& log) const {
    const LogInFiles read = readLog(path_);
    if (!read.wrong.empty()) return read.wrong.front();
    for (const LogEntry& kept : read.entries) {
      const auto found = std::ranges::find(log.entries(), kept.number, &LogEntry::number);
      if (found == log.entries().end() || found->changed) continue;
      LogEntry here = *found;
      here.cut = kept.cut; // of an earlier start: the file has no line for it
      if (jsonOf(here) != jsonOf(kept)) return jsonOf(*found).dump() + " is on disk " + jsonOf(kept).dump();
    }
    for (const LogEntry& on : log.shown())
      if (!on.changed && std::ranges::find(read.entries, on.number, &LogEntry::number) == read.entries.end())
        return "what is on is not on disk: " + jsonOf(on).dump();
    return {};
  }

  std::mt19937 random_;
  std::string path_;
  int64_t now_ = kBegin;
  std::unique_ptr<LogEntries> log_;
  std::unique_ptr<LogFile> file_;
  std::unique_ptr<Full> full_;
  std::string wrong_;
};

TEST(LogFileRandom, WhatIsOnDiskIsWhatWasInMemory) {
  for (uint32_t seed = 1; seed <= 40; ++seed) {
    const TemporaryFolder folder;
    RandomLog log(seed, (folder / "kept.log").string());
    for (int i = 0; i < 400; ++i) log.step();
    EXPECT_EQ(log.wrong(), "") << "seed " << seed;
    EXPECT_EQ(log.end(), "") << "seed " << seed;
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
