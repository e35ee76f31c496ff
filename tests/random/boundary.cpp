// The boundary values (see random.h).
#include "ir/support/check.h"
#include "tests/random/random.h"

namespace rung::ir {
namespace {

constexpr uint64_t kBits[] = {0, 1};
constexpr uint64_t kI8[] = {0, 1, 2, 7, 9, 0x10, 0x7F, 0x80, 0x99, 0xFE, 0xFF};
constexpr uint64_t kI16[] = {0, 1, 2, 10, 0x80, 0xFF, 0x100, 0x7FFF, 0x8000, 0x9999, 0xFFFF};
constexpr uint64_t kI32[] = {0,      1,          2,          10,         0x80,       0x8000,
                             0xFFFF, 0x7FFFFFFF, 0x80000000, 0x99999999, 0xFFFFFFFE, 0xFFFFFFFF};
constexpr uint64_t kWide[] = {0,
                              1,
                              2,
                              10,
                              0x80000000,
                              0xFFFFFFFF,
                              0x20000000000001,
                              0x7FFFFFFFFFFFFFFF,
                              0x8000000000000000,
                              0x9999999999999999,
                              0xFFFFFFFFFFFFFFFE,
                              0xFFFFFFFFFFFFFFFF};
constexpr uint64_t kF64[] = {
    0x0000000000000000, 0x8000000000000000, // 0, -0
    0x3FF0000000000000, 0xBFF0000000000000, // 1, -1
    0x3FE0000000000000, 0xBFE0000000000000, // 0.5, -0.5: ties
    0x4004000000000000, 0x3FDFFFFFFFFFFFFF, // 2.5, the number below 0.5
    0x405FF33333333333, 0xC0601CCCCCCCCCCD, // 127.8, -128.9: the borders of i8
    0x41DFFFFFFFE00000, 0xC1E0000000100000, // 2147483647.5, -2147483648.5: those of i32
    0x43E0000000000000, 0xC3E0000000000000, // 2^63, -2^63: those of i64
    0x7FE1CCF385EBC8A0, 0x0000000000000001, // 1e308, the smallest
    0x7FF0000000000000, 0xFFF0000000000000, // infinities
    0x7FF8000000000000, 0xFFF8000000000001, // NaN, another one
    0x3FF921FB54442D18, 0x4480F0CF064DD592, // pi/2, 1e22
    0xC0874910D52D3053, 0x000FFFFFFFFFFFFF, // -745.13..., whose exponential is the smallest; the greatest subnormal
};
constexpr uint64_t kCounts[] = {0, 1, 3, 7, 8, 15, 16, 31, 32, 63, 64, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF};

} // namespace

std::span<const uint64_t> boundaryValues(Type type) {
  switch (type) {
  case Type::Bit: return kBits;
  case Type::I8: return kI8;
  case Type::I16: return kI16;
  case Type::I32: return kI32;
  case Type::I64: return kWide;
  case Type::F64: return kF64;
  case Type::None: break;
  }
  RUNG_CHECK(false, "there are no values of no type");
  return {};
}

std::span<const uint64_t> boundaryCounts() { return kCounts; }

} // namespace rung::ir
