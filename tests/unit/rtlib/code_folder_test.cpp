// A folder of machine code is used only when nobody else could have put files there.
#include "rtlib/load/trust.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <sys/stat.h>
#include <unistd.h>

#include "ir/support/temporary_folder.h"

namespace {

using namespace rung::runtime;
using testing::HasSubstr;
namespace fs = std::filesystem;

class CodeFolderTest : public testing::Test {
protected:
  std::string path(std::string_view name = "cache") const { return (folder_ / name).string(); }
  std::optional<CodeFolder> open(std::string_view name = "cache") {
    problem_.clear();
    return CodeFolder::open(path(name), problem_);
  }

  rung::TemporaryFolder folder_;
  std::string problem_;
};

TEST_F(CodeFolderTest, IsMadeForItsOwnerAlone) {
  const mode_t before = umask(0);
  const auto folder = open("some/where/cache");
  umask(before);
  ASSERT_TRUE(folder) << problem_;
  EXPECT_EQ(fs::status(path("some/where/cache")).permissions(), fs::perms::owner_all);
  EXPECT_EQ(folder->write("a.o", "code"), "");
  EXPECT_EQ(fs::status(path("some/where/cache/a.o")).permissions(), fs::perms::owner_read | fs::perms::owner_write);
  EXPECT_EQ(folder->read("a.o"), "code");
  EXPECT_EQ(folder->read("b.o"), std::nullopt);
}

TEST_F(CodeFolderTest, ThatOthersMayWriteIsRefused) {
  ASSERT_TRUE(open());
  fs::permissions(path(), fs::perms::others_write, fs::perm_options::add);
  EXPECT_FALSE(open());
  EXPECT_THAT(problem_, HasSubstr("cache' for code: every user may write to it (mode 0702)"));
}

TEST_F(CodeFolderTest, OfSomebodyElseIsRefused) {
  if (geteuid() != 0) GTEST_SKIP() << "needs root, to give the folder away";
  ASSERT_TRUE(open());
  ASSERT_EQ(chown(path().c_str(), 65534, 65534), 0);
  EXPECT_FALSE(open());
  EXPECT_THAT(problem_, HasSubstr("it belongs to user 65534"));
}

TEST_F(CodeFolderTest, IsNoLinkAndNoFile) {
  ASSERT_TRUE(open());
  fs::create_symlink("cache", path("link"));
  EXPECT_FALSE(open("link"));
  EXPECT_EQ(replaceFile(path("file"), ""), "");
  EXPECT_FALSE(open("file"));
  EXPECT_THAT(problem_, HasSubstr("Not a directory"));
}

TEST_F(CodeFolderTest, FilesThatOthersCouldHaveWrittenAreNotThere) {
  const auto folder = open();
  ASSERT_TRUE(folder);
  EXPECT_EQ(folder->write("a.o", "code"), "");
  fs::create_symlink("a.o", path("cache/link.o"));
  EXPECT_EQ(folder->read("link.o"), std::nullopt);
  fs::permissions(path("cache/a.o"), fs::perms::others_write, fs::perm_options::add);
  EXPECT_EQ(folder->read("a.o"), std::nullopt);
  EXPECT_EQ(folder->write("a.o", "new"), "");
  EXPECT_EQ(folder->read("a.o"), "new");
  ASSERT_EQ(mkfifo(path("cache/pipe.o").c_str(), 0600), 0);
  EXPECT_EQ(folder->read("pipe.o"), std::nullopt) << "and nobody waits for its other end";
}

// The folder that was checked stays the one that is used.
TEST_F(CodeFolderTest, AnotherInItsPlaceIsNotUsed) {
  const auto folder = open();
  ASSERT_TRUE(folder);
  fs::rename(path(), path("moved"));
  ASSERT_TRUE(open());
  EXPECT_EQ(folder->write("a.o", "code"), "");
  EXPECT_TRUE(fs::exists(path("moved/a.o")));
  EXPECT_FALSE(fs::exists(path("cache/a.o")));
}

} // namespace
