// What a scenario does to the devices, and what it sees of them (see simulated_devices.h; inventory of the services,
// 15).
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "machine/io/key_text.h"
#include "rtlib/text/letters.h"
#include "rtlib/text/number.h"
#include "sim/technol/requests/simulated_devices.h"

namespace rung::sim::technol {
namespace {

constexpr std::string_view kKey = "KEY";
constexpr EventKey kAreaKeys[] = {required({"area", 0, io::SharedAreas::kAreas - 1}), {"on"}};
constexpr EventKey kTableKeys[] = {
    required({"table", 0, io::PlcTables::kTables - 1}), {"add"}, {"remove", 0, io::PlcTables::kMostLines - 1}};
constexpr EventKey kStopKeys[] = {{"emergency"}};
constexpr EventKey kReferenceKeys[] = {{"axis", 1, kMaxAxes}, {"axes", 0, (1u << kMaxAxes) - 1}, textKey("type")};
constexpr EventKey kManualKeys[] = {{"on"}};
constexpr EventKey kCommandKeys[] = {required(textKey("command")), {"state"}};
constexpr EventKey kHandwheelKeys[] = {required({"pulses", INT32_MIN, INT32_MAX}), {"wheel", 1, 2}};

// "2.0x6041.0": the number before the point, which both go away; UINT32_MAX where there is none.
uint32_t takePart(std::string_view& rest) {
  return text::wholeIn<uint32_t>(io::takeUntil(rest, '.')).value_or(UINT32_MAX);
}

} // namespace

// ---- events --------------------------------------------------------------------------------------------------------

std::string SimulatedDevices::areaEvent(const EventKeys& keys) {
  const bool held = areas_.hold(*keys.number<uint32_t>("area"), keys.number<bool>("on").value_or(true));
  return held ? "" : "there is no such shared area";
}

std::string SimulatedDevices::tableEvent(const EventKeys& keys) {
  const auto table = *keys.number<uint32_t>("table");
  const auto removed = keys.number<uint32_t>("remove");
  const bool adds = keys.number<bool>("add").value_or(false);
  if (adds == removed.has_value()) return "either add=1, or remove with the number of a line, as in table=0 remove=2";
  return adds ? tables_.addLine(table) : tables_.removeLine(table, *removed);
}

std::string SimulatedDevices::stopEvent(const EventKeys& keys) {
  axes_.stop(keys.number<bool>("emergency").value_or(false));
  return {};
}

std::string SimulatedDevices::referenceEvent(const EventKeys& keys) {
  const auto axis = keys.number<uint32_t>("axis");
  const AxisMask axes = axis ? bitOf(*axis - 1) : keys.number<AxisMask>("axes").value_or(0);
  return axes_.reference(keys.text("type"), axes);
}

std::string SimulatedDevices::manualEvent(const EventKeys& keys) {
  axes_.autman(keys.number<bool>("on").value_or(true));
  return {};
}

std::string SimulatedDevices::commandEvent(const EventKeys& keys) {
  return axes_.rtm(keys.text("command"), keys.number<bool>("state").value_or(true));
}

// Both wheels move the axis that is selected, unless they are disabled.
std::string SimulatedDevices::handwheelEvent(const EventKeys& keys) {
  axes_.handwheel(*keys.number<int64_t>("pulses"), keys.number<uint32_t>("wheel").value_or(1));
  return {};
}

std::span<const SimulatedDevices::Event> SimulatedDevices::deviceEvents() {
  static constexpr Event kEvents[] = {{"SA_LOCK", kAreaKeys, &SimulatedDevices::areaEvent, true},
                                      {"PLCT", kTableKeys, &SimulatedDevices::tableEvent, true},
                                      {"STOP", kStopKeys, &SimulatedDevices::stopEvent},
                                      {"REFERENCE", kReferenceKeys, &SimulatedDevices::referenceEvent},
                                      {"AUTMAN", kManualKeys, &SimulatedDevices::manualEvent},
                                      {"RTM", kCommandKeys, &SimulatedDevices::commandEvent},
                                      {"handwheel", kHandwheelKeys, &SimulatedDevices::handwheelEvent}};
  return kEvents;
}

std::vector<std::string_view> SimulatedDevices::events() const {
  std::vector<std::string_view> names{kKey};
  for (const std::span<const Event> events : {deviceEvents(), portEvents()})
    for (const Event& event : events) names.push_back(event.name);
  return names;
}

std::optional<std::string> SimulatedDevices::event(runtime::Instance& instance, std::string_view name,
                                                   std::span<const NcArgument> given) {
  if (simulated_ && text::equalsIgnoringCase(name, kKey)) return keyEvent(instance, given);
  if (const auto done = oneOf(deviceEvents(), name, given)) return done;
  return oneOf(portEvents(), name, given);
}

std::optional<std::string> SimulatedDevices::oneOf(std::span<const Event> events, std::string_view name,
                                                   std::span<const NcArgument> given) {
  const auto event =
      std::ranges::find_if(events, [&](const Event& known) { return text::equalsIgnoringCase(known.name, name); });
  if (event == events.end()) return std::nullopt;
  if (!simulated_ && !event->isScripted)
    return std::string(event->name) + " is of simulated devices: `config nc simulated` is missing";
  if (std::string wrong = wrongKeys(event->name, given, event->keys); !wrong.empty()) return wrong;
  const std::string wrong = (this->*event->act)(EventKeys(given));
  return wrong.empty() ? wrong : std::string(event->name) + ": " + wrong;
}

// ---- quantities ----------------------------------------------------------------------------------------------------

std::optional<double> SimulatedDevices::quantity(std::string_view name) const {
  if (!simulated_) return std::nullopt;
  if (text::equalsIgnoringCase(name, "MAINSPINDLE")) return axes_.mainSpindle();
  if (text::equalsIgnoringCase(name, "ECSTATE")) return static_cast<double>(ethercat_.state());
  const auto ofAxis = [&](std::string_view prefix, auto value) -> std::optional<double> {
    std::string_view rest = name;
    if (!text::takePrefixIgnoringCase(rest, prefix)) return std::nullopt;
    const uint32_t axis = takePart(rest);
    return axes_.exists(axis) && rest.empty() ? std::optional<double>(value(axis)) : std::nullopt;
  };
  if (auto v = ofAxis("MPOS.", [&](uint32_t axis) { return axes_.measured(axis); })) return v;
  if (auto v = ofAxis("TRUE.", [&](uint32_t axis) { return axes_.physical(axis); })) return v;
  if (auto v = ofAxis("SPEED.", [&](uint32_t axis) { return axes_.speedPerMinute(axis); })) return v;
  if (auto v = ofAxis("SPINDLE.", [&](uint32_t axis) { return axes_.spindleRole(axis); })) return v;
  if (auto v = ofAxis("REGUL.", [&](uint32_t axis) { return axes_.regulator(axis); })) return v;
  std::string_view rest = name;
  const auto asReal = [](auto value) { return value ? std::optional(static_cast<double>(*value)) : std::nullopt; };
  if (text::takePrefixIgnoringCase(rest, "ECSTATE.")) return asReal(ethercat_.slaveState(takePart(rest)));
  const auto three = [&](auto act) {
    const uint32_t a = takePart(rest), b = takePart(rest), c = takePart(rest);
    return act(a, b, c);
  };
  if (text::takePrefixIgnoringCase(rest, "DRIVE."))
    return asReal(three([&](auto a, auto b, auto c) { return can_.driveObject(a, b, c); }));
  if (text::takePrefixIgnoringCase(rest, "ETHERCAT."))
    return asReal(three([&](auto a, auto b, auto c) { return ethercat_.object(a, b, c); }));
  if (text::takePrefixIgnoringCase(rest, "IDN."))
    return asReal(three([&](auto a, auto b, auto c) { return ethercat_.idn(a, b, c); }));
  return std::nullopt;
}

std::optional<std::string> SimulatedDevices::setQuantity(std::string_view name, double value) {
  if (!simulated_) return std::nullopt;
  std::string_view rest = name;
  const bool measured = text::takePrefixIgnoringCase(rest, "MPOS.");
  if (measured || text::takePrefixIgnoringCase(rest, "TRUE.")) {
    const uint32_t axis = takePart(rest);
    if (!axes_.exists(axis)) return "there is no axis of this number";
    if (!(std::fabs(value) <= kFarthest)) return "a place is a number of -1e9 to 1e9";
    measured ? axes_.setMeasured(axis, value) : axes_.setPhysical(axis, value);
    return std::string();
  }
  const bool object = text::takePrefixIgnoringCase(rest, "ETHERCAT.");
  if (!object && !text::takePrefixIgnoringCase(rest, "IDN.")) {
    if (!quantity(name)) return std::nullopt;
    return "it is what a device does; set are NC.MPOS, NC.TRUE, NC.ETHERCAT and NC.IDN";
  }
  const uint32_t a = takePart(rest), b = takePart(rest), c = takePart(rest);
  const auto bits = static_cast<uint64_t>(static_cast<int64_t>(std::llround(value)));
  const bool done = object ? ethercat_.setObject(a, b, c, bits) : ethercat_.setIdn(a, b, c, bits);
  return std::string(done ? "" : "there is no such object");
}

} // namespace rung::sim::technol
