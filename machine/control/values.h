// Values of cells as JSON: a bit is true or false, an integer and a real are numbers; NaN and infinity are texts. A
// byte has no sign, wider integers have one.
#pragma once
#include <cstdint>
#include <stdexcept>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "rung/runtime.h"

namespace rung::control {

// A request cannot be carried out. The text is for the user: found, expected, what to do.
class Refused : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

// `type`: enum rung_type, not of a text.
nlohmann::json toJson(uint32_t type, rung_value value);
// Throws Refused if the value does not fit the type; integers may be signed as the cell, or unsigned.
rung_value fromJson(uint32_t type, const nlohmann::json& value, const std::string& name);
std::string typeName(uint32_t type); // "bit", "i16", "real"

} // namespace rung::control
