// Settings of a serial port (see settings.h).
#include "machine/io/com/settings.h"

#include <span>

#include "rtlib/nc/control/technol/identifier.h"
#include "rtlib/text/letters.h"
#include "rtlib/text/number.h"

namespace rung::io::com {
namespace {

struct Number {
  std::string_view attribute;
  uint32_t Settings::* member;
  uint32_t least, most;
};
constexpr Number kNumbers[] = {{"PhysicalComNo", &Settings::physical, 1, 256},
                               {"ComSpeed", &Settings::speed, 50, 4'000'000},
                               {"ComDataBits", &Settings::dataBits, 7, 8},
                               {"ComStopBits", &Settings::stopBits, 1, 2}};
constexpr std::string_view kParities[] = {"None", "Odd", "Even", "Mark", "Space"};

std::string expected(std::string_view attribute, std::string_view what, std::string_view value) {
  return std::string(attribute) + ": expected " + std::string(what) + ", found '" + std::string(value) + "'";
}

std::string setNumber(Settings& settings, const Number& row, std::string_view value) {
  const auto number = text::wholeIn<uint32_t>(value);
  if (!number || *number < row.least || *number > row.most)
    return expected(row.attribute, std::to_string(row.least) + " to " + std::to_string(row.most), value);
  settings.*row.member = *number;
  return {};
}

std::string setParity(Settings& settings, std::string_view value) {
  for (size_t i = 0; i < std::size(kParities); ++i)
    if (text::equalsIgnoringCase(value, kParities[i])) {
      settings.parity = static_cast<Parity>(i);
      return {};
    }
  return expected("ComParity", "None, Odd, Even, Mark or Space", value);
}

// Both ways to serve a port are the same here.
std::string checkMethod(std::string_view value) {
  const bool known = text::equalsIgnoringCase(value, "Buffered") || text::equalsIgnoringCase(value, "RT");
  return known ? "" : expected("ServiceMethod", "Buffered or RT", value);
}

} // namespace

std::string Settings::set(std::string_view attribute, std::string_view value) {
  for (const Number& row : kNumbers)
    if (text::equalsIgnoringCase(attribute, row.attribute)) return setNumber(*this, row, value);
  if (text::equalsIgnoringCase(attribute, "ComParity")) return setParity(*this, value);
  if (text::equalsIgnoringCase(attribute, "ServiceMethod")) return checkMethod(value);
  if (!text::equalsIgnoringCase(attribute, "Active"))
    return "a serial port has Active, PhysicalComNo, ServiceMethod, ComSpeed, ComDataBits, ComStopBits, ComParity, not "
           "'" +
           std::string(attribute) + "'";
  if (value != "0" && value != "1") return expected("Active", "0 or 1", value);
  isActive = value == "1";
  return {};
}

bool isPortKey(std::string_view key) {
  const std::string name = nc::technol::canonical(key);
  return name.starts_with("COM[") || name.starts_with("COM.");
}

// An index of 0 is the same as none: COM.Active (identifier.h).
std::string readPortKey(std::string_view key, PortKey& port) {
  const std::string name = nc::technol::canonical(key);
  std::string_view rest = name;
  nc::technol::takePrefix(rest, "COM");
  port.number = nc::technol::takeIndex(rest).value_or(0);
  if (!nc::technol::takePrefix(rest, ".") || port.number >= kMostPorts)
    return "'" + std::string(key) + "' is not a serial port's attribute: COM[0].Active to COM[15].Active";
  port.attribute = rest;
  return {};
}

} // namespace rung::io::com
