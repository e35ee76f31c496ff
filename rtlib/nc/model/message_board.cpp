// Messages on the screen and in the log (see message_board.h).
#include "rtlib/nc/model/message_board.h"

#include <algorithm>
#include <utility>

#include "rtlib/host/program_info.h"

namespace rung::nc {

void MessageBoard::take(host::Instance& instance) {
  rung_message message;
  while (instance.messages().pop(message)) {
    ShownMessage shown{message.number,    message.channel,
                       message.index,     message.value,
                       message.real != 0, std::string(host::messageText(instance.program(), message.number))};
    if (message.op == RUNG_MESSAGE_SHOW_LOG || message.op == RUNG_MESSAGE_LOG)
      log(std::to_string(message.number) + " " + shown.text);
    if (message.op == RUNG_MESSAGE_SHOW || message.op == RUNG_MESSAGE_SHOW_LOG) show(std::move(shown));
    if (message.op == RUNG_MESSAGE_CLEAR) remove(message.number);
  }
  lost_ = instance.messages().lost();
}

void MessageBoard::show(ShownMessage message) {
  if (std::find(shown_.begin(), shown_.end(), message) == shown_.end()) shown_.push_back(std::move(message));
}

void MessageBoard::remove(uint32_t number) {
  std::erase_if(shown_, [&](const ShownMessage& message) { return message.number == number; });
}

void MessageBoard::confirmOldest() {
  if (!shown_.empty()) shown_.erase(shown_.begin());
}

void MessageBoard::clear() {
  shown_.clear();
  log_.clear();
  lost_ = 0;
}

std::vector<std::string> MessageBoard::takeLog() { return std::exchange(log_, {}); }

} // namespace rung::nc
