// What the statements about values, messages, the log and the fault do in one lane. Each gives "" or what is wrong.
#pragma once
#include <string>

#include "tools/scenario/lane.h"
#include "tools/scenario/scenario.h"

namespace rung::scenario {

std::string setValue(Lane& lane, const Statement& s);
std::string expectValue(const Lane& lane, const Statement& s);
std::string expectRange(const Lane& lane, const Statement& s);
std::string expectMessage(const Lane& lane, const Statement& s);
std::string expectLog(Lane& lane, const Statement& s);
std::string expectFault(const Lane& lane, const Statement& s);

} // namespace rung::scenario
