// Whole values between two threads.
#include "machine/io/connections/triple_buffer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <thread>
#include <vector>

namespace rung::io {
namespace {

TEST(TripleBuffer, GivesTheNewest) {
  TripleBuffer<int> buffer(7);
  EXPECT_FALSE(buffer.take());
  EXPECT_EQ(buffer.front(), 7);
  for (const int value : {1, 2, 3}) {
    buffer.back() = value;
    buffer.publish();
  }
  EXPECT_TRUE(buffer.take());
  EXPECT_EQ(buffer.front(), 3);
  EXPECT_FALSE(buffer.take()) << "nothing is new";
  EXPECT_EQ(buffer.front(), 3);
}

TEST(TripleBuffer, GivesWholeValuesInTheirOrder) {
  constexpr int kLast = 200'000;
  TripleBuffer<std::vector<int>> buffer(std::vector<int>(50));
  std::thread writing([&buffer] {
    for (int value = 1; value <= kLast; ++value) {
      std::ranges::fill(buffer.back(), value);
      buffer.publish();
    }
  });
  int last = 0;
  while (last < kLast) {
    if (!buffer.take()) continue;
    const std::vector<int>& values = buffer.front();
    ASSERT_GT(values.front(), last);
    last = values.front();
    ASSERT_TRUE(std::ranges::all_of(values, [last](int value) { return value == last; }));
  }
  writing.join();
}

} // namespace
} // namespace rung::io
