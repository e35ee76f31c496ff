// Commands from another thread to the scan thread, which executes them between two slices. The slot holds one command
// at a time; neither thread blocks the other.
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
    State,   // returns the state of the instance and of functions
    Write,   // writes `value` to `cell`; returns the previous value and the instance's state
    Forced,  // returns force number `index` of the active forces
    Force,   // activates `forces`; null: releases all forces
    Replace, // starts the program of `replacement`; returns the instance's state
    Shadow,  // begins `shadow`; null: ends the current one
    Stop,
    Start,
    Restart, // after a fault
    Act,     // calls `act` with `actor`
    Profile, // copies up to `count` counters, of rungs from `index` on, to `profiles`; `count`: number of rungs
    ClearProfile,
  };
  Kind kind = Kind::State;
  rung_cell cell = 0;
  rung_value value{};
  uint32_t index = 0;
  uint32_t count = 0;
  rung_forces* forces = nullptr;
  rung_replacement* replacement = nullptr;
  const std::vector<rung_cell>* dead =
      nullptr; // for Replace: inputs of the running program that become 0; belongs to the caller
  rung_shadow* shadow = nullptr;
  void (*act)(void* actor) = nullptr;
  void* actor = nullptr;
  rung_profile* profiles = nullptr; // belongs to the caller
  // Results.
  rung_value former{};
  rung_state state{};
  FunctionState functions;
  rung_force_info force{};
};

// The result of a command.
struct CommandResult {
  int32_t status = RUNG_OK; // enum rung_status; RUNG_FAILED also if no thread scans the program
  std::string problem;      // a sentence, if the command was not executed
  bool ok() const { return status == RUNG_OK || status == RUNG_EMPTY; }
};

class CommandSlot {
public:
  // The status of a command, and a sentence if it was not executed.
  struct Outcome {
    int32_t status = RUNG_OK;
    const char* problem = ""; // valid until the result is copied
  };

  // Any thread except the scan thread; callers may wait here for each other. Posts a command and waits for its results,
  // which are stored in `command`. The scan thread retries a command that it cannot execute yet (RUNG_LATER) until the
  // time is over; the command is then withdrawn and has had no effect. `meanwhile` is called between two checks, for
  // work that must not wait.
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

  // Scan thread, between two slices: `execute` carries out the command and returns an Outcome.
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
