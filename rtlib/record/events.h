// What a recording consists of: events in the order in which they happened to the program, each a byte and its numbers
// (docs/recording.md). Numbers are unsigned and take as few bytes as they need, seven bits a byte, lowest first.
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <span>

#include "rtlib/core/queues.h"
#include "rtlib/core/runner.h"

namespace rung::runtime {

enum class Event : uint8_t {
  State = 1,        // COUNT BYTES: the state between two scans, as Instance::save writes it
  Surroundings = 2, // WORKS LATCHES NEEDED: as in struct Surroundings, from now on
  Outputs = 3,      // COUNT (SKIP COUNT)...: the bytes of the block that Hash is of, SKIP after those before
  Forces = 4,       // COUNT (OFFSET MASK VALUE)...: from now on these bits of the block are forced
  Part = 5,   // KIND TASK: the owner of the program is about to run this part, before which the events after it happen
  Repeat = 6, // COUNT: the last part so often again, with no event of its own
  Clock = 7,  // US, signed: the clock has advanced by that outside the program
  Bytes = 8,  // OFFSET COUNT BYTES: others have written them to the block
  Reply = 9,  // TICKET STATE COUNT RESULTS: a reply that the part, or a hook in it, finds
  Stopped = 10, // 0 or 1: the operator's stop
  Within = 11,  // COUNT: the events after it happen in that hook or latch of the part, counted from 0; after a Task the
                // rest of the hook counts as another one
  Task = 12,    // TASK: a run of a task within a hook
  Request = 13, // SERVICE COUNT ARGS: a request that the control makes
  Answer = 14,  // as Reply: for a request that is answered, or kept, at once
  Ended = 15,   // the part has ended; only after events within it
  Hash = 16,    // HASH: of the outputs after the part; without it they are as after the one before
  Fault = 17,   // CODE RUNG LINE TASK: the part has ended with it
  Anew = 18,    // the program was started, or another one has taken over: the next State does not follow from before
  Mark = 19,    // COUNT BYTES: a text
  Lost = 20,    // events are missing, up to the next State
  Program = 21, // HASH: the program of the next State (rung_program::code_hash); where a recording may begin
  // Only where the control of the dialect runs again (HostRecorder):
  Inputs = 22, // COUNT (SKIP BYTES MASKS)...: bits that the host writes before each slice, first as in the next State
  Input = 23,  // OFFSET COUNT BYTES: from now on the host writes these
  Configured = 24, // KIND A B COUNT TEXT: struct Configured
  Function = 25,   // CHANNEL KIND CODE: the host has begun a function
  Abort = 26,      // CHANNEL: it has aborted all of them
  Served = 27,     // 0 or 1: whether a CNC carries out requests
  Saved = 28,      // the memory that the program has asked to save is on disk
  Decision = 29,   // enum rung_answer: what the host has said to a request, if it has not answered it
  // Short forms, which refer to events before them, back to the last State:
  Next = 30,   // a Part like the last one
  Places = 31, // KIND TASK COUNT (PLACE EVENT OFFSET COUNT)...: what the short forms after it refer to
  // From 128 on: PLACE + 128 BYTES: as the last event Bytes or Input that has this place (Places::placeOf).
};

// Writes events to memory of the caller. One that does not fit is left out, and so is everything after it.
class EventWriter {
public:
  explicit EventWriter(std::span<uint8_t> to) noexcept : to_(to) {}

  size_t size() const noexcept { return size_; }
  bool fits() const noexcept { return fits_; }
  std::span<const uint8_t> written() const noexcept { return to_.first(size_); }
  // Room for what the caller writes itself; `advance` says how much that was.
  std::span<uint8_t> rest() const noexcept { return to_.subspan(size_); }
  void advance(size_t bytes) noexcept {
    fits_ = fits_ && bytes <= to_.size() - size_;
    if (fits_) size_ += bytes;
  }
  // Removes what was written after that size.
  void cut(size_t size) noexcept {
    size_ = size;
    fits_ = true;
  }

