// A PLC program between HAL pins: all that LinuxCNC's component and rung-run have in common, without HAL itself. The
// constructor allocates everything; `step` allocates nothing, takes no lock and makes no system call. Two threads use a
// host: the scan thread, which calls the steps, and the service thread, which calls `serve` and `post`.
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
    std::string retain;                              // FILE of FILE.a and FILE.b; "": none, the program starts cold
    NewInstance newInstance = {};                    // creates the instance if the program has a simulated control
    runtime::Clock* clock = &runtime::systemClock(); // for everything except steps; outlives the host
    uint32_t catchUp = 0;                            // as in rung_instance_options
    const char* reset = "pin reset rises";           // what restarts a stopped program, in messages
  };
  // Null, and `errors` say why: the map does not fit the program. Throws rung::Error if it does, but the program cannot
  // be switched on because another process uses its retained memory. `warnings`: what the operator should know about
  // the retained memory.
  static std::unique_ptr<PlcHost> make(const Image& image, File map, const Options& options,
                                       std::vector<std::string>& errors, std::vector<std::string>& warnings);
  // Scan thread, between two steps: begins the regular end of the program, and is called again after each step. True:
  // the program needs no more steps, and has had its last ones with fresh inputs. No restart begins any more; one that
  // `serve` has begun is waited for.
  bool powerOffDone() noexcept;
  bool ending() const noexcept { return ending_; }                               // any thread
  bool ended() const noexcept { return ended_.load(std::memory_order_acquire); } // any thread
  // After the last step, or if no more steps are possible: runs the program's last scans, sets output pins to their
  // safe values, and saves the retained memory; "", or why that failed.
  std::string close();

  const std::vector<Pin>& pins() const { return map_.pins; }
  // Connects the pins with the host's cells: as many as there are pins, in the same order; they outlive the host, and
  // get the initial values.
  void connect(const PinCell* cells, const PinAccess& access = kVariables) noexcept;

  // Scan thread. The clock advances by `ns`: the part of the program's schedule that is due runs on fresh inputs. A
  // step in which nothing is due only watches for edges. After a fault all output pins have their safe values until
  // `reset` rises and `serve` has restarted the program.
  StepResult step(int64_t ns, bool reset = false) noexcept;
  // Scan thread. The same for a host that calls the fast task separately, in the same thread: runs a slice that is due
  // up to the end of its fast task. The next step runs the rest, and is given the time since then.
  StepResult stepFast(int64_t ns, bool reset = false) noexcept;
  // Sets output pins to their safe values, because the program is not run any more.
  void clearPins() noexcept;
  // Scan thread: the present values of all pins; `values` has as many elements as there are pins. Nothing is read
  // before `connect`.
  void lookAtPins(std::span<Value> values) const noexcept { pins_.look(values); }
  // The time that the program may run in a step without a fault; 0: only its budgets apply.
  void setTimeLimit(int64_t ns) noexcept {
    constexpr int64_t kHour = 3'600'000'000'000; // a longer limit has no effect
    rung_instance_limit(plc_.handle(), std::min(ns, kHour));
  }
  // Scan thread, between two steps: reads the data that a step of the program reads, until CLOCK_MONOTONIC reaches
  // `untilNs`, so that the next step finds it in the processor's caches.
  void prefetch(int64_t untilNs) const noexcept {
    if (running()) plc_.prefetch(untilNs);
  }
  // Scan thread, before a step: whether a restart after a fault may begin; it waits while the host still moves an axis.
  void setRestartable(bool is) noexcept { restartable_ = is; }
  // Service thread: the scan thread executes the command in its next step (see commands.h). While this waits, a restart
  // that the scan thread requests is carried out.
  CommandResult post(Command& command, std::chrono::milliseconds time = kPatience);
  static constexpr std::chrono::milliseconds kPatience{1000};
  // Any one thread at a time. False: no new message of the program.
  bool nextMessage(rung_message_info& message) const noexcept;
  // The program's requests to its CNC, if a client serves them (`live().served`). One thread at a time. False: no
  // request waits.
  Live& live() noexcept { return live_; }
  bool nextRequest(Request& request) const;
  void answer(const rung_reply& reply) const noexcept { rung_instance_answer(plc_.handle(), &reply); }
  rung_instance* instance() const noexcept { return plc_.handle(); }
  const File& map() const noexcept { return map_; }
  runtime::Clock& clock() const noexcept { return clock_; }
  // A value that is written into the program before every slice.
  struct Feed {
    std::string name;              // of the cell
    std::string by;                // "pin door" or "a constant of the mapping file"
    std::vector<std::string> bits; // pins of its bits, from the lowest one on
  };
  const std::vector<Feed>& feeds() const noexcept { return feeds_; }

  // The entries of the map that are affected when the new program of a replacement takes over. Not for the scan thread.
  struct Losses {
    std::vector<std::string> mistakes; // errors as at the start: the program cannot take over
    std::vector<std::string>
        moved; // pins whose cells are elsewhere then, or gone: where that is not meant it does not either
    std::vector<rung_cell> dead; // inputs that no longer have a pin
  };
  Losses lossesBy(const rung_replacement* replacement, const rung_program& next) const;
  // The same for a program that has already run with this map, and so has no errors.
  Losses lossesBy(const rung_replacement* replacement) const;

  // Service thread, repeatedly: the work that a step must not do itself, such as describing a fault and restarting the
  // program. True: there was such work, and `reports` says what the operator should know about it.
  bool serve(std::vector<std::string>& reports);
  bool running() const noexcept { return state_.load(std::memory_order_acquire) == State::Running; }
  // Whether `serve` is restarting the program: no other code may use what belongs to it.
  bool restarting() const noexcept { return state_.load(std::memory_order_acquire) == State::Restarting; }

  // Service thread, while the program does not run.
  std::optional<rung_fault_info> fault() const noexcept;
  // The source line of the last fault; 0: none. Any thread.
  uint32_t faultLine() const noexcept { return faultLine_.load(std::memory_order_relaxed); }
  // The state of the instance. Scan thread while the program runs.
  rung_state state() const noexcept;
  bool failsToSave() const noexcept { return (state().flags & RUNG_STATE_UNSAVED) != 0; }
  const FunctionQueue& functions() const { return *functions_; }
  // How often `serve` has restarted the program. Service thread.
  uint32_t restarts() const noexcept { return restarts_; }
  // Why the last restart has failed; "": it has not.
  const std::string& restartProblem() const noexcept { return restartProblem_; }

