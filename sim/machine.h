// A program in a simulated NC: an instance of the runtime's library (rung/runtime.h), as in every host, with the
// simulation as its environment.
#pragma once
#include <functional>
#include <memory>
#include <string>

#include "rung/runtime.hpp"
#include "sim/simulated_nc.h"

namespace rung::sim {

// The clock of the program.
enum class Clock : uint8_t {
  Virtual, // as fast as possible; a scan waits until retained data is on disk
  Machine, // real time; nothing waits
};

class Machine {
public:
  // The program, and the engine that its chunks use as rung_ctx::engine, must outlive this object.
  Machine(const rung_program& program, void* engine, std::unique_ptr<SimulatedNc> nc, Clock clock = Clock::Virtual);
  Machine(const Machine&) = delete;
  Machine& operator=(const Machine&) = delete;

  // Receives reports about retained memory for the operator.
  void setReport(std::function<void(const std::string& line)> report) { report_ = std::move(report); }

  SimulatedNc& nc() { return *nc_; }
  const SimulatedNc& nc() const { return *nc_; }
  rung::Image& image() { return image_; }
  rung::Instance& instance() { return instance_; }
  // The internal object of the instance.
  runtime::Instance& inside() { return inside_; }
  const runtime::Instance& inside() const { return inside_; }

  // Throws rung::Error if retained memory cannot be used or saved.
  void powerOn(nc::PowerOn kind);
  void powerOff() { instance_.powerOff(); }
  // scan(): a whole scan of the schedule, or its rest; after a fault only its time passes. slot(): one slot. fast():
  // one run of the fast task alone. slice(): one slice.
  void scan();
  void slot() { (void)instance_.slot(); }
  void fast() { (void)instance_.fast(); }
  void slice() { (void)instance_.slice(); }
  // Executes an action of the operator or the machine between two scans.
  template <class Act>
  std::string operate(Act act) {
    std::string problem = act(*nc_, inside_);
    api::takeMessages(*instance_.handle());
    return problem;
  }
  // Another program of the dialect has taken over, by a replacement for `instance()`; `image` is its image.
  void setImage(rung::Image image) { image_ = std::move(image); }

private:
  void idle();
  static rung::Instance instanceOf(const rung::Image& image, std::unique_ptr<SimulatedNc> nc, Clock clock,
                                   Machine& self);

  std::function<void(const std::string& line)> report_;
  SimulatedNc* nc_; // owned by the instance
  rung::Image image_;
  rung::Instance instance_;
  runtime::Instance& inside_;
};

} // namespace rung::sim
