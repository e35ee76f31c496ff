// Programs beside what their operands name: NAME.EXTENSION with NAME.EXTENSION.names. A person has checked each
// line against the source; a place too many is as wrong as one that is missing.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "frontend/dialects/dialect.h"
#include "ir/support/diag_render.h"
#include "ir/support/put.h"
#include "tests/support/golden.h"

namespace rung::frontend {
namespace {

class Lister {
public:
  Lister(const SourceManager& sources, const Analysis& analysis) : sources_(sources), analysis_(analysis) {}

  std::string run() {
    for (const Definition& definition : analysis_.definitions()) add(definition);
    for (const OperandUse& operand : analysis_.operands()) add(operand);
    for (const TargetUse& target : analysis_.targets()) add(target);
    for (const NameUse& name : analysis_.names()) add(name);
    return std::move(out_);
  }

private:
  std::string whereIs(SourceRange range) const {
    if (!range.valid()) return "the control's";
    const LineCol at = sources_.lineCol(range.begin);
    return fmt::format("{}:{}", at.line, at.column);
  }
  static std::string textOf(const NamedPlace& place) {
    if (place.bits == 1) return fmt::format("{}+{}.{}", place.space, place.firstBit / 8, place.firstBit % 8);
    const uint32_t bytes = place.bits / 8;
    return fmt::format("{}+{}{}", place.space, place.firstBit / 8, bytes == 1 ? "" : fmt::format(":{}", bytes));
  }

  void add(const Definition& definition) {
    put(out_, "name {} ({}) = {}{}\n", definition.name, whereIs(definition.range),
        definition.isConstant() ? std::string(definition.value) : textOf(definition.place),
        definition.comment.empty() ? "" : fmt::format(" ; {}", definition.comment));
  }
  void add(const OperandUse& operand) {
    put(out_, "{} {} is {}{}, {}{}\n", whereIs(operand.range), sources_.text(operand.range), textOf(operand.place),
        operand.computed.empty() ? "" : fmt::format(" and '{}'", operand.computed), nameOf(operand.access),
        operand.base == kNoDefinition ? "" : fmt::format(", from {}", analysis_.definitions()[operand.base].name));
  }
  void add(const TargetUse& target) {
    put(out_, "{} {} {} {} of {}\n", whereIs(target.range), sources_.text(target.range),
        target.defines ? "is number" : "leads to number", target.number, target.scope);
  }
  void add(const NameUse& name) {
    put(out_, "{} uses {}\n", whereIs(name.range), analysis_.definitions()[name.definition].name);
  }

