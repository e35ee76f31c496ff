// What requests and answers hold, as JSON: texts and names, values of cells, bytes. Of cells a bit is true or false, an
// integer and a real are numbers; a real that is none is null. A byte has no sign, wider integers have one.
#pragma once
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "rung/runtime.h"

namespace rung::control {

// Something that is asked for cannot be done; the text is for the person who asks: found, expected, what to do.
class Refused : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

// Of a request, by their keys; throw Refused where they are not there, or are something else.
std::string textOf(const nlohmann::json& request, const char* key);
bool flagOf(const nlohmann::json& request, const char* key); // without it: false
std::vector<std::string> namesOf(const nlohmann::json& request);

std::string joined(const std::vector<std::string>& texts, const char* between);

// `type`: enum rung_type, not of a text.
nlohmann::json toJson(uint32_t type, rung_value value);
// Throws Refused where it is none of the type; integers may have the sign of the cell, or none.
rung_value fromJson(uint32_t type, const nlohmann::json& value, const std::string& name);
std::string typeName(uint32_t type);                 // "bit", "i16", "real"
std::string textOf(uint32_t type, rung_value value); // for people

std::string toBase64(std::string_view bytes);
std::optional<std::string> fromBase64(std::string_view text); // nothing where it is none

} // namespace rung::control
