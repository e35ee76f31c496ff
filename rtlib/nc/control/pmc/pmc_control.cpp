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

struct PmcPlaces final : Places {
  explicit PmcPlaces(const rung_program& program) : areas(program), messages(runtime::findSpace(program, "A")) {
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
  pmc::Areas areas;
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
  return std::make_unique<PmcPlaces>(program);
}

void PmcControl::usePlaces(runtime::Instance& instance, Places& places) noexcept {
  const auto& own = static_cast<const PmcPlaces&>(places);
  io_.emplace(instance, own.areas);
  functions_.use(*io_);
  messageArea_ = own.messages;
  messageBytes_ = own.messageBytes;
  messagePieces_ = own.pieces;
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

bool PmcControl::isAsSeen(const uint8_t* block) const noexcept {
  const uint8_t* seen = seen_.data();
  for (const pmc::MessageBytes& piece : messagePieces_) {
    if (std::memcmp(block + piece.offset, seen, piece.size()) != 0) return false;
    seen += piece.size();
  }
  return hasSeen_;
}

void PmcControl::see(const uint8_t* block) noexcept {
  uint8_t* seen = seen_.data();
  for (const pmc::MessageBytes& piece : messagePieces_) {
    std::memcpy(seen, block + piece.offset, piece.size());
    seen += piece.size();
  }
  hasSeen_ = true;
}

bool PmcControl::nextChange(const runtime::Instance& instance, rung_message& message) noexcept {
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

std::vector<ShownMessage> PmcControl::messages(const runtime::Instance& instance) const {
  std::vector<ShownMessage> shown;
  forShown(instance.block().data(), messagePieces_, [&](uint32_t number) {
    shown.push_back({number, 0, 0, 0, false, std::string(runtime::messageText(instance.program(), number))});
    return true;
  });
  return shown;
}

bool PmcControl::shows(const runtime::Instance& instance, std::span<const ShownMessage> these) const noexcept {
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
