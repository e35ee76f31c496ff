// The configuration keys of the FANUC PMC (see config_key.h).
#include "rtlib/nc/config_key.h"

namespace rung::nc {

namespace {

using enum ConfigForm;
constexpr auto kCompiler = ConfigReader::Compiler;

constexpr ConfigKey kKeys[] = {
    kEncodingKey,
    {.key = "pmc",
     .reader = kCompiler,
     .takes = "the type as in `%@0`, such as 0i-F PMC(MEM-B,FLT)",
     .otherwise = "that of the program, else memory B",
     .doc = "type of the PMC, which decides about the sizes of areas and the numbers of timers and counters"},
    {.key = "tmr.<N>",
     .reader = kCompiler,
     .takes = "milliseconds",
     .otherwise = "0",
     .doc = "preset of TMR N, as typed on the timer page; at most 32767 units of the timer"},
    {.key = "ctr.<N>", .reader = kCompiler, .form = Whole, .most = 32767, .otherwise = "0", .doc = "preset of CTR N"},
    {.key = "slot_steps",
     .reader = kCompiler,
     .form = Whole,
     .least = 1,
     .most = 1'000'000,
     .doc = "steps that fit into one slot of 8 ms, level 1 included; the number of parts of level 2 follows"},
    {.key = "period_us",
     .reader = kCompiler,
     .takes = "microseconds, a multiple of 8000",
     .doc = "period of level 2, in a scenario `period`: the number of its parts follows"},
    {.key = "nc",
     .form = Choice,
     .takes = "scripted simulated",
     .otherwise = "scripted",
     .doc = "who plays the CNC: the scenario, or the simulated CNC (simulated-nc-fanuc.md)"},
    {.key = "axes",
     .takes = "1 to 8 letters of XYZABCUVW",
     .otherwise = "XYZ",
     .doc =
         "axes of the simulated CNC, axis 1 first; where B is an axis, the second auxiliary function is not available"},
    {.key = "param.<N>",
     .form = Number,
     .doc = "parameter N; `param.N.A` of axis A, 1 the first. The first axis' value holds for axes without one of "
            "their own, except for 8010; it holds from every cold start"},
    {.key = "encoders",
     .form = Choice,
     .takes = "absolute incremental",
     .otherwise = "absolute",
     .doc = "whether the reference points are known at power-on"},
    {.key = "overtravel",
     .form = Choice,
     .takes = "on off",
     .otherwise = "off",
     .doc = "whether the limit switches are wired"},
};

} // namespace

std::span<const ConfigKey> fanucConfigKeys() { return kKeys; }

} // namespace rung::nc
