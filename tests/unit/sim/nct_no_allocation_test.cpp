// Scans beside the simulated NCT control allocate nothing: axes and spindles that move, requests of every kind that are
// answered or at work, the image of what is kept.
#include <gtest/gtest.h>

#include "tests/support/count_allocations.h"
#include "tests/unit/sim/nct_machine.h"

namespace {

using namespace rung::sim;
using rung::test::allocationsOf;
using test::NctMachine;

TEST(NctNoAllocation, CounterCounts) {
  EXPECT_GT(allocationsOf([] { NctMachine machine; }), 0);
}

TEST(NctNoAllocation, Scans) {
  NctMachine machine({{"ethercat.1", "coe+soe+voe"}, {"ethercat.1.coe.5.0", "1"}, {"axes", "XYZ"}});
  const NcArgument open{.key = "open", .isText = true, .text = "udp"};
  const NcArgument port{.key = "port", .integer = 49203};
  ASSERT_EQ(machine.ask(true, 60, {5, 1, 0, 1, 0x01010101, 49203}), 0);
  ASSERT_EQ(machine.nc().event(machine.instance(), "device", {open, port}), "");
  for (const char* signal : {"AP_PLCR", "AP_GOR", "SP_SEN", "SP_SSTRT", "SP_PAR", "AP_SYNCR,#1", "DP_ENA2"})
    machine.set(signal, 1);
  machine.scan(3);
  std::vector<uint8_t> image(machine.nc().retainedSize());
  const std::vector<std::pair<bool, std::vector<int32_t>>> requests = {{true, {11, 3, 0, 4000, 1024}},
                                                                       {false, {10, 3, 0, 4000, 1024}},
                                                                       {true, {34, 3, 1209, 0, 1}},
                                                                       {false, {31, 34, 501, 1}},
                                                                       {true, {40, 2, 1, 1}},
                                                                       {true, {63, 6, 1, 6000, 10, 0, 0, 0}},
                                                                       {false, {62, 6, 1, 6000, 10}},
                                                                       {true, {70, 2, 1000, 0}},
                                                                       {true, {81, 3, 1, 0, 5}},
                                                                       {true, {90, 3, 0}},
                                                                       {false, {201, 6, 3, 1, 4, 6000, 5}},
                                                                       {true, {202, 4, 15, 1, 4, 6000}},
                                                                       {true, {61, 1, 1}},
                                                                       {true, {60, 5, 1, 0, 2, 1, 49300}},
                                                                       {true, {999, 1}}};
  const int64_t move[] = {0, 1, 0, std::bit_cast<int64_t>(5.0)};
  const int64_t macro[] = {500, 0, 0};
  for (const auto& [write, words] : requests) {
    const std::vector<int32_t> operands(words.begin() + 1, words.end());
    const int count = allocationsOf([&] {
      machine.instance().services().request(4, move, 4);
      machine.instance().services().request(2, macro, 2);
      machine.instance().services().request(3, macro, 3);
      machine.request(write, words[0], operands);
      machine.scan(3);
      machine.machine().fast();
      machine.nc().copyRetained(image);
    });
    EXPECT_EQ(count, 0) << "function " << words[0];
  }
}

// Part programs with motion, functions and interruptions beside the tables of tools and pallets.
TEST(NctNoAllocation, Programs) {
  NctMachine machine({{"axes", "XYZ"}, {"cartridge.3", "9x9"}});
  const auto event = [&](std::string_view name, const std::vector<NcArgument>& keys) {
    EXPECT_EQ(machine.nc().event(machine.instance(), name, keys), "") << name;
  };
  const auto key = [](const char* name, int64_t value) { return NcArgument{.key = name, .integer = value}; };
  event("tool", {key("data", 1), key("type", 5), key("status", 1), key("life", 1), key("cartridge", 10)});
  event("tool",
        {key("data", 2), key("type", 6), key("info", 0x15), key("figure", 1), key("cartridge", 3), key("pot", 40)});
  event("pallet", {key("magazine", 10), key("id", 8), key("assigned", 1), key("program1", 100)});
  event("program", {key("number", 100),
                    key("channel", 1),
                    {.key = "blocks",
                     .isText = true,
                     .text = "N1 #500=2 G0 X5 M6 T5; IF #500 EQ 1 GOTO 1; G84 Z-1 R0 F600; G4 P0.1; M3 S100; GOTO 1"}});
  for (const char* signal : {"CP_AUTO", "CP_FIN", "CP_CBFEN"}) machine.set(signal, 1);
  for (const char* real : {"CP_FOVER", "CP_ROVER"}) machine.set(real, std::bit_cast<uint64_t>(1.0));
  machine.scan(2);
  machine.set("CP_START", 1);
  const std::vector<std::pair<bool, std::vector<int32_t>>> requests = {
      {true, {100, 4, 10, 1, 1, 1}},  {false, {101, 7, 3, 1, 0, 3, 40}},
      {true, {102, 3, 1, 2, 7}},      {true, {103, 3, 1, 2, 8}},
      {false, {104, 55, 1, 2}},       {true, {105, 2, 1, 2}},
      {true, {106, 4, 3, 40, 5, 1}},  {false, {107, 4, 3, 40, 5}},
      {false, {108, 4, 0, 0, 14, 1}}, {true, {300, 3, 1, 1, 10}},
      {true, {303, 3, 1, 1, 9}},      {false, {304, 14, 1, 1}},
      {true, {306, 4, 1, 1, 1, 4}},   {false, {307, 4, 1, 1, 2}},
      {false, {308, 6, 2, 4, 1, 0}},  {false, {309, 50, 1, 1, 1}},
      {true, {41, 2, 8, 2}}};
  for (const auto& [write, words] : requests) {
    const std::vector<int32_t> operands(words.begin() + 1, words.end());
    const int count = allocationsOf([&] {
      machine.request(write, words[0], operands);
      machine.scan(30);
      machine.set("CP_MDI", write); // interrupts, and goes on
      machine.set("CP_AUTO", !write);
      machine.set("CP_START", !write);
      machine.scan(3);
    });
    EXPECT_EQ(count, 0) << "function " << words[0];
  }
  EXPECT_GT(machine.nc().quantity("MPOS.1").value_or(0), 1);
}

} // namespace
