// A request of a TECHNOL program to a device while it is being answered, and the bytes of answers that programs fetch
// afterwards (rtlib/nc/technol/services.h). The device may be simulated or real. Nothing here allocates in a scan.
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

#include "rtlib/core/queues.h"
#include "rtlib/nc/control/technol/values.h"
#include "rtlib/nc/technol/services.h"
#include "rtlib/run/instance.h"
#include "rtlib/text/letters.h"
#include "rtlib/text/number.h"
#include "rung/program.h"

namespace rung::io {

// Storage for the bytes of answers.
class AnswerRoom {
public:
  static constexpr uint32_t kMost = nc::technol::kMostArgumentBytes; // of one answer

  // Makes room for the bytes of an answer, at most `count`.
  virtual std::span<uint8_t> make(uint32_t ticket, uint32_t count) = 0;

protected:
  ~AnswerRoom() = default;
};

// The bytes of the latest answers, by ticket.
class AnswerBytes final : public AnswerRoom {
public:
  AnswerBytes() : bytes_(std::make_unique<std::array<uint8_t, kRoom>>()) {}

  // Overwrites the bytes of the oldest answers.
  std::span<uint8_t> make(uint32_t ticket, uint32_t count) override {
    count = std::min(count, kMost);
    if (kRoom - end_ < count) end_ = 0;
    Entry& entry = entries_[next_++ % entries_.size()] = {.ticket = ticket, .first = end_, .count = count};
    end_ += count;
    return {bytes_->data() + entry.first, count};
  }
  // Answers FetchBytes.
  void fetch(const core::ServiceRequest& request, core::ServiceReply& reply) const {
    reply.resultCount = RUNG_MAX_SERVICE_ARGS;
    const auto first = static_cast<uint64_t>(request.args[1]) * nc::technol::kDataBytes;
    for (const Entry& entry : entries_) {
      if (entry.ticket != static_cast<uint32_t>(request.args[0]) || first >= entry.count) continue;
      const uint64_t count = std::min<uint64_t>(entry.count - first, nc::technol::kDataBytes);
      for (uint64_t i = 0; i < count; ++i)
        reply.results[i / 8] |= static_cast<int64_t>(uint64_t{(*bytes_)[entry.first + first + i]} << i % 8 * 8);
      return;
    }
  }
  void clear() { entries_ = {}, end_ = 0; }

  template <class Archive>
  void state(Archive& archive) {
    archive.atMost(next_, UINT64_MAX);
    archive.atMost(end_, kRoom);
    for (Entry& entry : entries_) {
      archive(entry.ticket);
      if (entry.ticket == 0) continue;
      archive.atMost(entry.count, kMost);
      archive.atMost(entry.first, kRoom - entry.count);
      archive.bytes(std::span(*bytes_).subspan(entry.first, entry.count));
    }
  }

private:
  static constexpr uint32_t kRoom = 1u << 18;
  struct Entry {
    uint32_t ticket = 0; // 0: unused
    uint32_t first = 0;
    uint32_t count = 0;
  };
  std::array<Entry, core::ServiceQueue::kRecords> entries_ = {}; // enough for all known tickets
  size_t next_ = 0;
  uint32_t end_ = 0;
  std::unique_ptr<std::array<uint8_t, kRoom>> bytes_;
};

using nc::technol::Device;
using nc::technol::ServiceKind;

inline ServiceKind kindOf(const core::ServiceRequest& request) { return static_cast<ServiceKind>(request.name->kind); }

class DeviceCall {
public:
  // For an answer within the program's instruction.
  DeviceCall(const runtime::Instance& instance, const core::ServiceRequest& request, core::ServiceReply& reply,
             AnswerRoom& room)
      : instance_(&instance), request_(request), reply_(reply), room_(room) {
    begin();
  }
  // For a later answer, outside the scan: `given` are the program's bytes of the one argument that refers to bytes.
  DeviceCall(std::span<const uint8_t> given, const core::ServiceRequest& request, core::ServiceReply& reply,
             AnswerRoom& room)
      : given_(given), request_(request), reply_(reply), room_(room) {
    begin();
  }

