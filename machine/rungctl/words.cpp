// See words.h.
#include "machine/rungctl/words.h"

#include <iostream>

#include "rtlib/text/controls.h"

namespace rung::rungctl {

using nlohmann::json;

int fail(const std::string& message, int status) {
  std::cerr << "rungctl: " << text::withoutControls(message, "\n\t") << '\n';
  return status;
}

std::string shown(const json& value) { return value.is_string() ? value.get<std::string>() : value.dump(); }

void print(const Words& words, const json& answer, const std::string& text) {
  if (words.common.asJson)
    std::cout << answer.dump() << std::endl;
  else if (!text.empty())
    std::cout << text << (text.ends_with('\n') ? "" : "\n") << std::flush;
}

} // namespace rung::rungctl
