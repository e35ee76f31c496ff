// FANUC's simulated CNC where it is not that of GSK: modes, inverted overrides, interlocks, stops, the spindle, axes of
// the program, messages. Tests play the PLC. And slots beside it allocate nothing.
#include "tests/support/count_allocations.h"
#include "tests/unit/sim/pmc_machine.h"

namespace rung::sim::test {
namespace {

class FanucCnc : public testing::Test {
protected:
  static constexpr uint32_t kResetSlots = 26;                     // of the power-on
  static constexpr uint32_t kF = 1, kG = 2, kA = 4, kDisplay = 5; // spaces

  FanucCnc() {
    set("G8", 0x31);   // *IT, *ESP, *SP
    set("G130", 0xFF); // *IT of each axis
    machine_.slot(kResetSlots);
  }
  void set(const char* name, uint64_t value) { machine_.set(name, value); }
  void display(bool on) { machine_.instance().memory().writeByte(kDisplay, 0, on); } // ACT of DISPB
  uint64_t get(const char* name) { return machine_.get(name); }
  double mpos() { return *machine_.nc().quantity("MPOS.1"); }
  void load(const char* blocks) {
    const NcArgument argument{.key = "blocks", .isText = true, .text = blocks};
    EXPECT_EQ(machine_.nc().event(machine_.instance(), "program", {argument}), "");
  }
  void start() {
    set("G43", 1);
    set("G7.2", 1);
    machine_.slot();
    set("G7.2", 0);
    machine_.slot();
  }
  // Answers M, S and T by FIN as long as it takes.
  void answer(int slots) {
    for (int i = 0; i < slots; ++i) {
      machine_.slot();
      set("G4.3", (get("F7") & 0x0D) != 0 || (get("F8") & 0xF0) != 0);
    }
  }

