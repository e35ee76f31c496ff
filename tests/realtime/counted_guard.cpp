// The guard that counts, and what it has to count.
#include <gtest/gtest.h>

#include <fcntl.h>
#include <malloc.h>

#include <new>

#include "tests/realtime/guard.h"
#include "tests/support/count_allocations.h"
#include "tests/support/count_system_calls.h"

namespace rung::test {

struct Guard::State {
  SystemCallTrap trap;
  int allocationsBefore = countedAllocations();
};

Guard::Guard() : state_(std::make_unique<State>()) {}
Guard::~Guard() = default;

void Guard::enter() {
  beginCountingAllocations();
  state_->trap.enter();
}

void Guard::exit() {
  state_->trap.exit();
  endCountingAllocations();
}

std::string Guard::offences() const {
  std::string text;
  if (const int calls = countedAllocations() - state_->allocationsBefore; calls > 0)
    text += std::to_string(calls) + " calls of the heap ";
  if (const int calls = state_->trap.count(); calls > 0)
    text += std::to_string(calls) + " system calls, the last of number " + std::to_string(state_->trap.last());
  return text;
}

std::vector<Offence> Guard::seen() {
  std::vector<Offence> list = {Offence::Allocation};
  if (SystemCallTrap().works()) list.push_back(Offence::SystemCall);
  return list;
}

namespace {

void* volatile block = nullptr; // else the compiler leaves allocation and release out

TEST(Guard, CountsEveryEntryOfTheHeap) {
  const auto callsOf = [](auto allocate) {
    return allocationsOf([&] {
      allocate();
      std::free(block);
    });
  };
  EXPECT_EQ(callsOf([] { block = std::malloc(10); }), 2);
  EXPECT_EQ(callsOf([] { block = std::calloc(10, 10); }), 2);
  EXPECT_EQ(callsOf([] { block = std::realloc(nullptr, 10); }), 2);
  EXPECT_EQ(callsOf([] { block = reallocarray(nullptr, 10, 10); }), 2);
  EXPECT_EQ(callsOf([] { block = std::aligned_alloc(64, 64); }), 2);
  EXPECT_EQ(callsOf([] { block = memalign(64, 10); }), 2);
  EXPECT_EQ(callsOf([] { block = valloc(10); }), 2);
  EXPECT_EQ(callsOf([] { block = pvalloc(10); }), 2);
  EXPECT_EQ(callsOf([] {
              void* made = nullptr;
              static_cast<void>(posix_memalign(&made, 64, 10));
              block = made;
            }),
            2);
  EXPECT_EQ(allocationsOf([] {
              block = ::operator new(10);
              ::operator delete(block);
            }),
            2);
  EXPECT_EQ(allocationsOf([] {
              constexpr std::align_val_t kLine{64};
              block = ::operator new(64, kLine);
              ::operator delete(block, kLine);
            }),
            2);
  EXPECT_EQ(allocationsOf([] { std::free(nullptr); }), 0);
}

TEST(Guard, CountsNothingOutside) {
  Guard guard;
  block = std::malloc(10);
  guard.enter();
  guard.exit();
  std::free(block);
  EXPECT_EQ(guard.offences(), "");
}

TEST(Guard, TheKernelDispatchesSystemCalls) {
  if (!SystemCallTrap().works()) GTEST_SKIP() << "this kernel cannot: system calls in a scan go unnoticed here";
  Guard guard;
  guard.enter();
  static_cast<void>(::open("/dev/null", O_RDONLY));
  guard.exit();
  EXPECT_NE(guard.offences(), "");
}

} // namespace
} // namespace rung::test
