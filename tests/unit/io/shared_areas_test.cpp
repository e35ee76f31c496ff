// Shared areas in memory of the process (man. l.15489-15631).
#include "machine/io/shared/shared_areas.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <thread>
#include <vector>

namespace rung::io {
namespace {

using enum AreaResult;
using Bytes = std::vector<uint8_t>;

TEST(SharedAreas, BeginAsZero) {
  SharedAreas areas;
  for (uint32_t area = 0; area < 2; ++area) {
    Bytes all(32000, 0xFF);
    EXPECT_EQ(areas.read(area, 0, all), Done);
    EXPECT_EQ(all, Bytes(32000, 0));
  }
}

TEST(SharedAreas, WhatIsWrittenIsRead) {
  SharedAreas areas;
  EXPECT_EQ(areas.write(0, 100, Bytes{1, 2, 3}), Done);
  Bytes found(5, 0xFF);
  EXPECT_EQ(areas.read(0, 99, found), Done);
  EXPECT_EQ(found, (Bytes{0, 1, 2, 3, 0}));
  EXPECT_EQ(areas.read(1, 99, found), Done);
  EXPECT_EQ(found, Bytes(5, 0));
}

TEST(SharedAreas, NoSuchArea) {
  SharedAreas areas;
  Bytes byte{7};
  EXPECT_EQ(areas.read(2, 0, byte), NoArea);
  EXPECT_EQ(areas.write(65535, 0, byte), NoArea);
  EXPECT_EQ(areas.read(2, 40000, {}), NoArea);
  EXPECT_EQ(byte, Bytes{7});
}

// l.15561: an error is "larger than the length".
TEST(SharedAreas, TheEnd) {
  SharedAreas areas;
  Bytes two{7, 8};
  EXPECT_EQ(areas.write(1, 31998, two), Done);
  EXPECT_EQ(areas.write(1, 31999, two), Outside);
  EXPECT_EQ(areas.read(1, 31999, two), Outside);
  EXPECT_EQ(areas.read(1, 65535, two), Outside);
  EXPECT_EQ(areas.read(1, UINT32_MAX, two), Outside);
  Bytes last(1);
  EXPECT_EQ(areas.read(1, 31999, last), Done);
  EXPECT_EQ(last, Bytes{8});
  EXPECT_EQ(areas.write(0, 0, Bytes(32000, 1)), Done);
  EXPECT_EQ(areas.write(0, 0, Bytes(32001, 2)), Outside);
  EXPECT_EQ(areas.write(0, 0, Bytes(65535, 2)), Outside);
  EXPECT_EQ(areas.bytes(0)[31999], 1);
}

TEST(SharedAreas, SizeZero) {
  SharedAreas areas;
  EXPECT_TRUE(areas.hold(0, true));
  EXPECT_EQ(areas.read(0, 32000, {}), Done);
  EXPECT_EQ(areas.write(0, 0, {}), Done);
  EXPECT_EQ(areas.write(0, 32001, {}), Outside);
}

TEST(SharedAreas, SomebodyHoldsOne) {
  SharedAreas areas;
  Bytes byte{7};
  EXPECT_TRUE(areas.hold(0, true));
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(areas.read(0, 0, byte), Locked);
    EXPECT_EQ(areas.write(0, 0, byte), Locked);
  }
  EXPECT_EQ(areas.read(0, 32000, byte), Outside); // errors go first
  EXPECT_EQ(areas.write(1, 0, byte), Done);
  EXPECT_EQ(areas.bytes(0)[0], 0);
  EXPECT_TRUE(areas.hold(0, false));
  EXPECT_EQ(areas.write(0, 0, byte), Done);
  EXPECT_FALSE(areas.hold(2, true));
}

TEST(SharedAreas, ForWhoLooksBesideTheProgram) {
  SharedAreas areas;
  ASSERT_EQ(areas.bytes(1).size(), 32000u);
  EXPECT_TRUE(areas.bytes(2).empty());
  areas.hold(1, true);
  areas.bytes(1)[5] = 9;
  areas.hold(1, false);
  Bytes byte(1);
  EXPECT_EQ(areas.read(1, 5, byte), Done);
  EXPECT_EQ(byte, Bytes{9});
}

TEST(SharedAreas, PowerUp) {
  SharedAreas areas;
  areas.hold(1, true);
  areas.bytes(1)[5] = 9;
  areas.clear();
  Bytes byte{1};
  EXPECT_EQ(areas.read(1, 5, byte), Done);
  EXPECT_EQ(byte, Bytes{0});
}

TEST(SharedAreas, AnotherThreadSeesWholeWrites) {
  SharedAreas areas;
  constexpr int kRounds = 20000;
  std::thread writer([&] {
    Bytes same(256);
    for (int i = 0; i < kRounds; ++i) {
      std::fill(same.begin(), same.end(), static_cast<uint8_t>(i));
      while (areas.write(0, 64, same) == Locked) std::this_thread::yield();
    }
  });
  Bytes found(256);
  for (int i = 0; i < kRounds; ++i) {
    const AreaResult result = areas.read(0, 64, found);
    ASSERT_TRUE(result == Done || result == Locked);
    ASSERT_EQ(found, Bytes(256, found[0]));
  }
  writer.join();
}

TEST(SharedAreas, AMutexThatWasWrittenOverWhileItWasLocked) {
  pthread_mutex_t mutex;
  makeMutex(mutex);
  for (const int spoiled : {0x00, 0xA5, 0xFF}) {
    ASSERT_EQ(pthread_mutex_trylock(&mutex), 0);
    const pthread_mutex_t asLocked = mutex;
    std::memset(&mutex, spoiled, sizeof mutex);
    EXPECT_EQ(unlockArea(mutex, asLocked), Broken);
  }
  ASSERT_EQ(pthread_mutex_trylock(&mutex), 0);
  const pthread_mutex_t asLocked = mutex;
  EXPECT_EQ(unlockArea(mutex, asLocked), Done);
  pthread_mutex_destroy(&mutex);
}

} // namespace
} // namespace rung::io
