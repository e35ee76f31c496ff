// Whose code runs: the rules as a table, and the folder of public keys.
#include "rtlib/load/trust.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <unistd.h>

#include "ir/support/temporary_folder.h"
#include "rtlib/load/file.h"
#include "rtlib/load/seal.h"

namespace {

using namespace rung::runtime;
using testing::HasSubstr;
namespace fs = std::filesystem;

constexpr ProcessIds kUser{.ruid = 1000, .euid = 1000, .suid = 1000, .fsuid = 1000, .egid = 100};
constexpr ProcessIds kRoot{};
constexpr ProcessIds kRtapi{.ruid = 0, .euid = 0, .suid = 1000, .fsuid = 1000, .egid = 100}; // of LinuxCNC 2.9

TEST(Trust, IsPrivilegedWhoHasRootsRightsForAnother) {
  EXPECT_FALSE(isPrivileged(kUser));
  EXPECT_FALSE(isPrivileged(kRoot));
  EXPECT_TRUE(isPrivileged(kRtapi));
  EXPECT_TRUE(isPrivileged({.ruid = 1000, .euid = 0, .suid = 0, .fsuid = 0, .egid = 0}));       // just started setuid
  EXPECT_TRUE(isPrivileged({.ruid = 1000, .euid = 1000, .suid = 0, .fsuid = 1000, .egid = 0})); // may return to root
  EXPECT_TRUE(isPrivileged({.ruid = 0, .euid = 0, .suid = 0, .fsuid = 1000, .egid = 0})); // opens files as another
  EXPECT_FALSE(isPrivileged({.ruid = 1000, .euid = 1001, .suid = 1001, .fsuid = 1001, .egid = 0})); // setuid, not root
}

struct Row {
  const char* what = "";
  ProcessIds process;
  FileFacts file;
  SealState seal = SealState::Missing;
  const char* verdict = ""; // part of it; empty: may be loaded
};

constexpr FileFacts facts(uint32_t uid, uint32_t gid, uint32_t mode) { return {.uid = uid, .gid = gid, .mode = mode}; }

TEST(Trust, RulesOfLoading) {
  using enum SealState;
  const Row rows[] = {
      {"one's own", kUser, facts(1000, 100, 0755), Unsigned, ""},
      {"root's", kUser, facts(0, 0, 0644), Unsigned, ""},
      {"another's", kUser, facts(1001, 100, 0644), Unsigned, "it belongs to user 1001, not to root or to user 1000"},
      {"another's, signed", kUser, facts(1001, 100, 0666), Signed, ""},
      {"another's, key unknown", kUser, facts(1001, 100, 0644), UnknownKey, "it belongs to user 1001"},
      {"one's own, key unknown", kUser, facts(1000, 100, 0644), UnknownKey, ""},
      {"one's own, signature wrong", kUser, facts(1000, 100, 0644), WrongSignature, "its signature is not by the key"},
      {"others write", kUser, facts(1000, 100, 0646), Unsigned,
       "every user may write to it (mode 0646); after chmod go-w"},
      {"others write root's", kUser, facts(0, 0, 0666), Unsigned, "every user may write to it"},
      {"own group writes", kUser, facts(1000, 100, 0664), Unsigned, ""},
      {"another group writes", kUser, facts(1000, 50, 0664), Unsigned, "its group 50 may write to it (mode 0664)"},
      {"no seal", kUser, facts(1000, 100, 0644), Missing, "it has no seal"},
      {"root, root's", kRoot, facts(0, 0, 0755), Unsigned, ""},
      {"root, a user's", kRoot, facts(1000, 100, 0644), Unsigned, "it belongs to user 1000, not to root, who runs it"},
      {"root, a user's, signed", kRoot, facts(1000, 100, 0644), Signed, ""},
      {"privileged, root's", kRtapi, facts(0, 0, 0755), Unsigned, ""},
      {"privileged, the user's", kRtapi, facts(1000, 100, 0644), Unsigned,
       "runs only what belongs to root; a copy made by sudo install"},
      {"privileged, the user's, signed", kRtapi, facts(1000, 100, 0666), Signed, ""},
      {"privileged, the user's, key unknown", kRtapi, facts(1000, 100, 0644), UnknownKey, "it belongs to user 1000"},
      {"privileged, own group writes", kRtapi, facts(0, 100, 0664), Unsigned, "its group 100 may write to it"},
      {"privileged, root's group writes", kRtapi, facts(0, 0, 0664), Unsigned, "its group 0 may write to it"},
      {"privileged, others write", kRtapi, facts(0, 0, 0646), Unsigned, "every user may write to it"},
      {"privileged, no seal", kRtapi, facts(0, 0, 0644), Missing, "it has no seal"},
      {"privileged, signature wrong", kRtapi, facts(0, 0, 0644), WrongSignature, "its signature is not by the key"},
  };
  for (const Row& row : rows) {
    const std::string verdict = loadProblem(row.file, row.process, row.seal, false);
    if (*row.verdict == 0)
      EXPECT_EQ(verdict, "") << row.what;
    else
      EXPECT_THAT(verdict, HasSubstr(row.verdict)) << row.what;
  }
}

TEST(Trust, OnlyAnUnprivilegedHostMayAllowUnsealedFiles) {
  EXPECT_EQ(loadProblem(facts(1000, 100, 0644), kUser, SealState::Missing, true), "");
  EXPECT_EQ(loadProblem(facts(0, 0, 0644), kRoot, SealState::Missing, true), "");
  EXPECT_THAT(loadProblem(facts(0, 0, 0644), kRtapi, SealState::Missing, true), HasSubstr("it has no seal"));
  EXPECT_THAT(loadProblem(facts(1001, 100, 0644), kUser, SealState::Missing, true),
              HasSubstr("it belongs to user 1001"));
}

TEST(Trust, OnlyRegularFilesAreLoaded) {
  FileFacts pipe = facts(0, 0, 0600);
  pipe.isRegular = false;
  EXPECT_EQ(loadProblem(pipe, kUser, SealState::Signed, true), "it is not a regular file");
}

TEST(Trust, APrivilegedHostLoadsNoFurtherLibraries) {
  EXPECT_EQ(dependencyProblem({.problem = {},
                               .machine = {},
                               .needed = {"libc.so.6", "libm.so.6", "libstdc++.so.6"},
                               .searched = {},
                               .exported = {}}),
            "");
  for (const char* library : {"libplc.so", "/lib/libc.so.6", "libc.so.6 ", "../libm.so.6", ""})
    EXPECT_THAT(dependencyProblem({.problem = {}, .machine = {}, .needed = {library}, .searched = {}, .exported = {}}),
                HasSubstr("it needs the library"));
  EXPECT_THAT(dependencyProblem({.problem = {}, .machine = {}, .needed = {}, .searched = {"$ORIGIN"}, .exported = {}}),
              HasSubstr("'$ORIGIN' to load libraries from"));
  EXPECT_EQ(
      dependencyProblem({.problem = "it is cut short", .machine = {}, .needed = {}, .searched = {}, .exported = {}}),
      "it is cut short");
}

TEST(Trust, KnowsItsProcess) {
  const ProcessIds ids = idsOfThisThread();
  EXPECT_EQ(ids.ruid, getuid());
  EXPECT_EQ(ids.euid, geteuid());
  EXPECT_EQ(ids.fsuid, geteuid());
  EXPECT_EQ(ids.egid, getegid());
}

class KnownKeys : public testing::Test {
protected:
  std::string path(std::string_view name) const { return (folder_ / name).string(); }
  std::optional<PublicKey> find() {
    problem_.clear();
    return findKey(key_.publicKey().id(), path(""), ids_, problem_);
  }
  void put(const std::string& name, const SecretKey& key, mode_t mode = 0644) {
    ASSERT_EQ(replaceFile(path(name), textOf(key.publicKey()), {.mode = mode}), "");
    fs::permissions(path(name), static_cast<fs::perms>(mode));
  }

