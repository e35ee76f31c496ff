// The interface of the host's EtherCAT master to ECAT_COE_READ, _WRITE, ECAT_SOE_READ, _WRITE and ECAT_COMMAND (TECHNOL
// manual, chapter 26). A request is begun, and its ticket is polled in later scans: nothing here waits, allocates or
// locks.
#pragma once
#include <cstdint>
#include <span>

namespace rung::io::ethercat {

// States of the master and of slaves (l.17941-17949).
enum class State : uint8_t {
  Unknown = 0, // there is no master
  Init = 1,
  PreOperational = 2,
  Bootstrap = 3,
  SafeOperational = 4,
  Operational = 8,
};

// Commands (l.18206-18232): up to 8, the State that the master must enter; plus 10, the same for a slave.
inline constexpr uint32_t kSlaveCommands = 10;
inline constexpr uint32_t kMasterState = 20;
inline constexpr uint32_t kSlaveState = 21;
// Unknown: the command is not a change of state.
constexpr State stateOf(uint32_t command) {
  if (command > kSlaveCommands && command < kMasterState) command -= kSlaveCommands;
  const bool known = (command >= 1 && command <= 4) || command == 8;
  return known ? static_cast<State>(command) : State::Unknown;
}

// Result codes of requests, besides abort codes of SDO (CiA 301) and codes of SoE, which are passed on unchanged.
enum Code : uint32_t {
  kDone = 0,
  kNoMaster = 1,
  kNoSlave = 2,        // or it has no link
  kNoMailbox = 3,      // no mailbox in the slave's state, or another protocol
  kUnknownCommand = 4, // or the request needs room for an answer and has none
  kTimedOut = 5,
  kStateRefused = 0x11,       // AL status code: invalid requested state change
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

// Largest number of bytes that one request transfers.
inline constexpr uint32_t kMostMailboxBytes = 1024;
// Elements of an IDN (l.18108, l.18138): operation data.
inline constexpr uint8_t kOperationData = 0x40;

// The address of a request: masters and slaves are numbered from 0, slaves in their order on the network
// (l.18019-18022).
struct Station {
  uint32_t master = 0;
  uint32_t slave = 0;

  template <class Archive>
  void state(Archive& archive) {
    archive(master, slave);
  }
};

struct Answer {
  bool isDone = false;
  uint32_t code = kDone;
  uint8_t elements = 0;          // elements of an IDN that were transferred
  uint32_t length = 0;           // number of bytes read or written
  std::span<const uint8_t> data; // data read; valid until the ticket is forgotten
};

class Master {
public:
  // 0: there are too many requests; the request was not begun.
  using Ticket = uint32_t;

  virtual ~Master() = default;

  // Each function begins a request. Read requests return at most the first `most` bytes.
  virtual Ticket upload(Station station, uint16_t index, uint8_t subindex, uint32_t most) noexcept = 0;
  virtual Ticket download(Station station, uint16_t index, uint8_t subindex,
                          std::span<const uint8_t> data) noexcept = 0;
  virtual Ticket readIdn(Station station, uint8_t drive, uint8_t elements, uint16_t idn, uint32_t most) noexcept = 0;
  virtual Ticket writeIdn(Station station, uint8_t drive, uint8_t elements, uint16_t idn,
                          std::span<const uint8_t> data) noexcept = 0;
  // The data of kMasterState and kSlaveState are one byte, the State. `station.slave` is used only by slave commands.
  virtual Ticket command(Station station, uint32_t command) noexcept = 0;

  // Returns the same answer until the ticket is forgotten; kNoMaster for an unknown ticket.
  virtual Answer poll(Ticket ticket) const noexcept = 0;
  // Releases a ticket. A request in progress is still carried out, but its answer is discarded.
  virtual void forget(Ticket ticket) noexcept = 0;

  // The last known state.
  virtual State state() const noexcept = 0;
};

// For hosts without a master: every request ends at once with kNoMaster.
Master& noMaster() noexcept;

} // namespace rung::io::ethercat
