// When the bits of a program's memory last changed. After each scan, what the program uses is compared with a copy that
// is first made in the constructor.
#pragma once
#include <optional>
#include <vector>

#include "ir/analysis/uses.h"
#include "tools/scenario/session.h"

namespace rung::scenario {

class Changes final : public Observer {
public:
  Changes(const Session& session, const ir::Uses& uses);

  void scanned(const Session& session) override;

  struct Scan {
    uint64_t number = 0;
    int64_t us = 0;
    bool operator==(const Scan&) const = default;
  };
  // The scan at which it was made.
  Scan begin() const { return begin_; }
  // The scan that has ended last.
  uint64_t scan() const { return scan_; }
  // For a session that has gone back, and counts on all the same: `scan` has ended last. The first one is for Changes
  // that have just been made, the other for a copy of what was known at that scan.
  void beginAt(const Session& session, uint64_t scan);
  void continueIn(const Session& session) { ahead_ = session.scans() - scan_; }
  // The last scan that ended with another value than the scan before; number 0: no change since the beginning. Nothing
  // for places that rungs do not use.
  std::optional<Scan> last(const runtime::Instance& instance, const ir::BitRange& place) const;
  // Whether a `set` has written the place since the last scan.
  bool pending(const runtime::Instance& instance, const ir::BitRange& place) const;

private:
  struct Span { // a range of the memory block
    uint32_t offset = 0;
    uint32_t size = 0;
    uint32_t copy = 0; // offset in copy_
  };
  // The times of scans of equal length: time(n) = us + (n - first) * step.
  struct Pace {
    uint64_t first = 0;
    int64_t us = 0;
    int64_t step = 0;
  };
  static void addPieces(const rung_program& program, const ir::BitRange& place, std::vector<Span>& pieces);
  void watch(const rung_program& program, const std::vector<ir::BitRange>& places);
  void compare(const Span& span, const uint8_t* now);
  void noteTime(uint64_t scan, int64_t us);
  int64_t timeOf(uint64_t scan) const;
  // Index of the bit in scans_; nothing if the bit is not watched.
  std::optional<size_t> indexOf(const runtime::Instance& instance, const ir::BitRange& place, uint32_t bit) const;

  std::vector<Span> spans_; // ascending by offset
  std::vector<uint8_t> copy_;
  std::vector<uint32_t> scans_; // scan of the last change, by bit of copy_
  std::vector<Pace> paces_;
  uint64_t scan_ = 0;
  uint64_t ahead_ = 0; // scans that the session has counted beyond these
  Scan begin_;
};

} // namespace rung::scenario
