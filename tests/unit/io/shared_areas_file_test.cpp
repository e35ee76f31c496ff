// Shared areas in a file that other programs map: two processes, and what a bad one may do.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <random>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

#include "ir/support/temporary_folder.h"
#include "machine/io/shared/shared_areas.h"

namespace rung::io {
namespace {

using testing::HasSubstr;
using enum AreaResult;
using Bytes = std::vector<uint8_t>;
using Layout = SharedAreas::Layout;

// Another program, which does by hand what the header says.
class Peer {
public:
  explicit Peer(const std::string& path) : fd_(::open(path.c_str(), O_RDWR)) {
    EXPECT_EQ(::flock(fd_, LOCK_SH | LOCK_NB), 0);
    void* const memory = ::mmap(nullptr, sizeof(Layout), PROT_READ | PROT_WRITE, MAP_SHARED, fd_, 0);
    EXPECT_NE(memory, MAP_FAILED);
    layout = static_cast<Layout*>(memory);
  }
  ~Peer() {
    ::munmap(layout, sizeof(Layout));
    ::close(fd_);
  }
  Peer(const Peer&) = delete;
  Peer& operator=(const Peer&) = delete;

  void shorten(off_t size) const { EXPECT_EQ(::ftruncate(fd_, size), 0); }

  Layout* layout = nullptr;

private:
  int fd_;
};

// A process that has locked an area, and holds it until it is killed.
class Holder {
public:
  Holder(const std::string& path, uint32_t area) {
    int pipes[2];
    EXPECT_EQ(::pipe(pipes), 0);
    pid_ = ::fork();
    if (pid_ == 0) {
      Peer peer(path);
      pthread_mutex_lock(&peer.layout->mutexes[area]);
      std::memset(peer.layout->areas[area].bytes.data(), 0x77, 16); // half of what it wanted to write
      if (::write(pipes[1], "x", 1) != 1) ::_exit(1);
      for (;;) ::pause();
    }
    char ready = 0;
    EXPECT_EQ(::read(pipes[0], &ready, 1), 1);
    ::close(pipes[0]);
    ::close(pipes[1]);
  }
  ~Holder() { kill(); }
  Holder(const Holder&) = delete;
  Holder& operator=(const Holder&) = delete;

  void kill() {
    if (pid_ <= 0) return;
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
    pid_ = 0;
  }

private:
  pid_t pid_ = 0;
};

class SharedAreasFile : public testing::Test {
protected:
  std::string path(std::string_view name = "sa") const { return (folder_ / name).string(); }
  std::string refusal(const std::string& name) const {
    SharedAreas areas;
    areas.bytes(0)[3] = 5;
    std::string why = areas.mapFile(name);
    EXPECT_EQ(areas.bytes(0)[3], 5); // the areas are as before
    Bytes byte(1);
    EXPECT_EQ(areas.read(0, 3, byte), Done);
    EXPECT_THAT(why, testing::StartsWith("cannot use " + name + " for shared areas: "));
    return why;
  }

