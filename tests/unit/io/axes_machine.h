// Axes with the cells of a program beside them, as tests drive them.
#pragma once
#include <initializer_list>
#include <string>
#include <utility>

#include "sim/technol/devices/axes.h"

namespace rung::test {

struct AxesMachine {
  sim::technol::Axes axes;
  sim::technol::AxisInputs in;
  sim::technol::AxisRequests requests;
  sim::technol::AxisOutputs out;

  using Configuration = std::initializer_list<std::pair<const char*, const char*>>;

  AxesMachine(Configuration configuration = {}) { // NOLINT(google-explicit-constructor)
    for (const auto& [key, value] : configuration) problems += axes.configure(key, value);
    requests.knobStep = 100;
    axes.powerUp();
    axes.show(out);
  }

  void ticks(int count) {
    for (int i = 0; i < count; ++i) axes.tick(in, requests);
    axes.show(out);
  }
  void scan(int count = 1) { ticks(20 * count); }
  // Ticks until `done` is true; -1: never within 100 s.
  int ticksUntil(auto done) {
    for (int i = 0; i < 100'000; ++i) {
      if (done()) return i;
      ticks(1);
    }
    return -1;
  }
  bool spiAx(int64_t axis, const sim::technol::SpindlePositioningOrder& order) {
    if (!axes.spiAx(axis, order)) return false;
    sim::technol::setBit(requests.positioning, static_cast<uint32_t>(axis - 1));
    axes.show(out);
    return true;
  }
  // All that the log would get.
  std::string log() {
    std::string all;
    for (sim::technol::Complaint complaint; axes.takeComplaint(complaint);) all += complaint.text() + "\n";
    return all;
  }

  std::string problems;
};

} // namespace rung::test
