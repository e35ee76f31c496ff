// Elementary functions: the doubles nearest to the exact values, which a program with 1,400 bits computed, and the
// rules where there is no such value.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "rung/sem.hpp"

namespace rung::sem {
namespace {

struct Case {
  u64 operand = 0;
  u64 result = 0;
  u64 exponent = 0;
};

// Among them the neighbours of ties, subnormal numbers, the limits of overflow and underflow, angles of all sizes, and
// the angle that comes closest to a multiple of pi/2.
constexpr Case kSqrt[] = {
    {0x4000000000000000, 0x3FF6A09E667F3BCD}, {0x4008000000000000, 0x3FFBB67AE8584CAA},
    {0x3FE0000000000000, 0x3FE6A09E667F3BCD}, {0x000012688B70E62B, 0x1FC1297872D9CBAE},
    {0x0000000000000001, 0x1E60000000000000}, {0x7FEFFFFFFFFFFFFF, 0x5FEFFFFFFFFFFFFF},
    {0x4330000000000001, 0x4190000000000000},
};
constexpr Case kPow[] = {
    {0x4000000000000000, 0x4090000000000000, 0x4024000000000000},
    {0x4000000000000000, 0x3FF6A09E667F3BCD, 0x3FE0000000000000},
    {0x4039000000000000, 0x4014000000000000, 0x3FE0000000000000},
    {0x4024000000000000, 0x3F50624DD2F1A9FC, 0xC008000000000000},
    {0x3FF8000000000000, 0x647F2DD011353699, 0x408F400000000000},
    {0x3FEFFFFFFFFFFFFF, 0x3EEF9F4ADC9092B5, 0x4376345785D8A000},
    {0x401C000000000000, 0x0B4BBB9B4E610170, 0xC072C00000000000},
    {0x4000000000000000, 0x0000000000000001, 0xC090C80000000000},
    {0x4000000000000000, 0x7FEFFFFFFFFFFD3A, 0x408FFFFFFFFFFFFF},
    {0x419FFFFFFC000000, 0x434FFFFFF8000000, 0x4000000000000000},
    {0x41A0000002000000, 0x4350000004000000, 0x4000000000000000},
    {0x4196A09E6C000000, 0x4340000007C84BEC, 0x4000000000000000},
    {0x4008000000000000, 0x4333BFEFA65ABB83, 0x4040800000000000},
    {0x3FF0000000000001, 0x3FF0000000000000, 0x3FE0000000000000},
    {0x3FF0000000000001, 0x3FF0000000000002, 0x3FF8000000000000},
    {0x0000000000000001, 0x3FDE666733F452DA, 0x3F50624DD2F1A9FC},
    {0xC008000000000000, 0xC03B000000000000, 0x4008000000000000},
    {0xC000000000000000, 0x8000000000000002, 0xC090C40000000000},
    {0x3FB999999999999A, 0x000730D67819E8F5, 0x4073400000000000},
};
constexpr Case kSin[] = {
    {0x3FF0000000000000, 0x3FEAED548F090CEE}, {0x3FE0000000000000, 0x3FDEAEE8744B05F0},
    {0x4008000000000000, 0x3FC210386DB6D55B}, {0x400921FB54442D18, 0x3CA1A62633145C07},
    {0x4480F0CF064DD592, 0xBFEB453AB76BF397}, {0x7506AC5B262CA1FF, 0x3FF0000000000000},
    {0x7FEFFFFFFFFFFFFF, 0x3F7452FC98B34E97}, {0x3FE921FB54442D18, 0x3FE6A09E667F3BCC},
    {0x3FE921FB54442D19, 0x3FE6A09E667F3BCD}, {0x0010000000000000, 0x0010000000000000},
    {0x0000000000000001, 0x0000000000000001}, {0x3E45798EE2308C3A, 0x3E45798EE2308C3A},
    {0xC004000000000000, 0xBFE326AF0DCFCAB1}, {0x4059000000000000, 0xBFE03425B78C4DB8},
    {0x412E848000000000, 0xBFD6664B2568D867},
};
constexpr Case kCos[] = {
    {0x3FF0000000000000, 0x3FE14A280FB5068C}, {0x3FE0000000000000, 0x3FEC1528065B7D50},
    {0x4008000000000000, 0xBFEFAE04BE85E5D2}, {0x400921FB54442D18, 0xBFF0000000000000},
    {0x4480F0CF064DD592, 0x3FE0BE2CEF01C8F4}, {0x7506AC5B262CA1FF, 0xBC214AE72E6BA22F},
    {0x7FEFFFFFFFFFFFFF, 0xBFEFFFE62ECFAB75}, {0x3FE921FB54442D18, 0x3FE6A09E667F3BCD},
    {0x3FE921FB54442D19, 0x3FE6A09E667F3BCC}, {0x0010000000000000, 0x3FF0000000000000},
    {0x0000000000000001, 0x3FF0000000000000}, {0x3E45798EE2308C3A, 0x3FF0000000000000},
    {0xC004000000000000, 0xBFE9A2F7EF858B7D}, {0x4059000000000000, 0x3FEB981DBF665FDF},
    {0x412E848000000000, 0x3FEDF9DF9906D32C},
};
constexpr Case kTan[] = {
    {0x3FF0000000000000, 0x3FF8EB245CBEE3A6}, {0x3FE0000000000000, 0x3FE17B4F5BF3474A},
    {0x4008000000000000, 0xBFC23EF71254B86F}, {0x400921FB54442D18, 0xBCA1A62633145C07},
    {0x3FE921FB54442D18, 0x3FEFFFFFFFFFFFFF}, {0x0000000000000001, 0x0000000000000001},
    {0x3E45798EE2308C3A, 0x3E45798EE2308C3A}, {0xC004000000000000, 0x3FE7E79B4E00BB15},
    {0x4059000000000000, 0xBFE2CA74D62B5D38}, {0x412E848000000000, 0xBFD7E9768AB734C0},
    {0x3FF921FB54442D17, 0x4329153D9443ED0B}, {0x3FF921FB54442D1A, 0xC3228F1859543AFF},
    {0x432FFFFFFFFFFFFC, 0x3FB3F31D75E7B437},
};
constexpr Case kAsin[] = {
    {0x3FF0000000000000, 0x3FF921FB54442D18}, {0xBFF0000000000000, 0xBFF921FB54442D18},
    {0x3FE0000000000000, 0x3FE0C152382D7366}, {0xBFE0000000000000, 0xBFE0C152382D7366},
    {0x3FEFFFFFFFFFFFFF, 0x3FF921FB50442D18}, {0x3E112E0BE826D695, 0x3E112E0BE826D695},
    {0x0000000000000001, 0x0000000000000001}, {0x3FE6A09E667F3BCD, 0x3FE921FB54442D19},
    {0x3FC0000000000000, 0x3FC00ABE0C129E1E},
};
constexpr Case kAcos[] = {
    {0x3FF0000000000000, 0x0000000000000000}, {0xBFF0000000000000, 0x400921FB54442D18},
    {0x3FE0000000000000, 0x3FF0C152382D7366}, {0xBFE0000000000000, 0x4000C152382D7366},
    {0x3FEFFFFFFFFFFFFF, 0x3E50000000000000}, {0x3E112E0BE826D695, 0x3FF921FB53FF74E9},
    {0x0000000000000001, 0x3FF921FB54442D18}, {0x3FE6A09E667F3BCD, 0x3FE921FB54442D18},
    {0x3FC0000000000000, 0x3FF720A392C1D955}, {0x0000000000000000, 0x3FF921FB54442D18},
};
constexpr Case kAtan[] = {
    {0x3FF0000000000000, 0x3FE921FB54442D18}, {0xBFF0000000000000, 0xBFE921FB54442D18},
    {0x3FB0000000000000, 0x3FAFF55BB72CFDEA}, {0x3FC7FCB923A29C78, 0x3FC7B650E9065DCF},
    {0x4020000000000000, 0x3FF7249FAA996A21}, {0x01A56E1FC2F8F359, 0x01A56E1FC2F8F359},
    {0x0000000000000001, 0x0000000000000001}, {0x7E37E43C8800759C, 0x3FF921FB54442D18},
    {0xC008000000000000, 0xBFF3FC176B7A8560}, {0x3FEFFFFFFFFFFFFF, 0x3FE921FB54442D18},
    {0x7FEFFFFFFFFFFFFF, 0x3FF921FB54442D18},
};
constexpr Case kExp[] = {
    {0x3FF0000000000000, 0x4005BF0A8B145769}, {0xBFF0000000000000, 0x3FD78B56362CEF38},
    {0x3FE62E42FEFA39EF, 0x4000000000000000}, {0xBFE62E42FEFA39EF, 0x3FE0000000000000},
    {0x40862E42FEFA39EF, 0x7FEFFFFFFFFFFF2A}, {0xC0874910D52D3051, 0x0000000000000001},
    {0xC086240000000000, 0x000E6CF6D08897AC}, {0x3BC79CA10C924223, 0x3FF0000000000000},
    {0xBBC79CA10C924223, 0x3FF0000000000000}, {0x0000000000000001, 0x3FF0000000000000},
    {0x3C9CD2B297D889BC, 0x3FF0000000000000}, {0x3CA0000000000000, 0x3FF0000000000001},
    {0x4059000000000000, 0x48F3494A9B171BF5}, {0x3FE0000000000000, 0x3FFA61298E1E069C},
};
constexpr Case kLog[] = {
    {0x4000000000000000, 0x3FE62E42FEFA39EF}, {0x4024000000000000, 0x40026BB1BBB55516},
    {0x3FE0000000000000, 0xBFE62E42FEFA39EF}, {0x3FF0000000000001, 0x3CAFFFFFFFFFFFFF},
    {0x3FEFFFFFFFFFFFFF, 0xBCA0000000000000}, {0x0000000000000001, 0xC0874385446D71C3},
    {0x7FEFFFFFFFFFFFFF, 0x40862E42FEFA39EF}, {0x3FF6A09E667F3BCD, 0x3FD62E42FEFA39F0},
    {0x3FF6A09E667F3BCC, 0x3FD62E42FEFA39EE}, {0x3FE6A09E667F3BCD, 0xBFD62E42FEFA39EE},
    {0x4005BF0A8B145769, 0x3FF0000000000000}, {0x00000000000007E8, 0xC087069E3078E52D},
};

template <size_t N>
void check(const char* name, const Case (&cases)[N], double (*f)(double)) {
  for (const Case& c : cases)
    EXPECT_EQ(toBits(f(fromBits(c.operand))), c.result) << name << " of " << fromBits(c.operand);
}

TEST(Real, AreTheNearestDoubles) {
  check("square root", kSqrt, fsqrt);
  check("sine", kSin, fsin);
  check("cosine", kCos, fcos);
  check("tangent", kTan, ftan);
  check("arc sine", kAsin, fasin);
  check("arc cosine", kAcos, facos);
  check("arc tangent", kAtan, fatan);
  check("exponential", kExp, fexp);
  check("logarithm", kLog, flog);
  for (const Case& c : kPow)
    EXPECT_EQ(toBits(fpow(fromBits(c.operand), fromBits(c.exponent))), c.result)
        << fromBits(c.operand) << " to the power of " << fromBits(c.exponent);
}

// What compilers compute is what programs compute: there is nothing in it that could differ.
static_assert(fsqrt(2.0) == 1.4142135623730951 && fpow(2, 10) == 1024 && fsin(0.5) == 0.479425538604203);
static_assert(fexp(1) == 2.718281828459045 && flog(10) == 2.302585092994046 && fatan(1) == 0.7853981633974483);

// Neighbours: the library's own results are not all the nearest ones.
bool near(double a, double b) {
  if (std::isnan(a) || std::isnan(b)) return std::isnan(a) && std::isnan(b);
  return a == b || std::nextafter(a, b) == b;
}

// Numbers of all sizes between 2^low and 2^high, of both signs.
class Numbers {
public:
  double operator()(int low, int high) {
    state_ = state_ * 6364136223846793005ull + 1442695040888963407ull;
    const u64 exponent = static_cast<u64>(1023 + low) + (state_ >> 33) % static_cast<u64>(high - low);
    state_ = state_ * 6364136223846793005ull + 1442695040888963407ull;
    return fromBits((state_ & (1ull << 63)) | exponent << 52 | (state_ >> 11 & ((1ull << 52) - 1)));
  }

private:
  u64 state_ = 1;
};

TEST(Real, AgreeWithTheLibrary) {
  Numbers numbers;
  const auto agree = [&](const char* name, double (*ours)(double), double (*library)(double), int low, int high) {
    for (int i = 0; i < 100'000; ++i) {
      const double x = numbers(low, high);
      ASSERT_TRUE(near(ours(x), library(x))) << name << " of " << x;
    }
  };
  agree("square root", fsqrt, std::sqrt, -1022, 1024);
  agree("sine", fsin, std::sin, -60, 1024);
  agree("cosine", fcos, std::cos, -60, 1024);
  agree("tangent", ftan, std::tan, -60, 20);
  agree("arc sine", fasin, std::asin, -40, 1);
  agree("arc cosine", facos, std::acos, -60, 1);
  agree("arc tangent", fatan, std::atan, -60, 100);
  agree("exponential", fexp, std::exp, -60, 10);
  agree("logarithm", flog, std::log, -1022, 1024);
  for (int i = 0; i < 100'000; ++i) {
    const double x = numbers(-30, 30);
    const double y = numbers(-10, 6);
    ASSERT_TRUE(near(fpow(x, y), std::pow(x, y))) << x << " to the power of " << y;
  }
  for (int x = 1; x < 300; ++x)
    for (int y = -40; y < 40; ++y) ASSERT_TRUE(near(fpow(-x, y), std::pow(-x, y))) << x << " to the power of " << y;
}

// Where a compiler has no numbers of 128 bits.
TEST(Real, BothMultiplicationsAreTheSame) {
  Numbers numbers;
  std::vector<u64> factors = {0, 1, 2, 0xFFFFFFFF, 0x100000000, 1ull << 63, ~0ull, ~0ull - 1};
  for (int i = 0; i < 1000; ++i) factors.push_back(toBits(numbers(-1022, 1023)));
  for (u64 a : factors)
    for (u64 b : factors) {
      const wide::U128 one = wide::mulFull(a, b);
      const wide::U128 other = wide::mulByHalves(a, b);
      ASSERT_TRUE(one.hi == other.hi && one.lo == other.lo) << a << " * " << b;
    }
}

TEST(Real, SignsOfZeroAndParity) {
  for (double (*f)(double) : {fsqrt, fsin, ftan, fasin, fatan}) {
    EXPECT_EQ(toBits(f(0.0)), toBits(0.0));
    EXPECT_EQ(toBits(f(-0.0)), toBits(-0.0));
  }
  for (double (*f)(double) : {fsin, ftan, fasin, fatan}) EXPECT_EQ(f(-0.3), -f(0.3));
  EXPECT_EQ(fcos(-0.3), fcos(0.3));
  EXPECT_EQ(fcos(0), 1);
  EXPECT_EQ(fexp(-0.0), 1);
  EXPECT_EQ(toBits(flog(1)), toBits(0.0));
  EXPECT_EQ(toBits(facos(1)), toBits(0.0));
}

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(Real, WhereThereIsNoValue) {
  const u64 none = kNanBits;
  for (double (*f)(double) : {fsqrt, fsin, fcos, ftan, fasin, facos, fatan, fexp, flog}) {
    EXPECT_EQ(toBits(f(kNan)), none);
    EXPECT_EQ(toBits(f(fromBits(0xFFF0000000000001))), none) << "all NaN become one";
  }
  EXPECT_EQ(toBits(fsqrt(-5e-324)), none);
  EXPECT_EQ(toBits(flog(-5e-324)), none);
  for (double x : {std::nextafter(1.0, 2.0), -std::nextafter(1.0, 2.0), kInf, -kInf}) {
    EXPECT_EQ(toBits(fasin(x)), none);
    EXPECT_EQ(toBits(facos(x)), none);
  }
  for (double x : {kInf, -kInf})
    for (double (*f)(double) : {fsin, fcos, ftan}) EXPECT_EQ(toBits(f(x)), none);
}

TEST(Real, Infinities) {
  EXPECT_EQ(fsqrt(kInf), kInf);
  EXPECT_EQ(toBits(fsqrt(-kInf)), kNanBits);
  EXPECT_EQ(fatan(kInf), 1.5707963267948966);
  EXPECT_EQ(fatan(-kInf), -1.5707963267948966);
  EXPECT_EQ(fexp(kInf), kInf);
  EXPECT_EQ(toBits(fexp(-kInf)), toBits(0.0));
  EXPECT_EQ(fexp(710), kInf);
  EXPECT_EQ(fexp(-746), 0);
  EXPECT_EQ(fexp(1e300), kInf);
  EXPECT_EQ(flog(kInf), kInf);
  EXPECT_EQ(flog(0), -kInf);
  EXPECT_EQ(flog(-0.0), -kInf);
}

// One unit of the last place on either side of an odd multiple of pi/2, also of large ones.
TEST(Real, PolesOfTheTangent) {
  for (double pole : {1.5707963267948966, 4.71238898038469, 7.853981633974483, 80.11061266653972, 3141603.6491640806,
                      387850942.92898154, 3454217652381.1987}) {
    EXPECT_TRUE(std::isnan(ftan(pole))) << pole;
    EXPECT_TRUE(std::isnan(ftan(-pole))) << pole;
    EXPECT_FALSE(std::isnan(ftan(pole + 3 * (std::nextafter(pole, kInf) - pole)))) << pole;
  }
  EXPECT_TRUE(std::isnan(ftan(std::nextafter(1.5707963267948966, 2.0))));  // 0.7 units behind the pole
  EXPECT_FALSE(std::isnan(ftan(std::nextafter(1.5707963267948966, 1.0)))); // 1.3 units in front of it
  EXPECT_FALSE(std::isnan(ftan(3.141592653589793))) << "an even multiple";
  EXPECT_TRUE(std::isnan(ftan(9007199254740992.0)) && std::isnan(ftan(1e300)));
}

TEST(Real, RulesOfPower) {
  for (double x : {0.0, -0.0, 1.0, -7.5, kInf, -kInf, kNan}) EXPECT_EQ(fpow(x, 0), 1) << x;
  for (double y : {0.5, -3.0, kInf, -kInf, kNan}) EXPECT_EQ(fpow(1, y), 1) << y;
  EXPECT_EQ(toBits(fpow(kNan, 2)), kNanBits);
  EXPECT_EQ(toBits(fpow(2, kNan)), kNanBits);
  EXPECT_EQ(toBits(fpow(-8, 1.0 / 3)), kNanBits);
  EXPECT_EQ(fpow(-2, 3), -8);
  EXPECT_EQ(fpow(-2, 9007199254740992.0), kInf) << "an even exponent";
  EXPECT_EQ(toBits(fpow(0.0, 2)), toBits(0.0));
  EXPECT_EQ(toBits(fpow(-0.0, 3)), toBits(-0.0));
  EXPECT_EQ(toBits(fpow(-0.0, 2)), toBits(0.0));
  EXPECT_EQ(fpow(0, -2), kInf);
  EXPECT_EQ(fpow(-0.0, -3), -kInf);
  EXPECT_EQ(fpow(kInf, 0.5), kInf);
  EXPECT_EQ(fpow(kInf, -0.5), 0);
  EXPECT_EQ(fpow(-kInf, 3), -kInf);
  EXPECT_EQ(fpow(-1, kInf), 1);
  EXPECT_EQ(fpow(0.5, kInf), 0);
  EXPECT_EQ(fpow(0.5, -kInf), kInf);
  EXPECT_EQ(fpow(2, 1024), kInf);
  EXPECT_EQ(fpow(2, -1076), 0);
  EXPECT_EQ(toBits(fpow(2, -1074)), 1u);
}

} // namespace
} // namespace rung::sem
