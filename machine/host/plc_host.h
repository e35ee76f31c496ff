// A PLC program between HAL pins: all that the component does, without RTAPI. Everything is allocated when the host is
// made; `step` allocates nothing, takes no lock and makes no system call.
#pragma once
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "machine/host/binding.h"
#include "machine/host/commands.h"
#include "machine/host/function_queue.h"
#include "machine/host/mapping_file.h"
#include "machine/host/pins.h"
#include "machine/host/services.h"
#include "rtlib/run/clock.h"
#include "rung/runtime.hpp"

namespace rung::host {

enum class StepResult : uint8_t {
  Waiting, // no part of the schedule was due, or the program has stopped
  Ran,
  Failed, // a fault has stopped the program in this step
};

class PlcHost {
public:
  using NewInstance = std::function<Instance(const Image& image, const rung_instance_options& options)>;
  struct Options {
    std::string retain;                              // FILE of FILE.a and FILE.b; "": it starts cold
    NewInstance newInstance = {};                    // of a program that is not in a control alone
    runtime::Clock* clock = &runtime::systemClock(); // for all but steps; outlives the host
    uint32_t catchUp = 0;                            // as in rung_instance_options
    const char* reset = "pin reset rises";           // what restarts a program that has stopped, for people
  };
  // Null, and `errors` say why, when the map does not fit the program. Throws rung::Error where it does, but the
  // program cannot be switched on: another process has its retained memory. `warnings`, then, too: what the operator
  // should know of the retained memory.
  static std::unique_ptr<PlcHost> make(const Image& image, File map, const Options& options,
                                       std::vector<std::string>& errors, std::vector<std::string>& warnings);
  // A regular end, for the thread of the steps between two of them: begins it, and is asked again after each step.
  // True: the program needs no more of them, and has had them with fresh inputs. Nothing is restarted any more; a
  // restart that `serve` has begun is waited for.
  bool powerOffDone() noexcept;
  bool ending() const noexcept { return ending_; }                               // any thread
  bool ended() const noexcept { return ended_.load(std::memory_order_acquire); } // any thread
  // After the last step, or where none can come any more: the program's last scans run where they have not, output pins
  // have their safe values then, and what is retained is on disk; "" or why not.
  std::string close();

  const std::vector<Pin>& pins() const { return map_.pins; }
  // As many cells as there are pins, in their order; they outlive the host. They get the values that they begin with.
  void connect(const PinCell* cells, const PinAccess& access = kVariables) noexcept;

  // The clock of the thread advances by `ns`: what is due of the program's schedule runs on fresh inputs. A step that
  // runs nothing only watches for edges. After a fault all output pins have their safe values, until `reset` rises and
  // `serve` has restarted the program.
  StepResult step(int64_t ns, bool reset = false) noexcept;
  // The same for a host that runs the fast task in a place of its own, in the same thread: a slice that is due runs up
  // to the end of its fast task. Its rest is the next step's, which is given the time since.
  StepResult stepFast(int64_t ns, bool reset = false) noexcept;
  // The program is not run any more: output pins have their safe values.
  void clearPins() noexcept;
  // The scan thread: as they are at this moment. As many values as there are pins; nothing is read before `connect`.
  void lookAtPins(std::span<Value> values) const noexcept { pins_.look(values); }
  // How long the program may run in a step before that counts as a fault; 0: its budgets alone count.
  void setTimeLimit(int64_t ns) noexcept {
    constexpr int64_t kHour = 3'600'000'000'000; // more is none
    plc_.limit(std::min(ns, kHour));
  }
  // For the thread of the steps, between two of them: reads what a step reads of the program, as long as
  // CLOCK_MONOTONIC has not come to `untilNs`, so that the next one finds it in the processor's caches.
  void prefetch(int64_t untilNs) const noexcept {
    if (running()) plc_.prefetch(untilNs);
  }
  // Whether a restart after a fault may begin, before a step: it waits while the host still moves something.
  void setRestartable(bool is) noexcept { restartable_ = is; }
  // The thread of `serve`; the scan thread does it in its next step (see commands.h). While it waits, a restart that
  // the scan thread asks for is done.
  CommandResult post(Command& command, std::chrono::milliseconds time = kPatience);
  static constexpr std::chrono::milliseconds kPatience{1000};
  // One thread at a time, any. False: the program has shown nothing since.
  bool nextMessage(rung_message_info& message) const noexcept;
  // The program's next request to a CNC that a client serves (`live().served`), for one thread at a time. False: no
  // request waits.
  Live& live() noexcept { return live_; }
  bool nextRequest(rung_request& request) const noexcept;
  const Translation& translation() const noexcept { return translation_; } // of its requests
  void answer(const rung_reply& reply) const noexcept { rung_instance_answer(plc_.handle(), &reply); }
  rung_instance* instance() const noexcept { return plc_.handle(); }
  const File& map() const noexcept { return map_; }
  runtime::Clock& clock() const noexcept { return clock_; }
  // What is written into the program before every slice.
  struct Feed {
    std::string name;              // of the cell
    std::string by;                // "pin door" or "a constant of the mapping file"
    std::vector<std::string> bits; // pins of its bits, from the lowest one on
  };
  const std::vector<Feed>& feeds() const noexcept { return feeds_; }

