// Shared memory with another program of the same user: docs/mapping-file.md describes what lies in it. It is read and
// written by calls of the system and not mapped, so that a program that shortens it ends only itself.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "machine/host/socket.h"
#include "machine/io/connections/connections.h"

namespace rung::io {

class SharedMemory final : public Service {
public:
  static constexpr uint32_t kMagic = 0x474E5552; // "RUNG"
  static constexpr uint32_t kVersion = 1;
  // As it lies there, before the outputs.
  struct Header {
    uint32_t magic = kMagic;
    uint32_t version = kVersion;
    uint32_t outputsAt = sizeof(Header);
    uint32_t outputsSize = 0;
    uint32_t inputsAt = 0;
    uint32_t inputsSize = 0;
    uint32_t outputsSequence = 0; // odd while the outputs are being written
    uint32_t inputsSequence = 0;  // the same of the other side
  };

  // Makes it, or takes over what a host that was killed has left. Throws std::runtime_error where something else has
  // the name, or another process uses it.
  SharedMemory(const host::Connection& connection, Exchange& exchange);
  ~SharedMemory() override; // nothing is left of it
  SharedMemory(const SharedMemory&) = delete;
  SharedMemory& operator=(const SharedMemory&) = delete;
  void run(const std::atomic<bool>& ending) noexcept override;

private:
  void open();
  void checkOwner(int file) const;
  void layOut();
  void keep() noexcept;
  bool reserve(int64_t size) const;
  void writeOutputs();
  void readInputs(int64_t now);
  bool takeInputs();
  bool isOpen() const { return file_.number() >= 0; }
  bool get(void* to, size_t size, uint32_t at) const;
  bool put(const void* from, size_t size, uint32_t at) const;
  [[noreturn]] void refuse(const std::string& found) const;

  std::string title_;
  std::string name_; // with the slash
  Exchange& exchange_;
  int64_t periodNs_;
  host::Socket file_;
  Header header_;
  uint32_t taken_ = 0; // sequence of the inputs that were last taken
  std::vector<uint8_t> outputs_, inputs_;
  std::vector<double> values_; // of the inputs
};

} // namespace rung::io
