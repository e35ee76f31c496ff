// What an editor asks about a program, answered by its analysis. A request that has no answer gets null, or an empty
// list.
#pragma once
#include <string>
#include <vector>

#include "tools/lsp/program.h"
#include "tools/lsp/protocol.h"

namespace rung::lsp {

// A file of a program, and a place in it.
struct Place {
  Program& program;
  FileId file;
  SourcePos at;
  Unit unit;
};

bool isLadderText(const Program& program, FileId file);

// Of all files of a program, by their paths: also of those without any.
std::map<std::string, json> diagnosticsOf(Program& program, Unit unit);
// The fixes of diagnostics in the range.
json codeActions(const Place& begin, SourcePos end);

json hover(const Place& place);
json definition(const Place& place);
json references(const Place& place, bool withDeclaration);
json highlights(const Place& place);
json prepareRename(const Place& place);
json rename(const Place& place, const std::string& name);

json documentSymbols(Program& program, FileId file, Unit unit);
json workspaceSymbols(Program& program, const std::string& query, Unit unit);
json foldingRanges(Program& program, FileId file, Unit unit);
// Groups of five numbers, as the protocol describes; the legend is part of the server's capabilities.
json semanticTokens(Program& program, FileId file, Unit unit);
json semanticLegend();

// How often each name that is declared in the file is written and read.
json codeLenses(Program& program, FileId file, Unit unit);
// Addresses and values of names up to the end.
json inlayHints(const Place& begin, SourcePos end);

json completion(const Place& place);
json formatting(Program& program, FileId file, Unit unit);

} // namespace rung::lsp
