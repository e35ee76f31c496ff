// A process that is killed while it writes images, and files that are damaged behind its back: what is loaded is always
// one whole image, the newest that was reported as written, or the one before when the newest is damaged.
#include <gtest/gtest.h>

#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <thread>

#include "rtlib/retain/retain.h"

namespace {

using namespace rung::runtime;
namespace fs = std::filesystem;
using Bytes = std::vector<uint8_t>;

constexpr uint64_t kLayout = 77;
constexpr uint32_t kSize = 2492; // K, C, T and D of a GSK program

// Every byte depends on the generation: parts of two images never pass for one.
Bytes imageOf(uint64_t generation) {
  Bytes bytes(kSize);
  for (uint32_t i = 0; i < kSize; ++i)
    bytes[i] = static_cast<uint8_t>((generation * 0x9E3779B97F4A7C15u >> 20) + uint64_t{i} * 31);
  return bytes;
}

class RetainCrashTest : public testing::Test {
protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "rung_crash_XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder = pattern;
    base = (folder / "plc").string();
  }
  void TearDown() override { fs::remove_all(folder); }

  // Saves image after image until it is killed, and reports each one that is on disk.
  [[noreturn]] void writer(int report) const {
    RetainStore store(base, kLayout, kSize);
    uint64_t generation = store.load().generation;
    std::string error;
    while (store.save(imageOf(generation + 1), error)) {
      ++generation;
      if (write(report, &generation, sizeof generation) != sizeof generation) break;
    }
    _exit(1);
  }

  // The newest generation that a writer reported before it was killed, `us` after it had saved `images`; `before` when
  // it reported none.
  uint64_t killAfter(int images, std::chrono::microseconds us, uint64_t before) const {
    int ends[2];
    EXPECT_EQ(pipe(ends), 0);
    const pid_t child = fork();
    if (child == 0) {
      close(ends[0]);
      writer(ends[1]);
    }
    close(ends[1]);
    uint64_t newest = before;
    for (int i = 0; i < images; ++i) EXPECT_EQ(read(ends[0], &newest, sizeof newest), ssize_t{sizeof newest});
    std::this_thread::sleep_for(us);
    kill(child, SIGKILL);
    for (uint64_t generation; read(ends[0], &generation, sizeof generation) == sizeof generation;) newest = generation;
    close(ends[0]);
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status));
    return newest;
  }

  RetainImage load() const { return RetainStore(base, kLayout, kSize).load(); }
  std::string newestFile() const { return load().generation % 2 == 1 ? base + ".a" : base + ".b"; }

  fs::path folder;
  std::string base;
};

TEST_F(RetainCrashTest, KilledAtAnyMomentLeavesTheLastImage) {
  std::mt19937 random(1);
  uint64_t newest = 0;
  for (int round = 0; round < 150; ++round) {
    newest = killAfter(round % 2, std::chrono::microseconds(random() % 8000), newest);
    const RetainImage image = load();
    if (newest == 0 && !image.found) continue; // killed before its first image
    ASSERT_TRUE(image.found) << "round " << round << ": " << image.report;
    ASSERT_EQ(image.report, "");
    // The one that was under way may be there already, although nobody was told.
    ASSERT_GE(image.generation, newest);
    ASSERT_LE(image.generation, newest + 1);
    ASSERT_EQ(image.bytes, imageOf(image.generation));
    newest = image.generation;
  }
  EXPECT_GE(newest, 75u); // an image in every second round
}

TEST_F(RetainCrashTest, OneDamagedFileGivesTheImageBefore) {
  std::mt19937 random(2);
  RetainStore store(base, kLayout, kSize);
  std::string error;
  uint64_t generation = 0;
  const auto save = [&] { ASSERT_TRUE(store.save(imageOf(++generation), error)) << error; };
  save();
  save();
  for (int round = 0; round < 300; ++round) {
    save();
    const std::string file = newestFile();
    const Bytes good = [&] {
      std::ifstream in(file, std::ios::binary);
      return Bytes(std::istreambuf_iterator<char>(in), {});
    }();
    Bytes bad = good;
    switch (round % 4) {
    case 0: bad.resize(random() % good.size()); break;                                        // cut
    case 1: bad[random() % good.size()] ^= static_cast<uint8_t>(1u << (random() % 8)); break; // a bit
    case 2:                                                                                   // a lost sector
      std::fill_n(bad.begin() + static_cast<ptrdiff_t>(random() % (good.size() - 512)), 512, uint8_t{0});
      break;
    case 3: bad.insert(bad.end(), 1 + random() % 100, uint8_t{0}); break; // an end that was not cut off
    }
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(bad.data()), static_cast<long>(bad.size()));
    const RetainImage image = load();
    ASSERT_TRUE(image.found);
    ASSERT_EQ(image.generation, generation - 1);
    ASSERT_EQ(image.bytes, imageOf(generation - 1));
    ASSERT_NE(image.report, "");
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(good.data()), static_cast<long>(good.size()));
    ASSERT_EQ(load().bytes, imageOf(generation));
  }
}

TEST_F(RetainCrashTest, AnOldCopyIsNotTakenForNew) {
  RetainStore store(base, kLayout, kSize);
  std::string error;
  ASSERT_TRUE(store.save(imageOf(1), error));
  fs::copy_file(base + ".a", base + ".old");
  for (uint64_t generation = 2; generation <= 5; ++generation) ASSERT_TRUE(store.save(imageOf(generation), error));
  fs::copy_file(base + ".old", base + ".a", fs::copy_options::overwrite_existing); // generation 5 is lost
  EXPECT_EQ(load().generation, 4u);
  EXPECT_EQ(load().bytes, imageOf(4));
  fs::copy_file(base + ".old", base + ".b", fs::copy_options::overwrite_existing);
  EXPECT_EQ(load().bytes, imageOf(1)); // nothing newer is left
}

} // namespace
