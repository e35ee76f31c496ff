// Letters, numbers and blanks of texts.
#include <clocale>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "rtlib/text/blanks.h"
#include "rtlib/text/hex.h"
#include "rtlib/text/letters.h"
#include "rtlib/text/number.h"

namespace {

using namespace rung;
using std::nullopt;

TEST(Letters, OnlyThoseOfAsciiChange) {
  for (int byte = 0; byte < 256; ++byte) {
    const char c = static_cast<char>(byte);
    const bool small = byte >= 'a' && byte <= 'z', capital = byte >= 'A' && byte <= 'Z';
    EXPECT_EQ(text::upper(c), small ? static_cast<char>(byte - 32) : c) << byte;
    EXPECT_EQ(text::lower(c), capital ? static_cast<char>(byte + 32) : c) << byte;
  }
}

TEST(Blanks, AroundAText) {
  EXPECT_EQ(text::trimmed(" \ta b\t \r\n"), "a b");
  EXPECT_EQ(text::trimmed("a"), "a");
  EXPECT_EQ(text::trimmed(" \t\r\n"), "");
  EXPECT_EQ(text::trimmed(""), "");
}

TEST(Letters, OfTexts) {
  EXPECT_EQ(text::upper(""), "");
  EXPECT_EQ(text::lower(""), "");
  EXPECT_EQ(text::upper("[az]{AZ}`@ 09_\xE4\xFD"), "[AZ]{AZ}`@ 09_\xE4\xFD");
  EXPECT_EQ(text::lower("[az]{AZ}`@ 09_\xC4\xDD"), "[az]{az}`@ 09_\xC4\xDD");
  EXPECT_EQ(text::upper(std::string_view("a\0b", 3)), std::string("A\0B", 3));
  EXPECT_EQ(text::lower("Příliš"), "příliš"); // of UTF-8: no byte of ř or š is a letter
}

// Turkish has other capitals of i; where that locale is missing, this is the test above.
TEST(Letters, WhateverTheLocale) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  for (const char* locale : {"tr_TR.ISO8859-9", "de_DE.ISO8859-1", "C.UTF-8"}) {
    std::setlocale(LC_ALL, locale);
    EXPECT_EQ(text::upper("i\xFD\xE4"), "I\xFD\xE4") << locale;
    EXPECT_EQ(text::lower("I\xDD\xC4"), "i\xDD\xC4") << locale;
    std::setlocale(LC_ALL, before.c_str());
  }
}

TEST(Letters, CompareWithoutCase) {
  EXPECT_TRUE(text::equalsIgnoringCase("", ""));
  EXPECT_TRUE(text::equalsIgnoringCase("Word_9", "wORD_9"));
  EXPECT_FALSE(text::equalsIgnoringCase("word", "words"));
  EXPECT_FALSE(text::equalsIgnoringCase("words", "word"));
  EXPECT_FALSE(text::equalsIgnoringCase("", "a"));
  EXPECT_FALSE(text::equalsIgnoringCase("[", "{")); // as far apart as a and A
  EXPECT_FALSE(text::equalsIgnoringCase("@", "`"));
  EXPECT_FALSE(text::equalsIgnoringCase("\xC4", "\xE4"));
  EXPECT_FALSE(text::equalsIgnoringCase(std::string_view("a\0b", 3), std::string_view("a\0c", 3)));
}

TEST(Letters, BeginningsWithoutCase) {
  EXPECT_TRUE(text::startsWithIgnoringCase("PlcTable3", "pLCtABLE"));
  EXPECT_TRUE(text::startsWithIgnoringCase("a", ""));
  EXPECT_TRUE(text::startsWithIgnoringCase("ab", "AB"));
  EXPECT_FALSE(text::startsWithIgnoringCase("a", "ab"));
  EXPECT_FALSE(text::startsWithIgnoringCase("", "a"));
  EXPECT_FALSE(text::startsWithIgnoringCase("{a", "["));
  std::string_view rest = "Can[1].x";
  EXPECT_FALSE(text::takePrefixIgnoringCase(rest, "COM["));
  EXPECT_EQ(rest, "Can[1].x");
  EXPECT_TRUE(text::takePrefixIgnoringCase(rest, "CAN["));
  EXPECT_EQ(rest, "1].x");
}

TEST(Hex, OfBytesAndNumbers) {
  const uint8_t bytes[] = {0x01, 0x2A, 0xFF};
  EXPECT_EQ(text::hexOf(bytes), "012AFF");
  EXPECT_EQ(text::hexOf({}), "");
  EXPECT_EQ(text::hexInPairs("\x01*\xFF"), "01 2A FF");
  EXPECT_EQ(text::hexInPairs(""), "");
  EXPECT_EQ(text::hexOfNumber(0x6040041, 4), "06040041");
  EXPECT_EQ(text::hexOfNumber(0x1234, 1), "34");
  EXPECT_EQ(text::hexOfNumber(UINT64_MAX, 8), "FFFFFFFFFFFFFFFF");
}

