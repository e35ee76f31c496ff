// Small functions of the model.
#include "frontend/network/convert/source_model.h"

#include "rtlib/text/blanks.h"

namespace rung::network::convert {

std::vector<Logic> logicOf(const std::vector<SourceCommand>& commands) {
  std::vector<Logic> result;
  for (const SourceCommand& command : commands)
    if (isLogic(command.command)) result.push_back(logicOf(command.command));
  return result;
}

std::string clean(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = ' ';
  return std::string(text::trimmed(result));
}

} // namespace rung::network::convert
