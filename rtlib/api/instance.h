// The instance handle of the C library: the running program, the control of its dialect, and everything that the host
// has bound to it.
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
#include "rtlib/api/recording.h"
#include "rtlib/api/watch.h"
#include "rtlib/core/handover.h"
#include "rtlib/nc/control/control.h"
#include "rtlib/run/instance.h"
#include "rtlib/run/pace.h"

namespace rung::api {

// A message that waits for the host, and the generation that sent it, which has its text and is kept until the host
// takes the message.
struct Said {
  rung_message message{};
  Generation* by = nullptr;
};

struct BoundVariable {
  rung_cell cell = 0;
  rung_host_type type = RUNG_HOST_BOOL;
  bool truth = false; // the cell is a bit: 0 if the variable is 0, else 1
  // Of a bit-field: its lowest bit in the byte at `address`, its number of bits, and the bytes that they occupy. bits
  // 0: the variable is not a bit-field.
  uint8_t bit = 0, bits = 0, bytes = 0;
  void* address = nullptr;
  double scale = 1;
};

// Passes the hooks of the schedule to the environment, and reports requests and faults to the host. Scan thread.
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

  // Process-image copies leave out bytes that no rung accesses, until the host looks up a cell or binds a variable
  // there. An environment other than the control alone sees the whole memory, so nothing is left out.
  void beginLeavingOut() noexcept {
    running.setNeededCopiesOnly(controlAlone && !running.neededCopies().leftOut.empty() && !seesLeftOut());
  }
  void bringInWhatIsSeen() noexcept {
    if (running.neededCopiesOnly() && seesLeftOut()) running.setNeededCopiesOnly(false);
  }
  bool seesLeftOut() const noexcept { return now().cells.seesLeftOut() || now().blockPlan.seesLeftOut(); }
  rung::api::Generation& now() const noexcept { return generations.now(); } // the running program

  uint32_t mark = rung::api::kInstanceMark;
  // The thread that is executing a call of the library; 0: none.
  mutable std::atomic<uintptr_t> inside{0};

  rung_instance_options options;
  std::string dialect; // the same for all its programs
  std::unique_ptr<rung::api::Environment> environment;
  rung::nc::Control* control; // owned by `environment`
  bool controlAlone;          // the environment is the control without a simulation
  rung::api::ServiceNames serviceNames;
  rung::api::Hooks hooks;
  rung::runtime::Instance running;
  rung::runtime::Pace pace;
  rung::api::Generations generations;
  std::vector<rung::api::BoundVariable> inputs, outputs;
  rung::api::HostStructs structs;
  rung::api::Watches watches;
  std::vector<rung::api::Configured> configured;           // so far
  std::unique_ptr<rung::api::HostRecorder> recorder;       // null: what the host does is not recorded
  std::unique_ptr<rung::api::InstanceRecording> recording; // null: nothing is recorded
  rung::core::FixedRing<rung::api::Said, rung::core::kMessageCapacity> messages;
  rung::runtime::Outside outside;
  std::string retainFile;                         // base path of the retained memory; "": it is not stored
  std::unique_ptr<rung::nc::Retention> retention; // made at the first power-on if retained memory is stored
  std::mutex retentionChanges;                    // held while `retention` is replaced
  uint32_t functionChannels = 0;                  // a bit for each channel in which a function was started
  // The replacement that holds the former program, which a fault puts back; null: none.
  std::atomic<rung_replacement*> former{nullptr};
  rung::core::ScanUse puttingBack;
  // The program that a fault stopped and that the former program has replaced since, and its fault. It is kept until
  // the next power-on.
  std::atomic<rung::api::Generation*> faulted{nullptr};
  rung_fault fault{};
  rung_forces* forces = nullptr;             // the active forces
  std::atomic<rung_shadow*> shadow{nullptr}; // the running shadow
  bool on = false;
  bool faultReported = false; // to the host's callback
  bool wasOn = false;         // its memory holds contents to be retained
  bool ending = false;        // its power-off has begun
  uint64_t lastScan = 0;      // while ending: the scan at which the power goes off even if the program is not done
  uint64_t scans = 0;
  int64_t passNs = 0;
  int64_t lastPassNs = 0;
  int64_t worstPassNs = 0;
};

namespace rung::api {

// When a call is allowed.
enum class When : uint8_t {
  Always,  // also from a callback of the same instance
  Outside, // not from its callbacks
  On,      // not from its callbacks, and only while the program is switched on
};

// One call of the host: checks that the handle is valid and that no other thread is executing a call for this instance.
// Any thread.
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

// The instance of a valid handle, else null, with an error: for functions that any thread may call at any time.
rung_instance* instanceOf(const rung_instance* handle) noexcept;
// Whether this thread is executing a call for the instance, so that the caller is one of its callbacks.
bool isInCallback(const rung_instance& instance) noexcept;
int32_t failCallback() noexcept;

} // namespace rung::api
