// The rung_instance of the C API: the running program, the control of its dialect, and what the host has bound to it.
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

// A message that waits for the host, and the generation that sent it: that has its texts, and is referred to until the
// message is taken.
struct Said {
  rung_message message{};
  Generation* by = nullptr;
};

struct BoundVariable {
  rung_cell cell = 0;
  rung_host_type type = RUNG_HOST_BOOL;
  bool truth = false; // the cell gets 0 or 1: whether the variable is not 0
  // For a bit-field: its lowest bit in the byte at the address, the number of its bits, and of the bytes that contain
  // them; bits 0: not a bit-field.
  uint8_t bit = 0, bits = 0, bytes = 0;
  void* address = nullptr;
  double scale = 1;
};

// Connects the environment with the schedule, and reports to the host's callbacks.
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

  // Process-image copies leave out bytes that no rung touches, until the host looks up or binds something there. A
  // simulated environment sees all of the memory.
  void beginLeavingOut() noexcept {
    running.setNeededCopiesOnly(controlAlone && !running.neededCopies().leftOut.empty() && !seesLeftOut());
  }
  void bringInWhatIsSeen() noexcept {
    if (running.neededCopiesOnly() && seesLeftOut()) running.setNeededCopiesOnly(false);
  }
  bool seesLeftOut() const noexcept { return now().cells.seesLeftOut() || now().blockPlan.seesLeftOut(); }
  rung::api::Generation& now() const noexcept { return generations.now(); } // the running program

  uint32_t mark = rung::api::kInstanceMark;
  // The thread that is inside a call of the API; 0: none.
  mutable std::atomic<uintptr_t> inside{0};

  rung_instance_options options;
  std::string dialect; // of all its programs
  std::unique_ptr<rung::api::Environment> environment;
  rung::nc::Control* control; // part of `environment`
  bool controlAlone;          // `environment` is the control without a simulation
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
  std::mutex retentionChanges;                    // held while `retention` is replaced
  uint32_t functionChannels = 0;                  // channels in which a function was passed to the program, a bit each
  // The replacement that holds the former program: a fault puts that program back.
  std::atomic<rung_replacement*> former{nullptr};
  rung::api::ScanUse puttingBack;
  // The program that a fault has stopped, if another one has taken its place since, and that fault; referred to until
  // the next power-on.
  std::atomic<rung::api::Generation*> faulted{nullptr};
  rung_fault fault{};
  rung_forces* forces = nullptr;             // in effect
  std::atomic<rung_shadow*> shadow{nullptr}; // the one that has begun
  bool on = false;
  bool faultReported = false; // to the host's callback
  bool wasOn = false;         // its memory has contents to be retained
  bool ending = false;        // its power-off has begun
  uint64_t lastPass = 0;      // number of the last scan that the power-off waits for
  uint64_t passes = 0;
  int64_t passNs = 0;
  int64_t lastPassNs = 0;
  int64_t worstPassNs = 0;
};

namespace rung::api {

// When a call is allowed.
enum class When : uint8_t {
  Always,  // also in a callback of the same instance
  Outside, // not in a callback of the instance
  On,      // not in a callback, and only while the program is switched on
};

// One call of the API by the host: checks that the handle is valid and that no other thread is inside.
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

// The instance of a handle, for functions that may be called at any time; null: the handle is not valid.
rung_instance* instanceOf(const rung_instance* handle) noexcept;
// Whether the calling thread is inside a call for the instance.
bool isInCallback(const rung_instance& instance) noexcept;
int32_t failCallback() noexcept;

} // namespace rung::api
