// How a TECHNOL message is told by hosts that know no texts of it.
#include <gtest/gtest.h>

#include <array>
#include <string>

#include "tools/sim/message_board.h"
#include "rtlib/nc/technol/messages.h"

namespace rung::nc {
namespace {

rung_message messageOf(uint32_t number, uint32_t subId, uint32_t par1, uint32_t par2, uint32_t par3) {
  rung_message message{};
  message.op = RUNG_MESSAGE_SHOW_LOG;
  message.number = number;
  message.index = static_cast<int32_t>(subId);
  message.value = static_cast<int64_t>(uint64_t{par2} << 32 | par1);
  message.channel = static_cast<int32_t>(par3);
  return message;
}

std::string told(const rung_message& message, size_t room) {
  rung_program program{};
  program.dialect = "technol";
  std::array<char, 100> line;
  line.fill('#');
  const size_t length = describeMessage(program, message, std::span(line).first(room));
  EXPECT_EQ(line[room], '#');
  return std::string(line.data(), length);
}

TEST(TechnolMessages, NumberSubidAndThreeValues) {
  EXPECT_EQ(told(messageOf(12, 0, 0, 0, 0), 90), "PLC00012 0 0 0 0");
  EXPECT_EQ(told(messageOf(65535 | technol::kByBit | technol::kPersistentWanted, 0xFFFFFFFF, 0xFFFFFFFF, 0x80000000,
                           0xFFFFFFFE),
                 90),
            "PLC65535 4294967295 4294967295 2147483648 4294967294");
}

TEST(TechnolMessages, WhatDoesNotFitIsCutOff) {
  EXPECT_EQ(told(messageOf(12, 1, 2, 3, 4), 10), "PLC00012 1");
  EXPECT_EQ(told(messageOf(12, 1, 2, 3, 4), 0), "");
}

} // namespace
} // namespace rung::nc