  rung::TemporaryFolder folder_;
  const SecretKey key_ = SecretKey::make();
  const ProcessIds ids_ = idsOfThisThread();
  std::string problem_;
};

TEST_F(KnownKeys, AreFoundByTheirIdentity) {
  EXPECT_FALSE(find());
  put("first.pub", SecretKey::make());
  EXPECT_FALSE(find());
  put("second.pub", key_);
  ASSERT_TRUE(find());
  EXPECT_EQ(find()->bytes, key_.publicKey().bytes);
  EXPECT_EQ(problem_, "");
}

TEST_F(KnownKeys, ThatOthersCouldHavePutThereDoNotCount) {
  put("a.pub", key_, 0666);
  EXPECT_FALSE(find());
  fs::remove(path("a.pub"));
  put("elsewhere", key_);
  EXPECT_FALSE(find()) << "another name";
  fs::create_symlink("elsewhere", path("a.pub"));
  EXPECT_FALSE(find()) << "a link";
  put("b.pub", key_);
  EXPECT_TRUE(find());
  fs::permissions(path(""), fs::perms::all);
  EXPECT_FALSE(find());
  EXPECT_THAT(problem_, HasSubstr("every user may write"));
}

TEST_F(KnownKeys, OfAPrivilegedProcessAreInOnePlace) {
  put("a.pub", key_);
  EXPECT_FALSE(findKey(key_.publicKey().id(), path(""), kRtapi, problem_)) << "an option must not choose it";
}

TEST_F(KnownKeys, AMissingFolderOfOnesOwnChoiceIsSaid) {
  EXPECT_FALSE(findKey(key_.publicKey().id(), path("missing"), ids_, problem_));
  EXPECT_THAT(problem_, HasSubstr("missing: No such file or directory"));
}

} // namespace
