// Takes over the retained memory of another program: the cells of this program are found in it by name and by address,
// as in a replacement.
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

// `initial` and the result are images of the description `now`; `image` is one of `former`. Cells that `former` does
// not have are as in `initial`.
struct RetainedTaken {
  bool good = false; // false: a description is not readable, the dialects differ, or an image has another size
  std::vector<uint8_t> image;
  std::vector<StateChange> changes;
  std::string otherDialect; // the dialect of `former`, if that is the reason; else ""
};
RetainedTaken takeRetained(std::string_view now, std::string_view former, std::span<const uint8_t> image,
                           std::span<const uint8_t> initial, const Naming& naming = {});

// Converts the image of another program, as it was found, into one of this program, whose map is given; `found` stays
// false if that fails. The report says what happens to the cells.
using RetainTake = void (*)(const rung_program& program, const RetainMap& map, RetainImage& image,
                            const Naming& naming);
void takeRetainedOf(const rung_program& program, const RetainMap& map, RetainImage& image, const Naming& naming);

// The retained memory of a running program on disk, as a host uses it: loaded at the start, saved while the program
// runs and at its end. The files FILE.a and FILE.b (see retain.h) are ordered by the dialect's addresses (RetainMap);
// contents of another program are taken by name and address (takeRetained).
//
// Only whole scans are saved: the contents of a scan that a fault has interrupted never reach the disk.

enum class RetainWhen : uint8_t {
  Always,    // after every scan
  OnRequest, // when the program requests it, and at the end
};

class RetainedMemory {
public:
  // `take`: null for a machine whose program never changes; then an image of another program is not taken, and the host
  // is smaller. `naming`: of the program's dialect.
  RetainedMemory(const rung_program& program, const std::string& file, RetainWhen when = RetainWhen::Always,
                 RetainTake take = &takeRetainedOf, const Outside& outside = {}, const Naming& naming = {});
  // The saver checks once per `period` whether there is something to write.
  RetainedMemory(const rung_program& program, const std::string& file, RetainWhen when, RetainTake take,
                 std::chrono::milliseconds period, Disk& disk = systemDisk(), const Naming& naming = {});

  // Call before the program's warm start. False: nothing could be taken, and the program starts cold. `report` is a
  // message for the user; "": this is the first start. From then on no other process can use the files. The first image
  // is written at once, so that an unwritable place is noticed: then `error` says why.
  bool load(Instance& instance, std::string& report, std::string& error);
  // Whether there was an image which `load` could not take, not even as that of another program.
  bool lost() const noexcept { return lost_; }

  // Scan thread, after every slice: copies the bytes to be saved; never waits, and allocates nothing. `asked`: the
  // program requests saving. True, once for each request: the bytes copied after the request are on disk.
  bool offer(const Instance& instance, bool asked) noexcept;

  // Scan thread, after another program has taken over: `channel` is that program's, and receives the former one, which
  // must exist until `settle` has returned. A pending request of the former program is made again for the new one.
  void programChanged(std::unique_ptr<RetainChannel>& channel) noexcept {
    saver_->swapChannel(channel);
    request_ = 0;
  }
  void settle() { saver_->settle(); }

  // Any thread, without a lock; see RetainSaver.
  bool failing() const noexcept { return saver_->failing(); }
  uint64_t saved() const noexcept { return saver_->saved(); }
  uint64_t failed() const noexcept { return saver_->failed(); }
  size_t problem(std::span<char> to) const noexcept { return saver_->problem(to); }

  // Not in a scan: waits until the last offer is on disk or the attempt has failed. False: it failed, and `problem`
  // says why.
  bool flush() { return saver_->flush(); }
  void look() noexcept { saver_->look(); }
  void abandon() noexcept { saver_->abandon(); }
  std::string problem() const { return saver_->problem(); }

  // After the last scan: saves the present image (after a fault, that of the last whole scan) before it returns. "", or
  // why it could not be saved.
  std::string finish(const Instance& instance);

private:
  RetainMap map_;
  RetainWhen when_;
  RetainTake take_;
  Naming naming_;
  std::unique_ptr<RetainStore> store_; // until `load` passes it to the saver
  std::chrono::milliseconds period_;
  std::unique_ptr<RetainSaver> saver_;
  bool lost_ = false;
  uint64_t request_ = 0; // ticket of the program's request; 0: none
};

} // namespace rung::runtime
