// The names of a program that a machine could be connected to, and values for them.
#pragma once
#include <random>
#include <string>
#include <vector>

#include "machine/host/mapping_file.h"
#include "rtlib/core/memory.h"
#include "rtlib/nc/control/control.h"

namespace rung::test {

// Bits that something outside of the program may write, and bits that it gives: the program's own names, and the
// signals of its control.
struct Names {
  std::vector<std::string> inputs;
  std::vector<std::string> outputs;
};
Names namesOf(const runtime::Instance& instance, const nc::Control& control);

// A pin for each.
host::File mapOf(const Names& names);

// Every value of a machine changes now and then; the same sequence in every run.
class Toggles {
public:
  bool next(bool old) { return random_() % 32 == 0 ? !old : old; }
  // A number, or bits side by side.
  int32_t nextNumber(int32_t old) { return random_() % 8 == 0 ? old ^ (1 << random_() % 16) : old; }

private:
  std::mt19937_64 random_{20260101};
};

// The inputs of a program without pins.
class Inputs {
public:
  Inputs(const runtime::Instance& instance, const nc::Control& control, const std::vector<std::string>& names);
  void toggle(runtime::Instance& instance);

private:
  std::vector<core::ListedPlace> places_;
  std::vector<uint64_t> values_;
  Toggles toggles_;
};

} // namespace rung::test
