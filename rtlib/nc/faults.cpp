// The faults of each dialect.
#include "rtlib/nc/faults.h"

namespace rung::nc {

namespace {

// Faults raised by the host, in every dialect.
constexpr Fault kMaxTime = {"max-time",
                            "A slice took longer than the limit that its host has set (rung_instance_limit, "
                            "the parameter max-time of LinuxCNC's component, rung-run --max-time). The "
                            "rung in brackets is where it was noticed. Check the loops around it, what "
                            "interrupts the thread, and how long a scan takes without a limit."};
constexpr Fault kOverrun = {"overrun", "Many scans in a row, 500 unless the host sets another number, began a "
                                       "whole period or more late. Shorten the program, choose a longer period, or "
                                       "check what else takes the time of the thread."};

constexpr Fault kPmc[] = {
    {kPmcDeadLoop,
     "One run of Level 1 or of a part of Level 2 does not end: a jump leads backwards and its condition "
     "never "
     "changes within the run. The rung in brackets is the one where the budget of steps was used up; look at the jumps "
     "around it. A loop that has to wait for the machine must be spread over several cycles: leave the program and "
     "test again "
     "in "
     "the next one."},
    kMaxTime,
    kOverrun};

constexpr Fault kNct[] = {
    {kNctTimeout,
     "MAIN or INT0 does not end in one run (man. l.540): a jump leads backwards and its condition never "
     "changes, or subroutines call far too much. The rung in brackets is the one where the budget of steps was used "
     "up. "
     "Inputs are constant during a run: a loop that waits for one never ends."},
    kMaxTime,
    kOverrun};

constexpr Fault kTechnol[] = {
    {kTechnolDivision,
     "DIVB divided by 0, or its result does not fit (man. l.5354). Compare the divisor with 0 before the division."},
    {kTechnolReal,
     "A real was divided by 0, or an operation has no result (man. l.5355). Check the operands before it."},
    {kTechnolRequested,
     "The control asked for the halt, in a scenario `event HALT` (man. l.5361). The program is not at fault."},
    {kTechnolFastOverrun, "MODULE_FAST, MODULE_FASTEST or MODULE_CYCLICOPERATION takes longer than its raster of 1 ms "
                          "allows (man. l.5356): a "
                          "loop in it does not end, or it does too much. Move work to MODULE_MAIN."},
    {kTechnolProtection,
     "A computed address lies outside the program's data (man. l.5352). Look at the index of the instruction in "
     "brackets, and at what is added to it."},
    {kTechnolEdef,
     "An EDEF was executed with more and more different bits. Bits are tied once; name fixed bits in the instruction."},
    {kTechnolWatchdog,
     "A module or an event procedure does not end: a jump leads backwards and its condition never changes. "
     "Waiting belongs in a mechanism (EX, TEX0, TIM), which continues in the next cycle."},
    kMaxTime,
    kOverrun};

} // namespace

std::span<const Fault> faultsOf(std::string_view dialect) {
  if (dialect == "fanuc" || dialect == "gsk") return kPmc;
  if (dialect == "nct") return kNct;
  if (dialect == "technol") return kTechnol;
  return {};
}

const Fault* findFault(std::string_view dialect, std::string_view text) {
  for (const Fault& fault : faultsOf(dialect))
    if (text.starts_with(fault.text)) return &fault;
  return nullptr;
}

std::string_view shortName(const Fault& fault) { return fault.text.substr(0, fault.text.find(':')); }

} // namespace rung::nc
