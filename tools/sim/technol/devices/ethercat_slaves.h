// The simulated EtherCAT slaves: what the configuration says of each, its objects, and what its mailbox answers.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "tools/devices/ethercat/master.h"
#include "tools/sim/ethercat_object.h"
#include "tools/sim/technol/devices/ds402_drive.h"

namespace rung::sim::technol {

using EthercatState = devices::ethercat::State;

struct EthercatSlave {
  // Configuration.
  std::string name; // of ECAT.<name>.…
  EthercatProtocols protocols;
  EthercatState refused = EthercatState::Unknown;          // never entered
  bool isDrive = false;                                    // 6040h, 6041h, 603Fh behave by CiA 402
  uint32_t controlWord = 0, statusWord = 0, errorCode = 0; // of a drive: the numbers of these objects
  // Since the power-on.
  EthercatState state = EthercatState::Init;
  bool isSilent = false;      // answers nothing
  uint32_t injectedError = 0; // what its mailbox answers; 0: as usual
  Ds402Drive drive;

  bool hasMailbox() const { return state != EthercatState::Init && state != EthercatState::Bootstrap; }
};

class EthercatSlaves {
public:
  static constexpr uint32_t kMost = 64;
  static constexpr uint16_t kControlWord = 0x6040, kStatusWord = 0x6041, kErrorCode = 0x603F;

  // Configuration: "" or what is wrong.
  std::string add(uint32_t number, std::string_view protocols);
  std::string addObject(const EthercatObject& object); // or another value of one that is there
  void makeDrive(uint32_t number, bool isDrive);       // adds the objects that are not there
  // Of process data: an object that is there, or a word of a drive, which need not be one yet. RUNG_NONE: none.
  uint32_t objectOfEntry(uint32_t slave, uint32_t index, uint32_t sub);

  uint32_t count() const { return static_cast<uint32_t>(slaves_.size()); }
  EthercatSlave& operator[](uint32_t number) { return slaves_[number]; }
  const EthercatSlave& operator[](uint32_t number) const { return slaves_[number]; }
  // The number of an object, for objectAt; RUNG_NONE: it is not there.
  uint32_t find(uint32_t slave, bool isIdn, uint32_t index, uint32_t sub) const;
  EthercatObject& objectAt(uint32_t number) { return objects_[number]; }
  const EthercatObject& objectAt(uint32_t number) const { return objects_[number]; }

  // What fits in an object, by its number, whatever its access. False: there is none.
  bool set(uint32_t object, uint64_t value);

  void powerOn();
  // One millisecond of the drives.
  void tick();

  // Objects by the mailbox: a code of devices::ethercat. What is read is appended.
  uint32_t upload(uint32_t slave, uint32_t index, uint32_t sub, MailboxData& to) const;
  uint32_t download(uint32_t slave, uint32_t index, uint32_t sub, std::span<const uint8_t> data);
  uint32_t readIdn(uint32_t slave, uint32_t drive, uint32_t elements, uint32_t idn, MailboxData& to) const;
  uint32_t writeIdn(uint32_t slave, uint32_t drive, uint32_t elements, uint32_t idn, std::span<const uint8_t> data);

private:
  uint32_t missing(uint32_t slave, uint32_t index) const;
  uint32_t wordOfDrive(uint32_t slave, uint32_t index, bool mayWrite);

  std::vector<EthercatSlave> slaves_;
  std::vector<EthercatObject> objects_;
};

} // namespace rung::sim::technol
