// The simulated EtherCAT slaves: their configuration, their objects, and the answers of their mailboxes.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "machine/io/ethercat/master.h"
#include "sim/ethercat_object.h"
#include "sim/technol/devices/ds402_drive.h"

namespace rung::sim::technol {

using EthercatState = io::ethercat::State;

// The object that the motor of an enabled drive follows: 607Ah in increments, or 60FFh in increments per second
// (TECHNOL manual, l.10346, l.10736); 6064h is the actual position.
enum class EthercatMotor : uint8_t { None, Position, Velocity };

struct EthercatSlave {
  // Configuration.
  std::string name; // of ECAT.<name>.…
  EthercatProtocols protocols;
  EthercatState refused = EthercatState::Unknown;          // never entered
  bool isDrive = false;                                    // 6040h, 6041h, 603Fh behave as in CiA 402
  uint32_t controlWord = 0, statusWord = 0, errorCode = 0; // of a drive: numbers of these objects
  EthercatMotor motor = EthercatMotor::None;
  uint32_t target = 0, actualPosition = 0; // of a motor: numbers of 607Ah or 60FFh, and of 6064h
  // State since the power-on.
  EthercatState state = EthercatState::Init;
  bool isSilent = false;      // does not answer
  uint32_t injectedError = 0; // error code of its mailbox; 0: normal answers
  Ds402Drive drive;
  int64_t rest = 0; // remainder of a motor that follows a velocity: 1/1000 increment

  bool hasMailbox() const { return state != EthercatState::Init && state != EthercatState::Bootstrap; }
};

class EthercatSlaves {
public:
  static constexpr uint32_t kMost = 64;
  static constexpr uint16_t kControlWord = 0x6040, kStatusWord = 0x6041, kErrorCode = 0x603F;
  static constexpr uint16_t kActualPosition = 0x6064, kTargetPosition = 0x607A, kTargetVelocity = 0x60FF;

  // Configuration. The functions with a result return "", or the error.
  std::string add(uint32_t number, std::string_view protocols);
  std::string addObject(const EthercatObject& object);  // or changes the value of an existing one
  void makeDrive(uint32_t number, bool isDrive);        // adds missing objects
  void giveMotor(uint32_t number, EthercatMotor motor); // adds missing objects
  // The object for process data: an existing one, or a word of a drive, which need not be configured as one yet.
  // RUNG_NONE: there is none.
  uint32_t objectOfEntry(uint32_t slave, uint32_t index, uint32_t sub);

  uint32_t count() const { return static_cast<uint32_t>(slaves_.size()); }
  EthercatSlave& operator[](uint32_t number) { return slaves_[number]; }
  const EthercatSlave& operator[](uint32_t number) const { return slaves_[number]; }
  // The number of an object, for objectAt; RUNG_NONE: there is no such object.
  uint32_t find(uint32_t slave, bool isIdn, uint32_t index, uint32_t sub) const;
  EthercatObject& objectAt(uint32_t number) { return objects_[number]; }
  const EthercatObject& objectAt(uint32_t number) const { return objects_[number]; }

  // Sets an object by its number, regardless of its access rights, if the value fits. Returns false if there is no such
  // object.
  bool set(uint32_t object, uint64_t value);

  void powerOn();
  // One millisecond of the drives.
  void tick();

  // Mailbox access to objects: return a code of io::ethercat. Data read are appended.
  uint32_t upload(uint32_t slave, uint32_t index, uint32_t sub, MailboxData& to) const;
  uint32_t download(uint32_t slave, uint32_t index, uint32_t sub, std::span<const uint8_t> data);
  uint32_t readIdn(uint32_t slave, uint32_t drive, uint32_t elements, uint32_t idn, MailboxData& to) const;
  uint32_t writeIdn(uint32_t slave, uint32_t drive, uint32_t elements, uint32_t idn, std::span<const uint8_t> data);

  template <class Archive>
  void state(Archive& archive) {
    for (EthercatSlave& slave : slaves_)
      archive(slave.state, slave.isSilent, slave.injectedError, slave.drive, slave.rest);
    archive.each(objects_);
  }

private:
  uint32_t missing(uint32_t slave, uint32_t index) const;
  uint32_t objectOfDrive(uint32_t slave, uint32_t index, uint32_t bytes, bool mayWrite);
  void move(EthercatSlave& slave);

