// What a rung_instance is: the running program, the control of its dialect, and what its host has bound to it.
#pragma once
#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "rtlib/api/environment.h"
#include "rtlib/api/host_struct.h"
#include "rtlib/api/image.h"
#include "rtlib/api/watch.h"
#include "rtlib/core/handover.h"
#include "rtlib/nc/control/control.h"
#include "rtlib/run/instance.h"
#include "rtlib/run/pace.h"

namespace rung::api {

// A message that waits to be taken, and whose it is: that has its texts, and is referred to until then.
struct Said {
  rung_message message{};
  Generation* by = nullptr;
};

struct BoundVariable {
  rung_cell cell = 0;
  rung_host_type type = RUNG_HOST_BOOL;
  bool truth = false; // the cell takes whether the variable is 0
  // Of a bit-field: its lowest bit in the byte at the address, how many bits, in how many bytes; bits 0: it is none.
  uint8_t bit = 0, bits = 0, bytes = 0;
  void* address = nullptr;
  double scale = 1;
};

// The place of the environment in the schedule, with what the host wants to hear of it.
class Hooks final : public runtime::ScheduleHooks {
public:
  explicit Hooks(rung_instance& instance) : instance_(instance) {}
  void onHook(runtime::Instance& running, uint32_t work) override;
  uint32_t works() const override;
  void onFault(runtime::Instance& running) override;
  void onLatch(runtime::Instance& running, uint32_t task) override;
  bool respond(runtime::Instance& running, const core::ServiceRequest& request, core::ServiceReply& reply) override;

private:
  rung_instance& instance_;
};

} // namespace rung::api

struct rung_instance {
  rung_instance(std::shared_ptr<const rung::api::Image> program, const rung_instance_options& given,
                std::unique_ptr<rung::api::Environment> environment, bool controlAlone);
  ~rung_instance();

  // Process-image copies leave out what no rung accesses, until the host finds or binds something there. Environments
  // see all of the memory.
  void beginLeavingOut() noexcept {
    running.setNeededCopiesOnly(controlAlone && !running.neededCopies().leftOut.empty() && !seesLeftOut());
  }
  void bringInWhatIsSeen() noexcept {
    if (running.neededCopiesOnly() && seesLeftOut()) running.setNeededCopiesOnly(false);
  }
  bool seesLeftOut() const noexcept { return now().cells.seesLeftOut() || now().blockPlan.seesLeftOut(); }
  rung::api::Generation& now() const noexcept { return generations.now(); } // the program that runs

  uint32_t mark = rung::api::kInstanceMark;
  // The thread that is inside a call; 0: none.
  mutable std::atomic<uintptr_t> inside{0};

  rung_instance_options options;
  std::string dialect; // of all its programs
  std::unique_ptr<rung::api::Environment> environment;
  rung::nc::Control* control; // in `environment`
  bool controlAlone;          // there
  rung::api::ServiceNames serviceNames;
  rung::api::Hooks hooks;
  rung::runtime::Instance running;
  rung::runtime::Pace pace;
  rung::api::Generations generations;
  std::vector<rung::api::BoundVariable> inputs, outputs;
  rung::api::HostStructs structs;
  rung::api::Watches watches;
  rung::core::FixedRing<rung::api::Said, rung::core::kMessageCapacity> messages;
  rung::runtime::Outside outside;
  std::string keptFile;                           // "": nothing is kept
  std::unique_ptr<rung::nc::Retention> retention; // from the first power-on, where something is kept
  std::mutex retentionChanges;                    // held while that is made anew
  uint32_t functionChannels = 0;                  // a bit for each that a function was handed over in
  // The replacement that holds the program before this one: a fault puts that back.
  std::atomic<rung_replacement*> former{nullptr};
  rung::core::ScanUse puttingBack;
  // The program that a fault has stopped, where another one has taken its place since, and that fault; it is referred
  // to until the next power-on.
  std::atomic<rung::api::Generation*> faulted{nullptr};
  rung_fault fault{};
  rung_forces* forces = nullptr;             // in effect
  std::atomic<rung_shadow*> shadow{nullptr}; // that has begun
  bool on = false;
  bool faultReported = false; // to the host's callback
  bool wasOn = false;         // its memory holds something to be retained
  bool ending = false;        // its power-off has begun
  uint64_t lastScan = 0;      // and does not wait longer for the program than to that one
  uint64_t scans = 0;
  int64_t passNs = 0;
  int64_t lastPassNs = 0;
  int64_t worstPassNs = 0;
};

namespace rung::api {

// When a call is allowed.
enum class When : uint8_t {
  Always,  // in a callback of the same instance, too
  Outside, // of its callbacks
  On,      // outside, while the program is switched on
};

// One call of the host: the handle is good, and no other thread is inside.
class Call {
public:
  explicit Call(const rung_instance* handle, When when = When::Outside) noexcept;
  ~Call() {
    if (entered_) instance_->inside.store(0, std::memory_order_release);
  }
  Call(const Call&) = delete;
  Call& operator=(const Call&) = delete;

  bool ok() const noexcept { return status_ == RUNG_OK; }
  int32_t status() const noexcept { return status_; }
  rung_instance& operator*() const noexcept { return *instance_; }
  rung_instance* operator->() const noexcept { return instance_; }

private:
  rung_instance* instance_;
  bool entered_ = false;
  int32_t status_ = RUNG_OK;
};

// The same for what may be called at any time.
rung_instance* instanceOf(const rung_instance* handle) noexcept;
// This thread is inside a call for the instance.
bool isInCallback(const rung_instance& instance) noexcept;
int32_t failCallback() noexcept;

} // namespace rung::api
