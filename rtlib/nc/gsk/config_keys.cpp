// The configuration keys of the GSK25i (see config_key.h).
#include "rtlib/nc/pmc/config_keys.h"

namespace rung::nc {

namespace {

using enum ConfigForm;
constexpr auto kCompiler = ConfigReader::Compiler;

constexpr ConfigKey kKeys[] = {
    kEncodingKey,
    pmc::timerKey("preset of TMR N, 1 to 100, as typed on the timer page; at most 65535 units of the timer"),
    pmc::counterKey(65535, "preset of CTR N, 1 to 100"),
    pmc::kSlotStepsKey,
    pmc::kPeriodKey,
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
    pmc::ncKey("who plays the CNC: the scenario, or the simulated CNC (simulated-nc-gsk.md)"),
    pmc::kAxesKey,
    pmc::parameterKey(
        "parameter N; `param.N.A` of axis A, 1 the first. The first axis' value holds for axes without one of "
        "their own, except for 7010; it holds from every cold start"),
    pmc::kEncodersKey,   // man. l.5071-5072
    pmc::kOvertravelKey, // man. l.3597
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
