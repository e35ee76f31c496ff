// Values of scenarios (see values.h).
#include "tools/scenario/values.h"

#include <bit>
#include <cmath>
#include <fmt/format.h>
#include <optional>
#include <string_view>

#include "rtlib/nc/names/write.h"

namespace rung::scenario {

using runtime::Instance;
using runtime::Ref;
using runtime::RefKind;

namespace {

uint64_t modulo(uint64_t value, uint32_t width) { return width >= 64 ? value : value & ((1ull << width) - 1); }

int64_t asSigned(uint64_t value, uint32_t width) {
  if (width >= 64) return static_cast<int64_t>(value);
  const uint64_t sign = 1ull << (width - 1);
  return static_cast<int64_t>((modulo(value, width) ^ sign) - sign);
}

// "" if an integer of the width can hold the number, directly or as the bit pattern of a negative one.
std::string widthProblem(const Value& value, uint32_t width) {
  if (value.kind != ValueKind::Int || text::fitsBits(value.number, width)) return {};
  if (width == 1) return fmt::format("a bit takes 0 or 1, not {}", value.text);
  const uint64_t most = UINT64_MAX >> (64 - width);
  return fmt::format("an integer of {} bits takes {} to {}, not {}", width, -static_cast<int64_t>(most / 2) - 1, most,
                     value.text);
}

std::string show(const Value& value) {
  return value.kind == ValueKind::Text ? fmt::format("\"{}\"", value.text) : value.text;
}

} // namespace

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

std::string showShort(const Reading& reading) {
  if (reading.kind != ValueKind::Int || reading.width <= 1) return show(reading);
  // Whether a cell is signed depends on the program: both readings are shown.
  const int64_t number = asSigned(reading.integer, reading.width);
  return number < 0 ? fmt::format("{} ({})", reading.integer, number) : fmt::format("{}", number);
}

int64_t signedOf(const Reading& integer) { return asSigned(integer.integer, integer.width); }

Reading realReading(double value) {
  Reading reading;
  reading.kind = ValueKind::Real;
  reading.real = value;
  return reading;
}

Reading cellReading(const sim::NcCell& cell, bool wantReal) {
  const bool isReal = cell.isReal || (wantReal && cell.untyped && cell.width == 64);
  if (isReal) return realReading(std::bit_cast<double>(cell.bits));
  Reading reading;
  if (cell.isText) {
    reading.kind = ValueKind::Text;
    reading.text = cell.text;
    return reading;
  }
  reading.integer = cell.bits;
  reading.width = cell.width;
  reading.real = static_cast<double>(asSigned(cell.bits, cell.width));
  return reading;
}

std::string cellProblem(const sim::NcCell& now, const Value& value) {
  if (now.isReal || now.isText) return {};
  if (now.untyped && now.width != 64 && value.kind == ValueKind::Real)
    return fmt::format("the cell has {} bits, so it cannot be {}: a real number needs 64", now.width, value.text);
  return widthProblem(value, now.width);
}

sim::NcCell cellOf(const Value& value) {
  if (value.kind == ValueKind::Text) return {.isText = true, .text = value.text};
  const bool isTooLong = value.number.form == text::NumberForm::TooLong; // a cell that can hold it is a real
  if (value.kind == ValueKind::Real || isTooLong) return {.isReal = true, .bits = std::bit_cast<uint64_t>(value.real)};
  return {.bits = static_cast<uint64_t>(value.integer)};
}

Reading readValue(const Instance& instance, const nc::Control& control, const Ref& place, bool wantReal) {
  if (place.kind == RefKind::Text) {
    Reading reading;
    reading.kind = ValueKind::Text;
    reading.text = control.shownText(instance.readText(place));
    return reading;
  }
  if (wantReal && place.kind == RefKind::Int)
    if (const auto real = runtime::asReal(instance.memory(), place)) return realReading(instance.readReal(*real));
  if (place.kind == RefKind::Real || wantReal) return realReading(instance.readReal(place));
  Reading reading;
  reading.integer = instance.read(place);
  reading.width = place.kind == RefKind::Bit ? 1 : place.kind == RefKind::Constant ? 64 : place.width;
  reading.real = static_cast<double>(asSigned(reading.integer, reading.width));
  return reading;
}

namespace {

// Why a number or a bit cannot hold the value; "" if it can.
std::string numberProblem(const Instance& instance, const Ref& place, const Value& value) {
  if (place.kind == RefKind::Constant) return "a constant cannot be set";
  if (value.kind == ValueKind::Text) return "this name holds a number, not a text";
  if (value.isBit && place.kind != RefKind::Bit)
    return fmt::format("this name is not a bit, so it cannot be {}: expected a number", value.text);
  if (place.kind == RefKind::Bit && value.kind == ValueKind::Real)
    return fmt::format("a bit takes 0 or 1, not {}", value.text);
  if (place.kind == RefKind::Real) return {};
  if (value.kind == ValueKind::Int) return widthProblem(value, place.kind == RefKind::Bit ? 1 : place.width);
  if (runtime::asReal(instance.memory(), place)) return {};
  return fmt::format("this name is an integer of {} bits, so it cannot be {}: expected a whole number, or a name of 64 "
                     "bits, which a real has",
                     place.width, value.text);
}

// The place of a real that the value is written to; nothing if the value is an integer.
std::optional<Ref> realPlace(const Instance& instance, const Ref& place, const Value& value) {
  if (place.kind == RefKind::Real) return place;
  return value.kind == ValueKind::Real ? runtime::asReal(instance.memory(), place) : std::nullopt;
}

} // namespace

std::string valueProblem(const Instance& instance, const Ref& place, const Value& value) {
  if (place.kind != RefKind::Text) return numberProblem(instance, place, value);
  return value.kind == ValueKind::Text ? "" : "this name holds a text: expected a value in quotes";
}

std::string writeValue(Instance& instance, const nc::Control& control, const Ref& place, const Value& value) {
  if (std::string problem = valueProblem(instance, place, value); !problem.empty()) return problem;
  if (place.kind == RefKind::Text) return nc::writeText(instance, place, control.memoryText(value.text, place.count));
  if (const auto real = realPlace(instance, place, value)) return nc::writeReal(instance, *real, value.real);
  return nc::write(instance, place, static_cast<uint64_t>(value.integer));
}

Result<rung_forced_cell> forcedCell(const Instance& instance, const std::string& name, const Ref& place,
                                    const Value& value) {
  if (place.kind == RefKind::Text) return failure("a text cannot be forced");
  if (std::string problem = numberProblem(instance, place, value); !problem.empty()) return failure(std::move(problem));
  rung_forced_cell cell{.name = name.c_str(), .value = {.integer = value.integer}};
  if (realPlace(instance, place, value)) {
    cell.value.real = value.real;
    cell.access = RUNG_REAL;
  }
  return cell;
}

std::string checkValue(const Reading& reading, const Statement& expect) {
  if (expect.value.isBit && (reading.kind != ValueKind::Int || reading.width != 1))
    return fmt::format("{} is not a bit, so it cannot be {}: it is {}; expected a number", expect.name,
                       expect.value.text, show(reading));
  if (reading.kind == ValueKind::Int && !expect.near)
    if (const std::string problem = widthProblem(expect.value, reading.width); !problem.empty())
      return fmt::format("{} is {}, and {}", expect.name, show(reading), problem);
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
  for (const Value* limit : {&expect.value, &expect.high})
    if (reading.kind == ValueKind::Int && limit->number.form == text::NumberForm::TooLong)
      return fmt::format("{} is {}, and {}", expect.name, show(reading), widthProblem(*limit, reading.width));
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

namespace {

// Values of 32 bits, compared modulo 2^32.
std::optional<uint32_t> technolValue(const nc::ShownMessage& message, std::string_view key) {
  if (key == "subid") return static_cast<uint32_t>(message.index);
  if (key == "par1") return static_cast<uint32_t>(message.value);
  if (key == "par2") return message.par2;
  if (key == "par3") return message.par3;
  return std::nullopt;
}

} // namespace

std::string messageDifference(const nc::ShownMessage& message, const std::vector<KeyValue>& keys) {
  for (const KeyValue& key : keys) {
    bool same = true;
    std::string found;
    if (key.key == "text") {
      same = message.text == key.value.text;
      found = "\"" + message.text + "\"";
    } else if (const auto technol = technolValue(message, key.key)) {
      same = *technol == static_cast<uint32_t>(key.value.integer) && text::fitsBits(key.value.number, 32);
      found = std::to_string(*technol);
    } else if (key.key == "channel" || key.key == "index") {
      const int32_t actual = key.key == "index" ? message.index : message.channel;
      same = actual == key.value.integer;
      found = std::to_string(actual);
    } else if (key.key == "value") {
      same = message.real ? std::bit_cast<double>(message.value) == key.value.real : message.value == key.value.integer;
      found = message.real ? fmt::format("{}", std::bit_cast<double>(message.value)) : std::to_string(message.value);
    } else {
      return fmt::format("a message has no property '{}'", key.key);
    }
    if (!same) return fmt::format("message {}: {} is {}, expected {}", message.number, key.key, found, show(key.value));
  }
  return {};
}

std::vector<sim::NcArgument> arguments(const std::vector<KeyValue>& keys) {
  std::vector<sim::NcArgument> out;
  for (const KeyValue& key : keys)
    out.push_back({key.key, key.value.kind == ValueKind::Text, key.value.kind == ValueKind::Real, key.value.integer,
                   key.value.real, key.value.text});
  return out;
}

} // namespace rung::scenario
