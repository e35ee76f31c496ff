// Names of documents: URIs of the protocol, and paths of files.
#pragma once
#include <string>
#include <string_view>

#include "ir/support/source.h"

namespace rung::lsp {

// The absolute path that a "file" URI names. Another URI, such as that of a document that was never saved, is its own
// path.
std::string pathOf(std::string_view uri);
std::string uriOf(std::string_view path);
// The absolute path of a file of a program.
std::string pathOf(const SourceManager& sources, FileId file);

} // namespace rung::lsp
