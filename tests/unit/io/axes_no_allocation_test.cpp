// Ticks and orders of the axes allocate nothing.
#include <gtest/gtest.h>

#include "tests/support/count_allocations.h"
#include "tests/unit/io/axes_machine.h"

namespace {

using namespace rung::sim::technol;
using rung::test::allocationsOf;
using rung::test::AxesMachine;

void work(AxesMachine& machine, int scan) {
  Axes& axes = machine.axes;
  if (scan % 100 == 0) {
    axes.posInit(1, 0, true);
    axes.posMode(1, scan % 200 == 0 ? 5000 : -5000, 500);
    machine.spiAx(4, {.feed1 = 36'000'000});
    axes.analogOnSpindle(1, 17, 0);
    machine.requests.homingStartReq = 2;
    axes.handwheel(scan);
    axes.stop(scan % 300 == 0);
  }
  axes.posControl(1, 6000 << 16, true);
  axes.analogPort(6);
  axes.analog(scan);
  machine.in.externalPlus = scan % 50 < 25 ? 4 : 0;
  machine.scan();
  Complaint complaint;
  while (axes.takeComplaint(complaint)) {
  }
}

TEST(AxesNoAllocation, TenThousandTicks) {
  AxesMachine machine({{"axis.4.RefSwitch", "0"}, {"axis.2.RefSwitch", "0"}});
  machine.in.autmanReq = machine.in.externalControl = true;
  EXPECT_GT(allocationsOf([&] { machine.axes.addSwitch(1, "1 0 1"); }), 0); // the counter counts
  EXPECT_EQ(allocationsOf([&] {
              for (int scan = 0; scan < 500; ++scan) work(machine, scan);
            }),
            0);
  EXPECT_NE(machine.axes.physical(3), 0);
}

} // namespace
