// A program of the scenarios with real devices around it, stepped by hand.
#pragma once
#include <gtest/gtest.h>

#include <fstream>
#include <list>
#include <optional>
#include <sstream>
#include <string>

#include "machine/io/host_devices.h"
#include "tests/support/compiled_program.h"
#include "tests/support/patience.h"

namespace rung::test {

inline std::string scenarioProgram(const std::string& name) {
  std::ifstream file("tests/scenarios/technol/" + name);
  std::stringstream text;
  text << file.rdbuf();
  EXPECT_FALSE(text.str().empty()) << name;
  return text.str();
}

class DeviceBench {
public:
  explicit DeviceBench(const std::string& program) : compiled_(program, scenarioProgram(program)) {}
  ~DeviceBench() {
    if (plc) plc->powerOff();
    devices.end();
  }
  DeviceBench(const DeviceBench&) = delete;
  DeviceBench& operator=(const DeviceBench&) = delete;

  void begin() {
    image_.emplace(Image::adopt(compiled_.program()));
    plc.emplace(devices.instance(*image_, sized<rung_instance_options>()));
    plc->powerOn(Power::Cold);
    devices.start();
    for (int i = 0; i < 40; ++i) step(); // edges count from the first scan on
  }
  void end() {
    plc->powerOff();
    devices.end();
    replacements_.clear();
    plc.reset();
  }
  // That program takes over, at its next pass.
  void replaceBy(const std::string& program) {
    const Image next = Image::adopt(others_.emplace_back(program, scenarioProgram(program)).program());
    Replacement& replacement = replacements_.emplace_back(*plc, next);
    replacement.allowLate();
    EXPECT_TRUE(soon([&] { return plc->replace(replacement) == RUNG_OK; }));
  }
  // A millisecond, and none of it is spent.
  void step() {
    devices.step(1'000'000);
    plc->runDue(1'000'000);
  }
  // Steps at their times until it is so.
  template <class Condition>
  bool soon(Condition condition) {
    return test::soon([&] { return step(), condition(); });
  }
  int64_t operator[](const std::string& name) { return plc->read<int64_t>(plc->find(name)); }
  void set(const std::string& name, int64_t value) { plc->write(plc->find(name, Access::Write), value); }
  bool soonIs(const std::string& name, int64_t value) {
    return soon([&] { return (*this)[name] == value; });
  }
  // A line that a report has brought since the last call.
  bool soonReports(const std::string& text) {
    return soon([&] {
      for (const std::string& line : devices.report())
        if (line.find(text) != std::string::npos) return true;
      return false;
    });
  }

private:
  testing::CompiledProgram compiled_; // outlives all, as do the others
  std::list<testing::CompiledProgram> others_;
  std::optional<Image> image_;

public:
  io::HostDevices devices;
  std::optional<Instance> plc;

private:
  std::list<Replacement> replacements_; // end before the instance
};

} // namespace rung::test
