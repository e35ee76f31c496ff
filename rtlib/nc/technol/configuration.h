// How a TECHNOL program asks its control for the configuration and the constants of the machine (man. ch. 16): one
// service that the control answers at once. A request names what is wanted and by which identifier; a text comes in
// parts.
#pragma once
#include <cstdint>
#include <string_view>

#include "rung/program.h"

namespace rung::nc {

enum class ConfigurationKind : uint8_t { Integer, Real, Text, Binary, Bit, Constant };

// Arguments: kind, number of the part, identifier, eight characters a word, filled up with zeros.
// Results: 1 where it was found, bytes of the whole text, then a value (the bits of a real) or the part of the text.
inline constexpr std::string_view kConfigurationService =
    "@CNF_GET kind part id0 id1 id2 id3 id4 id5 id6 id7 id8 id9 id10 id11 id12 id13 -> found length v0 v1 v2 v3 v4 v5 "
    "v6 v7 v8 v9 v10 v11 v12 v13";
inline constexpr uint32_t kConfigurationHead = 2; // words before the identifier and the value
inline constexpr uint32_t kConfigurationWords = RUNG_MAX_SERVICE_ARGS - kConfigurationHead;
inline constexpr uint32_t kConfigurationBytes = kConfigurationWords * 8; // longest identifier, and a part of a text

inline constexpr uint32_t kMaxAxes = 16; // of a control, l.8085

} // namespace rung::nc
