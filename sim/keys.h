// Keys of events, of the configuration and of quantities, as all simulated machines read them.
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
// "" or "event NAME does not know 'KEY'".
std::string unknownKey(std::string_view event, const std::vector<NcArgument>& keys,
                       std::initializer_list<std::string_view> known);
// The numbers after a prefix: "MPOS.3" with "MPOS." gives {3}, "param.0516.2" with "param." {516, 2}. Nothing when the
// prefix or the form is another.
std::optional<std::vector<uint32_t>> numbersAfter(std::string_view text, std::string_view prefix);
// "3.REST" gives 3, and the text is REST; nothing when its form is another.
std::optional<uint32_t> takeNumberAndDot(std::string_view& text);

} // namespace rung::sim
