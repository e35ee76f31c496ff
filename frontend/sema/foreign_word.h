// Words and numbers that programmers bring along from other languages and controls, and what is written for them here.
// Each dialect has one table of the words.
#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string_view>

#include "ir/support/diagnostics.h"
#include "rtlib/text/similar.h"

namespace rung::frontend {

struct ForeignWord {
  std::string_view word; // in capitals; of two words of a statement with a blank between
  std::string_view here; // one of this language that means the same, or how it is said here
  bool same = false;     // the first: it is written in its place, with the same operands
};

// In any case; null when it is none of them.
const ForeignWord* findForeign(std::span<const ForeignWord> words, std::string_view word);

// Adds what is written instead. With a fix only where the meaning stays and `fits`: the operands are those of the word.
void explainForeign(DiagBuilder& report, SourceRange range, const ForeignWord& word, bool fits);

// Whether a word is one of this language with a letter after it by which others invert the value (N, I) or ask for an
// edge (P, F): not a slip of the hand, and the word alone does something else.
bool isModified(std::string_view word, std::string_view known);

// Whether a word is as likely a slip of the hand for any of several of these, which would do different things.
template <class Words, class NameOf = std::identity>
bool isAmbiguous(std::string_view word, Words&& words, NameOf nameOf = {}) {
  text::Similar similar(word);
  for (const auto& one : words)
    if (!isModified(word, std::invoke(nameOf, one))) similar.offer(std::invoke(nameOf, one));
  return similar.ambiguous();
}

// The digits of a number in another language's form: 0x1F, 16#1F, $1F, #$1F, &H1F, 1Fh; 0b101, 2#101.
struct ForeignNumber {
  std::string_view digits;
  uint32_t base = 16;
};
std::optional<ForeignNumber> foreignNumber(std::string_view text);

// A time in another language's form, with its unit: T#5s, 2.5s, 100ms, T#1m30s.
struct ForeignTime {
  enum class Unit : uint8_t { Milliseconds, Seconds, Minutes, Hours };
  uint64_t amount = 0;
  Unit unit = Unit::Milliseconds; // that of a single whole number; else milliseconds
  uint64_t milliseconds() const;
};
std::optional<ForeignTime> foreignTime(std::string_view text);

// A comparison in the place of an operand, `a > 5`: its sides without blanks, and what IEC 61131 calls it.
struct ForeignComparison {
  std::string_view left;
  std::string_view word; // GT, GE, EQ, NE, LE, LT
  std::string_view right;
};
std::optional<ForeignComparison> foreignComparison(std::string_view text);

} // namespace rung::frontend
