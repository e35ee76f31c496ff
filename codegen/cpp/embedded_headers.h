// The headers of rtlib/abi as text, so that the command needs no installed files to compile generated C++.
#pragma once
#include <span>
#include <string_view>

namespace rung::codegen {

struct EmbeddedHeader {
  std::string_view name; // as included: "rung/gen.hpp"
  std::string_view text;
};

std::span<const EmbeddedHeader> embeddedHeaders();

} // namespace rung::codegen
