// The text of a message (see message_text.h).
#include "tools/console/message_text.h"

#include <fmt/format.h>
#include <string_view>

namespace rung::console {

std::string messageText(const rung_program& program, const nc::ShownMessage& message) {
  if (std::string_view(program.dialect) == "technol")
    return fmt::format("PLC{:05} {} {} {} {}{}", message.number, static_cast<uint32_t>(message.index), message.value,
                       message.par2, message.par3, message.text.empty() ? "" : " " + message.text);
  std::string text = fmt::format("message {}", message.number);
  if (message.channel != 0 || message.index != 0)
    text += fmt::format(" (channel {}, index {})", message.channel, message.index);
  if (!message.text.empty()) text += fmt::format(" \"{}\"", message.text);
  return text;
}

} // namespace rung::console
