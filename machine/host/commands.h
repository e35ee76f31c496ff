// What another thread asks of the thread that scans a program, which does it between two slices.
#pragma once
#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include "machine/host/function_queue.h"
#include "rtlib/core/handover.h"
#include "rtlib/run/clock.h"
#include "rung/runtime.h"

namespace rung::host {

struct Command {
  enum class Kind : uint8_t {
    State,   // the instance's state, and that of functions
    Write,   // `value` into `cell`; `former` is what was there, `state` the instance's state then
    Forced,  // the force in effect number `index`
    Force,   // `forces` are in effect from now on; null: none
    Replace, // by the program of `replacement`; the instance's state then
    Shadow,  // `shadow` begins; null: it ends
    Stop,
    Start,
    Restart, // after a fault
    Act,     // `act` does it, with `actor`
    Profile, // the counters of the rungs from `index` on, `count` of them at most, into `profiles`; `count`: of how
             // many
    ClearProfile,
  };
  Kind kind = Kind::State;
  rung_cell cell = 0;
  rung_value value{};
  uint32_t index = 0;
  uint32_t count = 0;
  rung_forces* forces = nullptr;
  rung_replacement* replacement = nullptr;
  const std::vector<rung_cell>* dead = nullptr; // with that: inputs of the running program that become 0; the caller's
  rung_shadow* shadow = nullptr;
  void (*act)(void* actor) = nullptr;
  void* actor = nullptr;
  rung_profile* profiles = nullptr; // the caller's
  // Results.
  rung_value former{};
  rung_state state{};
  FunctionState functions;
  rung_force_info force{};
};

// What became of a command.
struct CommandResult {
  int32_t status = RUNG_OK; // enum rung_status; RUNG_FAILED also where nobody scans
  std::string problem;      // a sentence, unless it is done
  bool ok() const { return status == RUNG_OK || status == RUNG_EMPTY; }
};

class CommandSlot {
public:
  // The status of a command, and the sentence that goes with it, where it is not done.
  struct Outcome {
    int32_t status = RUNG_OK;
    const char* problem = ""; // until the command is answered
  };

  // For all threads but the scan's, which may wait here for each other. Results are in `command`. What the scan thread
  // cannot do now it tries again, until the time is over: then the command is withdrawn, and has done nothing. Between
  // two looks, `meanwhile` does what others may wait for.
  template <class Meanwhile>
  CommandResult give(Command& command, std::chrono::nanoseconds time, runtime::Clock& clock, Meanwhile meanwhile) {
    constexpr int64_t kLookNs = 200'000;
    const std::lock_guard lock(giving_);
    slot_.post({.command = command});
    for (const int64_t end = clock.nowNs() + time.count(); !slot_.isDone() && clock.nowNs() < end;) {
      clock.sleep(kLookNs);
      meanwhile();
    }
    return take(command);
  }

  // The scan thread, between two slices: `execute` does the command and gives an Outcome.
  template <class Execute>
  void take(Execute execute) noexcept {
    slot_.take([&](Posted& posted) {
      posted.keep(execute(posted.command));
      return posted.status != RUNG_LATER;
    });
  }

private:
  struct Posted {
    void keep(const Outcome& outcome) noexcept;

    Command command;
    int32_t status = RUNG_OK;
    char problem[512] = "";
  };
  CommandResult take(Command& command);

  std::mutex giving_;
  core::Slot<Posted> slot_;
};

} // namespace rung::host