private:
  PlcHost(const Image& image, File map, const Options& options);

  // Stopped: by a fault. Restarting: the instance belongs to the service thread.
  enum class State : uint8_t { Running, Stopped, Restarting };

  template <class Link>
  void bind(const Link& link, Value& value, rung_direction direction, double scale);
  void bindValues();
  void beginWith(size_t link, bool first) noexcept;
  Value valueInProgram(const PinLink& link) noexcept;
  void setPins(const PinLink& link, const Value& value) noexcept;
  int32_t start(std::string& problem); // an error status and its reason, or RUNG_OK
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
  int32_t obeyRunning(Command& command) noexcept;
  int32_t replace(Command& command) noexcept;
  static void log(void* host, int32_t level, const char* text);
  static int32_t request(void* host, rung_instance* instance, const rung_request* request, rung_reply* reply);

  File map_;
  std::vector<std::string> logged_;
  Live live_;
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
  std::atomic<bool> ending_{false}; // powerOffDone was called
  std::atomic<bool> ended_ = false;
  bool hasRun_ = false;     // a slice since the power-on: outputs are the program's
  bool sliceBegun_ = false; // by `stepFast`
  // Service thread.
  bool reported_ = false; // the present fault was reported
  std::string unsaved_;   // the last reported reason why retained memory was not saved; "": it was
  std::vector<std::string> reports_;
  uint32_t restarts_ = 0;
  std::string restartProblem_;
  runtime::Alone scans_;  // scan thread
  runtime::Alone serves_; // service thread
  std::atomic<uint32_t> faultLine_{0};
  std::atomic<State> state_{State::Running};
};

} // namespace rung::host
