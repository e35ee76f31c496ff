// Scans beside the simulated TECHNOL control allocate nothing, whatever its devices do: axes that move, packets,
// service data of drives, serial ports, mailboxes, tables and shared areas.
#include <gtest/gtest.h>

#include "rtlib/nc/control/technol/cells.h"
#include "rtlib/nc/technol/exchange.h"
#include "rtlib/nc/technol/services.h"
#include "rtlib/nc/technol/signals.h"
#include "tests/support/count_allocations.h"
#include "tests/unit/rtlib/test_program.h"
#include "tools/sim/machine.h"

namespace {

using namespace rung;
using namespace rung::sim;

enum Service : uint32_t { kSend, kDrive, kCom, kUpload, kAnalog, kInit, kMode, kControl, kRead, kData };

// A program of nothing but the interface and the requests of instructions; the test plays the program.
class TechnolMachine {
public:
  explicit TechnolMachine(const std::vector<std::pair<std::string, std::string>>& config) {
    program_.dialect = "technol";
    program_.memorySize = 1u << 20;
    program_.services = {"CAN_SEND can id rtr len data:b -> DR",
                         "CAN_AX_SEND axis data:b -> data:b",
                         "COM_SEND com val -> RLO",
                         "ECAT_COE_READ Master Slave Index Subindex Len -> DR Len Val:b",
                         "ANALOG_SPI val axis -> port out:f",
                         "POS_INIT axis space",
                         "POS_MODE len accel axis -> control",
                         "POS_CONTROL feed mp axis -> status control",
                         "SA_READ SAIdx Offset Size -> RLO DR Val:b",
                         nc::technol::kDataService.data()};
    program_.addPacked("NCI", 1, nc::areaBytes(nc::technolSignals(), "I"), 0);
    program_.addTask("MAIN", program_.addChunk([](uint8_t*, rung_ctx* ctx, uint32_t) { return test::popChunk(ctx); }));
    program_.scan = {{RUNG_STEP_ADVANCE, 0, 20'000}, {RUNG_STEP_HOOK, 0, nc::kHookBeforeInput}, {RUNG_STEP_RUN, 0, 1}};
    program_.fast = program_.scan;
    machine_ = std::make_unique<Machine>(program_.link(), nullptr, makeSimulatedTechnol());
    for (const auto& [key, value] : config) EXPECT_EQ(machine_->nc().config(key, value), "");
    machine_->powerOn(nc::PowerOn::Cold);
  }

  uint32_t ask(Service service, std::initializer_list<int64_t> args) {
    return inside().services().request(service, args.begin(), static_cast<uint32_t>(args.size()));
  }
  host::Instance& inside() { return machine_->inside(); }
  SimulatedNc& nc() { return machine_->nc(); }
  void scan() { machine_->scan(); }

private:
  test::TestProgram program_;
  std::unique_ptr<Machine> machine_;
};

TEST(TechnolNoAllocation, DevicesAtWork) {
  TechnolMachine machine({{"nc", "simulated"},
                          {"CAN[1].InOut08Cnt", "32"},
                          {"CAN[0].Drives", "3"},
                          {"COM[1].Active", "1"},
                          {"ethercat.0", "coe"},
                          {"ethercat.0.coe.0x6041.0", "0x237/2 ro"}});
  constexpr int64_t kFeed = int64_t{6000} << 16; // 6000 mm/min
  for (const char* cell : {"VAZBA_4", "MP4PI"}) nc::technol::writeCell(machine.inside(), cell, 1);
  machine.ask(kInit, {4, 0});
  machine.ask(kMode, {1'000'000, 500, 4});
  machine.scan(); // what is written to a message or a text for the first time
  EXPECT_EQ(allocationsOf([&] {
              for (int i = 0; i < 10'000; ++i) {
                machine.ask(kSend, {2, 0x10, 0, 2, nc::technol::bytesArgument(0, 2, 0)});
                machine.ask(kDrive, {1, nc::technol::bytesArgument(0, 8, 0)});
                machine.ask(kCom, {1, 'A'});
                machine.ask(kControl, {kFeed, 1, 4});
                machine.ask(kAnalog, {i, 1});
                const uint32_t read = machine.ask(kRead, {0, 100, 1000});
                machine.ask(kData, {read, 3});
                machine.ask(kUpload, {0, 0, 0x6041, 0, 2});
                machine.scan();
              }
            }),
            0);
  EXPECT_NEAR(machine.nc().quantity("MPOS.4").value_or(0), 1000, 0.001);
}

} // namespace
