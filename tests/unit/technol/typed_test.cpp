// What is known of a program that has been checked, without any IR: operands with their places and names, and what each
// statement does to the stack.
#include <gtest/gtest.h>

#include "frontend/dialects/technol/check/check_program.h"
#include "frontend/dialects/technol/read/reader.h"
#include "tests/unit/technol/program.h"

namespace rung::technol_test {
namespace {

using namespace frontend::technol;

class Checked {
public:
  explicit Checked(const std::string& text)
      : file_(sources_.addBuffer("main.plc", text)), source_(sources_), symbols_(diagnostics_), typed_(check()) {}

  const TypedProgram& typed() const { return typed_; }
  const Diagnostics& diagnostics() const { return diagnostics_; }
  // The first statement of an instruction.
  const Typed& of(std::string_view mnemonic, int number = 0) const {
    for (size_t i = 0; i < source_.statements.size(); ++i)
      if (source_.statements[i].row && source_.statements[i].row->info.mnemonic == mnemonic && number-- == 0)
        return typed_.statements[i];
    ADD_FAILURE() << mnemonic;
    return typed_.statements[0];
  }
  std::string_view text(SourceRange range) const { return sources_.text(range); }
  // "NAME=SYMBOL" of each name in an operand.
  std::vector<std::string> names(const Operand& operand) const {
    std::vector<std::string> found;
    for (const frontend::NameUse& use : typed_.namesOf(operand))
      found.push_back(std::string(text(use.range)) + "=" + std::string(symbols_[use.definition].name));
    return found;
  }

private:
  TypedProgram check() {
    readProgram({sources_, {}, diagnostics_, source_, declarations_, symbols_}, std::span(&file_, 1));
    return checkProgram(source_, declarations_, symbols_, "", diagnostics_);
  }

  SourceManager sources_;
  Diagnostics diagnostics_;
  FileId file_;
  SourceProgram source_;
  Declarations declarations_;
  Symbols symbols_;
  TypedProgram typed_;
};

using Names = std::vector<std::string>;

TEST(TechnolTyped, OperandsHavePlaceRangeAccessAndNames) {
  const Checked c(programText(
      {.data = "EQUI TWO,2\nDFM A,B\nT: DS 10\nW: DS 2\n", .main = " LDR B\n WR A\n LOD WORD.(T + two)\n STO W\n"}));
  ASSERT_FALSE(c.diagnostics().hasErrors());
  const auto load = c.typed().operandsOf(c.of("LOD"));
  ASSERT_EQ(load.size(), 1u);
  EXPECT_EQ(c.text(load[0].range), "WORD.(T + two)");
  EXPECT_EQ(load[0].access, frontend::Access::Read);
  EXPECT_EQ(load[0].place.space, kDataSpace);
  EXPECT_EQ(load[0].place.byte, 3u);
  EXPECT_EQ(load[0].type, ir::Type::I16);
  EXPECT_EQ(c.names(load[0]), (Names{"T=T", "two=TWO"}));
  const Operand& written = c.typed().operandsOf(c.of("WR"))[0];
  EXPECT_EQ(written.access, frontend::Access::Write);
  EXPECT_EQ(c.names(written), Names{"A=A"});
  EXPECT_EQ(c.typed().operandsOf(c.of("LDR"))[0].place.bit, 1u);
}

TEST(TechnolTyped, MembersAndLabelsAreNames) {
  const Checked c(programText({.data = "P struc\nX DW ?\nP ends\nV P <1>\n",
                               .main = " LOD V.X\n LOD SYST_TIME_INFO.TIME_SEC\n JUM END\nEND: CLI\n"}));
  ASSERT_FALSE(c.diagnostics().hasErrors());
  EXPECT_EQ(c.names(c.typed().operandsOf(c.of("LOD"))[0]), (Names{"V=V", "X=X"}));
  EXPECT_EQ(c.names(c.typed().operandsOf(c.of("LOD", 1))[0]),
            (Names{"SYST_TIME_INFO=SYST_TIME_INFO", "TIME_SEC=TIME_INFOS.TIME_SEC"}));
  EXPECT_EQ(c.names(c.typed().operandsOf(c.of("JUM"))[0]), Names{"END=END"});
}

TEST(TechnolTyped, StatementsSayWhatTheyDoToTheStack) {
  const Checked c(programText({.data = "DFM A\n", .main = " LDR A\n LDR A\n LDR A\n LO\n LA\n WR A\n LDR A\n WR A\n"}));
  ASSERT_FALSE(c.diagnostics().hasErrors());
  EXPECT_TRUE(c.of("LDR").stack.begins);
  EXPECT_EQ(c.of("LDR").stack.pushed, kNone);
  EXPECT_FALSE(c.of("LDR", 2).stack.begins);
  EXPECT_EQ(c.of("LDR", 2).stack.pushed, 1u);
  EXPECT_EQ(c.of("LDR", 2).stack.depth, 2u);
  EXPECT_EQ(c.of("LO").stack.popped, 1u);
  EXPECT_EQ(c.of("LA").stack.popped, 0u);
  EXPECT_EQ(c.of("WR").stack.popped, kNone);
  EXPECT_TRUE(c.of("LDR", 3).stack.begins);
}

// A program with errors has what could be understood.
TEST(TechnolTyped, WithErrorsTheRestIsThere) {
  const Checked c(programText({.data = "DFM A\n", .main = " LDR NONE\n WR A\n"}));
  EXPECT_TRUE(c.diagnostics().hasErrors());
  EXPECT_TRUE(c.typed().namesOf(c.typed().operandsOf(c.of("LDR"))[0]).empty());
  EXPECT_EQ(c.names(c.typed().operandsOf(c.of("WR"))[0]), Names{"A=A"});
}

} // namespace
} // namespace rung::technol_test
