// Reference pages made from the tables: instructions of a dialect, diagnostics, operations of the IR. `rungc doc`
// prints them, `rungc explain` prints one entry; docs/reference/ holds the output and a test fails when it is stale.
#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "frontend/dialects/dialect.h"

namespace rung::driver {

// Markdown of a dialect's instructions, operand kinds and configuration keys.
std::string dialectReference(const frontend::Dialect& dialect);
// Markdown of all diagnostic codes.
std::string diagnosticReference();
// Markdown of the operations of the IR.
std::string operationReference();
// What is known about a diagnostic code or a mnemonic (of every dialect that has it); nothing when unknown.
std::optional<std::string> explain(std::string_view word);

} // namespace rung::driver