TEST(Letters, OrderIsThatOfTheCapitals) {
  const std::string_view texts[] = {"",  "A",  "a",  "AB",   "ab",   "_",    "Z",
                                    "[", "a_", "aB", "\x7F", "\x80", "\xFF", "a\xFF"};
  for (const std::string_view a : texts)
    for (const std::string_view b : texts) {
      const int expected = text::upper(a).compare(text::upper(b)), found = text::compareIgnoringCase(a, b);
      EXPECT_EQ(found < 0, expected < 0) << a << " " << b;
      EXPECT_EQ(found > 0, expected > 0) << a << " " << b;
    }
}

TEST(Letters, AreKnownToTheCompiler) {
  static_assert(text::upper('a') == 'A' && text::lower('Z') == 'z');
  static_assert(text::equalsIgnoringCase("Ab", "aB") && text::compareIgnoringCase("a", "B") < 0);
}

TEST(Number, IsTheWholeText) {
  EXPECT_EQ(text::numberIn<uint32_t>("0"), 0u);
  EXPECT_EQ(text::numberIn<uint32_t>("0012"), 12u);
  for (const char* wrong : {"", " ", "x", "12 ", " 12", "12x", "1.5", "1,000", "0x12", "1e3", "\xB2", "12\xB2"})
    EXPECT_EQ(text::numberIn<uint32_t>(wrong), nullopt) << wrong;
  EXPECT_EQ(text::numberIn<uint32_t>(std::string_view("1\0", 2)), nullopt);
  EXPECT_EQ(text::numberIn<uint32_t>(std::string_view()), nullopt);
}

TEST(Number, OnlySignedOnesHaveASign) {
  for (const char* wrong : {"-1", "-0", "+1", "+", "-"}) EXPECT_EQ(text::numberIn<uint32_t>(wrong), nullopt) << wrong;
  EXPECT_EQ(text::numberIn<int32_t>("-1"), -1);
  EXPECT_EQ(text::numberIn<int32_t>("-0"), 0);
  for (const char* wrong : {"+1", "--1", "- 1", "-"}) EXPECT_EQ(text::numberIn<int32_t>(wrong), nullopt) << wrong;
}

TEST(Number, EndsAtTheLimitsOfItsType) {
  EXPECT_EQ(text::numberIn<uint8_t>("255"), 255);
  EXPECT_EQ(text::numberIn<uint8_t>("256"), nullopt);
  EXPECT_EQ(text::numberIn<uint32_t>("4294967295"), UINT32_MAX);
  EXPECT_EQ(text::numberIn<uint32_t>("4294967296"), nullopt);
  EXPECT_EQ(text::numberIn<uint32_t>("000000000000004294967295"), UINT32_MAX);
  EXPECT_EQ(text::numberIn<int64_t>("9223372036854775807"), INT64_MAX);
  EXPECT_EQ(text::numberIn<int64_t>("9223372036854775808"), nullopt);
  EXPECT_EQ(text::numberIn<int64_t>("-9223372036854775808"), INT64_MIN);
  EXPECT_EQ(text::numberIn<int64_t>("-9223372036854775809"), nullopt);
  EXPECT_EQ(text::numberIn<uint64_t>("18446744073709551615"), UINT64_MAX);
  EXPECT_EQ(text::numberIn<uint64_t>("18446744073709551616"), nullopt);
}

TEST(Number, OfAnotherBase) {
  EXPECT_EQ(text::numberIn<uint32_t>("fF", 16), 255u);
  EXPECT_EQ(text::numberIn<uint32_t>("FFFFFFFF", 16), UINT32_MAX);
  EXPECT_EQ(text::numberIn<uint32_t>("100000000", 16), nullopt);
  EXPECT_EQ(text::numberIn<uint32_t>("101", 2), 5u);
  for (const char* wrong : {"", "0x1", "G", "-1"}) EXPECT_EQ(text::numberIn<uint32_t>(wrong, 16), nullopt) << wrong;
  EXPECT_EQ(text::numberIn<uint32_t>("102", 2), nullopt);
}

TEST(Number, IsTakenFromTheBeginning) {
  std::string_view rest = "12.5ms";
  EXPECT_EQ(text::takeNumber<uint32_t>(rest), 12u);
  EXPECT_EQ(rest, ".5ms");
  EXPECT_EQ(text::takeNumber<uint32_t>(rest), nullopt);
  EXPECT_EQ(rest, ".5ms");
  rest = "300 "; // out of the range: nothing is taken
  EXPECT_EQ(text::takeNumber<uint8_t>(rest), nullopt);
  EXPECT_EQ(rest, "300 ");
  rest = "1e3";
  EXPECT_EQ(text::takeNumber<double>(rest, std::chars_format::fixed), 1.0);
  EXPECT_EQ(rest, "e3");
  rest = {};
  EXPECT_EQ(text::takeNumber<uint32_t>(rest), nullopt);
}

