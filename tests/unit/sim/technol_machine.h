// The simulated TECHNOL control around a program of nothing but the interface and the requests of instructions; the
// test plays the program.
#pragma once
#include <gtest/gtest.h>

#include "rtlib/nc/technol/exchange.h"
#include "rtlib/nc/technol/services.h"
#include "rtlib/nc/technol/signals.h"
#include "sim/machine.h"
#include "tests/unit/rtlib/test_program.h"

namespace rung::sim {

enum Service : uint32_t {
  kSend,
  kReceive,
  kItem,
  kDrive,
  kCom,
  kComReceive,
  kUpload,
  kAnalog,
  kInit,
  kMode,
  kControl,
  kRead,
  kData
};

class TechnolMachine {
public:
  using Pairs = std::vector<std::pair<std::string, std::string>>;
  // Keys and values; sources and destinations.
  explicit TechnolMachine(const Pairs& config, const Pairs& connections = {}) {
    program_.dialect = "technol";
    program_.memorySize = 1u << 20;
    program_.services = {"CAN_SEND can id rtr len data:b -> DR",
                         "CAN_RECV can -> DR id rtr data:b",
                         "CAN_SYSIO_READ can group board item -> RLO DR",
                         "CAN_AX_SEND axis data:b -> data:b",
                         "COM_SEND com val -> RLO",
                         "COM_RECV com -> RLO DR",
                         "ECAT_COE_READ Master Slave Index Subindex Len -> DR Len Val:b",
                         "ANALOG_SPI val axis -> port out:f",
                         "POS_INIT axis space",
                         "POS_MODE len accel axis -> control",
                         "POS_CONTROL feed mp axis -> status control",
                         "SA_READ SAIdx Offset Size -> RLO DR Val:b",
                         nc::technol::deviceService(nc::technol::ServiceKind::FetchBytes).service.text.data()};
    program_.addPacked("NCI", 1, nc::areaBytes(nc::technolSignals(), "I"), 0);
    program_.addTask("MAIN",
                     program_.addChunk([](uint8_t*, rung_ctx* ctx, uint32_t) { return rung::test::popChunk(ctx); }));
    program_.scan = {{RUNG_STEP_ADVANCE, 0, 20'000}, {RUNG_STEP_HOOK, 0, nc::kHookBeforeInput}, {RUNG_STEP_RUN, 0, 1}};
    program_.fast = program_.scan;
    machine_ = std::make_unique<Machine>(program_.link(), nullptr, makeSimulatedTechnol());
    for (const auto& [key, value] : config) EXPECT_EQ(machine_->nc().config(key, value), "");
    for (const auto& [source, destination] : connections) machine_->nc().connect(source, destination);
    machine_->powerOn(nc::PowerOn::Cold);
  }

  uint32_t ask(Service service, std::initializer_list<int64_t> args) {
    return inside().services().request(service, args.begin(), static_cast<uint32_t>(args.size()));
  }
  runtime::Instance& inside() { return machine_->inside(); }
  SimulatedNc& nc() { return machine_->nc(); }
  void scan() { machine_->scan(); }
  std::string event(const char* name, const std::vector<NcArgument>& keys) {
    return machine_->operate([&](SimulatedNc& nc, runtime::Instance& inside) { return nc.event(inside, name, keys); });
  }

private:
  rung::test::TestProgram program_;
  std::unique_ptr<Machine> machine_;
};

} // namespace rung::sim
