// What a control of each dialect says of texts, messages and slots.
#include "rtlib/nc/control/control.h"

#include <gtest/gtest.h>

namespace {

using rung::nc::makeControl;
using rung::nc::ShownMessage;

TEST(ControlTexts, OfMessages) {
  const auto plain = makeControl("gsk"), nct = makeControl("nct");
  ShownMessage message;
  message.number = 12;
  EXPECT_EQ(plain->text(message), "message 12");
  message.text = "DOOR OPEN";
  EXPECT_EQ(plain->text(message), "message 12 \"DOOR OPEN\"");
  message.index = 3;
  EXPECT_EQ(nct->text(message), "message 12 (channel 0, index 3) \"DOOR OPEN\"");
}

TEST(ControlTexts, OfTechnolMessagesAreAsInTheLog) {
  const auto technol = makeControl("technol");
  ShownMessage message;
  message.number = 12;
  message.index = -1; // a subid of 32 bits
  message.value = 4;
  message.par2 = 0xFFFFFFFF;
  message.par3 = 6;
  EXPECT_EQ(technol->text(message), "PLC00012 4294967295 4 4294967295 6");
  message.text = "DOOR 4";
  EXPECT_EQ(technol->text(message), "PLC00012 4294967295 4 4294967295 6 DOOR 4");
}

// TECHNOL: Windows-1250, the last byte is the terminator.
TEST(ControlTexts, OfMemory) {
  const auto technol = makeControl("technol"), nct = makeControl("nct");
  EXPECT_EQ(technol->memoryText("č1234", 4), "\xE8"
                                             "12");
  EXPECT_EQ(technol->shownText("\xE8"
                               "12"),
            "č12");
  EXPECT_EQ(nct->memoryText("č1234", 4), "č1234");
  EXPECT_EQ(nct->shownText("č1234"), "č1234");
}

TEST(ControlSlots, AreThoseOfThePmcFamily) {
  for (const char* dialect : {"fanuc", "gsk"}) EXPECT_TRUE(makeControl(dialect)->runsInSlots()) << dialect;
  for (const char* dialect : {"nct", "technol", "other"}) EXPECT_FALSE(makeControl(dialect)->runsInSlots()) << dialect;
}

} // namespace
