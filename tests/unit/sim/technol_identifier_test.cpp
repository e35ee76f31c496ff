// Identifiers of logical inputs and outputs, and the elements of modules that are not simulated.
#include <gtest/gtest.h>

#include "rtlib/nc/control/technol/identifier.h"
#include "sim/technol/module_cells.h"

namespace rung::sim::technol {
namespace {

TEST(TechnolIdentifier, ZeroIndicesAndCaseDoNotCount) {
  EXPECT_EQ(nc::technol::canonical("BunIn1[02].Prvek"), "BUNIN1[2].PRVEK");
  EXPECT_EQ(nc::technol::canonical("PrecitecEG8030[0].BodyTouch"), "PRECITECEG8030.BODYTOUCH");
  EXPECT_EQ(nc::technol::canonical(" RTM.Axis[2].Pos0_AX"), "RTM.AXIS[2].POS0_AX");
  EXPECT_EQ(nc::technol::canonical("CNC.PLC.Output.A[000]"), "PLC.OUTPUT.A");
  EXPECT_EQ(nc::technol::canonical("ECAT.Inputs.Status word"), "ECAT.INPUTS.STATUS WORD");
  EXPECT_EQ(nc::technol::canonical("a[x].b[]"), "A[X].B[]"); // no indices
  EXPECT_EQ(nc::technol::canonical(""), "");
}

TEST(TechnolIdentifier, AConnectionAddsElementAndBit) {
  const nc::technol::Reference bit = nc::technol::withoutBit("A.B[3].BIT[7]");
  EXPECT_EQ(bit.base, "A.B[3]");
  EXPECT_EQ(bit.bit, 7u);
  const nc::technol::Reference both = withoutIndex(bit);
  EXPECT_EQ(both.base, "A.B");
  EXPECT_EQ(both.element, 3u);
  EXPECT_EQ(nc::technol::withoutBit("A.BIT").bit, 0u); // .Bit[0]
  EXPECT_FALSE(nc::technol::withoutBit("A.BITS[1]").bit);
  EXPECT_EQ(withoutIndex(nc::technol::withoutBit("A[2].B")).base, "A[2].B");
}

TEST(TechnolIdentifier, ElementsOfModules) {
  std::string problem;
  const auto key = [&](std::string_view name) {
    const auto element = moduleElement(nc::technol::canonical(name), problem);
    return element ? element->key : std::string();
  };
  EXPECT_EQ(key("RTM.Axis[2].Pos0_AX"), key("RTM.Axis.Pos0_Ax[2]")); // man. l.12753
  EXPECT_NE(key("RTM.Axis[2].Pos0_AX"), key("RTM.Axis.Pos0_Ax"));
  EXPECT_FALSE(key("RTM.Axis[15].Pos0_Ax").empty());
  EXPECT_TRUE(key("RTM.Axis[16].Pos0_Ax").empty());
  EXPECT_TRUE(key("RTM.Axis.Pos0_Ax[16]").empty());
  EXPECT_FALSE(key("RTM.Servo[3].Edrv.DrivePos").empty());
  EXPECT_TRUE(key("RTM.Servo[3].Edrv.Nothing").empty());
  EXPECT_FALSE(key("VKeyboard.VKey[255]").empty());
  EXPECT_TRUE(key("VKeyboard.VKey[256]").empty());
  EXPECT_EQ(moduleElement("VKEYBOARD.VKEY", problem)->isSource, false);
  EXPECT_EQ(moduleElement("RTM.CONTROL.M03", problem)->isDestination, false);
}

TEST(TechnolIdentifier, CellsKeepTheirType) {
  ModuleCells cells;
  EXPECT_TRUE(
      cells.write("RTM.Servo[1].ICounter_S", {.isReal = false, .width = 64, .bits = static_cast<uint64_t>(-2)}));
  EXPECT_EQ(cells.read("rtm.servo[1].icounter_s")->bits, 0xFFFFFFFEu);
  EXPECT_EQ(cells.read("RTM.Servo[1].ICounter_S.Bit[0]")->bits, 0u);
  EXPECT_TRUE(cells.write("RTM.Servo[1].ICounter_S.Bit[0]", {.isReal = false, .width = 64, .bits = 1}));
  EXPECT_EQ(cells.read("RTM.Servo[1].ICounter_S")->bits, 0xFFFFFFFFu);
  EXPECT_TRUE(cells.read("RTM.Spindle.ActSpeedPm")->isReal);
  EXPECT_FALSE(cells.read("ECAT.Anything")); // no connection tells its type
  EXPECT_FALSE(cells.write("RTM.Spindle.Nothing", {}));
  cells.reset();
  EXPECT_EQ(cells.read("RTM.Servo[1].ICounter_S")->bits, 0u);
}

} // namespace
} // namespace rung::sim::technol
