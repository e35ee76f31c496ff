// Characters of ASCII.
#include "rtlib/text/letters.h"

#include <gtest/gtest.h>

namespace rung {
namespace {

TEST(Ascii, KindsOfCharacters) {
  for (const char c : {'0', '9'}) EXPECT_TRUE(text::isDigit(c)) << c;
  for (const char c : {'/', ':', 'a', '\xB2'}) EXPECT_FALSE(text::isDigit(c)) << c;
  for (const char c : {'a', 'z', 'A', 'Z'}) EXPECT_TRUE(text::isLetter(c)) << c;
  for (const char c : {'@', '[', '`', '{', '0', '_', '\xE9'}) EXPECT_FALSE(text::isLetter(c)) << c;
}

TEST(Ascii, HexadecimalDigits) {
  EXPECT_EQ(text::hexDigit('0'), 0);
  EXPECT_EQ(text::hexDigit('9'), 9);
  EXPECT_EQ(text::hexDigit('A'), 10);
  EXPECT_EQ(text::hexDigit('f'), 15);
  for (const char c : {'G', 'g', '@', '`', ' '}) EXPECT_EQ(text::hexDigit(c), -1) << c;
}

} // namespace
} // namespace rung
