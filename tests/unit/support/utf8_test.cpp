// UTF-8 decoding.
#include <string>

#include <gtest/gtest.h>

#include "ir/support/utf8.h"

namespace rung {
namespace {

TEST(Utf8, DecodesCharactersOfEveryLength) {
  const std::string text = "a\u00E9\u4E2D\U0001F600";
  EXPECT_EQ(decodeUtf8(text, 0).value, 'a');
  EXPECT_EQ(decodeUtf8(text, 1).value, 0xE9u);
  EXPECT_EQ(decodeUtf8(text, 3).value, 0x4E2Du);
  EXPECT_EQ(decodeUtf8(text, 6).value, 0x1F600u);
  EXPECT_EQ(decodeUtf8(text, 6).length, 4);
  EXPECT_EQ(countCodePoints(text), 4u);
}

TEST(Utf8, FindsTheFirstBadByte) {
  constexpr size_t kNone = std::string_view::npos;
  EXPECT_EQ(findInvalidUtf8(""), kNone);
  EXPECT_EQ(findInvalidUtf8("plain text that is longer than a machine word"), kNone);
  EXPECT_EQ(findInvalidUtf8("caf\u00E9 \u4E2D\u6587 \U0001F600 and on and on"), kNone);
  EXPECT_EQ(findInvalidUtf8("0123456789\xE9zz"), 10u); // Latin-1
  EXPECT_EQ(findInvalidUtf8("a\xC0\x80"), 1u);         // overlong
  EXPECT_EQ(findInvalidUtf8("a\xE0\x80\x80"), 1u);     // overlong
  EXPECT_EQ(findInvalidUtf8("a\xED\xA0\x80"), 1u);     // surrogate
  EXPECT_EQ(findInvalidUtf8("a\xF4\x90\x80\x80"), 1u); // above U+10FFFF
  EXPECT_EQ(findInvalidUtf8("ab\xE4\xB8"), 2u);        // cut off
  EXPECT_EQ(findInvalidUtf8(std::string(20, 'x') + "\x80"), 20u);
}

TEST(Utf8, KnowsTheCellsOfATerminal) {
  EXPECT_EQ(displayWidth('x'), 1u);
  EXPECT_EQ(displayWidth(0xE9), 1u);
  EXPECT_EQ(displayWidth(0x4E2D), 2u);
  EXPECT_EQ(displayWidth(0x2500), 1u); // a line of a drawing
  EXPECT_EQ(displayWidth(0x1F600), 2u);
  EXPECT_EQ(displayWidth(0x1F321), 1u); // a thermometer is a picture as wide as a letter
  EXPECT_EQ(displayWidth(0x0301), 0u);
  EXPECT_EQ(displayWidth(0x05B0), 0u); // a Hebrew vowel
  EXPECT_EQ(displayWidth('\x01'), 0u);
}

} // namespace
} // namespace rung
