// Reading of the text of part programs.
#include "sim/part_program.h"

#include <algorithm>
#include <cmath>

#include "rtlib/text/letters.h"
#include "rtlib/text/number.h"

namespace rung::sim {

bool ProgramText::atBlockEnd() const { return at_ >= text_.size() || text_[at_] == ';' || text_[at_] == '\n'; }

bool ProgramText::nextBlock() { return at_++ < text_.size(); }

char ProgramText::here() const { return text::upper(written()); }

void ProgramText::skipBlanks() {
  while (written() == ' ' || written() == '\t' || written() == '\r') ++at_;
}

bool ProgramText::take(std::string_view word) {
  if (!text::startsWithIgnoringCase(text_.substr(std::min(at_, text_.size())), word)) return false;
  at_ += word.size();
  return true;
}

std::string ProgramText::skipComment() {
  const size_t end = text_.find(')', at_);
  if (end == std::string_view::npos) return "a comment without ')'";
  at_ = end + 1;
  return {};
}

std::optional<double> ProgramText::number() {
  if (written() == '+') ++at_;
  std::string_view rest = text_.substr(std::min(at_, text_.size()));
  const auto number = text::takeNumber<double>(rest, std::chars_format::fixed);
  if (!number || !std::isfinite(*number)) return std::nullopt; // "INF" and "NAN" are words
  at_ = text_.size() - rest.size();
  return number;
}

std::optional<uint32_t> ProgramText::variable() {
  const auto found = number();
  if (!found || *found < 1 || *found > lastVariable_) return std::nullopt;
  return static_cast<uint32_t>(*found);
}

std::optional<ProgramValue> ProgramText::value() {
  skipBlanks();
  if (!take("#")) {
    const auto found = number();
    return found ? std::optional(ProgramValue{.number = *found}) : std::nullopt;
  }
  const auto found = variable();
  return found ? std::optional(ProgramValue{.variable = *found}) : std::nullopt;
}

bool isCode(std::span<const int> tenths, double code) {
  return std::ranges::find(tenths, std::lround(code * 10)) != tenths.end();
}

} // namespace rung::sim
