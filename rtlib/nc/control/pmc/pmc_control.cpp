// Power-on, messages and names of the family (see pmc_control.h).
#include "rtlib/nc/control/pmc/pmc_control.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "rtlib/change/forcing.h"
#include "rtlib/core/bits.h"
#include "rtlib/load/program_info.h"
#include "rtlib/text/number.h"

namespace rung::nc {
namespace {

std::vector<uint8_t> readArea(const runtime::Instance& instance, const char* area) {
  const uint32_t space = runtime::findSpace(instance.program(), area);
  std::vector<uint8_t> bytes(space == RUNG_NONE ? 0 : instance.program().spaces[space].byte_count);
  for (uint32_t i = 0; i < bytes.size(); ++i) bytes[i] = instance.memory().readByte(space, i);
  return bytes;
}

void writeArea(runtime::Instance& instance, const char* area, const std::vector<uint8_t>& bytes) {
  const uint32_t space = runtime::findSpace(instance.program(), area);
  for (uint32_t i = 0; i < bytes.size(); ++i) instance.memory().writeByte(space, i, bytes[i]);
}

constexpr uint32_t kMostMessageBytes = PmcControl::kMostMessageBytes;

// The number at the beginning of a text of FANUC's list, "1000 DOOR OPEN".
uint32_t numberOf(std::string_view text) {
  return text::numberIn<uint32_t>(text.substr(0, text.find(' '))).value_or(0);
}
// The text without the number.
std::string_view withoutNumber(std::string_view text) {
  const size_t blank = text.find(' ');
  return blank == std::string_view::npos ? std::string_view() : text.substr(blank + 1);
}

// FANUC's messages: the text in another language lies this many A bits further, as the word K918 says.
constexpr uint32_t kShiftAt = 918;

struct PmcPlaces final : Places {
  PmcPlaces(const rung_program& program, pmc::MessageRule rule)
      : areas(program), messages(runtime::findSpace(program, "A")) {
    if (rule == pmc::MessageRule::ByTextList) readNumbers(program);
    if (messages == RUNG_NONE) return;
    const rung_space& space = program.spaces[messages];
    messageBytes = std::min(space.byte_count, kMostMessageBytes);
    for (const rung_range& range : std::span(space.ranges, space.range_count)) {
      if (range.first_byte >= messageBytes) break;
      pieces.push_back({.first = range.first_byte,
                        .count = std::min(range.byte_count, messageBytes - range.first_byte),
                        .offset = range.offset,
                        .expanded = range.repr == RUNG_REPR_BYTE_PER_BIT});
      for (uint32_t i = 0; i < pieces.back().size(); ++i)
        written.push_back(runtime::writtenBits(program, range.offset + i));
    }
  }
  void readNumbers(const rung_program& program) {
    display = runtime::findSpace(program, "@DISPB");
    shift = runtime::findSpace(program, "K");
    if (shift != RUNG_NONE && program.spaces[shift].byte_count < kShiftAt + 2) shift = RUNG_NONE;
    for (const rung_message_text& text : std::span(program.texts, program.text_count)) {
      if (text.number == 0 || text.number > 8 * kMostMessageBytes) continue;
      if (text.number > numbers.size()) numbers.resize(text.number);
      numbers[text.number - 1] = numberOf(text.text);
    }
  }

