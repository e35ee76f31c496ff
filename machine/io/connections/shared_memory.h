// Memory shared with another program of the same user; docs/mapping-file.md describes its layout. It is accessed by
// system calls and not mapped, so that a program that truncates it harms only itself.
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
  // The layout of the header, which precedes the outputs.
  struct Header {
    uint32_t magic = kMagic;
    uint32_t version = kVersion;
    uint32_t outputsAt = sizeof(Header);
    uint32_t outputsSize = 0;
    uint32_t inputsAt = 0;
    uint32_t inputsSize = 0;
    uint32_t outputsSequence = 0; // odd while the outputs are being written
    uint32_t inputsSequence = 0;  // the same for the inputs, set by the other side
  };

  // Creates the memory, or takes over that of a host that was killed. Throws std::runtime_error if something else has
  // the name, or another process uses the memory.
  SharedMemory(const host::Connection& connection, Exchange& exchange);
  ~SharedMemory() override; // removes the memory
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
  std::string name_; // including the slash
  Exchange& exchange_;
  int64_t periodNs_;
  host::Socket file_;
  Header header_;
  uint32_t taken_ = 0; // sequence of the inputs taken last
  std::vector<uint8_t> outputs_, inputs_;
  std::vector<double> values_; // of the inputs
};

} // namespace rung::io
