// Quantiles: exact for small values, within 1.6 % for large ones, whatever one value does.
#include "rtlib/record/histogram.h"

#include <gtest/gtest.h>

namespace {

using rung::runtime::Histogram;

TEST(ProfileHistogram, IsEmptyAtFirst) {
  const Histogram none;
  EXPECT_EQ(none.count(), 0u);
  EXPECT_EQ(none.min(), 0u);
  EXPECT_EQ(none.max(), 0u);
  EXPECT_EQ(none.quantile(0.5), 0);
}

TEST(ProfileHistogram, OneValueIsAllQuantiles) {
  for (const uint64_t value :
       {uint64_t{0}, uint64_t{7}, uint64_t{63}, uint64_t{64}, uint64_t{12345}, uint64_t{1} << 50}) {
    Histogram histogram;
    for (int i = 0; i < 3; ++i) histogram.add(value);
    for (const double q : {0.0, 0.5, 0.99, 1.0}) EXPECT_EQ(histogram.quantile(q), static_cast<double>(value)) << value;
  }
}

TEST(ProfileHistogram, SmallValuesHaveAStepEach) {
  Histogram histogram;
  for (uint64_t v = 0; v < 64; ++v) histogram.add(v);
  EXPECT_NEAR(histogram.quantile(0.5), 31.5, 1e-9);
  EXPECT_NEAR(histogram.quantile(0.25), 15.5, 1e-9);
}

TEST(ProfileHistogram, LargeValuesAreWithinAStep) {
  for (uint64_t v = 64; v < uint64_t{1} << 33; v += v / 7 + 1) {
    Histogram histogram;
    histogram.add(0);
    histogram.add(v);
    histogram.add(v);
    histogram.add(uint64_t{1} << 40);
    EXPECT_NEAR(histogram.quantile(0.5), static_cast<double>(v), static_cast<double>(v) * 0.032) << v;
  }
}

TEST(ProfileHistogram, BetweenTwoValuesItInterpolates) {
  Histogram histogram;
  for (int i = 0; i < 100; ++i) histogram.add(24);
  for (int i = 0; i < 60; ++i) histogram.add(25);
  EXPECT_GT(histogram.quantile(0.5), 24);
  EXPECT_LT(histogram.quantile(0.5), 24.5);
}

TEST(ProfileHistogram, TheTrimmedMeanLeavesOutTheLargest) {
  Histogram histogram;
  EXPECT_EQ(histogram.trimmedMean(), 0);
  histogram.add(30);
  EXPECT_EQ(histogram.trimmedMean(), 30) << "a single value is all there is";
  histogram.add(500'000);
  EXPECT_EQ(histogram.trimmedMean(), 30);
  for (int i = 0; i < 299; ++i) histogram.add(20); // 301: three are left out
  EXPECT_EQ(histogram.trimmedMean(), 20);
  for (int i = 0; i < 100; ++i) histogram.add(40);
  EXPECT_NEAR(histogram.trimmedMean(), (30 + 299 * 20 + 97 * 40) / 397.0, 0.01);
}

TEST(ProfileHistogram, OneOutlierMovesTheMaximumAlone) {
  Histogram histogram;
  for (int i = 0; i < 1000; ++i) histogram.add(30);
  histogram.add(400'000);
  EXPECT_NEAR(histogram.quantile(0.5), 30, 0.5);
  EXPECT_NEAR(histogram.quantile(0.99), 30, 0.5);
  EXPECT_EQ(histogram.max(), 400'000u);
}

} // namespace
