// The interpreter runs programs in real time, before their machine code is there: it asks nothing of the heap.
#include <gtest/gtest.h>

#include "ir/interp/interp.h"
#include "rtlib/run/instance.h"
#include "tests/random/random.h"
#include "tests/support/count_allocations.h"

namespace rung::ir {
namespace {

TEST(Interpreter, AllocatesNothingWhileItRuns) {
  for (uint64_t seed = 0; seed < 100; ++seed) {
    const Module module = randomModule(seed, {});
    const Layout layout(module, {});
    InterpEngine engine(layout, 0);
    ASSERT_FALSE(engine.allocates());
    runtime::Instance instance(engine);
    const int allocations = test::allocationsOf([&] {
      for (int scan = 0; scan < 8; ++scan) instance.scan();
    });
    EXPECT_EQ(allocations, 0) << seed;
  }
}

} // namespace
} // namespace rung::ir
