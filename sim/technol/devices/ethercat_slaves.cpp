// Simulated EtherCAT slaves (see ethercat_slaves.h).
#include "sim/technol/devices/ethercat_slaves.h"

#include <algorithm>

#include "rung/program.h"

namespace rung::sim::technol {
namespace {

using namespace io::ethercat;

// Of a value with the sign that its limits have.
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

} // namespace rung::sim::technol
