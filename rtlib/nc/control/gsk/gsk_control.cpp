// Power-on, messages and names of GSK (see gsk_control.h).
#include "rtlib/nc/control/gsk/gsk_control.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "rtlib/change/forcing.h"
#include "rtlib/core/bits.h"
#include "rtlib/load/program_info.h"
#include "rtlib/nc/gsk/signals.h"
#include "rtlib/nc/gsk/window_functions.h"
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

constexpr uint32_t kMostMessageBytes = GskControl::kMostMessageBytes;

struct GskPlaces final : Places {
  explicit GskPlaces(const rung_program& program) : areas(program), messages(runtime::findSpace(program, "A")) {
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
  gsk::Areas areas;
  uint32_t messages;
  uint32_t messageBytes = 0;
  std::vector<gsk::MessageBytes> pieces;
  std::vector<uint8_t> written; // mask of the bits that rungs write, by byte of the pieces
};

// Ends messages of the former program that no rung can end any more.
void endOthers(uint8_t* block, const GskPlaces& places) noexcept {
  const uint8_t* written = places.written.data();
  for (const gsk::MessageBytes& piece : places.pieces)
    for (uint32_t i = 0; i < piece.size(); ++i) block[piece.offset + i] &= *written++;
}

// Calls see(number) for each message whose bit is 1, in order, until it returns false. Nearly all bits are 0, so eight
// bytes of the block are tested at once.
template <class See>
bool forShown(const uint8_t* block, std::span<const gsk::MessageBytes> pieces, See see) {
  constexpr uint32_t kWord = sizeof(uint64_t);
  for (const gsk::MessageBytes& piece : pieces) {
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

std::unique_ptr<Places> GskControl::locate(const rung_program& program) const {
  return std::make_unique<GskPlaces>(program);
}

void GskControl::usePlaces(runtime::Instance& instance, Places& places) noexcept {
  const auto& own = static_cast<const GskPlaces&>(places);
  io_.emplace(instance, own.areas);
  functions_.use(*io_);
  messageArea_ = own.messages;
  messageBytes_ = own.messageBytes;
  messagePieces_ = own.pieces;
  hasSeen_ = false;
  endOthers(instance.block().data(), own);
}

void GskControl::prepare(runtime::Instance& instance, PowerOn kind) {
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

bool GskControl::isAsSeen(const uint8_t* block) const noexcept {
  const uint8_t* seen = seen_.data();
  for (const gsk::MessageBytes& piece : messagePieces_) {
    if (std::memcmp(block + piece.offset, seen, piece.size()) != 0) return false;
    seen += piece.size();
  }
  return hasSeen_;
}

void GskControl::see(const uint8_t* block) noexcept {
  uint8_t* seen = seen_.data();
  for (const gsk::MessageBytes& piece : messagePieces_) {
    std::memcpy(seen, block + piece.offset, piece.size());
    seen += piece.size();
  }
  hasSeen_ = true;
}

bool GskControl::nextChange(const runtime::Instance& instance, rung_message& message) noexcept {
  if (isAsSeen(instance.block().data())) return false;
  for (uint32_t byte = 0; byte < messageBytes_; ++byte) {
    const uint8_t bits = instance.memory().readByte(messageArea_, byte);
    const auto changed = static_cast<uint8_t>(bits ^ known_[byte]);
    if (changed == 0) continue;
    const auto bit = static_cast<uint32_t>(std::countr_zero(changed));
    known_[byte] = static_cast<uint8_t>(known_[byte] ^ 1u << bit);
    const bool shown = (bits >> bit & 1) != 0;
    message = {.op = shown ? RUNG_MESSAGE_SHOW : RUNG_MESSAGE_CLEAR, .number = 8 * byte + bit + 1};
    return true;
  }
  see(instance.block().data());
  return false;
}

std::vector<ShownMessage> GskControl::messages(const runtime::Instance& instance) const {
  std::vector<ShownMessage> shown;
  forShown(instance.block().data(), messagePieces_, [&](uint32_t number) {
    shown.push_back({number, 0, 0, 0, false, std::string(runtime::messageText(instance.program(), number))});
    return true;
  });
  return shown;
}

bool GskControl::shows(const runtime::Instance& instance, std::span<const ShownMessage> these) const noexcept {
  size_t count = 0;
  const bool same = forShown(instance.block().data(), messagePieces_, [&](uint32_t number) {
    if (count == these.size() || these[count].number != number) return false;
    ++count;
    return true;
  });
  return same && count == these.size();
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

std::optional<runtime::Ref> GskControl::signal(const rung_program& program, std::string_view name) const {
  constexpr std::string_view kPositions = "NC.MPOS.";
  if (name.starts_with(kPositions)) return position(program, name.substr(kPositions.size()));
  const Signal* found = findSignal(gskSignals(), name);
  if (found == nullptr) return std::nullopt;
  const uint32_t space = runtime::findSpace(program, found->area);
  if (space == RUNG_NONE) return std::nullopt;
  if (found->type == SignalType::Bit) return runtime::bitRef(space, found->byteOffset, found->bit);
  const uint32_t bytes = elementBytes(found->type);
  if (bytes == 0) return std::nullopt;
  return runtime::intRef(space, found->byteOffset, bytes * 8);
}

core::ServiceReply GskControl::refuse(const core::ServiceRequest& request) const noexcept {
  core::ServiceReply reply{.ticket = request.ticket, .state = RUNG_SERVICE_DONE, .results = {gsk::kWindowNotProvided}};
  switch (static_cast<gsk::ServiceKind>(request.name->kind)) {
  case gsk::ServiceKind::ReadWindow: reply.resultCount = 2; return reply;
  case gsk::ServiceKind::WriteWindow: reply.resultCount = 1; return reply;
  case gsk::ServiceKind::MoveAxis:
  case gsk::ServiceKind::Unknown: break;
  }
  return Control::refuse(request);
}

} // namespace rung::nc
