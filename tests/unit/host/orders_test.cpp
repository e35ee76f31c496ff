// Orders between threads: done once by the scan thread, or withdrawn and never done.
#include "machine/host/orders.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

namespace rung::host {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kLong(10000);

Answer given(OrderSlot& slot, Order& order, milliseconds time) {
  return slot.give(order, time, runtime::systemClock(), [] {});
}

// A scan thread that takes orders again and again.
class Scanning {
public:
  template <class Obey>
  Scanning(OrderSlot& slot, Obey obey)
      : thread_([this, &slot, obey] {
          while (!end_) slot.take(obey);
        }) {}
  ~Scanning() {
    end_ = true;
    thread_.join();
  }

private:
  std::atomic<bool> end_{false};
  std::thread thread_;
};

TEST(Orders, AreDoneWithTheirResults) {
  OrderSlot slot;
  const Scanning scanning(slot, [](Order& order) {
    order.former.integer = order.value.integer - 1;
    return OrderSlot::Outcome{};
  });
  for (int i = 0; i < 20; ++i) {
    Order order{.kind = Order::Kind::Write, .cell = 7, .value = {.integer = i}};
    const Answer answer = given(slot, order, kLong);
    EXPECT_TRUE(answer.ok());
    EXPECT_EQ(answer.problem, "");
    EXPECT_EQ(order.former.integer, i - 1);
  }
}

TEST(Orders, WithoutAScanAreWithdrawn) {
  OrderSlot slot;
  Order order;
  const Answer answer = given(slot, order, milliseconds(5));
  EXPECT_EQ(answer.status, RUNG_FAILED);
  EXPECT_EQ(answer.problem, "the scan thread does not run");
  bool done = false;
  slot.take([&](Order&) { return done = true, OrderSlot::Outcome{}; });
  EXPECT_FALSE(done) << "it was withdrawn";
}

TEST(Orders, ThatCannotBeDoneNowAreTriedAgain) {
  OrderSlot slot;
  std::atomic<int> tries{0};
  const Scanning scanning(slot, [&](Order&) { return OrderSlot::Outcome{++tries < 100 ? RUNG_LATER : RUNG_OK}; });
  Order order{.kind = Order::Kind::Replace};
  EXPECT_TRUE(given(slot, order, kLong).ok());
  EXPECT_EQ(tries, 100);
}

TEST(Orders, ThatNeverCanBeDoneSayWhy) {
  OrderSlot slot;
  const Scanning scanning(slot, [](Order&) { return OrderSlot::Outcome{RUNG_LATER, "the program is within a scan"}; });
  Order order{.kind = Order::Kind::Replace};
  const Answer answer = given(slot, order, milliseconds(20));
  EXPECT_EQ(answer.status, RUNG_LATER);
  EXPECT_EQ(answer.problem, "the program is within a scan");
}

TEST(Orders, OfSeveralThreadsWaitForEachOther) {
  OrderSlot slot;
  const Scanning scanning(slot, [](Order& order) {
    order.former = order.value;
    return OrderSlot::Outcome{};
  });
  std::thread others[3];
  std::atomic<int> wrong{0};
  for (std::thread& other : others)
    other = std::thread([&, number = &other - others] {
      for (int i = 0; i < 50; ++i) {
        Order order{.kind = Order::Kind::Write, .value = {.integer = number * 1000 + i}};
        if (!given(slot, order, kLong).ok() || order.former.integer != number * 1000 + i) ++wrong;
      }
    });
  for (std::thread& other : others) other.join();
  EXPECT_EQ(wrong, 0);
}

// Whichever comes first: an order is done and says so, or it is not done.
TEST(Orders, AreWithdrawnOrDone) {
  OrderSlot slot;
  std::atomic<int> done{0};
  int said = 0;
  {
    const Scanning scanning(slot, [&](Order&) { return ++done, OrderSlot::Outcome{}; });
    for (int i = 0; i < 300; ++i) {
      Order order;
      said += given(slot, order, milliseconds(0)).ok() ? 1 : 0;
    }
  }
  EXPECT_EQ(said, done);
}

} // namespace
} // namespace rung::host
