// A program of the PMC family of nothing but its areas, beside its simulated CNC: tests play the PLC.
#pragma once
#include <gtest/gtest.h>

#include "rtlib/nc/names/names.h"
#include "rtlib/nc/pmc/services.h"
#include "rtlib/nc/service.h"
#include "sim/machine.h"
#include "tests/unit/rtlib/test_program.h"

namespace rung::sim::test {

class PmcMachine {
public:
  using Config = std::vector<std::pair<std::string, std::string>>;

  PmcMachine(const char* dialect, const Config& config, const std::vector<rung_message_text>& texts = {}) {
    constexpr uint32_t kInterface = 768; // bytes of F and of G
    program_.dialect = dialect;
    program_.memorySize = 128 + 2 * kInterface + 32 + 32 + 1;
    const auto service = [&](nc::pmc::ServiceKind kind) {
      return nc::serviceOf(dialect, static_cast<uint32_t>(kind))->text.data();
    };
    program_.services = {service(nc::pmc::ServiceKind::ReadWindow), service(nc::pmc::ServiceKind::WriteWindow)};
    program_.texts = texts;
    uint32_t at = 0;
    const auto add = [&](const char* space, uint32_t bytes) {
      program_.addPacked(space, 1, bytes, at);
      at += bytes;
    };
    add("X", 128);
    add("F", kInterface);
    add("G", kInterface);
    add("@MPOS", 32);
    add("A", 32);
    add("@DISPB", 1);
    program_.addTask("LEVEL1",
                     program_.addChunk([](uint8_t*, rung_ctx* ctx, uint32_t) { return rung::test::popChunk(ctx); }));
    program_.scan = {{RUNG_STEP_ADVANCE, 0, 8000}, {RUNG_STEP_RUN, 0, 1}, {RUNG_STEP_SLOT, 0, 0}};
    program_.fast = program_.scan;
    machine_ = std::make_unique<Machine>(program_.link(), nullptr, makeSimulatedNc(dialect));
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

struct GskMachine : PmcMachine {
  explicit GskMachine(const Config& config) : PmcMachine("gsk", config) {}
};

} // namespace rung::sim::test
