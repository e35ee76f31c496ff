// The configuration keys of the GSK25i (see config_key.h).
#include "rtlib/nc/config_key.h"

namespace rung::nc {

namespace {

using enum ConfigForm;
constexpr auto kCompiler = ConfigReader::Compiler;

constexpr ConfigKey kKeys[] = {
    kEncodingKey,
    {.key = "tmr.<N>",
     .reader = kCompiler,
     .takes = "milliseconds",
     .otherwise = "0",
     .doc = "preset of TMR N, 1 to 100, as typed on the timer page; at most 65535 units of the timer"},
    {.key = "ctr.<N>",
     .reader = kCompiler,
     .form = Whole,
     .most = 65535,
     .otherwise = "0",
     .doc = "preset of CTR N, 1 to 100"},
    {.key = "slot_steps",
     .reader = kCompiler,
     .form = Whole,
     .least = 1,
     .most = 1'000'000,
     .doc = "steps that fit into one slot of 8 ms, Level 1 included; the number of parts of Level 2 follows"},
    {.key = "period_us",
     .reader = kCompiler,
     .takes = "microseconds, a multiple of 8000",
     .doc = "period of Level 2, in a scenario `period`: the number of its parts follows"},
    {.key = "machine",
     .reader = kCompiler,
     .form = Choice,
     .takes = "mill turn",
     .otherwise = "both are accepted",
     .doc = "GSK25iMc or GSK25iTc: warns of signals that this machine does not have"},
    {.key = "messages",
     .reader = kCompiler,
     .form = File,
     .doc = "texts for the messages of area A, relative to the program: `NUMBER \"text\"` a line; the number is 8 x "
            "byte + bit + 1, or the bit, `A0.0`, itself"},
    {.key = "nc",
     .form = Choice,
     .takes = "scripted simulated",
     .otherwise = "scripted",
     .doc = "who plays the CNC: the scenario, or the simulated CNC (simulated-nc-gsk.md)"},
    {.key = "axes",
     .takes = "1 to 8 letters of XYZABCUVW",
     .otherwise = "XYZ",
     .doc =
         "axes of the simulated CNC, axis 1 first; where B is an axis, the second auxiliary function is not available"},
    {.key = "param.<N>",
     .form = Number,
     .doc = "parameter N; `param.N.A` of axis A, 1 the first. The first axis' value holds for axes without one of "
            "their own, except for 7010; it holds from every cold start"},
    {.key = "encoders",
     .form = Choice,
     .takes = "absolute incremental",
     .otherwise = "absolute",
     .doc = "whether the reference points are known at power-on (l.5071-5072)"},
    {.key = "overtravel",
     .form = Choice,
     .takes = "on off",
     .otherwise = "off",
     .doc = "whether the limit switches are wired (l.3597)"},
    {.key = "jog",
     .form = Number,
     .otherwise = "2000",
     .doc = "manual feed at 100 % in mm/min; the manual names no parameter"},
    {.key = "protect",
     .form = Choice,
     .takes = "on off",
     .otherwise = "off",
     .doc = "tables protected: window writes end with code 7"},
};

} // namespace

std::span<const ConfigKey> gskConfigKeys() { return kKeys; }

} // namespace rung::nc
