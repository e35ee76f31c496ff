// Texts of the messages that bits of area A request (man. l.754-762), from a file beside the program: one `NUMBER
// "text"` per line, `;` begins a comment. The number is 1 to 256 (P57) or the bit itself, A0.0 to A31.7.
#pragma once
#include <string_view>
#include <vector>

#include "frontend/network/program.h"
#include "ir/core/module.h"
#include "ir/support/diagnostics.h"
#include "ir/support/source.h"

namespace rung::frontend::gsk {

// `path` is relative to the folder of `program`. Mistakes are reported; the result has the correct entries, by number.
std::vector<ir::MessageText> readMessages(SourceManager& sources, FileId program, std::string_view path,
                                          Diagnostics& diagnostics);

// Warns of messages without a text that coils request, each at the first coil.
void checkTexts(const network::Program& program, const std::vector<ir::MessageText>& texts, Diagnostics& diagnostics);

} // namespace rung::frontend::gsk
