// What happened to the state when a program replaced another, in words.
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/code_maker.h"
#include "rtlib/change/state_transfer.h"
#include "rtlib/load/engine.h"
#include "rung/runtime.hpp"
#include "sim/machine.h"
#include "tools/scenario/recorded_nc.h"
#include "tools/scenario/requests.h"

namespace rung::scenario {

// Precedes the key of state that the compiler made, where a name would mean a cell.
inline constexpr std::string_view kStateWord = "state";

std::optional<runtime::ChangeKind> changeKindFromName(std::string_view name);
// "moved COUNT", "renamed LAMP BEACON", "new state MAIN/TMR": as expect_change writes it.
std::string textOf(const runtime::StateChange& change);

struct ReplaceReport {
  ReplaceReport() = default;
  explicit ReplaceReport(const rung::Replacement& replacement);

  uint32_t keptCells = 0;
  uint32_t keptStates = 0;
  std::string bound;                         // rung_replacement_info::bound
  std::vector<runtime::StateChange> changes; // changes that no statement has taken yet

  // Removes the change from `changes`; "" or which changes there are instead.
  std::string take(const runtime::StateChange& change);
  // "" or the changes that remain.
  std::string expectNone() const;
  // A line for each change of state, and the longest time that a slice of the replacement may take.
  std::vector<std::string> lines() const;
};

// One engine's run of a program in its simulated NC, with the output that a scenario has yet to check.

class EngineRun {
public:
  // Files that the NC's configuration names are looked for in `folder`. The engine must outlive the run.
  EngineRun(runtime::Engine& engine, std::string folder, sim::Clock clock, bool controlRecorded);

  std::string_view engineName() const { return engine_->name(); }
  sim::Machine& machine() { return machine_; }
  // The program instance for direct access.
  runtime::Instance& instance() { return machine_.inside(); }
  const runtime::Instance& instance() const { return machine_.inside(); }
  sim::SimulatedNc& nc() { return machine_.nc(); }
  const sim::SimulatedNc& nc() const { return machine_.nc(); }
  RecordedNc* recordedNc() { return recordedNc_; } // null: the NC is a simulation
  Requests& requests() { return requests_; }
  std::vector<std::string>& unreadLog() { return unreadLog_; } // lines since the last expect_log

  // Lets the program's code be recompiled from the result of `compiled`, when that becomes necessary.
  void serve(const compiler::GetCompiled& compiled);

  // Switches the program on and drops all unchecked output. Throws as Machine::powerOn.
  void powerOn(nc::PowerOn kind);
  // Replaces the running program by another one of the same dialect, whose engine must outlive the run. "" or why that
  // is impossible; then nothing has changed.
  std::string replace(runtime::Engine& next, const compiler::GetCompiled& compiled, ReplaceReport& report);
  // The state of the program, of the NC and of the output that has not been checked.
  struct Snapshot {
    std::vector<uint8_t> state; // rung_instance_save
    Requests requests;
    std::vector<std::string> unreadLog;
  };
  // Nothing: a scan has not ended.
  std::optional<Snapshot> snapshot();
  // Throws rung::Error if that is impossible.
  void restore(const Snapshot& snapshot);
  // Runs the NC and the program for a scan, a slot, the fast part or a slice.
  using Advance = void (sim::Machine::*)();
  void advance(Advance how);
  // Executes an action of the operator or the machine between two scans.
  template <class Act>
  std::string operate(Act act) {
    std::string problem = machine_.operate(act);
    takeLog();
    return problem;
  }
  // Refuses requests and drops the log, for runs without statements that check them.
  void ignore();

private:
  void takeLog();

  runtime::Engine* engine_;
  RecordedNc* recordedNc_ = nullptr; // owned by the machine
  sim::Machine machine_;
  Requests requests_;
  std::vector<std::string> unreadLog_;
};

} // namespace rung::scenario
