// Loading shared objects; the programs are in so/*.c, so the ABI is used from plain C too.
#include "rtlib/load/so_engine.h"

#include <dlfcn.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <link.h>
#include <sys/stat.h>
#include <unistd.h>

#include "ir/support/temporary_folder.h"
#include "rtlib/load/seal.h"
#include "rtlib/run/instance.h"

namespace {

using namespace rung::runtime;
using testing::HasSubstr;
namespace fs = std::filesystem;

constexpr uid_t kNobody = 65534;

std::string contentsOf(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

class SoEngineTest : public testing::Test {
protected:
  std::string path(std::string_view name = "program.so") const { return (folder_ / name).string(); }
  // A program of so/, with a seal, at path(name).
  std::string put(const char* object, std::string_view name = "program.so") {
    EXPECT_EQ(replaceFile(path(name), sealed(contentsOf(object)), {.mode = kProgramMode}), "");
    return path(name);
  }
  std::unique_ptr<SoEngine> open(const std::string& file, const SoOptions& options = {}) {
    return SoEngine::open(file, error_, options);
  }
  static uint64_t countOf(SoEngine& engine) {
    Instance instance(engine.program());
    instance.scan();
    instance.scan();
    return instance.read(intRef(0, 0, 8)); // D0
  }

  rung::TemporaryFolder folder_;
  std::string error_;
};

TEST_F(SoEngineTest, LoadsAndRunsAProgramMadeInC) {
  const auto engine = open(put(RUNG_TEST_SO_GOOD));
  ASSERT_NE(engine, nullptr) << error_;
  EXPECT_EQ(engine->name(), "so");
  EXPECT_EQ(engine->path(), path());
  EXPECT_EQ(countOf(*engine), 2u);
}

// How many loaded objects export a program of this name, and by which names the dynamic linker knows them.
std::vector<std::string> loadedNames() {
  std::vector<std::string> names;
  dl_iterate_phdr(
      [](dl_phdr_info* info, size_t, void* found) {
        if (std::string_view(info->dlpi_name).starts_with("/proc/"))
          static_cast<std::vector<std::string>*>(found)->emplace_back(info->dlpi_name);
        return 0;
      },
      &names);
  return names;
}

TEST_F(SoEngineTest, StaysLoadedOnlyWhenAsked) {
  const std::string file = put(RUNG_TEST_SO_GOOD);
  const size_t before = loadedNames().size();
  ASSERT_NE(open(file), nullptr) << error_;
  EXPECT_EQ(loadedNames().size(), before);
  ASSERT_NE(open(file, {.loaded = Loaded::WithProcess}), nullptr) << error_;
  EXPECT_EQ(loadedNames().size(), before + 1);
  // Its file can still be opened by that name.
  EXPECT_TRUE(fs::equivalent(loadedNames().back(), file));
}

TEST_F(SoEngineTest, ADebuggerElsewhereFindsTheFile) {
  const auto engine = open(put(RUNG_TEST_SO_GOOD));
  ASSERT_NE(engine, nullptr) << error_;
  ASSERT_FALSE(loadedNames().empty());
  const std::string name = loadedNames().back();
  EXPECT_THAT(name, testing::StartsWith("/proc/" + std::to_string(getpid()) + "/fd/"));
  EXPECT_TRUE(fs::equivalent(name, path()));
}

TEST_F(SoEngineTest, ARebuiltFileIsTheNewProgram) {
  {
    const auto first = open(put(RUNG_TEST_SO_GOOD));
    ASSERT_NE(first, nullptr) << error_;
    EXPECT_EQ(countOf(*first), 2u);
  }
  const auto second = open(put(RUNG_TEST_SO_OTHER));
  ASSERT_NE(second, nullptr) << error_;
  EXPECT_EQ(countOf(*second), 20u);
}

TEST_F(SoEngineTest, ARebuiltFileIsTheNewProgramBesideTheOldOne) {
  const auto first = open(put(RUNG_TEST_SO_GOOD));
  const auto second = open(put(RUNG_TEST_SO_OTHER));
  const auto third = open(put(RUNG_TEST_SO_GOOD));
  ASSERT_TRUE(first && second && third) << error_;
  EXPECT_EQ(countOf(*second), 20u);
  EXPECT_EQ(countOf(*first), 2u);
  EXPECT_EQ(countOf(*third), 2u);
}

// A file loaded twice is one library with two names; the second name's descriptor is free when its engine goes.
TEST_F(SoEngineTest, ANameOfALoadedLibraryIsNotUsedAgain) {
  const std::string file = put(RUNG_TEST_SO_GOOD);
  const auto first = open(file);
  auto again = open(file);
  ASSERT_TRUE(first && again) << error_;
  again.reset();
  const auto other = open(put(RUNG_TEST_SO_OTHER));
  ASSERT_NE(other, nullptr) << error_;
  EXPECT_EQ(countOf(*other), 20u);
  EXPECT_EQ(countOf(*first), 2u);
}

TEST_F(SoEngineTest, KeepsNoDescriptorOfWhatIsGone) {
  const auto descriptors = [] {
    return std::distance(fs::directory_iterator("/proc/self/fd"), fs::directory_iterator());
  };
  const std::string file = put(RUNG_TEST_SO_GOOD);
  const auto before = descriptors();
  for (int i = 0; i < 3; ++i) EXPECT_NE(open(file), nullptr) << error_;
  EXPECT_EQ(open(put(RUNG_TEST_SO_EMPTY)), nullptr);
  EXPECT_EQ(descriptors(), before);
}

TEST_F(SoEngineTest, RefusesAnotherVersion) {
  EXPECT_EQ(open(put(RUNG_TEST_SO_VERSION)), nullptr);
  EXPECT_THAT(error_, HasSubstr("ABI version 99"));
  EXPECT_THAT(error_, HasSubstr("compile it again"));
}

TEST_F(SoEngineTest, RefusesALibraryWithoutProgram) {
  EXPECT_EQ(open(put(RUNG_TEST_SO_EMPTY)), nullptr);
  EXPECT_THAT(error_, HasSubstr("no symbol rung_program_table"));
}

TEST_F(SoEngineTest, SaysWhyAFileCannotBeLoaded) {
  EXPECT_EQ(open("no_such_file.so"), nullptr);
  EXPECT_THAT(error_, HasSubstr("cannot load no_such_file.so: No such file or directory"));
  EXPECT_EQ(open("tests/unit/rtlib/so_engine_test.cpp"), nullptr);
  EXPECT_THAT(error_, HasSubstr("it is not an ELF file"));
  EXPECT_EQ(open(path("")), nullptr);
  EXPECT_THAT(error_, HasSubstr("it is not a regular file"));
  ASSERT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
  EXPECT_EQ(open(path("pipe")), nullptr) << "and nobody waits for its other end";
  EXPECT_THAT(error_, HasSubstr("it is not a regular file"));
}

TEST_F(SoEngineTest, RefusesAFileWithoutSealUnlessAllowed) {
  ASSERT_EQ(replaceFile(path(), contentsOf(RUNG_TEST_SO_GOOD)), "");
  EXPECT_EQ(open(path()), nullptr);
  EXPECT_THAT(error_, HasSubstr("it has no seal"));
  EXPECT_THAT(error_, HasSubstr("rungc seal"));
  EXPECT_NE(open(path(), {.mayLackSeal = true}), nullptr) << error_;
}

TEST_F(SoEngineTest, RefusesDamageWhateverIsAllowed) {
  std::string file = sealed(contentsOf(RUNG_TEST_SO_GOOD));
  file[file.size() / 2] ^= 1;
  ASSERT_EQ(replaceFile(path(), file), "");
  EXPECT_EQ(open(path(), {.mayLackSeal = true}), nullptr);
  EXPECT_THAT(error_, HasSubstr("its content is not what was sealed; build or copy it again"));
}

TEST_F(SoEngineTest, RefusesWhatOthersMayWrite) {
  const std::string file = put(RUNG_TEST_SO_GOOD);
  fs::permissions(file, fs::perms::others_write, fs::perm_options::add);
  EXPECT_EQ(open(file), nullptr);
  EXPECT_THAT(error_, HasSubstr("every user may write to it"));
}

// Signed files are loaded whoever could write them, from a copy.
class Signed : public SoEngineTest {
protected:
  void SetUp() override {
    fs::create_directory(path("keys"));
    ASSERT_EQ(replaceFile(path("keys/maker.pub"), textOf(key_.publicKey())), "");
  }
  std::string putSigned(const SecretKey& key) {
    EXPECT_EQ(replaceFile(path(), sealed(contentsOf(RUNG_TEST_SO_GOOD), &key)), "");
    fs::permissions(path(), fs::perms::others_write, fs::perm_options::add);
    return path();
  }
  const SecretKey key_ = SecretKey::make();
  const SoOptions options_{.keysFolder = path("keys")};
};

TEST_F(Signed, ByAKnownKeyRunsWhoeverMayWriteIt) {
  const auto engine = open(putSigned(key_), options_);
  ASSERT_NE(engine, nullptr) << error_;
  // What was checked runs, whatever happens to the file.
  std::ofstream(path(), std::ios::binary) << std::string(fs::file_size(path()), 'x');
  EXPECT_EQ(countOf(*engine), 2u);
  EXPECT_THAT(fs::read_symlink(loadedNames().back()).string(), HasSubstr("memfd:rung-program"));
}

TEST_F(Signed, ByAnotherKeyIsAsUnsigned) {
  EXPECT_EQ(open(putSigned(SecretKey::make()), options_), nullptr);
  EXPECT_THAT(error_, HasSubstr("every user may write to it"));
  EXPECT_THAT(error_, HasSubstr("is not among the known keys"));
}

TEST_F(Signed, WrongIsRefusedEvenOfOnesOwn) {
  Seal seal{.digest = digestOf(contentsOf(RUNG_TEST_SO_GOOD)), .signature = key_.sign(digestOf("another program"))};
  ASSERT_EQ(replaceFile(path(), contentsOf(RUNG_TEST_SO_GOOD) + bytesOf(seal), {.mode = kProgramMode}), "");
  EXPECT_EQ(open(path(), options_), nullptr);
  EXPECT_THAT(error_, HasSubstr("its signature is not by the key that it names"));
}

// A process with root's rights that serves another user: a copy of load_program that is setuid root, started by nobody.
class Privileged : public SoEngineTest {
protected:
  void SetUp() override {
#ifdef RUNG_TEST_EMULATED
    GTEST_SKIP() << "the kernel of this machine cannot start a program of the other processor";
#endif
    if (geteuid() != 0) GTEST_SKIP() << "needs root, to make a program setuid root";
    fs::permissions(path(""), fs::perms(0755));
    fs::copy_file(RUNG_TEST_LOADER, path("loader"));
    ASSERT_EQ(chmod(path("loader").c_str(), 04755), 0);
    ASSERT_EQ(replaceFile(path("key.pub"), textOf(key_.publicKey())), "");
    if (run("test -u " + path("loader") + " && cp /usr/bin/id " + path("id") + " && chmod u+s " + path("id") +
            " && setpriv --reuid 65534 " + path("id") + " -u") != "0\n")
      GTEST_SKIP() << "setuid programs do not work in " << path("");
  }

  static std::string run(const std::string& command) {
    std::string output;
    std::FILE* pipe = popen(("{ " + command + "; } 2>&1").c_str(), "r");
    if (pipe == nullptr) return "cannot run";
    for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) output += static_cast<char>(c);
    pclose(pipe);
    return output;
  }
  // What the loader says; `before` is done first, by root.
  std::string load(const std::string& file, const std::string& before = "true") const {
    const std::string loader = "setpriv --reuid 65534 --regid 65534 --clear-groups " + path("loader");
    return run(before + " && " + loader + " " + file + " " + path(""));
  }
  // In a name space of its own, where /etc holds nothing but the key.
  std::string loadWithKey(const std::string& file, const std::string& further = "true") const {
    const std::string etc = "mount -t tmpfs -o mode=755 none /etc && mkdir -p /etc/rung/keys.d && cp " +
                            path("key.pub") + " /etc/rung/keys.d && " + further + " && " +
                            "setpriv --reuid 65534 --regid 65534 --clear-groups " + path("loader") + " " + file;
    return run("unshare --mount sh -c '" + etc + "'");
  }
  std::string putNobodys(const std::string& bytes) {
    EXPECT_EQ(replaceFile(path(), bytes, {.mode = kProgramMode}), "");
    EXPECT_EQ(chown(path().c_str(), kNobody, kNobody), 0);
    return path();
  }

  const SecretKey key_ = SecretKey::make();
};

TEST_F(Privileged, RunsWhatIsRootsAndNothingElse) {
  EXPECT_EQ(load(put(RUNG_TEST_SO_GOOD)), "loaded\n");
  EXPECT_THAT(
      load(putNobodys(sealed(contentsOf(RUNG_TEST_SO_GOOD)))),
      HasSubstr("it belongs to user 65534, and a process with root's rights that serves another user runs only"));
  EXPECT_THAT(load(put(RUNG_TEST_SO_GOOD), "chmod g+w " + path()), HasSubstr("its group 0 may write to it"));
}

TEST_F(Privileged, NeverRunsUnsealedFiles) {
  ASSERT_EQ(replaceFile(path(), contentsOf(RUNG_TEST_SO_GOOD), {.mode = kProgramMode}), "");
  EXPECT_THAT(load(path()), HasSubstr("it has no seal"));
}

TEST_F(Privileged, LoadsNoFurtherLibraries) {
  EXPECT_THAT(load(put(RUNG_TEST_SO_SEARCHING)), HasSubstr("it names '/opt/libraries' to load libraries from"));
  EXPECT_THAT(load(put(RUNG_TEST_SO_NEEDING)), HasSubstr("it needs the library 'libsodium.so"));
}

TEST_F(Privileged, TakesKeysOfRootsFolderAlone) {
  const std::string file = putNobodys(sealed(contentsOf(RUNG_TEST_SO_GOOD), &key_));
  EXPECT_THAT(load(file), HasSubstr("is not among the known keys")) << "though the option names the key's folder";
  if (!run("unshare --mount mount -t tmpfs none /mnt").empty())
    GTEST_SKIP() << "this system does not allow name spaces";
  EXPECT_EQ(loadWithKey(file), "loaded\n");
  EXPECT_THAT(loadWithKey(file, "chmod 666 /etc/rung/keys.d/key.pub"), HasSubstr("is not among the known keys"));
  EXPECT_THAT(loadWithKey(file, "chown 65534 /etc/rung/keys.d/key.pub"), HasSubstr("is not among the known keys"));
  EXPECT_THAT(loadWithKey(file, "chmod 777 /etc/rung"), HasSubstr("/etc/rung must be writable only by root"));
  EXPECT_THAT(loadWithKey(file, "chmod 1777 /etc"), HasSubstr("/etc must be writable only by root"));
  EXPECT_THAT(loadWithKey(file, "mv /etc/rung /etc/r && ln -s r /etc/rung"), HasSubstr("/etc/rung: "));
  EXPECT_THAT(loadWithKey(putNobodys(sealed(contentsOf(RUNG_TEST_SO_OTHER), &key_))), HasSubstr("loaded"));
  EXPECT_THAT(loadWithKey(putNobodys(sealed(contentsOf(RUNG_TEST_SO_NEEDING), &key_))),
              HasSubstr("it needs the library"));
}

} // namespace
