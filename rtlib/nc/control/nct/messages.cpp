// The messages on the screen (see messages.h).
#include "rtlib/nc/control/nct/messages.h"

#include <algorithm>
#include <cstring>

#include "rtlib/load/program_info.h"
#include "rtlib/nc/control/control.h"

namespace rung::nc::nct {
namespace {

uint32_t codeOf(const rung_message& message) {
  return messageCode(message.number, static_cast<uint32_t>(message.channel), static_cast<uint32_t>(message.index));
}

// The maximum length of a text with its numbers.
size_t roomFor(std::string_view text) {
  constexpr size_t kNumber = 340; // the longest one
  return text.size() + kNumber * static_cast<size_t>(std::ranges::count(text, '{'));
}

std::string filled(const rung_program& program, const rung_message& message) {
  const std::string_view text = runtime::messageText(program, message.number);
  std::string out(roomFor(text), '\0');
  out.resize(fillText(text, message, out));
  return out;
}

} // namespace

size_t logLine(const rung_program& program, const rung_message& message, std::span<char> out) noexcept {
  size_t size = putMessageNumber(message.number, message.channel, message.index, out);
  if (size < out.size()) out[size++] = ' ';
  return size + fillText(runtime::messageText(program, message.number), message, out.subspan(size));
}

// ---- cells -------------------------------------------------------------------------------------------------------

namespace {

// Keeps the contents in the vector with more capacity.
template <class Entry>
void widen(std::vector<Entry>& used, std::vector<Entry>& other) noexcept {
  if (used.capacity() >= other.capacity()) return;
  other.assign(used.begin(), used.end());
  used.swap(other);
}

} // namespace

Messages::Places::Places(const rung_program& of) : program(&of), cells(of, kMessageSpace) {
  // More than one message for a box exists only between a loss in the queue and its detection.
  const size_t room = cells.bytes / (size_t{kMessageWords} * 4) + core::kMessageCapacity;
  list.reserve(room);
  cleared.reserve(room);
  sorted.reserve(room);
}

void Messages::powerOn() {
  list_.clear();
  cleared_.clear();
  lost_ = 0;
  cancel_ = pressed_ = ownSignal_ = false;
  changed_ = true;
}

void Messages::use(runtime::Instance& instance, Places& places) noexcept {
  cells_ = instance.block().subspan(places.cells.offset, places.cells.bytes);
  widen(list_, places.list);
  widen(cleared_, places.cleared);
  widen(sorted_, places.sorted);
  endGone(instance);
  for (Entry& entry : list_) {
    const uint32_t number = entry.message.number;
    if (runtime::messageText(*program_, number) != runtime::messageText(*places.program, number))
      entry.renewal = Renewal::End;
  }
  program_ = places.program;
}

bool Messages::nextChange(rung_message& message) noexcept {
  const auto entry = std::ranges::find_if(list_, [](const Entry& one) { return one.renewal != Renewal::None; });
  if (entry == list_.end()) return false;
  message = entry->message;
  const bool ends = entry->renewal == Renewal::End;
  if (ends) message.op = RUNG_MESSAGE_CLEAR;
  entry->renewal = ends ? Renewal::Begin : Renewal::None;
  return true;
}

uint32_t Messages::cell(uint32_t box, uint32_t word) const {
  uint32_t value = 0;
  std::memcpy(&value, cells_.data() + (size_t{box} * kMessageWords + word) * 4, sizeof value);
  return value;
}

void Messages::setShown(uint32_t box, bool shown) {
  const uint32_t value = shown ? 1 : 0;
  std::memcpy(cells_.data() + (size_t{box} * kMessageWords + kShownWord) * 4, &value, sizeof value);
}

// ---- list --------------------------------------------------------------------------------------------------------

bool Messages::isShown(uint32_t code) const {
  return std::ranges::any_of(list_, [&](const Entry& entry) { return entry.code == code; });
}

void Messages::remove(uint32_t code) {
  std::erase_if(list_, [&](const Entry& entry) { return entry.code == code; });
}

void Messages::registered(uint32_t code) {
  for (uint32_t box = 0; box < cells(); ++box)
    if (cell(box, kWantedWord) == (code | kLogCell)) setShown(box, true);
}

void Messages::accept(const rung_message& message) {
  const uint32_t code = codeOf(message);
  changed_ = true;
  switch (static_cast<rung_message_op>(message.op)) {
  case RUNG_MESSAGE_CLEAR: return remove(code);
  case RUNG_MESSAGE_LOG: return registered(code);
  case RUNG_MESSAGE_SHOW:
  case RUNG_MESSAGE_SHOW_LOG: break;
  }
  remove(code);
  if (list_.size() == list_.capacity()) dropUnwanted();
  if (list_.size() < list_.capacity())
    list_.push_back({.code = code, .clearing = false, .renewal = Renewal::None, .message = message});
}

bool Messages::isWanted(uint32_t code) const noexcept {
  for (uint32_t box = 0; box < cells(); ++box)
    if (cell(box, kWantedWord) == code) return true;
  return false;
}

// Removes messages that no box wants any more, whose end the program could not report.
void Messages::dropUnwanted() {
  std::erase_if(list_, [&](const Entry& entry) { return !isWanted(entry.code); });
  changed_ = true;
}

void Messages::endGone(runtime::Instance& instance) noexcept {
  for (const Entry& entry : list_) {
    if (isWanted(entry.code)) continue;
    rung_message end = entry.message;
    end.op = RUNG_MESSAGE_CLEAR;
    (void)instance.messages().push(end); // the list receives it like any other message
  }
}

namespace {

ShownMessage withoutText(const rung_message& m) {
  return {
      .number = m.number, .channel = m.channel, .index = m.index, .value = m.value, .real = m.real != 0, .text = {}};
}

} // namespace

std::vector<ShownMessage> Messages::shown(const rung_program& program) const {
  std::vector<ShownMessage> out;
  for (const Entry& entry : list_) {
    out.push_back(withoutText(entry.message));
    out.back().text = filled(program, entry.message);
  }
  return out;
}

bool Messages::shows(std::span<const ShownMessage> these) const noexcept {
  return std::ranges::equal(list_, these, [](const Entry& entry, const ShownMessage& other) {
    return other.isSameButText(withoutText(entry.message));
  });
}

// ---- operator ----------------------------------------------------------------------------------------------------

void Messages::cancelTop() {
  if (!list_.empty()) cleared_.push_back(list_.back().code);
  cancel_ = true;
}

void Messages::cancelAll() {
  for (const Entry& entry : list_) cleared_.push_back(entry.code);
  cancel_ = true;
}

bool Messages::cancel(uint32_t code) {
  if (!isShown(code)) return false;
  cleared_.push_back(code);
  cancel_ = true;
  return true;
}

// N_CLRMSG is 1 for the one cycle after a button; set by another writer it clears the message on top with its rising
// edge.
void Messages::press(const SignalWord& common, bool inCycle) {
  const bool pressed = common.get(clear_);
  if (pressed && !pressed_ && !ownSignal_ && !list_.empty()) {
    if (inCycle)
      list_.back().clearing = true;
    else
      cleared_.push_back(list_.back().code);
  }
  pressed_ = pressed;
}

// ---- time --------------------------------------------------------------------------------------------------------

void Messages::timeSlice(const SignalMemory& signals, SignalWord& common, Slice slice, uint32_t lost) {
  if (slice == Slice::First) {
    endCycle();
    if (ownSignal_ || cancel_) common.set(clear_, cancel_);
    ownSignal_ = cancel_;
    cancel_ = false;
    for (Entry& entry : list_) entry.clearing = std::ranges::find(cleared_, entry.code) != cleared_.end();
    cleared_.clear();
  }
  press(common, slice != Slice::Alone);
  if (lost != lost_) dropUnwanted();
  lost_ = lost;
  report(signals, common);
}

void Messages::endCycle() {
  if (std::erase_if(list_, [](const Entry& entry) { return entry.clearing; }) != 0) changed_ = true;
}

void Messages::report(const SignalMemory& signals, SignalWord& common) {
  common.set(any_, !list_.empty());
  common.set(plc_, !list_.empty());
  signals.set(active_, 0, list_.empty() ? 0 : static_cast<int32_t>(list_.back().code));
  if (!changed_) return;
  changed_ = false;
  sorted_.clear();
  for (const Entry& entry : list_) sorted_.push_back(entry.code);
  std::ranges::sort(sorted_);
  for (uint32_t box = 0; box < cells(); ++box) {
    const uint32_t wanted = cell(box, kWantedWord);
    if (wanted != 0 && (wanted & kLogCell) == 0) setShown(box, std::ranges::binary_search(sorted_, wanted));
  }
}

} // namespace rung::nc::nct
