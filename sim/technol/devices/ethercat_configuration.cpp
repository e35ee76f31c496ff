// Configuration, events and quantities of the simulated EtherCAT net (see ethercat.h).
#include <algorithm>

#include "rtlib/text/number.h"
#include "rung/program.h"
#include "sim/technol/devices/ethercat.h"

namespace rung::sim::technol {
namespace {

using namespace io::ethercat;

constexpr std::string_view kPrefix = "ethercat.";

// The text up to `end`, which loses it and the `end`; all of it where it has none.
std::string_view takeUpTo(std::string_view& text, char end) {
  const std::string_view taken = text.substr(0, text.find(end));
  text.remove_prefix(std::min(text.size(), taken.size() + 1));
  return taken;
}

std::string setFlag(bool& flag, std::string_view value) {
  if (value != "0" && value != "1") return "expected 0 or 1, found '" + std::string(value) + "'";
  flag = value == "1";
  return {};
}

// "-100" or "0x64", as an object of so many bytes holds it. Below 0 it makes the value signed, and a limit that is not
// given the last one with a sign.
std::string setLimit(EthercatObject& object, std::string_view text, uint64_t& limit) {
  EthercatObject limited;
  if (std::string wrong = parseObjectValue(std::string(text) + "/" + std::to_string(object.bytes), limited);
      !wrong.empty())
    return "the limit: " + wrong;
  if (text.starts_with('-') && !object.isSigned) {
    object.isSigned = true;
    object.most = std::min(object.most, onesOf(object.bytes) / 2);
    if (object.least == 0) object.least = onesOf(object.bytes) / 2 + 1;
  }
  limit = limited.value;
  return {};
}

// "ro", "wo", "min=0", "max=100" after the value.
std::string setOption(EthercatObject& object, std::string_view option) {
  if (option == "ro") return object.mayWrite = false, "";
  if (option == "wo" && !object.isIdn) return object.mayRead = false, "";
  if (object.isIdn && option.starts_with("min=")) return setLimit(object, option.substr(4), object.least);
  if (object.isIdn && option.starts_with("max=")) return setLimit(object, option.substr(4), object.most);
  return "'" + std::string(option) + "' is not an option: " + (object.isIdn ? "ro, min=, max=" : "ro, wo");
}

} // namespace

// ---- keys --------------------------------------------------------------------------------------------------------

bool EtherCat::owns(std::string_view key) {
  return key.starts_with(kPrefix) || key == "EtherCATOPViaPLC" || key == "EtherCATDelayOP";
}

std::string EtherCat::configure(std::string_view key, std::string_view value) {
  std::string wrong = "unknown key";
  if (key == "EtherCATOPViaPLC") {
    wrong = setFlag(byProgram_, value);
  } else if (key == "EtherCATDelayOP") {
    const auto delay = text::wholeIn<uint32_t>(value);
    const bool fits = delay && *delay <= kMostDelayMs;
    wrong = fits ? "" : "expected 0 to " + std::to_string(kMostDelayMs) + " milliseconds";
    if (fits) delayMs_ = *delay;
  } else if (key.starts_with(kPrefix)) {
    wrong = configureSlave(key.substr(kPrefix.size()), value);
  }
  return wrong.empty() ? wrong : std::string(key) + ": " + wrong;
}

// "0", "0.name", "0.coe.0x6041.0", "0.pdo.Inputs.Status_word".
std::string EtherCat::configureSlave(std::string_view place, std::string_view value) {
  std::string_view rest = place;
  const auto number = text::numberIn<uint32_t>(takeUpTo(rest, '.'));
  if (!number) return "expected ethercat.DEVICE, a number from 0";
  if (rest.empty()) return slaves_.add(*number, value);
  if (*number >= slaves_.count()) return "there is no such device yet";
  std::string_view attribute = rest;
  const std::string_view first = takeUpTo(attribute, '.');
  if (first == "coe" || first == "soe") return configureObject(place, value);
  if (first == "pdo") return configureEntry(*number, attribute, value);
  return configureAttribute(*number, rest, value);
}

std::string EtherCat::configureAttribute(uint32_t slave, std::string_view attribute, std::string_view value) {
  if (attribute == "name") return setName(slave, value);
  if (attribute == "refuse") return setRefused(slave, value);
  if (attribute == "motor") return setMotor(slave, value);
  if (attribute != "ds402")
    return "a device has coe, soe, pdo, name, refuse, ds402, motor, not '" + std::string(attribute) + "'";
  bool isDrive = false;
  std::string wrong = setFlag(isDrive, value);
  if (!wrong.empty()) return wrong;
  if (isDrive && !slaves_[slave].protocols.coe) return "a drive by CiA 402 needs the protocol coe";
  slaves_.makeDrive(slave, isDrive);
  return {};
}

std::string EtherCat::setMotor(uint32_t slave, std::string_view value) {
  if (value != "position" && value != "velocity")
    return "a motor follows position or velocity, not '" + std::string(value) + "'";
  if (!slaves_[slave].isDrive) return "a motor needs a drive: ds402 1 before it";
  slaves_.giveMotor(slave, value == "position" ? EthercatMotor::Position : EthercatMotor::Velocity);
  return {};
}

std::string EtherCat::setName(uint32_t slave, std::string_view name) {
  if (name.empty()) return "expected a name";
  for (uint32_t i = 0; i < slaves_.count(); ++i)
    if (i != slave && slaves_[i].name == name) return "device " + std::to_string(i) + " has this name";
  slaves_[slave].name = name;
  return {};
}

// INIT, where all begin, is refused by none.
std::string EtherCat::setRefused(uint32_t slave, std::string_view value) {
  const auto number = text::wholeIn<uint32_t>(value);
  const State state = number && *number <= 8 ? stateOf(*number) : State::Unknown;
  const bool fits = number && (*number == 0 || (state != State::Unknown && state != State::Init));
  if (!fits) return "expected a state, 2, 3, 4 or 8, or 0 for none";
  slaves_[slave].refused = state;
  return {};
}

std::string EtherCat::configureObject(std::string_view place, std::string_view value) {
  EthercatObject object;
  std::string wrong = parseObjectPlace(place, object);
  if (wrong.empty()) wrong = parseObjectValue(takeUpTo(value, ' '), object);
  while (wrong.empty() && !value.empty())
    if (const std::string_view option = takeUpTo(value, ' '); !option.empty()) wrong = setOption(object, option);
  if (!wrong.empty()) return wrong;
  const EthercatProtocols& spoken = slaves_[object.slave].protocols;
  if (!(object.isIdn ? spoken.soe : spoken.coe)) return "the device does not have this protocol";
  return slaves_.addObject(object);
}

// "Inputs.Status_word" and "0x6041.0".
std::string EtherCat::configureEntry(uint32_t slave, std::string_view place, std::string_view value) {
  const std::string_view group = takeUpTo(place, '.');
  if ((group != "Inputs" && group != "Outputs") || place.empty())
    return "expected pdo.Inputs.ENTRY or pdo.Outputs.ENTRY";
  EthercatObject object;
  const std::string wanted = std::to_string(slave) + ".coe." + std::string(value);
  if (!parseObjectPlace(wanted, object).empty()) return "expected INDEX.SUBINDEX of an object";
  const uint32_t found = slaves_.objectOfEntry(slave, object.index, object.sub);
  if (found == RUNG_NONE) return "there is no object " + std::string(value) + " yet";
  image_.add(slave, group == "Inputs", place, found);
  return {};
}

// ---- events ------------------------------------------------------------------------------------------------------

std::string EtherCat::unknownSlave(uint32_t slave) const {
  return slave < slaves_.count() ? "" : "there is no EtherCAT device " + std::to_string(slave);
}

std::string EtherCat::setError(uint32_t slave, uint32_t code) {
  std::string wrong = unknownSlave(slave);
  if (wrong.empty()) slaves_[slave].injectedError = code;
  return wrong;
}

std::string EtherCat::setSilent(uint32_t slave, bool isSilent) {
  std::string wrong = unknownSlave(slave);
  if (wrong.empty()) slaves_[slave].isSilent = isSilent;
  return wrong;
}

std::string EtherCat::fault(uint32_t slave, uint32_t code) {
  if (std::string wrong = unknownSlave(slave); !wrong.empty()) return wrong;
  if (!slaves_[slave].isDrive) return "EtherCAT device " + std::to_string(slave) + " is not a drive: ds402 1";
  if (code > 0xFFFF) return "an error code of a drive has 16 bits";
  slaves_[slave].drive.fault(static_cast<uint16_t>(code));
  return {};
}

// ---- quantities --------------------------------------------------------------------------------------------------

std::optional<uint64_t> EtherCat::object(uint32_t slave, uint32_t index, uint32_t sub) const {
  const uint32_t found = slaves_.find(slave, false, index, sub);
  return found == RUNG_NONE ? std::nullopt : std::optional(slaves_.objectAt(found).value);
}

std::optional<uint64_t> EtherCat::idn(uint32_t slave, uint32_t idn, uint32_t drive) const {
  const uint32_t found = slaves_.find(slave, true, idn, drive);
  return found == RUNG_NONE ? std::nullopt : std::optional(slaves_.objectAt(found).value);
}

bool EtherCat::setObject(uint32_t slave, uint32_t index, uint32_t sub, uint64_t value) {
  return slaves_.set(slaves_.find(slave, false, index, sub), value);
}

bool EtherCat::setIdn(uint32_t slave, uint32_t idn, uint32_t drive, uint64_t value) {
  return slaves_.set(slaves_.find(slave, true, idn, drive), value);
}

std::optional<EthercatState> EtherCat::slaveState(uint32_t slave) const {
  return slave < slaves_.count() ? std::optional(slaves_[slave].state) : std::nullopt;
}

} // namespace rung::sim::technol
