// A program whose axis 4 is at pins of the test: its drive.
#pragma once
#include <algorithm>
#include <string>
#include <vector>

#include "machine/host/pins.h"
#include "tests/support/faultless_map.h"
#include "tests/unit/io/host_devices_bench.h"

namespace rung::test {

class AxisBench : public DeviceBench {
public:
  explicit AxisBench(const std::string& program) : DeviceBench(program) {}

  // With these further keys of the axis; it stands at 5 mm, referenced and enabled.
  void beginWith(const std::string& keys = {}) {
    map_ = faultlessMap("[devices.axes]\n4 = { pins = \"table\"" + keys + " }\n");
    std::vector<std::string> errors;
    devices.set(map_, errors);
    devices.addAxisPins(map_, errors);
    EXPECT_EQ(errors, std::vector<std::string>());
    values_.resize(map_.pins.size());
    for (size_t i = 0; i < values_.size(); ++i)
      cells_.push_back(map_.pins[i].type == host::PinType::Float ? host::PinCell{.real = &values_[i].real}
                                                                 : host::PinCell{.bit = &values_[i].bit});
    devices.connectAxes(cells_.data(), host::kVariables);
    real("position-feedback") = 5;
    bit("homed") = bit("enabled") = true;
    begin();
    set("AXIS", 4);
    set("ALLOW", 1);
    set("EACH", 1);
  }
  double& real(const std::string& pin) { return value(pin).real; }
  bool& bit(const std::string& pin) { return value(pin).bit; }
  double command() { return real("position-command"); }

  // The drive is where the last step has commanded it, unless it does not follow.
  void stepDrive(int64_t ns = 1'000'000) {
    devices.step(ns);
    plc->runDue(ns);
    if (follows) real("position-feedback") = command();
  }
  void ms(int count) {
    for (int i = 0; i < count; ++i) stepDrive();
  }
  // POS_INIT, then POS_MODE and a feed of 100 mm/s; the ramp takes 0.2 s.
  void take() { order("TAKE"); }
  void move(int32_t micrometres) {
    set("LEN", micrometres);
    set("ACC", 500);
    set("FEED", int64_t{6000} << 16);
    order("BEGIN");
  }
  void order(const std::string& bit) {
    set(bit, 1);
    ms(40);
  }

  bool follows = true;

private:
  struct Value {
    double real = 0;
    bool bit = false;
  };
  Value& value(const std::string& pin) {
    const auto found = std::ranges::find(map_.pins, "table." + pin, &host::Pin::name);
    return values_.at(static_cast<size_t>(found - map_.pins.begin()));
  }
  host::File map_;
  std::vector<Value> values_;
  std::vector<host::PinCell> cells_;
};

} // namespace rung::test
