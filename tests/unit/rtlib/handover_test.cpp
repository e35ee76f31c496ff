// What two threads hand to each other: whole, in order, and without waiting.
#include "rtlib/core/handover.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace rung::core {
namespace {

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
  Ring<int> ring(storage, 2);
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

TEST(SlotRing, GivesSlotsInTheirOrderUntilAllAreFull) {
  SlotRing ring(3);
  EXPECT_EQ(ring.front(), std::nullopt);
  for (size_t number = 0; number < 7; ++number) {
    EXPECT_EQ(ring.back(), number % 3);
    ring.push();
    EXPECT_FALSE(ring.empty());
    EXPECT_EQ(ring.front(), number % 3);
    ring.pop();
    EXPECT_TRUE(ring.empty());
  }
  for (int i = 0; i < 3; ++i) ring.push();
  EXPECT_EQ(ring.back(), std::nullopt);
  ring.pop();
  EXPECT_EQ(ring.back(), 1u);
}

TEST(SlotRing, TwoThreadsLoseNothingAndTearNothing) {
  constexpr uint64_t kCount = 200'000;
  std::vector<Wide> slots(5);
  SlotRing ring(slots.size());
  std::thread producer([&] {
    for (uint64_t i = 0; i < kCount;) {
      const std::optional<size_t> slot = ring.back();
      if (!slot) {
        std::this_thread::yield();
        continue;
      }
      slots[*slot] = {i, ~i};
      ring.push();
      ++i;
    }
  });
  uint64_t wrong = 0;
  for (uint64_t i = 0; i < kCount;) {
    const std::optional<size_t> slot = ring.front();
    if (!slot) {
      std::this_thread::yield();
      continue;
    }
    if (slots[*slot].number != i || slots[*slot].inverse != ~i) ++wrong;
    ring.pop();
    ++i;
  }
  producer.join();
  EXPECT_EQ(wrong, 0u);
}

TEST(Newest, GivesTheNewest) {
  Newest<int> values(7);
  EXPECT_FALSE(values.take());
  EXPECT_EQ(values.front(), 7);
  for (const int value : {1, 2, 3}) {
    values.back() = value;
    values.publish();
  }
  EXPECT_FALSE(values.taken());
  EXPECT_TRUE(values.take());
  EXPECT_TRUE(values.taken());
  EXPECT_EQ(values.front(), 3);
  EXPECT_FALSE(values.take()) << "nothing is new";
  EXPECT_EQ(values.front(), 3);
}

TEST(Newest, GivesWholeValuesInTheirOrder) {
  constexpr int kLast = 200'000;
  Newest<std::vector<int>> newest(std::vector<int>(50));
  std::thread writing([&newest] {
    for (int value = 1; value <= kLast; ++value) {
      std::ranges::fill(newest.back(), value);
      newest.publish();
    }
  });
  int last = 0;
  while (last < kLast) {
    if (!newest.take()) continue;
    const std::vector<int>& values = newest.front();
    ASSERT_GT(values.front(), last);
    last = values.front();
    ASSERT_TRUE(std::ranges::all_of(values, [last](int value) { return value == last; }));
  }
  writing.join();
}

TEST(PublishedText, IsReadWholeOrNotAtAll) {
  PublishedText text;
  char buffer[PublishedText::kMost];
  EXPECT_EQ(text.read(buffer), 0u);
  std::atomic<bool> stop{false};
  std::thread setter([&] {
    for (unsigned i = 0; !stop.load(); ++i) {
      text.set(std::string(10 + i % 400, static_cast<char>('a' + i % 26)));
      std::this_thread::yield();
    }
  });
  for (int found = 0; found < 500;) {
    const size_t size = text.read(buffer);
    if (size == 0) continue;
    ++found;
    EXPECT_EQ(std::string_view(buffer, size).find_first_not_of(buffer[0]), std::string_view::npos);
  }
  stop.store(true);
  setter.join();
  text.set(std::string(1000, 'x'));
  EXPECT_EQ(text.read(buffer), PublishedText::kMost);
}

// The reader is interrupted after it has begun, each time by so many values that its copy is used again.
TEST(Published, GivesUpWhenItIsInterruptedEachTime) {
  Published published(2);
  EXPECT_EQ(published.read([](size_t, uint64_t) {}), Looked::Empty);
  const uint64_t words[] = {1, 2};
  published.publish(words);
  int begun = 0;
  const auto disturb = [&](size_t i, uint64_t) {
    if (i != 0) return;
    ++begun;
    for (int n = 0; n < 4; ++n) published.publish(words);
  };
  EXPECT_EQ(published.read(disturb), Looked::Interrupted);
  EXPECT_EQ(begun, 3);
  EXPECT_EQ(published.read([](size_t i, uint64_t word) { EXPECT_EQ(word, i + 1); }), Looked::Found);
}

TEST(Slot, ACommandIsDoneOnceOrNotAtAll) {
  Slot<int> slot;
  slot.post(5);
  EXPECT_TRUE(slot.withdraw());
  slot.take([](int&) { return ADD_FAILURE() << "it was withdrawn", true; });
  slot.post(6);
  slot.take([](int& command) { return ++command, false; }); // not now
  EXPECT_FALSE(slot.isDone());
  slot.take([](int& command) { return ++command, true; });
  slot.take([](int&) { return ADD_FAILURE() << "it is done", true; });
  EXPECT_TRUE(slot.isDone());
  EXPECT_FALSE(slot.withdraw());
  EXPECT_EQ(slot.command(), 8);
  slot.release();
  slot.post(9);
  EXPECT_FALSE(slot.isDone());
}

TEST(GuardedMemory, IsCopiedWhereItsCountersAgree) {
  struct Shared {
    uint32_t head = 1, tail = 1;
    uint64_t word = 0x0123456789ABCDEF;
    uint8_t rest[3] = {1, 2, 3};
  } shared;
  const GuardedMemory memory(reinterpret_cast<const uint8_t*>(&shared), 0, 4, 4);
  const GuardedMemory::Range ranges[] = {{8, 11}};
  uint8_t copy[sizeof(Shared)] = {};
  ASSERT_TRUE(memory.copy(ranges, copy, 1));
  EXPECT_EQ(std::memcmp(copy + 8, &shared.word, 11), 0);
  EXPECT_EQ(copy[0], 0);
  shared.head = 2; // a change has begun
  EXPECT_FALSE(memory.copy(ranges, copy, 4));
  shared.tail = 2;
  EXPECT_TRUE(memory.copy(ranges, copy, 1));
}

} // namespace
} // namespace rung::core
