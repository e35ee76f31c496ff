// A compiled program with its control alone, switched on; the test plays the host.
#pragma once
#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>
#include <string_view>

#include "rtlib/nc/control/technol/technol_control.h"
#include "tests/unit/technol/program.h"

namespace rung::technol_test {

class WithControl : public ::testing::Test {
protected:
  explicit WithControl(const Parts& parts) : compilation_(compile({programText(parts)})) {
    if (!compilation_.module) throw std::runtime_error(compilation_.text());
    layout_ = std::make_unique<ir::Layout>(*compilation_.module, ir::LayoutOptions{});
    engine_ = std::make_unique<ir::InterpEngine>(*layout_, 1);
    instance_ = std::make_unique<runtime::Instance>(*engine_, &control_);
    control_.powerOn(*instance_, nc::PowerOn::Cold);
  }

  // Names of the program and of the interface.
  uint64_t get(std::string_view name) { return instance_->read(place(name)); }
  double real(std::string_view name) { return instance_->readReal(place(name)); }
  void set(std::string_view name, uint64_t value) { EXPECT_FALSE(instance_->write(place(name), value)); }

  nc::TechnolControl control_;
  Compilation compilation_;
  std::unique_ptr<ir::Layout> layout_;
  std::unique_ptr<ir::InterpEngine> engine_;
  std::unique_ptr<runtime::Instance> instance_;

private:
  runtime::Ref place(std::string_view name) {
    const auto found = control_.readPlace(instance_->program(), name);
    EXPECT_TRUE(found) << name;
    return found.value_or(runtime::Ref{});
  }
};

} // namespace rung::technol_test
