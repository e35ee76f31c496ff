// Whatever is ordered in whatever order: what moves is reported, and no axis jumps or accelerates beyond its ramps.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/unit/io/axes_machine.h"

namespace {

using namespace rung::sim::technol;
using rung::test::AxesMachine;

class Orders {
public:
  // Since AX_SPI, and until they stop without a role.
  AxisMask spindles = 0;

  explicit Orders(uint32_t seed) : random_(seed) {}
  int64_t pick(int64_t low, int64_t high) { return std::uniform_int_distribution<int64_t>(low, high)(random_); }
  bool one(int64_t in) { return pick(1, in) == 1; }
  AxisMask mask() { return static_cast<AxisMask>(pick(0, 15)); }

  void give(AxesMachine& machine) {
    Axes& axes = machine.axes;
    const int64_t axis = pick(0, 5);
    switch (pick(0, 17)) {
    case 0:
      axes.axSpi(axis, static_cast<SpindleRole>(pick(0, 3)));
      if (axes.exists(static_cast<uint32_t>(axis))) setBit(spindles, static_cast<uint32_t>(axis - 1));
      return;
    case 1: axes.spiMain(axis); return;
    case 2: machine.spiAx(axis, {.feed1 = pick(-36'000'000, 36'000'000), .angle = pick(-90'000, 90'000)}); return;
    case 3: axes.posInit(axis, 0, !one(5)); return;
    case 4:
      axes.posMode(axis, static_cast<int32_t>(pick(-20'000, 20'000)), static_cast<uint16_t>(pick(0, 1000)));
      return;
    case 5: axes.posControl(axis, static_cast<uint32_t>(pick(0, 9000)) << 16, !one(4)); return;
    case 6: axes.posReset(axis); return;
    case 7: axes.analogOnSpindle(pick(-40'000, 40'000), axis, pick(0, 2)); return;
    case 8: machine.requests.homingStartReq = mask(); return;
    case 9: axes.reference("single", mask()); return;
    case 10: machine.requests.positioning = mask(); return;
    case 11: machine.in.externalControl = one(2); return;
    case 12: machine.in.externalPlus = mask(); return;
    case 13: machine.in.externalMinus = mask(); return;
    case 14: axes.handwheel(pick(-50, 50)); return;
    case 15: axes.rtm(one(2) ? "RTMID_MMM_MOVEXNEGY" : "RTMID_IMMM_MOVE02RT", one(2)); return;
    case 16: cells(machine); return;
    default: one(4) ? axes.stop(one(2)) : axes.autman(one(2)); return;
    }
  }

private:
  void cells(AxesMachine& machine) {
    machine.in.enabled = static_cast<AxisMask>(one(3) ? mask() : 0xFFFF);
    machine.in.limitPlus = one(3) ? mask() : AxisMask{0};
    machine.in.limitMinus = one(3) ? mask() : AxisMask{0};
    machine.in.refSwitch = mask();
    machine.in.reverseSwitch = one(4) ? mask() : AxisMask{0};
    machine.in.autmanReq = one(2);
  }

  std::mt19937 random_;
};

void check(const AxesMachine& machine, AxisMask& spindles, const std::array<double, 4>& places,
           const std::array<double, 4>& speeds) {
  for (uint32_t axis = 1; axis <= 4; ++axis) {
    const double place = machine.axes.physical(axis), speed = machine.axes.speedPerMinute(axis) / 60;
    ASSERT_LE(std::fabs(speed - speeds[axis - 1]), 2000 * 0.001 + 1e-6) << "axis " << axis;
    ASSERT_NEAR(place - places[axis - 1], (speed + speeds[axis - 1]) / 2 * 0.001, 2000 * 1e-6 + 1e-6)
        << "axis " << axis;
    if (machine.axes.spindleRole(axis) != 0)
      setBit(spindles, axis - 1);
    else if (speed == 0)
      clearBit(spindles, axis - 1);
    if (!has(machine.out.motion, axis - 1) && !has(spindles, axis - 1))
      ASSERT_EQ(speed, 0) << "axis " << axis << " moves unseen";
  }
}

TEST(AxesProperty, NothingJumpsOrMovesUnseen) {
  for (uint32_t seed = 1; seed <= 40; ++seed) {
    AxesMachine machine({{"axis.1.RefSwitch", "0"},
                         {"axis.2.RefMethod", "10"},
                         {"axis.3.MoveToPosAfterRef", "2"},
                         {"axis.4.Rotary", "1"},
                         {"axis.4.RefSwitch", "0"},
                         {"axis.4.SpeedAt10V", "60000"}});
    Orders orders(seed);
    for (int tick = 0; tick < 5000; ++tick) {
      if (orders.one(15)) orders.give(machine);
      std::array<double, 4> places{}, speeds{};
      for (uint32_t i = 0; i < 4; ++i) {
        places[i] = machine.axes.physical(i + 1);
        speeds[i] = machine.axes.speedPerMinute(i + 1) / 60;
      }
      machine.ticks(1);
      ASSERT_NO_FATAL_FAILURE(check(machine, orders.spindles, places, speeds)) << "seed " << seed << ", tick " << tick;
    }
  }
}

} // namespace
