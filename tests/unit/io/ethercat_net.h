// A simulated EtherCAT net, its bits, and the requests of a test.
#pragma once
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "sim/technol/devices/ethercat.h"

namespace rung::test {

using io::ethercat::Answer;
using io::ethercat::State;
using io::ethercat::StateBits;

struct EthercatNet {
  using Config = std::initializer_list<std::pair<const char*, const char*>>;

  // Powered on. The configuration must be right.
  EthercatNet(Config keys = {}) {
    for (const auto& [key, value] : keys) problems += net.configure(key, value);
    net.powerOn();
  }
  void ticks(int count) {
    for (int i = 0; i < count; ++i) net.tick(bits);
  }
  void scans(int count) { ticks(20 * count); }
  // Until the answer is there, at most 2 s; then the ticket is forgotten.
  Answer finish(uint32_t ticket) {
    for (tookMs = 0; tookMs < 2000 && !net.poll(ticket).isDone; ++tookMs) ticks(1);
    Answer answer = net.poll(ticket);
    data.assign(answer.data.begin(), answer.data.end());
    net.forget(ticket);
    return answer;
  }
  uint32_t upload(uint32_t slave, uint16_t index, uint8_t sub, uint32_t most = 8) {
    return finish(net.upload({0, slave}, index, sub, most)).code;
  }
  uint32_t download(uint32_t slave, uint16_t index, uint8_t sub, const std::vector<uint8_t>& bytes) {
    return finish(net.download({0, slave}, index, sub, bytes)).code;
  }
  uint32_t command(uint32_t command, uint32_t slave = 0) { return finish(net.command({0, slave}, command)).code; }

  std::string problems;
  sim::technol::EtherCat net;
  StateBits bits;
  std::vector<uint8_t> data; // of the last answer
  int tookMs = 0;            // until it was there
};

} // namespace rung::test
