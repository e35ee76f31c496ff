// Reads, writes and compares values by the rules of the scenario format: integers as bit patterns of their width, reals
// with a tolerance, texts exactly.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "ir/support/result.h"
#include "rtlib/run/instance.h"
#include "rung/runtime.h"
#include "sim/simulated_nc.h"
#include "tools/scenario/scenario.h"

namespace rung::scenario {

// The current value of a name.
struct Reading {
  ValueKind kind = ValueKind::Int;
  uint64_t integer = 0;
  uint32_t width = 64; // bits of the integer
  double real = 0;
  std::string text;
};

// `wantReal`: two words or eight bytes are read as one double.
Reading readValue(const runtime::Instance& instance, const nc::Control& control, const runtime::Ref& place,
                  bool wantReal);
std::string show(const Reading& reading);
// As decimal numbers only: "65535 (-1)".
std::string showShort(const Reading& reading);
Reading realReading(double value);
Reading cellReading(const sim::NcCell& cell, bool wantReal);
sim::NcCell cellOf(const Value& value);
// "", or why a cell of the NC, which now holds `now`, cannot hold the number.
std::string cellProblem(const sim::NcCell& now, const Value& value);
int64_t signedOf(const Reading& integer);

// "", or why a writable place cannot hold the value.
std::string valueProblem(const runtime::Instance& instance, const runtime::Ref& place, const Value& value);
// A forced cell with this name, place and value. `name` must outlive the result.
Result<rung_forced_cell> forcedCell(const runtime::Instance& instance, const std::string& name,
                                    const runtime::Ref& place, const Value& value);

// Each of these returns "" or what is wrong.
std::string writeValue(runtime::Instance& instance, const nc::Control& control, const runtime::Ref& place,
                       const Value& value);
std::string checkValue(const Reading& reading, const Statement& expect);
std::string checkRange(const Reading& reading, const Statement& expect);
std::string messageDifference(const nc::ShownMessage& message, const std::vector<KeyValue>& keys);

std::vector<sim::NcArgument> arguments(const std::vector<KeyValue>& keys);

} // namespace rung::scenario
