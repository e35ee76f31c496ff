// See messages.h.
#include "rtlib/nc/fanuc/messages.h"

#include <algorithm>
#include <span>

#include "rtlib/text/number.h"

namespace rung::nc::fanuc {

uint32_t messageNumber(std::string_view text) {
  return text::numberIn<uint32_t>(text.substr(0, text.find(' '))).value_or(0);
}

std::string addressOfMessage(const rung_program& program, std::string_view word) {
  if (program.dialect != std::string_view("fanuc")) return {};
  if (word.starts_with("EX") || word.starts_with("ex")) word.remove_prefix(2);
  const uint32_t number = text::numberIn<uint32_t>(word).value_or(0);
  if (number == 0) return {};
  const std::span texts(program.texts, program.text_count);
  const auto found =
      std::ranges::find(texts, number, [](const rung_message_text& text) { return messageNumber(text.text); });
  if (found == texts.end() || found->number == 0) return {};
  const uint32_t bit = found->number - 1; // texts are numbered from A0.0 on
  return "A" + std::to_string(bit / 8) + "." + std::to_string(bit % 8);
}

} // namespace rung::nc::fanuc
