// The simulated serial ports (TECHNOL manual 23.3): bytes of a program leave a port at its speed; bytes from outside
// are in its queue at once.
#pragma once
#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "machine/io/com/port.h"

namespace rung::sim::technol {

// One port's line.
class ComLine {
public:
  static constexpr uint32_t kSentBytes = 65536; // sent bytes that have not been checked yet

  explicit ComLine(io::com::Port& port) : port_(port) {}

  void makeRoom() { sent_.resize(kSentBytes); }
  void powerOn();
  // One millisecond.
  void tick();
  // While the line has an error, nothing leaves it, and received bytes are lost.
  void receive(std::span<const uint8_t> bytes);

  // Sent bytes that have not been checked, from the oldest on. Beyond kSentBytes, the oldest are lost.
  uint32_t sent() const { return sentCount_; }
  uint8_t sentByte(uint32_t number) const { return sent_[(sentFirst_ + number) % kSentBytes]; }
  // Returns whether the oldest bytes are the expected ones, which then count as checked.
  bool takeSent(std::span<const uint8_t> expected);

  template <class Archive>
  void state(Archive& archive) {
    archive(progress_);
    archive.atMost(sentCount_, sent_.size());
    for (uint32_t i = 0; i < sentCount_; ++i) archive(sent_[(sentFirst_ + i) % kSentBytes]);
  }

private:
  void leave();

  io::com::Port& port_;
  uint64_t progress_ = 0; // of the byte being sent, in thousandths of a bit
  std::vector<uint8_t> sent_;
  uint32_t sentFirst_ = 0, sentCount_ = 0;
};

class ComPorts {
public:
  static constexpr uint32_t kMost = io::com::kMostPorts;

  // Sets the keys COM[1].Active, COM[1].ComSpeed … Returns "", or the error.
  static bool owns(std::string_view key) { return io::com::isPortKey(key); }
  std::string configure(std::string_view key, std::string_view value);

  void powerOn();
  void tick();

  io::com::Port& port(uint32_t number) { return units_[number].port; }
  // Null: no port of this number.
  io::com::Port* find(uint32_t number) { return number < kMost ? &units_[number].port : nullptr; }
  ComLine& line(uint32_t number) { return units_[number].line; }
  // Events; they return "", or the error.
  std::string receive(uint32_t number, std::span<const uint8_t> bytes);
  std::string setError(uint32_t number, bool isWrong);

  template <class Archive>
  void state(Archive& archive) {
    archive(units_);
  }

private:
  struct Unit {
    io::com::Port port;
    ComLine line{port};
    template <class Archive>
    void state(Archive& archive) {
      archive(port, line);
    }
  };
  std::string inactive(uint32_t number) const;

  std::array<Unit, kMost> units_;
};

} // namespace rung::sim::technol
