// A PLC program between HAL pins: the complete work of the component, without RTAPI. Everything is allocated when the
// host is made; `step` allocates nothing, takes no lock and makes no system call.
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
#include <utility>
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
  Waiting, // no slice was due, or the program has stopped
  Ran,
  Failed, // a fault has stopped the program in this step
};

// Whether two descriptions are of one cell, whatever its names are.
inline bool isSamePlace(const rung_cell_info& a, const rung_cell_info& b) noexcept {
  return a.space == b.space && a.byte == b.byte && a.bit == b.bit && a.type == b.type;
}

// A report of a host to its operator.
struct Report {
  enum class Kind : uint8_t { Fault, Restart, Other };
  Kind kind = Kind::Other;
  std::string text;
  // Of a fault.
  uint32_t rung = 0; // as drawn, from 1; 0: none
  std::string file;  // "": unknown
  uint32_t line = 0; // 0: unknown
};

class PlcHost {
public:
  using NewInstance = std::function<Instance(const Image& image, const rung_instance_options& options)>;
  struct Options {
    // Retained memory is in FILE.a and FILE.b, and a recording in the folder FILE.recording unless the map has another
    // one; "": cold start.
    std::string retain = {};
    NewInstance newInstance = {};                    // makes instances; empty: without devices or a simulation
    runtime::Clock* clock = &runtime::systemClock(); // for everything but steps; must outlive the host
    uint32_t catchUp = 0;                            // as in rung_instance_options
    bool measure = false;                            // times of scans are in `state`
    const char* reset = "pin reset rises";           // how to restart a stopped program, for messages to users
  };
  // Returns null, with the reasons in `errors`, if the map does not fit the program. Throws rung::Error if the program
  // cannot be switched on because another process has its retained memory. `warnings` receives, in all cases, reports
  // about the retained memory for the operator.
  static std::unique_ptr<PlcHost> make(const Image& image, File map, const Options& options,
                                       std::vector<std::string>& errors, std::vector<std::string>& warnings);
  // Scan thread, between two steps: begins the regular power-off, and is called again after each step. Returns true
  // when the program needs no more steps and has run its last scans with fresh inputs. Nothing is restarted from then
  // on; a restart that `serve` has begun is waited for.
  bool powerOffDone() noexcept;
  bool ending() const noexcept { return ending_; }                               // any thread
  bool ended() const noexcept { return ended_.load(std::memory_order_acquire); } // any thread
  // To be called after the last step, or when no more steps can come: runs the program's last scans if they have not
  // run, sets output pins to their safe values, and writes retained memory to disk. Returns "", or why it could not be
  // written.
  std::string close();

  const std::vector<Pin>& pins() const { return map_.pins; }
  // `cells` has one cell per pin, in the order of the pins, and must outlive the host. The pins get their initial
  // values.
  void connect(const PinCell* cells, const PinAccess& access = kVariables) noexcept;

  // Scan thread: advances the program's time by `ns` and runs the slices that are due with fresh inputs. A step that
  // runs no slice only watches for edges. After a fault all output pins have their safe values until `reset` rises and
  // `serve` has restarted the program.
  StepResult step(int64_t ns, bool reset = false) noexcept;
  // Scan thread, for a host that calls the fast task separately: runs a slice that is due up to the end of its fast
  // task. The next `step` runs the rest of the slice, and is given the time since this call.
  StepResult stepFast(int64_t ns, bool reset = false) noexcept;
  // Sets output pins to their safe values, because the program no longer runs.
  void clearPins() noexcept;
  // Scan thread: reads the current values of the pins. `values` has one value per pin; nothing is read before
  // `connect`.
  void lookAtPins(std::span<Value> values) const noexcept { pins_.look(values); }
  // Scan thread: whether the program has another value than a pin of a bit gave it in the last slice, because the
  // simulated control, a force or a rung has written it since. `overwritten` has one entry per pin.
  void lookAtOverwritten(std::span<bool> overwritten) const noexcept;
  // Sets how long the program may run in one step; a longer run is a fault. 0: only the budgets apply.
  void setTimeLimit(int64_t ns) noexcept {
    constexpr int64_t kHour = 3'600'000'000'000; // the largest limit
    plc_.limit(std::min(ns, kHour));
  }
  // Scan thread, between two steps: reads the memory that a step uses until CLOCK_MONOTONIC reaches `untilNs`, so that
  // the next step finds it in the processor's caches.
  void prefetch(int64_t untilNs) const noexcept {
    if (running()) plc_.prefetch(untilNs);
  }
  // Scan thread, before a step: whether a restart after a fault may begin; it waits while the host still moves an axis.
  void setRestartable(bool is) noexcept { restartable_ = is; }
  // Service thread: posts a command, which the scan thread executes in its next step (commands.h). A restart that the
  // scan thread requests is done while this waits.
  CommandResult post(Command& command, std::chrono::milliseconds time = kPatience);
  static constexpr std::chrono::milliseconds kPatience{1000};
  // Any thread, one at a time. Returns false if there are no more messages of the program.
  bool nextMessage(rung_message_info& message) const noexcept;
  // The program's next request to a CNC that a client serves (`live().served`); any thread, one at a time. Returns
  // false if no request waits.
  Live& live() noexcept { return live_; }
  bool nextRequest(rung_request& request) const noexcept;
  const Translation& translation() const noexcept { return translation_; } // of the program's requests
  void answer(const rung_reply& reply) const noexcept { rung_instance_answer(plc_.handle(), &reply); }
  rung_instance* instance() const noexcept { return plc_.handle(); }
  const File& map() const noexcept { return map_; }
  runtime::Clock& clock() const noexcept { return clock_; }
  // A value that is written to the program before every slice.
  struct Feed {
    std::string name;              // name of the cell
    std::string by;                // the source: "pin door" or "a constant of the mapping file"
    std::vector<std::string> bits; // pins of the cell's bits, lowest first
  };
  const std::vector<Feed>& feeds() const noexcept { return feeds_; }

