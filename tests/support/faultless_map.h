// A mapping file that a test writes, and in which it expects no mistake.
#pragma once
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "machine/host/mapping_file.h"

namespace rung::test {

// Throws with all mistakes where there are some.
inline host::File faultlessMap(std::string_view text) {
  std::vector<std::string> errors;
  host::File map = host::parseMap(text, "m.map", errors);
  std::string all;
  for (const std::string& error : errors) all += error + '\n';
  if (!all.empty()) throw std::runtime_error(all);
  return map;
}

} // namespace rung::test
