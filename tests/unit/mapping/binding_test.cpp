// Names of mapping files in programs of the three dialects.
#include "tools/mapping/binding.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rtlib/host/program_info.h"
#include "tests/support/adopted_image.h"
#include "tests/unit/mapping/test_program.h"

namespace rung::mapping {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::StartsWith;

// Space, byte, bit and type of what an entry is bound to.
struct Cell {
  uint32_t space;
  uint32_t byte;
  uint32_t bit;
  uint32_t type;
  bool operator==(const Cell&) const = default;
};

struct Bound {
  explicit Bound(const rung_program& program) : plc(test::adopted(program)) {}
  template <class Link>
  Cell cell(const Link& link) {
    const rung_cell found =
        plc.find(link.name, static_cast<Access>(link.words ? RUNG_WRITE | RUNG_REAL : uint32_t{RUNG_WRITE}));
    const rung_cell_info info = plc.describe(found);
    return {info.space, info.byte, info.bit, info.type};
  }

  std::vector<PinLink> inputs() const { return links(toProgram); }
  std::vector<PinLink> outputs() const { return links(fromProgram); }
  std::vector<PinLink> links(bool (*wanted)(Direction)) const {
    std::vector<PinLink> found;
    for (const PinLink& link : binding.links)
      if (wanted(link.direction)) found.push_back(link);
    return found;
  }

