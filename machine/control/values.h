// JSON values of requests and answers: texts and names, values of cells, bytes. A bit is true or false; integers and
// reals are numbers; a real that is not finite is null. Bytes are unsigned, wider integers signed.
#pragma once
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "rtlib/run/clock.h"
#include "rung/runtime.h"

namespace rung::control {

// A request that cannot be executed. The text is for the user: what was found, what was expected, how to fix it.
class Refused : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

// Members of a request by key; throw Refused if the member is missing or has another type.
std::string textOf(const nlohmann::json& request, const char* key);
bool flagOf(const nlohmann::json& request, const char* key); // false if missing
std::vector<std::string> namesOf(const nlohmann::json& request);

// Adds an age as `us`, and since when, `since`, in seconds since 1970.
void addAge(nlohmann::json& out, runtime::Clock& clock, int64_t ageNs);

std::string joined(const std::vector<std::string>& texts, const char* between);

// `type`: enum rung_type, except text.
nlohmann::json toJson(uint32_t type, rung_value value);
// Throws Refused if the value does not fit the type; integers may be given signed or unsigned.
rung_value fromJson(uint32_t type, const nlohmann::json& value, const std::string& name);
std::string typeName(uint32_t type);                 // "bit", "i16", "real"
std::string textOf(uint32_t type, rung_value value); // for users

std::string toBase64(std::string_view bytes);
std::optional<std::string> fromBase64(std::string_view text); // nothing if it is not base64

} // namespace rung::control
