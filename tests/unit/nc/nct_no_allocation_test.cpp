// Scans beside the simulated NCT control allocate nothing: axes and spindles that move, requests of every kind that are
// answered or at work, the image of what is kept.
#include <gtest/gtest.h>

#include "tests/support/count_allocations.h"
#include "tests/unit/nc/nct_machine.h"

namespace {

using namespace rung::nc;
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
  std::vector<uint8_t> image(machine.nc().keptSize());
  const std::vector<std::pair<bool, std::vector<int32_t>>> requests = {
      {true, {11, 3, 0, 4000, 1024}}, {false, {10, 3, 0, 4000, 1024}}, {true, {34, 3, 1209, 0, 1}},
      {false, {31, 34, 501, 1}},      {true, {40, 2, 1, 1}},           {true, {63, 6, 1, 6000, 10, 0, 0, 0}},
      {false, {62, 6, 1, 6000, 10}},  {true, {70, 2, 1000, 0}},        {true, {81, 3, 1, 0, 5}},
      {true, {90, 3, 0}},             {false, {201, 6, 3, 1, 4, 6000, 5}}, {true, {202, 4, 15, 1, 4, 6000}},
      {true, {61, 1, 1}},             {true, {60, 5, 1, 0, 2, 1, 49300}},  {true, {999, 1}}};
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
      machine.nc().fast(machine.instance());
      machine.nc().copyKept(image);
    });
    EXPECT_EQ(count, 0) << "function " << words[0];
  }
}

} // namespace
