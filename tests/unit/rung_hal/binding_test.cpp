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
  const Bound bound = boundTo(testing::gskProgram(), R"(
in.a = { type = "bit", name = "X000.3" }
out.b = { type = "bit", name = "SYM" }
in.c = { type = "s32", name = "F10:4" }
out.fin = { type = "bit", name = "FIN" }
)");
  EXPECT_THAT(bound.errors, IsEmpty());
  ASSERT_EQ(bound.binding.inputs.size(), 2u);
  EXPECT_EQ(bound.binding.inputs[0].place, host::bitRef(0, 0, 3));
  EXPECT_EQ(bound.binding.inputs[1].place, host::intRef(2, 10, 32));
  ASSERT_EQ(bound.binding.outputs.size(), 2u);
  EXPECT_EQ(bound.binding.outputs[0].place, host::bitRef(1, 1, 2));
  EXPECT_EQ(bound.binding.outputs[1].place, host::bitRef(3, 4, 3)); // FIN of the NC interface is G4.3
}

TEST(Binding, MachinePositions) {
  const Bound bound = boundTo(testing::gskProgram(), R"(
in.a = { type = "float", name = "NC.MPOS.1", scale = 1000 }
in.b = { type = "s32", name = "NC.MPOS.8" }
)");
  EXPECT_THAT(bound.errors, IsEmpty());
  ASSERT_EQ(bound.binding.inputs.size(), 2u);
  const uint32_t space = host::findSpace(testing::gskProgram(), "@MPOS");
  EXPECT_EQ(bound.binding.inputs[0].place, host::intRef(space, 0, 32));
  EXPECT_EQ(bound.binding.inputs[0].scale, 1000);
  EXPECT_EQ(bound.binding.inputs[1].place, host::intRef(space, 28, 32));
  EXPECT_EQ(bound.binding.inputs[1].scale, 1);
  EXPECT_THAT(gskErrors(R"(
in.a = { type = "bit", name = "NC.MPOS.1" }
in.b = { type = "s32", name = "NC.MPOS.9" }
in.c = { type = "s32", name = "NC.MPOS.0" }
out.d = { type = "s32", name = "NC.MPOS.1" }
in.e = { type = "s32", name = "NC.MPOS.x" }
)"),
              ElementsAre("m.map:2:31: NC.MPOS.1 is not a bit; s32, u32 or float is possible",
                          "m.map:3:31: NC.MPOS.9: axes are 1 to 8", "m.map:4:31: NC.MPOS.0: axes are 1 to 8",
                          "m.map:6:31: NC.MPOS.x: axes are 1 to 8",
                          "m.map:5:32: NC.MPOS.1 is written by HAL, not by the program"));
  EXPECT_THAT(boundTo(testing::nctProgram(), R"(in.a = { type = "s32", name = "NC.MPOS.1" })").errors,
              ElementsAre("m.map:1:31: NC.MPOS.1: the program reads no machine positions"));
}

TEST(Binding, NctNamesAreTheHardwaresSide) {
  const Bound bound = boundTo(testing::nctProgram(), R"(
in.a = { type = "bit", name = "0056.17" }
out.w = { type = "s32", name = "0400" }
out.d = { type = "float", name = "0400" }
)");
  EXPECT_THAT(bound.errors, IsEmpty());
  const uint32_t slice = host::findSpace(testing::nctProgram(), "TS");
  ASSERT_EQ(bound.binding.inputs.size(), 1u);
  EXPECT_EQ(bound.binding.inputs[0].place, host::bitRef(slice, 56 * 4, 17));
  ASSERT_EQ(bound.binding.outputs.size(), 2u);
  EXPECT_EQ(bound.binding.outputs[0].place, host::intRef(slice, 1600, 32));
  EXPECT_EQ(bound.binding.outputs[1].place, host::realRef(slice, 1600)); // a double in two words
}

TEST(Binding, TechnolCells) {
  const Bound bound = boundTo(testing::technolProgram(), R"(
out.r = { type = "float", name = "realcell" }
out.c = { type = "s32", name = "COUNT" }
out.b = { type = "bit", name = "COUNT.3" }
)");
  EXPECT_THAT(bound.errors, IsEmpty());
  const uint32_t data = host::findSpace(testing::technolProgram(), "DATA");
  ASSERT_EQ(bound.binding.outputs.size(), 3u);
  EXPECT_EQ(bound.binding.outputs[0].place, host::realRef(data, 0));
  EXPECT_EQ(bound.binding.outputs[1].place, host::intRef(data, 8, 16));
  EXPECT_EQ(bound.binding.outputs[2].place, host::bitRef(data, 8, 3));
}

TEST(Binding, FloatPinsConvertOtherIntegers) {
  const Bound bound = boundTo(testing::technolProgram(), R"(out.c = { type = "float", name = "COUNT" })");
  EXPECT_THAT(bound.errors, IsEmpty());
  ASSERT_EQ(bound.binding.outputs.size(), 1u);
  EXPECT_EQ(bound.binding.outputs[0].place.kind, host::RefKind::Int);
}

