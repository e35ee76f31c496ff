// Lines, words and comments.
#include "frontend/syntax/word_lexer.h"

#include <gtest/gtest.h>

namespace rung {
namespace {

std::string wordsOf(std::string_view text, const frontend::WordRules& rules = {}) {
  frontend::LineWords words;
  splitWords({1, text, SourcePos{1}}, rules, words);
  std::string result;
  for (const frontend::Word& word : words.words)
    result += word.quoted ? "<" + std::string(word.text) + ">" : "[" + std::string(word.text) + "]";
  if (words.hasComment) result += ";" + std::string(words.comment);
  if (words.unterminatedQuote) result += " unterminated";
  return result;
}

TEST(WordLexer, WordsAreSeparatedByBlanksAndTabs) {
  EXPECT_EQ(wordsOf("  LD   X002.1\tR0 "), "[LD][X002.1][R0]");
  EXPECT_EQ(wordsOf(""), "");
  EXPECT_EQ(wordsOf("   "), "");
}

TEST(WordLexer, CommentRunsToTheEnd) {
  EXPECT_EQ(wordsOf("LD A;  the \"door\" ; "), "[LD][A];the \"door\" ;");
  EXPECT_EQ(wordsOf(";"), ";");
  EXPECT_EQ(wordsOf("# no ; comment", {.comment = '#'}), ";no ; comment");
}

TEST(WordLexer, QuotedTextIsOneWordAndHidesComments) {
  EXPECT_EQ(wordsOf("message 20 \"a; {#0:F0} b\" ; c"), "[message][20]<a; {#0:F0} b>;c");
  EXPECT_EQ(wordsOf("\"\""), "<>");
  EXPECT_EQ(wordsOf("A\"b\"C"), "[A]<b>[C]");
  EXPECT_EQ(wordsOf("STR 'it is' ;x", {.quotes = "'"}), "[STR]<it is>;x");
}

TEST(WordLexer, TextThatIsNotClosed) {
  EXPECT_EQ(wordsOf("rung \"a ; b"), "[rung]<a ; b> unterminated");
  EXPECT_EQ(wordsOf("\""), "<> unterminated");
}

TEST(WordLexer, SeparatorsAreWords) {
  EXPECT_EQ(wordsOf("LAB: DFM a,,b", {.separators = ",:"}), "[LAB][:][DFM][a][,][,][b]");
  EXPECT_EQ(wordsOf("LAB: a,b"), "[LAB:][a,b]");
}

TEST(WordLexer, RangesIncludeQuotes) {
  frontend::LineWords words;
  const frontend::SourceLine line{1, "ab \"cd\" ;e", SourcePos{100}};
  splitWords(line, {}, words);
  EXPECT_EQ(words.words[0].range, (SourceRange{{100}, {102}}));
  EXPECT_EQ(words.words[1].range, (SourceRange{{103}, {107}}));
  EXPECT_EQ(words.commentRange, (SourceRange{{108}, {110}}));
}

TEST(LineReader, TakesBothLineEndsAndSkipsAByteOrderMark) {
  SourceManager sources;
  const FileId file = sources.addBuffer("f", "\xEF\xBB\xBFone\r\n\ntwo");
  frontend::LineReader reader(sources, file);
  frontend::SourceLine line;
  ASSERT_TRUE(reader.next(line));
  EXPECT_EQ(line.text, "one");
  EXPECT_EQ(sources.text({line.begin, line.at(3)}), "one");
  ASSERT_TRUE(reader.next(line));
  EXPECT_EQ(line.text, "");
  ASSERT_TRUE(reader.next(line));
  EXPECT_EQ(line.text, "two");
  EXPECT_EQ(line.number, 3u);
  EXPECT_FALSE(reader.next(line));
}

TEST(CheckEncoding, FindsBytesThatAreNoText) {
  SourceManager sources;
  Diagnostics diags;
  EXPECT_TRUE(frontend::checkEncoding(sources, sources.addBuffer("good", "; caf\u00E9"), diags));
  EXPECT_FALSE(frontend::checkEncoding(sources, sources.addBuffer("latin", "a\n; caf\xE9"), diags));
  EXPECT_FALSE(frontend::checkEncoding(sources, sources.addBuffer("binary", std::string("ab\0c", 4)), diags));
  ASSERT_EQ(diags.errorCount(), 2u);
  const LineCol at = sources.lineCol(diags.reported()[0].range.begin);
  EXPECT_EQ(at, (LineCol{"latin", 2, 6}));
  EXPECT_EQ(messageOf(diags.reported()[1]), "the text is not UTF-8 (byte 0x00)");
}

} // namespace
} // namespace rung
