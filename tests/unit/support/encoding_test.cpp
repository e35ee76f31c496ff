// Other encodings than UTF-8.
#include "ir/support/encoding.h"

#include <gtest/gtest.h>

namespace rung {
namespace {

constexpr char kGb18030[] = "; \xBC\xB1\xCD\xA3 X0.0"; // in GB18030: "; 急停 X0.0"

TEST(Encoding, OfBytesAndBack) {
  const Decoded text = decoded(kGb18030, "gb18030");
  EXPECT_EQ(text.text, "; 急停 X0.0");
  EXPECT_FALSE(text.wrong);
  EXPECT_EQ(encoded(text.text, "gb18030"), kGb18030);
  EXPECT_EQ(decoded("\xFF\xFE"
                    "a\0b\0",
                    "utf-16")
                .text,
            "");
  EXPECT_EQ(decoded(std::string_view("\xFF\xFE"
                                     "a\0b\0",
                                     6),
                    "utf-16")
                .text,
            "ab");
}

TEST(Encoding, LongTexts) {
  std::string bytes;
  for (int i = 0; i < 10'000; ++i)
    bytes += "\xBC\xB1"
             "a";
  EXPECT_EQ(encoded(decoded(bytes, "GB18030").text, "GB18030"), bytes);
}

TEST(Encoding, TheFirstWrongByteIsFound) {
  EXPECT_EQ(decoded("ab\xFF", "gb18030").wrong, 2u);
  EXPECT_EQ(decoded("ab\xBC", "gb18030").wrong, 2u); // half of a character
  EXPECT_EQ(decoded("ab\xBC", "utf-8").wrong, 2u);
  EXPECT_EQ(encoded("急", "windows-1250"), std::nullopt);
}

TEST(Encoding, Names) {
  EXPECT_TRUE(knowsEncoding("gb18030"));
  EXPECT_TRUE(knowsEncoding("Windows-1250"));
  EXPECT_FALSE(knowsEncoding("klingon"));
  EXPECT_FALSE(knowsEncoding(""));                // iconv: that of the environment
  EXPECT_FALSE(knowsEncoding("ascii//TRANSLIT")); // loses characters
}

TEST(Encoding, OfATextThatDoesNotDeclareIt) {
  const auto wide = [](std::string_view text) { return encoded(text, "UTF-16LE").value(); };
  EXPECT_EQ(guessedEncoding(wide("%@3\r\n")), "UTF-16LE");
  EXPECT_EQ(guessedEncoding(wide(";Двери\r\n%@3\r\n")), "UTF-16LE");
  EXPECT_EQ(guessedEncoding(wide(";急停")), "UTF-8"); // nothing shows that it is a text
  EXPECT_EQ(guessedEncoding(wide(";急停\n")), "UTF-16LE");
  EXPECT_EQ(guessedEncoding(wide("P\x05\n")), "UTF-8");
  EXPECT_EQ(guessedEncoding("\xFF\xFE" + wide("é")), "UTF-16");
  EXPECT_EQ(guessedEncoding(std::string_view("A\0\0B", 4)), "UTF-8");
  EXPECT_EQ(guessedEncoding(""), "UTF-8");
  EXPECT_EQ(guessedEncoding("T\xC3\xBCr"), "UTF-8");
  EXPECT_EQ(guessedEncoding("T\xFCr"), "ISO-8859-1");
}

TEST(Encoding, IsNamedInOneOfTheFirstTwoLines) {
  const auto named = [](std::string_view text) {
    const auto line = encodingLine(text);
    return line ? line->name + " " + std::to_string(line->offset) : "";
  };
  EXPECT_EQ(named("; encoding: gb18030\nLD X0.0\n"), "gb18030 12");
  EXPECT_EQ(named("\xEF\xBB\xBF;Encoding:\tGB18030 \r\n"), "GB18030 14");
  EXPECT_EQ(named("dialect gsk\n; encoding: cp852"), "cp852 24");
  EXPECT_EQ(named("\n\n; encoding: cp852"), "");
  EXPECT_EQ(named("; encoding: of the tool magazine\n"), "");
  EXPECT_EQ(named("; encoding:\n"), "");
  EXPECT_EQ(named("encoding: cp852\n"), "");
  EXPECT_EQ(named(""), "");
}

} // namespace
} // namespace rung
