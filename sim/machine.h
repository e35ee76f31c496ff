// A program that runs in a simulated NC: an instance of the runtime's library (rung/runtime.h), as every host has it,
// with the simulation around it.
#pragma once
#include <functional>
#include <memory>
#include <string>

#include "rung/runtime.hpp"
#include "sim/simulated_nc.h"

namespace rung::sim {

// Which clock the program runs on.
enum class Clock : uint8_t {
  Virtual, // as fast as it goes: what it wants to be on disk is there before it runs on
  Machine, // and nothing waits
};

class Machine {
public:
  // The program and what its chunks find in rung_ctx::engine outlive it.
  Machine(const rung_program& program, void* engine, std::unique_ptr<SimulatedNc> nc, Clock clock = Clock::Virtual);
  Machine(const Machine&) = delete;
  Machine& operator=(const Machine&) = delete;

  // What an operator should know of retained memory goes there.
  void setReport(std::function<void(const std::string& line)> report) { report_ = std::move(report); }

  SimulatedNc& nc() { return *nc_; }
  const SimulatedNc& nc() const { return *nc_; }
  rung::Image& image() { return image_; }
  rung::Instance& instance() { return instance_; }
  // The program from inside.
  runtime::Instance& inside() { return inside_; }
  const runtime::Instance& inside() const { return inside_; }

  // Throws rung::Error where retained memory cannot be taken or saved.
  void powerOn(nc::PowerOn kind);
  void powerOff() { instance_.powerOff(); }
  // A whole scan of the schedule, or its rest, after a fault its time alone; a slot; one run of the fast task by
  // itself; a slice.
  void scan();
  void slot() { (void)instance_.slot(); }
  void fast() { (void)instance_.fast(); }
  void slice() { (void)instance_.slice(); }
  // The operator or the machine does something between two scans.
  template <class Act>
  std::string operate(Act act) {
    std::string problem = act(*nc_, inside_);
    api::takeMessages(*instance_.handle());
    return problem;
  }
  // Another program of the dialect has taken over, by a replacement for `instance()`: this is its image.
  void setImage(rung::Image image) { image_ = std::move(image); }

private:
  void idle();
  static rung::Instance instanceOf(const rung::Image& image, std::unique_ptr<SimulatedNc> nc, Clock clock,
                                   Machine& self);

  std::function<void(const std::string& line)> report_;
  SimulatedNc* nc_; // the instance's
  rung::Image image_;
  rung::Instance instance_;
  runtime::Instance& inside_;
};

} // namespace rung::sim
