// What a place of a program's text is about: a name, an address, a position in the program.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "frontend/sema/analysis.h"
#include "ir/support/source.h"

namespace rung::lsp {

struct Subject {
  SourceRange range;                                // of the word
  const frontend::Definition* definition = nullptr; // of a name
  std::optional<frontend::NamedPlace> place;        // of an operand, or of a name that has one
  const frontend::TargetUse* target = nullptr;      // of a label or a subprogram
};

// Also of a word that ends there, as a cursor after its last character is at it. Nothing: a word of another kind.
std::optional<Subject> subjectAt(const frontend::Analysis& analysis, SourcePos at);

// Whether the name is an operand that its instruction writes.
bool isWrittenAt(const frontend::Analysis& analysis, SourceRange name);

struct Occurrence {
  SourceRange range;
  bool declares = false;
  bool writes = false;
};

// All places of the text that are about the same, under whatever name or address; in their order, each once.
std::vector<Occurrence> occurrencesOf(const frontend::Analysis& analysis, const Subject& subject);
// Those of the name alone.
std::vector<Occurrence> occurrencesOf(const frontend::Analysis& analysis, const frontend::Definition& definition);

} // namespace rung::lsp