  // What the map loses when the new program of a replacement takes over; not for the scan thread.
  struct Losses {
    std::vector<std::string> mistakes; // as at the start: the program does not take over
    std::vector<std::string>
        moved; // pins whose cells are elsewhere then, or gone: where that is not meant it does not either
    std::vector<rung_cell> dead; // inputs that no pin feeds any more
  };
  Losses lossesBy(const rung_replacement* replacement, const rung_program& next) const;
  // Of one that ran, with this map, already: it makes no mistakes.
  Losses lossesBy(const rung_replacement* replacement) const;

  // Not the scan thread, again and again: what a step must not do itself, a fault in words, and the restart after it.
  // True: there was something of that, and `reports` says what the operator should know of it.
  bool serve(std::vector<std::string>& reports);
  bool running() const noexcept { return state_.load(std::memory_order_acquire) == State::Running; }
  // `serve` has the program: nothing else may touch what belongs to it.
  bool restarting() const noexcept { return state_.load(std::memory_order_acquire) == State::Restarting; }

  // While it does not run, for the thread that serves it.
  std::optional<rung_fault_info> fault() const noexcept;
  // The line of the last fault; 0: none. Any thread.
  uint32_t faultLine() const noexcept { return faultLine_.load(std::memory_order_relaxed); }
  // Of the instance; while it runs, for the scan thread.
  rung_state state() const noexcept;
  bool failsToSave() const noexcept { return (state().flags & RUNG_STATE_UNSAVED) != 0; }
  const FunctionQueue& functions() const { return *functions_; }
  // How often `serve` has switched the program on again; its thread.
  uint32_t restarts() const noexcept { return restarts_; }
  // Why the last restart has failed; "" where it has not.
  const std::string& restartProblem() const noexcept { return restartProblem_; }

private:
  PlcHost(const Image& image, File map, const Options& options);

  // Stopped: by a fault. Restarting: the instance belongs to `serve`.
  enum class State : uint8_t { Running, Stopped, Restarting };

  template <class Link>
  void bind(const Link& link, Value& value, rung_direction direction, double scale);
  void bindValues();
  void beginWith(size_t link, bool first) noexcept;
  Value valueInProgram(const PinLink& link) noexcept;
  void setPins(const PinLink& link, const Value& value) noexcept;
  int32_t start(std::string& problem); // the status, and why it is none
  std::string stopText(const rung_fault_info& fault) const;
  void stop() noexcept;
  void reportFault();
  void reportSaving();
  void restart();
  bool beginStep(int64_t ns, bool reset) noexcept;
  StepResult run(int64_t ns, int32_t (*due)(rung_instance*, int64_t)) noexcept;
  void readPins() noexcept;
  void writePins() noexcept;
  CommandSlot::Outcome execute(Command& command) noexcept;
  int32_t executeRunning(Command& command) noexcept;
  int32_t replace(Command& command) noexcept;
  static void log(void* host, int32_t level, const char* text);
  static int32_t request(void* host, rung_instance* instance, const rung_request* request, rung_reply* reply);

  File map_;
  std::vector<std::string> logged_;
  Live live_;
  const Translation& translation_;
  rung_instance_options options_;
  Instance plc_;
  bool kept_; // there is a file for retained memory
  const char* const reset_;
  Binding binding_;
  std::vector<Value> values_, constants_;       // bound to the program; by binding_
  std::vector<size_t> toProgram_, fromProgram_; // links
  std::vector<Feed> feeds_;
  std::unique_ptr<FunctionQueue> functions_; // once the map is bound
  Pins pins_;
  CommandSlot commands_;
  runtime::Clock& clock_;
  bool wasReset_ = false;
  bool restartable_ = true;
  std::atomic<bool> ending_{false}; // `ends` was asked
  std::atomic<bool> ended_ = false;
  bool hasRun_ = false;     // a slice, since it was switched on: outputs are the program's
  bool sliceBegun_ = false; // by `stepFast`
  // The thread of `serve`.
  bool reported_ = false; // the fault that has stopped it
  std::string unsaved_;   // why retained memory was not saved, as it was reported; ""
  std::vector<std::string> reports_;
  uint32_t restarts_ = 0;
  std::string restartProblem_;
  runtime::Alone scans_;  // the thread of the steps
  runtime::Alone serves_; // the thread of `serve` and `command`
  std::atomic<uint32_t> faultLine_{0};
  std::atomic<State> state_{State::Running};
};

} // namespace rung::host