  // Only within the instruction.
  core::Memory memory() const { return instance_->memory(); }
  const core::ServiceRequest& request() const { return request_; }
  ServiceKind kind() const { return kindOf(request_); }
  int64_t arg(uint32_t number) const { return request_.args[number]; }
  int64_t argOr(uint32_t number, int64_t otherwise) const {
    return arg(number) == nc::technol::kNotGiven ? otherwise : arg(number);
  }
  // An argument as an unsigned 32-bit number; UINT32_MAX if it does not fit.
  uint32_t number(uint32_t at) const {
    return arg(at) < 0 || arg(at) > UINT32_MAX ? UINT32_MAX : static_cast<uint32_t>(arg(at));
  }
  double real(uint32_t at) const { return std::bit_cast<double>(arg(at)); }
  // The program's bytes, copied to `room`, as many as fit.
  std::span<const uint8_t> bytes(uint32_t at, std::span<uint8_t> room) const {
    const nc::technol::ArgumentBytes from = nc::technol::bytesOfArgument(arg(at));
    if (instance_ == nullptr) return given_.first(std::min(given_.size(), room.size()));
    const auto count = std::min<uint32_t>(from.count, static_cast<uint32_t>(room.size()));
    const core::Memory memory = instance_->memory();
    for (uint32_t i = 0; i < count; ++i) room[i] = memory.readByte(from.space, from.first + i);
    return room.first(count);
  }
  // The program's bytes up to a terminating 0.
  std::string_view text(uint32_t at, std::span<uint8_t> room) const {
    const std::span<const uint8_t> all = bytes(at, room);
    const auto end = std::ranges::find(all, 0);
    return {reinterpret_cast<const char*>(all.data()), static_cast<size_t>(end - all.begin())};
  }

  void set(uint32_t result, int64_t value) { reply_.results[result] = value; }
  int64_t result(uint32_t number) const { return reply_.results[number]; }
  void setReal(uint32_t result, double value) { set(result, std::bit_cast<int64_t>(value)); }
  // Makes room for bytes of the answer; their number becomes the result.
  std::span<uint8_t> makeBytes(uint32_t result, uint32_t count) {
    const std::span<uint8_t> made = room_.make(request_.ticket, count);
    set(result, static_cast<int64_t>(made.size()));
    return made;
  }
  void setBytes(uint32_t result, std::span<const uint8_t> bytes) {
    const std::span<uint8_t> made = makeBytes(result, static_cast<uint32_t>(bytes.size()));
    std::ranges::copy(bytes.first(made.size()), made.begin());
  }
  // The request is not carried out.
  void refuse() { reply_.state = RUNG_SERVICE_ERROR; }
  // The answer follows later, through the instance's queue.
  void wait() { reply_.state = RUNG_SERVICE_PENDING; }

private:
  void begin() {
    reply_.ticket = request_.ticket;
    reply_.state = RUNG_SERVICE_DONE;
    reply_.resultCount = RUNG_MAX_SERVICE_ARGS;
  }

  const runtime::Instance* instance_ = nullptr; // null: a later answer
  std::span<const uint8_t> given_;
  const core::ServiceRequest& request_;
  core::ServiceReply& reply_;
  AnswerRoom& room_;
};

// Parsing of configuration keys and their values.

// Nothing if the text is not a number within these limits.
inline std::optional<uint32_t> numberBetween(std::string_view text, int64_t least, int64_t most) {
  const auto number = nc::technol::integerOf(text);
  return number && *number >= least && *number <= most ? std::optional(static_cast<uint32_t>(*number)) : std::nullopt;
}

// The number after a prefix of the key, in any case: PlcTableDef3.
inline std::optional<uint32_t> numberAfter(std::string_view key, std::string_view prefix) {
  return text::takePrefixIgnoringCase(key, prefix) ? text::numberIn<uint32_t>(key) : std::nullopt;
}

// Removes the text up to the character, and the character, from `text` and returns it; all of the text if the character
// is missing.
inline std::string_view takeUntil(std::string_view& text, char end) {
  const size_t at = std::min(text.find(end), text.size());
  const std::string_view part = text.substr(0, at);
  text.remove_prefix(std::min(at + 1, text.size()));
  return part;
}

} // namespace rung::io
