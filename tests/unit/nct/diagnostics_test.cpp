// Every code that the dialect reports, at its line and column; several in one program, none that only follows another.
#include <gmock/gmock.h>

#include "tests/unit/nct/support.h"

namespace rung::frontend::nct::test {
namespace {

// One rung; its drawing is line 4 of the file. "": nothing is reported.
struct RungCase {
  const char* name;
  const char* drawing;
  const char* codes; // ", " between them
};

std::string codesOf(const Compiled& c) {
  std::string text;
  for (const std::string& code : c.codes()) text += (text.empty() ? "" : ", ") + code;
  return text;
}

void PrintTo(const RungCase& c, std::ostream* out) { *out << c.drawing; }

std::string titleOf(const ::testing::TestParamInfo<RungCase>& info) { return info.param.name; }

class MainRung : public ::testing::TestWithParam<RungCase> {};
class Int0Rung : public ::testing::TestWithParam<RungCase> {};

TEST_P(MainRung, Reports) {
  const Compiled c =
      compileMain(std::string("rung\n") + GetParam().drawing +
                  "\n\nsymbol APPLE 7100\nsymbol PEAR 7101.05\nconst TEN #10\nconst PI *3.14\nsymbol REG 7102\n");
  EXPECT_EQ(codesOf(c), GetParam().codes) << c.rendered();
  EXPECT_EQ(c.module == nullptr, c.diagnostics.hasErrors());
}

TEST_P(Int0Rung, Reports) {
  const Compiled c = compileFile(std::string("dialect nct\nmodule INT0\nrung\n") + GetParam().drawing +
                                 "\n\nmodule MAIN\nsymbol APPLE 7100\n");
  EXPECT_EQ(codesOf(c), GetParam().codes) << c.rendered();
}

INSTANTIATE_TEST_SUITE_P(
    Addresses, MainRung,
    ::testing::ValuesIn(std::vector<RungCase>{
        {"ThreeDigits", "|--[756.17]--(7000.00)", "4:5 address-format"},
        {"FiveDigits", "|--[10000]--(7000.00)", "4:5 address-format"},
        {"TwoDigits", "|--[7000.00]--{MOV 56 #1}", "4:20 address-format"},
        {"BareNumberForConstant", "|--[7000.00]--{MOV 7001 5}", "4:25 address-format"},
        {"LetterInNumber", "|--[70A0.00]--(7000.00)", "4:5 address-format"},
        {"IndexRegisterFormat", "|--[7000.00,56]--(7000.01)", "4:13 address-format"},
        {"DoubleIndex", "|--[7000,7001,#1]--(7000.01)", "4:10 address-format"},
        {"OneBitDigit", "|--[7000.5]--(7000.00)", "4:10 bit-format"},
        {"ThreeBitDigits", "|--[7000.005]--(7000.00)", "4:10 bit-format"},
        {"NoBitDigits", "|--[7000.]--(7000.00)", "4:5 bit-format"},
        {"Bit31", "|--[7000.31]--(7000.00)", ""},
        {"Bit32", "|--[7000.32]--(7000.00)", "4:10 bit-out-of-range"},
        {"Undeclared", "|--[NOWHERE]--(7000.00)", "4:5 undeclared-symbol"},
        {"UndeclaredIndex", "|--[7000.00,NOWHERE]--(7000.01)", "4:13 undeclared-symbol"},
        {"UndeclaredBitRegister", "|--[7000:NOWHERE]--(7000.01)", "4:10 undeclared-symbol"},
        {"WordForBit", "|--[PEAR]--(APPLE)", "4:13 symbol-kind-mismatch"},
        {"NumberForBit", "|--[PEAR]--(7000)", "4:13 symbol-kind-mismatch"},
        {"BitForWord", "|--[PEAR]--{MOV PEAR #1}", "4:17 symbol-kind-mismatch"},
        {"BitAsSource", "|--[PEAR]--{MOV APPLE PEAR}", "4:23 symbol-kind-mismatch"},
        {"BitOfBitSymbol", "|--[PEAR.03]--(7000.00)", "4:5 symbol-kind-mismatch"},
        {"ConstantForAddress", "|--[PEAR]--{MOV TEN #1}", "4:17 symbol-kind-mismatch"},
        {"ConstantForContact", "|--[TEN]--(7000.00)", "4:5 symbol-kind-mismatch"},
        {"ConstantAsBase", "|--[TEN.05]--(7000.00)", "4:5 symbol-kind-mismatch"},
        {"BitAsIndex", "|--[7000.00,PEAR]--(7000.01)", "4:13 symbol-kind-mismatch"},
        {"IndexBehindEnd", "|--[9999.00,#1]--(7000.01)", "4:5 address-out-of-range"},
        {"IndexAtEnd", "|--[9998.00,#1]--(7000.01)", ""},
        {"IndexBelowStart", "|--[0000.00,#-1]--(7000.01)", "4:5 address-out-of-range"},
        {"IndexConstantSymbol", "|--[9990.00,TEN]--(7000.01)", "4:5 address-out-of-range"},
        {"LastElement", "|--[AN_PLCA,#31]--(AP_PLCR,#31)", ""},
        {"ElementTooFar", "|--[AN_PLCA,#32]--(AP_PLCR,#-1)", "4:5 signal-index (w), 4:20 signal-index (w)"},
        {"LastDouble", "|--[PEAR]--{MOVF CP_FOVER,#14 *1.0}", ""},
        {"DoubleTooFar", "|--[PEAR]--{MOVF CP_FOVER,#16 *1.0}", "4:18 signal-index (w)"},
        {"ComputedElement", "|--[AN_PLCA,REG]--(7000.00)", ""},
        {"WordsThatFollowEachOther", "|--[INP000.05,#15]--(7000.00)", ""},
        {"DoubleAt9998", "|--[PEAR]--{MOVF 9998 *1.0}", ""},
        {"DoubleAt9999", "|--[PEAR]--{MOVF 9999 *1.0}", "4:18 double-at-9999"},
        {"OddIndex", "|--[PEAR]--{MOVF 7000,#3 *1.0}", "4:18 odd-double-index"},
        {"EvenIndex", "|--[PEAR]--{MOVF 7000,#4 *1.0}", ""},
        {"TimerBelowUserMemory", "|--[PEAR]--{TOND 3999 #5 #0}--(7000.00)", "4:18 user-area-required"},
        {"TimerAtUserMemory", "|--[PEAR]--{TOND PLCNVRAM #5 #0}--(7000.00)", ""},
        {"WriteFlags", "|--[PEAR]--(FL_ER)", "4:13 write-to-flags"},
        {"WriteFlagsWord", "|--[PEAR]--{MOV FLAGS #1}", "4:17 write-to-flags"},
        {"SetFlags", "|--[PEAR]--(S 0000.07)", "4:15 write-to-flags"},
        {"PulseFlags", "|--[PEAR]--{DIFU FL_CY}", "4:18 write-to-flags"},
        {"WriteInput", "|--[PEAR]--(MB_START)", "4:13 write-to-input (w)"},
        {"WriteInputWord", "|--[PEAR]--{MOV INP000 #1}", "4:17 write-to-input (w)"},
        {"WriteOutput", "|--[PEAR]--(ML_START)", ""},
    }),
    titleOf);

INSTANTIATE_TEST_SUITE_P(
    Constants, MainRung,
    ::testing::ValuesIn(std::vector<RungCase>{
        {"NoPoint", "|--[PEAR]--{MOVF 7000 *5}", "4:23 constant-format"},
        {"Exponent", "|--[PEAR]--{MOVF 7000 *5.0e3}", "4:23 constant-format"},
        {"PointOnly", "|--[PEAR]--{MOVF 7000 *.}", "4:23 constant-format"},
        {"PointFirst", "|--[PEAR]--{MOVF 7000 *.25}", ""},
        {"PointLast", "|--[PEAR]--{MOVF 7000 *-3.}", ""},
        {"DecimalWithLetter", "|--[PEAR]--{MOV 7000 #1A}", "4:22 constant-format"},
        {"DecimalWithPlus", "|--[PEAR]--{MOV 7000 #+14}", "4:22 constant-format"},
        {"HexWithLetter", "|--[PEAR]--{MOV 7000 #$XY}", "4:22 constant-format"},
        {"NothingBehindHash", "|--[PEAR]--{MOV 7000 #}", "4:22 constant-format"},
        {"NoHash", "|--[PEAR]--{MOV 7000 -5}", "4:22 constant-format"},
        {"HexIndex", "|--[7000,#$1]--(7000.00)", "4:10 constant-format"},
        {"GreatestDecimal", "|--[PEAR]--{MOV 7000 #2147483647}", ""},
        {"TooLargeDecimal", "|--[PEAR]--{MOV 7000 #2147483648}", "4:22 constant-out-of-range"},
        {"LeastDecimal", "|--[PEAR]--{MOV 7000 #-2147483648}", ""},
        {"TooSmallDecimal", "|--[PEAR]--{MOV 7000 #-2147483649}", "4:22 constant-out-of-range"},
        {"HugeDecimal", "|--[PEAR]--{MOV 7000 #99999999999999999999999999}", "4:22 constant-out-of-range"},
        {"GreatestHex", "|--[PEAR]--{MOV 7000 #$FFFFffff}", ""},
        {"TooLargeHex", "|--[PEAR]--{MOV 7000 #$100000000}", "4:22 constant-out-of-range"},
        {"BasisTooLarge", "|--[PEAR]--{TOND 7000 #5 #4}--(7001.00)", "4:26 constant-out-of-range"},
        {"BasisNegative", "|--[PEAR]--{TOND 7000 #5 #-1}--(7001.00)", "4:26 constant-out-of-range"},
        {"SetValueNegative", "|--[PEAR]--{TOND 7000 #-5 #0}--(7001.00)", "4:23 constant-out-of-range"},
        {"SecondsAtLimit", "|--[PEAR]--{TOND 7000 #2147483 #1}--(7001.00)", ""},
        {"SecondsAboveLimit", "|--[PEAR]--{TOND 7000 #2147484 #1}--(7001.00)", "4:23 constant-out-of-range"},
        {"MinutesAboveLimit", "|--[PEAR]--{TOFFD 7000 #35792 #2}--(7001.00)", "4:24 constant-out-of-range"},
        {"HoursAboveLimit", "|--[PEAR]--{TPULSE 7000 #597 #3}--(7001.00)", "4:25 constant-out-of-range"},
        {"HoursAtLimit", "|--[PEAR]--{TPULSE 7000 #596 #3}--(7001.00)", ""},
        {"CounterNegative", "|--[PEAR]---{CNT 7000 #0 #-1 #0}--(7001.00)\n|--[PEAR]---{U/D}\n|--[PEAR]---{R}",
         "4:26 constant-out-of-range"},
    }),
    titleOf);

INSTANTIATE_TEST_SUITE_P(Operands, MainRung,
                         ::testing::ValuesIn(std::vector<RungCase>{
                             {"TooFew", "|--[PEAR]--{MOV 7000}", "4:13 operand-count"},
                             {"TooMany", "|--[PEAR]--{MOV 7000 #1 #2}", "4:25 operand-count"},
                             {"OneUnknown", "|--[PEAR]--{MOV NO}", "4:13 operand-count, 4:17 undeclared-symbol"},
                             {"MacroOfNoChannel", "|--[PEAR]--{MACR 7000 #500 #8}", "4:28 constant-out-of-range (w)"},
                             {"NoneForJump", "|--[PEAR]--{JMP}", "4:13 operand-count"},
                             {"SomeForRet", "|--[PEAR]--{RET #1}", "4:12 ret-outside-subroutine, 4:17 operand-count"},
                             {"IntegerForDouble", "|--[PEAR]--{MOVF 7000 #5}", "4:23 operand-type-mismatch"},
                             {"DoubleForInteger", "|--[PEAR]--{MOV 7000 *5.0}", "4:22 operand-type-mismatch"},
                             {"DecimalForMvn", "|--[PEAR]--{MVN 7000 #5}", "4:22 operand-type-mismatch"},
                             {"DecimalForNeg", "|--[PEAR]--{NEG 7000 #5}", "4:22 operand-type-mismatch"},
                             {"DecimalForAnd", "|--[PEAR]--{AND 7000 7001 #5}", "4:27 operand-type-mismatch"},
                             {"DecimalForXor", "|--[PEAR]--{XOR 7000 7001 #5}", "4:27 operand-type-mismatch"},
                             {"HexForTimer", "|--[PEAR]--{TOND 7000 #$5 #0}--(7001.00)", "4:23 operand-type-mismatch"},
                             {"ConstantSymbolOfOtherKind", "|--[PEAR]--{MOV 7000 PI}", "4:22 operand-type-mismatch"},
                             {"ConstantResult", "|--[PEAR]--{MOV #1 #1}", "4:17 operand-not-register"},
                             {"ConstantLeftSide", "|--{CLT #5 7000}--(7001.00)", "4:9 operand-not-register"},
                             {"ConstantCompared", "|--[PEAR]--{CMP #5 7000}", "4:17 operand-not-register"},
                             {"ConstantFirstOperand", "|--[PEAR]--{ADD 7000 #5 7001}", "4:22 operand-not-register"},
                             {"ConstantTimer", "|--[PEAR]--{TOND #7000 #5 #0}--(7001.00)", "4:18 operand-not-register"},
                             {"ConstantContact", "|--[#5]--(7001.00)", "4:5 operand-not-register"},
                             {"UnknownInstruction", "|--[PEAR]--{FOO 7000}", "4:13 unknown-instruction"},
                             {"ContactNameAsBox", "|--[PEAR]--{SET 7000.00}", "4:13 unknown-instruction"},
                             {"DecimalForReal", "|--[PEAR]--{SIN 7000 #1}", "4:22 operand-type-mismatch"},
                             {"NoSuchQuantity", "|--[PEAR]--{SCP 7000 ActPos #1 #0}", "4:22 unknown-scope-symbol"},
                             {"AxisNumberOfQuantity", "|--[PEAR]--{SCP 7000 ActPosAx #33 #0}",
                              "4:31 constant-out-of-range"},
                             {"FunctionOfTheOther", "|--[PEAR]--{MR 7000 #11}", "4:21 unknown-function-code (w)"},
                             {"BlockIsFlags", "|--[PEAR]--{MW FLAGS #11}", "4:16 write-to-flags"},
                             {"AllWrong", "|--[PEAR]--{ADD #1 *2.0 NOWHERE}",
                              "4:17 operand-not-register, 4:20 operand-not-register, 4:25 undeclared-symbol"},
                         }),
                         titleOf);

INSTANTIATE_TEST_SUITE_P(Modifiers, MainRung,
                         ::testing::ValuesIn(std::vector<RungCase>{
                             {"EdgeWithImmediate", "|--[@!INP000.00]--(7000.00)", "4:6 edge-with-immediate"},
                             {"ImmediateWithEdge", "|--[!%INP000.00]--(7000.00)", "4:5 edge-with-immediate"},
                             {"ImmediateContact", "|--[!INP000.00]--(7000.00)", "4:5 immediate-outside-int0"},
                             {"ImmediateCoil", "|--[PEAR]--(!OUT000.00)", "4:13 immediate-outside-int0"},
                             {"ImmediateBox", "|--[PEAR]--{MOV !OUT000 #1}", "4:17 immediate-outside-int0"},
                             {"EdgeOnCoil", "|--[PEAR]--(@7000.00)", "4:14 modifier-not-allowed"},
                             {"EdgeOnSet", "|--[PEAR]--(S %7000.00)", "4:16 modifier-not-allowed"},
                             {"EdgeOnPulse", "|--[PEAR]--{DIFU @7000.00}", "4:18 modifier-not-allowed"},
                             {"EdgeOnOperand", "|--[PEAR]--{MOV 7000 @7001}", "4:22 modifier-not-allowed"},
                             {"EdgeOnWordContact", "|--[@APPLE]--(7000.00)", ""},
                             {"HandwheelInMain", "|--[PEAR]--{MOV 7000 HWMOVE}", "4:22 int0-only-signal (w)"},
                             {"FastClockInMain", "|--[N_P2MS]--(7000.00)", "4:5 int0-only-signal (w)"},
                             {"TwoEdges", "|--[@%PEAR]--(7000.00)", "4:6 modifier-not-allowed"},
                             {"EdgeTwice", "|--[/@@PEAR]--(7000.00)", "4:7 modifier-not-allowed"},
                             {"AddressErrorComesFirst", "|--[!NOWHERE]--(7000.00)", "4:6 undeclared-symbol"},
                         }),
                         titleOf);

INSTANTIATE_TEST_SUITE_P(Modifiers, Int0Rung,
                         ::testing::ValuesIn(std::vector<RungCase>{
                             {"Immediate", "|--[!INP000.00]--(!OUT000.00)", ""},
                             {"ImmediateClosed", "|--[/!INP000.00]--(S !OUT000.00)", ""},
                             {"ImmediateWord", "|--[!INP000]--(7000.00)", "4:5 immediate-not-allowed"},
                             {"ImmediateBox", "|--[!INP000.00]--{MOV 7000 !INP000}", "4:28 immediate-not-allowed"},
                             {"ImmediatePulse", "|--[!INP000.00]--{DIFU !OUT000.00}", "4:24 immediate-not-allowed"},
                             {"ImmediateUserMemory", "|--[!7000.00]--(7000.01)", "4:5 immediate-not-allowed"},
                             {"EdgeWithImmediate", "|--[@!INP000.00]--(7000.01)", "4:6 edge-with-immediate"},
                             {"FastClock", "|--[!N_P2MS]--(7000.01)", ""},
                         }),
                         titleOf);

INSTANTIATE_TEST_SUITE_P(
    Shape, MainRung,
    ::testing::ValuesIn(std::vector<RungCase>{
        {"CoilAtRail", "|--(7000.00)", "4:4 first-column-not-allowed"},
        {"BoxAtRail", "|--{MOV 7000 #1}", "4:4 first-column-not-allowed"},
        {"PinAtRail", "|--[PEAR]--{CNT 7000 #0 #1 #1}--(7001.00)\n|----------{U/D}\n|--[PEAR]--{R}",
         "5:12 first-column-not-allowed"},
        {"CompareContactAtRail", "|--{CLT 7000 #5}--(7001.00)", ""},
        {"EndBehindContact", "|--[PEAR]--{END}", "4:12 first-column-required"},
        {"LabelBehindContact", "|--[PEAR]--{JME #5}", "4:12 first-column-required, 4:12 label-unused (w)"},
        {"EndNotAlone", "|--{END}\n|--[PEAR]--(7000.00)", "4:4 first-column-required"},
        {"BehindCoil", "|--[PEAR]--(7000.00)--(7000.01)", "4:12 element-after-closing"},
        {"BehindCompare", "|--[PEAR]--{CMP 7000 #1}--(7000.01)", "4:12 element-after-closing"},
        {"BehindJump", "|--[PEAR]--{RET}--(7000.01)", "4:12 element-after-closing, 4:12 ret-outside-subroutine"},
        {"ContactEnds", "|--[PEAR]", "4:4 missing-closing-element"},
        {"TimerEnds", "|--[PEAR]--{TOND 7000 #5 #0}", "4:12 missing-closing-element"},
        {"CompareContactEnds", "|--{CLT 7000 #5}", "4:4 missing-closing-element"},
        {"WireEnds", "|--[PEAR]--", "4:10 missing-closing-element"},
        {"OutputOptional", "|--[PEAR]--{MOV 7000 #1}", ""},
        {"OutputUsed", "|--[PEAR]--{MOV 7000 #1}--(7001.00)", ""},
        {"PinMissing", "|--[PEAR]--{CNT 7000 #0 #1 #1}--(7001.00)\n|--[PEAR]--{U/D}", "4:12 missing-pin"},
        {"PinUnknown", "|--[PEAR]--{CNT 7000 #0 #1 #1}--(7001.00)\n|--[PEAR]--{U/D}\n|--[PEAR]--{X}",
         "6:12 unknown-pin"},
        {"BracesMisaligned", "|--[PEAR]---{CNT 7000 #0 #1 #1}--(7001.00)\n|--[PEAR]--{U/D}\n|--[PEAR]---{R}",
         "5:12 misaligned-box"},
        {"Section", "|--{SEC \"Spindle\"}", ""},
    }),
    titleOf);

TEST(NctDiagnostics, Symbols) {
  const Compiled c = compileMain("symbol A 7000\n"
                                 "symbol A 7001\n"        // 4
                                 "symbol N_ON 7002.00\n"  // 5: of the NC
                                 "symbol FL_ER 7002.00\n" // 6
                                 "symbol OLD 0056\n"      // 7: warning
                                 "symbol 5X 7000\n"       // 8
                                 "symbol B C\n"           // 9: circle with C
                                 "symbol C B\n"
                                 "symbol D NOWHERE,#1\n" // 11
                                 "symbol E 7000,7001\n"  // 12
                                 "const F 7000\n"        // 13
                                 "symbol G #5\n"         // 14
                                 "symbol H 756\n"        // 15
                                 "symbol SW2 N_SW,#1\n"
                                 "symbol LUB N_MSG.22\n");
  EXPECT_EQ(codesOf(c), "4:8 duplicate-symbol, 5:8 duplicate-symbol, 6:8 duplicate-symbol, 7:12 symbol-in-nc-area (w), "
                        "8:8 bad-operand, 9:10 bad-operand, 11:10 undeclared-symbol, 12:10 bad-operand, 13:9 "
                        "constant-format, 14:10 bad-operand, 15:10 address-format")
      << c.rendered();
}

TEST(NctDiagnostics, StrictModeRejectsNumbersInTheNcArea) {
  Options options;
  options.strict = true;
  EXPECT_EQ(codesOf(compileMain("symbol OLD 0056\n", options)), "3:12 symbol-in-nc-area");
}

TEST(NctDiagnostics, NcAreaBeginsBehindFlagsAndEndsAtPlcnvram) {
  EXPECT_EQ(codesOf(compileMain("symbol A 0000.00\nsymbol B 4000\nsymbol C 3999\n")), "5:10 symbol-in-nc-area (w)");
}

// Uses of a symbol whose declaration is wrong say nothing more.
TEST(NctDiagnostics, WrongSymbolIsReportedOnce) {
  const Compiled c = compileMain("symbol A 756\n\nrung\n|--[A.00]--(7000.00)\n\nrung\n|--[7000.00]--{MOV A #1}\n");
  EXPECT_EQ(codesOf(c), "3:10 address-format");
  EXPECT_EQ(codesOf(compileMain("symbol A = 7000.00\nconst B\nsymbol N_ON\n\nrung\n|--[A]--[N_ON]--{MOV 7001 B}\n")),
            "3:1 malformed-statement, 4:1 malformed-statement, 5:1 malformed-statement");
}

TEST(NctDiagnostics, Texts) {
  const Compiled c = compileMain("message 0 \"a\"\nmessage 1000 \"b\"\nmessage 20 \"c\"\nmessage 20 \"d\"\nbutton 33 "
                                 "\"e\"\nbutton 20 \"f\"\nmessage x \"g\"\n");
  EXPECT_EQ(codesOf(c), "3:9 constant-out-of-range, 4:9 constant-out-of-range, 6:9 duplicate-symbol, 7:8 "
                        "constant-out-of-range, 9:9 bad-operand");
}

// --- outputs
// --------------------------------------------------------------------------------------------------------------
std::string rungs(std::initializer_list<const char*> drawings) {
  std::string text;
  for (const char* drawing : drawings) text += std::string("rung\n") + drawing + "\n\n";
  return text;
}

TEST(NctDiagnostics, OutputOnce) {
  // Drawings are lines 4, 7, 10, …
  const Compiled c = compileMain(rungs({"|--[7000.00]--(7001.00)", "|--[7000.01]--(/7001.00)",
                                        "|--[7000.01]--{DIFU 7001.00}", "|--[7000.01]--{TOND 7002 #5 #0}--(7001.01)",
                                        "|--[7000.01]--{TPULSE 7002 #5 #0}--(7001.02)", "|--[7000.01]--(7001.01,#0)"}));
  EXPECT_EQ(codesOf(c),
            "7:17 duplicate-output, 10:21 duplicate-output, 16:23 duplicate-output, 19:16 duplicate-output");
}

TEST(NctDiagnostics, OutputOnceHoldsOverBothModules) {
  const Compiled c = compileFile(
      "dialect nct\nmodule MAIN\nrung\n|--[7000.00]--(OUT000.01)\n\nmodule INT0\nrung\n|--[7000.00]--(!OUT000.01)\n");
  EXPECT_EQ(codesOf(c), "8:16 duplicate-output");
}

TEST(NctDiagnostics, SetResetAndComputedAddressesAreExempt) {
  const Compiled c =
      compileMain(rungs({"|--[7000.00]--(S 7001.00)", "|--[7000.01]--(S 7001.00)", "|--[7000.02]--(R 7001.00)",
                         "|--[7000.00]--(7002.00,7003)", "|--[7000.01]--(7002.00,7003)", "|--[7000.02]--{MOV 7004 #1}",
                         "|--[7000.03]--{MOV 7004 #2}"}));
  EXPECT_EQ(codesOf(c), "");
}

TEST(NctDiagnostics, MixedOutput) {
  const Compiled c =
      compileMain(rungs({"|--[7000.00]--(S 7001.00)", "|--[7000.01]--(7001.00)", "|--[7000.02]--(R 7001.00)"}));
  EXPECT_EQ(codesOf(c), "7:16 mixed-output (w)");
}

// --- structure
// --------------------------------------------------------------------------------------------------------------
TEST(NctDiagnostics, Labels) {
  const Compiled c = compileMain(rungs({
      "|--[7000.00]--{JMP #5}",   // 4: undefined
      "|--[7000.00]--{JMP #100}", // 7
      "|--[7000.00]--{JMP #-1}",  // 10
      "|--[7000.00]--{JMP 7}",    // 13: fine, below
      "|--{JME #7}",              // 16
      "|--[7000.00]--{JMP #7}",   // 19: backwards
  }));
  // A label out of range might have been any, so nothing is said about 5.
  EXPECT_EQ(codesOf(c), "7:20 label-out-of-range, 10:20 label-out-of-range");
  const Compiled d = compileMain(rungs({"|--[7000.00]--{JMP #5}", "|--[7000.00]--{JMP 7}", "|--{JME #7}",
                                        "|--[7000.00]--{JMP #7}", "|--{JME #7}", "|--{JME #8}"}));
  EXPECT_EQ(codesOf(d), "4:15 undefined-label, 13:15 backward-jump (w), 16:4 duplicate-label, 19:4 label-unused (w)");
}

TEST(NctDiagnostics, Subroutines) {
  const Compiled c = compileMain(rungs({
      "|--[7000.00]--{SBS #1}",  // 4
      "|--[7000.00]--{SBS #9}",  // 7: undefined
      "|--[7000.00]--{RET}",     // 10: outside
      "|--{END}",                // 13
      "|--[7000.00]--(7001.00)", // 16: code after END
      "|--[7000.00]--(7001.01)", // 19: not once more
      "|--{SBN #1}",             // 22
      "|--[7000.00]--{RET}",     // 25
      "|--{SBN #1}",             // 28: duplicate, and without RET
      "|--{SBN #2}",             // 31: unused
      "|--[7000.00]--{RET}",     // 34
      "|--{END}",                // 37: twice
  }));
  EXPECT_EQ(codesOf(c), "7:15 undefined-subroutine, 10:15 ret-outside-subroutine, 15:1 code-after-end, 28:4 "
                        "duplicate-subroutine, 28:4 missing-ret, 31:4 subroutine-unused (w), 37:4 duplicate-end");
}

TEST(NctDiagnostics, SubroutineBeforeEnd) {
  const Compiled c = compileMain(rungs({"|--[7000.00]--{SBS #1}", "|--{SBN #1}", "|--[7000.00]--{RET}"}));
  EXPECT_EQ(codesOf(c), "7:4 subroutine-before-end");
}

TEST(NctDiagnostics, OneSetOfNumbers) {
  const Compiled c = compileMain(rungs({"|--[7000.00]--{JMP #1}", "|--{JME #1}", "|--[7000.00]--{SBS #1}", "|--{END}",
                                        "|--{SBN #1}", "|--[7000.00]--{RET}"}));
  EXPECT_EQ(codesOf(c), "10:15 label-conflict");
}

TEST(NctDiagnostics, NumbersBelongToTheirModule) {
  const Compiled c =
      compileFile("dialect nct\nmodule MAIN\n" + rungs({"|--[7000.00]--{JMP #1}", "|--{JME #1}"}) + "module INT0\n" +
                  rungs({"|--[7000.00]--{SBS #1}", "|--{END}", "|--{SBN #1}", "|--[7000.00]--{RET}"}));
  EXPECT_EQ(codesOf(c), "");
  EXPECT_EQ(codesOf(compileFile("dialect nct\nmodule MAIN\n" + rungs({"|--[7000.00]--{JMP #1}"}) + "module INT0\n" +
                                rungs({"|--{JME #1}"}))),
            "4:15 undefined-label, 8:4 label-unused (w)");
}

TEST(NctDiagnostics, JumpAcrossSubroutine) {
  const Compiled c = compileMain(rungs({"|--[7000.00]--{JMP #1}", "|--[7000.00]--{SBS #2}", "|--{END}", "|--{SBN #2}",
                                        "|--{JME #1}", "|--[7000.00]--{RET}"}));
  EXPECT_EQ(codesOf(c), "4:15 jump-across-subroutine");
}

TEST(NctDiagnostics, Recursion) {
  const Compiled c = compileMain(
      rungs({"|--[7000.00]--{SBS #1}", "|--{END}", "|--{SBN #1}", "|--[7000.00]--{SBS #2}", "|--[7000.00]--{RET}",
             "|--{SBN #2}", "|--[7000.00]--{SBS #1}", "|--[7000.01]--{SBS #2}", "|--[7000.00]--{RET}"}));
  EXPECT_EQ(codesOf(c), "22:15 recursive-call, 25:15 recursive-call");
  EXPECT_NE(c.rendered().find("subroutine 1 calls itself through 2"), std::string::npos) << c.rendered();
}

TEST(NctDiagnostics, Modules) {
  EXPECT_EQ(codesOf(compileFile("dialect nct\nmodule INT0\n")), "1:9 missing-main");
  EXPECT_EQ(codesOf(compileFile("dialect nct\nmodule MIAN\n")), "2:8 unknown-module");
  EXPECT_EQ(codesOf(compileFile("dialect nct\nmodule SUB P1\nmodule MAIN\n")), "2:8 unknown-module");
  EXPECT_EQ(codesOf(compileFile("dialect nct\nmodule MAIN\nmodule MAIN\n")), "3:1 duplicate-module");
  EXPECT_EQ(codesOf(compileFile("dialect nct\nrung\n|--[7000.00]--(7000.01)\n")), "2:1 rung-outside-module");
  EXPECT_EQ(codesOf(compileFile("dialect gsk\nmodule MAIN\n")), "1:9 dialect-conflict");
}

// A rung that could not be read might have held what others refer to.
TEST(NctDiagnostics, BrokenRungCausesNoFurtherErrors) {
  const Compiled c =
      compileMain(rungs({"|--[7000.00]--{JMP #1}", "|--{JME #1", "|--[NOWHERE]--{JMP #1}", "|--[7000.00]--{SBS #3}"}));
  EXPECT_EQ(codesOf(c), "7:4 unclosed-element, 10:5 undeclared-symbol");
}

// Only one that might have held an END, a label or the like hides what others refer to.
TEST(NctDiagnostics, OtherBrokenRungsHideNothing) {
  const Compiled c =
      compileMain(rungs({"|--[7000.00]--{JMP #1}", "|--[7000.00", "|--[7000.00]--{FOO 7001}", "|--[7000.00]--{MOV}"}));
  EXPECT_EQ(codesOf(c), "4:15 undefined-label, 7:4 unclosed-element, 10:16 unknown-instruction, 13:16 operand-count");
  EXPECT_EQ(codesOf(compileMain(rungs({"|--[7000.00]--{JMP #1}", "|--{JNE #1}"}))), "7:5 unknown-instruction");
}

// What a symbol is called says nothing of what a broken rung has.
TEST(NctDiagnostics, NamesInABrokenRungHideNothing) {
  const char* text = "|--[7000.00]--{JMP #1}";
  EXPECT_EQ(codesOf(compileMain(rungs({text, "|--[T_END]--{TOND JMP_TIME #1 SEC"}))),
            "4:15 undefined-label, 7:5 undeclared-symbol, 7:13 unclosed-element");
  EXPECT_EQ(codesOf(compileMain(rungs({text, "|--[7000.00]--{JME #1"}))), "7:15 unclosed-element");
}

// What can be read of it is checked, where no net is asked for.
TEST(NctDiagnostics, ABrokenRungIsCheckedAllTheSame) {
  EXPECT_EQ(codesOf(compileMain(rungs({"|--[NOWHERE]--{MOV 7000 *5.5}--{TOND 7001"}))),
            "4:5 undeclared-symbol, 4:25 operand-type-mismatch, 4:32 unclosed-element");
  EXPECT_EQ(codesOf(compileMain(rungs({"|--[7000.00]--{FOO 7001}---"}))),
            "4:16 unknown-instruction, 4:25 missing-closing-element");
  // Its labels are there, and so is what it jumps to.
  EXPECT_EQ(codesOf(compileMain(rungs({"|--[7000.00]--{JMP #1}", "|--{JME #1}--[7000.00]--"}))),
            "7:23 missing-closing-element");
  // A box of one word may be a pin of one that was not read.
  EXPECT_EQ(codesOf(compileMain(rungs({"|--[7000.00]--{CNT 7310 #0 #1 #10\n|--[7000.01]--{R  }"}))),
            "4:15 unclosed-element");
}

// A subroutine in front of END leaves open where bodies begin and end.
TEST(NctDiagnostics, MisplacedSubroutineCausesNoFurtherErrors) {
  const Compiled c =
      compileMain(rungs({"|--[7000.00]--{JMP #5}", "|--{SBN #1}", "|--[@7000.00]--{SBS #1}", "|--[7000.00]--{RET}",
                         "|--{JME #5}", "|--[7000.00]--{SBS #1}", "|--{END}", "|--{SBN #2}", "|--[7000.00]--{RET}"}));
  EXPECT_EQ(codesOf(c), "7:4 subroutine-before-end");
}

// What follows an END that must not stand where it does is no code behind END.
TEST(NctDiagnostics, MisplacedEndCausesNoFurtherErrors) {
  const Compiled c = compileMain(rungs({"|--[7000.00]--{END}", "|--[7000.00]--(7000.01)", "|--[7000.00]--{SBS #1}",
                                        "|--{SBN #1}", "|--[7000.00]--{RET}"}));
  EXPECT_EQ(codesOf(c), "4:15 first-column-required");
}

// Rungs of a module that is reported are looked at, but their labels belong to nobody.
TEST(NctDiagnostics, RungsOfWrongModulesAreChecked) {
  EXPECT_EQ(codesOf(compileFile("dialect nct\nmodule MIAN\nrung\n|--[NOWHERE]--{JMP #1}\n")),
            "2:8 unknown-module, 4:5 undeclared-symbol");
  EXPECT_EQ(
      codesOf(compileFile("dialect nct\nmodule MAIN\nrung\n|--[N_ON]--{JMP #1}\n\nmodule MAIN\nrung\n|--{JME #1}\n")),
      "6:1 duplicate-module");
}

TEST(NctDiagnostics, Suggestions) {
  const auto note = [](const char* drawing) {
    return compileMain(std::string("symbol SPEED 7001\nrung\n") + drawing + "\n").rendered();
  };
  EXPECT_NE(note("|--[N_ON]--{MOV SPEDE #1}").find("did you mean SPEED?"), std::string::npos);
  EXPECT_NE(note("|--[N_ON]--{MOV speed #1}").find("did you mean SPEED?"), std::string::npos);
  EXPECT_NE(note("|--[N_ONN]--{MOV SPEED #1}").find("did you mean N_ON?"), std::string::npos);
  EXPECT_NE(note("|--[AN_PLAC]--{MOV SPEED #1}").find("did you mean AN_PLCA?"), std::string::npos);
  EXPECT_NE(note("|--[N_ON]--{MOVE SPEED #1}").find("in this language: MOV, whose result comes first"),
            std::string::npos);
  EXPECT_NE(note("|--[N_ON]--{mov SPEED #1}").find("did you mean MOV?"), std::string::npos);
  EXPECT_EQ(note("|--[XYZZY]--{PLUGH SPEED #1}").find("did you mean"), std::string::npos);
}

// Slips of the hand, and what they are answered with.
TEST(NctDiagnostics, HintsHowToMend) {
  struct Slip {
    const char* text;
    const char* hint;
  };
  const Slip slips[] = {{"rung\n|--[700.00]--(7001.00)", "0700"},
                        {"rung\n|--[N_ON]--{MOV 7000 5}", "a constant #5"},
                        {"rung\n|--[N_ON]--{MOV 7000 12345}", "a constant is written #12345"},
                        {"rung\n|--[N_ON]--(7001.5)", "write .05"},
                        {"rung\n|--[7000.00@]--(7001.00)", "'@' is written before the operand"},
                        {"rung\n|--[N_ON]--{MOV 7000, #5}", "without commas"},
                        {"rung\n|--[N_ON]--(S7001.00)", "(S 7001.00)"},
                        {"rung\n|--[N_ON]--(RLAMP)", "(R LAMP)"},
                        {"rung\n|--[!7000.00]--(7001.00)", "a closed contact is written [/x]"},
                        {"rung\n|--[N_ON]--{MOVF 7000 *3,5}", "*3.5"},
                        {"rung\n|--[N_ON]--{MOVF 7000 *5}", "write *5.0"},
                        {"rung\n|--[N_ON]--{MOV 7000 #5.5}", "a real number is written *5.5"},
                        {"rung\n |--[N_ON]--(7001.00)", "put the rail into the first column"},
                        {"module MIAN", "did you mean MAIN?"},
                        {"rung\n\n|--[N_ON]--(7001.00)", "without a blank line between"},
                        {"const LIMIT 10", "a constant is written #10"},
                        {"rung\n|--[N_ON]--(INP000.00)", "stays until the NC writes it again"},
                        {"rung \u201cx\u201d", "write '\"'"},
                        {"rung\n|\u2013[N_ON]--(7001.00)", "write '-'"},
                        {"// text", "a comment begins with ';'"},
                        {"RUNG", "did you mean rung?"},
                        {"rung\n|--[N_ON]--+--(7001.00)\n\n              +--(7001.01)", "this rung's drawing ended"}};
  for (const Slip& slip : slips) {
    const std::string text = compileMain(std::string("symbol LAMP 7001.09\n") + slip.text + "\n").rendered();
    EXPECT_NE(text.find(slip.hint), std::string::npos) << slip.text << '\n' << text;
  }
}

TEST(NctDiagnostics, Configuration) {
  Options options;
  options.config = {{"PLCNVRAM", "100"}, {"PLCRAM", "x"}, {"timeslice", "2 apples"}};
  EXPECT_THAT(
      compileMain("", options).codes(),
      ::testing::UnorderedElementsAre("0:0 constant-out-of-range", "0:0 constant-out-of-range", "0:0 config-value"));
  options.config = {{"timeslice", "7"}};
  EXPECT_THAT(compileMain("", options).rendered(),
              ::testing::HasSubstr("expected a duration with its unit such as 2ms"));
}

} // namespace
} // namespace rung::frontend::nct::test