  const SourceManager& sources_;
  const Analysis& analysis_;
  std::string out_;
};

TEST(SemaGolden, Names) {
  test::Golden golden("tests/golden/sema", {".lad", ".mne", ".plc", ".pmc"});
  for (const std::filesystem::path& input : golden.inputs()) {
    SourceManager sources;
    Diagnostics diagnostics;
    const FileId file = sources.addBuffer(input.filename(), golden.read(input));
    const auto program = dialectOf(sources, file)->check(sources, {&file, 1}, {}, diagnostics);
    golden.expect(input.filename().string() + ".names",
                  renderText(diagnostics, sources) + Lister(sources, program->analysis()).run());
  }
}

// What a character belongs to.
TEST(Analysis, IsAskedByPosition) {
  SourceManager sources;
  Diagnostics diagnostics;
  const std::string text = "dialect nct\nmodule MAIN\nsymbol IDX 7010\nsymbol COPY 7020 ; of IDX\n"
                           "rung\n|--[7000.01,IDX]--{MOV COPY 7030}\nrung\n|--[7000.00]--{JMP #1}\nrung\n|--{JME #1}\n";
  const FileId file = sources.addBuffer("t.lad", text);
  const auto program = dialectOf(sources, file)->check(sources, {&file, 1}, {}, diagnostics);
  const Analysis& analysis = program->analysis();
  const auto after = [&](std::string_view before) { return sources.position(file, text.find(before) + before.size()); };

  for (const std::string_view before : {"{MOV ", "{MOV C", "{MOV COP"}) {
    ASSERT_NE(analysis.nameAt(after(before)), nullptr) << before;
    EXPECT_EQ(analysis.nameAt(after(before))->name, "COPY");
    ASSERT_NE(analysis.operandAt(after(before)), nullptr) << before;
    EXPECT_EQ(sources.text(analysis.operandAt(after(before))->range), "COPY");
  }
  EXPECT_EQ(analysis.nameAt(after("{MOV COPY")), nullptr) << "the end is outside";
  EXPECT_EQ(analysis.nameAt(after("{MOV")), nullptr);

  ASSERT_NE(analysis.declaredAt(after("symbol ID")), nullptr);
  EXPECT_EQ(analysis.declaredAt(after("symbol ID"))->name, "IDX");
  EXPECT_EQ(analysis.declaredAt(after("symbol IDX")), nullptr);
  EXPECT_EQ(analysis.declaredAt(after("{MOV ")), nullptr) << "a use";
  EXPECT_EQ(analysis.nameAt(after("; of ")), nullptr) << "a comment names nothing";

  ASSERT_NE(analysis.nameAt(after("01,")), nullptr);
  EXPECT_EQ(analysis.nameAt(after("01,"))->name, "IDX");
  EXPECT_EQ(analysis.nameAt(after("|--[")), nullptr) << "an address";
  ASSERT_NE(analysis.operandAt(after("|--[")), nullptr);
  EXPECT_EQ(analysis.operandAt(after("|--["))->computed, ",IDX");
  EXPECT_EQ(analysis.operandAt(after(",IDX]")), nullptr) << "a wire";

  ASSERT_NE(analysis.targetAt(after("{JMP ")), nullptr);
  EXPECT_FALSE(analysis.targetAt(after("{JMP "))->defines);
  ASSERT_NE(analysis.targetAt(after("{JME #")), nullptr);
  EXPECT_TRUE(analysis.targetAt(after("{JME #"))->defines);

  ASSERT_NE(analysis.instructionAt(after("{M")), nullptr);
  EXPECT_EQ(analysis.instructionAt(after("{M"))->instruction->mnemonic, "MOV");
  EXPECT_EQ(analysis.instructionAt(after("{MOV")), nullptr);
}

// A list names functions by numbers, too; a line of TECHNOL has its mnemonic after its label.
TEST(Analysis, KnowsInstructions) {
  const auto at = [](const std::string& name, const std::string& text, std::string_view word) {
    SourceManager sources;
    Diagnostics diagnostics;
    const FileId file = sources.addBuffer(name, text);
    const auto program = dialectOf(sources, file)->check(sources, {&file, 1}, {}, diagnostics);
    const InstructionUse* use = program->analysis().instructionAt(sources.position(file, text.find(word)));
    return use == nullptr ? "" : std::string(use->instruction->mnemonic);
  };
  const std::string list = "FUNC 0\nLD X0.0\nFUNC 35\nPRM 0\nFUNC JMPE\nFUNC END2\n";
  EXPECT_EQ(at("t.pmc", list, "35"), "JMP");
  EXPECT_EQ(at("t.pmc", list, "JMPE"), "JMPE");
  EXPECT_EQ(at("t.pmc", list, "X0.0"), "");
  EXPECT_EQ(at("t.lad", "dialect gsk\nmodule LEVEL2\nrung\n|--[X0.0]--{TMR 1}--(Y0.0)\n", "TMR"), "TMR");
  EXPECT_EQ(at("t.plc", "MODULE_MAIN\nREADY:  LDR  RUN\nMODULE_MAIN_END\n", "DR"), "LDR");
}

// What is written there, exactly.
TEST(Analysis, IsAskedByPlace) {
  SourceManager sources;
  Diagnostics diagnostics;
  const FileId file =
      sources.addBuffer("t.lad", "dialect nct\nmodule MAIN\nsymbol A 7000.00\nrung\n|--[A]--(7001,#1)\n");
  const auto program = dialectOf(sources, file)->check(sources, {&file, 1}, {}, diagnostics);
  EXPECT_TRUE(diagnostics.hasErrors()) << "a word is not a coil";
  const Analysis& analysis = program->analysis();
  const size_t at = sources.text(file).find("[A]") + 1;
  const SourceRange a = sources.range(file, at, at + 1);
  ASSERT_NE(analysis.nameAt(a), nullptr) << "also of a program with errors";
  EXPECT_EQ(analysis.nameAt(a)->name, "A");
  ASSERT_NE(analysis.operandAt(a), nullptr);
  EXPECT_EQ(analysis.operandAt(a)->place.bits, 1u);
  EXPECT_EQ(analysis.operandAt(sources.range(file, at, at + 2)), nullptr);
  EXPECT_EQ(analysis.nameAt(sources.range(file, at - 1, at)), nullptr);
}

} // namespace
} // namespace rung::frontend
