// The bound of a slice, measured on a program that does not run to its end.
#include "rtlib/run/scan_bound.h"

#include <gtest/gtest.h>

#include "tests/unit/rtlib/test_program.h"

namespace {

using namespace rung::runtime;
using rung::test::TestProgram;

TEST(ScanBound, OfAChunkThatIsHeavierThanTheBudget) {
  TestProgram test;
  test.addPacked("R", 1, 8, 0);
  test.addChunk([](uint8_t*, rung_ctx*, uint32_t) { return RUNG_PC_DONE; }, 2000);
  test.addTask("MAIN", 0, 1000);
  test.scan = {{RUNG_STEP_ADVANCE, RUNG_NONE, 2000}, {RUNG_STEP_RUN, 0, 1}, {RUNG_STEP_ADVANCE, RUNG_NONE, 2000}};
  test.link();
  const ScanBound bound =
      measureBound({test.program}); // it faults in the first slice, and never comes to the list's end
  EXPECT_EQ(bound.periodNs, 2'000'000);
  EXPECT_GT(bound.weight, 0u);
}

} // namespace
