// Names of mapping files in programs of the three dialects.
#include "tools/rung-hal/binding.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rtlib/host/program_info.h"
#include "tests/unit/rung_hal/test_program.h"

namespace rung::hal {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

struct Bound {
  Binding binding;
  std::vector<std::string> errors;
};

Bound boundTo(const rung_program& program, std::string_view text) {
  EXPECT_EQ(host::checkProgram(program), "");
  Bound bound;
  const MapFile map = parseMap(text, "m.map", bound.errors);
  host::Instance instance(program);
  const std::unique_ptr<nc::Control> control = nc::makeControl(program.dialect);
  bound.binding = bindMap(map, instance, *control, bound.errors);
  return bound;
}

std::vector<std::string> gskErrors(std::string_view text) { return boundTo(testing::gskProgram(), text).errors; }

TEST(Binding, AddressesSymbolsAndSignalsOfGsk) {
  const Bound bound =
      boundTo(testing::gskProgram(), "in bit a X000.3\nout bit b SYM\nin s32 c F10:4\nout bit fin FIN\n");
  EXPECT_THAT(bound.errors, IsEmpty());
  ASSERT_EQ(bound.binding.inputs.size(), 2u);
  EXPECT_EQ(bound.binding.inputs[0].place, host::bitRef(0, 0, 3));
  EXPECT_EQ(bound.binding.inputs[1].place, host::intRef(2, 10, 32));
  ASSERT_EQ(bound.binding.outputs.size(), 2u);
  EXPECT_EQ(bound.binding.outputs[0].place, host::bitRef(1, 1, 2));
  EXPECT_EQ(bound.binding.outputs[1].place, host::bitRef(3, 4, 3)); // FIN of the NC interface is G4.3
}

TEST(Binding, MachinePositions) {
  const Bound bound = boundTo(testing::gskProgram(), "in float a NC.MPOS.1 1000\nin s32 b NC.MPOS.8\n");
  EXPECT_THAT(bound.errors, IsEmpty());
  ASSERT_EQ(bound.binding.inputs.size(), 2u);
  const uint32_t space = host::findSpace(testing::gskProgram(), "@MPOS");
  EXPECT_EQ(bound.binding.inputs[0].place, host::intRef(space, 0, 32));
  EXPECT_EQ(bound.binding.inputs[0].scale, 1000);
  EXPECT_EQ(bound.binding.inputs[1].place, host::intRef(space, 28, 32));
  EXPECT_EQ(bound.binding.inputs[1].scale, 1);
  EXPECT_THAT(gskErrors("in bit a NC.MPOS.1\nin s32 b NC.MPOS.9\nin s32 c NC.MPOS.0\nout s32 d NC.MPOS.1\n"
                        "in s32 e NC.MPOS.x\n"),
              ElementsAre("m.map:1: NC.MPOS.1 is not a bit; s32, u32 or float is possible",
                          "m.map:2: NC.MPOS.9: axes are 1 to 8", "m.map:3: NC.MPOS.0: axes are 1 to 8",
                          "m.map:5: NC.MPOS.x: axes are 1 to 8",
                          "m.map:4: NC.MPOS.1 is written by HAL, not by the program"));
  EXPECT_THAT(boundTo(testing::nctProgram(), "in s32 a NC.MPOS.1\n").errors,
              ElementsAre("m.map:1: NC.MPOS.1: the program reads no machine positions"));
}

TEST(Binding, NctNamesAreTheHardwaresSide) {
  const Bound bound = boundTo(testing::nctProgram(), "in bit a 0056.17\nout s32 w 0400\nout float d 0400\n");
  EXPECT_THAT(bound.errors, IsEmpty());
  const uint32_t slice = host::findSpace(testing::nctProgram(), "TS");
  ASSERT_EQ(bound.binding.inputs.size(), 1u);
  EXPECT_EQ(bound.binding.inputs[0].place, host::bitRef(slice, 56 * 4, 17));
  ASSERT_EQ(bound.binding.outputs.size(), 2u);
  EXPECT_EQ(bound.binding.outputs[0].place, host::intRef(slice, 1600, 32));
  EXPECT_EQ(bound.binding.outputs[1].place, host::realRef(slice, 1600)); // a double in two words
}

TEST(Binding, TechnolCells) {
  const Bound bound = boundTo(testing::technolProgram(), "out float r realcell\nout s32 c COUNT\nout bit b COUNT.3\n");
  EXPECT_THAT(bound.errors, IsEmpty());
  const uint32_t data = host::findSpace(testing::technolProgram(), "DATA");
  ASSERT_EQ(bound.binding.outputs.size(), 3u);
  EXPECT_EQ(bound.binding.outputs[0].place, host::realRef(data, 0));
  EXPECT_EQ(bound.binding.outputs[1].place, host::intRef(data, 8, 16));
  EXPECT_EQ(bound.binding.outputs[2].place, host::bitRef(data, 8, 3));
}

TEST(Binding, FloatPinsConvertOtherIntegers) {
  const Bound bound = boundTo(testing::technolProgram(), "out float c COUNT\n");
  EXPECT_THAT(bound.errors, IsEmpty());
  ASSERT_EQ(bound.binding.outputs.size(), 1u);
  EXPECT_EQ(bound.binding.outputs[0].place.kind, host::RefKind::Int);
}

TEST(Binding, NamesThatDoNotFit) {
  EXPECT_THAT(gskErrors("# x\nin bit a NOWHERE"),
              ElementsAre("m.map:2: NOWHERE: the program has no such name or address"));
  EXPECT_THAT(gskErrors("in bit a X99.0"), ElementsAre("m.map:1: X99.0: the program has no such name or address"));
  EXPECT_THAT(gskErrors("in bit a Y0.0"),
              ElementsAre("m.map:1: Y0.0 is an output of the program; it cannot be written"));
  EXPECT_THAT(gskErrors("const bit Y0.0 1"),
              ElementsAre("m.map:1: Y0.0 is an output of the program; it cannot be written"));
  EXPECT_THAT(gskErrors("out bit a D0"),
              ElementsAre("m.map:1: D0 is not a bit; s32, u32, float or a bit of it is possible"));
  EXPECT_THAT(gskErrors("out u32 a SYM"), ElementsAre("m.map:1: SYM is a bit, not u32"));
  EXPECT_THAT(gskErrors("out s32 a LIMIT"), ElementsAre("m.map:1: LIMIT is a constant of the program"));
  EXPECT_THAT(boundTo(testing::technolProgram(), "out s32 a NAME").errors,
              ElementsAre("m.map:1: NAME is a text; HAL has no pins for texts"));
}

TEST(Binding, FunctionsOfOtherDialectsAreRefused) {
  const auto refusal = [](const std::string& line, const std::string& dialect) {
    return "m.map:" + line + ": send: the handshake of M, S and T functions is not supported yet for this dialect (" +
           dialect + "); remove the line, and connect the signals by in and out lines";
  };
  EXPECT_THAT(boundTo(testing::nctProgram(), "send a rise M 3\nsend a fall M 5\n").errors,
              ElementsAre(refusal("1", "nct"), refusal("2", "nct")));
  EXPECT_THAT(
      boundTo(testing::technolProgram(), "send a rise T 1\nhigh-speed").errors,
      ElementsAre(refusal("1", "technol"), "m.map:2: high-speed: this dialect has no such handshake; remove the line"));
}

} // namespace
} // namespace rung::hal
