// Characters of ASCII.
#include "ir/support/ascii.h"

#include <gtest/gtest.h>

namespace rung {
namespace {

TEST(Ascii, KindsOfCharacters) {
  for (const char c : {'0', '9'}) EXPECT_TRUE(isDigit(c)) << c;
  for (const char c : {'/', ':', 'a', '\xB2'}) EXPECT_FALSE(isDigit(c)) << c;
  for (const char c : {'a', 'z', 'A', 'Z'}) EXPECT_TRUE(isLetter(c)) << c;
  for (const char c : {'@', '[', '`', '{', '0', '_', '\xE9'}) EXPECT_FALSE(isLetter(c)) << c;
}

TEST(Ascii, HexadecimalDigits) {
  EXPECT_EQ(hexDigit('0'), 0);
  EXPECT_EQ(hexDigit('9'), 9);
  EXPECT_EQ(hexDigit('A'), 10);
  EXPECT_EQ(hexDigit('f'), 15);
  for (const char c : {'G', 'g', '@', '`', ' '}) EXPECT_EQ(hexDigit(c), -1) << c;
}

} // namespace
} // namespace rung
