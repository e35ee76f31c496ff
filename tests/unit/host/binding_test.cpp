// Names of mapping files in programs of the three dialects.
#include "machine/host/binding.h"

#include <gtest/gtest.h>

#include "rtlib/load/program_info.h"
#include "rung/runtime.hpp"
#include "tests/support/words.h"
#include "tests/unit/host/test_program.h"

namespace rung::host {
namespace {

// Space, byte, bit and type of what an entry is bound to.
struct Cell {
  uint32_t space;
  uint32_t byte;
  uint32_t bit;
  uint32_t type;
  bool operator==(const Cell&) const = default;
};

struct Bound {
  explicit Bound(const rung_program& program) : plc(Image::adopt(program)) {}
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
  EXPECT_EQ(test::joined(bound.errors), "");
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
  EXPECT_EQ(test::joined(bound.errors), "");
  ASSERT_EQ(bound.inputs().size(), 2u);
  const uint32_t space = runtime::findSpace(testing::gskProgram(), "@MPOS");
  EXPECT_EQ(bound.cell(bound.inputs()[0]), (Cell{space, 0, 0, RUNG_TYPE_I32}));
  EXPECT_EQ(bound.inputs()[0].scale, 1000);
  EXPECT_EQ(bound.cell(bound.inputs()[1]), (Cell{space, 28, 0, RUNG_TYPE_I32}));
  EXPECT_EQ(bound.inputs()[1].scale, 1);
}

TEST(Binding, NctNamesAreTheHardwaresSide) {
  Bound bound = boundTo(testing::nctProgram(), R"(
in.a = { type = "bit", name = "0056.17" }
out.w = { type = "s32", name = "0400" }
out.d = { type = "float", name = "0400" }
)");
  EXPECT_EQ(test::joined(bound.errors), "");
  const uint32_t slice = runtime::findSpace(testing::nctProgram(), "TS");
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
  EXPECT_EQ(test::joined(bound.errors), "");
  const uint32_t data = runtime::findSpace(testing::technolProgram(), "DATA");
  ASSERT_EQ(bound.outputs().size(), 3u);
  EXPECT_EQ(bound.cell(bound.outputs()[0]), (Cell{data, 0, 0, RUNG_TYPE_F64}));
  EXPECT_EQ(bound.cell(bound.outputs()[1]), (Cell{data, 8, 0, RUNG_TYPE_I16}));
  EXPECT_EQ(bound.cell(bound.outputs()[2]), (Cell{data, 8, 3, RUNG_TYPE_BIT}));
}

TEST(Binding, FloatPinsConvertOtherIntegers) {
  Bound bound = boundTo(testing::technolProgram(), R"(out.c = { type = "float", name = "COUNT" })");
  EXPECT_EQ(test::joined(bound.errors), "");
  ASSERT_EQ(bound.outputs().size(), 1u);
  EXPECT_NE(bound.cell(bound.outputs()[0]).type, uint32_t{RUNG_TYPE_F64});
}

// A wrong program for the map must not cost a search of all its symbols for each name.
TEST(Binding, SuggestionsAreFew) {
  std::string text;
  for (int i = 0; i <= 10; ++i) text += "out.p" + std::to_string(i) + " = { type = \"bit\", name = \"SYMB\" }\n";
  const std::vector<std::string> errors = gskErrors(text);
  ASSERT_EQ(errors.size(), 11u);
  EXPECT_TRUE(errors[9].ends_with(" SYM?")) << errors[9];
  EXPECT_FALSE(errors[10].ends_with(" SYM?")) << errors[10];
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
  EXPECT_EQ(test::joined(bound.errors), "");
  ASSERT_EQ(bound.binding.constants.size(), 1u);
  EXPECT_EQ(bound.binding.constants[0].type, PinType::Float);
  EXPECT_EQ(bound.cell(bound.binding.constants[0]), (Cell{1, 0, 0, RUNG_TYPE_F64}));
}

TEST(Binding, Constants) {
  Bound bound = boundTo(testing::gskProgram(), R"([const]
"X0.0" = true
D0 = 255
D1 = -128
"D2:2" = 40000
"F20:2" = 7.0
"NC.MPOS.2" = -2000000000
)");
  EXPECT_EQ(test::joined(bound.errors), "");
  ASSERT_EQ(bound.binding.constants.size(), 6u);
  EXPECT_EQ(bound.binding.constants[0].type, PinType::Bit);
  EXPECT_EQ(bound.binding.constants[1].value, 255);
  EXPECT_EQ(bound.binding.constants[2].type, PinType::S32);
  EXPECT_EQ(bound.binding.constants[4].type, PinType::Float);
  EXPECT_NE(bound.cell(bound.binding.constants[4]).type, uint32_t{RUNG_TYPE_F64}); // an integer there
  // 8 bytes hold either an integer or a real number: the value says which.
  Bound real = boundTo(testing::technolProgram(), "const.realcell = 5.0");
  EXPECT_EQ(test::joined(real.errors), "");
  ASSERT_EQ(real.binding.constants.size(), 1u);
  EXPECT_EQ(real.cell(real.binding.constants[0]).type, uint32_t{RUNG_TYPE_F64});
  Bound integer = boundTo(testing::technolProgram(), "const.realcell = 5");
  EXPECT_EQ(test::joined(integer.errors), "");
  ASSERT_EQ(integer.binding.constants.size(), 1u);
  EXPECT_NE(integer.cell(integer.binding.constants[0]).type, uint32_t{RUNG_TYPE_F64});
}

TEST(Binding, BitsParametersAndBothSides) {
  Bound bound = boundTo(testing::gskProgram(), R"(
in.key = { type = "bit", name = "X10", bits = 8 }
io.mode = { type = "s32", name = "D4:4" }
param.delay = { type = "u32", name = "D0:2", value = 65535 }
)");
  EXPECT_EQ(test::joined(bound.errors), "");
  ASSERT_EQ(bound.binding.links.size(), 3u);
  EXPECT_EQ(bound.binding.links[0].type, PinType::U32);
  EXPECT_EQ(bound.binding.links[0].bits.size(), 8u);
  EXPECT_EQ(bound.binding.links[1].direction, Direction::Io);
  EXPECT_EQ(bound.binding.links[2].value, 65535);
}

} // namespace
} // namespace rung::host