  template <class... Numbers>
  void put(Event event, Numbers... numbers) noexcept {
    constexpr size_t kMost = 1 + kNumber * sizeof...(Numbers);
    if (fits_ && kMost <= to_.size() - size_) {
      uint8_t* at = to_.data() + size_;
      *at++ = static_cast<uint8_t>(event);
      ((at = numberAt(at, static_cast<uint64_t>(numbers))), ...);
      size_ = static_cast<size_t>(at - to_.data());
      return;
    }
    putByte(static_cast<uint8_t>(event));
    (putNumber(static_cast<uint64_t>(numbers)), ...);
  }
  void putByte(uint8_t byte) noexcept {
    fits_ = fits_ && size_ < to_.size();
    if (fits_) to_[size_++] = byte;
  }
  void putNumber(uint64_t number) noexcept {
    for (; number >= 0x80; number >>= 7) putByte(static_cast<uint8_t>(number | 0x80));
    putByte(static_cast<uint8_t>(number));
  }
  // A number of up to 35 bits in five bytes, which can be written later.
  static constexpr size_t kPadded = 5;
  void putPadded(uint64_t number) noexcept {
    for (size_t i = 0; i + 1 < kPadded; ++i, number >>= 7) putByte(static_cast<uint8_t>(number | 0x80));
    putByte(static_cast<uint8_t>(number & 0x7F));
  }
  void putBytes(std::span<const uint8_t> bytes) noexcept {
    fits_ = fits_ && bytes.size() <= to_.size() - size_;
    if (!fits_ || bytes.empty()) return;
    uint8_t* to = to_.data() + size_;
    size_ += bytes.size();
    if (bytes.size() <= kFew) return copyFew(to, bytes.data(), bytes.size());
    std::memcpy(to, bytes.data(), bytes.size());
  }

private:
  static constexpr size_t kNumber = 10; // bytes of one, at most
  static constexpr size_t kFew = 8;     // bytes that are copied here: most events are that short
  static void copyFew(uint8_t* to, const uint8_t* from, size_t count) noexcept {
    if (count >= sizeof(uint32_t)) return copyBoth<uint32_t>(to, from, count);
    if (count >= sizeof(uint16_t)) return copyBoth<uint16_t>(to, from, count);
    *to = *from;
  }
  // The first bytes and the last ones, which may overlap.
  template <class Word>
  static void copyBoth(uint8_t* to, const uint8_t* from, size_t count) noexcept {
    std::memcpy(to, from, sizeof(Word));
    std::memcpy(to + count - sizeof(Word), from + count - sizeof(Word), sizeof(Word));
  }
  static uint8_t* numberAt(uint8_t* at, uint64_t number) noexcept {
    for (; number >= 0x80; number >>= 7) *at++ = static_cast<uint8_t>(number | 0x80);
    *at++ = static_cast<uint8_t>(number);
    return at;
  }

  std::span<uint8_t> to_;
  size_t size_ = 0;
  bool fits_ = true;
};

// Reads events. After bytes that are cut off `good` is false, and everything further reads as 0.
class EventReader {
public:
  explicit EventReader(std::span<const uint8_t> from) noexcept : from_(from) {}

  bool good() const noexcept { return good_; }
  bool atEnd() const noexcept { return !good_ || at_ == from_.size(); }
  size_t position() const noexcept { return at_; }
  // The event that follows, which stays; only if it is not the end.
  Event next() const noexcept { return static_cast<Event>(from_[at_]); }

  Event takeEvent() noexcept { return static_cast<Event>(takeByte()); }
  uint64_t takeNumber() noexcept {
    uint64_t number = 0;
    for (uint32_t shift = 0; shift < 64; shift += 7) {
      const uint8_t byte = takeByte();
      number |= uint64_t{byte & 0x7Fu} << shift;
      if (byte < 0x80) return number;
    }
    good_ = false;
    return 0;
  }
  uint32_t takeNumber32() noexcept {
    const uint64_t number = takeNumber();
    good_ = good_ && number <= UINT32_MAX;
    return good_ ? static_cast<uint32_t>(number) : 0;
  }
  // Empty if there are not that many.
  std::span<const uint8_t> takeBytes(uint64_t count) noexcept {
    good_ = good_ && count <= from_.size() - at_;
    if (!good_) return {};
    at_ += count;
    return from_.subspan(at_ - count, count);
  }

private:
  uint8_t takeByte() noexcept {
    good_ = good_ && at_ < from_.size();
    return good_ ? from_[at_++] : uint8_t{0};
  }

  std::span<const uint8_t> from_;
  size_t at_ = 0;
  bool good_ = true;
};

// Signed numbers: 0, -1, 1, -2, ...
inline uint64_t zigzag(int64_t value) noexcept {
  return static_cast<uint64_t>(value) << 1 ^ static_cast<uint64_t>(value >> 63);
}
inline int64_t unzigzag(uint64_t number) noexcept {
  return static_cast<int64_t>(number >> 1) ^ -static_cast<int64_t>(number & 1);
}

// ---- what several of those who write events have in common -------------------------------------------------------

// Event::Forces; `roomForForces` is its size at most.
inline size_t roomForForces(std::span<const core::ForcedBits> forced) noexcept { return 16 + 12 * forced.size(); }
inline void putForces(EventWriter& writer, std::span<const core::ForcedBits> forced) noexcept {
  writer.put(Event::Forces, forced.size());
  for (const core::ForcedBits& bits : forced) {
    writer.putNumber(bits.offset);
    writer.putNumber(bits.mask);
    writer.putNumber(bits.value);
  }
}

// Event::Reply or Event::Answer.
inline void putReply(EventWriter& writer, Event event, const core::ServiceReply& reply) noexcept {
  const uint32_t count = std::min(reply.resultCount, RUNG_MAX_SERVICE_ARGS);
  writer.put(event, reply.ticket, reply.state, count);
  for (uint32_t i = 0; i < count; ++i) writer.putNumber(zigzag(reply.results[i]));
}

// The events Bytes and Input that short forms may refer to, as writer and reader know them: of each place the last one.
// Nothing here allocates.
class Places {
public:
  static constexpr uint8_t kShort = 128; // the first byte of a short form
  static constexpr size_t kCount = 128;
  struct Run {
    Event event = Event::Bytes;
    uint32_t offset = 0, count = 0; // 0: no event has had this place
    bool operator==(const Run&) const = default;
  };