  TemporaryFolder folder_;
};

TEST_F(SharedAreasFile, IsMade) {
  SharedAreas areas;
  areas.bytes(0)[0] = 1;
  ASSERT_EQ(areas.mapFile(path()), "");
  struct stat about{};
  ASSERT_EQ(::stat(path().c_str(), &about), 0);
  EXPECT_EQ(about.st_mode & 07777u, 0600u);
  EXPECT_EQ(about.st_size, static_cast<off_t>(sizeof(Layout)));
  EXPECT_EQ(areas.bytes(0)[0], 0);
  Peer peer(path());
  EXPECT_STREQ(peer.layout->head.magic.data(), "RUNG-SA");
  EXPECT_EQ(peer.layout->head.areasAt, offsetof(Layout, areas));
  EXPECT_EQ(areas.write(1, 31998, Bytes{8, 9}), Done);
  EXPECT_EQ(peer.layout->areas[1].bytes[31999], 9);
  peer.layout->areas[0].bytes[7] = 3;
  Bytes byte(1);
  EXPECT_EQ(areas.read(0, 7, byte), Done);
  EXPECT_EQ(byte, Bytes{3});
}

TEST_F(SharedAreasFile, WhoComesLaterFindsWhatIsThere) {
  SharedAreas first, second;
  ASSERT_EQ(first.mapFile(path()), "");
  EXPECT_EQ(first.write(0, 0, Bytes{5}), Done);
  ASSERT_EQ(second.mapFile(path()), "");
  Bytes byte(1);
  EXPECT_EQ(second.read(0, 0, byte), Done);
  EXPECT_EQ(byte, Bytes{5});
  EXPECT_TRUE(first.hold(0, true)); // this object's alone
  EXPECT_EQ(second.read(0, 0, byte), Done);
}

TEST_F(SharedAreasFile, WhoComesFirstBeginsAnew) {
  {
    SharedAreas areas;
    ASSERT_EQ(areas.mapFile(path()), "");
    EXPECT_EQ(areas.write(0, 0, Bytes{5}), Done);
    Peer peer(path());
    peer.layout->mutexes[0].__data.__lock = 1; // of a thread that is not there: as after a reset of the machine
    Bytes byte(1);
    EXPECT_EQ(areas.read(0, 0, byte), Locked);
    peer.layout->head.version = 99;
  }
  SharedAreas areas;
  ASSERT_EQ(areas.mapFile(path()), "");
  Bytes byte{1};
  EXPECT_EQ(areas.read(0, 0, byte), Done);
  EXPECT_EQ(byte, Bytes{0});
}

TEST_F(SharedAreasFile, AnInterruptedMakingIsDoneAgain) {
  std::ofstream(path()) << std::string(sizeof(Layout), '\0');
  std::filesystem::permissions(path(), std::filesystem::perms(0600));
  SharedAreas areas;
  EXPECT_EQ(areas.mapFile(path()), "");
  EXPECT_EQ(areas.write(0, 0, Bytes{5}), Done);
}

TEST_F(SharedAreasFile, FilesThatAreRefused) {
  const auto make = [&](const char* name, size_t size, unsigned mode) {
    std::ofstream(path(name)) << std::string(size, 'x');
    std::filesystem::permissions(path(name), std::filesystem::perms(mode));
    return path(name);
  };
  EXPECT_THAT(refusal(make("readable", 0, 0640)), HasSubstr("others than its user may use it, expected mode 0600"));
  EXPECT_THAT(refusal(make("writable", 0, 0602)), HasSubstr("expected mode 0600"));
  EXPECT_THAT(refusal(make("short", 100, 0600)),
              HasSubstr("it has 100 bytes, expected " + std::to_string(sizeof(Layout))));
  EXPECT_THAT(refusal(make("long", sizeof(Layout) + 1, 0600)), HasSubstr("it is not a file of shared areas"));
  EXPECT_THAT(refusal(make("other", sizeof(Layout), 0600)), HasSubstr("it is not a file of shared areas of version 1"));
  EXPECT_EQ(folder_.contentsOf("other"), std::string(sizeof(Layout), 'x')); // not touched
  std::filesystem::create_symlink(path("other"), path("link"));
  EXPECT_THAT(refusal(path("link")), HasSubstr("it is a symbolic link"));
  std::filesystem::create_symlink(path("nowhere"), path("dangling"));
  EXPECT_THAT(refusal(path("dangling")), HasSubstr("it is a symbolic link"));
  EXPECT_FALSE(std::filesystem::exists(path("nowhere")));
  std::filesystem::create_hard_link(path("other"), path("hard"));
  EXPECT_THAT(refusal(path("hard")), HasSubstr("it is not a file of its own"));
  ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
  EXPECT_THAT(refusal(path("pipe")), HasSubstr("it is not a file of its own"));
  EXPECT_THAT(refusal(path("")), HasSubstr("directory"));
  EXPECT_THAT(refusal(path("missing/sa")), HasSubstr("No such file"));
}

TEST_F(SharedAreasFile, AFileThatSomebodyKeepsLocked) {
  {
    ASSERT_EQ(SharedAreas().mapFile(path()), "");
  }
  const int fd = ::open(path().c_str(), O_RDWR);
  ASSERT_EQ(::flock(fd, LOCK_EX), 0);
  EXPECT_THAT(refusal(path()), HasSubstr("another program keeps it locked"));
  ::close(fd);
}

TEST_F(SharedAreasFile, AHeadOfAnotherKindWhileItIsUsed) {
  SharedAreas areas;
  ASSERT_EQ(areas.mapFile(path()), "");
  Peer peer(path());
  peer.layout->head.version = 2;
  EXPECT_THAT(refusal(path()), HasSubstr("it is not a file of shared areas of version 1"));
}

TEST_F(SharedAreasFile, AProcessThatHoldsAnAreaAndDies) {
  SharedAreas areas;
  ASSERT_EQ(areas.mapFile(path()), "");
  Holder holder(path(), 0);
  Bytes found(16, 1);
  for (int i = 0; i < 10000; ++i) ASSERT_EQ(areas.read(0, 0, found), Locked); // for ever: repeat
  EXPECT_EQ(areas.write(0, 0, found), Locked);
  EXPECT_EQ(areas.write(1, 0, found), Done);
  EXPECT_EQ(found, Bytes(16, 1));
  holder.kill();
  EXPECT_EQ(areas.read(0, 0, found), Done);
  EXPECT_EQ(found, Bytes(16, 0x77)); // what it left
  EXPECT_EQ(areas.write(0, 0, Bytes(16, 2)), Done);
  Holder another(path(), 0); // the mutex is as good as new
  EXPECT_EQ(areas.read(0, 0, found), Locked);
}

TEST_F(SharedAreasFile, TwoProcessesSeeWholeWrites) {
  SharedAreas areas;
  ASSERT_EQ(areas.mapFile(path()), "");
  const pid_t child = ::fork();
  if (child == 0) {
    SharedAreas own;
    if (!own.mapFile(path()).empty()) ::_exit(1);
    for (int i = 1;; ++i) // until it is killed
      if (own.write(1, 1000, Bytes(512, static_cast<uint8_t>(i))) > Outside) ::sched_yield();
  }
  Bytes found(512);
  int done = 0;
  for (int i = 0; i < 10'000'000 && done < 20000; ++i) {
    const AreaResult result = areas.read(1, 1000, found);
    ASSERT_TRUE(result == Done || result == Locked);
    ASSERT_EQ(found, Bytes(512, found[0]));
    done += result == Done ? 1 : 0;
  }
  EXPECT_EQ(done, 20000);
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  EXPECT_EQ(areas.read(1, 1000, found), Done); // wherever it was killed
}

TEST_F(SharedAreasFile, ASpoiledHead) {
  SharedAreas areas;
  ASSERT_EQ(areas.mapFile(path()), "");
  Peer peer(path());
  const SharedAreas::Head sound = peer.layout->head;
  for (size_t byte = 0; byte < sizeof sound; ++byte) {
    reinterpret_cast<uint8_t*>(&peer.layout->head)[byte] ^= 0x40;
    Bytes found(1, 9);
    EXPECT_EQ(areas.read(0, 0, found), Broken);
    EXPECT_EQ(areas.write(1, 0, found), Broken);
    EXPECT_EQ(found, Bytes{9});
    peer.layout->head = sound;
    EXPECT_EQ(areas.read(0, 0, found), Done);
  }
}

TEST_F(SharedAreasFile, AShortenedFile) {
  SharedAreas areas;
  ASSERT_EQ(areas.mapFile(path()), "");
  const Peer peer(path());
  for (const off_t size : {static_cast<off_t>(sizeof(Layout)) - 1, off_t{4096}, off_t{0}}) {
    peer.shorten(size);
    Bytes found(1);
    EXPECT_EQ(areas.read(0, 0, found), Broken) << size;
    EXPECT_EQ(areas.write(1, 31000, found), Broken) << size;
  }
}

TEST_F(SharedAreasFile, ASpoiledMutex) {
  SharedAreas areas;
  ASSERT_EQ(areas.mapFile(path()), "");
  Peer peer(path());
  pthread_mutex_t& mutex = peer.layout->mutexes[0];
  Bytes found(1);
  std::memset(&mutex, 0, sizeof mutex); // an ordinary mutex
  EXPECT_EQ(areas.read(0, 0, found), Broken);
  std::memset(&mutex, 0xFF, sizeof mutex);
  EXPECT_EQ(areas.read(0, 0, found), Broken);
  EXPECT_EQ(areas.read(1, 0, found), Done);
  makeMutex(mutex);
  EXPECT_EQ(areas.read(0, 0, found), Done);
}

TEST_F(SharedAreasFile, AnyBytesInAMutex) {
  SharedAreas areas;
  ASSERT_EQ(areas.mapFile(path()), "");
  Peer peer(path());
  pthread_mutex_t& mutex = peer.layout->mutexes[0];
  makeMutex(mutex);
  const pthread_mutex_t sound = mutex;
  std::mt19937 random(1);
  int locked = 0, done = 0;
  for (int i = 0; i < 20000; ++i) {
    std::array<uint8_t, sizeof mutex> bytes{};
    for (uint8_t& byte : bytes) byte = static_cast<uint8_t>(random());
    std::memcpy(&mutex, bytes.data(), sizeof mutex);
    mutex.__data.__kind = sound.__data.__kind;
    if (i % 2 == 0) mutex.__data.__lock = sound.__data.__lock;
    Bytes found(1);
    const AreaResult result = areas.read(0, 0, found);
    EXPECT_TRUE(result == Done || result == Locked || result == Broken);
    locked += result == Locked ? 1 : 0;
    done += result == Done ? 1 : 0;
  }
  EXPECT_GT(locked, 100);
  EXPECT_GT(done, 100);
  mutex = sound;
  Bytes found(1);
  EXPECT_EQ(areas.read(0, 0, found), Done);
}

} // namespace
} // namespace rung::io
