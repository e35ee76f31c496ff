// The recorder: writes down what others do to a program while it runs, from which everything that the program did can
// be computed again, by any engine, on any machine (player.h). Of what the program does it writes down only when its
// outputs have changed, and a hash of them, so that a difference is found.
//
// It belongs to the scan thread, allocates nothing after its construction, and never waits: what finds no room in the
// ring is left out, which the recording says, and the next whole state begins it anew.
#pragma once
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "rtlib/core/handover.h"
#include "rtlib/record/events.h"
#include "rtlib/record/watched_bytes.h"
#include "rtlib/run/instance.h"

namespace rung::runtime {

// Bytes of the memory block that others write without Instance::write, and those that are compared.
struct RecordedBytes {
  WatchedBytes before;  // written between two parts only
  WatchedBytes within;  // written by hooks and latches, too
  WatchedBytes outputs; // whose contents are compared after each part when the recording is played
};

struct RecorderOptions {
  size_t ringBytes = size_t{1} << 20; // a power of two, at least four whole states
  int64_t stateEveryUs = 10'000'000;  // of the program's clock, between two states
};

class Recorder final : public OutsideWatch {
public:
  // All are for the program of the instance.
  Recorder(const Instance& instance, RecordedBytes bytes, const RecorderOptions& options = {});

  // ---- scan thread ----

  void begins(const Instance& instance, PartKind kind, uint32_t number) noexcept override;
  void ended(const Instance& instance) noexcept override;
  void withinBegins(const Instance& instance) noexcept override;
  void withinEnded(const Instance& instance) noexcept override;
  void requested(const Instance& instance, const core::ServiceRequest& request,
                 const core::ServiceReply* reply) noexcept override;
  void written(const Instance& instance, uint32_t offset, uint32_t bytes) noexcept override;
  void surroundingsChanged(const Instance& instance) noexcept override;
  void changedWhole(const Instance& instance) noexcept override;
  // Between two parts.
  void mark(std::string_view text) noexcept;
  // Makes all parts so far readable.
  void flush() noexcept;

  // ---- the thread that writes the recording ----

  // Records of whole events, one after the other.
  core::ByteRing& ring() noexcept { return ring_; }

private:
  static constexpr size_t kBatch = 1024; // bytes that are made readable together

  struct Part {
    PartKind kind = PartKind::Scan;
    uint32_t number = RUNG_NONE;
    // Of the present one: it has no other event. Of the last one: such a part is its repetition.
    bool plain = false;
    bool operator==(const Part&) const = default;
  };

  void beginsWithin(const Instance& instance, uint32_t task) noexcept;
  void putState(const Instance& instance) noexcept;
  void keepBefore() noexcept;
  size_t stateSize(const Instance& instance) const noexcept;
  void know(const Instance& instance) noexcept;
  void putBefore(const Instance& instance) noexcept;
  void putPart() noexcept;
  void putChanges(const Instance& instance, WatchedBytes& watched) noexcept;
  void enterWithin(const Instance& instance) noexcept;
  void putWithin() noexcept;
  void putReply(Event event, const core::ServiceReply& reply) noexcept;
  void putOutcome(const Instance& instance) noexcept;
  void keepPart() noexcept;
  void putRepeats() noexcept;
  void lose() noexcept;

  RecorderOptions options_;
  core::ByteRing ring_;
  std::vector<uint8_t> partBytes_, batchBytes_;
  EventWriter part_;  // the events of the part, and those since the last one
  EventWriter batch_; // parts that are not readable yet
  WatchedBytes before_, withinBytes_, outputs_;

  bool whole_ = false;  // all since the last state is recorded
  bool lost_ = false;   // something was lost since then
  int64_t stateUs_ = 0; // when the next state is due
  // As recorded last:
  int64_t nowUs_ = 0;
  bool stopped_ = false;
  bool faulted_ = false;
  std::span<const core::ForcedBits> forced_;

  uint32_t replies_ = 0; // that wait and are written
  bool inPart_ = false;
  Part now_, last_;
  size_t plainSize_ = 0; // of the events up to that of the part itself; 0: it is not written
  uint64_t repeats_ = 0; // of the last one
  // Hooks and latches of the part. After a run of a task within one, the rest of it counts as another one.
  uint32_t within_ = 0; // so far
  uint32_t number_ = 0; // of the present one
  bool inWithin_ = false;
  bool withinPut_ = false; // its event is written
  uint32_t depth_ = 0;     // of runs of tasks within them
};

} // namespace rung::runtime
