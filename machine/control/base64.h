// Base64: arbitrary bytes within JSON.
#pragma once
#include <optional>
#include <string>
#include <string_view>

namespace rung::control {

std::string toBase64(std::string_view bytes);
std::optional<std::string> fromBase64(std::string_view text); // nothing: not base64

} // namespace rung::control
