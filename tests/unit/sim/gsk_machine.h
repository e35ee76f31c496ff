// A GSK program of nothing but its areas, beside its simulated CNC: tests play the PLC.
#pragma once
#include <gtest/gtest.h>

#include "rtlib/nc/names/names.h"
#include "sim/machine.h"
#include "tests/unit/rtlib/test_program.h"

namespace rung::sim::test {

class GskMachine {
public:
  explicit GskMachine(const std::vector<std::pair<std::string, std::string>>& config) {
    program_.dialect = "gsk";
    program_.memorySize = 1024;
    program_.services = {"windr function length number attribute -> end data",
                         "windw function length number attribute data -> end"};
    program_.addPacked("X", 1, 128, 0);
    program_.addPacked("F", 1, 256, 128);
    program_.addPacked("G", 1, 256, 384);
    program_.addPacked("@MPOS", 1, 32, 640);
    program_.addTask("LEVEL1",
                     program_.addChunk([](uint8_t*, rung_ctx* ctx, uint32_t) { return rung::test::popChunk(ctx); }));
    program_.scan = {{RUNG_STEP_ADVANCE, 0, 8000}, {RUNG_STEP_RUN, 0, 1}, {RUNG_STEP_SLOT, 0, 0}};
    program_.fast = program_.scan;
    machine_ = std::make_unique<Machine>(program_.link(), nullptr, makeSimulatedGsk());
    for (const auto& [key, value] : config) EXPECT_EQ(nc().config(key, value), "");
    machine_->powerOn(nc::PowerOn::Cold);
  }

  void set(const char* name, uint64_t value) { EXPECT_EQ(instance().write(place(name), value), std::nullopt); }
  uint64_t get(const char* name) { return instance().read(place(name)); }
  void slot(int count = 1) {
    for (int i = 0; i < count; ++i) machine_->slot();
  }
  Machine& machine() const { return *machine_; }
  SimulatedNc& nc() const { return machine_->nc(); }
  runtime::Instance& instance() const { return machine_->inside(); }

private:
  runtime::Ref place(const char* name) {
    const auto found = nc::resolve(instance().program(), name);
    EXPECT_TRUE(found) << name;
    return found.value_or(runtime::Ref{});
  }

  rung::test::TestProgram program_;
  std::unique_ptr<Machine> machine_;
};

} // namespace rung::sim::test
