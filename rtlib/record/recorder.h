// The recorder: writes down what others do to a program while it runs, from which everything that the program did can
// be computed again, by any engine, on any machine (bytes_player.h). Of what the program does it writes down only when its
// outputs have changed, and a hash of them, so that a difference is found.
//
// It belongs to the scan thread, allocates nothing after its construction, and never waits: what finds no room in the
// ring is left out, which the recording says, and the next whole state begins it anew.
#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "rtlib/record/part_stream.h"
#include "rtlib/record/watched_bytes.h"
#include "rtlib/run/instance.h"

namespace rung::runtime {

// Bytes of the memory block that others write without Instance::write, and those that are compared.
struct RecordedBytes {
  WatchedBytes before;  // written between two parts only
  WatchedBytes within;  // written by hooks and latches, too
  WatchedBytes outputs; // whose contents are compared after each part when the recording is played
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
  void replied(const Instance& instance, const core::ServiceReply& reply) noexcept override;
  void written(const Instance& instance, uint32_t offset, uint32_t bytes) noexcept override;
  void surroundingsChanged(const Instance& instance) noexcept override;
  void changedWhole(const Instance& instance) noexcept override;
  // Another program runs; `bytes` are for it, and receive those of the former one. Null: nothing is recorded of it.
  void programChanged(std::unique_ptr<RecordedBytes>& bytes) noexcept;
  // Between two parts.
  void mark(std::string_view text) noexcept;
  // Makes all parts so far readable.
  void flush() noexcept { stream_.flush(); }

  // ---- the thread that writes the recording ----

  core::ByteRing& ring() noexcept { return stream_.ring(); }
  PartStream& stream() noexcept { return stream_; }

private:
  void beginsWithin(const Instance& instance, uint32_t task) noexcept;
  void putState(const Instance& instance) noexcept;
  size_t stateSize(const Instance& instance) const noexcept;
  void know(const Instance& instance) noexcept;
  void putBefore(const Instance& instance) noexcept;
  void putChanges(const Instance& instance, WatchedBytes& watched) noexcept;
  void enterWithin(const Instance& instance) noexcept;
  void putWithin() noexcept;
  void putOutcome(const Instance& instance) noexcept;

  PartStream stream_;
  std::unique_ptr<RecordedBytes> bytes_; // null: for another program

  // As recorded last:
  int64_t nowUs_ = 0;
  bool stopped_ = false;
  bool faulted_ = false;
  std::span<const core::ForcedBits> forced_;

  bool inPart_ = false;
  // Hooks and latches of the part. After a run of a task within one, the rest of it counts as another one.
  uint32_t within_ = 0; // so far
  uint32_t number_ = 0; // of the present one
  bool inWithin_ = false;
  bool withinPut_ = false; // its event is written
  uint32_t depth_ = 0;     // of runs of tasks within them
};

} // namespace rung::runtime
