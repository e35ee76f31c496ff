// Requests that the simulated EtherCAT master has taken, in the order in which they were begun. All memory is made
// with the object.
#pragma once
#include <array>
#include <cstdint>
#include <span>

#include "machine/io/ethercat/master.h"

namespace rung::sim::technol {

struct EthercatRequest {
  enum class Kind : uint8_t { Upload, Download, ReadIdn, WriteIdn, Command };
  Kind kind = Kind::Command;
  io::ethercat::Station station;
  uint32_t index = 0;    // or IDN, or command
  uint32_t sub = 0;      // or drive
  uint32_t elements = 0; // of an IDN
  uint32_t most = 0;     // bytes that are wanted
  // At work.
  uint32_t ticket = 0; // 0: free
  uint32_t ageMs = 0;
  bool isDone = false;
  bool isForgotten = false;
  uint32_t code = 0;
  uint32_t size = 0; // of the data that are to be written, or were read
  std::array<uint8_t, io::ethercat::kMostMailboxBytes> data{};
};

class EthercatRequests {
public:
  static constexpr uint32_t kMost = 64;

  // Null: all are in use. The data that do not fit are cut, but `size` is all of them.
  EthercatRequest* add(const io::ethercat::Station& station, EthercatRequest::Kind kind, std::span<const uint8_t> data);
  const EthercatRequest* find(uint32_t ticket) const;
  // Of one that is not done the place is free once it is.
  void forget(uint32_t ticket);
  void finish(EthercatRequest& request, uint32_t code);
  void clear();

  // From the oldest one.
  uint32_t count() const { return count_; }
  EthercatRequest& operator[](uint32_t number) { return slots_[order_[number]]; }
  void dropForgotten();

private:
  std::array<EthercatRequest, kMost> slots_;
  std::array<uint8_t, kMost> order_{}; // numbers of slots
  uint32_t count_ = 0;
  uint32_t lastTicket_ = 0;
};

} // namespace rung::sim::technol
