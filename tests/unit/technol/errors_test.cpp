// Every code that the compiler reports for TECHNOL, at its line.
#include <gtest/gtest.h>

#include "tests/unit/technol/program.h"

namespace rung::technol_test {
namespace {

using Lines = std::vector<std::string>;

struct Case {
  const char* name;
  const char* data;   // lines 2 and on
  const char* main;   // after the data, lines 6 and on without data
  const char* errors; // ", " between them
  const char* warnings;
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

// With one line of data the main module's lines begin at 7; with none at 6.
// clang-format off: a case a line
constexpr Case kCases[] = {
    {"Balanced", "DFM A,B\n", " LDR A\n LDR B\n LO\n WR A\n", "", ""},
    {"UnbalancedAtModuleEnd", "DFM A,B\n", " LDR A\n LDR B\n WR A\n", "0:10 unbalanced-stack", ""},
    {"UnbalancedAtMechEnd", "DFM A,B\n", " MECH_BEGIN M\n LDR A\n LDR B\n WR A\n MECH_END M\n", "0:11 unbalanced-stack", ""},
    {"UnbalancedAtMechBegin", "DFM A,B\n", " LDR A\n LDR B\n WR A\n MECH_BEGIN M\n MECH_END M\n", "0:10 unbalanced-stack", ""},
    {"UnbalancedAtCheck", "DFM A,B\n", " LDR A\n LDR B\n CHECK\n WR A\n", "0:9 unbalanced-stack", ""},
    {"Underflow", "DFM A\n", " LDR A\n LA\n WR A\n", "0:8 stack-underflow", ""},
    {"Overflow", "DFM A\n", " LDR A\n LDR A\n LDR A\n LDR A\n LDR A\n LDR A\n LDR A\n LDR A\n LDR A\n LDR A\n LO\n LO\n LO\n LO\n LO\n LO\n LO\n LO\n WR A\n", "0:16 stack-overflow", ""},
    {"UnterminatedEquation", "DFM A\n", " LDR A\n LA A\n", "", "0:7 unterminated-equation"},
    {"UndefinedBit", "DFM A\n", " LDR A\n LA X\n WR A\n LDR X\n WR A\n", "0:8 undefined-symbol", ""},
    {"UndefinedCell", "", " LOD X\n STO Y\n", "0:6 undefined-symbol, 0:7 undefined-symbol", ""},
    {"UndefinedLabel", "", " JUM L\n", "0:6 undefined-symbol", ""},
    {"UndefinedMechanism", "", " MECH_INIT M\n", "0:6 undefined-symbol", ""},
    {"UndefinedProcedure", "", " PROC_CALL P\n", "0:6 undefined-symbol", ""},
    {"Duplicate", "A: DS 1\nDFM B,A\n", "", "0:3 duplicate-symbol", ""},
    {"DuplicateOfInterface", "MPX: DS 1\n", "", "0:2 duplicate-symbol", ""},
    {"DuplicateLabel", "A: DS 1\n", "L: LOD A\nl: LOD A\n", "0:8 duplicate-symbol", ""},
    {"SameConstantTwice", "EQUI K,5\nEQUI K,05h\n", "", "", ""},
    {"OtherConstantTwice", "EQUI K,5\nEQUI K,6\n", "", "0:3 duplicate-symbol", ""},
    {"CaseAndLength", "abc: DS 1\nABC: DS 1\nA123456789012345678901234567890X: DS 1\n", "", "0:3 duplicate-symbol", "0:4 name-too-long"},
    {"ReservedWord", "LDR: DS 1\nDR: DS 1\n", "", "0:2 reserved-word, 0:3 reserved-word", ""},
    {"ServiceNameAsSymbol", "DFM POS_RESET\n", " FL 1,POS_RESET\n", "", "0:2 reserved-word"},
    {"BadIdentifier", "1A: DS 1\nA#B: DS 1\nDFM 2C\n", "", "0:2 bad-identifier, 0:3 bad-identifier, 0:4 bad-identifier", ""},
    {"BadIdentifierParts", "DFM A-B\nEQUI C-D,5\nDFM E F\n", " MECH_BEGIN M-1\n PROC_BEGIN 1P\n", "0:2 bad-identifier, 0:3 bad-identifier, 0:4 syntax-error, 0:9 bad-identifier, 0:10 bad-identifier", ""},
    {"StoreToConstant", "A: DS 1\n", " STO CNST.5\n STO 5\n MOVE A,CNST.5\n", "0:7 invalid-type-prefix, 0:7 wrong-operand-kind, 0:8 wrong-operand-kind, 0:9 invalid-type-prefix", ""},
    {"ModuleInsideModule", "A: DS 1\n", "MODULE_CONT\nMODULE_CONT_END\n LOD A\n", "0:7 module-not-closed", ""},
    {"BadCharacter", "A: DS 1\n", " LOD \"A\n LOD &\n", "0:7 bad-identifier, 0:8 bad-character", ""},
    {"BadNumber", "", " LOD 12X\n LOD 0GH\n LOD 1.5Z\n LOD 012b\n", "0:6 bad-number, 0:7 bad-number, 0:8 bad-number, 0:9 bad-number", ""},
    {"BadString", "S: STR 5,'abc\n", "", "0:2 bad-string", ""},
    {"NumberTooLarge", "", " LOD 99999999999999999999\n LOD 0FFFFFFFFFFFFFFFFFh\n", "0:6 operand-range, 0:7 operand-range", ""},
    {"TextCharacter", "S: STR 5,'a\xE2\x86\x92'\n", " STRCPY S,'\xE2\x82\xAC\xE2\x86\x92'\n LOD '\xE2\x86\x92'\n EQUI K,'\xE2\x86\x92'\n", "0:2 text-character, 0:7 text-character, 0:8 text-character, 0:9 text-character", ""},
    {"SyntaxError", "A: DS 1\n", " 5\n LOD (A+1\n : LOD A\n LOD A,\n", "0:7 syntax-error, 0:8 syntax-error, 0:9 syntax-error, 0:10 operand-count", ""},
    {"UnknownInstruction", "", " LODE 5\n", "0:6 unknown-instruction", ""},
    {"UnknownBeginning", "DFM A\n", " MECH_BEGINN CLAMP\n EX\n LDR A\n EX0\n MECH_END CLAMP\n MECH_INIT CLAMP\n", "0:7 unknown-instruction", ""},
    {"UnknownEnd", "DFM A\n", " MECH_BEGIN M\n EX\n MECH END M\n PROC_BEGIN P\n PROCEND P\n FL 1,A\n", "0:9 unknown-instruction, 0:11 unknown-instruction", ""},
    {"UnknownThatFitsNowhere", "DFM A\n", " MECH_EN M\n STOPP\n DFMM B\n FL 1,A\n", "0:7 unknown-instruction, 0:8 unknown-instruction, 0:9 unknown-instruction", ""},
    {"UnknownDeclaration", "DFMM A,B\nX: DSS 4\n", " FL 1,A,B\n LOD X\n", "0:2 unknown-instruction, 0:3 unknown-instruction", ""},
    {"UndefinedInAMacro", "DEF_T_MACRO TWICE\n LDR NONE\n WR NONE\nEND_T_MACRO\n", " TWICE\n TWICE\n", "0:3 undefined-symbol", ""},
    {"UnknownInEquation", "DFM A\n", " LDR A\n EX2\n WR A\n LDR A\n EX2\n", "0:8 unknown-instruction, 0:11 unknown-instruction", ""},
    {"UnsupportedAssembler", "", " PUSH AX\n MOV BX, DX\n", "0:6 unsupported-assembler, 0:7 unsupported-assembler", ""},
    {"OperandCount", "DFM A\n", " LDR\n LA A,A\n WR\n FL 1\n CA A\n JUM\n", "0:7 operand-count, 0:8 operand-count, 0:9 operand-count, 0:10 operand-count, 0:11 operand-count, 0:12 operand-count", ""},
    {"OperandRange", "DFM A\n", " FL 2,A\n CONDR 32\n LOD 100000000h\n LOD BYTE.256\n LOD BYTE.-129\n LOD BYTE.-128\n", "0:7 operand-range, 0:8 operand-range, 0:9 operand-range, 0:10 operand-range, 0:11 operand-range", ""},
    {"SizeZero", "A: DS 0\n", "", "0:2 operand-range", ""},
    {"TimeTooLargeForItsCount", "C: DS 1\n", " MECH_BEGIN M\n TIM C,256\n MECH_END M\n", "0:8 operand-range", ""},
    {"WrongKinds", "DFM A\nC: DS 1\n", "L: LDR C\n LOD A\n STO 5\n LOD L\n JUM C\n WR C\n LDR C.C\n LA 5\n WR A\n", "0:8 wrong-operand-kind, 0:9 wrong-operand-kind, 0:10 wrong-operand-kind, 0:11 wrong-operand-kind, 0:12 wrong-operand-kind, 0:13 wrong-operand-kind, 0:14 wrong-operand-kind, 0:15 wrong-operand-kind", ""},
    {"SignWhereNothingIsRead", "DFM A\n", " WR -A\n EDGE_H -A\n AD -CELL1\n", "0:7 wrong-operand-kind, 0:8 wrong-operand-kind, 0:9 undefined-symbol", ""},
    {"InvalidPrefix", "A: DS 8\nB: DS 1\n", " MULB QWRD.A\n ORB REAL.A\n RL WORD.A\n TM DWRD.A\n LOD QWRD.5\n CU BYTE.B\n", "0:8 invalid-type-prefix, 0:9 invalid-type-prefix, 0:10 invalid-type-prefix, 0:11 invalid-type-prefix, 0:12 invalid-type-prefix, 0:13 invalid-type-prefix", ""},
    {"TypedWaitWithConstantTime", "C: DS 1\n", " MECH_BEGIN M\n TIM BYTE.C,5\n MECH_END M\n", "0:8 invalid-type-prefix", ""},
    {"Untyped", "A: DS 16\n", " LOD A\n LOD WORD.A\n", "0:7 untyped-operand", ""},
    {"TypeMismatch", "A: DS 1\nB: DS 2\n", " MOVE A,B\n MOVE A,BYTE.B\n", "0:8 type-mismatch", ""},
    {"WriteToReadonly", "", " FL 1,MPX\n LOD 1\n STO PB11\n STO REAL.ANALOG_INPUT_PHYSICAL\n FL 0,P1OUT.IO_DIS_ERR\n", "0:6 write-to-readonly, 0:8 write-to-readonly", "0:9 write-to-readonly"},
    {"BlocksAreReadonly", "", " FL 1,BLK[0].M3\n", "0:6 write-to-readonly", ""},
    {"TooManyBits", "DFM A,B,C,D,E,F,G,H,I\nDFM K,,,\n", "", "0:2 too-many-bits", ""},
    {"MissingLabel", "STR 10\nDS 2\n", "", "0:2 missing-label, 0:3 missing-label", ""},
    {"DeclarationOutsideData", "", "X: DS 1\n LOD X\n", "0:6 declaration-outside-data", ""},
    {"ExOutside", "A: DS 1\n", " EX\n PLCT_CHANGED 1,A\n", "0:7 ex-outside-mechanism, 0:8 ex-outside-mechanism", ""},
    {"ServiceOutsideModules", "", "MODULE_MAIN_END\n SPI_MAIN 4\nMODULE_CONT\nMODULE_CONT_END\nMODULE_DONE\n", "0:7 code-outside-module, 0:11 module-not-closed", ""},
    {"ServiceInLoop", "A: DS 4\n", " MECH_BEGIN M\nL: PLCT_CHANGED 1,A\n JUM L\n MECH_END M\n", "", ""},
    {"ValueInPlaceOfDr", "A: DS 2\n", " MECH_BEGIN M\n EX\n ESET 12\n ANALOG A\n ANALOG A,4\n ANALOG_SPI A,4\n COM_SEND 1,A\n MECH_END M\n", "", ""},
    {"LostValueInDr", "", " MECH_BEGIN M\n EX\n COM_SEND 1\n EX\n ANALOG\n EX\n ANALOG_SPI -,4\n MECH_END M\n", "", "0:8 value-not-preserved, 0:10 value-not-preserved, 0:12 value-not-preserved"},
    {"ServiceAnswersInRegisters", "A: DS 4\n", " MECH_BEGIN M\n EX\n PLCT_CHANGED 1,A\n EX0\n EQ CNST.0\n JL0 E\nE: MECH_END M\n", "", ""},
    {"ExInProcedure", "", " MECH_BEGIN M\n PROC_BEGIN P\n EX\n PROC_END P\n MECH_END M\n", "0:8 ex-outside-mechanism", ""},
    {"MechNames", "", " MECH_BEGIN M\n MECH_END N\n MECH_END M\n", "0:7 mech-name-mismatch, 0:8 mech-name-mismatch", ""},
    {"MechNotClosed", "", " MECH_BEGIN M\n EX\n", "0:8 mech-not-closed", ""},
    {"NestedMechanism", "", " MECH_BEGIN M\n MECH_BEGIN N\n MECH_END N\n MECH_END M\n", "0:7 nested-mechanism", ""},
    {"LoopWithoutEx", "A: DS 2\n", " MECH_BEGIN M\nL: LOD A\n JUM L\n MECH_END M\n MECH_BEGIN N\nK: LOD A\n EX\n JUM K\n MECH_END N\n", "0:9 mech-loop-without-ex", ""},
    {"JumpIntoMechanism", "A: DS 1\n", " JUM L\n MECH_BEGIN M\nL: LOD A\n JUM K\n MECH_END M\nK: LOD A\n", "0:7 jump-crosses-unit, 0:10 jump-crosses-unit", ""},
    {"JumpOutOfTimedBlock", "A: DS 1\n", " DFTM1 E\n LOD A\n JUM E\n JUM K\nE:\nK: LOD A\n", "0:10 jump-crosses-unit", ""},
    {"TimedBlockWithoutEnd", "A: DS 1\n", "E: LOD A\n DFTM1 E\n LOD A\n DFTM10 F\n LOD A\n", "0:8 syntax-error, 0:10 undefined-symbol", ""},
    {"TimedBlockAcrossMechanism", "A: DS 1\n", " MECH_BEGIN M\n DFTM1 E\n EX\n MECH_END M\nE: LOD A\n", "0:8 jump-crosses-unit", ""},
    {"ProcNames", "", " PROC_BEGIN P\n PROC_END Q\n PROC_END P\n", "0:7 proc-name-mismatch, 0:8 proc-name-mismatch", ""},
    {"ProcNotClosed", "", " PROC_BEGIN P\n", "0:7 proc-not-closed", ""},
    {"NestedProcedure", "", " PROC_BEGIN P\n PROC_BEGIN Q\n PROC_END Q\n PROC_END P\n", "0:7 nested-procedure", ""},
    {"Recursion", "", " PROC_BEGIN P\n PROC_CALL Q\n PROC_END P\n PROC_BEGIN Q\n PROC_CALL P\n PROC_END Q\n", "0:10 recursive-procedure", ""},
    {"RecursionByMessages", "", " PROC_BEGIN _ON_ESET\n PROC_CALL P\n PROC_END _ON_ESET\n PROC_BEGIN P\n ESET 5\n PROC_END P\n", "0:10 recursive-procedure", ""},
    {"InitOnly", "DFM A\n", " EDEF -,A,5,-,1\n", "0:7 init-only-instruction", ""},
    {"Licence", "A: DS 4\n", " LDR_LIC FEATUREPLC9\n JL0 E\nE: LDR_LIC FeaturePlc10\n JL0 E\n LDR_LIC A\n JL0 E\n LOD HwKeyConnected\n", "0:9 undefined-symbol, 0:11 wrong-operand-kind, 0:13 undefined-symbol", ""},
    {"AddressOutside", "A: DS 4\n", " LOD DWRD.(A+1)\n LOD BYTE.(A-1)\n", "0:7 address-out-of-range, 0:8 address-out-of-range", ""},
    {"CntsPrefix", "", " LOD CNTS.5\n", "", "0:6 cnts-prefix"},
    {"JloAlias", "", "L: JLO L\n", "", "0:6 jlo-alias"},
    {"SharedName", "POSUN: DS 1\n", " MECH_BEGIN POSUN\n EX\n MECH_END POSUN\n LDR POSUN\n FL1 0,POSUN\n LOD POSUN\n MECH_INIT POSUN\n", "", "0:7 shared-name"},
    {"MixedRealInteger", "R: DS 8\nW: DS 2\n", " LOD REAL.R\n AD W\n STO REAL.R\n LOD REAL.R\n AD W\n REAL QWRD\n STO REAL.R\n", "", "0:9 mixed-real-integer"},
    {"ValueNotPreserved", "DFM A\nW: DS 2\n", " MECH_BEGIN M\n LDR A\n EX0\n WR A\n EX\n STO W\n LDR A\n EX0\n STO W\n MECH_END M\n", "", "0:11 value-not-preserved, 0:13 value-not-preserved"},
    {"TmOutsideDftm", "C: DS 2\n", " TM C\n DFTM1 E\n TM C\nE:\n", "", "0:7 tm-outside-dftm"},
    {"StringTooLong", "S: STR 2,'abc'\n", "", "", "0:2 string-too-long"},
    {"SeveralErrorsOneRun", "DFM A\n", " LDR X\n WR A\n LOD A\n STO Y\n FOO\n", "0:7 undefined-symbol, 0:9 wrong-operand-kind, 0:10 undefined-symbol, 0:11 unknown-instruction", ""},
};
// clang-format on

std::string listOf(const Lines& codes) {
  std::string text;
  for (const std::string& code : codes) text += (text.empty() ? "" : ", ") + code;
  return text;
}

class TechnolErrors : public testing::TestWithParam<Case> {};

TEST_P(TechnolErrors, AreReportedAtTheirLines) {
  const Case& c = GetParam();
  const Compilation result = compileMain(c.main, c.data);
  EXPECT_EQ(listOf(result.errors()), c.errors) << result.text();
  EXPECT_EQ(listOf(result.warnings()), c.warnings) << result.text();
  EXPECT_EQ(result.module != nullptr, result.errors().empty());
}

INSTANTIATE_TEST_SUITE_P(Codes, TechnolErrors, testing::ValuesIn(kCases),
                         [](const auto& tested) { return std::string(tested.param.name); });

Lines errorsOf(const std::vector<std::string>& files) { return compile(files).errors(); }

constexpr const char* kRest =
    "MODULE_BLOCK_INIT\nMODULE_BLOCK_INIT_END\nMODULE_BLOCK_DONE\nMODULE_BLOCK_DONE_END\nMODULE_INIT\nMODULE_INIT_END\n"
    "MODULE_CLEAR\nMODULE_CLEAR_END\nMODULE_HALT\nMODULE_HALT_END\n";              // 10 lines
constexpr const char* kFirst = "DATA\nDATA_END\nMODULE_INPUT\nMODULE_INPUT_END\n"; // 4 lines
constexpr const char* kMain = "MODULE_MAIN\nMODULE_MAIN_END\n";

// What was probably meant stands beside the report.
TEST(TechnolHints, NameWhatWasMeant) {
  const struct {
    const char *statement, *hint;
  } cases[] = {{"LOD WRD.W", "did you mean WORD?"},
               {"DFTM1 LOOPX\nLOOP1:", "did you mean LOOP1?"},
               {"LOD DWORD.W", "did you mean DWRD?"},
               {"LOD SYST_TIME_INFO.TIME_SEK", "did you mean TIME_SEC?"},
               {"LDR BLK[0].M99", "did you mean M9?"},
               {"LDR P1OUT.IO_DIS_ER", "did you mean IO_DIS_ERR?"},
               {"LOD SPEDE", "did you mean SPEED?"},
               {"LDR_LIC FeaturPlc1", "did you mean FeaturePlc1?"},
               {"LOD FFh", "as a number: 0FFh"},
               {"LDR W", "'W' is a WORD, but a bit is needed here"},
               {"STRCPY W,\"abc", "a text is written between apostrophes"},
               {"MECH BEGIN M", "did you mean MECH_BEGIN?"},
               {"CAN_ SEND 1,W", "did you mean CAN_SEND?"},
               {"FLD W", "in this language: LOD REAL."},
               {"MECH_INIT", "its operands in order: mech\n"},
               {"FL 1", "its operands in order: value, bit, ..."},
               {"RL", "its operands in order: n, [width]; those in brackets may be left out"},
               {"ESET 1,2,3,4,5,6,7", "ESET takes at most 6 operands, not 7"},
               {"LOD A1\n LOD A1", "it is used once more, here"},
               {"LOD A1\n LOD A1\n LOD A1\n STO A1", "and 3 further uses; the next is here"},
               {"MECH_END M", "MECH_END names 'M', but no mechanism is open"}};
  for (const auto& c : cases) {
    const std::string text = compileMain(" " + std::string(c.statement) + "\n", "W: DS 2\nSPEED: DS 2\n").text();
    EXPECT_NE(text.find(c.hint), std::string::npos) << c.statement << '\n' << text;
  }
}

TEST(TechnolHints, NoNumberForALetter) {
  EXPECT_EQ(compileMain(" LOD BYTE.W.B\n", "W: DS 2\n").text().find("as a number"), std::string::npos);
}

// The word that was meant, in the place of what was written.
TEST(TechnolHints, UnknownInstructionsHaveAFix) {
  for (const char* word : {"MECH_BEGINN", "MECH BEGIN"}) {
    const Compilation c = compileMain(" " + std::string(word) + " M\n MECH_END M\n");
    ASSERT_EQ(c.diagnostics->reported().size(), 1u) << c.text();
    const std::vector<DiagFix>& fixes = c.diagnostics->reported()[0].fixes;
    ASSERT_EQ(fixes.size(), 1u) << c.text();
    EXPECT_EQ(c.sources->text(fixes[0].range), word);
    EXPECT_EQ(fixes[0].replacement, "MECH_BEGIN");
  }
}

TEST(TechnolStructure, AnEmptyFileIsToldAtItsFirstLine) {
  const Lines errors = errorsOf({""});
  ASSERT_FALSE(errors.empty());
  EXPECT_EQ(errors.front(), "0:1 data-not-first");
}

TEST(TechnolStructure, DataComesFirst) {
  EXPECT_EQ(errorsOf({std::string("MODULE_INPUT\nMODULE_INPUT_END\nDATA\nDATA_END\n") + kMain + kRest + "STOP\n"}),
            (Lines{"0:1 data-not-first"}));
}

TEST(TechnolStructure, MissingModulesAndStop) {
  EXPECT_EQ(errorsOf({std::string(kFirst) + kRest}), (Lines{"0:14 missing-module", "0:14 missing-stop"}));
  const Compilation several = compile({std::string(kFirst) + kMain});
  EXPECT_EQ(several.errors(), (Lines{"0:6 missing-module", "0:6 missing-stop"}));
  EXPECT_NE(several.text().find("modules are missing: MODULE_BLOCK_INIT, MODULE_BLOCK_DONE, MODULE_INIT, MODULE_CLEAR, "
                                "MODULE_HALT [missing-module]"),
            std::string::npos)
      << several.text();
}

TEST(TechnolStructure, DuplicateModule) {
  EXPECT_EQ(errorsOf({std::string(kFirst) + kMain + kMain + kRest + "STOP\n"}), (Lines{"0:7 duplicate-module"}));
}

TEST(TechnolStructure, NotClosed) {
  EXPECT_EQ(errorsOf({std::string(kFirst) + "MODULE_MAIN\n" + kRest + "STOP\n"}), (Lines{"0:6 module-not-closed"}));
  EXPECT_EQ(errorsOf({std::string(kFirst) + "MODULE_MAIN\nMODULE_INIT_END\n" + kRest + "STOP\n"}),
            (Lines{"0:6 module-not-closed"}));
  EXPECT_EQ(errorsOf({std::string(kFirst) + kRest + "MODULE_MAIN\n"}),
            (Lines{"0:15 module-not-closed", "0:15 missing-stop"}));
}

TEST(TechnolStructure, CodeOutsideModules) {
  EXPECT_EQ(errorsOf({std::string(kFirst) + "LOD 5\nCA\n" + kMain + kRest + "STOP\n"}),
            (Lines{"0:5 code-outside-module"}));
  EXPECT_EQ(errorsOf({std::string("DATA\nCA\nDATA_END\nMODULE_INPUT\nMODULE_INPUT_END\n") + kMain + kRest + "STOP\n"}),
            (Lines{"0:2 code-outside-module"}));
}

TEST(TechnolStructure, TextAfterStop) {
  const Compilation c = compile({std::string(kFirst) + kMain + kRest + "STOP\n; comment\n\nLOD X\nLOD Y\n"});
  EXPECT_TRUE(c.errors().empty());
  EXPECT_EQ(c.warnings(), (Lines{"0:20 text-after-stop"}));
}

TEST(TechnolStructure, FurtherFiles) {
  const std::string first = std::string(kFirst) + kMain + kRest + "STOP\n";
  EXPECT_TRUE(errorsOf({first, "DATA\nDATA_END\nMODULE_MAIN\nMODULE_MAIN_END\n"}).empty());
  EXPECT_EQ(errorsOf({first, "DATA\nDATA_END\nMODULE_INPUT\nMODULE_INPUT_END\nMODULE_MAIN\nMODULE_MAIN_END\n"}),
            (Lines{"1:3 module-not-allowed"}));
  EXPECT_EQ(errorsOf({first, "DATA\nDATA_END\n"}), (Lines{"1:2 missing-module"}));
  EXPECT_EQ(errorsOf({first, "MODULE_MAIN\nMODULE_MAIN_END\n"}), (Lines{"1:1 data-not-first"}));
}

TEST(TechnolStructure, TooManyFiles) {
  EXPECT_EQ(errorsOf(std::vector<std::string>(65, kFirst)), (Lines{"64:1 too-many-files"}));
}

} // namespace
} // namespace rung::technol_test
