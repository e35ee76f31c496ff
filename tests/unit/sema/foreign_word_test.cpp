// Words and numbers of other languages.
#include "frontend/sema/foreign_word.h"

#include <gtest/gtest.h>

namespace rung::frontend {
namespace {

TEST(ForeignWord, ALetterForAnEdgeOrAnInversionIsNoSlip) {
  for (const char* word : {"LDP", "ldn", "LDI", "LDF"}) EXPECT_TRUE(isModified(word, "LD")) << word;
  for (const char* word : {"LD", "LDD", "LDPI", "ALD", "P"}) EXPECT_FALSE(isModified(word, "LD")) << word;
  EXPECT_FALSE(isModified("MECH_BEGINN", "MECH_BEGIN"));
  EXPECT_FALSE(isModified("N", ""));
}

TEST(ForeignWord, OneChangeFromTwoIsAmbiguous) {
  constexpr std::string_view kWords[] = {"LD", "LDI", "OR", "ORI", "OUT", "SET", "RST"};
  for (const char* word : {"RSET", "ST", "rset"}) EXPECT_TRUE(isAmbiguous(word, kWords)) << word;
  for (const char* word : {"LDN", "ORN", "WR", "RD", "S", "RESET", "SETT"})
    EXPECT_FALSE(isAmbiguous(word, kWords)) << word;
}

std::string digitsOf(std::string_view text) {
  const auto number = foreignNumber(text);
  return number ? std::string(number->digits) + " in base " + std::to_string(number->base) : "";
}

TEST(ForeignWord, NumbersInOtherForms) {
  for (const char* text : {"0x1F", "0X1F", "16#1F", "$1F", "#$1F", "&H1F", "1Fh", "1FH"})
    EXPECT_EQ(digitsOf(text), "1F in base 16") << text;
  for (const char* text : {"0b101", "2#101"}) EXPECT_EQ(digitsOf(text), "101 in base 2") << text;
  for (const char* text : {"", "h", "$", "0x", "1F", "101b", "0x1G", "2#12", "FFh", "-0x1F", "31"})
    EXPECT_EQ(digitsOf(text), "") << text;
}

} // namespace
} // namespace rung::frontend