TEST(Number, RealIsFinite) {
  EXPECT_EQ(text::realIn("-0.5"), -0.5);
  EXPECT_EQ(text::realIn("1e3"), 1000.0);
  EXPECT_EQ(text::realIn("12"), 12.0);
  EXPECT_EQ(text::realIn("1."), 1.0);
  EXPECT_EQ(text::realIn("1.7976931348623157e308"), std::numeric_limits<double>::max());
  EXPECT_EQ(text::realIn("+1"), 1.0);
  EXPECT_EQ(text::realIn("-0x10"), -16.0);
  EXPECT_EQ(text::realIn("100000000000000000000"), 1e20);
  EXPECT_EQ(text::realIn("5e-324"), 5e-324);
  EXPECT_EQ(text::realIn("-0.0e-999"), 0.0);
  for (const char* wrong : {"", "inf", "-INF", "nan", "1e309", "1e-999", "-0.01e-400", " 1", "1 ", "1,5", "0x1p3", ".",
                            "--1", "+-1", "-+1", "1_000.5"})
    EXPECT_EQ(text::realIn(wrong), nullopt) << wrong;
}

TEST(WrittenNumber, WholeOnesOfAllForms) {
  const std::pair<const char*, int64_t> kForms[] = {{"-25", -25},  {"+3", 3},       {"0x1F", 31},   {"0X1f", 31},
                                                    {"16#1F", 31}, {"0b101", 5},    {"0B1", 1},     {"2#101", 5},
                                                    {"8#17", 15},  {"1_000", 1000}, {"0xF_F", 255}, {"-0x80", -128},
                                                    {"0", 0},      {"-0", 0},       {"007", 7}};
  for (const auto& [text, value] : kForms) EXPECT_EQ(text::wholeIn<int64_t>(text), value) << text;
  for (const char* wrong : {"",   "-",    "+",    "x",  "0x", "16#", "0b",  "0b2", "8#8",  "2#2",  "0xG", "_1",
                            "1_", "1__0", "0x_1", "1 ", " 1", "1.0", "1e3", "--1", "0x-1", "10#5", "1#",  "inf"})
    EXPECT_EQ(text::wholeIn<int64_t>(wrong), nullopt) << wrong;
}

TEST(WrittenNumber, EndsAtTheLimitsOfItsType) {
  EXPECT_EQ(text::wholeIn<uint8_t>("0xFF"), 255);
  EXPECT_EQ(text::wholeIn<uint8_t>("256"), nullopt);
  EXPECT_EQ(text::wholeIn<uint8_t>("-1"), nullopt);
  EXPECT_EQ(text::wholeIn<int8_t>("-0x80"), -128);
  EXPECT_EQ(text::wholeIn<int8_t>("-129"), nullopt);
  EXPECT_EQ(text::wholeIn<int8_t>("128"), nullopt);
  EXPECT_EQ(text::wholeIn<uint64_t>("18446744073709551615"), UINT64_MAX);
  EXPECT_EQ(text::wholeIn<uint64_t>("18446744073709551616"), nullopt);
  EXPECT_EQ(text::wholeIn<uint64_t>("0xFFFFFFFFFFFFFFFF"), UINT64_MAX);
  EXPECT_EQ(text::wholeIn<int64_t>("9223372036854775808"), nullopt);
  EXPECT_EQ(text::wholeIn<int64_t>("-9223372036854775808"), INT64_MIN);
  EXPECT_EQ(text::wholeIn<int64_t>("-9223372036854775809"), nullopt);
}

TEST(WrittenNumber, SaysWhatNoCellHolds) {
  using enum text::NumberForm;
  const std::pair<const char*, text::NumberForm> kForms[] = {{"1", Whole},
                                                             {"1.5", Real},
                                                             {"inf", Real},
                                                             {"-nan", Real},
                                                             {"1e308", Real},
                                                             {"99999999999999999999", TooLong},
                                                             {"18446744073709551616", TooLong},
                                                             {"-9223372036854775809", TooLong},
                                                             {"18446744073709551616.0", Real},
                                                             {"1844674407370955161e1", Real},
                                                             {"1e999", OutOfRange},
                                                             {"-1e999", OutOfRange},
                                                             {"1e-999", OutOfRange},
                                                             {"0x10000000000000000", OutOfRange},
                                                             {"-0x8000000000000001", OutOfRange},
                                                             {"0e-999", Real},
                                                             {"x", None},
                                                             {"", None},
                                                             {"1e", None}};
  for (const auto& [text, form] : kForms) EXPECT_EQ(text::writtenNumber(text).form, form) << text;
}

TEST(WrittenNumber, FitsBitsWithASignOrWithout) {
  const auto fits = [](const char* text, uint32_t bits) { return text::fitsBits(text::writtenNumber(text), bits); };
  for (const char* right : {"255", "-1", "-128", "0xFF"}) EXPECT_TRUE(fits(right, 8)) << right;
  for (const char* wrong : {"256", "-129", "1.0", "x", "18446744073709551615"}) EXPECT_FALSE(fits(wrong, 8)) << wrong;
  EXPECT_TRUE(fits("0", 1) && fits("1", 1) && fits("-0", 1));
  EXPECT_FALSE(fits("2", 1) || fits("-1", 1));
  EXPECT_TRUE(fits("-9223372036854775808", 64) && fits("18446744073709551615", 64));
}

} // namespace
