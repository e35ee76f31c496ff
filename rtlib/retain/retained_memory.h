// The retained memory that another program has left: the cells of this one are found there by name and by address, as
// when it takes over from a running one.
#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rtlib/change/state_transfer.h"
#include "rtlib/retain/retain.h"
#include "rtlib/run/clock.h"

namespace rung::runtime {

// `initial` and the result are images of the description `now`, `image` is one of `former`. What `former` does not have
// is as in `initial`.
struct RetainedTaken {
  bool good = false; // a description is none, the dialect is another, or an image has another size
  std::vector<uint8_t> image;
  std::vector<StateChange> changes;
  std::string otherDialect; // of `former`, where that is why; else ""
};
RetainedTaken takeRetained(std::string_view now, std::string_view former, std::span<const uint8_t> image,
                           std::span<const uint8_t> initial);

// The image of another program, as it was found, becomes one of this program, whose map that is; or stays not found.
// The report says what becomes of the cells.
using RetainTake = void (*)(const rung_program& program, const RetainMap& map, RetainImage& image);
void takeRetainedOf(const rung_program& program, const RetainMap& map, RetainImage& image);

// The retained memory of a running program on disk, as a host uses it: taken at the start, saved while the program
// runs, and at its end. Files: FILE.a and FILE.b (see retain.h), by the dialect's addresses (see retained_cells.h);
// what another program has left there, by name and address (RetainTake).
//
// Only whole scans are saved: what a fault leaves of the scan that it stopped never reaches the disk.

enum class RetainWhen : uint8_t {
  Always,    // after every scan
  OnRequest, // when the program asks for it, and at the end
};

class RetainedMemory {
public:
  // `take`: null where a machine's program never changes. Then an image of another one is not taken, and the host is
  // smaller.
  RetainedMemory(const rung_program& program, const std::string& file, RetainWhen when = RetainWhen::Always,
                 RetainTake take = &takeRetainedOf, const Outside& outside = {});
  // The saver looks once a `period` whether there is something to write.
  RetainedMemory(const rung_program& program, const std::string& file, RetainWhen when, RetainTake take,
                 std::chrono::milliseconds period, Disk& disk = systemDisk());

  // Before the program's warm start; false: nothing could be taken, and it starts cold. `report` is a message for the
  // user, "" when this is the first start. From then on no other process can use the files. The first image is written
  // at once, so that a place that cannot be written shows: then `error` says why.
  bool load(Instance& instance, std::string& report, std::string& error);
  // There was an image, and `load` could not take it, not even that of another program.
  bool lost() const noexcept { return lost_; }

  // Scan thread, after every slice: copies what is to be saved, never waits and allocates nothing. `asked`: the program
  // asks for it. True, once for each request: what was copied after it began is on disk.
  bool offer(const Instance& instance, bool asked) noexcept;

  // Scan thread: another program has taken over, of which `channel` is; it gets that of the former program, which must
  // not end before `settle` has returned. A request of the former program is asked again by the new one.
  void programChanged(std::unique_ptr<RetainChannel>& channel) noexcept {
    saver_->swapChannel(channel);
    request_ = 0;
  }
  void settle() { saver_->settle(); }

  // Any thread, without a lock: see RetainSaver.
  bool failing() const noexcept { return saver_->failing(); }
  uint64_t saved() const noexcept { return saver_->saved(); }
  uint64_t failed() const noexcept { return saver_->failed(); }
  size_t problem(std::span<char> to) const noexcept { return saver_->problem(to); }

  // Not in a scan: waits until what was offered is on disk or was tried; false: it is not, and `problem` says why.
  bool flush() { return saver_->flush(); }
  void look() noexcept { saver_->look(); }
  void abandon() noexcept { saver_->abandon(); }
  std::string problem() const { return saver_->problem(); }

  // After the last scan: the image of now, of the last whole scan after a fault, is on disk when it returns; "" or why
  // it is not.
  std::string finish(const Instance& instance);

private:
  RetainMap map_;
  RetainWhen when_;
  RetainTake take_;
  std::unique_ptr<RetainStore> store_; // until load has handed it to the saver
  std::chrono::milliseconds period_;
  std::unique_ptr<RetainSaver> saver_;
  bool lost_ = false;
  uint64_t request_ = 0; // ticket of what the program has asked for; 0: it does not ask
};

} // namespace rung::runtime