  // The entries of the map that no longer fit when the new program of a replacement takes over; not for the scan
  // thread.
  struct Losses {
    std::vector<std::string> mistakes; // errors as at the start: they prevent the replacement
    std::vector<std::string>
        moved; // pins whose cells have moved or no longer exist: they prevent the replacement unless that is intended
    std::vector<rung_cell> dead; // inputs that are no longer fed by a pin
  };
  Losses lossesBy(const rung_replacement* replacement, const rung_program& next) const;
  // The same for a program that has already run with this map and therefore causes no errors.
  Losses lossesBy(const rung_replacement* replacement) const;

  // Service thread, periodically: does the work that a step must not do itself: the text of a fault, and the restart
  // after it. Returns true if there was such work; `reports` receives the reports for the operator.
  bool serve(std::vector<Report>& reports);
  bool running() const noexcept { return state_.load(std::memory_order_acquire) == State::Running; }
  // `serve` is restarting the program: no other code may access the instance.
  bool restarting() const noexcept { return state_.load(std::memory_order_acquire) == State::Restarting; }

  // Service thread, while the program does not run.
  std::optional<rung_fault_info> fault() const noexcept;
  // The source line of the last fault; 0: none. Any thread.
  uint32_t faultLine() const noexcept { return faultLine_.load(std::memory_order_relaxed); }
  // The state of the instance; only for the scan thread while the program runs.
  rung_state state() const noexcept;
  bool failsToSave() const noexcept { return (state().flags & RUNG_STATE_UNSAVED) != 0; }
  const FunctionQueue& functions() const { return *functions_; }
  // Service thread: how often `serve` has switched the program on again.
  uint32_t restarts() const noexcept { return restarts_; }
  // Why the last restart failed; "": it did not.
  const std::string& restartProblem() const noexcept { return restartProblem_; }

private:
  PlcHost(const Image& image, File map, const Options& options);

  // Stopped: by a fault. Restarting: the instance belongs to `serve`.
  enum class State : uint8_t { Running, Stopped, Restarting };

  template <class Link>
  void bind(const Link& link, Value& value, rung_direction direction, double scale);
  void bindValues();
  std::string record();
  void beginWith(size_t link, bool first) noexcept;
  Value valueInProgram(const PinLink& link) noexcept;
  void setPins(const PinLink& link, const Value& value) noexcept;
  int32_t start(std::string& problem); // returns the status; `problem` gets the reason of a failure
  std::string stopText(const rung_fault_info& fault) const;
  void stop() noexcept;
  void reportFault();
  void reportSaving();
  void reportRecording();
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
  bool kept_;                         // retained memory has a file
  const std::string recordingFolder_; // "": nothing is recorded
  const char* const reset_;
  Binding binding_;
  std::vector<Value> values_, constants_;             // bound to the program; indexed as the entries of binding_
  std::vector<size_t> toProgram_, fromProgram_;       // indices of links
  std::vector<std::pair<size_t, rung_cell>> fedBits_; // links of bits that only pins feed, and their cells
  std::vector<Feed> feeds_;
  std::unique_ptr<FunctionQueue> functions_; // set once the map is bound
  Pins pins_;
  CommandSlot commands_;
  runtime::Clock& clock_;
  bool wasReset_ = false;
  bool restartable_ = true;
  std::atomic<bool> ending_{false}; // `powerOffDone` has been called
  std::atomic<bool> ended_ = false;
  bool hasRun_ = false;     // a slice has run since power-on, so outputs are the program's
  bool sliceBegun_ = false; // by `stepFast`
  // Service thread:
  bool reported_ = false;        // the fault that stopped the program has been reported
  std::string unsaved_;          // the reported reason why retained memory was not saved; "": none
  std::string recordingProblem_; // the same of the recording
  std::optional<int64_t> recordingLookedNs_;
  std::vector<Report> reports_;
  uint32_t restarts_ = 0;
  std::string restartProblem_;
  runtime::Alone scans_;  // only the scan thread
  runtime::Alone serves_; // only the thread of `serve` and `post`
  std::atomic<uint32_t> faultLine_{0};
  std::atomic<State> state_{State::Running};
};

} // namespace rung::host
