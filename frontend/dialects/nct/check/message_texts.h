// Texts of messages: the kinds of their placeholders, and whether the boxes that send them supply such values (man.
// l.2745-2773).
#pragma once
#include <initializer_list>
#include <unordered_map>

#include "frontend/dialects/nct/program.h"

namespace rung::frontend::nct {

enum class TextKind : uint8_t { Plain, Integer, Real, Bad };

struct CheckedText {
  TextKind kind = TextKind::Plain;
  SourceRange range;
};
using TextKinds = std::unordered_map<uint32_t, CheckedText>; // by the message's number

// Reports invalid placeholders.
TextKind checkText(const Word& text, Diagnostics& diagnostics);
// Reports boxes with a constant message number whose text needs another kind of number. A box with a computed message
// number prints its number in any case.
void checkMessages(const TypedModule& module, const TextKinds& texts, Diagnostics& diagnostics);

// Warns of texts that no box of the program shows, and of boxes with a constant number that has no text.
void checkMessageNumbers(std::initializer_list<const TypedModule*> modules, const TextKinds& texts,
                         Diagnostics& diagnostics);

} // namespace rung::frontend::nct
