// Lines, words and comments; see the header.
#include "frontend/syntax/word_lexer.h"

#include <algorithm>

#include <fmt/format.h>

#include "ir/support/diag/source.h"
#include "ir/support/utf8.h"
#include "rtlib/text/blanks.h"

namespace rung::frontend {
namespace {

bool isBlank(char c) { return c == ' ' || c == '\t'; }

bool contains(std::string_view set, char c) { return set.find(c) != std::string_view::npos; }

/// End of a plain word that begins at `begin`.
size_t wordEnd(std::string_view text, size_t begin, const WordRules& rules) {
  size_t end = begin;
  while (end < text.size() && !isBlank(text[end]) && text[end] != rules.comment && !contains(rules.quotes, text[end]) &&
         !contains(rules.separators, text[end])) {
    ++end;
  }
  return end;
}

} // namespace

LineReader::LineReader(const SourceManager& sources, FileId file)
    : text_(sources.text(file)), begin_(sources.position(file, 0)) {
  if (text_.starts_with(kByteOrderMark)) offset_ = kByteOrderMark.size();
}

bool LineReader::next(SourceLine& line) {
  if (offset_ >= text_.size()) return false;
  const size_t newline = text_.find('\n', offset_);
  size_t end = newline == std::string_view::npos ? text_.size() : newline;
  const size_t following = newline == std::string_view::npos ? end : newline + 1;
  if (end > offset_ && text_[end - 1] == '\r') --end;
  line.number = ++number_;
  line.text = text_.substr(offset_, end - offset_);
  line.begin = {begin_.value + static_cast<uint32_t>(offset_)};
  offset_ = following;
  return true;
}

void splitWords(const SourceLine& line, const WordRules& rules, LineWords& out) {
  out.words.clear();
  out.hasComment = false;
  out.comment = {};
  out.commentRange = {};
  out.unterminatedQuote = false;
  const std::string_view text = line.text;
  size_t at = 0;
  while (at < text.size()) {
    const char c = text[at];
    if (isBlank(c)) {
      ++at;
    } else if (c == rules.comment) {
      out.hasComment = true;
      out.comment = text::trimmed(text.substr(at + 1));
      out.commentRange = line.range(at, text.size());
      return;
    } else if (contains(rules.quotes, c)) {
      const size_t close = text.find(c, at + 1);
      const bool closed = close != std::string_view::npos;
      const size_t textEnd = closed ? close : text.size();
      const size_t end = closed ? close + 1 : textEnd;
      out.words.push_back({text.substr(at + 1, textEnd - at - 1), line.range(at, end), true});
      out.unterminatedQuote = !closed;
      at = end;
    } else {
      const size_t end = contains(rules.separators, c) ? at + 1 : wordEnd(text, at, rules);
      out.words.push_back({text.substr(at, end - at), line.range(at, end), false});
      at = end;
    }
  }
}

bool checkEncoding(const SourceManager& sources, FileId file, Diagnostics& diagnostics) {
  const std::string_view text = sources.text(file);
  const std::optional<SourceManager::Undecoded>& undecoded = sources.undecoded(file);
  if (undecoded && !undecoded->known) {
    const size_t first = undecoded->offset;
    diagnostics.report(diag::UnknownEncoding, sources.range(file, first, first + undecoded->encoding.size()))
        << undecoded->encoding;
    return false;
  }
  const size_t offset = undecoded ? undecoded->offset : std::min(findInvalidUtf8(text), text.find('\0'));
  if (offset == std::string_view::npos) return true;
  DiagBuilder report = diagnostics.report(diag::BadEncoding, sources.range(file, offset, offset + 1));
  report << fmt::format("0x{:02X}", static_cast<unsigned char>(text[offset]))
         << (undecoded ? undecoded->encoding : "UTF-8");
  if (!undecoded && (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")))
    report.note("it begins as UTF-16 does: `encoding = \"utf-16\"` in the project file says so");
  else if (!undecoded && text[offset] != '\0')
    report.note(
        "a file in another encoding names it in its first line, for instance `; encoding: windows-1250`; or the "
        "project file does, `encoding = \"windows-1250\"`");
  return false;
}

} // namespace rung::frontend
