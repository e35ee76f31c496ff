// The parts of a program's run on their way from the scan thread to the one that writes the recording. Equal parts are
// counted; what finds no room in the ring is left out, which the recording says, and the next whole state begins it
// anew.
#pragma once
#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include "rtlib/core/handover.h"
#include "rtlib/record/events.h"
#include "rtlib/run/instance.h"

namespace rung::runtime {

struct RecorderOptions {
  size_t ringBytes = size_t{1} << 20; // a power of two, at least four whole states
  int64_t stateEveryUs = 10'000'000;  // of the program's clock, between two states
};

class PartStream {
public:
  // `partRoom`: bytes that the events of a part may need. Allocates; nothing else here does.
  PartStream(const RecorderOptions& options, size_t partRoom)
      : options_(options), ring_(options.ringBytes), partBytes_(partRoom), batchBytes_(partRoom + 2 * kBatch),
        part_(partBytes_), batch_(batchBytes_) {}

  // ---- scan thread ----

  // The events of the part, and those since the last one; only while `whole`.
  EventWriter& events() noexcept { return part_; }
  Places& places() noexcept { return places_; }
  // Whether all since the last state is recorded.
  bool whole() const noexcept { return whole_; }
  bool isStateDue(int64_t nowUs) const noexcept { return nowUs >= stateUs_; }
  // Begins a record with a whole state, after all before it. `put` writes the events that belong to it, at most `room`
  // bytes, or returns false. False: there is no room; the recording continues as it was, and a state is due again after
  // a while.
  template <class Put>
  bool putState(uint64_t program, int64_t nowUs, size_t room, Put put) noexcept;
  // What comes from now on does not follow from before.
  void beginAnew() noexcept {
    if (whole_) flush();
    whole_ = false;
    stateUs_ = kAtOnce;
    part_.cut(0);
  }

  // The part that begins next.
  void announce(PartKind kind, uint32_t number) noexcept { now_ = {.kind = kind, .number = number}; }
  // After what has happened before it.
  void begin() noexcept {
    now_.plain = part_.size() == 0;
    plainSize_ = 0;
    if (!now_.plain) putPart();
  }
  // Only when there is something else to write: most parts are as the one before.
  void putPart() noexcept {
    if (plainSize_ != 0) return;
    if (now_.kind == written_.kind && now_.number == written_.number && written_.plain)
      part_.put(Event::Next);
    else
      part_.put(Event::Part, static_cast<uint8_t>(now_.kind), now_.number == RUNG_NONE ? 0 : now_.number);
    written_ = {.kind = now_.kind, .plain = true, .number = now_.number};
    plainSize_ = part_.size();
  }
  bool hasEventsWithin() const noexcept { return part_.size() != plainSize_; }
  void end() noexcept {
    if (part_.size() == 0 && now_ == last_)
      ++repeats_;
    else
      keepPart();
    if (wanted_.load(std::memory_order_relaxed)) serve();
  }
  // By a fault, which stops the program.
  void endByFault() noexcept {
    faults_.store(faults_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
    want();
    end();
  }
  // Makes all parts so far readable.
  void flush() noexcept;

  // ---- the thread that writes the recording ----

  // Records of whole parts, one after the other. Those with a state begin with Event::Program.
  core::ByteRing& ring() noexcept { return ring_; }
  // Parts are made readable at the end of the one that runs.
  void want() noexcept { wanted_.store(true, std::memory_order_relaxed); }
  // Any thread: how often events were lost.
  uint64_t losses() const noexcept { return losses_.load(std::memory_order_relaxed); }
  uint32_t faults() const noexcept { return faults_.load(std::memory_order_relaxed); } // any thread

private:
  static constexpr size_t kBatch = 1024; // bytes that are made readable together
  static constexpr size_t kHead = 16;    // bytes of the first events of a state
  static constexpr int64_t kAtOnce = INT64_MIN, kAgainUs = 100'000;

  struct Part {
    PartKind kind = PartKind::Scan;
    // Of the present one: it has no other event. Of the last one: such a part is its repetition.
    bool plain = false;
    uint32_t number = RUNG_NONE;
    bool operator==(const Part&) const = default;
  };

  void keepBefore() noexcept;
  void keepPart() noexcept;
  void putRepeats() noexcept;
  void lose() noexcept;
  void serve() noexcept {
    wanted_.store(false, std::memory_order_relaxed);
    flush();
  }

  RecorderOptions options_;
  core::ByteRing ring_;
  std::vector<uint8_t> partBytes_, batchBytes_;
  EventWriter part_;
  EventWriter batch_; // parts that are not readable yet
  bool whole_ = false;
  bool lost_ = false;         // something was lost since then
  int64_t stateUs_ = kAtOnce; // when the next state is due
  Part now_, last_;
  Part written_; // by the last event of a part; not plain: there is none since the last state
  Places places_;
  size_t plainSize_ = 0; // of the events up to that of the part itself; 0: it is not written
  uint64_t repeats_ = 0; // of the last one
  std::atomic<bool> wanted_{false};
  std::atomic<uint64_t> losses_{0};
  std::atomic<uint32_t> faults_{0};
};

template <class Put>
bool PartStream::putState(uint64_t program, int64_t nowUs, size_t room, Put put) noexcept {
  keepBefore();
  const std::span<uint8_t> to = ring_.reserve(kHead + room);
  if (to.empty()) {
    stateUs_ = nowUs + kAgainUs;
    return false;
  }
  EventWriter writer(to);
  writer.put(Event::Program, program);
  if (!whole_) writer.put(lost_ ? Event::Lost : Event::Anew);
  if (!put(writer)) return false;
  ring_.commit(writer.size());
  stateUs_ = nowUs + options_.stateEveryUs;
  whole_ = true;
  lost_ = false;
  last_.plain = written_.plain = false; // a recording may be played from here
  places_.clear();
  return true;
}

} // namespace rung::runtime
