// The queue between two threads.
#include "rtlib/core/ring.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

namespace {

using rung::core::FixedRing;

TEST(Ring, KeepsOrderAcrossTheEnd) {
  FixedRing<int, 4> ring;
  int next = 0;
  int expected = 0;
  for (int round = 0; round < 10; ++round) {
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(ring.push(next++));
    for (int i = 0; i < 3; ++i) {
      int value = -1;
      ASSERT_TRUE(ring.pop(value));
      EXPECT_EQ(value, expected++);
    }
  }
  int value = -1;
  EXPECT_FALSE(ring.pop(value));
  EXPECT_EQ(ring.lost(), 0u);
}

TEST(Ring, RefusesAndCountsWhatDoesNotFit) {
  FixedRing<int, 4> ring;
  for (int i = 0; i < 7; ++i) EXPECT_EQ(ring.push(i), i < 4);
  EXPECT_EQ(ring.size(), 4u);
  EXPECT_EQ(ring.lost(), 3u);
  EXPECT_EQ(*ring.peek(), 0);
  EXPECT_EQ(*ring.peek(3), 3);
  EXPECT_EQ(ring.peek(4), nullptr);
  ring.drop();
  EXPECT_EQ(ring.size(), 0u);
  EXPECT_EQ(ring.lost(), 0u);
}

// The room of dropped elements is free once the consumer has looked.
TEST(Ring, DroppedElementsAreNotSeen) {
  FixedRing<int, 4> ring;
  int value = -1;
  for (int round = 0; round < 10; ++round) {
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(ring.push(i));
    ASSERT_TRUE(ring.pop(value));
    ring.drop();
    EXPECT_EQ(ring.size(), 0u);
    EXPECT_EQ(ring.peek(), nullptr);
    EXPECT_TRUE(ring.push(10 + round));
    EXPECT_TRUE(ring.push(20 + round));
    EXPECT_FALSE(ring.push(30 + round));
    EXPECT_EQ(ring.lost(), 1u);
    EXPECT_EQ(ring.size(), 2u);
    EXPECT_EQ(*ring.peek(1), 20 + round);
    ASSERT_TRUE(ring.pop(value));
    EXPECT_EQ(value, 10 + round);
    ASSERT_TRUE(ring.pop(value));
    EXPECT_EQ(value, 20 + round);
    EXPECT_FALSE(ring.pop(value));
  }
  for (int i = 0; i < 4; ++i) EXPECT_TRUE(ring.push(i));
  ring.drop();
  EXPECT_FALSE(ring.pop(value));
  for (int i = 0; i < 4; ++i) EXPECT_TRUE(ring.push(i)) << "all room is free";
}

TEST(Ring, UsesStorageOfTheCaller) {
  int storage[2] = {};
  rung::core::Ring<int> ring(storage, 2);
  EXPECT_TRUE(ring.push(7));
  EXPECT_TRUE(ring.push(8));
  EXPECT_FALSE(ring.push(9));
  EXPECT_EQ(storage[0], 7);
  EXPECT_EQ(storage[1], 8);
}

struct Wide {
  uint64_t number;
  uint64_t inverse; // torn elements would show
};

TEST(Ring, TwoThreadsLoseNothingAndTearNothing) {
  constexpr uint64_t kCount = 300'000;
  FixedRing<Wide, 64> ring;
  std::thread producer([&ring] {
    for (uint64_t i = 0; i < kCount; ++i)
      while (!ring.push({i, ~i})) std::this_thread::yield();
  });
  uint64_t wrong = 0;
  for (uint64_t i = 0; i < kCount; ++i) {
    Wide wide{};
    while (!ring.pop(wide)) std::this_thread::yield();
    if (wide.number != i || wide.inverse != ~i) ++wrong;
  }
  producer.join();
  EXPECT_EQ(wrong, 0u);
  EXPECT_EQ(ring.size(), 0u);
}

// A restart while the other thread reads: its view never holds more than the capacity, and goes on in order.
TEST(Ring, DropsWhileTheConsumerReads) {
  constexpr uint64_t kCount = 200'000;
  FixedRing<Wide, 64> ring;
  std::atomic<bool> done = false;
  std::thread producer([&] {
    for (uint64_t i = 1; i <= kCount; ++i) {
      ring.push({i, ~i});
      if (i % 50 == 0) ring.drop();
      if (i % 1000 == 0) std::this_thread::yield();
    }
    done = true;
  });
  uint64_t wrong = 0;
  uint64_t last = 0;
  while (!done) {
    Wide wide{};
    if (ring.size() > 64) ++wrong;
    if (!ring.pop(wide)) continue;
    if (wide.number <= last || wide.inverse != ~wide.number) ++wrong;
    last = wide.number;
  }
  producer.join();
  EXPECT_EQ(wrong, 0u);
}

} // namespace