TEST(Binding, NamesThatDoNotFit) {
  EXPECT_THAT(gskErrors(R"(
# x
in.a = { type = "bit", name = "NOWHERE" }
)"),
              ElementsAre("m.map:3:31: NOWHERE: the program has no such name or address"));
  EXPECT_THAT(gskErrors(R"(in.a = { type = "bit", name = "X99.0" })"),
              ElementsAre("m.map:1:31: X99.0: the program has no such name or address"));
  EXPECT_THAT(gskErrors(R"(in.a = { type = "bit", name = "Y0.0" })"),
              ElementsAre("m.map:1:31: Y0.0 is an output of the program; it cannot be written"));
  EXPECT_THAT(gskErrors(R"(const."Y0.0" = true)"),
              ElementsAre("m.map:1:7: Y0.0 is an output of the program; it cannot be written"));
  EXPECT_THAT(gskErrors(R"(out.a = { type = "bit", name = "D0" })"),
              ElementsAre("m.map:1:32: D0 is not a bit; s32, u32, float or a bit of it is possible"));
  EXPECT_THAT(gskErrors(R"(out.a = { type = "u32", name = "SYM" })"), ElementsAre("m.map:1:32: SYM is a bit, not u32"));
  EXPECT_THAT(gskErrors(R"(out.a = { type = "s32", name = "LIMIT" })"),
              ElementsAre("m.map:1:32: LIMIT is a constant of the program"));
  EXPECT_THAT(boundTo(testing::technolProgram(), R"(out.a = { type = "s32", name = "NAME" })").errors,
              ElementsAre("m.map:1:32: NAME is a text; HAL has no pins for texts"));
}

TEST(Binding, Constants) {
  const Bound bound = boundTo(testing::gskProgram(), R"([const]
"X0.0" = true
D0 = 255
D1 = -128
"D2:2" = 40000
"F20:2" = 7.5
"NC.MPOS.2" = -2000000000
)");
  EXPECT_THAT(bound.errors, IsEmpty());
  ASSERT_EQ(bound.binding.constants.size(), 6u);
  EXPECT_EQ(bound.binding.constants[0].type, PinType::Bit);
  EXPECT_EQ(bound.binding.constants[1].value, 255);
  EXPECT_EQ(bound.binding.constants[2].type, PinType::S32);
  EXPECT_EQ(bound.binding.constants[4].type, PinType::Float);
  EXPECT_EQ(bound.binding.constants[4].place.kind, host::RefKind::Int); // rounded there
  // 8 bytes hold either an integer or a real number: the value says which.
  const Bound real = boundTo(testing::technolProgram(), "const.realcell = 5.0");
  EXPECT_THAT(real.errors, IsEmpty());
  ASSERT_EQ(real.binding.constants.size(), 1u);
  EXPECT_EQ(real.binding.constants[0].place.kind, host::RefKind::Real);
  const Bound integer = boundTo(testing::technolProgram(), "const.realcell = 5");
  EXPECT_THAT(integer.errors, IsEmpty());
  ASSERT_EQ(integer.binding.constants.size(), 1u);
  EXPECT_EQ(integer.binding.constants[0].place.kind, host::RefKind::Int);
  EXPECT_THAT(
      gskErrors(R"([const]
"X0.0" = 1
D0 = true
D1 = 256
D2 = -129
"D3:2" = 40000.0
)"),
      ElementsAre("m.map:2:1: X0.0 is a bit; write true or false", "m.map:3:1: D0 is not a bit; write a number",
                  "m.map:4:1: D1: the value does not fit into the cell, which has 8 bits",
                  "m.map:5:1: D2: the value does not fit into the cell, which has 8 bits",
                  "m.map:6:1: D3:2: the value does not fit into the cell, which has 16 bits; a real number becomes an "
                  "integer with a sign"));
}

TEST(Binding, FunctionsThatADialectDoesNotHave) {
  EXPECT_THAT(boundTo(testing::technolProgram(), R"(
high-speed = true
send = [
  { pin = "a", edge = "rise", function = "B", code = 1 },
  { pin = "a", edge = "rise", function = "M", code = 100 },
  { pin = "a", edge = "rise", function = "M", code = 99 },
  { pin = "a", edge = "rise", function = "T", code = "number" },
  { pin = "a", edge = "rise", function = "M", code = 3, channel = 2 },
]
)")
                  .errors,
              ElementsAre("m.map:4:3: send: found function B, which the dialect technol does not have; remove the "
                          "table, and connect its signals in [in] and [out]",
                          "m.map:5:3: send: found M100, a code that the signals of the dialect technol do not hold; "
                          "write another code",
                          "m.map:8:3: send: found channel 2, expected 1: a control of the dialect technol has one "
                          "channel",
                          "m.map:2:14: high-speed: this dialect has no such handshake; remove the line"));
  EXPECT_THAT(boundTo(testing::technolProgram(), "[m-groups]\n70 = 10\n71 = 15\n100 = 10\n").errors,
              ElementsAre("m.map:3:1: m-groups: found M71 in group 15, which a control of the dialect technol cannot "
                          "have; remove the line",
                          "m.map:4:1: m-groups: found M100 in group 10, which a control of the dialect technol cannot "
                          "have; remove the line"));
  EXPECT_THAT(boundTo(testing::nctProgram(), "[m-groups]\n70 = 10\n").errors,
              ElementsAre("m.map:2:1: m-groups: found M70 in group 10, which a control of the dialect nct cannot "
                          "have; remove the line"));
  EXPECT_THAT(boundTo(testing::nctProgram(), R"(
send = [
  { pin = "a", edge = "rise", function = "B", code = -1, channel = 8 },
  { pin = "a", edge = "rise", function = "M", code = 3, channel = 9 },
]
)")
                  .errors,
              ElementsAre("m.map:4:3: send: found channel 9, expected 1 to 8, the channels of a control of the dialect "
                          "nct"));
}

} // namespace
} // namespace rung::hal
