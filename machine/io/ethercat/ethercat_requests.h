// ECAT_*: requests of a program to an EtherCAT master, and the cells that order its states (man. ch. 26).
#pragma once
#include <array>
#include <string_view>

#include "machine/io/device_call.h"
#include "machine/io/ethercat/master.h"
#include "machine/io/ethercat/state_requests.h"

namespace rung::io {

// What a request asks for; None: no such service.
enum class EthercatOrder : uint8_t { None, ReadObject, WriteObject, ReadIdn, WriteIdn, Command };
EthercatOrder ethercatOrder(std::string_view service);

// Requests that the master has not answered yet.
class EthercatCalls {
public:
  explicit EthercatCalls(ethercat::Master& master) : master_(master) {}

  void clear();
  void begin(EthercatOrder order, DeviceCall& call);
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
