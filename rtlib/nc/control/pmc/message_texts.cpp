// Places and texts of messages, and what is rare (see messages.h).
#include "rtlib/change/forcing.h"
#include "rtlib/load/program_info.h"
#include "rtlib/nc/control/pmc/messages.h"
#include "rtlib/nc/fanuc/messages.h"

namespace rung::nc {
namespace {

// A text of FANUC's list without its number.
std::string_view withoutNumber(std::string_view text) {
  const size_t blank = text.find(' ');
  return blank == std::string_view::npos ? std::string_view() : text.substr(blank + 1);
}

// Appends as much as fits.
void put(std::string_view text, std::span<char> out, size_t& size) {
  const size_t count = std::min(text.size(), out.size() - size);
  std::copy_n(text.data(), count, out.data() + size);
  size += count;
}

} // namespace

PmcMessages::Places::Places(const rung_program& of, pmc::MessageRule rule)
    : program(&of), area(runtime::findSpace(of, "A")) {
  if (rule == pmc::MessageRule::ByTextList) readTexts(of);
  if (area == RUNG_NONE) return;
  const rung_space& space = of.spaces[area];
  if (rule == pmc::MessageRule::ByTextList) findStates(space);
  bytes = std::min(space.byte_count, kMostBytes);
  for (const rung_range& range : std::span(space.ranges, space.range_count)) {
    if (range.first_byte >= bytes) break;
    pieces.push_back({.first = range.first_byte,
                      .count = std::min(range.byte_count, bytes - range.first_byte),
                      .offset = range.offset,
                      .expanded = range.repr == RUNG_REPR_BYTE_PER_BIT});
    for (uint32_t i = 0; i < pieces.back().size(); ++i) written.push_back(runtime::writtenBits(of, range.offset + i));
  }
}

void PmcMessages::Places::findStates(const rung_space& space) {
  for (const rung_range& range : std::span(space.ranges, space.range_count)) {
    const uint32_t first = std::max(range.first_byte, kFirstState);
    const uint32_t end = std::min(range.first_byte + range.byte_count, kFirstState + kMostBytes);
    if (first >= end) continue;
    const bool expanded = range.repr == RUNG_REPR_BYTE_PER_BIT;
    states.push_back({.first = first - kFirstState,
                      .count = end - first,
                      .offset = range.offset + (first - range.first_byte) * (expanded ? 8 : 1),
                      .expanded = expanded});
  }
}

void PmcMessages::Places::readTexts(const rung_program& of) {
  const core::Memory memory(of, nullptr);
  display = memory.locate(runtime::findSpace(of, "@DISPB"), 0, 1);
  shift = memory.locate(runtime::findSpace(of, "K"), kShiftAt, 2);
  for (const rung_message_text& text : std::span(of.texts, of.text_count)) {
    if (text.number == 0 || text.number > 8 * kMostBytes) continue;
    if (text.number > numbers.size()) numbers.resize(text.number);
    numbers[text.number - 1] = fanuc::messageNumber(text.text);
  }
}

void PmcMessages::powerOn() {
  reported_.fill(0);
  for (Look* look : {&allReported_, &stated_, &states_}) look->forget();
}

void PmcMessages::use(uint8_t* block, const Places& places) noexcept {
  for (uint32_t at = 0; at < reportedAs_.size(); ++at) {
    uint32_t& key = reportedAs_[at].key;
    if ((reported_[at / 8] >> at % 8 & 1) != 0 &&
        runtime::messageText(*places_->program, key) != runtime::messageText(*places.program, key))
      key = 0;
  }
  places_ = &places;
  for (Look* look : {&allReported_, &stated_, &states_}) look->forget();
  const uint8_t* written = places.written.data();
  for (const Piece& piece : places.pieces)
    for (uint32_t i = 0; i < piece.size(); ++i) block[piece.offset + i] &= *written++;
}

PmcMessages::Known PmcMessages::known(uint32_t bit, uint32_t shift) const noexcept {
  if (!isListed()) return {bit, bit};
  const std::vector<uint32_t>& numbers = places_->numbers;
  const auto numberAt = [&](uint32_t key) { return key <= numbers.size() ? numbers[key - 1] : 0; };
  const uint32_t key = numberAt(bit + shift) != 0 ? bit + shift : bit; // a language without this text
  return {numberAt(key), key};
}

std::vector<ShownMessage> PmcMessages::list(const runtime::Instance& instance) const {
  std::vector<ShownMessage> shown;
  forShown(instance, [&](uint32_t key, uint32_t number) {
    const std::string_view text = runtime::messageText(instance.program(), key);
    shown.push_back({.number = number,
                     .value = isListed() ? key : 0,
                     .text = std::string(isListed() ? withoutNumber(text) : text)});
    return true;
  });
  return shown;
}

bool PmcMessages::showsAlarm(const runtime::Instance& instance) const noexcept {
  return isListed() && !forShown(instance, [](uint32_t, uint32_t number) { return !isAlarm(number); });
}

size_t PmcMessages::describe(const rung_program& program, const rung_message& message, std::span<char> out) noexcept {
  size_t size = 0;
  if (isAlarm(message.number)) put("EX", out, size);
  put(runtime::messageText(program, static_cast<uint32_t>(message.value)), out, size); // begins with the number
  return size;
}

std::string PmcMessages::text(const ShownMessage& message) {
  const std::string number = std::to_string(message.number), text = " \"" + message.text + "\"";
  if (isAlarm(message.number)) return "message EX" + number + text;
  return "message " + number + text + (message.number >= kFirstPlain ? ", shown without its number" : "");
}

} // namespace rung::nc
