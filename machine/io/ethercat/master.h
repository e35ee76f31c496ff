// The EtherCAT master that a host gives: what ECAT_COE_READ, _WRITE, ECAT_SOE_READ, _WRITE and ECAT_COMMAND ask of it
// (TECHNOL manual, chapter 26). A request is begun, and polled by its ticket in later scans: nothing here waits,
// allocates or locks.
#pragma once
#include <cstdint>
#include <span>

namespace rung::io::ethercat {

// Of the master and of slaves (l.17941-17949).
enum class State : uint8_t {
  Unknown = 0, // there is no master
  Init = 1,
  PreOperational = 2,
  Bootstrap = 3,
  SafeOperational = 4,
  Operational = 8,
};

// Commands (l.18206-18232). Those of the master up to 8 are the State to go to, those of a slave 10 more.
inline constexpr uint32_t kSlaveCommands = 10;
inline constexpr uint32_t kMasterState = 20;
inline constexpr uint32_t kSlaveState = 21;
// Nothing: the command is not a change to a state.
constexpr State stateOf(uint32_t command) {
  if (command > kSlaveCommands && command < kMasterState) command -= kSlaveCommands;
  const bool known = (command >= 1 && command <= 4) || command == 8;
  return known ? static_cast<State>(command) : State::Unknown;
}

// What requests end with, beside abort codes of SDO (CiA 301) and codes of SoE, which are passed on as they come.
enum Code : uint32_t {
  kDone = 0,
  kNoMaster = 1,
  kNoSlave = 2,        // or there is no link to it
  kNoMailbox = 3,      // none in its state, or another protocol
  kUnknownCommand = 4, // or an answer is to be given, and there is no place for it
  kTimedOut = 5,
  kStateRefused = 0x11,       // AL status: invalid requested state change
  kSdoWriteOnly = 0x06010001, // SDO abort codes
  kSdoReadOnly = 0x06010002,
  kSdoNoObject = 0x06020000,
  kSdoWrongLength = 0x06070010,
  kSdoNoSubindex = 0x06090011,
  kSoeNoIdn = 0x1001, // codes of SoE (IEC 61800-7-304)
  kSoeWrongElement = 0x1009,
  kSoeTooShort = 0x7002,
  kSoeTooLong = 0x7003,
  kSoeReadOnly = 0x7004,
  kSoeTooSmall = 0x7006,
  kSoeTooLarge = 0x7007,
};

// Bytes that one request moves at most.
inline constexpr uint32_t kMostMailboxBytes = 1024;
// Elements of an IDN (l.18108, l.18138): the operation data.
inline constexpr uint8_t kOperationData = 0x40;

// Where a request goes: masters and slaves from 0, slaves in their order on the net (l.18019-18022).
struct Station {
  uint32_t master = 0;
  uint32_t slave = 0;
};

struct Answer {
  bool isDone = false;
  uint32_t code = kDone;
  uint8_t elements = 0;          // of an IDN, those that were transferred
  uint32_t length = 0;           // bytes that were read or written
  std::span<const uint8_t> data; // what was read; until the ticket is forgotten
};

class Master {
public:
  // 0: there are too many requests; nothing was begun.
  using Ticket = uint32_t;

  virtual ~Master() = default;

  // Each begins a request. Of what is read, the first `most` bytes are wanted.
  virtual Ticket upload(Station station, uint16_t index, uint8_t subindex, uint32_t most) noexcept = 0;
  virtual Ticket download(Station station, uint16_t index, uint8_t subindex,
                          std::span<const uint8_t> data) noexcept = 0;
  virtual Ticket readIdn(Station station, uint8_t drive, uint8_t elements, uint16_t idn, uint32_t most) noexcept = 0;
  virtual Ticket writeIdn(Station station, uint8_t drive, uint8_t elements, uint16_t idn,
                          std::span<const uint8_t> data) noexcept = 0;
  // The data of kMasterState and kSlaveState are one byte, the State. The slave counts for commands to a slave.
  virtual Ticket command(Station station, uint32_t command) noexcept = 0;

  // The same answer until the ticket is forgotten; of a ticket that is not known, kNoMaster.
  virtual Answer poll(Ticket ticket) const noexcept = 0;
  // A request that is forgotten before its end is carried out all the same, and its answer is not read.
  virtual void forget(Ticket ticket) noexcept = 0;

  // As it was last seen.
  virtual State state() const noexcept = 0;
};

// Where a host has none: every request ends at once with kNoMaster.
Master& noMaster() noexcept;

} // namespace rung::io::ethercat
