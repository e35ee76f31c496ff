// Simulated EtherCAT slaves.
#include "sim/technol/devices/ethercat_slaves.h"

#include <algorithm>

#include "rtlib/nc/control/technol/identifier.h"
#include "rung/program.h"

namespace rung::sim::technol {

namespace {

using namespace io::ethercat;

// Whether a < b, signed if the object's limits are.
bool isBelow(const EthercatObject& idn, uint64_t a, uint64_t b) {
  if (!idn.isSigned) return a < b;
  const uint32_t shift = 64 - 8 * idn.bytes;
  return static_cast<int64_t>(a << shift) < static_cast<int64_t>(b << shift);
}

uint32_t wrongSize(const EthercatObject& idn, size_t bytes) {
  if (bytes == idn.bytes) return kDone;
  return bytes < idn.bytes ? kSoeTooShort : kSoeTooLong;
}

uint32_t wrongValue(const EthercatObject& idn, uint64_t value) {
  if (isBelow(idn, value, idn.least)) return kSoeTooSmall;
  return isBelow(idn, idn.most, value) ? kSoeTooLarge : kDone;
}

} // namespace

// ---- configuration -----------------------------------------------------------------------------------------------

std::string EthercatSlaves::add(uint32_t number, std::string_view protocols) {
  EthercatProtocols parsed;
  if (!parseProtocols(protocols, parsed).empty() || parsed.voe) return "protocols are coe, soe, joined by +";
  if (number >= kMost) return "there are at most " + std::to_string(kMost) + " slaves";
  if (number > count()) return "slaves are numbered without gaps: the next one is " + std::to_string(count());
  if (number == count()) slaves_.emplace_back();
  slaves_[number].protocols = parsed;
  return {};
}

std::string EthercatSlaves::addObject(const EthercatObject& object) {
  if (object.slave >= count()) return "there is no such device yet";
  if (object.isIdn && isBelow(object, object.most & onesOf(object.bytes), object.least)) return "min is above max";
  if (object.isIdn && wrongValue(object, object.initial) != kDone) return "the value is not within its limits";
  const uint32_t known = find(object.slave, object.isIdn, object.index, object.sub);
  if (known == RUNG_NONE)
    objects_.push_back(object);
  else
    objects_[known] = object;
  return {};
}

void EthercatSlaves::makeDrive(uint32_t number, bool isDrive) {
  EthercatSlave& slave = slaves_[number];
  slave.isDrive = isDrive;
  if (!isDrive) return;
  slave.controlWord = objectOfDrive(number, kControlWord, 2, true);
  slave.statusWord = objectOfDrive(number, kStatusWord, 2, false);
  slave.errorCode = objectOfDrive(number, kErrorCode, 2, false);
}

void EthercatSlaves::giveMotor(uint32_t number, EthercatMotor motor) {
  EthercatSlave& slave = slaves_[number];
  slave.motor = motor;
  slave.target = objectOfDrive(number, motor == EthercatMotor::Position ? kTargetPosition : kTargetVelocity, 4, true);
  slave.actualPosition = objectOfDrive(number, kActualPosition, 4, false);
}

uint32_t EthercatSlaves::objectOfEntry(uint32_t slave, uint32_t index, uint32_t sub) {
  const bool isDriveWord = sub == 0 && (index == kControlWord || index == kStatusWord || index == kErrorCode);
  return isDriveWord ? objectOfDrive(slave, index, 2, index == kControlWord) : find(slave, false, index, sub);
}

uint32_t EthercatSlaves::objectOfDrive(uint32_t slave, uint32_t index, uint32_t bytes, bool mayWrite) {
  const uint32_t known = find(slave, false, index, 0);
  if (known != RUNG_NONE) return known;
  objects_.push_back({.slave = slave, .index = index, .bytes = bytes, .mayWrite = mayWrite});
  return static_cast<uint32_t>(objects_.size()) - 1;
}

uint32_t EthercatSlaves::find(uint32_t slave, bool isIdn, uint32_t index, uint32_t sub) const {
  for (uint32_t i = 0; i < objects_.size(); ++i) {
    const EthercatObject& object = objects_[i];
    if (object.slave == slave && object.isIdn == isIdn && object.index == index && object.sub == sub) return i;
  }
  return RUNG_NONE;
}

bool EthercatSlaves::set(uint32_t object, uint64_t value) {
  if (object == RUNG_NONE) return false;
  objects_[object].value = value & onesOf(objects_[object].bytes);
  return true;
}

// ---- at work -----------------------------------------------------------------------------------------------------

void EthercatSlaves::powerOn() {
  for (EthercatSlave& slave : slaves_) {
    slave.state = State::Init;
    slave.isSilent = false;
    slave.injectedError = 0;
    slave.drive.powerOn();
    slave.rest = 0;
  }
  for (EthercatObject& object : objects_) object.value = object.initial;
}

void EthercatSlaves::tick() {
  for (EthercatSlave& slave : slaves_) {
    if (!slave.isDrive) continue;
    slave.drive.step(static_cast<uint16_t>(objects_[slave.controlWord].value));
    objects_[slave.statusWord].value = slave.drive.status();
    objects_[slave.errorCode].value = slave.drive.error();
    move(slave);
  }
}

void EthercatSlaves::move(EthercatSlave& slave) {
  constexpr int64_t kTicksPerSecond = 1000;
  if (slave.motor == EthercatMotor::None || slave.drive.status() != kOperationEnabled) return;
  const auto target = static_cast<int32_t>(objects_[slave.target].value);
  if (slave.motor == EthercatMotor::Position) {
    set(slave.actualPosition, static_cast<uint64_t>(target));
    return;
  }
  slave.rest += target;
  set(slave.actualPosition, objects_[slave.actualPosition].value + static_cast<uint64_t>(slave.rest / kTicksPerSecond));
  slave.rest %= kTicksPerSecond;
}

// ---- the mailbox -------------------------------------------------------------------------------------------------

uint32_t EthercatSlaves::missing(uint32_t slave, uint32_t index) const {
  const bool known = std::ranges::any_of(
      objects_, [&](const EthercatObject& o) { return o.slave == slave && !o.isIdn && o.index == index; });
  return known ? kSdoNoSubindex : kSdoNoObject;
}

uint32_t EthercatSlaves::upload(uint32_t slave, uint32_t index, uint32_t sub, MailboxData& to) const {
  const uint32_t found = find(slave, false, index, sub);
  if (found == RUNG_NONE) return missing(slave, index);
  const EthercatObject& object = objects_[found];
  if (!object.mayRead) return kSdoWriteOnly;
  to.append(object.value, object.bytes);
  return kDone;
}

uint32_t EthercatSlaves::download(uint32_t slave, uint32_t index, uint32_t sub, std::span<const uint8_t> data) {
  const uint32_t found = find(slave, false, index, sub);
  if (found == RUNG_NONE) return missing(slave, index);
  EthercatObject& object = objects_[found];
  if (!object.mayWrite) return kSdoReadOnly;
  if (data.size() != object.bytes) return kSdoWrongLength;
  object.value = littleEndian(data);
  return kDone;
}

uint32_t EthercatSlaves::readIdn(uint32_t slave, uint32_t drive, uint32_t elements, uint32_t idn,
                                 MailboxData& to) const {
  const uint32_t found = find(slave, true, idn, drive);
  if (found == RUNG_NONE) return kSoeNoIdn;
  if ((elements & 0xFF) == 0) return kSoeWrongElement;
  appendSoeElements(objects_[found], elements, to);
  return kDone;
}

uint32_t EthercatSlaves::writeIdn(uint32_t slave, uint32_t drive, uint32_t elements, uint32_t idn,
                                  std::span<const uint8_t> data) {
  const uint32_t found = find(slave, true, idn, drive);
  if (found == RUNG_NONE) return kSoeNoIdn;
  EthercatObject& object = objects_[found];
  if (elements == 0) return kSoeWrongElement;
  if (elements != kOperationData || !object.mayWrite) return kSoeReadOnly;
  const uint64_t value = littleEndian(data);
  uint32_t wrong = wrongSize(object, data.size());
  if (wrong == kDone) wrong = wrongValue(object, value);
  if (wrong == kDone) object.value = value;
  return wrong;
}

// States of master and slaves.

namespace {

using namespace io::ethercat;

// The state after one step towards `target`; nothing if there is no such change.
std::optional<State> nextState(State from, State target) {
  if (from == target) return from;
  if (target == State::Bootstrap) return from == State::Init ? std::optional(target) : std::nullopt;
  if (from == State::Bootstrap) return target == State::Init ? std::optional(target) : std::nullopt;
  if (target < from) return target;
  if (from == State::Init) return State::PreOperational;
  return from == State::PreOperational ? State::SafeOperational : State::Operational;
}

} // namespace

void EthercatStates::powerOn() {
  master_ = target_ = State::Init;
  slave_.reset();
  stepMs_ = silentMs_ = 0;
  link_ = true;
}

void EthercatStates::start(State target) {
  begin(target, std::nullopt);
  for (Step made = step(); !made.isDone && !made.isRefused && !made.isSilent;) made = step();
}

void EthercatStates::begin(State target, std::optional<uint32_t> slave) {
  target_ = target;
  slave_ = slave;
  stepMs_ = silentMs_ = 0;
}

// ---- one step ----------------------------------------------------------------------------------------------------

EthercatStates::Step EthercatStates::stepOf(EthercatSlave& slave, State goal) {
  if (slave.state == goal) return {};
  if (slave.isSilent) return {.isSilent = true, .isDone = false};
  const std::optional<State> next = nextState(slave.state, goal);
  if (!next || *next == slave.refused) return {.isRefused = true, .isDone = false};
  slave.state = *next;
  return {.isDone = slave.state == goal};
}

// Slaves that accept the goal stay in it even if another slave refuses, which can be found by its state.
EthercatStates::Step EthercatStates::allTo(State goal) {
  Step all;
  for (uint32_t i = 0; i < slaves_.count(); ++i) {
    const Step one = stepOf(slaves_[i], goal);
    all.isRefused |= one.isRefused;
    all.isSilent |= one.isSilent;
    all.isDone &= one.isDone;
  }
  return all;
}

EthercatStates::Step EthercatStates::step() {
  if (slave_) return stepOf(slaves_[*slave_], target_);
  const std::optional<State> goal = nextState(master_, target_);
  if (!goal) return {.isRefused = true, .isDone = false};
  Step made = allTo(*goal);
  if (made.isDone) master_ = *goal;
  made.isDone &= master_ == target_;
  return made;
}

// ---- changes -----------------------------------------------------------------------------------------------------

std::optional<uint32_t> EthercatStates::tick() {
  if (!link_) return kNoSlave;
  if (++stepMs_ < kStepMs) return std::nullopt;
  const Step made = step();
  if (made.isRefused) return kStateRefused;
  if (made.isDone) return kDone;
  silentMs_ = made.isSilent ? silentMs_ + stepMs_ : 0;
  stepMs_ = 0;
  return silentMs_ >= kTimeoutMs ? std::optional<uint32_t>(kTimedOut) : std::nullopt;
}

void EthercatStates::setLink(bool isUp) {
  link_ = isUp;
  if (isUp) return;
  master_ = State::Init;
  for (uint32_t i = 0; i < slaves_.count(); ++i) slaves_[i].state = State::Init;
}

bool EthercatStates::givesInputs(uint32_t slave) const {
  const auto exchanges = [](State state) { return state == State::SafeOperational || state == State::Operational; };
  return link_ && exchanges(master_) && exchanges(slaves_[slave].state) && !slaves_[slave].isSilent;
}

bool EthercatStates::takesOutputs(uint32_t slave) const {
  return givesInputs(slave) && master_ == State::Operational && slaves_[slave].state == State::Operational;
}

// Process image.

namespace {

// The canonical form of a name. In configuration keys a blank is written `_`.
std::string nameOf(std::string_view text) {
  std::string name = nc::technol::canonical(text);
  std::ranges::replace(name, '_', ' ');
  return name;
}

} // namespace

void EthercatImage::add(uint32_t slave, bool isInput, std::string_view name, uint32_t object) {
  Entry made{.slave = slave, .isInput = isInput, .name = nameOf(name), .object = object};
  for (Entry& entry : entries_)
    if (entry.slave == slave && entry.isInput == isInput && entry.name == made.name) {
      entry = std::move(made);
      return;
    }
  entries_.push_back(std::move(made));
}

// Names may contain dots, so whole identifiers are compared.
uint32_t EthercatImage::find(std::string_view identifier) const {
  const std::string wanted = nameOf(identifier);
  for (uint32_t i = 0; i < count(); ++i) {
    const Entry& entry = entries_[i];
    const std::string group = entry.isInput ? ".INPUTS." : ".OUTPUTS.";
    const std::string& slave = slaves_[entry.slave].name;
    if (!slave.empty() && wanted == "ECAT." + nameOf(slave) + group + entry.name) return i;
  }
  return RUNG_NONE;
}

bool EthercatImage::isOfSlave(std::string_view identifier) const {
  const std::string wanted = nameOf(identifier);
  for (uint32_t i = 0; i < slaves_.count(); ++i) {
    const std::string slave = "ECAT." + nameOf(slaves_[i].name) + ".";
    if (!slaves_[i].name.empty() && (wanted.starts_with(slave + "INPUTS.") || wanted.starts_with(slave + "OUTPUTS.")))
      return true;
  }
  return false;
}

void EthercatImage::write(uint32_t entry, uint64_t value) {
  if (entries_[entry].isInput) return;
  entries_[entry].value = value & onesOf(bytesOf(entry));
  entries_[entry].isWritten = true;
}

bool EthercatImage::isExchanged(uint32_t entry) const {
  const Entry& found = entries_[entry];
  return found.isInput ? states_.givesInputs(found.slave) : states_.takesOutputs(found.slave);
}

void EthercatImage::powerOn() {
  for (Entry& entry : entries_) {
    entry.value = 0;
    entry.isWritten = false;
  }
}

// An output that was never written does not change its object, which keeps the value of the mailbox or the
// configuration.
void EthercatImage::putOutputs() {
  for (uint32_t i = 0; i < count(); ++i)
    if (entries_[i].isWritten && isExchanged(i)) slaves_.objectAt(entries_[i].object).value = entries_[i].value;
}

void EthercatImage::takeInputs() {
  for (uint32_t i = 0; i < count(); ++i)
    if (entries_[i].isInput && isExchanged(i)) entries_[i].value = slaves_.objectAt(entries_[i].object).value;
}

} // namespace rung::sim::technol
