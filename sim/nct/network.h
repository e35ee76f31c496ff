// The other side of the simulated network: a device that scenarios open and close and through which they send (`event
// device …`).
#pragma once
#include <array>
#include <string>
#include <vector>

#include "sim/nct/memory_line.h"
#include "sim/nct/socket.h"
#include "sim/nct/topic.h"

namespace rung::sim::nct {

class NetworkDevice {
public:
  // `line` is the device's side, joined with the control's.
  explicit NetworkDevice(MemoryLine& line) : line_(line) {}

  // Handles the keys of the event: open=udp|server|client with port=N; send=WORDS with w0=V …; close=1. `control` is
  // the port of the control's connection, 0 if it has none; `open` without a port uses it. Returns "", or the error.
  std::string event(const std::vector<NcArgument>& keys, uint16_t control);
  void close() { line_.close(); }
  // Receives data from the control.
  void poll();

  // Length and words of the last received message.
  uint32_t receivedWords() const { return static_cast<uint32_t>(messageBytes_ / 4); }
  std::optional<double> receivedWord(uint32_t number) const;
  bool connected() const { return line_.isOpen(); }

  template <class Archive>
  void state(Archive& archive) {
    archive(udp_, message_);
    archive.atMost(messageBytes_, message_.size());
  }

private:
  std::string open(std::string_view role, uint16_t port);
  std::string send(const std::vector<NcArgument>& keys, uint16_t control);

  MemoryLine& line_;
  bool udp_ = false; // type of the last connection
  std::array<uint8_t, kMostNetworkBytes> message_{};
  size_t messageBytes_ = 0;
};

// The network of the PLC program: MW 60, 61, MR 62, MW 63 (man. 6.22), UDP and TCP.
//
// `config network isolated` (default): a network in memory that consists of the control and the simulated device; every
// target address of a program is the device. `config network loopback`: the control is 127.0.0.1 and reaches other
// programs on 127.0.0.0/8 by their addresses and ports, through real sockets that are only accessed between two scans.
// They never wait, except up to 100 ms when a connection is opened on the virtual clock.

class Network final : public Topic {
public:
  explicit Network(Links& links) : Topic(links) { MemoryLine::join(control_, remote_); }

  bool serves(bool write, uint32_t function) const override;
  std::optional<int32_t> service(uint32_t function, Block& block) override;
  Handled config(std::string_view key, std::string_view value) override;
  std::span<const std::string_view> events() const override {
    static constexpr std::string_view kEvents[] = {"device"};
    return kEvents;
  }
  Handled event(std::string_view name, const std::vector<NcArgument>& keys) override;
  std::optional<double> quantity(std::string_view name) const override;
  void powerOn(nc::PowerOn kind) override;
  void cycle() override;
  void dropRequests() override { close(); }

  // Not of real sockets, which loading closes.
  template <class Archive>
  void state(Archive& archive) {
    archive(control_, remote_, protocol_, connecting_, connectingSince_, target_, port_, unsent_, device_);
    archive.atMost(unsentBytes_, unsent_.size());
    archive.atMost(unsentAt_, unsent_.size());
    if constexpr (Archive::kLoads)
      if (!isolated()) close();
  }

private:
  enum class Protocol : uint8_t { None, Udp, Server, Client };
  using Buffer = std::array<uint8_t, kMostNetworkBytes>;

  std::optional<int32_t> open(Block& block);
  std::optional<int32_t> connecting(Block& block);
  int32_t receive(Block& block);
  int32_t take(Block& block);
  std::optional<int32_t> send(Block& block);
  int32_t failed(Block& block, int32_t error);
  void close();
  bool flush();
  bool isolated() const { return line_ == &control_; }

  MemoryLine control_; // the two sides of the network in memory
  MemoryLine remote_;
  SocketLine sockets_;
  Line* line_ = &control_; // destination of the program's connection

  Protocol protocol_ = Protocol::None; // of the connection
  bool connecting_ = false;
  int64_t connectingSince_ = 0;
  uint32_t target_ = 0; // as the program wrote it
  uint16_t port_ = 0;
  Buffer unsent_{}; // bytes of a stream for which there was no room
  size_t unsentBytes_ = 0;
  size_t unsentAt_ = 0;
  mutable NetworkDevice device_{remote_};
};

} // namespace rung::sim::nct
