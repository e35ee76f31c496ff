// Reads a struct of a C or C++ header through clang. Errors in the header go to standard error, as clang prints them.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "codegen/clang/layout.h"

namespace rung::codegen {

struct HeaderRequest {
  std::string header;
  std::string name;               // of the struct: its tag or typedef name, with its namespaces
  std::string buildFolder;        // folder with a compile_commands.json; "": none
  std::vector<std::string> flags; // compiler flags, used without a build folder
};

struct HeaderOutcome {
  std::optional<HostLayout> layout;
  std::string problem; // a sentence, if there is no layout
};

HeaderOutcome readHeader(const HeaderRequest& request);

} // namespace rung::codegen
