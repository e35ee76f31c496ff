// Configuration keys of the PMC family (see config_key.h), for the tables of its dialects.
#pragma once
#include "rtlib/nc/config_key.h"

namespace rung::nc::pmc {

constexpr ConfigKey timerKey(std::string_view doc) {
  return {.key = "tmr.<N>", .reader = ConfigReader::Compiler, .takes = "milliseconds", .otherwise = "0", .doc = doc};
}
constexpr ConfigKey counterKey(int64_t most, std::string_view doc) {
  return {.key = "ctr.<N>",
          .reader = ConfigReader::Compiler,
          .form = ConfigForm::Whole,
          .most = most,
          .otherwise = "0",
          .doc = doc};
}
inline constexpr ConfigKey kSlotStepsKey = {
    .key = "slot_steps",
    .reader = ConfigReader::Compiler,
    .form = ConfigForm::Whole,
    .least = 1,
    .most = 1'000'000,
    .doc = "steps that fit into one slot of 8 ms, Level 1 included; the number of parts of Level 2 follows"};
inline constexpr ConfigKey kPeriodKey = {
    .key = "period_us",
    .reader = ConfigReader::Compiler,
    .takes = "microseconds, a multiple of 8000",
    .doc = "period of Level 2, in a scenario `period`: the number of its parts follows"};

constexpr ConfigKey ncKey(std::string_view doc) {
  return {.key = "nc", .form = ConfigForm::Choice, .takes = "scripted simulated", .otherwise = "scripted", .doc = doc};
}
inline constexpr ConfigKey kAxesKey = {
    .key = "axes",
    .takes = "1 to 8 letters of XYZABCUVW",
    .otherwise = "XYZ",
    .doc =
        "axes of the simulated CNC, axis 1 first; where B is an axis, the second auxiliary function is not available"};
constexpr ConfigKey parameterKey(std::string_view doc) {
  return {.key = "param.<N>", .form = ConfigForm::Number, .doc = doc};
}
inline constexpr ConfigKey kEncodersKey = {.key = "encoders",
                                           .form = ConfigForm::Choice,
                                           .takes = "absolute incremental",
                                           .otherwise = "absolute",
                                           .doc = "whether the reference points are known at power-on"};
inline constexpr ConfigKey kOvertravelKey = {.key = "overtravel",
                                             .form = ConfigForm::Choice,
                                             .takes = "on off",
                                             .otherwise = "off",
                                             .doc = "whether the limit switches are wired"};

} // namespace rung::nc::pmc
