// Values of cells as JSON: a bit is true or false, an integer and a real are numbers; a real that is none is null. A
// byte has no sign, wider integers have one.
#pragma once
#include <cstdint>
#include <stdexcept>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "rung/runtime.h"

namespace rung::control {

// Something that is asked for cannot be done; the text is for the person who asks: found, expected, what to do.
class Refused : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

// `type`: enum rung_type, not of a text.
nlohmann::json toJson(uint32_t type, rung_value value);
// Throws Refused where it is none of the type; integers may have the sign of the cell, or none.
rung_value fromJson(uint32_t type, const nlohmann::json& value, const std::string& name);
std::string typeName(uint32_t type); // "bit", "i16", "real"

} // namespace rung::control
