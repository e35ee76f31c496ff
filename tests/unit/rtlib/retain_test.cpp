// The retained image on disk: generations, every kind of damage, and the saving thread.
#include "rtlib/retain/retain.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sched.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>
#include <zlib.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <thread>

#include "tests/support/patience.h"
#include "tests/unit/rtlib/test_program.h"

namespace {

using namespace rung::runtime;
using rung::test::TestProgram;
using testing::HasSubstr;
namespace fs = std::filesystem;

using Bytes = std::vector<uint8_t>;
constexpr uint64_t kLayout = 0x1122334455667788;

class RetainTest : public testing::Test {
protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "rung_retain_XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder = pattern;
    base = (folder / "plc").string();
  }
  void TearDown() override { fs::remove_all(folder); }

  RetainStore store(uint64_t layout = kLayout, uint32_t size = 3) { return {base, layout, size}; }
  void save(RetainStore& to, const Bytes& bytes) {
    std::string error;
    ASSERT_TRUE(to.save(bytes, error)) << error;
  }
  // Three saves: generation 1 and 3 in .a, 2 in .b.
  void saveThree() {
    RetainStore s = store();
    for (uint8_t i = 1; i <= 3; ++i) save(s, {i, i, i});
  }
  void change(const char* ending, std::streamoff at, char value) {
    std::fstream file(base + ending, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(at);
    file.put(value);
    ASSERT_TRUE(file.good());
  }
  RetainImage load() { return store().load(); }
  std::string saveError(RetainStore& to, const Bytes& bytes = {7, 7, 7}) {
    std::string error;
    EXPECT_FALSE(to.save(bytes, error));
    EXPECT_NE(error, "");
    return error;
  }
  // Neither half a file nor one that should be gone.
  void expectNothingLeft() {
    for (const auto& entry : fs::directory_iterator(folder))
      EXPECT_NE(entry.path().extension(), ".tmp") << entry.path();
  }

  fs::path folder;
  std::string base;
};

TEST_F(RetainTest, NothingThereIsAQuietColdStart) {
  const RetainImage image = load();
  EXPECT_FALSE(image.found);
  EXPECT_EQ(image.report, "");
}

TEST_F(RetainTest, NewestGenerationWins) {
  saveThree();
  const RetainImage image = load();
  EXPECT_TRUE(image.found);
  EXPECT_EQ(image.bytes, (Bytes{3, 3, 3}));
  EXPECT_EQ(image.generation, 3u);
  EXPECT_EQ(image.report, "");
  RetainStore next = store(); // a new process goes on counting
  save(next, {4, 4, 4});
  EXPECT_EQ(load().generation, 4u);
  EXPECT_EQ(load().bytes, (Bytes{4, 4, 4}));
}

// Any changed byte of the newest file makes the older one count.
TEST_F(RetainTest, EveryDamagedByteIsNoticed) {
  saveThree();
  const auto size = static_cast<std::streamoff>(fs::file_size(base + ".a"));
  ASSERT_EQ(size, 35);
  for (std::streamoff at = 0; at < size; ++at) {
    SCOPED_TRACE(at);
    std::ifstream in(base + ".a", std::ios::binary);
    in.seekg(at);
    const char good = static_cast<char>(in.get());
    change(".a", at, static_cast<char>(good ^ 0x10));
    const RetainImage image = load();
    EXPECT_TRUE(image.found);
    EXPECT_EQ(image.bytes, (Bytes{2, 2, 2}));
    EXPECT_THAT(image.report, HasSubstr("plc.a"));
    EXPECT_THAT(image.report, HasSubstr("generation 2"));
    change(".a", at, good);
  }
  EXPECT_EQ(load().bytes, (Bytes{3, 3, 3}));
}

TEST_F(RetainTest, TruncatedAtAnyLengthIsNoticed) {
  saveThree();
  for (uintmax_t size = 35; size-- > 0;) {
    SCOPED_TRACE(size);
    fs::resize_file(base + ".a", size);
    EXPECT_EQ(load().bytes, (Bytes{2, 2, 2}));
  }
}

TEST_F(RetainTest, BothDamagedIsAReportedColdStart) {
  saveThree();
  change(".a", 34, 77);
  change(".b", 20, 77);
  const RetainImage image = load();
  EXPECT_FALSE(image.found);
  EXPECT_THAT(image.report, HasSubstr("plc.a: wrong checksum"));
  EXPECT_THAT(image.report, HasSubstr("plc.b: wrong checksum"));
  EXPECT_THAT(image.report, HasSubstr("starting cold"));
}

// No image could be newer, so saving would never be seen again.
TEST_F(RetainTest, AnImageWithTheLastGenerationIsNotTaken) {
  saveThree();
  std::fstream file(base + ".a", std::ios::in | std::ios::out | std::ios::binary);
  Bytes bytes(std::istreambuf_iterator<char>(file), {});
  ASSERT_EQ(bytes.size(), 35u);
  std::fill_n(bytes.begin() + 16, 8, uint8_t{0xFF});
  const uLong sum = crc32(crc32(0, bytes.data(), 28), bytes.data() + 32, 3);
  for (size_t i = 0; i < 4; ++i) bytes[28 + i] = static_cast<uint8_t>(sum >> (8 * i));
  file.clear();
  file.seekp(0);
  file.write(reinterpret_cast<const char*>(bytes.data()), 35);
  file.close();
  RetainStore s = store();
  const RetainImage image = s.load();
  EXPECT_THAT(image.report, HasSubstr("plc.a: wrong generation"));
  EXPECT_EQ(image.bytes, (Bytes{2, 2, 2}));
  save(s, {9, 9, 9});
  EXPECT_EQ(load().bytes, (Bytes{9, 9, 9}));
}

TEST_F(RetainTest, SavingOverwritesTheDamagedFile) {
  saveThree();
  change(".a", 34, 77);
  RetainStore s = store();
  EXPECT_EQ(s.load().bytes, (Bytes{2, 2, 2}));
  save(s, {9, 9, 9});
  EXPECT_EQ(load().bytes, (Bytes{9, 9, 9}));
  EXPECT_EQ(load().report, "");
  change(".a", 34, 77); // the good one was not touched
  EXPECT_EQ(load().bytes, (Bytes{2, 2, 2}));
}

TEST_F(RetainTest, SavingWithoutLoadingKeepsTheOrder) {
  saveThree();
  RetainStore s = store();
  save(s, {8, 8, 8});
  EXPECT_EQ(load().bytes, (Bytes{8, 8, 8}));
  EXPECT_EQ(load().generation, 4u);
}

TEST_F(RetainTest, LeftoverOfACrashIsIgnored) {
  saveThree();
  std::ofstream(base + ".b.tmp") << "half a fi";
  EXPECT_EQ(load().bytes, (Bytes{3, 3, 3}));
  EXPECT_EQ(load().report, "");
  RetainStore s = store();
  save(s, {4, 4, 4});
  EXPECT_EQ(load().bytes, (Bytes{4, 4, 4}));
  expectNothingLeft();
}

// Machines have such files.
TEST_F(RetainTest, TheFormatStaysTheSame) {
  RetainStore s = store();
  save(s, {1, 2, 3});
  std::ifstream in(base + ".a", std::ios::binary);
  const Bytes file(std::istreambuf_iterator<char>(in), {});
  EXPECT_EQ(file, (Bytes{'R', 'U', 'N', 'G', 'R', 'E', 'T', '1', 0x88, 0x77, 0x66, 0x55, 0x44, 0x33, 0x22, 0x11, 1, 0,
                         0,   0,   0,   0,   0,   0,   3,   0,   0,    0,    0xB0, 0xCE, 0xD8, 0x63, 1,    2,    3}));
}

TEST_F(RetainTest, AnotherLayoutOrSizeIsNotTaken) {
  saveThree();
  const RetainImage other = store(kLayout + 1).load();
  EXPECT_FALSE(other.found);
  EXPECT_THAT(other.report, HasSubstr("other retained cells"));
  EXPECT_FALSE(store(kLayout, 4).load().found);
  // After the other program saved, the old image is out of date.
  RetainStore s = store(kLayout + 1);
  save(s, {5, 5, 5});
  EXPECT_FALSE(load().found);
  EXPECT_TRUE(store(kLayout + 1).load().found);
}

TEST_F(RetainTest, ErrorsAreReported) {
  std::string error;
  RetainStore s = store();
  EXPECT_FALSE(s.save(Bytes{1}, error));
  EXPECT_THAT(error, HasSubstr("wrong size"));
  RetainStore nowhere((folder / "none" / "plc").string(), kLayout, 3);
  EXPECT_FALSE(nowhere.save(Bytes{1, 2, 3}, error));
  EXPECT_THAT(error, HasSubstr("No such file"));
}

// ---- places that do not work ---------------------------------------------------------------------------------------

// What a link leads to is neither read nor written.
TEST_F(RetainTest, LinksAreNotFollowed) {
  saveThree();
  fs::rename(base + ".a", folder / "elsewhere");
  fs::create_symlink(folder / "elsewhere", base + ".a");
  EXPECT_EQ(load().bytes, (Bytes{2, 2, 2}));
  EXPECT_THAT(load().report, HasSubstr("plc.a: it is a symbolic link; using the other image"));
  std::ofstream(folder / "victim") << "untouched";
  fs::create_symlink(folder / "victim", base + ".a.tmp");
  RetainStore s = store();
  save(s, {4, 4, 4});
  save(s, {5, 5, 5});
  EXPECT_EQ(load().bytes, (Bytes{5, 5, 5}));
  EXPECT_EQ(load().report, "");
  EXPECT_EQ(fs::file_size(folder / "victim"), 9u);
  fs::remove(base + ".lock");
  fs::create_symlink(folder / "victim", base + ".lock");
  RetainStore another = store();
  EXPECT_THAT(saveError(another), HasSubstr("plc.lock: it is a symbolic link"));
}

TEST_F(RetainTest, APipeBlocksNothing) {
  saveThree();
  fs::remove(base + ".a");
  ASSERT_EQ(mkfifo((base + ".a").c_str(), 0600), 0);
  ASSERT_EQ(mkfifo((base + ".a.tmp").c_str(), 0600), 0);
  EXPECT_THAT(load().report, HasSubstr("plc.a: it is not a regular file; using the other image"));
  RetainStore s = store();
  save(s, {4, 4, 4});
  EXPECT_EQ(load().bytes, (Bytes{4, 4, 4}));
  fs::remove(base + ".lock");
  ASSERT_EQ(mkfifo((base + ".lock").c_str(), 0600), 0);
  RetainStore another = store();
  EXPECT_THAT(saveError(another), HasSubstr("plc.lock: it is not a regular file"));
}

TEST_F(RetainTest, AFolderInTheWay) {
  saveThree();
  RetainStore s = store();
  fs::create_directory(base + ".b.tmp");
  EXPECT_THAT(saveError(s), HasSubstr("cannot write " + base + ".b.tmp: "));
  fs::remove(base + ".b.tmp");
  fs::remove(base + ".b");
  fs::create_directories(base + ".b/full");
  EXPECT_THAT(saveError(s), HasSubstr("cannot write " + base + ".b: ")); // renaming fails
  expectNothingLeft();
  EXPECT_EQ(load().bytes, (Bytes{3, 3, 3}));
  fs::remove_all(base + ".b");
  save(s, {4, 4, 4});
  EXPECT_EQ(load().bytes, (Bytes{4, 4, 4}));
  EXPECT_EQ(load().generation, 4u);
}

// A write that ends in the middle, as on a full disk: a limit on its size does the same and needs no rights.
TEST_F(RetainTest, AWriteThatEndsInTheMiddle) {
  saveThree();
  RetainStore s = store();
  rlimit old{};
  getrlimit(RLIMIT_FSIZE, &old);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small = {20, old.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  const std::string error = saveError(s);
  setrlimit(RLIMIT_FSIZE, &old);
  std::signal(SIGXFSZ, handler);
  EXPECT_THAT(error, HasSubstr("cannot write " + base + ".b: File too large"));
  expectNothingLeft();
  EXPECT_EQ(load().bytes, (Bytes{3, 3, 3}));
  EXPECT_EQ(load().report, "");
  save(s, {4, 4, 4});
  EXPECT_EQ(load().generation, 4u);
}

// Runs `work` in a process of its own; what it returns is the exit status.
template <class Work>
int inChild(Work work) {
  const pid_t child = fork();
  if (child == 0) _exit(work());
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}
constexpr int kCannot = 77;

TEST_F(RetainTest, AFullDisk) {
  const int status = inChild([&] {
    if (unshare(CLONE_NEWNS) != 0 || mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0 ||
        mount("full", folder.c_str(), "tmpfs", 0, "size=64k") != 0)
      return kCannot;
    saveThree();
    RetainStore s = store();
    {
      std::ofstream fill(folder / "fill", std::ios::binary);
      while (fill.put('x').flush()) {
      }
    }
    EXPECT_THAT(saveError(s), HasSubstr("No space left on device"));
    expectNothingLeft();
    EXPECT_EQ(load().bytes, (Bytes{3, 3, 3}));
    fs::remove(folder / "fill");
    save(s, {4, 4, 4});
    EXPECT_EQ(load().bytes, (Bytes{4, 4, 4}));
    return HasFailure() ? 1 : 0;
  });
  if (status == kCannot) GTEST_SKIP() << "only root can make a small disk";
  EXPECT_EQ(status, 0);
}

// In a folder such as /tmp, where everybody may write and nobody may remove what is another's.
TEST_F(RetainTest, ATemporaryFileOfSomebodyElse) {
  if (geteuid() != 0) GTEST_SKIP() << "only root can make files of another user";
  fs::permissions(folder, fs::perms::all | fs::perms::sticky_bit);
  std::ofstream(base + ".a.tmp") << "not yours";
  const int status = inChild([&] {
    if (setgid(65534) != 0 || setuid(65534) != 0) return kCannot;
    RetainStore s = store();
    EXPECT_THAT(saveError(s), HasSubstr("cannot write " + base + ".a.tmp: Operation not permitted"));
    return HasFailure() ? 1 : 0;
  });
  EXPECT_EQ(status, 0);
  EXPECT_EQ(fs::file_size(base + ".a.tmp"), 9u);
}

// ---- one process at a time -----------------------------------------------------------------------------------------

TEST_F(RetainTest, TheSecondStoreIsRefused) {
  std::string error;
  {
    RetainStore first = store();
    ASSERT_TRUE(first.lock(error)) << error;
    for (uint8_t i = 1; i <= 5; ++i) save(first, {i, i, i}); // the files are replaced, the lock is not
    RetainStore second = store();
    EXPECT_THAT(saveError(second, {9, 9, 9}),
                testing::StartsWith(base + " is in use by another process, which holds " + base + ".lock"));
    EXPECT_EQ(load().bytes, (Bytes{5, 5, 5}));
    RetainStore third = std::move(first); // moving does not free it
    EXPECT_FALSE(second.lock(error));
    EXPECT_TRUE(third.lock(error));
  }
  RetainStore next = store();
  EXPECT_TRUE(next.lock(error)) << error;
}

TEST_F(RetainTest, ACrashFreesTheLock) {
  int ready[2];
  ASSERT_EQ(pipe(ready), 0);
  const pid_t child = fork();
  if (child == 0) {
    RetainStore s = store();
    std::string error;
    if (s.save(Bytes{1, 1, 1}, error) && write(ready[1], "r", 1) == 1) pause();
    _exit(1);
  }
  char byte = 0;
  ASSERT_EQ(read(ready[0], &byte, 1), 1);
  RetainStore s = store();
  EXPECT_THAT(saveError(s), HasSubstr("in use by another process"));
  kill(child, SIGKILL);
  int status = 0;
  waitpid(child, &status, 0);
  save(s, {2, 2, 2});
  EXPECT_EQ(load().generation, 2u);
  close(ready[0]);
  close(ready[1]);
}

// What another process has saved since we looked counts.
TEST_F(RetainTest, LockingLooksAgain) {
  RetainStore late = store();
  EXPECT_FALSE(late.load().found);
  saveThree();
  save(late, {4, 4, 4});
  EXPECT_EQ(load().generation, 4u);
  EXPECT_EQ(load().bytes, (Bytes{4, 4, 4}));
}

TEST_F(RetainTest, ImagesThatAreGoneAreReported) {
  std::string error;
  {
    RetainStore first = store();
    ASSERT_TRUE(first.lock(error));
    EXPECT_EQ(first.load().report, ""); // a first start
  }
  saveThree();
  fs::remove(base + ".a");
  fs::remove(base + ".b");
  RetainStore next = store();
  ASSERT_TRUE(next.lock(error));
  const RetainImage image = next.load();
  EXPECT_FALSE(image.found);
  EXPECT_THAT(image.report, HasSubstr("plc.a and .b are gone; starting cold"));
}

// ---- saver ---------------------------------------------------------------------------------------------------------

class SaverTest : public RetainTest {
protected:
  void SetUp() override {
    RetainTest::SetUp();
    test.addPacked("R", 1, 8, 0);
    test.retains = {{1, 3}};
    test.link();
    instance = std::make_unique<Instance>(test.program);
  }
  std::unique_ptr<RetainChannel> channel() {
    const RetainMap map(test.program);
    return std::make_unique<RetainChannel>(kLayout, map.rawSize(), map.size(),
                                           [map](auto raw, auto image) { map.pack(raw, image); });
  }
  std::unique_ptr<RetainSaver> saver(int periodMs) {
    return std::make_unique<RetainSaver>(std::make_unique<RetainStore>(store()), channel(),
                                         std::chrono::milliseconds(periodMs));
  }
  uint64_t offer(RetainSaver& to, uint32_t value) {
    EXPECT_EQ(instance->write(intRef(0, 1, 8), value), std::nullopt);
    return to.offer(*instance);
  }
  // Waits for what the saver does by itself.
  template <class Condition>
  static bool becomes(Condition condition) {
    return rung::test::soon(condition);
  }

  TestProgram test;
  std::unique_ptr<Instance> instance;
};

TEST_F(SaverTest, SavesWhatWasOffered) {
  {
    const auto s = saver(1);
    for (uint32_t i = 1; i <= 5; ++i) {
      const uint64_t ticket = offer(*s, i);
      EXPECT_EQ(ticket, i);
      ASSERT_TRUE(becomes([&] { return s->stored() == ticket; }));
    }
    EXPECT_EQ(s->saved(), 5u);
    EXPECT_EQ(s->failed(), 0u);
    EXPECT_FALSE(s->failing());
  }
  EXPECT_EQ(load().bytes, (Bytes{5, 0, 0}));
  EXPECT_EQ(load().generation, 5u);
}

TEST_F(SaverTest, SignalsAreForOthers) {
  sigset_t one, before, pending;
  sigemptyset(&one);
  sigaddset(&one, SIGUSR1);
  ASSERT_EQ(pthread_sigmask(SIG_UNBLOCK, &one, &before), 0);
  const auto s = saver(1);
  const uint64_t ticket = offer(*s, 1);
  ASSERT_TRUE(becomes([&] { return s->stored() == ticket; }));
  ASSERT_EQ(pthread_sigmask(SIG_BLOCK, &one, nullptr), 0);
  ASSERT_EQ(kill(getpid(), SIGUSR1), 0); // ends the process where a thread takes it
  sigpending(&pending);
  EXPECT_EQ(sigismember(&pending, SIGUSR1), 1);
  int taken = 0;
  sigwait(&one, &taken);
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

// While the saver does not look, the newest image takes the place of those before.
TEST_F(SaverTest, TheNewestIsSaved) {
  {
    const auto s = saver(3600'000);
    EXPECT_TRUE(s->flush()); // nothing was offered
    for (uint32_t i = 1; i <= 100; ++i) EXPECT_EQ(offer(*s, i), i);
    EXPECT_FALSE(s->taken());
    EXPECT_EQ(s->stored(), 0u);
    EXPECT_TRUE(s->flush());
    EXPECT_TRUE(s->taken());
    EXPECT_EQ(s->stored(), 100u);
    EXPECT_EQ(s->saved(), 1u);
    EXPECT_EQ(offer(*s, 100), 101u);
    EXPECT_TRUE(s->flush());
    EXPECT_EQ(s->stored(), 101u); // it is on disk
    EXPECT_EQ(s->saved(), 1u);    // already
    offer(*s, 102);
  } // the end saves too
  EXPECT_EQ(load().bytes, (Bytes{102, 0, 0}));
  EXPECT_EQ(load().generation, 2u);
}

TEST_F(SaverTest, AFailureIsPublishedAndTriedAgain) {
  const auto s = saver(1);
  ASSERT_TRUE(becomes([&] { return offer(*s, 1), s->stored() > 0; }));
  for (const char* ending : {".a.tmp", ".b.tmp"}) fs::create_directory(base + ending);
  const uint64_t ticket = offer(*s, 2);
  ASSERT_TRUE(becomes([&] { return s->failed() >= 3; })); // by itself
  EXPECT_TRUE(s->failing());
  EXPECT_LT(s->stored(), ticket);
  EXPECT_THAT(s->problem(), HasSubstr("cannot write " + base));
  char shortText[6];
  ASSERT_EQ(s->problem(shortText), 6u);
  EXPECT_EQ(std::string_view(shortText, 6), "cannot");
  EXPECT_FALSE(s->flush());
  EXPECT_EQ(load().bytes, (Bytes{1, 0, 0}));
  for (const char* ending : {".a.tmp", ".b.tmp"}) fs::remove(base + ending);
  ASSERT_TRUE(becomes([&] { return !s->failing(); })); // nothing is offered any more
  EXPECT_EQ(s->stored(), ticket);
  EXPECT_EQ(load().bytes, (Bytes{2, 0, 0}));
}

// Another program takes over, and the former one again.
TEST_F(SaverTest, WhatIsOfferedGoesThroughTheLaneOfTheProgram) {
  std::unique_ptr<RetainSaver> s = saver(3600 * 1000);
  const auto one = [](std::span<const uint8_t> raw, std::span<uint8_t> image) { image[0] = raw[0]; };
  auto other = std::make_unique<RetainChannel>(kLayout + 1, 2, 1, one);
  const auto offerOther = [&](uint8_t value) { s->offerFrom([=](std::span<uint8_t> to) { to[0] = value; }); };
  offer(*s, 1);
  EXPECT_TRUE(s->flush());
  offer(*s, 2);
  s->swapChannel(other);
  EXPECT_TRUE(s->flush()) << "nothing was offered by the new program";
  EXPECT_EQ(load().bytes, (Bytes{2, 0, 0})) << "what the former one offered last is the newest";
  offerOther(3);
  EXPECT_TRUE(s->flush());
  EXPECT_EQ(store(kLayout + 1, 1).load().bytes, (Bytes{3}));
  s->swapChannel(other);
  EXPECT_TRUE(s->flush());
  EXPECT_EQ(s->saved(), 3u) << "what the former program offered last is older";
  offer(*s, 4);
  EXPECT_TRUE(s->flush());
  EXPECT_EQ(load().bytes, (Bytes{4, 0, 0}));
  s->settle();
}

// Fails, although what it was given is on disk then.
class FailsAfterWriting final : public RetainTarget {
public:
  FailsAfterWriting(std::vector<Bytes>& written, bool& fails) : written_(&written), fails_(&fails) {}
  bool save(std::span<const uint8_t> bytes, const RetainLayout&, std::string& error) override {
    written_->emplace_back(bytes.begin(), bytes.end());
    error = "fsync";
    return !*fails_;
  }

private:
  std::vector<Bytes>* written_;
  bool* fails_;
};

TEST_F(SaverTest, WhatWasOfferedLastIsSavedWithoutItsChannel) {
  bool fails = true;
  std::vector<Bytes> written;
  RetainSaver s(std::make_unique<FailsAfterWriting>(written, fails), channel(), std::chrono::milliseconds(0));
  offer(s, 1);
  std::unique_ptr<RetainChannel> other = channel();
  s.swapChannel(other);
  s.settle();
  other.reset();
  EXPECT_FALSE(s.flush());
  fails = false;
  EXPECT_TRUE(s.flush());
  EXPECT_EQ(written.back(), (Bytes{1, 0, 0}));
}

TEST_F(SaverTest, WithoutPowerNothingIsSaved) {
  bool fails = false;
  std::vector<Bytes> written;
  {
    RetainSaver s(std::make_unique<FailsAfterWriting>(written, fails), channel(), std::chrono::milliseconds(0));
    offer(s, 1);
    s.abandon();
  }
  EXPECT_TRUE(written.empty());
}

TEST_F(SaverTest, ALaneOfASaverBeforeHoldsNothingNew) {
  std::unique_ptr<RetainChannel> former = channel();
  {
    std::unique_ptr<RetainSaver> s = saver(3600 * 1000);
    for (uint32_t i = 0; i < 100; ++i) offer(*s, 9);
    s->swapChannel(former);
  }
  std::unique_ptr<RetainSaver> s = saver(3600 * 1000);
  s->swapChannel(former);
  EXPECT_TRUE(s->flush());
  EXPECT_EQ(s->saved(), 0u);
}

TEST_F(SaverTest, AfterAFailureTheOldImageIsWrittenAgain) {
  std::vector<Bytes> written;
  bool fails = false;
  RetainSaver s(std::make_unique<FailsAfterWriting>(written, fails), channel(), std::chrono::hours(1));
  offer(s, 1);
  EXPECT_TRUE(s.flush());
  fails = true;
  offer(s, 2);
  EXPECT_FALSE(s.flush());
  fails = false;
  const uint64_t ticket = offer(s, 1);
  EXPECT_TRUE(s.flush());
  EXPECT_EQ(s.stored(), ticket);
  EXPECT_EQ(written, (std::vector<Bytes>{{1, 0, 0}, {2, 0, 0}, {1, 0, 0}}));
}

class Throws final : public RetainTarget {
public:
  bool save(std::span<const uint8_t>, const RetainLayout&, std::string&) override { throw std::bad_alloc(); }
};

TEST_F(SaverTest, NothingThrownLeavesTheThread) {
  RetainSaver s(std::make_unique<Throws>(), channel(), std::chrono::milliseconds(1));
  offer(s, 1);
  EXPECT_FALSE(s.flush());
  EXPECT_EQ(s.problem(), std::bad_alloc().what());
}

} // namespace