  PmcMachine machine_{"fanuc",
                      {{"nc", "simulated"}, {"param.8010.2", "3"}, {"param.3404", "128"}},
                      {{1, 0, "1000 DOOR OPEN"}, {2, 0, "2000 OIL"}}};
};

TEST_F(FanucCnc, Modes) {
  const struct {
    uint64_t select, f3;
    bool reference;
  } kCases[] = {{0x00, 0x08, false}, {0x01, 0x20, false}, {0x21, 0x10, false}, {0x03, 0x40, false},
                {0x04, 0x02, false}, {0x05, 0x04, false}, {0x85, 0x00, true},  {0x06, 0x00, false}};
  for (const auto& c : kCases) {
    set("G43", c.select);
    machine_.slot();
    EXPECT_EQ(get("F3"), c.f3) << c.select;
    EXPECT_EQ(get("F4.5"), c.reference) << c.select;
  }
  EXPECT_EQ(machine_.nc().setQuantity("PARAM.8131", 0), ""); // no hand wheel
  set("G43", 4);
  machine_.slot();
  EXPECT_EQ(get("F3"), 0x01u);
}

// All bits 0 and all bits 1 stop; 100 % is the complement of 100.
TEST_F(FanucCnc, FeedOverrideIsInverted) {
  load("G91 G1 X100 F6000");
  const auto way = [&](uint64_t signals) {
    set("G12", signals);
    const double before = mpos();
    machine_.slot();
    return mpos() - before;
  };
  set("G12", 0xFF);
  start();
  EXPECT_EQ(way(0xFF), 0);
  EXPECT_EQ(way(0x00), 0);
  EXPECT_EQ(way(0xFF ^ 100), 800); // 0.001 mm in 8 ms
  EXPECT_EQ(way(0xFF ^ 50), 400);
  set("G6.4", 1); // OVC
  EXPECT_EQ(way(0xFF), 800);
}

TEST_F(FanucCnc, RapidOverride) {
  load("G91 G0 X1000");
  start();
  const auto way = [&] {
    const double before = mpos();
    machine_.slot();
    return mpos() - before;
  };
  EXPECT_EQ(way(), 1600); // ROV1 = ROV2 = 0 is 100 % of 12 m/min
  set("G14", 1);
  EXPECT_EQ(way(), 800);
  set("G14", 2);
  EXPECT_EQ(way(), 400);
  set("G14", 3);
  EXPECT_EQ(way(), 80); // F0
  set("G96", 0xFF ^ 10);
  EXPECT_EQ(way(), 160); // HROV: 10 %
  set("G96", 0xFF);
  EXPECT_EQ(way(), 0);
}

TEST_F(FanucCnc, JogByItsOverrideAndParameter) {
  set("G43", 5);
  set("G100.0", 1);
  set("G10:2", 0xFFFF); // 0 %
  machine_.slot(2);
  EXPECT_EQ(mpos(), 0);
  set("G10:2", 0xFFFF ^ 10000); // 100 % of 2000 mm/min
  machine_.slot(30);
  EXPECT_NEAR(mpos(), 8000, 1);
}

TEST_F(FanucCnc, InterlockOfAnAxis) {
  set("G43", 5);
  set("G100.0", 1);
  set("G10:2", 0xFFFF ^ 10000);
  set("G130", 0xFE);
  machine_.slot(3);
  EXPECT_EQ(mpos(), 0);
  EXPECT_EQ(machine_.nc().setQuantity("PARAM.3003", 4), ""); // ITX: not valid
  machine_.slot(3);
  EXPECT_GT(mpos(), 0);
}

// The program stops at M0: by *SP or SBK. Without that the CNC goes on.
TEST_F(FanucCnc, M0IsThePrograms) {
  set("G12", 0xFF ^ 100);
  load("M0; G91 G0 X1; M30");
  start();
  answer(40);
  EXPECT_EQ(mpos(), 1000);
  EXPECT_FALSE(get("F0.7"));
  load("M0; G91 G0 X1; M30");
  set("G46.1", 1); // SBK
  start();
  answer(40);
  EXPECT_EQ(mpos(), 1000);
  EXPECT_TRUE(get("F0.7"));
  EXPECT_FALSE(get("F0.5"));
}

// Programs answer M30 by RRW instead of FIN.
TEST_F(FanucCnc, ResetAndRewindEndsAProgram) {
  load("M30");
  start();
  machine_.slot(2);
  EXPECT_TRUE(get("F9.4"));
  EXPECT_TRUE(get("F0.7"));
  set("G8.6", 1);
  machine_.slot();
  EXPECT_TRUE(get("F1.1")); // RST
  EXPECT_FALSE(get("F0.7"));
  EXPECT_FALSE(get("F7.0"));
  set("G8.6", 0);
  machine_.slot(kResetSlots);
  EXPECT_FALSE(get("F1.1"));
}

TEST_F(FanucCnc, FiveFunctionsOfABlock) {
  load("M3 M8 M10 M20 M21");
  start();
  EXPECT_EQ(get("F10"), 3u);
  EXPECT_EQ(get("F14"), 8u);
  EXPECT_EQ(get("F16"), 10u);
  machine_.slot();
  EXPECT_EQ(get("F8"), 0xF0u);
  EXPECT_TRUE(get("F7.0"));
  const NcArgument six{.key = "blocks", .isText = true, .text = "M1 M2 M3 M4 M5 M6"};
  machine_.nc().event(machine_.instance(), "reset", {});
  machine_.slot(kResetSlots);
  EXPECT_EQ(machine_.nc().event(machine_.instance(), "program", {six}), "block 1: more than five M codes");
}

TEST_F(FanucCnc, TheSpindleTurnsAsTheProgramOrders) {
  load("S600; M30");
  set("G30", 100);
  set("G29.6", 1);
  start();
  answer(6);
  machine_.slot(20);
  EXPECT_EQ(machine_.nc().quantity("SPINDLE"), 0); // not ready, no direction
  set("G70", 0x90);                                // MRDYA, SRVA
  set("G71.1", 1);                                 // *ESPA
  machine_.slot(20);
  EXPECT_EQ(machine_.nc().quantity("SPINDLE"), -600);
  EXPECT_TRUE(get("F45.3"));
  EXPECT_EQ(get("F36:2"), 409u); // 600 of 6000 r/min
  set("G70", 0xA0);              // SFRA
  machine_.slot(40);
  EXPECT_EQ(machine_.nc().quantity("SPINDLE"), 600);
  set("G33", 0xE0); // SIND, SSIN, SGN
  set("G32", 0xFF);
  set("G33", 0xEF);
  machine_.slot(200);
  EXPECT_EQ(machine_.nc().quantity("SPINDLE"), -6000);
  set("G71.1", 0);
  machine_.slot(200);
  EXPECT_TRUE(get("F45.1"));
}

// Group C has axis 2: distances in 0.001 mm, feed overrides inverted.
TEST_F(FanucCnc, AxesOfTheProgram) {
  set("G136.1", 1);
  set("G175", 0xFF ^ 100);
  set("G167", 1); // cutting feed
  set("G168:2", 6000);
  set("G170:4", 2500);
  set("G166.7", 1); // EBUF
  machine_.slot();
  EXPECT_TRUE(get("F136.7")); // EBSY
  EXPECT_TRUE(get("F182.1"));
  machine_.slot(10);
  EXPECT_EQ(machine_.nc().quantity("MPOS.2"), 2500);
  EXPECT_FALSE(get("F136.4"));
  EXPECT_FALSE(get("F136.2"));
  EXPECT_EQ(get("F104"), 7u); // in position
}

TEST_F(FanucCnc, ACommandBeforeTheReferencePointIsAnAlarm) {
  PmcMachine machine("fanuc", {{"nc", "simulated"}, {"encoders", "incremental"}, {"param.8010", "1"}});
  machine.set("G8", 0x31);
  machine.slot(kResetSlots);
  machine.set("G136.0", 1);
  machine.set("G143", 7);
  machine.set("G144:2", 1000);
  machine.set("G142.7", 1);
  machine.slot(2);
  EXPECT_EQ(machine.nc().quantity("ALARM"), 224);
  EXPECT_TRUE(machine.get("F130.2"));
  EXPECT_TRUE(machine.get("F1.0"));
}

TEST_F(FanucCnc, AMessageFrom1000OnIsAnAlarm) {
  load("G4 P400; M30");
  start();
  EXPECT_TRUE(get("F0.5"));
  set("A0.1", 1); // an operator message
  display(true);
  machine_.slot();
  EXPECT_FALSE(get("F1.0"));
  set("A0.0", 1);
  machine_.slot();
  EXPECT_TRUE(get("F1.0"));
  EXPECT_TRUE(get("F0.4")); // held
  set("A0.0", 0);
  machine_.slot();
  EXPECT_FALSE(get("F1.0"));
}

// Number, axis and value of external data input: 16 bits from G0, address and strobe in G2.
TEST_F(FanucCnc, ExternalDataInput) {
  set("G0:2", 0xFFFF & -250);
  set("G2", 0x80 | 0x10 | 2); // offset 3
  machine_.slot();
  EXPECT_TRUE(get("F60.0"));
  machine_.slot();
  EXPECT_TRUE(get("F60.1"));
  EXPECT_EQ(machine_.nc().quantity("OFFSET.H.3"), -0.25);
  set("G2", 0);
  machine_.slot();
  EXPECT_EQ(get("F60"), 0u);
}

TEST_F(FanucCnc, OverTravel) {
  PmcMachine machine("fanuc", {{"nc", "simulated"}, {"overtravel", "on"}});
  machine.set("G8", 0x31);
  machine.set("G114", 0xFF);
  machine.set("G116", 0xFD);
  machine.slot();
  EXPECT_EQ(machine.nc().quantity("ALARM"), 507);
  EXPECT_EQ(machine.get("F126"), 2u);
}

TEST_F(FanucCnc, SlotsAllocateNothing) {
  for (const char* tool : {"TOOL", "NEXTTOOL"}) ASSERT_EQ(machine_.nc().setQuantity(tool, 1), "");
  load("G1 F6000 X1; G4 P40; M3 M8 S100; G28 Z1; M6 T2; M30");
  set("G12", 0xFF ^ 100);
  display(true);
  start();
  const int64_t all[] = {28, 12, 0, 0xFFFF}, parameter[] = {17, 2, 1423, 1};
  const core::Memory memory = machine_.instance().memory();
  EXPECT_EQ(rung::test::allocationsOf([&] {
              for (int i = 0; i < 200; ++i) {
                machine_.instance().services().request(0, all, 4);
                machine_.instance().services().request(0, parameter, 4);
                memory.writeBit(kA, 0, 1, i % 2 == 0);
                machine_.slot();
                memory.writeBit(kG, 4, 3, (memory.readByte(kF, 7) | memory.readByte(kF, 8)) != 0);
              }
            }),
            0);
  EXPECT_EQ(mpos(), 1000);
}

} // namespace
} // namespace rung::sim::test
