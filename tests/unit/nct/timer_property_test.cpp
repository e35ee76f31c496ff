// Timers against what their names say, told from the times at which the input changed (man. §6.4): random inputs,
// random presets, in MAIN and in INT0. Each timer twice: with a preset from a register its time is its own, with a
// constant it goes by the run's.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/unit/nct/machines.h"

namespace rung::frontend::nct::test {
namespace {

constexpr uint32_t kInput = 7000, kOutputs = 7001, kPreset = 7002, kRegisters = 7010, kFixedPreset = 23;

const std::string kRungs = "rung\n|--[7000.00]--{TOND 7010 7002 #0}--(7001.00)\n\n"
                           "rung\n|--[7000.00]--{TOFFD 7011 7002 #0}--(7001.01)\n\n"
                           "rung\n|--[7000.00]--{TPULSE 7012 7002 #0}--(7001.02)\n\n"
                           "rung\n|--[7000.00]--{TOND 7013 #23 #0}--(7001.03)\n\n"
                           "rung\n|--[7000.00]--{TOFFD 7014 #23 #0}--(7001.04)\n\n"
                           "rung\n|--[7000.00]--{TPULSE 7015 #23 #0}--(7001.05)\n";

// What a timer knows: when its input changed last, and whether it ever did.
struct Input {
  bool on = false;
  int64_t changedUs = 0;
  bool everOn = false;
};

// The three from register and output `first`.
void check(const Machine& machine, uint32_t first, const Input& input, int64_t presetMs) {
  const int64_t passedMs = (machine.nowUs() - input.changedUs) / 1000;
  const int64_t left = std::max<int64_t>(0, presetMs - passedMs);
  const bool over = passedMs >= presetMs;
  const int64_t afterOff = !input.everOn ? 0 : left; // off from the start: nothing was switched off
  ASSERT_EQ(machine.word(kRegisters + first), input.on ? left : presetMs) << machine.name();
  ASSERT_EQ(machine.word(kRegisters + first + 1), input.on ? presetMs : afterOff) << machine.name();
  ASSERT_EQ(machine.word(kRegisters + first + 2), input.on ? left : presetMs) << machine.name();
  ASSERT_EQ(machine.bit(kOutputs, first), input.on && over) << machine.name();
  ASSERT_EQ(machine.bit(kOutputs, first + 1), input.on || (input.everOn && !over)) << machine.name();
  ASSERT_EQ(machine.bit(kOutputs, first + 2), input.on && !over) << machine.name();
}

// A preset lasts from one change of the input to the next, as a timer takes it over where it is triggered or idle.
void runTimers(Machine& machine, bool fast, uint32_t seed) {
  std::mt19937 random(seed);
  Input input;
  int64_t preset = 40;
  for (int step = 0; step < 400; ++step) {
    const bool on = random() % 6 == 0 ? !input.on : input.on;
    const bool changes = on != input.on;
    if (changes) preset = random() % 8 == 0 ? 0 : static_cast<int64_t>(random() % (fast ? 17 : 71));
    machine.setWord(kInput, on ? 1 : 0);
    machine.setWord(kPreset, static_cast<uint32_t>(preset));
    if (fast)
      machine.fast();
    else
      machine.scan();
    if (changes) input = {on, machine.nowUs(), input.everOn || on};
    ASSERT_NO_FATAL_FAILURE(check(machine, 0, input, preset)) << "step " << step << " preset " << preset;
    ASSERT_NO_FATAL_FAILURE(check(machine, 3, input, kFixedPreset)) << "step " << step;
  }
}

TEST(TimerProperty, OutputsFollowTheTimesOfTheInput) {
  Machines machines(kRungs);
  for (Machine& machine : machines.all()) runTimers(machine, false, 11);
  EXPECT_EQ(machines.difference(), "");
}

TEST(TimerProperty, TimersOfInt0CountTimeSlices) {
  Machines machines("\nmodule INT0\n" + kRungs);
  for (Machine& machine : machines.all()) runTimers(machine, true, 12);
  EXPECT_EQ(machines.difference(), "");
}

} // namespace
} // namespace rung::frontend::nct::test
