// The line of a TECHNOL message in the log, with and without a text of the control's files.
#include <gtest/gtest.h>

#include <array>
#include <string>

#include "rtlib/nc/control/technol/messages.h"

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

std::string line(const technol::Messages& messages, const rung_message& message, size_t room) {
  std::array<char, 100> out{};
  out.fill('#');
  const size_t length = messages.describe(message, std::span(out).first(room));
  EXPECT_EQ(out[room], '#');
  return std::string(out.data(), length);
}

TEST(TechnolMessages, NumberSubidAndThreeValues) {
  EXPECT_EQ(line({}, messageOf(12, 0, 0, 0, 0), 90), "PLC00012 0 0 0 0");
  EXPECT_EQ(line({},
                 messageOf(65535 | technol::kByBit | technol::kPersistentWanted, 0xFFFFFFFF, 0xFFFFFFFF, 0x80000000,
                           0xFFFFFFFE),
                 90),
            "PLC65535 4294967295 4294967295 2147483648 4294967294");
}

TEST(TechnolMessages, WhatDoesNotFitIsCutOff) {
  EXPECT_EQ(line({}, messageOf(12, 1, 2, 3, 4), 10), "PLC00012 1");
  EXPECT_EQ(line({}, messageOf(12, 1, 2, 3, 4), 0), "");
}

TEST(TechnolMessages, TheTextComesWithItsValues) {
  technol::Messages messages;
  messages.define({12, technol::MessageKind::Err, technol::Validity::Transient, "at %d, code %X, %x; %d 100 %"});
  EXPECT_EQ(line(messages, messageOf(12, 1, 0xFFFFFFFE, 0xAB, 0xCD), 90),
            "PLC00012 1 4294967294 171 205 at -2, code AB, cd; %d 100 %");
  EXPECT_EQ(line(messages, messageOf(12, 1, 0xFFFFFFFE, 0xAB, 0xCD), 36), "PLC00012 1 4294967294 171 205 at -2,");
  messages.accept(messageOf(12, 1, 7, 8, 9));
  ASSERT_EQ(messages.shown().size(), 1u);
  EXPECT_EQ(messages.shown()[0].text, "at 7, code 8, 9; %d 100 %");
}

// l.5013-5064, 5262-5281: `set` is ignored for a transient message; Event is registered only.
TEST(TechnolMessages, WhatAHostReads) {
  technol::Messages messages;
  messages.define({12, technol::MessageKind::Err, technol::Validity::Transient, ""});
  messages.define({13, technol::MessageKind::Err, technol::Validity::Persistent, ""});
  messages.define({14, technol::MessageKind::Event, technol::Validity::Transient, ""});
  const auto opOf = [&](uint32_t number, uint32_t op) {
    rung_message message = messageOf(number, 0, 0, 0, 0);
    message.op = op;
    return messages.outward(message).op;
  };
  EXPECT_EQ(opOf(12, RUNG_MESSAGE_SHOW_LOG), RUNG_MESSAGE_SHOW_LOG);
  EXPECT_EQ(opOf(12, RUNG_MESSAGE_CLEAR), RUNG_MESSAGE_SHOW_LOG);
  EXPECT_EQ(opOf(12 | technol::kByBit, RUNG_MESSAGE_CLEAR), RUNG_MESSAGE_CLEAR);
  EXPECT_EQ(opOf(13, RUNG_MESSAGE_CLEAR), RUNG_MESSAGE_CLEAR);
  EXPECT_EQ(opOf(14, RUNG_MESSAGE_SHOW_LOG), RUNG_MESSAGE_LOG);
  EXPECT_EQ(messages.outward(messageOf(12 | technol::kPersistentWanted, 0, 0, 0, 0)).number, 12u);
}

} // namespace
} // namespace rung::nc
