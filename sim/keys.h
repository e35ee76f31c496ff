// Parsing of keys of events, of the configuration and of quantities, for all simulated machines.
#pragma once
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rtlib/text/number.h"
#include "sim/simulated_nc.h"

namespace rung::sim {

const NcArgument* findKey(const std::vector<NcArgument>& keys, std::string_view key);
int64_t integerKey(const std::vector<NcArgument>& keys, std::string_view key, int64_t otherwise);
// Returns "" or "event NAME does not know 'KEY'".
std::string unknownKey(std::string_view event, const std::vector<NcArgument>& keys,
                       std::initializer_list<std::string_view> known);
// The numbers after a prefix: "MPOS.3" with "MPOS." gives {3}, "param.0516.2" with "param." {516, 2}. Nothing if the
// text has another prefix or form.
std::optional<std::vector<uint32_t>> numbersAfter(std::string_view text, std::string_view prefix);
// Takes the number and the dot from "3.REST", so that REST is left; nothing if the text has another form.
std::optional<uint32_t> takeNumberAndDot(std::string_view& text);

} // namespace rung::sim
