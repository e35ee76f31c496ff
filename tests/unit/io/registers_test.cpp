// Values as registers and as bytes: every format both ways, limits, and what is not a number.
#include "machine/io/connections/modbus_image.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

namespace rung::io {
namespace {

using host::Format;
using host::PinType;

ExchangedPin pinOf(PinType type, Format format, bool lowFirst = false) {
  return {.place = {.area = host::Area::HoldingRegister, .format = format, .lowFirst = lowFirst}, .type = type};
}

double throughRegisters(const ExchangedPin& pin, double value) {
  uint16_t registers[2] = {0xAAAA, 0xAAAA};
  toRegisters(pin, value, registers);
  return fromRegisters(pin, registers).value();
}

TEST(Registers, HoldWhatFits) {
  std::mt19937 random(4711);
  for (int i = 0; i < 1000; ++i) {
    const auto bits = static_cast<uint32_t>(random());
    for (const bool lowFirst : {false, true}) {
      const auto both = [&](PinType type, Format format, double value) {
        EXPECT_EQ(throughRegisters(pinOf(type, format, lowFirst), value), value);
      };
      both(PinType::S32, Format::S16, static_cast<int16_t>(bits));
      both(PinType::U32, Format::U16, static_cast<uint16_t>(bits));
      both(PinType::S32, Format::S32, static_cast<int32_t>(bits));
      both(PinType::U32, Format::U32, bits);
      both(PinType::Float, Format::S32, static_cast<int32_t>(bits));
      both(PinType::Float, Format::F32, static_cast<float>(bits) / 7);
    }
  }
}

TEST(Registers, AreInTheStatedOrder) {
  uint16_t registers[2] = {};
  toRegisters(pinOf(PinType::U32, Format::U32, false), 0x12345678, registers);
  EXPECT_EQ(registers[0], 0x1234);
  EXPECT_EQ(registers[1], 0x5678);
  toRegisters(pinOf(PinType::U32, Format::U32, true), 0x12345678, registers);
  EXPECT_EQ(registers[0], 0x5678);
  EXPECT_EQ(registers[1], 0x1234);
}

TEST(Registers, LimitAndRound) {
  EXPECT_EQ(throughRegisters(pinOf(PinType::S32, Format::S16), 40000), 32767);
  EXPECT_EQ(throughRegisters(pinOf(PinType::S32, Format::S16), -40000), -32768);
  EXPECT_EQ(throughRegisters(pinOf(PinType::U32, Format::U16), 70000), 65535);
  EXPECT_EQ(throughRegisters(pinOf(PinType::Float, Format::S16), 2.5), 3);
  EXPECT_EQ(throughRegisters(pinOf(PinType::Float, Format::S16), -1e300), -32768);
  EXPECT_EQ(throughRegisters(pinOf(PinType::Float, Format::S16), NAN), 0);
  EXPECT_EQ(throughRegisters(pinOf(PinType::Float, Format::F32), 1e300), std::numeric_limits<float>::max());
}

TEST(Registers, GiveWhatThePinHolds) {
  const uint16_t negative[] = {0xFFFF, 0xFFFF};
  EXPECT_EQ(fromRegisters(pinOf(PinType::U32, Format::S16), negative), 0) << "not below 0";
  EXPECT_EQ(fromRegisters(pinOf(PinType::S32, Format::U32), negative), INT32_MAX);
  EXPECT_EQ(fromRegisters(pinOf(PinType::Float, Format::U32), negative), UINT32_MAX);
}

TEST(Registers, OfNoNumberGiveNothing) {
  for (const uint16_t high : {0x7FC0, 0xFFC0, 0x7F80, 0xFF80, 0x7F81}) {
    const uint16_t registers[] = {high, 0};
    EXPECT_FALSE(fromRegisters(pinOf(PinType::Float, Format::F32), registers)) << high;
  }
}

TEST(Bytes, HoldEveryType) {
  uint8_t bytes[8] = {};
  const auto both = [&](PinType type, double value) {
    const ExchangedPin pin{.type = type};
    toBytes(pin, value, bytes);
    EXPECT_EQ(fromBytes(pin, bytes), value);
  };
  both(PinType::Bit, 1);
  both(PinType::Bit, 0);
  both(PinType::S32, INT32_MIN);
  both(PinType::U32, UINT32_MAX);
  both(PinType::Float, -0.1);
  const double none = NAN;
  std::memcpy(bytes, &none, sizeof none);
  EXPECT_FALSE(fromBytes({.type = PinType::Float}, bytes));
}

} // namespace
} // namespace rung::io
