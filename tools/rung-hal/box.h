// A PLC program between HAL pins: all that the component does, without RTAPI. Everything is allocated when the box is
// made; `step` allocates nothing, takes no lock and makes no system call.
#pragma once
#include <algorithm>
#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "rung/runtime.hpp"
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
using MessageSink = void (*)(const rung_message_info& message);

class Box {
public:
  // Null, and `errors` say why, when the map does not fit the program. The start is cold, or with the memory that
  // `retain` (FILE of FILE.a and FILE.b) keeps. `warnings`: what the operator should know of the retained memory.
  static std::unique_ptr<Box> make(const Image& image, MapFile map, std::vector<std::string>& errors,
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
  void setTimeLimit(int64_t ns) noexcept {
    constexpr int64_t kHour = 3'600'000'000'000; // more is none
    rung_instance_limit(plc_.handle(), std::min(ns, kHour));
  }
  // Not the scan thread, again and again: what a step must not do itself, a fault in words, and the restart after it.
  // True: there was something of that, and `reports` says what the operator should know of it.
  bool serve(std::vector<std::string>& reports);
  bool running() const noexcept { return state_.load(std::memory_order_acquire) == State::Running; }

  // While it does not run, for the thread that serves it.
  std::optional<rung_fault_info> fault() const noexcept;
  // The line of the last fault that `serve` has reported; 0: none.
  uint32_t faultLine() const noexcept { return faultLine_.load(std::memory_order_relaxed); }
  // Of the instance; while it runs, for the scan thread.
  rung_state state() const noexcept;
  bool failsToSave() const noexcept { return (state().flags & RUNG_STATE_UNSAVED) != 0; }
  const FunctionQueue& functions() const { return *functions_; }

private:
  Box(const Image& image, MapFile map, const std::string& retain);

  // Stopped: by a fault. Restarting: the instance belongs to `serve`.
  enum class State : uint8_t { Running, Stopped, Restarting };

  template <class Link>
  void bind(const Link& link, Value& value, rung_direction direction, double scale);
  void bindValues();
  bool start(std::vector<std::string>& reports);
  StepResult run(int64_t ns) noexcept;
  void readPins() noexcept;
  void writePins() noexcept;
  void clearPins() noexcept;
  void passMessages() noexcept;
  static void log(void* box, int32_t level, const char* text);

  MapFile map_;
  std::vector<std::string> logged_;
  rung_instance_options options_;
  Instance plc_;
  bool kept_; // there is a file for retained memory
  Binding binding_;
  std::vector<Value> inputs_, outputs_, constants_; // bound to the program; by binding_
  std::unique_ptr<FunctionQueue> functions_;        // once the map is bound
  const PinCell* cells_ = nullptr;
  MessageSink sink_ = nullptr;
  bool wasReset_ = false;
  bool reported_ = false; // the fault that has stopped it: by `serve`
  std::atomic<uint32_t> faultLine_{0};
  std::atomic<State> state_{State::Running};
};

} // namespace rung::hal
