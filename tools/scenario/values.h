// Reading, writing and comparing by the rules of the scenario format: integers as patterns of their width, reals by
// tolerance, texts as they are.
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

// What a name holds now.
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
// Without the hexadecimal form: "65535 (-1)".
std::string showShort(const Reading& reading);
Reading realReading(double value);
Reading cellReading(const sim::NcCell& cell, bool wantReal);
sim::NcCell cellOf(const Value& value);
// "", or why a cell of the NC that holds `now` cannot hold the number.
std::string cellProblem(const sim::NcCell& now, const Value& value);
int64_t signedOf(const Reading& integer);

// "", or why a place that can be written cannot hold the value.
std::string valueProblem(const runtime::Instance& instance, const runtime::Ref& place, const Value& value);
// The cell of this name, at this place, with the value, for a force. The name outlives the result.
Result<rung_forced_cell> forcedCell(const runtime::Instance& instance, const std::string& name,
                                    const runtime::Ref& place, const Value& value);

// Each gives "" or what is wrong.
std::string writeValue(runtime::Instance& instance, const nc::Control& control, const runtime::Ref& place,
                       const Value& value);
std::string checkValue(const Reading& reading, const Statement& expect);
std::string checkRange(const Reading& reading, const Statement& expect);
std::string messageDifference(const nc::ShownMessage& message, const std::vector<KeyValue>& keys);

std::vector<sim::NcArgument> arguments(const std::vector<KeyValue>& keys);

} // namespace rung::scenario
