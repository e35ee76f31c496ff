// Reference pages made from the tables: instructions of a dialect, diagnostics, operations of the IR. `rungc doc`
// prints them, `rungc explain` prints one entry; docs/reference/ holds the output and a test fails when it is stale.
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
// What is known about a diagnostic code, a fault, or (of every dialect that has it) a mnemonic, a kind of operands, a
// configuration key, a signal; nothing when unknown. Markdown, as all of these. From here on all is for a reader who
// has no manual. `only`: a dialect, or null.
std::optional<std::string> explain(std::string_view word, const frontend::Dialect* only = nullptr);
// What there is to be explained, and a list of one kind of it: a dialect, "diagnostics", "faults", "config".
std::string explainTopics();
std::optional<std::string> explainTopic(std::string_view word);

// Everything that has a name, to be searched.
struct ReferenceEntry {
  std::string name;
  std::string kind;  // "nct instruction", "error"
  std::string title; // its first sentence
  std::string group; // of an instruction or a signal
};
std::vector<ReferenceEntry> referenceEntries();

// References to lines of a manual and to proposals, which the tables have beside their texts. A user at a terminal does
// not have those lines.

// The Markdown without "l.1271", "man. l.540" and "P17" in brackets and after "Manual:"; brackets with nothing else go.
// Fenced blocks stay as they are.
std::string withoutManualLines(std::string_view markdown);

} // namespace rung::compiler
