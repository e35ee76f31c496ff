// What has become of the state when a program took the place of another, in words.
#pragma once
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
#include "tools/scenario/requests.h"

namespace rung::scenario {

// Before the key of what the compiler made, where a name would mean a cell.
inline constexpr std::string_view kStateWord = "state";

std::optional<runtime::ChangeKind> changeKindFromName(std::string_view name);
// "moved COUNT", "renamed LAMP BEACON", "new state MAIN/TMR": as expect_change names it.
std::string textOf(const runtime::StateChange& change);

struct ReplaceReport {
  ReplaceReport() = default;
  explicit ReplaceReport(const rung::Replacement& replacement);

  uint32_t keptCells = 0;
  uint32_t keptStates = 0;
  std::string bound;                         // rung_replacement_info::bound
  std::vector<runtime::StateChange> changes; // those that no statement has taken

  // Takes it out; "" or what is there instead.
  std::string take(const runtime::StateChange& change);
  // "" or what there is.
  std::string expectNone() const;
  // What was kept, a line for each change, and how long a slice of it may last.
  std::vector<std::string> lines() const;
};

// One engine's run of a program in its simulated NC, and what a scenario has yet to look at.

class EngineRun {
public:
  // Files that the NC's configuration names lie in `folder`. The engine outlives the run.
  EngineRun(runtime::Engine& engine, std::string folder, sim::Clock clock);

  std::string_view engineName() const { return engine_->name(); }
  sim::Machine& machine() { return machine_; }
  // The program from inside.
  runtime::Instance& instance() { return machine_.inside(); }
  const runtime::Instance& instance() const { return machine_.inside(); }
  sim::SimulatedNc& nc() { return machine_.nc(); }
  const sim::SimulatedNc& nc() const { return machine_.nc(); }
  Requests& requests() { return requests_; }
  std::vector<std::string>& unreadLog() { return unreadLog_; } // since the last expect_log

  // Code of the program can be made anew from what `compiled` gives, when it is asked for.
  void serve(const compiler::GetCompiled& compiled);

  // Switches the program on; what was to be looked at is dropped. Throws as Machine::powerOn.
  void powerOn(nc::PowerOn kind);
  // Another program of the same dialect takes over from the running one. "" or why it cannot, and nothing has happened;
  // its engine outlives the run.
  std::string replace(runtime::Engine& next, const compiler::GetCompiled& compiled, ReplaceReport& report);
  // Runs the NC and the program: a scan, a slot, the fast part or a slice.
  using Advance = void (sim::Machine::*)();
  void advance(Advance how);
  // The operator or the machine does something between two scans.
  template <class Act>
  std::string operate(Act act) {
    std::string problem = machine_.operate(act);
    takeLog();
    return problem;
  }
  // No statement will look at them: requests are refused, and what the log holds is dropped.
  void ignore();

private:
  void takeLog();

  runtime::Engine* engine_;
  sim::Machine machine_;
  Requests requests_;
  std::vector<std::string> unreadLog_;
};

} // namespace rung::scenario
