// Words that programmers bring along from other languages and controls, and what is written for them here. Each dialect
// has one table of them.
#pragma once
#include <span>
#include <string_view>

#include "ir/support/diagnostics.h"

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

} // namespace rung::frontend
