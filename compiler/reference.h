// Reference pages made from the tables: instructions of a dialect, diagnostics, operations of the IR. `rungc doc`
// prints them, `rungc explain` prints one entry; docs/reference/ contains the output and a test fails if it is stale.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "frontend/dialects/dialect.h"

namespace rung::compiler {

// Markdown of a dialect's instructions, operand kinds and configuration keys.
std::string dialectReference(const frontend::Dialect& dialect);
// Markdown of all diagnostic codes.
std::string diagnosticReference();
// Markdown of the operations of the IR.
std::string operationReference();
// Markdown about a diagnostic code, a fault, or (for every dialect that has it) a mnemonic, a kind of operand, a
// configuration key, a signal; nothing if the word is unknown. This and the functions below are for readers without a
// manual. `only`: a dialect, or null.
std::optional<std::string> explain(std::string_view word, const frontend::Dialect* only = nullptr);
// The list of topics, and one topic: a dialect, "diagnostics", "faults", "config".
std::string explainTopics();
std::optional<std::string> explainTopic(std::string_view word);

// Everything that has a name, for a search.
struct ReferenceEntry {
  std::string name;
  std::string kind;  // such as "nct instruction", "error"
  std::string title; // its first sentence
  std::string group; // of an instruction or a signal
};
std::vector<ReferenceEntry> referenceEntries();

// References to lines of a manual and to proposals in the texts of the tables, which a user at a terminal cannot look
// up.

// The Markdown without "l.1271", "man. l.540" and "P17" in brackets and after "Manual:"; brackets that become empty are
// removed, too. Fenced blocks are unchanged.
std::string withoutManualLines(std::string_view markdown);

} // namespace rung::compiler