  pmc::Areas areas;
  std::vector<uint32_t> numbers; // of texts, by the text's number in the program's table - 1
  uint32_t display = RUNG_NONE, shift = RUNG_NONE;
  uint32_t messages;
  uint32_t messageBytes = 0;
  std::vector<pmc::MessageBytes> pieces;
  std::vector<uint8_t> written; // mask of the bits that rungs write, by byte of the pieces
};

// Ends messages of the former program that no rung can end any more.
void endOthers(uint8_t* block, const PmcPlaces& places) noexcept {
  const uint8_t* written = places.written.data();
  for (const pmc::MessageBytes& piece : places.pieces)
    for (uint32_t i = 0; i < piece.size(); ++i) block[piece.offset + i] &= *written++;
}

// Calls see(number) for each message whose bit is 1, in order, until it returns false. Nearly all bits are 0, so eight
// bytes of the block are tested at once.
template <class See>
bool forShown(const uint8_t* block, std::span<const pmc::MessageBytes> pieces, See see) {
  constexpr uint32_t kWord = sizeof(uint64_t);
  for (const pmc::MessageBytes& piece : pieces) {
    const uint32_t size = piece.size();
    for (uint32_t at = 0; at < size; at += kWord) {
      uint64_t bits = 0;
      std::memcpy(&bits, block + piece.offset + at, std::min(kWord, size - at));
      if (bits == 0) continue;
      if (piece.expanded) bits = core::packBits(block + piece.offset + at);
      for (uint32_t number = 8 * (piece.first + (piece.expanded ? at / 8 : at)) + 1; bits != 0; bits &= bits - 1)
        if (!see(number + static_cast<uint32_t>(std::countr_zero(bits)))) return false;
    }
  }
  return true;
}

} // namespace

std::unique_ptr<Places> PmcControl::locate(const rung_program& program) const {
  return std::make_unique<PmcPlaces>(program, model_->messages);
}

void PmcControl::usePlaces(runtime::Instance& instance, Places& places) noexcept {
  const auto& own = static_cast<const PmcPlaces&>(places);
  io_.emplace(instance, own.areas);
  functions_.use(*io_);
  messageArea_ = own.messages;
  messageBytes_ = own.messageBytes;
  messagePieces_ = own.pieces;
  numbers_ = own.numbers;
  displaySpace_ = own.display;
  shiftSpace_ = own.shift;
  hasSeen_ = false;
  endOthers(instance.block().data(), own);
}

void PmcControl::prepare(runtime::Instance& instance, PowerOn kind) {
  const std::vector<uint8_t> machine = readArea(instance, "X");
  const std::vector<uint8_t> cnc = readArea(instance, "F");
  Control::prepare(instance, kind);
  writeArea(instance, "X", machine);
  writeArea(instance, "F", cnc);
  functions_.powerOn();
  axes_.powerOn();
  known_.fill(0);
  hasSeen_ = false;
}

bool PmcControl::displays(const runtime::Instance& instance) const noexcept {
  if (model_->messages == pmc::MessageRule::ByBit) return true;
  return displaySpace_ != RUNG_NONE && instance.memory().readByte(displaySpace_, 0) != 0;
}

uint32_t PmcControl::shift(const runtime::Instance& instance) const noexcept {
  return shiftSpace_ == RUNG_NONE ? 0 : static_cast<uint32_t>(instance.memory().read(shiftSpace_, kShiftAt, 2));
}

PmcControl::Known PmcControl::known(uint32_t bit, uint32_t shift) const noexcept {
  if (model_->messages == pmc::MessageRule::ByBit) return {bit, bit};
  const auto numberAt = [&](uint32_t key) { return key <= numbers_.size() ? numbers_[key - 1] : 0; };
  const uint32_t key = numberAt(bit + shift) != 0 ? bit + shift : bit; // a language without this text
  return {numberAt(key), key};
}

template <class See>
bool PmcControl::forMessages(const runtime::Instance& instance, See see) const {
  if (!displays(instance)) return true;
  const uint32_t moved = shift(instance);
  return forShown(instance.block().data(), messagePieces_, [&](uint32_t bit) {
    const Known found = known(bit, moved);
    return found.number == 0 || see(found.key, found.number);
  });
}

bool PmcControl::isAsSeen(const uint8_t* block, bool display) const noexcept {
  if (!hasSeen_ || display != seenDisplay_) return false;
  const uint8_t* seen = seen_.data();
  for (const pmc::MessageBytes& piece : messagePieces_) {
    if (std::memcmp(block + piece.offset, seen, piece.size()) != 0) return false;
    seen += piece.size();
  }
  return true;
}

void PmcControl::see(const uint8_t* block, bool display) noexcept {
  uint8_t* seen = seen_.data();
  for (const pmc::MessageBytes& piece : messagePieces_) {
    std::memcpy(seen, block + piece.offset, piece.size());
    seen += piece.size();
  }
  hasSeen_ = true;
  seenDisplay_ = display;
}

bool PmcControl::nextChange(const runtime::Instance& instance, rung_message& message) noexcept {
  const bool display = displays(instance);
  if (isAsSeen(instance.block().data(), display)) return false;
  const uint32_t moved = shift(instance);
  for (uint32_t byte = 0; byte < messageBytes_; ++byte) {
    const uint8_t bits = display ? instance.memory().readByte(messageArea_, byte) : uint8_t{0};
    for (uint8_t changed = bits ^ known_[byte]; changed != 0; changed = bits ^ known_[byte]) {
      const auto bit = static_cast<uint32_t>(std::countr_zero(changed));
      known_[byte] = static_cast<uint8_t>(known_[byte] ^ 1u << bit);
      const Known found = known(8 * byte + bit + 1, moved);
      if (found.number == 0) continue;
      message = {.op = (bits >> bit & 1) != 0 ? RUNG_MESSAGE_SHOW : RUNG_MESSAGE_CLEAR, .number = found.number};
      if (model_->messages == pmc::MessageRule::ByTextList) message.value = found.key;
      return true;
    }
  }
  see(instance.block().data(), display);
  return false;
}

std::vector<ShownMessage> PmcControl::messages(const runtime::Instance& instance) const {
  const bool listed = model_->messages == pmc::MessageRule::ByTextList;
  std::vector<ShownMessage> shown;
  forMessages(instance, [&](uint32_t key, uint32_t number) {
    const std::string_view text = runtime::messageText(instance.program(), key);
    shown.push_back(
        {.number = number, .value = listed ? key : 0, .text = std::string(listed ? withoutNumber(text) : text)});
    return true;
  });
  return shown;
}

bool PmcControl::shows(const runtime::Instance& instance, std::span<const ShownMessage> these) const noexcept {
  const bool listed = model_->messages == pmc::MessageRule::ByTextList;
  size_t count = 0;
  const bool same = forMessages(instance, [&](uint32_t key, uint32_t number) {
    if (count == these.size() || these[count].number != number) return false;
    return these[count++].value == (listed ? key : 0);
  });
  return same && count == these.size();
}

// FANUC's kinds of messages by number: alarms, which the CNC shows with EX; operator messages; those without a number.

namespace {

constexpr uint32_t kFirstAlarm = 1000, kFirstMessage = 2000, kFirstPlain = 2100;

bool isAlarm(uint32_t number) { return number >= kFirstAlarm && number < kFirstMessage; }

// Appends as much as fits.
void put(std::string_view text, std::span<char> out, size_t& size) {
  const size_t count = std::min(text.size(), out.size() - size);
  std::copy_n(text.data(), count, out.data() + size);
  size += count;
}

} // namespace

bool PmcControl::showsAlarm(const runtime::Instance& instance) const noexcept {
  return model_->messages == pmc::MessageRule::ByTextList &&
         !forMessages(instance, [](uint32_t, uint32_t number) { return !isAlarm(number); });
}

size_t PmcControl::describe(const rung_program& program, const rung_message& message,
                            std::span<char> out) const noexcept {
  if (model_->messages == pmc::MessageRule::ByBit) return Control::describe(program, message, out);
  size_t size = 0;
  if (isAlarm(message.number)) put("EX", out, size);
  put(runtime::messageText(program, static_cast<uint32_t>(message.value)), out, size); // begins with the number
  return size;
}

std::string PmcControl::text(const ShownMessage& message) const {
  if (model_->messages == pmc::MessageRule::ByBit) return Control::text(message);
  const std::string number = std::to_string(message.number), text = " \"" + message.text + "\"";
  if (isAlarm(message.number)) return "alarm EX" + number + text;
  return "message " + number + text + (message.number >= kFirstPlain ? ", shown without its number" : "");
}

namespace {

// NC.MPOS.N, the machine position of axis N in 0.001 mm; only in programs that read positions (PSGNL, PSGN2).
std::optional<runtime::Ref> position(const rung_program& program, std::string_view number) {
  constexpr uint32_t kBytes = 4;
  const uint32_t space = runtime::findSpace(program, "@MPOS");
  const uint32_t axis = text::numberIn<uint32_t>(number).value_or(0);
  if (space == RUNG_NONE || axis == 0 || axis > program.spaces[space].byte_count / kBytes) return std::nullopt;
  return runtime::intRef(space, kBytes * (axis - 1), 8 * kBytes);
}

} // namespace

std::optional<runtime::Ref> PmcControl::signal(const rung_program& program, std::string_view name) const {
  constexpr std::string_view kPositions = "NC.MPOS.";
  if (name.starts_with(kPositions)) return position(program, name.substr(kPositions.size()));
  const Signal* found = findSignal(model_->signals(), name);
  if (found == nullptr) return std::nullopt;
  const uint32_t space = runtime::findSpace(program, found->area);
  if (space == RUNG_NONE) return std::nullopt;
  if (found->type == SignalType::Bit) return runtime::bitRef(space, found->byteOffset, found->bit);
  const uint32_t bytes = elementBytes(found->type);
  if (bytes == 0) return std::nullopt;
  return runtime::intRef(space, found->byteOffset, bytes * 8);
}

core::ServiceReply PmcControl::refuse(const core::ServiceRequest& request) const noexcept {
  const auto kind = static_cast<pmc::ServiceKind>(request.name->kind);
  if (kind != pmc::ServiceKind::ReadWindow && kind != pmc::ServiceKind::WriteWindow) return Control::refuse(request);
  return {.ticket = request.ticket,
          .state = RUNG_SERVICE_DONE,
          .resultCount = model_->service(kind).results.count(),
          .results = {model_->windowRefused}};
}

} // namespace rung::nc
