// The character sets of Czech sources.
#include <gtest/gtest.h>

#include "rtlib/nc/technol/code_page.h"

namespace rung::nc {
namespace {

TEST(CodePage, EveryByteOfWindows1250ComesBack) {
  for (int byte = 1; byte < 256; ++byte) {
    const std::string memory(1, static_cast<char>(byte));
    EXPECT_EQ(memoryText(shownText(memory)), memory) << byte;
  }
}

TEST(CodePage, LettersOfBothPages) {
  EXPECT_EQ(utf8From(CodePage::Windows1250, "P\xF8\xEDli\x9A"), "Příliš");
  EXPECT_EQ(utf8From(CodePage::Cp852, "P\xFD\xA1li\xE7"), "Příliš");
  EXPECT_EQ(memoryText("Příliš"), "P\xF8\xEDli\x9A");
}

TEST(CodePage, WhatHasNoByteIsAQuestionMark) { EXPECT_EQ(memoryText("a\u4E2Db\U0001F600"), "a?b?"); }

TEST(CodePage, GuessesByTheLetters) {
  EXPECT_EQ(guessCodePage("\x8Er\xE1"
                          "dlo, \xE8"
                          "erpadlo"),
            CodePage::Windows1250);
  EXPECT_EQ(guessCodePage("\xA6r\xA0"
                          "dlo, \x9F"
                          "erpadlo"),
            CodePage::Cp852);
  EXPECT_EQ(guessCodePage("plain"), CodePage::Windows1250);
}

} // namespace
} // namespace rung::nc
