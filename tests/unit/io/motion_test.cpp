// Trapezoids are held to their closed formulas, and end exactly.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "machine/io/axes/motion.h"

namespace {

using rung::io::Motion;

int ticksToStand(Motion& motion) {
  int ticks = 0;
  while (!motion.isAtRest() && ticks < 10'000'000) {
    motion.tick();
    ++ticks;
  }
  return ticks;
}

void ticks(Motion& motion, int count) {
  for (int i = 0; i < count; ++i) motion.tick();
}

// s / v + v / a, or 2 * sqrt(s / a) where the speed is not reached.
double timeOf(double s, double v, double a) { return s < v * v / a ? 2 * std::sqrt(s / a) : s / v + v / a; }

TEST(Motion, TakesTheTimeOfTheFormula) {
  Motion motion;
  motion.moveTo(100, 50, 500);
  EXPECT_DOUBLE_EQ(motion.duration(), 2.1);
  EXPECT_EQ(ticksToStand(motion), 2100);
  EXPECT_EQ(motion.position(), 100);
  EXPECT_EQ(motion.speed(), 0);
}

TEST(Motion, OfAnyLengthEndsExactly) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> length(-500, 500), speed(0.5, 900), acceleration(5, 5000);
  Motion motion;
  for (int i = 0; i < 300; ++i) {
    const double from = motion.position(), target = from + length(random);
    const double v = speed(random), a = acceleration(random);
    motion.moveTo(target, v, a);
    const double seconds = timeOf(std::fabs(target - from), v, a);
    EXPECT_NEAR(motion.duration(), seconds, 1e-9);
    EXPECT_NEAR(ticksToStand(motion), std::ceil(seconds * 1000 - 1e-6), 1);
    ASSERT_EQ(motion.position(), target);
    ASSERT_TRUE(motion.isAtRestAt(target));
  }
}

TEST(Motion, IsContinuousAndNeverTooFast) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(-40, 40), speed(1, 300), acceleration(50, 3000);
  Motion motion;
  for (int i = 0; i < 400; ++i) {
    const double a = acceleration(random), v = speed(random);
    if (i % 7 == 6)
      motion.stop(a);
    else if (i % 7 == 5)
      motion.run(place(random), a);
    else
      motion.moveTo(place(random), v, a);
    for (int t = 0; t < 40; ++t) {
      const double x = motion.position(), u = motion.speed();
      motion.tick();
      ASSERT_LE(std::fabs(motion.speed() - u), a * 0.001 + 1e-9);
      ASSERT_NEAR(motion.position() - x, (u + motion.speed()) / 2 * 0.001, a * 1e-6 + 1e-9);
    }
  }
}

TEST(Motion, TakesAnotherSpeedByARamp) {
  Motion motion;
  motion.moveTo(100, 50, 500);
  ticks(motion, 500); // 0.1 s of ramp, 2.5 mm, then 20 mm
  EXPECT_NEAR(motion.position(), 22.5, 1e-9);
  motion.moveTo(100, 20, 500);
  ticks(motion, 30);
  EXPECT_NEAR(motion.speed(), 35, 1e-9);
  ticks(motion, 30);
  EXPECT_NEAR(motion.speed(), 20, 1e-9);
  ticksToStand(motion);
  EXPECT_EQ(motion.position(), 100);
}

TEST(Motion, GoesOnAfterAStop) {
  Motion motion;
  motion.moveTo(-30, 60, 600);
  ticks(motion, 200);
  motion.stop(600);
  EXPECT_DOUBLE_EQ(motion.duration(), 0.1);
  ticksToStand(motion);
  EXPECT_NEAR(motion.position(), -3 - 6 - 3, 1e-9);
  motion.moveTo(-30, 60, 600);
  ticksToStand(motion);
  EXPECT_EQ(motion.position(), -30);
}

TEST(Motion, ComesBackToATargetThatItCannotBrakeFor) {
  Motion motion;
  motion.run(100, 1000);
  ticks(motion, 100);
  motion.moveTo(motion.position() + 1, 100, 1000); // it needs 5 mm
  double most = 0;
  while (!motion.isAtRest()) {
    motion.tick();
    most = std::max(most, motion.position());
  }
  EXPECT_NEAR(most, 10, 0.001);
  EXPECT_NEAR(motion.position(), 6, 1e-9);
}

TEST(Motion, OrderThatIsGivenAgainChangesNothing) {
  Motion once, often;
  once.moveTo(12.345, 33.3, 777);
  for (int i = 0; i < 1000; ++i) {
    often.moveTo(12.345, 33.3, 777);
    once.tick();
    often.tick();
    ASSERT_EQ(once.position(), often.position());
  }
}

TEST(Motion, BrakesFromAPlaceThatItPasses) {
  Motion motion;
  motion.runPast(100, 50, 500);
  ticksToStand(motion);
  EXPECT_DOUBLE_EQ(motion.position(), 100 + 50. * 50 / 1000); // v²/2a
  motion.place(0);
  motion.runPast(-0.9, -50, 500); // still accelerating: 30 mm/s there
  ticksToStand(motion);
  EXPECT_NEAR(motion.position(), -1.8, 1e-12);
}

TEST(Motion, SaysFromWhereASpeedIsReached) {
  Motion motion;
  motion.run(-100, 1000);
  ticks(motion, 100);
  EXPECT_DOUBLE_EQ(motion.position(), -5);
  EXPECT_DOUBLE_EQ(motion.inRange(-100, 1000), -5);
  EXPECT_DOUBLE_EQ(motion.inRange(-20, 1000), -5 - 4.8);
  EXPECT_DOUBLE_EQ(motion.inRange(20, 1000), -10);
}

TEST(Motion, RunIsWithoutDrift) {
  Motion motion;
  motion.run(1.0 / 3, 1000);
  ticks(motion, 3'000'000); // 3000 s, of which the ramp costs v²/2a
  EXPECT_NEAR(motion.position(), 1000 - 1.0 / 9 / 2000, 1e-9);
  EXPECT_FALSE(motion.isAtRest());
}

} // namespace