  std::vector<EthercatSlave> slaves_;
  std::vector<EthercatObject> objects_;
};

// The states of the simulated EtherCAT master and of its slaves (TECHNOL manual 26.3, l.17937-17955). A step takes 10
// ms: upwards through the intermediate states, downwards at once, BOOTSTRAP only from INIT and back to it.

class EthercatStates {
public:
  static constexpr uint32_t kStepMs = 10;
  static constexpr uint32_t kTimeoutMs = 1000; // time after which a silent slave counts as not responding

  explicit EthercatStates(EthercatSlaves& slaves) : slaves_(slaves) {}

  // To be called at a power-on, after that of the slaves: all are in INIT.
  void powerOn();
  // Starts the master as the control does: immediately, as far up as the slaves permit.
  void start(EthercatState target);

  // Begins a change of state: of the master with all slaves, or of one slave. One change at a time.
  void begin(EthercatState target, std::optional<uint32_t> slave);
  // One millisecond of the change: returns its code once it has ended.
  std::optional<uint32_t> tick();
  // The cable: while it is disconnected, all are in INIT, and changes end with kNoSlave.
  void setLink(bool isUp);

  EthercatState master() const { return master_; }
  bool hasLink() const { return link_; }
  // Whether a slave exchanges process data.
  bool givesInputs(uint32_t slave) const;
  bool takesOutputs(uint32_t slave) const;

  template <class Archive>
  void state(Archive& archive) {
    archive(master_, target_, slave_, stepMs_, silentMs_, link_);
    archive.require(!slave_ || *slave_ < slaves_.count());
  }

private:
  struct Step {
    bool isRefused = false;
    bool isSilent = false; // a slave does not answer
    bool isDone = true;    // all have reached the state
  };
  static Step stepOf(EthercatSlave& slave, EthercatState goal);
  Step step();
  Step allTo(EthercatState goal);

  EthercatSlaves& slaves_;
  EthercatState master_ = EthercatState::Init;
  EthercatState target_ = EthercatState::Init; // target of the change in progress
  std::optional<uint32_t> slave_;              // nothing: a change of the master
  uint32_t stepMs_ = 0;
  uint32_t silentMs_ = 0;
  bool link_ = true;
};

// The process image of the simulated EtherCAT network (TECHNOL manual 26.2, l.17763-17786, l.17872-17904): entries of
// the slaves, named ECAT.<slave>.Inputs.<entry> and ECAT.<slave>.Outputs.<entry> in connections, each bound to an
// object.

class EthercatImage {
public:
  struct Entry {
    uint32_t slave = 0;
    bool isInput = false; // from the slave to the control
    std::string name;     // result of nameOf
    uint32_t object = 0;  // number of the object among those of the slaves
    uint64_t value = 0;
    bool isWritten = false; // an output written since the power-on
    template <class Archive>
    void state(Archive& archive) {
      archive(value, isWritten);
    }
  };

  EthercatImage(EthercatSlaves& slaves, const EthercatStates& states) : slaves_(slaves), states_(states) {}

  // Configuration; replaces an earlier entry with the same name.
  void add(uint32_t slave, bool isInput, std::string_view name, uint32_t object);
  // Finds an entry by the identifier of a connection; case, and `_` or blank, do not matter. RUNG_NONE: there is none.
  uint32_t find(std::string_view identifier) const;
  // Whether the identifier names process data of a named slave, even if that entry does not exist.
  bool isOfSlave(std::string_view identifier) const;
  uint32_t count() const { return static_cast<uint32_t>(entries_.size()); }
  const Entry& operator[](uint32_t entry) const { return entries_[entry]; }
  uint32_t bytesOf(uint32_t entry) const { return slaves_.objectAt(entries_[entry].object).bytes; }
  // Inputs have the last values from the slave, also without exchange; outputs have the values written.
  uint64_t read(uint32_t entry) const { return entries_[entry].value; }
  void write(uint32_t entry, uint64_t value);
  // Whether the slave currently exchanges the entry.
  bool isExchanged(uint32_t entry) const;

  void powerOn();
  // One millisecond: outputs are copied to their objects before the drives work, inputs after it.
  void putOutputs();
  void takeInputs();

  template <class Archive>
  void state(Archive& archive) {
    archive.each(entries_);
  }

private:
  EthercatSlaves& slaves_;
  const EthercatStates& states_;
  std::vector<Entry> entries_;
};

} // namespace rung::sim::technol