  Instance plc;
  Binding binding;
  std::vector<std::string> errors;
};

Bound boundTo(const rung_program& program, std::string_view text) {
  Bound bound(program);
  const File map = parseMap(text, "m.map", bound.errors);
  bound.binding = bindMap(map, bound.plc.handle(), program, bound.errors);
  return bound;
}

std::vector<std::string> gskErrors(std::string_view text) { return boundTo(testing::gskProgram(), text).errors; }

TEST(Binding, AddressesSymbolsAndSignalsOfGsk) {
  Bound bound = boundTo(testing::gskProgram(), R"(
in.a = { type = "bit", name = "X000.3" }
out.b = { type = "bit", name = "SYM" }
in.c = { type = "s32", name = "F10:4" }
out.fin = { type = "bit", name = "FIN" }
)");
  EXPECT_THAT(bound.errors, IsEmpty());
  ASSERT_EQ(bound.inputs().size(), 2u);
  EXPECT_EQ(bound.cell(bound.inputs()[0]), (Cell{0, 0, 3, RUNG_TYPE_BIT}));
  EXPECT_EQ(bound.cell(bound.inputs()[1]), (Cell{2, 10, 0, RUNG_TYPE_I32}));
  ASSERT_EQ(bound.outputs().size(), 2u);
  EXPECT_EQ(bound.cell(bound.outputs()[0]), (Cell{1, 1, 2, RUNG_TYPE_BIT}));
  EXPECT_EQ(bound.cell(bound.outputs()[1]), (Cell{3, 4, 3, RUNG_TYPE_BIT})); // FIN of the NC interface is G4.3
}

TEST(Binding, MachinePositions) {
  Bound bound = boundTo(testing::gskProgram(), R"(
in.a = { type = "float", name = "NC.MPOS.1", scale = 1000 }
in.b = { type = "s32", name = "NC.MPOS.8" }
)");
  EXPECT_THAT(bound.errors, IsEmpty());
  ASSERT_EQ(bound.inputs().size(), 2u);
  const uint32_t space = host::findSpace(testing::gskProgram(), "@MPOS");
  EXPECT_EQ(bound.cell(bound.inputs()[0]), (Cell{space, 0, 0, RUNG_TYPE_I32}));
  EXPECT_EQ(bound.inputs()[0].scale, 1000);
  EXPECT_EQ(bound.cell(bound.inputs()[1]), (Cell{space, 28, 0, RUNG_TYPE_I32}));
  EXPECT_EQ(bound.inputs()[1].scale, 1);
  EXPECT_THAT(gskErrors(R"(
in.a = { type = "bit", name = "NC.MPOS.1" }
in.b = { type = "s32", name = "NC.MPOS.9" }
in.c = { type = "s32", name = "NC.MPOS.0" }
out.d = { type = "s32", name = "NC.MPOS.1" }
in.e = { type = "s32", name = "NC.MPOS.x" }
)"),
              ElementsAre("m.map:2:31: in.a.name: found the cell NC.MPOS.1 for type bit, expected a bit; write type = "
                          "\"s32\", \"u32\" or \"float\"",
                          "m.map:3:31: in.b.name: found NC.MPOS.9, expected NC.MPOS.1 to NC.MPOS.8; write for example "
                          "NC.MPOS.1",
                          StartsWith("m.map:4:31: in.c.name: found NC.MPOS.0, expected NC.MPOS.1 to NC.MPOS.8; "),
                          StartsWith("m.map:6:31: in.e.name: found NC.MPOS.x, expected NC.MPOS.1 to NC.MPOS.8; "),
                          "m.map:5:32: out.d.name: found NC.MPOS.1, which HAL writes, expected a name that the program "
                          "writes; move the pin to [in]"));
  EXPECT_THAT(gskErrors(R"(in.a = { type = "s32", name = "NC.MPOS.1x" })"),
              ElementsAre(StartsWith("m.map:1:31: in.a.name: found NC.MPOS.1x, expected NC.MPOS.1 to NC.MPOS.8; ")));
  EXPECT_THAT(boundTo(testing::nctProgram(), R"(in.a = { type = "s32", name = "NC.MPOS.1" })").errors,
              ElementsAre("m.map:1:31: in.a.name: found NC.MPOS.1, expected a name of this program, which reads no "
                          "machine positions; remove the entry"));
}

TEST(Binding, NctNamesAreTheHardwaresSide) {
  Bound bound = boundTo(testing::nctProgram(), R"(
in.a = { type = "bit", name = "0056.17" }
out.w = { type = "s32", name = "0400" }
out.d = { type = "float", name = "0400" }
)");
  EXPECT_THAT(bound.errors, IsEmpty());
  const uint32_t slice = host::findSpace(testing::nctProgram(), "TS");
  ASSERT_EQ(bound.inputs().size(), 1u);
  EXPECT_EQ(bound.cell(bound.inputs()[0]), (Cell{slice, 56 * 4 + 2, 1, RUNG_TYPE_BIT}));
  ASSERT_EQ(bound.outputs().size(), 2u);
  EXPECT_EQ(bound.cell(bound.outputs()[0]), (Cell{slice, 1600, 0, RUNG_TYPE_I32}));
  EXPECT_EQ(bound.cell(bound.outputs()[1]), (Cell{slice, 1600, 0, RUNG_TYPE_F64})); // a double in two words
}

TEST(Binding, TechnolCells) {
  Bound bound = boundTo(testing::technolProgram(), R"(
out.r = { type = "float", name = "realcell" }
out.c = { type = "s32", name = "COUNT" }
out.b = { type = "bit", name = "COUNT.3" }
)");
  EXPECT_THAT(bound.errors, IsEmpty());
  const uint32_t data = host::findSpace(testing::technolProgram(), "DATA");
  ASSERT_EQ(bound.outputs().size(), 3u);
  EXPECT_EQ(bound.cell(bound.outputs()[0]), (Cell{data, 0, 0, RUNG_TYPE_F64}));
  EXPECT_EQ(bound.cell(bound.outputs()[1]), (Cell{data, 8, 0, RUNG_TYPE_I16}));
  EXPECT_EQ(bound.cell(bound.outputs()[2]), (Cell{data, 8, 3, RUNG_TYPE_BIT}));
}

TEST(Binding, FloatPinsConvertOtherIntegers) {
  Bound bound = boundTo(testing::technolProgram(), R"(out.c = { type = "float", name = "COUNT" })");
  EXPECT_THAT(bound.errors, IsEmpty());
  ASSERT_EQ(bound.outputs().size(), 1u);
  EXPECT_NE(bound.cell(bound.outputs()[0]).type, uint32_t{RUNG_TYPE_F64});
}

TEST(Binding, UnknownNames) {
  EXPECT_THAT(
      gskErrors(R"(
# x
in.a = { type = "bit", name = "NOWHERE" }
)"),
      ElementsAre("m.map:3:31: in.a.name: found an unknown name NOWHERE, expected a symbol or an address of the "
                  "program, or a signal of the NC interface; write the name as the program has it"));
  EXPECT_THAT(gskErrors(R"(in.a = { type = "bit", name = "X99.0" })"),
              ElementsAre(StartsWith("m.map:1:31: in.a.name: found an unknown name X99.0, expected a symbol")));
  EXPECT_THAT(gskErrors(R"(const.NOWHERE = 1)"),
              ElementsAre(StartsWith("m.map:1:7: const.NOWHERE: found an unknown name NOWHERE, expected a symbol")));
}

// What is offered would be taken: a symbol with a place, which HAL may write where it writes, of the type.
TEST(Binding, UnknownNamesThatAreLikeASymbol) {
  const auto meant = [](const rung_program& program, std::string_view text) {
    const std::vector<std::string> errors = boundTo(program, text).errors;
    const std::string error = errors.size() == 1 ? errors[0] : "not one mistake";
    return error.substr(error.rfind("; ") + 2);
  };
  const std::string none = "write the name as the program has it";
  const auto gsk = [&](std::string_view text) { return meant(testing::gskProgram(), text); };
  EXPECT_EQ(gsk(R"(out.a = { type = "bit", name = "SYMB" })"), "did you mean SYM?");
  EXPECT_EQ(gsk(R"(out.a = { type = "bit", name = "sym" })"), "did you mean SYM?");
  EXPECT_EQ(gsk(R"(out.a = { type = "s32", name = "SYMB" })"), none); // it is a bit
  EXPECT_EQ(gsk(R"(in.a = { type = "bit", name = "SYMB" })"), none);  // and an output
  EXPECT_EQ(gsk(R"(out.a = { type = "s32", name = "LIMITS" })"), none);
  const auto technol = [&](std::string_view text) { return meant(testing::technolProgram(), text); };
  EXPECT_EQ(technol(R"(out.a = { type = "bit", name = "COUND.3" })"), "did you mean COUNT.3?");
  EXPECT_EQ(technol(R"(out.a = { type = "bit", name = "COUND" })"), none);
  EXPECT_EQ(technol(R"(out.a = { type = "bit", name = "COUND.16" })"), none); // it has 16 bits
  EXPECT_EQ(technol(R"(out.a = { type = "bit", name = "COUNT.16" })"), none);
  EXPECT_EQ(technol(R"(out.a = { type = "s32", name = "NAMES" })"), none);
  EXPECT_EQ(technol(R"(out.a = { type = "float", name = "REALCEL" })"), "did you mean REALCELL?");
  EXPECT_EQ(technol(R"(const.REALCEL = 5)"), "did you mean REALCELL?");
}

// A wrong program for the map must not cost a search of all its symbols for each name.
TEST(Binding, SuggestionsAreFew) {
  std::string text;
  for (int i = 0; i <= 10; ++i) text += "out.p" + std::to_string(i) + " = { type = \"bit\", name = \"SYMB\" }\n";
  const std::vector<std::string> errors = gskErrors(text);
  ASSERT_EQ(errors.size(), 11u);
  EXPECT_THAT(errors[9], ::testing::EndsWith("; did you mean SYM?"));
  EXPECT_THAT(errors[10], ::testing::EndsWith("; write the name as the program has it"));
}

TEST(Binding, NamesThatDoNotFit) {
  EXPECT_THAT(gskErrors(R"(in.a = { type = "bit", name = "Y0.0" })"),
              ElementsAre("m.map:1:31: in.a.name: found Y0.0, an output of the program, expected a name that HAL may "
                          "write; move the pin to [out]"));
  EXPECT_THAT(gskErrors(R"(const."Y0.0" = true)"),
              ElementsAre("m.map:1:7: const.Y0.0: found Y0.0, an output of the program, expected a name that HAL may "
                          "write; remove the line"));
  EXPECT_THAT(gskErrors(R"(out.a = { type = "bit", name = "D0" })"),
              ElementsAre("m.map:1:32: out.a.name: found the cell D0 for type bit, expected a bit; write type = "
                          "\"s32\", \"u32\" or \"float\", or name a bit of the cell"));
  EXPECT_THAT(gskErrors(R"(out.a = { type = "u32", name = "SYM" })"),
              ElementsAre("m.map:1:32: out.a.name: found the bit SYM for type u32, expected a cell; write type = "
                          "\"bit\""));
  EXPECT_THAT(
      gskErrors(R"(out.a = { type = "s32", name = "LIMIT" })"),
      ElementsAre("m.map:1:32: out.a.name: found the constant LIMIT (5), expected a place in the memory; remove "
                  "the entry, the value never changes"));
  EXPECT_THAT(boundTo(testing::technolProgram(), R"(out.a = { type = "s32", name = "NAME" })").errors,
              ElementsAre("m.map:1:32: out.a.name: found the text NAME, expected a bit or a number; remove the entry, "
                          "HAL has no pins for texts"));
}

// Signals of TECHNOL's interface are, and other 8 bytes only when the entry says so.
TEST(Binding, RealNumbers) {
  static constexpr rung_symbol kSpeed = {"SPEED", "", 1, 0, 0, RUNG_TYPE_F64, 1, 0, 0};
  rung_program program = testing::technolProgram();
  program.symbols = &kSpeed;
  program.symbol_count = 1;
  Bound bound = boundTo(program, R"(
out.a = { type = "float", name = "SPEED" }
const.SPEED = 5
)");
  EXPECT_THAT(bound.errors, IsEmpty());
  ASSERT_EQ(bound.binding.constants.size(), 1u);
  EXPECT_EQ(bound.binding.constants[0].type, PinType::Float);
  EXPECT_EQ(bound.cell(bound.binding.constants[0]), (Cell{1, 0, 0, RUNG_TYPE_F64}));
  EXPECT_THAT(
      boundTo(program, R"(
out.a = { type = "u32", name = "SPEED" }
out.b = { type = "bit", name = "SPEED" }
const.SPEED = true
)")
          .errors,
      ElementsAre("m.map:2:32: out.a.name: found the real number SPEED for type u32, expected an integer; write "
                  "type = \"float\"",
                  "m.map:3:32: out.b.name: found the cell SPEED for type bit, expected a bit; write type = "
                  "\"float\"",
                  "m.map:4:7: const.SPEED: found true for a cell, expected a number; write for example "
                  "\"SPEED\" = 1"));
}

TEST(Binding, Constants) {
  Bound bound = boundTo(testing::gskProgram(), R"([const]
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
  EXPECT_NE(bound.cell(bound.binding.constants[4]).type, uint32_t{RUNG_TYPE_F64}); // rounded there
  // 8 bytes hold either an integer or a real number: the value says which.
  Bound real = boundTo(testing::technolProgram(), "const.realcell = 5.0");
  EXPECT_THAT(real.errors, IsEmpty());
  ASSERT_EQ(real.binding.constants.size(), 1u);
  EXPECT_EQ(real.cell(real.binding.constants[0]).type, uint32_t{RUNG_TYPE_F64});
  Bound integer = boundTo(testing::technolProgram(), "const.realcell = 5");
  EXPECT_THAT(integer.errors, IsEmpty());
  ASSERT_EQ(integer.binding.constants.size(), 1u);
  EXPECT_NE(integer.cell(integer.binding.constants[0]).type, uint32_t{RUNG_TYPE_F64});
  EXPECT_THAT(
      gskErrors(R"([const]
"X0.0" = 1
D0 = true
D1 = 256
D2 = -129
"D3:2" = 40000.0
)"),
      ElementsAre("m.map:2:1: const.X0.0: found 1 for a bit, expected true or false; write for example \"X0.0\" = true",
                  "m.map:3:1: const.D0: found true for a cell, expected a number; write for example \"D0\" = 1",
                  "m.map:4:1: const.D1: found 256, expected -128 to 255, what the cell of 8 bits holds; write such a "
                  "value, or name a longer cell",
                  "m.map:5:1: const.D2: found -129, expected -128 to 255, what the cell of 8 bits holds; write such a "
                  "value, or name a longer cell",
                  "m.map:6:1: const.D3:2: found 40000, expected -32768 to 32767, what the cell of 16 bits holds of a "
                  "real number, which becomes an integer with a sign; write such a value, or name a longer cell"));
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
              ElementsAre("m.map:4:3: send.function: found \"B\", expected \"M\", \"S\", \"T\", \"H\", \"key\", the "
                          "functions of the dialect technol; remove the table, and connect its signals in [in] and "
                          "[out]",
                          "m.map:5:3: send.code: found M100, expected a code that the signals of the dialect technol "
                          "hold; write another code",
                          "m.map:8:3: send.channel: found 2, expected 1, the only channel of a control of the dialect "
                          "technol; write for example channel = 1",
                          "m.map:2:14: high-speed: found true, expected false, because the dialect technol has no such "
                          "handshake; remove the line"));
  EXPECT_THAT(
      boundTo(testing::technolProgram(), "[m-groups]\n70 = 10\n71 = 15\n100 = 10\n").errors,
      ElementsAre("m.map:3:1: m-groups: found M71 in group 15, expected what a machine can choose with the dialect "
                  "technol; write another group, or remove the line",
                  "m.map:4:1: m-groups: found M100 in group 10, expected what a machine can choose with the "
                  "dialect technol; write another group, or remove the line"));
  EXPECT_THAT(boundTo(testing::gskProgram(), "[axis-groups]\n1 = \"A\"\n8 = \"H\"\n").errors, IsEmpty());
  EXPECT_THAT(boundTo(testing::gskProgram(), "[axis-groups]\n9 = \"A\"\n1 = \"I\"\n").errors,
              ElementsAre("m.map:2:1: axis-groups: found axis 9 in group A, expected axes and groups that the dialect "
                          "gsk has; write others, or remove the line",
                          "m.map:3:1: axis-groups: found axis 1 in group I, expected axes and groups that the dialect "
                          "gsk has; write others, or remove the line"));
  EXPECT_THAT(
      boundTo(testing::nctProgram(), "[m-groups]\n70 = 10\n").errors,
      ElementsAre("m.map:2:1: m-groups: found M70 in group 10, expected what a machine can choose with the dialect "
                  "nct; write another group, or remove the line"));
  EXPECT_THAT(
      boundTo(testing::nctProgram(), R"(
send = [
  { pin = "a", edge = "rise", function = "B", code = -1, channel = 8 },
  { pin = "a", edge = "rise", function = "M", code = 3, channel = 9 },
  { pin = "a", edge = "rise", function = "H", code = 3 },
]
)")
          .errors,
      ElementsAre("m.map:4:3: send.channel: found 9, expected 1 to 8, the channels of a control of the dialect nct; "
                  "write for example channel = 1",
                  "m.map:5:3: send.function: found \"H\", expected \"M\", \"S\", \"T\", \"B\", the functions of the "
                  "dialect nct; remove the table, and connect its signals in [in] and [out]"));
}

TEST(Binding, CellsThatAreNeitherSetNorForced) {
  EXPECT_THAT(gskErrors("rungctl.never = [\"X0.0\", \"SYM\", \"D4:4\"]"), IsEmpty());
  EXPECT_THAT(gskErrors("rungctl.never = [\"X0.0\", \"SYN\"]"),
              ElementsAre(StartsWith("m.map:1:26: rungctl.never: found an unknown name SYN, expected a symbol")));
}

TEST(Binding, BitsParametersAndBothSides) {
  Bound bound = boundTo(testing::gskProgram(), R"(
in.key = { type = "bit", name = "X10", bits = 8 }
io.mode = { type = "s32", name = "D4:4" }
param.delay = { type = "u32", name = "D0:2", value = 65535 }
)");
  EXPECT_THAT(bound.errors, IsEmpty());
  ASSERT_EQ(bound.binding.links.size(), 3u);
  EXPECT_EQ(bound.binding.links[0].type, PinType::U32);
  EXPECT_EQ(bound.binding.links[0].bits.size(), 8u);
  EXPECT_EQ(bound.binding.links[1].direction, Direction::Io);
  EXPECT_EQ(bound.binding.links[2].value, 65535);
}

TEST(Binding, BitsAndParametersThatDoNotFit) {
  EXPECT_THAT(
      gskErrors(R"(
in.a = { type = "bit", name = "X10", bits = 9 }
in.b = { type = "bit", name = "X10.0", bits = 2 }
io.c = { type = "bit", name = "Y0.0" }
param.d = { type = "u32", name = "D0:2", value = 65536 }
param.e = { type = "u32", name = "Y0", value = 1 }
)"),
      ElementsAre("m.map:2:31: in.a.name: found the cell of 8 bits X10 for 9 pins, expected a cell with as many "
                  "bits; write bits = 8 or less",
                  "m.map:3:31: in.b.name: found the bit X10.0 for 2 pins, expected a cell; remove bits",
                  "m.map:4:31: io.c.name: found Y0.0, an output of the program, expected a name that HAL may "
                  "write; move the pin to [out]",
                  StartsWith("m.map:5:34: param.d.name: found 65536, expected -32768 to 65535, what the cell of "
                             "16 bits holds"),
                  StartsWith("m.map:6:34: param.e.name: found Y0, an output of the program, ")));
}

} // namespace
} // namespace rung::mapping
