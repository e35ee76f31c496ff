// Messages on the screen of the control (see messages.h).
#include "tools/sim/technol/messages.h"

#include <algorithm>
#include <cstdio>

#include "rtlib/nc/technol/messages.h"

namespace rung::nc::technol {
namespace {

constexpr size_t kMostShown = 256; // of either validity; more are logged only

// %d, %x and %X stand for the values in their order (man. l.5290-5297).
std::string filled(std::string_view text, const MessageValues& values) {
  std::string out;
  size_t next = 0;
  for (size_t i = 0; i < text.size(); ++i) {
    const char form = text[i] == '%' && i + 1 < text.size() ? text[i + 1] : '\0';
    if ((form != 'd' && form != 'x' && form != 'X') || next >= std::size(values.par)) {
      out += text[i];
      continue;
    }
    char digits[16];
    const uint32_t value = values.par[next++];
    if (form == 'd')
      std::snprintf(digits, sizeof digits, "%d", static_cast<int32_t>(value));
    else
      std::snprintf(digits, sizeof digits, form == 'x' ? "%x" : "%X", value);
    out += digits;
    ++i;
  }
  return out;
}

ShownMessage shownOf(const MessageValues& values, const MessageDefinition* definition) {
  ShownMessage shown;
  shown.number = values.number;
  shown.index = static_cast<int32_t>(values.subId);
  shown.value = values.par[0];
  shown.par2 = values.par[1];
  shown.par3 = values.par[2];
  if (definition != nullptr) shown.text = filled(definition->text, values);
  return shown;
}

bool isSame(const ShownMessage& message, uint32_t number, int32_t subId) {
  return message.number == number && message.index == subId;
}

} // namespace

void Messages::define(std::span<const MessageDefinition> definitions) {
  for (const MessageDefinition& definition : definitions) definitions_.insert_or_assign(definition.number, definition);
}

void Messages::clear() {
  transient_.clear();
  persistent_.clear();
}

const MessageDefinition* Messages::definitionOf(uint32_t number) const {
  const auto found = definitions_.find(number);
  return found == definitions_.end() ? nullptr : &found->second;
}

void Messages::take(host::Instance& instance, MessageBoard& board) {
  rung_message message;
  while (instance.messages().pop(message)) {
    char line[kMessageLine];
    const size_t length = describeMessage(instance.program(), message, line);
    const MessageValues values = valuesOf(message);
    const MessageDefinition* definition = definitionOf(values.number);
    const bool wanted = (message.number & kPersistentWanted) != 0;
    const Validity validity = definition != nullptr ? definition->validity
                              : wanted              ? Validity::Persistent
                                                    : Validity::Transient;
    // The end of a persistent message; `set` of a transient one is ignored, its bit has no end.
    if (message.op == RUNG_MESSAGE_CLEAR) {
      if (validity == Validity::Persistent) remove(values.number, static_cast<int32_t>(values.subId));
      if (validity == Validity::Persistent || (message.number & kByBit) != 0) continue;
    }
    ShownMessage shown = shownOf(values, definition);
    board.log(std::string(line, length) + (shown.text.empty() ? "" : " " + shown.text));
    if (definition == nullptr || definition->kind != MessageKind::Event) show(std::move(shown), validity);
  }
}

void Messages::show(ShownMessage message, Validity validity) {
  if (validity == Validity::Transient) {
    if (transient_.size() < kMostShown && std::find(transient_.begin(), transient_.end(), message) == transient_.end())
      transient_.push_back(std::move(message));
    return;
  }
  const auto same = std::find_if(persistent_.begin(), persistent_.end(), [&](const ShownMessage& other) {
    return isSame(other, message.number, message.index);
  });
  if (same != persistent_.end())
    *same = std::move(message);
  else if (persistent_.size() < kMostShown)
    persistent_.push_back(std::move(message));
}

void Messages::remove(uint32_t number, int32_t subId) {
  std::erase_if(persistent_, [&](const ShownMessage& message) { return isSame(message, number, subId); });
}

void Messages::confirm() {
  if (!transient_.empty()) transient_.pop_front();
}

std::vector<ShownMessage> Messages::shown() const {
  std::vector<ShownMessage> all = persistent_;
  if (!transient_.empty()) all.push_back(transient_.front());
  return all;
}

} // namespace rung::nc::technol