  static size_t placeOf(const Run& run) noexcept {
    const uint32_t mixed = (run.offset * 8 + run.count) * 0x9E3779B1u ^ static_cast<uint32_t>(run.event);
    return (mixed ^ mixed >> 16) % kCount;
  }
  void clear() noexcept { runs_.fill({}); }
  // Makes it the last one of its place. Whether it was that already.
  bool know(const Run& run) noexcept {
    Run& last = runs_[placeOf(run)];
    if (last == run) return true;
    last = run;
    return false;
  }
  const Run& at(size_t place) const noexcept { return runs_[place]; }
  // Of the rest of Event::Places, without KIND and TASK.
  static constexpr size_t kRoom = 16 * kCount;
  void list(EventWriter& writer) const noexcept {
    writer.putNumber(
        static_cast<uint64_t>(std::ranges::count_if(runs_, [](const Run& run) { return run.count != 0; })));
    for (size_t place = 0; place < kCount; ++place) {
      const Run& run = runs_[place];
      if (run.count == 0) continue;
      for (const uint64_t number :
           {uint64_t{place}, static_cast<uint64_t>(run.event), uint64_t{run.offset}, uint64_t{run.count}})
        writer.putNumber(number);
    }
  }
  bool takeList(EventReader& reader) noexcept {
    clear();
    for (uint64_t left = reader.takeNumber(); left != 0; --left) {
      const uint64_t place = reader.takeNumber();
      const uint64_t event = reader.takeNumber();
      const uint32_t offset = reader.takeNumber32(), count = reader.takeNumber32();
      const bool isEvent = event == static_cast<uint64_t>(Event::Bytes) || event == static_cast<uint64_t>(Event::Input);
      if (!reader.good() || place >= kCount || !isEvent || count == 0) return false;
      runs_[place] = {static_cast<Event>(event), offset, count};
    }
    return reader.good();
  }

private:
  std::array<Run, kCount> runs_{};
};

// Bytes that others have written: their event, or its short form.
inline void putRun(EventWriter& writer, Places& places, const Places::Run& run, const uint8_t* bytes) noexcept {
  if (places.know(run))
    writer.putByte(static_cast<uint8_t>(Places::kShort + Places::placeOf(run)));
  else
    writer.put(run.event, run.offset, run.count);
  writer.putBytes({bytes, run.count});
}

inline bool isRun(Event event) noexcept {
  return event == Event::Bytes || event == Event::Input || static_cast<uint8_t>(event) >= Places::kShort;
}

// Reads such an event, whose first byte has been taken. False: it is none that can be. `bytes` are in the events.
inline bool takeRun(EventReader& reader, Places& places, Event first, Places::Run& run,
                    std::span<const uint8_t>& bytes) noexcept {
  const auto number = static_cast<uint8_t>(first);
  if (number >= Places::kShort) {
    run = places.at(number - Places::kShort);
  } else {
    const uint64_t offset = reader.takeNumber(), count = reader.takeNumber();
    if (!reader.good() || offset > UINT32_MAX || count > UINT32_MAX) return false;
    run = {first, static_cast<uint32_t>(offset), static_cast<uint32_t>(count)};
    if (count != 0) (void)places.know(run);
  }
  bytes = reader.takeBytes(run.count);
  return reader.good() && run.count != 0;
}

// Joins bytes of a memory block, which come with ascending offsets, to runs, each of which is an event.
class ByteRuns {
public:
  ByteRuns(EventWriter& writer, Places& places, Event event, const uint8_t* block) noexcept
      : writer_(writer), places_(places), event_(event), block_(block) {}
  ByteRuns(const ByteRuns&) = delete;
  ByteRuns& operator=(const ByteRuns&) = delete;
  ~ByteRuns() {
    if (count_ != 0) put();
  }

  void add(uint32_t offset) noexcept {
    if (count_ != 0 && offset != first_ + count_) put();
    if (count_ == 0) first_ = offset;
    ++count_;
  }

private:
  void put() noexcept {
    putRun(writer_, places_, {event_, first_, count_}, block_ + first_);
    count_ = 0;
  }
  EventWriter& writer_;
  Places& places_;
  Event event_;
  const uint8_t* block_;
  uint32_t first_ = 0, count_ = 0;
};

} // namespace rung::runtime
