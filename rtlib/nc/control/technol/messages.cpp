// Messages on the screen of the control (see messages.h).
#include "rtlib/nc/control/technol/messages.h"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <iterator>
#include <utility>

#include "rtlib/text/letters.h"

namespace rung::nc::technol {
namespace {

constexpr size_t kMostShown = 256; // of each validity; further messages are only logged
constexpr size_t kLongestValue = 11;

// Appends characters to `out`; characters that do not fit are dropped.
class Line {
public:
  explicit Line(std::span<char> out) : out_(out) {}

  void put(char c) {
    if (size_ < out_.size()) out_[size_++] = c;
  }
  void put(std::string_view text) {
    for (const char c : text) put(c);
  }
  // %d, %x and %X are replaced by the values in order (man. l.5290-5297).
  void putFilled(std::string_view text, const MessageValues& values) {
    size_t next = 0;
    for (size_t i = 0; i < text.size(); ++i) {
      const char form = text[i] == '%' && i + 1 < text.size() ? text[i + 1] : '\0';
      if ((form != 'd' && form != 'x' && form != 'X') || next >= std::size(values.par)) {
        put(text[i]);
        continue;
      }
      putValue(form, values.par[next++]);
      ++i;
    }
  }
  size_t size() const { return size_; }

private:
  void putValue(char form, uint32_t value) {
    char digits[kLongestValue + 1];
    const auto end = form == 'd' ? std::to_chars(digits, std::end(digits), static_cast<int32_t>(value))
                                 : std::to_chars(digits, std::end(digits), value, 16);
    for (const char* c = digits; c != end.ptr; ++c) put(form == 'X' ? text::upper(*c) : *c);
  }

  std::span<char> out_;
  size_t size_ = 0;
};

bool isSame(const MessageValues& a, const MessageValues& b) { return a.number == b.number && a.subId == b.subId; }

} // namespace

Messages::Messages() {
  transient_.reserve(kMostShown);
  persistent_.reserve(kMostShown);
}

void Messages::define(MessageDefinition definition) {
  definitions_.insert_or_assign(definition.number, std::move(definition));
}

void Messages::clear() {
  transient_.clear();
  persistent_.clear();
}

const MessageDefinition* Messages::definitionOf(uint32_t number) const {
  const auto found = definitions_.find(number);
  return found == definitions_.end() ? nullptr : &found->second;
}

Validity Messages::validityOf(const rung_message& message) const {
  const MessageDefinition* definition = definitionOf(valuesOf(message).number);
  if (definition != nullptr) return definition->validity;
  return (message.number & kPersistentWanted) != 0 ? Validity::Persistent : Validity::Transient;
}

bool Messages::isOnlyLogged(uint32_t number) const {
  const MessageDefinition* definition = definitionOf(number);
  return definition != nullptr && definition->kind == MessageKind::Event;
}

// Clear ends a persistent message. A transient message has no end: Clear begins it, as if `set` were not given, unless
// it belongs to a bit.
bool Messages::begins(const rung_message& message) const {
  return message.op != RUNG_MESSAGE_CLEAR ||
         (validityOf(message) == Validity::Transient && (message.number & kByBit) == 0);
}

void Messages::accept(const rung_message& message) {
  const MessageValues values = valuesOf(message);
  const Validity validity = validityOf(message);
  if (message.op == RUNG_MESSAGE_CLEAR && validity == Validity::Persistent)
    std::erase_if(persistent_, [&](const MessageValues& other) { return isSame(other, values); });
  if (begins(message) && !isOnlyLogged(values.number)) show(values, validity);
}

rung_message Messages::outward(const rung_message& message) const noexcept {
  rung_message out = message;
  out.number = valuesOf(message).number;
  if (begins(message)) out.op = isOnlyLogged(out.number) ? RUNG_MESSAGE_LOG : RUNG_MESSAGE_SHOW_LOG;
  return out;
}

void Messages::show(const MessageValues& values, Validity validity) {
  if (validity == Validity::Transient) {
    if (transient_.size() < kMostShown && std::ranges::find(transient_, values) == transient_.end())
      transient_.push_back(values);
    return;
  }
  const auto same =
      std::ranges::find_if(persistent_, [&](const MessageValues& other) { return isSame(other, values); });
  if (same != persistent_.end())
    *same = values;
  else if (persistent_.size() < kMostShown)
    persistent_.push_back(values);
}

void Messages::confirm() {
  if (!transient_.empty()) transient_.erase(transient_.begin());
}

size_t Messages::describe(const rung_message& message, std::span<char> out) const noexcept {
  const MessageValues m = valuesOf(message);
  char head[64];
  const int length =
      std::snprintf(head, sizeof head, "PLC%05u %u %u %u %u", m.number, m.subId, m.par[0], m.par[1], m.par[2]);
  Line line(out);
  line.put(std::string_view(head, static_cast<size_t>(length)));
  if (const MessageDefinition* definition = definitionOf(m.number);
      definition != nullptr && !definition->text.empty()) {
    line.put(' ');
    line.putFilled(definition->text, m);
  }
  return line.size();
}

namespace {

ShownMessage withoutText(const MessageValues& values) {
  ShownMessage shown;
  shown.number = values.number;
  shown.index = static_cast<int32_t>(values.subId);
  shown.value = values.par[0];
  shown.par2 = values.par[1];
  shown.par3 = values.par[2];
  return shown;
}

bool isShownAs(const MessageValues& values, const ShownMessage& other) {
  return other.isSameButText(withoutText(values));
}

} // namespace

ShownMessage Messages::shownOf(const MessageValues& values) const {
  ShownMessage shown = withoutText(values);
  if (const MessageDefinition* definition = definitionOf(values.number)) {
    std::string text(definition->text.size() + std::size(values.par) * kLongestValue, '\0');
    Line line(text);
    line.putFilled(definition->text, values);
    text.resize(line.size());
    shown.text = std::move(text);
  }
  return shown;
}

std::vector<ShownMessage> Messages::shown() const {
  std::vector<ShownMessage> all;
  for (const MessageValues& values : persistent_) all.push_back(shownOf(values));
  if (!transient_.empty()) all.push_back(shownOf(transient_.front()));
  return all;
}

bool Messages::shows(std::span<const ShownMessage> these) const noexcept {
  const size_t lasting = persistent_.size();
  if (these.size() != lasting + (transient_.empty() ? 0 : 1)) return false;
  return std::ranges::equal(persistent_, these.first(lasting), isShownAs) &&
         (transient_.empty() || isShownAs(transient_.front(), these.back()));
}

} // namespace rung::nc::technol
