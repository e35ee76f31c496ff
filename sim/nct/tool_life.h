// Life management of the tools in the spindles (man. 6.26.1, l.4385-4436) and its signals (man. 7.14.1): counting,
// expiry and breakage of tools, and the requests SN_TLCHI, SN_TLCH, SN_TLSKPA, SN_TLNL.
//
// Without tool management (N2900 #0 TMU = 0) nothing is counted and the signals are 0.
#pragma once
#include <array>

#include "rtlib/nc/nct/parameters.h"
#include "sim/nct/tool_table.h"

namespace rung::sim::nct {

// Outputs and inputs of the program for one spindle.
struct ToolAnswers {
  bool individualDone = false; // SP_TLCHIA
  bool groupDone = false;      // SP_TLCHA
  bool skip = false;           // SP_TLSKP
  bool countDisabled = false;  // SP_TLCD

  template <class Archive>
  void state(Archive& archive) {
    archive(individualDone, groupDone, skip, countDisabled);
  }
};
struct ToolRequests {
  bool individual = false; // SN_TLCHI
  bool group = false;      // SN_TLCH
  bool skipDone = false;   // SN_TLSKPA
  bool notice = false;     // SN_TLNL

  template <class Archive>
  void state(Archive& archive) {
    archive(individual, group, skipDone, notice);
  }
};

class ToolLife {
public:
  explicit ToolLife(ToolTables& tables) : tables_(tables) {}

  // Called once per PLC cycle; `spindle` counts from 0.
  const ToolRequests& cycle(uint32_t spindle, const ToolAnswers& answers, bool managed);
  void clear() { spindles_ = {}; }

  // A tool change has been completed: counts one more use of the tool now in the spindle.
  void countUse(uint32_t spindle);
  // Counts machining time of the tool in the spindle.
  void countTime(uint32_t spindle, int64_t us);
  // Counter, life or status of a tool were written: requests a change if a tool in a spindle expires thereby.
  void written(uint32_t dataNumber, int32_t statusBefore);

  uint32_t toolIn(uint32_t spindle) const { return tables_.cartridges.dataNumber({(spindle + 1) * 10, 1}); }

  template <class Archive>
  void state(Archive& archive) {
    archive(spindles_);
  }

private:
  struct Spindle {
    ToolAnswers answers;
    ToolRequests requests;
    bool managed = false;
    bool skipped = false;   // SN_TLCHI follows SN_TLSKPA
    bool noticeDue = false; // SN_TLNL in the next cycle
    uint32_t timedTool = 0;
    int64_t us = 0; // time of timedTool, less than a second
    template <class Archive>
    void state(Archive& archive) {
      archive(answers, requests, managed, skipped, noticeDue, timedTool, us);
    }
  };
  void add(uint32_t spindle, bool time);
  void tellGroup(Spindle& spindle, int32_t type);

  ToolTables& tables_;
  std::array<Spindle, nc::nct::kSpindles> spindles_{};
};

} // namespace rung::sim::nct
