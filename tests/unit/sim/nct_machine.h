// An NCT program of nothing but its memory, beside its simulated control: tests play the PLC. The memory begins like
// that of a compiled program: PLCNVRAM 4000, PLCRAM 5024.
#pragma once
#include <gtest/gtest.h>

#include "rtlib/nc/nct/operand_block.h"
#include "sim/machine.h"
#include "tests/unit/rtlib/test_program.h"

namespace rung::sim::test {

class NctMachine {
public:
  using Config = std::vector<std::pair<std::string, std::string>>; // keys and values

  explicit NctMachine(const Config& config = {}) {
    program_.dialect = "nct";
    program_.services = {"MR function address block -> code",    "MW function address block -> code",
                         "MACR variable channel -> value:f",     "MACW variable channel value:f ->",
                         "MOVCMND axis code speed:f distance:f", "SCP symbol p1 p2 -> value:f"};
    constexpr uint32_t kMemory = 40000;
    constexpr uint32_t kSlice = 16000;
    constexpr uint32_t kBlocks = 4 * nc::nct::kBlockStride;
    program_.memorySize = kMemory + kSlice + kBlocks;
    program_.addPacked("M", 4, kMemory, 0);
    program_.addPacked("TS", 4, kSlice, kMemory);
    blocks_ = program_.addPacked(nc::nct::kBlockSpace, 4, kBlocks, kMemory + kSlice);
    program_.retains = {{16000, 4096}};
    program_.addTask("MAIN",
                     program_.addChunk([](uint8_t*, rung_ctx* ctx, uint32_t) { return rung::test::popChunk(ctx); }));
    program_.addBeginCopy(0, {RUNG_COPY_ALL, kMemory + 4, 4, 0, kSlice - 4});
    program_.scan.clear();
    for (int i = 0; i < 5; ++i) {
      program_.scan.push_back({RUNG_STEP_ADVANCE, RUNG_NONE, 2000});
      program_.scan.push_back({RUNG_STEP_HOOK, RUNG_NONE, 0});
    }
    program_.scan.push_back({RUNG_STEP_RUN, 0, 1});
    program_.scan.push_back({RUNG_STEP_SLOT, RUNG_NONE, 0});
    program_.fast = {{RUNG_STEP_ADVANCE, RUNG_NONE, 2000}, {RUNG_STEP_HOOK, RUNG_NONE, 0}};
    machine_ = std::make_unique<Machine>(program_.link(), nullptr, makeSimulatedNct());
    EXPECT_EQ(nc().config("nc", "simulated"), "");
    for (const auto& [key, value] : config) EXPECT_EQ(nc().config(key, value), "") << key;
    machine_->powerOn(nc::PowerOn::Cold);
  }

  void set(const char* name, uint64_t value) { EXPECT_EQ(instance().write(place(name, true), value), std::nullopt); }
  uint64_t get(const char* name) { return instance().read(place(name, false)); }
  void scan(int count = 1) {
    for (int i = 0; i < count; ++i) machine_->scan();
  }

  // A request of MR or MW with words 1, 2…; its answer, -1 while it is pending.
  uint32_t request(bool write, int64_t function, const std::vector<int32_t>& words) {
    for (uint32_t i = 0; i < nc::nct::kBlockStride; ++i) instance().memory().write(blocks_, 4 * i, 4, 0);
    for (uint32_t i = 0; i < words.size(); ++i)
      instance().memory().write(blocks_, 4 * (i + 1), 4, static_cast<uint32_t>(words[i]));
    const int64_t args[] = {function, 7000, 0};
    return instance().services().request(write ? 1 : 0, args, 3);
  }
  int64_t answer(uint32_t ticket) {
    instance().services().deliver();
    return instance().services().poll(ticket) == RUNG_SERVICE_DONE ? instance().services().result(ticket, 0) : -1;
  }
  int64_t ask(bool write, int64_t function, const std::vector<int32_t>& words, int scans = 1) {
    const uint32_t ticket = request(write, function, words);
    scan(scans);
    return answer(ticket);
  }
  int32_t blockWord(uint32_t n) { return static_cast<int32_t>(instance().memory().read(blocks_, 4 * n, 4)); }

  int32_t word(uint32_t address) { return static_cast<int32_t>(instance().memory().read(0, 4 * address, 4)); }
  void setWord(uint32_t address, int32_t value) {
    instance().memory().write(0, 4 * address, 4, static_cast<uint32_t>(value));
  }

  Machine& machine() { return *machine_; }
  SimulatedNc& nc() { return machine_->nc(); }
  runtime::Instance& instance() { return machine_->inside(); }

private:
  runtime::Ref place(const char* name, bool write) {
    const auto found = write ? nc().writePlace(instance().program(), name) : nc().readPlace(instance().program(), name);
    EXPECT_TRUE(found) << name;
    return found.value_or(runtime::Ref{});
  }

  rung::test::TestProgram program_;
  uint32_t blocks_ = 0;
  std::unique_ptr<Machine> machine_;
};

} // namespace rung::sim::test
