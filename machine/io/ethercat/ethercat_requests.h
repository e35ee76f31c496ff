// The bits by which a program orders states of the EtherCAT master (TECHNOL manual, l.17908-17985), over any master.
#pragma once
#include <array>
#include <string_view>

#include "machine/io/device_call.h"
#include "machine/io/ethercat/master.h"

namespace rung::io {

namespace ethercat {

// Cells of the program.
struct StateBits {
  // Its requests (l.17957-17967): reset when the master has reached the state (l.17969).
  bool bootstrapRequest = false;
  bool initRequest = false;
  bool preOperationalRequest = false;
  bool safeOperationalRequest = false;
  bool operationalRequest = false;
  // Set by the program, which keeps it; counts where the program starts the cyclic exchange (l.17918).
  bool startCyclicOperation = false;
  // The master is in OPERATIONAL (l.17930, l.17953).
  bool isOperational = false;
};

class StateRequests {
public:
  explicit StateRequests(Master& master) : master_(master) {}

  // At a power-on. `byProgram`: EtherCATOPViaPLC, the program starts the cyclic exchange.
  void reset(bool byProgram) noexcept;
  // Once a tick. Of several bits INIT, BOOTSTRAP, PRE, SAFE, OP are served in this order, one at a time. What the
  // master refuses stays requested, and is tried again after the others.
  void tick(StateBits& bits) noexcept;

private:
  static constexpr uint32_t kStart = 5; // after the five requests
  void finish(StateBits& bits) noexcept;
  void begin(const StateBits& bits) noexcept;
  bool isWanted(uint32_t request, const StateBits& bits) const noexcept;

  Master& master_;
  Master::Ticket ticket_ = 0;
  uint32_t current_ = 0; // what the ticket is for
  uint32_t next_ = 0;    // where the search begins
  bool byProgram_ = false;
  bool startSeen_ = false;
  bool start_ = false; // pending
};

} // namespace ethercat

// ECAT_*: requests of a program to an EtherCAT master, and the cells that order its states (man. ch. 26).

// Requests that the master has not answered yet.
class EthercatCalls {
public:
  explicit EthercatCalls(ethercat::Master& master) : master_(master) {}

  void clear();
  void begin(DeviceCall& call);
  // After a tick: answers what is done. True: something was.
  bool finish(runtime::Instance& instance, AnswerBytes& bytes);

private:
  struct Pending {
    uint32_t ticket = 0; // the program's; 0: none
    ethercat::Master::Ticket asked = 0;
    bool writes = false; // its answer has no data
  };
  Pending pending_[core::ServiceQueue::kMaxPending];
  ethercat::Master& master_;
};

// Cells of the master.
class StatePlaces {
public:
  StatePlaces() = default; // a program that has nothing
  explicit StatePlaces(const rung_program& program);

  void read(const core::Memory& memory, ethercat::StateBits& bits) const;
  void write(const core::Memory& memory, const ethercat::StateBits& bits) const;

private:
  std::array<core::Place, 7> bits_;
};

} // namespace rung::io
