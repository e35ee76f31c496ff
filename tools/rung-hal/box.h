// A PLC program between HAL pins: all that the component does, without RTAPI. Everything is allocated when the box is
// made; `step` allocates nothing, takes no lock and makes no system call.
#pragma once
#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "rtlib/core/place_list.h"
#include "rtlib/host/instance.h"
#include "rtlib/host/pace.h"
#include "rtlib/host/realtime.h"
#include "rtlib/nc/control/control.h"
#include "rtlib/nc/control/retention.h"
#include "tools/rung-hal/binding.h"
#include "tools/rung-hal/function_queue.h"
#include "tools/rung-hal/map_file.h"
#include "tools/rung-hal/pin_cell.h"

namespace rung::hal {

enum class StepResult : uint8_t {
  Waiting, // no part of the schedule was due, or the program has stopped
  Ran,
  Failed, // a fault has stopped the program in this step
};

// Takes a message of the program in the scan.
using MessageSink = void (*)(const nc::Control& control, const rung_program& program, const rung_message& message);

class Box {
public:
  // Null, and `errors` say why, when the map does not fit the program, which outlives the box. The start is cold, or
  // with the memory that `retain` (FILE of FILE.a and FILE.b) keeps. `warnings`: what the operator should know of the
  // retained memory.
  static std::unique_ptr<Box> make(const rung_program& program, MapFile map, std::vector<std::string>& errors,
                                   const std::string& retain, std::vector<std::string>& warnings);
  // After the last step, or where none can come any more: the program's last scans run, output pins are 0 then, and
  // what is retained is on disk; "" or why not.
  std::string close();

  const std::vector<MapPin>& pins() const { return map_.pins; }
  // As many cells as there are pins, in their order; they outlive the box.
  void connect(const PinCell* cells) { cells_ = cells; }
  void setMessageSink(MessageSink sink) { sink_ = sink; }

  // The clock of the thread advances by `ns`: what is due of the program's schedule runs on fresh inputs. A step that
  // runs nothing only watches for edges. After a fault all output pins are 0, until `reset` rises and `serve` has
  // restarted the program.
  StepResult step(int64_t ns, bool reset = false) noexcept;
  // How long the program may run in a step before that counts as a fault; 0: its budgets alone count.
  void setTimeLimit(int64_t ns) noexcept { instance_.setTimeLimit({.ns = ns, .nowNs = &host::monotonicNs}); }
  // Not the scan thread, again and again: what a step must not do itself, the restart after a fault. True: it has been
  // tried, and `reports` says what the operator should know of it.
  bool serve(std::vector<std::string>& reports);
  bool running() const noexcept { return state_.load(std::memory_order_acquire) == State::Running; }

  const rung_program& program() const { return instance_.program(); }
  const rung_fault& fault() const { return instance_.fault(); }
  uint32_t scans() const { return scans_; }          // passes of the schedule
  uint64_t missed() const { return pace_.missed(); } // passes that were left out
  const FunctionQueue& functions() const { return *functions_; }
  // Of the retained memory; null: nothing is kept.
  const host::RetainedMemory* retained() const { return retained_ ? &retained_->memory() : nullptr; }

private:
  Box(const rung_program& program, MapFile map, std::string retain);

  // Stopped: by a fault. Restarting: the instance belongs to `serve`.
  enum class State : uint8_t { Running, Stopped, Restarting };

  bool start(std::vector<std::string>& errors, std::vector<std::string>& warnings);
  void lastScans() noexcept;
  void slice() noexcept;
  void locatePlaces();
  void readPins() noexcept;
  void writePins() noexcept;
  void clearPins() noexcept;
  void passMessages() noexcept;

  MapFile map_;
  std::string retain_; // the file, or ""
  std::unique_ptr<nc::Control> control_;
  host::Instance instance_;
  host::Pace pace_;
  Binding binding_;
  std::vector<rt::ListedPlace> inputs_, outputs_; // of binding_; its constants follow the inputs
  std::vector<uint64_t> inputValues_, outputValues_;
  std::unique_ptr<FunctionQueue> functions_; // once the map is bound
  std::unique_ptr<nc::Retention> retained_;  // null: nothing is kept
  const PinCell* cells_ = nullptr;
  MessageSink sink_ = nullptr;
  uint32_t scans_ = 0;
  bool wasReset_ = false;
  std::atomic<State> state_{State::Running};
};

} // namespace rung::hal
