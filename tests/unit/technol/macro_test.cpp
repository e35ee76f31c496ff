// Macros, included files and the options of a compilation.
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <unistd.h>

#include "tests/unit/technol/program.h"

namespace rung::technol_test {
namespace {

using Lines = std::vector<std::string>;

class TechnolInclude : public testing::Test {
protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("rung-technol-" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  void file(const std::string& name, const std::string& text) { std::ofstream(folder_ / name) << text; }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  // The code of each error, without its place.
  static Lines codes(const Compilation& c) {
    Lines found;
    for (const std::string& line : c.errors()) found.push_back(line.substr(line.rfind(' ') + 1));
    return found;
  }

private:
  std::filesystem::path folder_;
};

TEST_F(TechnolInclude, HoldsConstantsAndMacros) {
  file("a.inc", "EQUI TEN,10\nDEF_T_MACRO SETW P1\n  LOD TEN\n  STO TMAC.P1\nEND_T_MACRO\n");
  Machine m(Parts{.data = "T_INCLUDE " + path("a.inc") + " ; comment\nW: DS 2\n", .main = "  SETW W\n"});
  m.scan();
  EXPECT_EQ(m.get("W"), 10);
}

TEST_F(TechnolInclude, NamesInApostrophesLieInTheSystemFolder) {
  file("sys.inc", "EQUI TEN,10\n");
  frontend::CompileOptions options;
  options.config["system_folder"] = path("");
  EXPECT_TRUE(compile({programText({.data = "T_INCLUDE 'sys.inc'\nA: DS TEN\n"})}, options).module);
  EXPECT_EQ(codes(compile({programText({.data = "T_INCLUDE 'other.inc'\n"})}, options)), (Lines{"include-not-found"}));
}

TEST_F(TechnolInclude, CodeAndCircles) {
  file("code.inc", "  LOD 5\n  CA\n");
  file("a.inc", "T_INCLUDE b.inc\n");
  file("b.inc", "T_INCLUDE a.inc\n");
  EXPECT_EQ(codes(compile({programText({.main = "  T_INCLUDE " + path("code.inc") + "\n"})})),
            (Lines{"code-in-include"}));
  EXPECT_EQ(codes(compile({programText({.data = "T_INCLUDE " + path("a.inc") + "\n"})})), (Lines{"include-cycle"}));
}

TEST_F(TechnolInclude, IsFoundInAnyCaseAndBesideTheProgramFirst) {
  std::filesystem::create_directories(path("Sub"));
  file("Sub/Both.inc", "EQUI WHERE,1\n");
  file("Sub/outer.inc", "T_INCLUDE BOTH.INC\n");
  const auto where = [&] {
    SourceManager sources;
    Diagnostics diagnostics;
    file("main.plc", programText({.data = "T_INCLUDE SUB\\OUTER.INC\nA: DS WHERE\n"}));
    const std::vector<FileId> files = {sources.addFile(path("main.plc")).value()};
    const auto module = frontend::technol::kTechnol.compile(sources, files, {}, diagnostics);
    return module ? module->spaces[1].units : 0;
  };
  EXPECT_EQ(where(), 1u);
  file("BOTH.INC", "EQUI WHERE,2\n");
  EXPECT_EQ(where(), 2u);
}

TEST(TechnolOptions, OfUnknownValueAreTold) {
  for (const auto& [key, value] : {std::pair("period_us", "0"), std::pair("period_us", "2ms")}) {
    frontend::CompileOptions options;
    options.config[key] = value;
    EXPECT_EQ(compile({programText({})}, options).errors(), (Lines{"-:0 operand-range"})) << key << " " << value;
  }
}

TEST(TechnolMacros, OperandsLocalsAndNegation) {
  Machine m(Parts{.data = "DEF_T_MACRO PUT V,BITV\n T_LOCAL OVER\n LDR -TMAC.BITV\n JL1 OVER\n LOD TMAC.V\n STO "
                          "W\nOVER:\nEND_T_MACRO T_END\nW: DS 2\nDFM A,B\n",
                  .main = "  PUT 7,A\n  PUT BYTE.9,B\n"});
  m.set("A", 1);
  m.scan();
  EXPECT_EQ(m.get("W"), 7);
  m.set("B", 1);
  m.scan();
  EXPECT_EQ(m.get("W"), 9);
}

TEST(TechnolMacros, AddressOfAParameter) {
  Machine m(Parts{.data = "DEF_T_MACRO MARK WEIGHT,AT\n FL 1,TMAC.AT.WEIGHT\nEND_T_MACRO\nW: DS 2\nDFM B0,B1\n",
                  .main = "  MARK B1,W\n"});
  m.scan();
  EXPECT_EQ(m.get("W"), 2);
}

TEST(TechnolMacros, StatesOfAMechanismStandInTheLineOfTheUse) {
  Machine m(Parts{.data = "DEF_T_MACRO WAITFOR B\n LDR TMAC.B\n EX0\nEND_T_MACRO\nDFM GO\n",
                  .main = "  MECH_BEGIN M\n  WAITFOR GO\n  MECH_END M\n"});
  m.set("M", 1);
  m.scan();
  EXPECT_EQ(m.get("M_LINE"), 12);
}

void PrintTo(const struct Case& c, std::ostream* out);
struct Case {
  const char* name;
  std::string data, main;
  Lines errors;
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

const Case kCases[] = {
    {"NotClosed", "DEF_T_MACRO M\n", "", {"0:2 macro-not-closed"}},
    {"OperandCount",
     "DEF_T_MACRO M P\n LOD TMAC.P\nEND_T_MACRO\n",
     " M\n M 1,2\n M 1\n",
     {"0:9 macro-operand-count", "0:10 macro-operand-count"}},
    {"Recursion",
     "DEF_T_MACRO M\n M\nEND_T_MACRO\nDEF_T_MACRO A\n B\nEND_T_MACRO\nDEF_T_MACRO B\n A\nEND_T_MACRO\n",
     " M\n A\n",
     {"0:3 macro-recursion", "0:9 macro-recursion"}},
    {"EightBits",
     "DEF_T_MACRO M\nDATA_LOCAL\nDFM A,B,C,D,E,F,G\nDATA_LOCAL_END\nEND_T_MACRO\n",
     " M\n",
     {"0:4 dfm-needs-eight"}},
    {"LocalsTwice", "DEF_T_MACRO M\nL: LOD 5\nEND_T_MACRO\n", " M\n M\n", {"0:3 duplicate-symbol"}},
    {"EndWithoutBeginning", "END_T_MACRO\n", "", {"0:2 syntax-error"}},
    {"UnknownFlag", "DEF_T_MACRO M\nEND_T_MACRO T_MAYBE\n", "", {"0:3 syntax-error"}},
    {"AliasOfNothing", "APPEND_T_MACRO M,N\n", "", {"0:2 undefined-symbol"}},
};

class TechnolMacroErrors : public testing::TestWithParam<Case> {};

TEST_P(TechnolMacroErrors, AreReportedAtTheirLines) {
  const Compilation c = compileMain(GetParam().main, GetParam().data);
  EXPECT_EQ(c.errors(), GetParam().errors) << c.text();
}

INSTANTIATE_TEST_SUITE_P(Codes, TechnolMacroErrors, testing::ValuesIn(kCases),
                         [](const auto& tested) { return std::string(tested.param.name); });

} // namespace
} // namespace rung::technol_test
