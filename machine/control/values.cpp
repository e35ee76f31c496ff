// See values.h.
#include "machine/control/values.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <nlohmann/json.hpp>
#include <sodium.h>

#include "rtlib/text/controls.h"
#include "rtlib/text/number.h"
#include "rung/types.hpp"

namespace rung::control {

using nlohmann::json;

std::string textOf(const json& request, const char* key) {
  const auto found = request.find(key);
  if (found == request.end() || !found->is_string())
    throw Refused(std::string("found no text \"") + key + "\" in the request, expected one");
  std::string text = found->get<std::string>();
  if (text::hasControls(text))
    throw Refused(std::string("found a control character in \"") + key + "\", expected none");
  return text;
}

bool flagOf(const json& request, const char* key) {
  const auto found = request.find(key);
  if (found == request.end()) return false;
  if (!found->is_boolean())
    throw Refused(std::string("found no true or false for \"") + key + "\", expected one of them");
  return found->get<bool>();
}

std::vector<std::string> namesOf(const json& request) {
  constexpr size_t kMostNames = 256;
  const auto found = request.find("names");
  const bool good = found != request.end() && found->is_array() && !found->empty() && found->size() <= kMostNames &&
                    std::ranges::all_of(*found, &json::is_string);
  if (found != request.end() && found->is_array() && found->size() > kMostNames)
    throw Refused("found " + std::to_string(found->size()) + " names, expected at most " + std::to_string(kMostNames) +
                  ", because all come from one scan; ask for them in parts");
  if (!good) throw Refused("found no list \"names\" of 1 to 256 texts in the request, expected one");
  auto names = found->get<std::vector<std::string>>();
  if (std::ranges::any_of(names, [](const std::string& name) { return text::hasControls(name); }))
    throw Refused("found a control character in \"names\", expected none");
  return names;
}

void addAge(json& out, runtime::Clock& clock, int64_t ageNs) {
  constexpr int64_t kNsInUs = 1000, kNsInS = 1'000'000'000;
  out["us"] = ageNs / kNsInUs;
  out["since"] = (clock.dateNs() - ageNs) / kNsInS;
}

std::string joined(const std::vector<std::string>& texts, const char* between) {
  std::string all;
  for (const std::string& text : texts) all += (all.empty() ? "" : between) + text;
  return all;
}

// ---- values of cells -----------------------------------------------------------------------------------------------

std::string textOf(uint32_t type, rung_value value) { return toJson(type, value).dump(); }

std::string typeName(uint32_t type) {
  switch (type) {
  case RUNG_TYPE_BIT: return "bit";
  case RUNG_TYPE_F64: return "real";
  case RUNG_TYPE_TEXT: return "text";
  default: return "i" + std::to_string(elementBits(type));
  }
}

json toJson(uint32_t type, rung_value value) {
  switch (type) {
  case RUNG_TYPE_BIT: return value.integer != 0;
  case RUNG_TYPE_I8: return static_cast<uint8_t>(value.integer);
  case RUNG_TYPE_I16: return static_cast<int16_t>(value.integer);
  case RUNG_TYPE_I32: return static_cast<int32_t>(value.integer);
  case RUNG_TYPE_F64:
    if (std::isnan(value.real)) return "nan";
    if (std::isinf(value.real)) return value.real < 0 ? "-inf" : "inf";
    return value.real;
  default: return value.integer;
  }
}

namespace {

// The number in a text, for numbers that JSON cannot represent.
text::WrittenNumber writtenIn(const json& value) {
  return value.is_string() ? text::writtenNumber(value.get<std::string>()) : text::WrittenNumber{};
}

std::string rangeOf(uint32_t bits) {
  const int64_t least = -static_cast<int64_t>((uint64_t{1} << (bits - 1)) - 1) - 1;
  return std::to_string(least) + " to " + std::to_string(UINT64_MAX >> (64 - bits));
}

} // namespace

rung_value fromJson(uint32_t type, const json& value, const std::string& name) {
  const auto refuse = [&](const std::string& expected) {
    throw Refused("found " + value.dump() + " for " + name + ", expected " + expected);
  };
  const text::WrittenNumber written = writtenIn(value);
  if (written.form == text::NumberForm::OutOfRange)
    throw Refused("no variable can hold " + value.get<std::string>() + ", given for " + name);
  rung_value made{};
  if (type == RUNG_TYPE_BIT) {
    if (value.is_boolean())
      made.integer = value.get<bool>() ? 1 : 0;
    else if (value.is_number_integer() && (value == 0 || value == 1))
      made.integer = value == 1 ? 1 : 0;
    else
      refuse("true or false, because it is a bit");
    return made;
  }
  if (type == RUNG_TYPE_F64) {
    if (!value.is_number() && written.form != text::NumberForm::TooLong) refuse("a number");
    made.real = value.is_number() ? value.get<double>() : written.real;
    return made;
  }
  const uint32_t bits = elementBits(type);
  if (written.form == text::NumberForm::TooLong)
    throw Refused("found " + value.get<std::string>() + " for " + name + ", expected " + rangeOf(bits));
  if (!value.is_number_integer()) refuse("an integer, because the variable has " + std::to_string(bits) + " bits");
  if (value.is_number_unsigned()) {
    const auto number = value.get<uint64_t>();
    if (bits < 64 && number >> bits != 0) refuse("at most " + std::to_string((uint64_t{1} << bits) - 1));
    std::memcpy(&made.integer, &number, sizeof number);
    return made;
  }
  made.integer = value.get<int64_t>();
  if (bits < 64 && made.integer < -(int64_t{1} << (bits - 1)))
    refuse("at least " + std::to_string(-(int64_t{1} << (bits - 1))));
  return made;
}

// ---- bytes ---------------------------------------------------------------------------------------------------------

std::string toBase64(std::string_view bytes) {
  std::string text(sodium_base64_ENCODED_LEN(bytes.size(), sodium_base64_VARIANT_ORIGINAL), '\0');
  sodium_bin2base64(text.data(), text.size(), reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(),
                    sodium_base64_VARIANT_ORIGINAL);
  text.pop_back(); // the terminating 0
  return text;
}

std::optional<std::string> fromBase64(std::string_view text) {
  std::string bytes(text.size() / 4 * 3 + 3, '\0');
  size_t length = 0;
  const int status = sodium_base642bin(reinterpret_cast<unsigned char*>(bytes.data()), bytes.size(), text.data(),
                                       text.size(), nullptr, &length, nullptr, sodium_base64_VARIANT_ORIGINAL);
  if (status != 0) return std::nullopt;
  bytes.resize(length);
  return bytes;
}

} // namespace rung::control
