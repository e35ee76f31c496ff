// The licences of the hardware key that LDR_LIC asks for (man. l.7631-7655): what the program writes, what a
// configuration sets, and the bits of the host cell @LICENCES, in this order from bit 0.
#pragma once
#include <string_view>

namespace rung::nc {

inline constexpr std::string_view kLicences =
    "HwKeyConnected FeaturePlc0 FeaturePlc1 FeaturePlc2 FeaturePlc3 FeaturePlc4 "
    "FeaturePlc5 FeaturePlc6 FeaturePlc7 FeaturePlc8 FeaturePlc9";
inline constexpr std::string_view kLicenceCell = "@LICENCES";

} // namespace rung::nc
