// Values of scenarios (see values.h).
#include "tools/scenario/values.h"

#include <algorithm>
#include <bit>
#include <cctype>
#include <cmath>
#include <fmt/format.h>
#include <sstream>

namespace rung::scenario {

using host::Instance;
using host::Ref;
using host::RefKind;

namespace {

uint64_t modulo(uint64_t value, uint32_t width) { return width >= 64 ? value : value & ((1ull << width) - 1); }

int64_t asSigned(uint64_t value, uint32_t width) {
  if (width >= 64) return static_cast<int64_t>(value);
  const uint64_t sign = 1ull << (width - 1);
  return static_cast<int64_t>((modulo(value, width) ^ sign) - sign);
}

std::string show(const Reading& reading) {
  switch (reading.kind) {
  case ValueKind::Real: return fmt::format("{}", reading.real);
  case ValueKind::Text: return fmt::format("\"{}\"", reading.text);
  case ValueKind::Int: break;
  }
  if (reading.width <= 1) return fmt::format("{}", reading.integer);
  const int64_t number = asSigned(reading.integer, reading.width);
  return number < 0 ? fmt::format("{} ({}, 0x{:X})", reading.integer, number, reading.integer)
                    : fmt::format("{} (0x{:X})", number, reading.integer);
}

std::string show(const Value& value) {
  return value.kind == ValueKind::Text ? fmt::format("\"{}\"", value.text) : value.text;
}

bool sameName(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

int indexOf(const std::vector<std::string>& names, std::string_view key) {
  for (size_t i = 0; i < names.size(); ++i)
    if (sameName(names[i], key)) return static_cast<int>(i);
  return -1;
}

int64_t rawOf(const Value& value) {
  return value.kind == ValueKind::Real ? std::bit_cast<int64_t>(value.real) : value.integer;
}

} // namespace

Reading realReading(double value) {
  Reading reading;
  reading.kind = ValueKind::Real;
  reading.real = value;
  return reading;
}

Reading readValue(const Instance& instance, const Ref& place, bool wantReal) {
  if (place.kind == RefKind::Text) {
    Reading reading;
    reading.kind = ValueKind::Text;
    reading.text = instance.readText(place);
    return reading;
  }
  if (wantReal && place.kind == RefKind::Int)
    if (const auto real = host::asReal(instance.memory(), place)) return realReading(instance.readReal(*real));
  if (place.kind == RefKind::Real || wantReal) return realReading(instance.readReal(place));
  Reading reading;
  reading.integer = instance.read(place);
  reading.width = place.kind == RefKind::Bit ? 1 : place.kind == RefKind::Constant ? 64 : place.width;
  reading.real = static_cast<double>(asSigned(reading.integer, reading.width));
  return reading;
}

std::string writeValue(Instance& instance, const Ref& place, const Value& value) {
  if (place.kind == RefKind::Constant) return "a constant cannot be set";
  if (place.kind == RefKind::Text) {
    if (value.kind != ValueKind::Text) return "this name holds a text: expected a value in quotes";
    instance.writeText(place, value.text);
    return {};
  }
  if (value.kind == ValueKind::Text) return "this name holds a number, not a text";
  if (place.kind == RefKind::Bit && (value.kind == ValueKind::Real || (value.integer != 0 && value.integer != 1)))
    return fmt::format("a bit takes 0 or 1, not {}", value.text);
  if (place.kind == RefKind::Real) {
    instance.writeReal(place, value.real);
  } else if (value.kind == ValueKind::Real) {
    const auto real = host::asReal(instance.memory(), place);
    if (!real) return fmt::format("a real does not fit here: {}", value.text);
    instance.writeReal(*real, value.real);
  } else {
    instance.write(place, static_cast<uint64_t>(value.integer));
  }
  return {};
}

std::string checkValue(const Reading& reading, const Statement& expect) {
  bool same = false;
  if (expect.near)
    same = std::fabs(reading.real - expect.value.real) <= expect.tolerance;
  else if (reading.kind == ValueKind::Text)
    same = expect.value.kind == ValueKind::Text && reading.text == expect.value.text;
  else if (expect.value.kind == ValueKind::Text)
    same = false;
  else if (reading.kind == ValueKind::Real)
    same = reading.real == expect.value.real || (std::isnan(reading.real) && std::isnan(expect.value.real));
  else
    same = reading.integer == modulo(static_cast<uint64_t>(expect.value.integer), reading.width);
  if (same) return {};
  return fmt::format("{} is {}, expected {}{}", expect.name, show(reading), show(expect.value),
                     expect.near ? fmt::format(" within {}", expect.tolerance) : "");
}

std::string checkRange(const Reading& reading, const Statement& expect) {
  bool inside = false;
  if (reading.kind == ValueKind::Real)
    inside = reading.real >= expect.value.real && reading.real <= expect.high.real;
  else if (reading.kind == ValueKind::Int && expect.value.integer < 0)
    inside = asSigned(reading.integer, reading.width) >= expect.value.integer &&
             asSigned(reading.integer, reading.width) <= expect.high.integer;
  else if (reading.kind == ValueKind::Int)
    inside = reading.integer >= static_cast<uint64_t>(expect.value.integer) &&
             reading.integer <= static_cast<uint64_t>(expect.high.integer);
  return inside
             ? std::string()
             : fmt::format("{} is {}, expected {}…{}", expect.name, show(reading), expect.value.text, expect.high.text);
}

std::string messageDifference(const nc::ShownMessage& message, const std::vector<KeyValue>& keys) {
  for (const KeyValue& key : keys) {
    bool same = true;
    std::string found;
    if (key.key == "text") {
      same = message.text == key.value.text;
      found = "\"" + message.text + "\"";
    } else if (key.key == "channel" || key.key == "index" || key.key == "subid") {
      const int32_t actual = key.key == "index" || key.key == "subid" ? message.index : message.channel;
      same = actual == key.value.integer;
      found = std::to_string(actual);
    } else if (key.key == "value" || key.key == "par1") {
      same = message.real ? std::bit_cast<double>(message.value) == key.value.real : message.value == key.value.integer;
      found = message.real ? fmt::format("{}", std::bit_cast<double>(message.value)) : std::to_string(message.value);
    } else {
      return fmt::format("a message has no property '{}'", key.key);
    }
    if (!same) return fmt::format("message {}: {} is {}, expected {}", message.number, key.key, found, show(key.value));
  }
  return {};
}

std::vector<nc::NcArgument> arguments(const std::vector<KeyValue>& keys) {
  std::vector<nc::NcArgument> out;
  for (const KeyValue& key : keys)
    out.push_back({key.key, key.value.kind == ValueKind::Text, key.value.kind == ValueKind::Real, key.value.integer,
                   key.value.real, key.value.text});
  return out;
}

ServiceSignature::ServiceSignature(std::string_view text) {
  std::istringstream in{std::string(text)};
  in >> name_;
  bool results = false;
  for (std::string word; in >> word;) {
    if (word == "->")
      results = true;
    else
      (results ? results_ : arguments_).push_back(word);
  }
}

bool ServiceSignature::isNamed(std::string_view name) const { return sameName(name_, name); }
int ServiceSignature::argument(std::string_view key) const { return indexOf(arguments_, key); }
int ServiceSignature::result(std::string_view key) const { return indexOf(results_, key); }

std::string keyProblem(const ServiceSignature& signature, const std::vector<KeyValue>& arguments,
                       const std::vector<KeyValue>& results) {
  for (const KeyValue& key : arguments)
    if (signature.argument(key.key) < 0) return fmt::format("{} has no argument '{}'", signature.name(), key.key);
  for (const KeyValue& key : results)
    if (key.key != "error" && signature.result(key.key) < 0)
      return fmt::format("{} has no result '{}'", signature.name(), key.key);
  return {};
}

namespace {

// Bits of an argument that count.
uint64_t maskOf(const ServiceSignature& signature, const rt::ServiceRequest& request, std::string_view key) {
  const int length = signature.argument("length");
  if (length < 0 || static_cast<uint32_t>(length) >= request.argCount || !sameName(key, "data")) return UINT64_MAX;
  const int64_t bytes = request.args[length];
  return bytes > 0 && bytes < 8 ? (uint64_t{1} << (8 * bytes)) - 1 : UINT64_MAX;
}

} // namespace

std::string requestDifference(const ServiceSignature& signature, const rt::ServiceRequest& request,
                              std::string_view service, const std::vector<KeyValue>& keys) {
  if (!signature.isNamed(service)) return fmt::format("the next request is {}, expected {}", signature.name(), service);
  for (const KeyValue& key : keys) {
    const int index = signature.argument(key.key);
    if (index < 0 || static_cast<uint32_t>(index) >= request.argCount)
      return fmt::format("{} has no argument '{}'", signature.name(), key.key);
    const uint64_t difference = static_cast<uint64_t>(request.args[index]) ^ static_cast<uint64_t>(rawOf(key.value));
    if ((difference & maskOf(signature, request, key.key)) != 0)
      return fmt::format("{}: {} is {}, expected {}", signature.name(), key.key, request.args[index], key.value.text);
  }
  return {};
}

bool matches(const ServiceSignature& signature, const rt::ServiceRequest& request, std::string_view service,
             const std::vector<KeyValue>& keys) {
  return requestDifference(signature, request, service, keys).empty();
}

rt::ServiceReply replyOf(const ServiceSignature& signature, uint32_t ticket, const std::vector<KeyValue>& results) {
  rt::ServiceReply reply;
  reply.ticket = ticket;
  for (const KeyValue& key : results) {
    if (key.key == "error") {
      if (key.value.integer != 0) reply.state = RUNG_SERVICE_ERROR;
      continue;
    }
    const int index = signature.result(key.key);
    if (index < 0 || index >= static_cast<int>(RUNG_MAX_SERVICE_ARGS)) continue;
    reply.results[index] = rawOf(key.value);
    reply.resultCount = std::max(reply.resultCount, static_cast<uint32_t>(index) + 1);
  }
  return reply;
}

} // namespace rung::scenario
