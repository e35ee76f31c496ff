// Words of other languages (see foreign_word.h).
#include "frontend/sema/foreign_word.h"

#include <algorithm>
#include <string>

#include "rtlib/text/letters.h"

namespace rung::frontend {

const ForeignWord* findForeign(std::span<const ForeignWord> words, std::string_view word) {
  const auto found =
      std::ranges::find_if(words, [&](const ForeignWord& one) { return text::equalsIgnoringCase(one.word, word); });
  return found == words.end() ? nullptr : &*found;
}

void explainForeign(DiagBuilder& report, SourceRange range, const ForeignWord& word, bool fits) {
  if (word.same)
    report.meant(fits ? range : SourceRange{}, word.here);
  else
    report.note("in this language: " + std::string(word.here));
}

} // namespace rung::frontend
