// What a scenario does to the devices, and what it sees of them (see simulated_devices.h; inventory of the services,
// 15).
#include <cmath>

#include "rtlib/nc/technol/code_page.h"
#include "rtlib/text/letters.h"
#include "rtlib/text/number.h"
#include "tools/sim/technol/requests/scenario_texts.h"
#include "tools/sim/technol/requests/simulated_devices.h"

namespace rung::sim::technol {
namespace {

using Keys = std::span<const NcArgument>;

const NcArgument* find(Keys keys, std::string_view name) {
  for (const NcArgument& key : keys)
    if (text::equalsIgnoringCase(key.key, name)) return &key;
  return nullptr;
}

int64_t number(Keys keys, std::string_view name, int64_t otherwise) {
  const NcArgument* key = find(keys, name);
  return key != nullptr && !key->isText ? key->integer : otherwise;
}
uint32_t unsignedNumber(Keys keys, std::string_view name, uint32_t otherwise = 0) {
  return static_cast<uint32_t>(number(keys, name, otherwise));
}
std::string textOf(Keys keys, std::string_view name) {
  const NcArgument* key = find(keys, name);
  return key != nullptr && key->isText ? key->text : std::string();
}
template <class Value>
std::optional<Value> given(Keys keys, std::string_view name) {
  const NcArgument* key = find(keys, name);
  return key == nullptr ? std::nullopt : std::optional(static_cast<Value>(key->integer));
}

// "" or the first key that the event has not.
std::string unknownKey(Keys keys, std::string_view event, std::string_view known) {
  for (const NcArgument& key : keys) {
    bool found = false;
    for (std::string_view rest = known; !rest.empty();) {
      const size_t end = std::min(rest.find(' '), rest.size());
      found = found || text::equalsIgnoringCase(key.key, rest.substr(0, end));
      rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    if (!found) return std::string(event) + " has no '" + key.key + "': it has " + std::string(known);
  }
  return {};
}

AxisMask axesOf(Keys keys) {
  const int64_t axis = number(keys, "axis", 0);
  if (axis >= 1 && axis <= kMaxAxes) return bitOf(static_cast<uint32_t>(axis - 1));
  return static_cast<AxisMask>(number(keys, "axes", 0));
}

// "" or what is wrong.
std::string editLines(devices::PlcTables& tables, Keys keys) {
  const auto table = given<uint32_t>(keys, "table"), removed = given<uint32_t>(keys, "remove");
  const bool adds = number(keys, "add", 0) == 1;
  if (!table || adds == removed.has_value() || keys.size() != 2)
    return "PLCT needs a table, and add=1 or the number of a line to remove, as in table=0 remove=2";
  return adds ? tables.addLine(*table) : tables.removeLine(*table, *removed);
}

// "" or what is wrong. Both wheels move the axis that is selected, unless they are disabled.
std::string turnHandwheel(Axes& axes, Keys keys) {
  const int64_t pulses = number(keys, "pulses", 0), wheel = number(keys, "wheel", 1);
  if (find(keys, "pulses") == nullptr || pulses != static_cast<int32_t>(pulses))
    return "pulses are a whole number, as in pulses=5";
  if (wheel != 1 && wheel != 2) return "the handwheels are 1 and 2";
  axes.handwheel(pulses, static_cast<uint32_t>(wheel));
  return {};
}

// "4.RefSpeed": the axis and the rest; 0 where there is none.
uint32_t takeNumber(std::string_view& rest) {
  const size_t end = std::min(rest.find('.'), rest.size());
  const bool hex = rest.substr(0, end).starts_with("0x");
  const auto number =
      hex ? text::numberIn<uint32_t>(rest.substr(2, end - 2), 16) : text::numberIn<uint32_t>(rest.substr(0, end));
  rest.remove_prefix(std::min(end + 1, rest.size()));
  return number.value_or(UINT32_MAX);
}

} // namespace

std::optional<std::string> SimulatedDevices::event(host::Instance& instance, std::string_view name, Keys keys) {
  const auto is = [&](std::string_view event) { return text::equalsIgnoringCase(name, event); };
  const auto checked = [&](std::string_view known, auto act) -> std::optional<std::string> {
    if (std::string wrong = unknownKey(keys, name, known); !wrong.empty()) return wrong;
    return std::string(act());
  };
  if (is("SA_LOCK"))
    return checked("area on", [&] {
      const bool held =
          find(keys, "area") != nullptr && areas_.hold(unsignedNumber(keys, "area"), number(keys, "on", 1) != 0);
      return std::string(held ? "" : "there is no such shared area");
    });
  if (is("PLCT")) return checked("table add remove", [&] { return editLines(tables_, keys); });
  if (const auto done = portEvent(name, keys)) return done;
  if (!simulated_) return std::nullopt;
  if (is("STOP"))
    return checked("emergency", [&] { return axes_.stop(number(keys, "emergency", 0) != 0), std::string(); });
  if (is("REFERENCE"))
    return checked("axis axes type", [&] { return axes_.reference(textOf(keys, "type"), axesOf(keys)); });
  if (is("AUTMAN")) return checked("on", [&] { return axes_.autman(number(keys, "on", 1) != 0), std::string(); });
  if (is("RTM"))
    return checked("command state", [&] { return axes_.rtm(textOf(keys, "command"), number(keys, "state", 1) != 0); });
  if (is("KEY")) return keyEvent(instance, keys);
  if (is("handwheel")) return checked("pulses wheel", [&] { return turnHandwheel(axes_, keys); });
  return std::nullopt;
}

// ---- quantities ----------------------------------------------------------------------------------------------------

std::optional<double> SimulatedDevices::quantity(std::string_view name) const {
  if (!simulated_) return std::nullopt;
  if (text::equalsIgnoringCase(name, "MAINSPINDLE")) return axes_.mainSpindle();
  if (text::equalsIgnoringCase(name, "ECSTATE")) return static_cast<double>(ethercat_.state());
  const auto ofAxis = [&](std::string_view prefix, auto value) -> std::optional<double> {
    std::string_view rest = name;
    if (!takePrefix(rest, prefix)) return std::nullopt;
    const uint32_t axis = takeNumber(rest);
    return axes_.exists(axis) && rest.empty() ? std::optional<double>(value(axis)) : std::nullopt;
  };
  if (auto v = ofAxis("MPOS.", [&](uint32_t axis) { return axes_.measured(axis); })) return v;
  if (auto v = ofAxis("TRUE.", [&](uint32_t axis) { return axes_.physical(axis); })) return v;
  if (auto v = ofAxis("SPEED.", [&](uint32_t axis) { return axes_.speedPerMinute(axis); })) return v;
  if (auto v = ofAxis("SPINDLE.", [&](uint32_t axis) { return axes_.spindleRole(axis); })) return v;
  if (auto v = ofAxis("REGUL.", [&](uint32_t axis) { return axes_.regulator(axis); })) return v;
  std::string_view rest = name;
  const auto asReal = [](auto value) { return value ? std::optional(static_cast<double>(*value)) : std::nullopt; };
  if (takePrefix(rest, "ECSTATE.")) return asReal(ethercat_.slaveState(takeNumber(rest)));
  const auto three = [&](auto act) {
    const uint32_t a = takeNumber(rest), b = takeNumber(rest), c = takeNumber(rest);
    return act(a, b, c);
  };
  if (takePrefix(rest, "DRIVE."))
    return asReal(three([&](auto a, auto b, auto c) { return can_.driveObject(a, b, c); }));
  if (takePrefix(rest, "ETHERCAT."))
    return asReal(three([&](auto a, auto b, auto c) { return ethercat_.object(a, b, c); }));
  if (takePrefix(rest, "IDN.")) return asReal(three([&](auto a, auto b, auto c) { return ethercat_.idn(a, b, c); }));
  return std::nullopt;
}

std::optional<std::string> SimulatedDevices::setQuantity(std::string_view name, double value) {
  if (!simulated_) return std::nullopt;
  std::string_view rest = name;
  const bool measured = takePrefix(rest, "MPOS.");
  if (measured || takePrefix(rest, "TRUE.")) {
    const uint32_t axis = takeNumber(rest);
    if (!axes_.exists(axis)) return "there is no axis of this number";
    if (!(std::fabs(value) <= kFarthest)) return "a place is a number of -1e9 to 1e9";
    measured ? axes_.setMeasured(axis, value) : axes_.setPhysical(axis, value);
    return std::string();
  }
  const bool object = takePrefix(rest, "ETHERCAT.");
  if (!object && !takePrefix(rest, "IDN.")) {
    if (!quantity(name)) return std::nullopt;
    return "it is what a device does; set are NC.MPOS, NC.TRUE, NC.ETHERCAT and NC.IDN";
  }
  const uint32_t a = takeNumber(rest), b = takeNumber(rest), c = takeNumber(rest);
  const auto bits = static_cast<uint64_t>(static_cast<int64_t>(std::llround(value)));
  const bool done = object ? ethercat_.setObject(a, b, c, bits) : ethercat_.setIdn(a, b, c, bits);
  return std::string(done ? "" : "there is no such object");
}

} // namespace rung::sim::technol
