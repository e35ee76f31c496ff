// Texts of messages: what their placeholders take, and whether the boxes that send them give it (man. l.2745-2773).
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

// Reports placeholders that are none.
TextKind checkText(const Word& text, Diagnostics& diagnostics);
// Reports boxes with a constant number whose text wants another kind of number. A box whose number is computed prints
// the number that it has.
void checkMessages(const TypedModule& module, const TextKinds& texts, Diagnostics& diagnostics);

// Warns of texts that no box of the program shows, and of boxes without one where others have theirs.
void checkMessageNumbers(std::initializer_list<const TypedModule*> modules, const TextKinds& texts,
                         Diagnostics& diagnostics);

} // namespace rung::frontend::nct
