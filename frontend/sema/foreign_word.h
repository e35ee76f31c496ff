// Words and numbers that programmers use from other languages and controls, and their equivalents. Each dialect has one
// table of the words.
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
  std::string_view word; // in capitals; for two words of a statement, with a blank between
  std::string_view here; // an equivalent word of this language, or how to express it
  bool same = false;     // `here` replaces it, with the same operands
};

// Ignoring case; null if it is unknown.
const ForeignWord* findForeign(std::span<const ForeignWord> words, std::string_view word);

// Adds the equivalent to the report. With a fix only if the meaning is the same and `fits`: the operands suit the word.
void explainForeign(DiagBuilder& report, SourceRange range, const ForeignWord& word, bool fits);

// Whether a word is one of this language with a suffix by which other languages invert the value (N, I) or detect an
// edge (P, F): this is not a typing error, and the word without suffix has another meaning.
bool isModified(std::string_view word, std::string_view known);

// Whether a word could equally be a misspelling of several of these, which have different meanings.
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
  Unit unit = Unit::Milliseconds; // unit of a single whole number; otherwise milliseconds
  uint64_t milliseconds() const;
};
std::optional<ForeignTime> foreignTime(std::string_view text);

// A comparison in place of an operand, `a > 5`: its sides without blanks, and its name in IEC 61131.
struct ForeignComparison {
  std::string_view left;
  std::string_view word; // GT, GE, EQ, NE, LE, LT
  std::string_view right;
};
std::optional<ForeignComparison> foreignComparison(std::string_view text);

} // namespace rung::frontend
