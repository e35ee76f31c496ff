// The scanner of the text form (see scanner.h).
#include "ir/text/scanner.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>

#include "ir/text/keywords.h"
#include "rtlib/text/letters.h"

namespace rung::ir {
void Scanner::fail(std::string message) {
  if (!ok()) return;
  message_ = std::move(message);
  errorAt_ = std::min(token_, text_.size());
  pos_ = text_.size();
}

ParseError Scanner::error() const {
  const std::string_view before = text_.substr(0, errorAt_);
  const size_t lineStart = before.rfind('\n') == std::string_view::npos ? 0 : before.rfind('\n') + 1;
  return {static_cast<uint32_t>(std::count(before.begin(), before.end(), '\n') + 1),
          static_cast<uint32_t>(errorAt_ - lineStart + 1), message_};
}

void Scanner::skipBlanks() {
  while (more() && (text_[pos_] == ' ' || text_[pos_] == '\t' || text_[pos_] == '\r')) ++pos_;
  if (more() && text_[pos_] == ';') pos_ = std::min(text_.find('\n', pos_), text_.size());
  token_ = pos_;
}

void Scanner::skipEmptyLines() {
  for (skipBlanks(); more() && text_[pos_] == '\n'; skipBlanks()) ++pos_;
}

void Scanner::endLine() {
  skipBlanks();
  if (more() && text_[pos_] != '\n') return fail("end of line expected");
  skipEmptyLines();
}

bool Scanner::atEnd() {
  skipEmptyLines();
  return !more();
}

bool Scanner::peek(char c) {
  skipBlanks();
  return more() && text_[pos_] == c;
}

bool Scanner::accept(char c) {
  if (!peek(c)) return false;
  ++pos_;
  return true;
}

void Scanner::expect(char c) {
  if (!accept(c)) fail(fmt::format("'{}' expected", c));
}

bool Scanner::acceptWord(std::string_view word) {
  skipBlanks();
  if (text_.substr(pos_, word.size()) != word) return false;
  if (pos_ + word.size() < text_.size() && isNameChar(text_[pos_ + word.size()])) return false;
  pos_ += word.size();
  return true;
}

void Scanner::expectWord(std::string_view word) {
  if (!acceptWord(word)) fail(fmt::format("'{}' expected", word));
}

bool Scanner::peekName() {
  skipBlanks();
  return more() && (text_[pos_] == '"' || (isNameChar(text_[pos_]) && !text::isDigit(text_[pos_])));
}

bool Scanner::peekNumber() {
  skipBlanks();
  return more() && text::isDigit(text_[pos_]);
}

std::string_view Scanner::word() {
  skipBlanks();
  const size_t begin = pos_;
  if (!more() || !isNameChar(text_[pos_]) || text::isDigit(text_[pos_])) {
    fail("word expected");
    return {};
  }
  while (more() && isNameChar(text_[pos_])) ++pos_;
  return text_.substr(begin, pos_ - begin);
}

std::string Scanner::name() { return peek('"') ? text() : std::string(word()); }

std::string Scanner::text() {
  std::string out;
  expect('"');
  while (more() && text_[pos_] != '"' && text_[pos_] != '\n') {
    char c = text_[pos_++];
    if (c == '\\' && more()) {
      c = text_[pos_++];
      if (c == 'n')
        c = '\n';
      else if (c == 'r')
        c = '\r';
      else if (c == 't')
        c = '\t';
      else if (c == 'x') {
        const int high = more() ? text::hexDigit(text_[pos_]) : -1;
        const int low = pos_ + 1 < text_.size() ? text::hexDigit(text_[pos_ + 1]) : -1;
        if (high < 0 || low < 0) fail("two hexadecimal digits expected after \\x");
        pos_ = std::min(pos_ + 2, text_.size());
        c = static_cast<char>(high * 16 + low);
      } else if (c != '"' && c != '\\')
        fail("unknown escape");
    }
    out += c;
  }
  if (!more() || text_[pos_] != '"')
    fail("text without its closing quote");
  else
    ++pos_;
  return out;
}

uint64_t Scanner::u64() {
  skipBlanks();
  uint64_t value = 0;
  const bool hex = text_.substr(pos_, 2) == "0x";
  const char* begin = text_.data() + pos_ + (hex ? 2 : 0);
  const auto [end, code] = std::from_chars(begin, text_.data() + text_.size(), value, hex ? 16 : 10);
  if (code != std::errc()) {
    fail(code == std::errc::result_out_of_range ? "number too large" : "number expected");
    return 0;
  }
  pos_ = static_cast<size_t>(end - text_.data());
  return value;
}

uint32_t Scanner::u32() {
  const uint64_t value = u64();
  if (value > UINT32_MAX) fail("number too large");
  return static_cast<uint32_t>(value);
}

int64_t Scanner::i64() {
  const bool minus = accept('-');
  const uint64_t value = u64();
  return static_cast<int64_t>(minus ? 0 - value : value);
}

double Scanner::real() {
  skipBlanks();
  double value = 0;
  const auto [end, code] = std::from_chars(text_.data() + pos_, text_.data() + text_.size(), value);
  if (code != std::errc())
    fail("number expected");
  else
    pos_ = static_cast<size_t>(end - text_.data());
  return value;
}

std::string_view Scanner::hexDigits() {
  skipBlanks();
  const size_t begin = pos_;
  while (more() && text::hexDigit(text_[pos_]) >= 0) ++pos_;
  return text_.substr(begin, pos_ - begin);
}

} // namespace rung::ir
