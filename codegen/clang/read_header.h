// Reads a struct of a C or C++ header as clang compiles it. The errors of the header itself go to standard error, as
// clang prints them.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "codegen/clang/layout.h"

namespace rung::codegen {

struct HeaderRequest {
  std::string header;
  std::string name;               // of the struct: its tag, or that of a typedef, with its namespaces
  std::string buildFolder;        // with a compile_commands.json; "": none
  std::vector<std::string> flags; // where there is no such folder
};

struct HeaderOutcome {
  std::optional<HostLayout> layout;
  std::string problem; // a sentence, where there is no layout
};

HeaderOutcome readHeader(const HeaderRequest& request);

} // namespace rung::codegen
