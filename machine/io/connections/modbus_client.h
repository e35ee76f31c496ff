// A Modbus TCP client: in each period it writes the outputs of a connection to a device and reads the inputs from it.
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <modbus.h>

#include "machine/io/connections/connections.h"

namespace rung::io {

class ModbusClient final : public Service {
public:
  // Throws std::bad_alloc. The device need not be connected yet.
  ModbusClient(const host::Connection& connection, Exchange& exchange);
  void run(const std::atomic<bool>& ending) noexcept override;

private:
  // Consecutive addresses that fit into one request.
  struct Block {
    host::Area area = host::Area::Coil;
    uint32_t first = 0;
    uint32_t count = 0;
    std::vector<size_t> pins; // indices into Exchange::inputs() or outputs()
  };
  struct Free {
    void operator()(modbus_t* context) const noexcept { modbus_free(context); }
  };
  static std::vector<Block> blocksOf(const std::vector<ExchangedPin>& pins, bool writes);

  bool connect();
  void disconnect();
  bool turn();
  bool write();
  bool writeBlock(const Block& block, const std::vector<double>& values);
  bool read();
  bool readBlock(const Block& block);
  bool takeBlock(const Block& block);
  void begin(uint8_t function, const Block& block);
  bool ask();
  bool fail(const std::string& what);
  bool answersLater();

  Exchange& exchange_;
  int64_t periodNs_;
  std::unique_ptr<modbus_t, Free> context_;
  std::vector<Block> reads_, writes_;
  uint8_t unit_ = 0;
  std::vector<uint8_t> request_;    // without the MBAP header
  std::vector<uint8_t> answer_;     // from the function code on
  std::vector<uint8_t> bits_;       // bits of a block
  std::vector<uint16_t> registers_; // registers of a block
  std::vector<double> inputs_;
  bool connected_ = false;
  int64_t answerNs_;    // how long an answer is waited for
  bool waited_ = false; // for a late answer, since the last successful exchange
  const std::atomic<bool>* ending_ = nullptr;
};

} // namespace rung::io
