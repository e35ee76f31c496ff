// Messages on the screen and in the log (see message_board.h).
#include "tools/sim/message_board.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "rtlib/host/program_info.h"
#include "rtlib/nc/nct/messages.h"
#include "rtlib/nc/technol/messages.h"

namespace rung::nc {

namespace {

size_t describeTechnol(const rung_message& message, std::span<char> out) {
  const technol::MessageValues m = technol::valuesOf(message);
  char line[64];
  const int length =
      std::snprintf(line, sizeof line, "PLC%05u %u %u %u %u", m.number, m.subId, m.par[0], m.par[1], m.par[2]);
  const size_t count = std::min(static_cast<size_t>(length), out.size());
  std::copy_n(line, count, out.data());
  return count;
}

} // namespace

size_t describeMessage(const rung_program& program, const rung_message& message, std::span<char> out) {
  if (std::string_view(program.dialect) == "technol") return describeTechnol(message, out);
  const std::string_view text = host::messageText(program, message.number);
  const bool nct = std::string_view(program.dialect) == "nct";
  const uint32_t number = nct ? nct::messageCode(message.number, static_cast<uint32_t>(message.channel),
                                                 static_cast<uint32_t>(message.index))
                              : message.number;
  char digits[16];
  const auto length = static_cast<size_t>(std::snprintf(digits, sizeof digits, nct ? "%08u " : "%u ", number));
  const size_t head = std::min(length, out.size());
  std::copy_n(digits, head, out.data());
  const std::span<char> rest = out.subspan(head);
  if (nct) return head + nct::fillText(text, message, rest);
  const size_t plain = std::min(text.size(), rest.size());
  std::copy_n(text.data(), plain, rest.data());
  return head + plain;
}

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
