// The configuration keys of the FANUC PMC (see config_key.h).
#include "rtlib/nc/pmc/config_keys.h"

namespace rung::nc {

namespace {

constexpr ConfigKey kKeys[] = {
    kEncodingKey,
    {.key = "pmc",
     .reader = ConfigReader::Compiler,
     .takes = "the type as in `%@0`, such as 0i-F PMC(MEM-B,FLT)",
     .otherwise = "that of the program, else memory B",
     .doc = "type of the PMC, which decides about the sizes of areas and the numbers of timers and counters"},
    pmc::timerKey("preset of TMR N, as typed on the timer page; at most 32767 units of the timer"),
    pmc::counterKey(32767, "preset of CTR N"),
    pmc::kSlotStepsKey,
    pmc::kPeriodKey,
    pmc::ncKey("who plays the CNC: the scenario, or the simulated CNC (simulated-nc-fanuc.md)"),
    pmc::kAxesKey,
    pmc::parameterKey(
        "parameter N; `param.N.A` of axis A, 1 the first. The first axis' value holds for axes without one of "
        "their own, except for 8010; it holds from every cold start"),
    pmc::kEncodersKey,
    pmc::kOvertravelKey,
};

} // namespace

std::span<const ConfigKey> fanucConfigKeys() { return kKeys; }

} // namespace rung::nc
