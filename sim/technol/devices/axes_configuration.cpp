// Configuration of the axes (see axes.h).
#include <algorithm>
#include <array>
#include <cmath>

#include "rtlib/text/number.h"
#include "sim/technol/devices/axes.h"

namespace rung::sim::technol {
namespace {

// "" or what is wrong with the letters of axes.
std::string problemOf(std::string_view letters) {
  if (letters.empty() || letters.size() > kMaxAxes) return "'axes' needs 1 to 16 letters";
  for (size_t i = 0; i < letters.size(); ++i) {
    if (letters[i] < 'A' || letters[i] > 'Z')
      return "'axes' needs capital letters; found '" + std::string(letters) + "'";
    if (letters.find(letters[i], i + 1) != std::string_view::npos)
      return "'axes' has the letter '" + std::string(1, letters[i]) + "' twice";
  }
  return {};
}

std::string_view takeWord(std::string_view& text) {
  const size_t begin = std::min(text.find_first_not_of(' '), text.size());
  const size_t end = std::min(text.find(' ', begin), text.size());
  const std::string_view word = text.substr(begin, end - begin);
  text.remove_prefix(end);
  return word;
}

} // namespace

std::string Axes::configure(std::string_view key, std::string_view value) {
  if (key == "axes") {
    std::string problem = problemOf(value);
    if (problem.empty()) letters_ = value;
    return problem;
  }
  if (!io::isAxisKey(key)) return "the axes have no key '" + std::string(key) + "'";
  io::AxisKey own;
  if (std::string wrong = readAxisKey(key, own); !wrong.empty()) return wrong;
  configured_.emplace(own.axis, key);
  return axes_[own.axis - 1].attributes.set(own.attribute, value);
}

std::string Axes::configurationProblem() const {
  for (const auto& [axis, key] : configured_)
    if (!exists(axis))
      return "'" + key + "' is for axis " + std::to_string(axis) + "; the axes are " + letters_ + ", 1 to " +
             std::to_string(count()) + " (config axes)";
  return {};
}

std::string Axes::addSwitch(uint64_t bit, std::string_view value) {
  std::string_view rest = value;
  const auto axis = text::wholeIn<uint32_t>(takeWord(rest));
  const auto low = text::realIn(takeWord(rest));
  const auto high = text::realIn(takeWord(rest));
  if (!axis || *axis < 1 || *axis > kMaxAxes || !low || !high || *low > *high || !takeWord(rest).empty())
    return "a switch needs an axis and two places, the lower first: '1 -1000 -5'; found '" + std::string(value) + "'";
  configured_.emplace(*axis, "switch " + std::string(value));
  switches_.push_back({.bit = bit, .axis = *axis, .low = *low, .high = *high});
  return {};
}

// A rotary axis passes its switch in each revolution: of its equal places it is the first one from `low` on.
bool Axes::isClosed(const Switch& contact) const {
  const Axis& axis = axes_[contact.axis - 1];
  const double place = axis.physical();
  if (axis.attributes.rotary == 0) return place >= contact.low && place <= contact.high;
  return place + kDegreesPerTurn * std::ceil((contact.low - place) / kDegreesPerTurn) <= contact.high;
}

} // namespace rung::sim::technol
