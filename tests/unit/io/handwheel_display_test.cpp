// The display of a handwheel panel (man. 8.4.3).
#include "sim/technol/devices/keyboards.h"

#include <gtest/gtest.h>

namespace {

struct Display : testing::Test {
  void show(std::array<uint8_t, 8> order) { display.show(order); }
  rung::sim::technol::HandwheelDisplay display;
};

TEST_F(Display, TheManualsExample) { // l.7517-7531
  show({0, 16, 'A', 'b', 'c', 0xFF, 0, 0});
  EXPECT_EQ(display.text(0, 16), "Abc");
  EXPECT_EQ(display.text(0, 22), "bc");
  EXPECT_EQ(display.text(0, 17), "") << "no character begins there";
  EXPECT_EQ(display.text(8, 16), "");
}

TEST_F(Display, TransparentCharactersStay) {
  show({8, 0, 'A', 'B', 'C', 'D', 0, 0});
  show({8, 0, 0xFF, 'x', 0xFF, 'y', 0, 1});
  EXPECT_EQ(display.text(8, 0), "AxCy");
  EXPECT_FALSE(display.isInverted(8, 0));
  EXPECT_TRUE(display.isInverted(8, 6));
}

TEST_F(Display, LargeCharacters) {
  show({16, 0, '1', '2', '3', '4', 1, 0});
  EXPECT_EQ(display.text(16, 0), "1234");
  EXPECT_EQ(display.text(16, 12), "234");
  show({24, 12, 'a', 'b', 'c', 'd', 0, 0}); // over the lower half of 2, 3
  EXPECT_EQ(display.text(16, 0), "1");
  EXPECT_EQ(display.text(16, 36), "4") << "d ends before it";
  EXPECT_EQ(display.text(24, 12), "abcd");
}

TEST_F(Display, AtTheEdges) {
  show({56, 116, 'a', 'b', 'c', 'd', 0, 0});
  EXPECT_EQ(display.text(56, 116), "ab") << "128 columns";
  show({57, 0, 'a', 'b', 'c', 'd', 0, 0});
  EXPECT_EQ(display.text(57, 0), "") << "64 rows";
  show({255, 255, 'a', 'b', 'c', 'd', 1, 1});
  EXPECT_EQ(display.text(255, 255), "");
}

TEST_F(Display, OtherSizesShowNothing) {
  show({0, 0, 'a', 'b', 'c', 'd', 8, 0}); // graphic
  EXPECT_EQ(display.text(0, 0), "");
}

TEST_F(Display, Cleared) {
  show({0, 0, 'a', 'b', 'c', 'd', 0, 0});
  display.clear();
  EXPECT_EQ(display.text(0, 0), "");
  show({0, 0, 'a', 'b', 'c', 'd', 0, 0});
  EXPECT_EQ(display.text(0, 0), "abcd");
}

} // namespace
