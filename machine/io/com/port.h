// The configuration of a serial port: the attributes of ComChannel (TECHNOL manual 23.3.1, l.21000-21040).
#pragma once
#include <atomic>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "machine/io/device_call.h"
#include "rtlib/core/handover.h"

namespace rung::io {

namespace com {

inline constexpr uint32_t kMostPorts = 16; // numbers 0 to 15

enum class Parity : uint8_t { None, Odd, Even, Mark, Space };

struct Settings {
  bool isActive = false;
  uint32_t physical = 0; // PhysicalComNo, from 1; 0: not given
  uint32_t speed = 115200;
  uint32_t dataBits = 8;
  uint32_t stopBits = 2;
  Parity parity = Parity::None;

  // Sets an attribute; the case of both texts does not matter. Returns "", or the error.
  std::string set(std::string_view attribute, std::string_view value);
  // Number of start, data, parity and stop bits.
  uint32_t bitsOfByte() const { return 1 + dataBits + (parity == Parity::None ? 0 : 1) + stopBits; }
  uint8_t mask() const { return dataBits == 7 ? 0x7F : 0xFF; }
};

// The parts of a key "COM[1].ComSpeed": the number of the port, and its attribute in capitals.
struct PortKey {
  uint32_t number = 0;
  std::string attribute;
};
// Whether the key is that of a serial port, with or without errors.
bool isPortKey(std::string_view key);
// Returns "", or the error.
std::string readPortKey(std::string_view key, PortKey& port);

} // namespace com

// A serial port as a program sees it (TECHNOL manual 23.3.2, l.21042-21199): a queue in each direction and a state. The
// program runs on the scan thread; the line, simulated or real, may run on another thread. Nothing waits, allocates or
// locks.

namespace com {

// The result of COM_CONTROL STATE (l.21189-21198).
enum PortState : uint32_t {
  kPortError = 1,       // PLC_COM_ERROR
  kNotConfigured = 2,   // PLC_COM_REQ
  kSendOverflow = 4,    // PLC_COM_SEND_OVER
  kReceiveOverflow = 8, // PLC_COM_RECV_OVER
};

class Port {
public:
  static constexpr uint32_t kQueueBytes = 1024; // in each direction

  // To be called before the program runs. A port that is not active refuses all functions except `takeState`.
  void configure(const Settings& settings) { settings_ = settings; }
  const Settings& settings() const { return settings_; }

  // ---- program ---------------------------------------------------------------------------------------------------
  //
  // At a power-on: discards received bytes and overflows. Bytes to be sent, and an error, belong to the line and stay.
  void powerOn() noexcept;
  // Returns false if there is no room, or the port is not active.
  bool send(uint8_t byte) noexcept { return send(std::span(&byte, 1)); }
  // Queues all bytes or none; the line gets them at once, so that it can send them without a gap (l.21102).
  bool send(std::span<const uint8_t> bytes) noexcept;
  std::optional<uint8_t> receive() noexcept;
  bool clear() noexcept; // discards received bytes
  // Number of bytes that can be received; nothing: not active.
  std::optional<uint32_t> received() const noexcept;
  // Returns a sum of PortState, and resets the overflows.
  uint32_t takeState() noexcept;

  // ---- line ------------------------------------------------------------------------------------------------------
  //
  // Number of bytes to be sent; 0 while a block is being queued.
  uint32_t toSend() const noexcept;
  // Takes the oldest byte to be sent; to be called after toSend.
  bool takeToSend(uint8_t& byte) noexcept { return toLine_.pop(byte); }
  void dropToSend() noexcept;
  // Adds a received byte, which is lost if there is no room.
  void deliver(uint8_t byte) noexcept { fromLine_.push(byte & settings_.mask()); }
  void setError(bool isWrong) noexcept { error_.store(isWrong, std::memory_order_relaxed); }
  // Number of received bytes lost because there was no room. Any thread.
  uint32_t lostBytes() const noexcept { return fromLine_.lost(); }
  bool hasError() const noexcept { return error_.load(std::memory_order_relaxed); }

  // For a simulated line, on the program's thread.
  template <class Archive>
  void state(Archive& archive) {
    archiveBytes(archive, toLine_);
    archiveBytes(archive, fromLine_);
    bool isWrong = hasError();
    uint32_t lost = fromLine_.lost() - lostSeen_; // since the last takeState
    archive(sendOverflow_, isWrong, lost);
    if constexpr (Archive::kLoads) setError(isWrong), lostSeen_ = fromLine_.lost() - lost;
  }

private:
  using Bytes = core::FixedRing<uint8_t, kQueueBytes>;
  template <class Archive>
  static void archiveBytes(Archive& archive, Bytes& ring) {
    uint8_t byte = 0;
    if constexpr (Archive::kLoads)
      while (ring.pop(byte)) continue;
    uint32_t count = ring.size();
    archive.atMost(count, kQueueBytes);
    for (uint32_t i = 0; i < count; ++i) {
      if constexpr (!Archive::kLoads) byte = *ring.peek(i);
      archive(byte);
      if constexpr (Archive::kLoads) ring.push(byte);
    }
  }

  Settings settings_;
  Bytes toLine_, fromLine_;
  std::atomic<bool> filling_{false}; // a block is being added to toLine_
  std::atomic<bool> error_{false};
  bool sendOverflow_ = false;
  uint32_t lostSeen_ = 0; // lost bytes of fromLine_ at the last takeState
};

} // namespace com

// Answers to COM_*: serial ports (man. ch. 23.3).

inline uint32_t comOf(const DeviceCall& call) { return call.number(0); }
// Answers a request; `port` is the port that it names, null if there is no such number.
void answerCom(com::Port* port, DeviceCall& call);

} // namespace rung::io
