// Files appear under their name whole, or not at all.
#include "rtlib/load/file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <sys/stat.h>
#include <thread>
#include <vector>

#include "ir/support/temporary_folder.h"

namespace {

using namespace rung::runtime;
using testing::HasSubstr;
namespace fs = std::filesystem;

class ReplaceFile : public testing::Test {
protected:
  std::string path(std::string_view name) const { return (folder_ / name).string(); }
  std::string text(std::string_view name) const { return folder_.contentsOf(name).value_or("unreadable"); }
  size_t files() const {
    return static_cast<size_t>(std::distance(fs::directory_iterator(path("")), fs::directory_iterator()));
  }
  static unsigned modeOf(const std::string& file) {
    struct stat status{};
    return ::stat(file.c_str(), &status) == 0 ? status.st_mode & 07777u : 0;
  }

  rung::TemporaryFolder folder_;
};

TEST_F(ReplaceFile, WritesAndReplaces) {
  EXPECT_EQ(replaceFile(path("a"), "one"), "");
  EXPECT_EQ(text("a"), "one");
  EXPECT_EQ(replaceFile(path("a"), "two", {.mode = 0640, .lasts = true}), "");
  EXPECT_EQ(text("a"), "two");
  EXPECT_EQ(modeOf(path("a")), 0640u);
  EXPECT_EQ(files(), 1u);
}

TEST_F(ReplaceFile, WhoHasTheOldFileOpenKeepsIt) {
  EXPECT_EQ(replaceFile(path("a"), "one"), "");
  std::ifstream old(path("a"));
  EXPECT_EQ(replaceFile(path("a"), "two"), "");
  std::string word;
  old >> word;
  EXPECT_EQ(word, "one");
}

TEST_F(ReplaceFile, SaysWhyAndLeavesNothing) {
  EXPECT_THAT(replaceFile(path("missing/a"), "one"),
              testing::AllOf(HasSubstr("cannot write '"), HasSubstr("missing/a': the folder "),
                             HasSubstr("missing does not exist")));
  fs::create_directory(path("folder"));
  EXPECT_THAT(replaceFile(path("folder"), "one"), HasSubstr("folder': "));
  EXPECT_EQ(files(), 1u);
}

TEST_F(ReplaceFile, KeepsWhatItMustNotReplace) {
  EXPECT_EQ(replaceFile(path("a"), "one", {.mayReplace = false}), "");
  EXPECT_THAT(replaceFile(path("a"), "two", {.mayReplace = false}), HasSubstr("File exists"));
  EXPECT_EQ(text("a"), "one");
  fs::create_symlink(path("elsewhere"), path("link"));
  EXPECT_THAT(replaceFile(path("link"), "two", {.mayReplace = false}), HasSubstr("File exists"));
  EXPECT_EQ(files(), 2u);
}

TEST_F(ReplaceFile, FollowsALink) {
  EXPECT_EQ(replaceFile(path("a"), "one"), "");
  fs::create_symlink("a", path("link"));
  EXPECT_EQ(replaceFile(path("link"), "two"), "");
  EXPECT_TRUE(fs::is_symlink(path("link")));
  EXPECT_EQ(text("a"), "two");
}

TEST_F(ReplaceFile, ADeviceStaysOne) {
  EXPECT_EQ(replaceFile("/dev/null", "one"), "");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
  std::string got;
  std::thread reader([&] { std::ifstream(path("pipe")) >> got; });
  EXPECT_EQ(replaceFile(path("pipe"), "one"), "");
  reader.join();
  EXPECT_EQ(got, "one");
}

TEST_F(ReplaceFile, WritersOfOneNameDoNotMixTheirBytes) {
  std::vector<std::thread> writers;
  for (int writer = 0; writer < 4; ++writer)
    writers.emplace_back([&, writer] {
      const std::string bytes(200'000, static_cast<char>('a' + writer));
      for (int i = 0; i < 20; ++i) EXPECT_EQ(replaceFile(path("a"), bytes), "");
    });
  for (int look = 0; look < 50; ++look) {
    const auto found = folder_.contentsOf("a");
    if (!found) continue; // not yet there
    EXPECT_EQ(found->size(), 200'000u);
    EXPECT_EQ(found->find_first_not_of(found->front()), std::string::npos);
  }
  for (std::thread& writer : writers) writer.join();
  EXPECT_EQ(files(), 1u);
}

TEST_F(ReplaceFile, ReadAllHasALimit) {
  EXPECT_EQ(replaceFile(path("a"), std::string(3 << 20, 'x')), "");
  const File file(::open(path("a").c_str(), O_RDONLY));
  std::string bytes;
  EXPECT_EQ(readAll(file.fd(), 3 << 20, bytes), "");
  EXPECT_EQ(bytes.size(), size_t{3} << 20);
  EXPECT_EQ(readAll(file.fd(), 2 << 20, bytes), "it is larger than 2 MB");
}

} // namespace
