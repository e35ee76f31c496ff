// The bits by which a program requests states of the EtherCAT master (TECHNOL manual, l.17908-17985), for any master.
#pragma once
#include <array>
#include <string_view>

#include "machine/io/device_call.h"
#include "machine/io/ethercat/master.h"

namespace rung::io {

namespace ethercat {

// Cells of the program.
struct StateBits {
  // Requests (l.17957-17967): reset when the master has reached the state (l.17969).
  bool bootstrapRequest = false;
  bool initRequest = false;
  bool preOperationalRequest = false;
  bool safeOperationalRequest = false;
  bool operationalRequest = false;
  // Set by the program and not reset; has an effect only if the program starts the cyclic exchange (l.17918).
  bool startCyclicOperation = false;
  // The master is in OPERATIONAL (l.17930, l.17953).
  bool isOperational = false;

  template <class Archive>
  void state(Archive& archive) {
    archive(bootstrapRequest, initRequest, preOperationalRequest, safeOperationalRequest, operationalRequest,
            startCyclicOperation, isOperational);
  }
};

class StateRequests {
public:
  explicit StateRequests(Master& master) : master_(master) {}

  // At a power-on. `byProgram`: EtherCATOPViaPLC is set, so the program starts the cyclic exchange.
  void reset(bool byProgram) noexcept;
  // Called once per tick. Several requests are served one at a time in the order INIT, BOOTSTRAP, PRE, SAFE, OP. A
  // request that the master refuses stays set and is tried again after the others.
  void tick(StateBits& bits) noexcept;

  template <class Archive>
  void state(Archive& archive) {
    archive(ticket_, byProgram_, startSeen_, start_);
    archive.atMost(current_, kStart);
    archive.atMost(next_, kStart);
  }

private:
  static constexpr uint32_t kStart = 5; // index after the five requests
  void finish(StateBits& bits) noexcept;
  void begin(const StateBits& bits) noexcept;
  bool isWanted(uint32_t request, const StateBits& bits) const noexcept;

  Master& master_;
  Master::Ticket ticket_ = 0;
  uint32_t current_ = 0; // index of the request in progress
  uint32_t next_ = 0;    // index where the search begins
  bool byProgram_ = false;
  bool startSeen_ = false;
  bool start_ = false; // a start is pending
};

} // namespace ethercat

// ECAT_*: requests of a program to an EtherCAT master, and the cells that request its states (man. ch. 26).

// Requests that the master has not answered yet.
class EthercatCalls {
public:
  explicit EthercatCalls(ethercat::Master& master) : master_(master) {}

  void clear();
  void begin(DeviceCall& call);
  // To be called after a tick: passes on finished answers. Returns true if there were any.
  bool finish(runtime::Instance& instance, AnswerBytes& bytes);

  template <class Archive>
  void state(Archive& archive) {
    archive(pending_);
  }

private:
  struct Pending {
    uint32_t ticket = 0; // ticket of the program; 0: unused
    ethercat::Master::Ticket asked = 0;
    bool writes = false; // a write request: its answer has no data
    template <class Archive>
    void state(Archive& archive) {
      archive(ticket, asked, writes);
    }
  };
  Pending pending_[core::ServiceQueue::kMaxPending];
  ethercat::Master& master_;
};

// Cells of the master.
class StatePlaces {
public:
  StatePlaces() = default; // for a program without these cells
  explicit StatePlaces(const rung_program& program);

  void read(const core::Memory& memory, ethercat::StateBits& bits) const;
  void write(const core::Memory& memory, const ethercat::StateBits& bits) const;

private:
  std::array<core::Place, 7> bits_;
};

} // namespace rung::io
