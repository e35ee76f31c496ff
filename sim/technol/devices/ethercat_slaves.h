// The simulated EtherCAT slaves: what the configuration says of each, its objects, and what its mailbox answers.
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

// What the motor of a drive that is enabled follows: 607Ah in increments, or 60FFh in increments per second (TECHNOL
// manual, l.10346, l.10736); 6064h is where it is.
enum class EthercatMotor : uint8_t { None, Position, Velocity };

struct EthercatSlave {
  // Configuration.
  std::string name; // of ECAT.<name>.…
  EthercatProtocols protocols;
  EthercatState refused = EthercatState::Unknown;          // never entered
  bool isDrive = false;                                    // 6040h, 6041h, 603Fh behave by CiA 402
  uint32_t controlWord = 0, statusWord = 0, errorCode = 0; // of a drive: the numbers of these objects
  EthercatMotor motor = EthercatMotor::None;
  uint32_t target = 0, actualPosition = 0; // of a motor: the numbers of 607Ah or 60FFh, and of 6064h
  // Since the power-on.
  EthercatState state = EthercatState::Init;
  bool isSilent = false;      // answers nothing
  uint32_t injectedError = 0; // what its mailbox answers; 0: as usual
  Ds402Drive drive;
  int64_t rest = 0; // of a motor that follows a velocity: 1/1000 increment

  bool hasMailbox() const { return state != EthercatState::Init && state != EthercatState::Bootstrap; }
};

class EthercatSlaves {
public:
  static constexpr uint32_t kMost = 64;
  static constexpr uint16_t kControlWord = 0x6040, kStatusWord = 0x6041, kErrorCode = 0x603F;
  static constexpr uint16_t kActualPosition = 0x6064, kTargetPosition = 0x607A, kTargetVelocity = 0x60FF;

  // Configuration: "" or what is wrong.
  std::string add(uint32_t number, std::string_view protocols);
  std::string addObject(const EthercatObject& object);  // or another value of one that is there
  void makeDrive(uint32_t number, bool isDrive);        // adds the objects that are not there
  void giveMotor(uint32_t number, EthercatMotor motor); // likewise
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

  // Objects by the mailbox: a code of io::ethercat. What is read is appended.
  uint32_t upload(uint32_t slave, uint32_t index, uint32_t sub, MailboxData& to) const;
  uint32_t download(uint32_t slave, uint32_t index, uint32_t sub, std::span<const uint8_t> data);
  uint32_t readIdn(uint32_t slave, uint32_t drive, uint32_t elements, uint32_t idn, MailboxData& to) const;
  uint32_t writeIdn(uint32_t slave, uint32_t drive, uint32_t elements, uint32_t idn, std::span<const uint8_t> data);

private:
  uint32_t missing(uint32_t slave, uint32_t index) const;
  uint32_t objectOfDrive(uint32_t slave, uint32_t index, uint32_t bytes, bool mayWrite);
  void move(EthercatSlave& slave);

  std::vector<EthercatSlave> slaves_;
  std::vector<EthercatObject> objects_;
};

// The states of the simulated EtherCAT master and of its slaves (TECHNOL manual 26.3, l.17937-17955). A step takes
// 10 ms: up through the states between, down at once, BOOTSTRAP only from INIT and to it.

class EthercatStates {
public:
  static constexpr uint32_t kStepMs = 10;
  static constexpr uint32_t kTimeoutMs = 1000; // until a slave that is silent has not answered

  explicit EthercatStates(EthercatSlaves& slaves) : slaves_(slaves) {}

  // At a power-on, after that of the slaves: all are in INIT.
  void powerOn();
  // As the control starts its master: at once as far up as the slaves go with it.
  void start(EthercatState target);

  // A change of the master takes all slaves along; with a number it is one of that slave. One at a time.
  void begin(EthercatState target, std::optional<uint32_t> slave);
  // One millisecond of it: its code once it has ended.
  std::optional<uint32_t> tick();
  // The cable: without it all are in INIT, and changes end with kNoSlave.
  void setLink(bool isUp);

  EthercatState master() const { return master_; }
  bool hasLink() const { return link_; }
  // Process data that a slave gives and takes.
  bool givesInputs(uint32_t slave) const;
  bool takesOutputs(uint32_t slave) const;

private:
  struct Step {
    bool isRefused = false;
    bool isSilent = false; // a slave has not answered
    bool isDone = true;    // all are there
  };
  static Step stepOf(EthercatSlave& slave, EthercatState goal);
  Step step();
  Step allTo(EthercatState goal);

  EthercatSlaves& slaves_;
  EthercatState master_ = EthercatState::Init;
  EthercatState target_ = EthercatState::Init; // of the change under way
  std::optional<uint32_t> slave_;              // nothing: the master's
  uint32_t stepMs_ = 0;
  uint32_t silentMs_ = 0;
  bool link_ = true;
};

// The process image of the simulated EtherCAT net (TECHNOL manual 26.2, l.17763-17786, l.17872-17904): entries of the
// slaves that connections name ECAT.<slave>.Inputs.<entry> and ECAT.<slave>.Outputs.<entry>, each bound to an object.

class EthercatImage {
public:
  struct Entry {
    uint32_t slave = 0;
    bool isInput = false; // what the slave gives
    std::string name;     // as nameOf makes it
    uint32_t object = 0;  // its number among those of the slaves
    uint64_t value = 0;
    bool isWritten = false; // since the power-on, of an output
  };

  EthercatImage(EthercatSlaves& slaves, const EthercatStates& states) : slaves_(slaves), states_(states) {}

  // Configuration; a later entry of the same name takes its place.
  void add(uint32_t slave, bool isInput, std::string_view name, uint32_t object);
  // By the identifier of a connection, in any case, with `_` or a blank. RUNG_NONE: there is none.
  uint32_t find(std::string_view identifier) const;
  // The identifier names process data of a slave that has a name, whether or not that entry exists.
  bool isOfSlave(std::string_view identifier) const;
  uint32_t count() const { return static_cast<uint32_t>(entries_.size()); }
  const Entry& operator[](uint32_t entry) const { return entries_[entry]; }
  uint32_t bytesOf(uint32_t entry) const { return slaves_.objectAt(entries_[entry].object).bytes; }
  // Inputs are as the slave has given them last; without exchange they stay. Outputs are as they were written.
  uint64_t read(uint32_t entry) const { return entries_[entry].value; }
  void write(uint32_t entry, uint64_t value);
  // Whether the slave exchanges it just now.
  bool isExchanged(uint32_t entry) const;

  void powerOn();
  // One millisecond: outputs go to their objects before the drives have worked, inputs come after it.
  void putOutputs();
  void takeInputs();

private:
  EthercatSlaves& slaves_;
  const EthercatStates& states_;
  std::vector<Entry> entries_;
};

} // namespace rung::sim::technol
