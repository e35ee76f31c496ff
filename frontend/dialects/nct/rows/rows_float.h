// Rows: floating point, conversions, comparisons (man. §6.10-§6.12). Included by instructions.cpp only.
#pragma once
#include "frontend/dialects/nct/rows/rows_word.h"

namespace rung::frontend::nct {

constexpr Row floatBinaryShape(std::string_view first, std::string_view second, LowerFn lower) {
  return {.info = {.group = "float",
                   .pins = {kEnable},
                   .operands = {O{"Result", &kinds::kDouble, Access::Write, "where the result goes"},
                                O{first, &kinds::kFloat, Access::Read, "constant or register"},
                                O{second, &kinds::kFloat, Access::Read, "constant or register"}},
                   .output = Output::Optional},
          .lower = lower};
}

inline constexpr Row kFloatShape = convertShape("float", kinds::kDouble, kinds::kFloat, lowerFloatFunction);

constexpr Row compareShape(const OperandKind& valueKind, const OperandKind& dataKind, LowerFn lower) {
  return {.info = {.group = "compare",
                   .pins = {kEnable},
                   .operands = {O{"Value", &valueKind, Access::Read, "left side, a register"},
                                O{"Data", &dataKind, Access::Read, "right side"}},
                   .output = Output::None},
          .lower = lower};
}

constexpr Row compareContactShape(const OperandKind& valueKind, const OperandKind& dataKind, LowerFn lower) {
  return {.info = {.group = "compare-contact",
                   .pins = {P{"IN", "power from the left"}},
                   .operands = {O{"Value", &valueKind, Access::Read, "left side, a register"},
                                O{"Data", &dataKind, Access::Read, "right side"}},
                   .output = Output::Always,
                   .placement = Placement::Anywhere},
          .lower = lower};
}
inline constexpr Row kIntContact = compareContactShape(kinds::kWord, kinds::kInteger, lowerCompareContact);
inline constexpr Row kFloatContact = compareContactShape(kinds::kDouble, kinds::kFloat, lowerFloatContact);

inline constexpr Row kFloatRows[] = {
    rowOf(floatBinaryShape("1st Operand", "2nd Operand", lowerFloatArithmetic), "+F", "floating-point addition",
          "6.10.1, l.2161", "Result := 1st + 2nd.", "|--[N_ON]--{+F 7000 7002 *1.5}", kAdd),
    rowOf(floatBinaryShape("1st Operand", "2nd Operand", lowerFloatArithmetic), "-F", "floating-point subtraction",
          "6.10.2, l.2179", "Result := 1st - 2nd.", "|--[N_ON]--{-F 7000 7002 *1.5}", kSubtract),
    rowOf(floatBinaryShape("1st Operand", "2nd Operand", lowerFloatArithmetic), "*F", "floating-point multiplication",
          "6.10.3, l.2197", "Result := 1st * 2nd.", "|--[N_ON]--{*F 7000 7002 *1.5}", kMultiply),
    rowOf(floatBinaryShape("1st Operand", "2nd Operand", lowerFloatArithmetic), "/F", "floating-point division",
          "6.10.4, l.2215", "Result := 1st / 2nd. By 0: FL_ER, not executed.", "|--[N_ON]--{/F 7000 7002 *1.5}",
          kDivide),
    rowOf(floatBinaryShape("Base", "Exponent", lowerFloatFunction), "PWR", "power", "6.10.5, l.2233",
          "Result := Base to the power of Exponent; anything to the power of 0 is 1. A negative base, or 0 "
          "to a negative exponent: FL_ER, not executed.",
          "|--[N_ON]--{PWR 7000 7002 *2.0}", kPower),
    rowOf(kFloatShape, "SQRT", "square root", "6.10.6, l.2257", "Result := square root. Negative: FL_ER, not executed.",
          "|--[N_ON]--{SQRT 7000 7002}", kSquareRoot),
    rowOf(kFloatShape, "SIN", "sine", "6.10.7, l.2273", "Result := sine of the operand in radians.",
          "|--[N_ON]--{SIN 7000 7002}", kSine),
    rowOf(kFloatShape, "COS", "cosine", "6.10.8, l.2285", "Result := cosine of the operand in radians.",
          "|--[N_ON]--{COS 7000 7002}", kCosine),
    rowOf(kFloatShape, "TAN", "tangent", "6.10.9, l.2297",
          "Result := tangent of the operand in radians. Where an odd multiple of pi/2 is at most the distance of "
          "two neighbouring doubles away: FL_ER, not executed.",
          "|--[N_ON]--{TAN 7000 7002}", kTangent),
    rowOf(kFloatShape, "ASIN", "arc sine", "6.10.10, l.2315",
          "Result := arc sine in radians. Outside -1 to 1: FL_ER, not executed.", "|--[N_ON]--{ASIN 7000 7002}",
          kArcSine),
    rowOf(kFloatShape, "ACOS", "arc cosine", "6.10.11, l.2335",
          "Result := arc cosine in radians. Outside -1 to 1: FL_ER, not executed.", "|--[N_ON]--{ACOS 7000 7002}",
          kArcCosine),
    rowOf(kFloatShape, "ATAN", "arc tangent", "6.10.12, l.2356", "Result := arc tangent in radians.",
          "|--[N_ON]--{ATAN 7000 7002}", kArcTangent),
    rowOf(kFloatShape, "EXP", "natural exponential", "6.10.13, l.2371", "Result := e to the power of the operand.",
          "|--[N_ON]--{EXP 7000 7002}", kExponential),
    rowOf(kFloatShape, "LOG", "natural logarithm", "6.10.14, l.2385",
          "Result := natural logarithm. Of 0 or less: FL_ER, not executed.", "|--[N_ON]--{LOG 7000 7002}", kLogarithm),

    rowOf(convertShape("conversion", kinds::kWord, kinds::kHex, lowerBin), "BIN", "BCD to binary", "6.11.1, l.2449",
          "Eight BCD digits become an integer. A digit above 9: FL_ER, not executed.", "|--[N_ON]--{BIN 7000 #$1234}"),
    rowOf(convertShape("conversion", kinds::kWord, kinds::kInteger, lowerBcd), "BCD", "binary to BCD", "6.11.2, l.2464",
          "An integer of 0 to 99999999 becomes eight BCD digits. Others: FL_ER, not executed.",
          "|--[N_ON]--{BCD 7000 7001}"),
    rowOf(convertShape("conversion", kinds::kDouble, kinds::kInteger, lowerFlt), "FLT", "integer to double",
          "6.11.3, l.2475", "Result := the signed integer as a double.", "|--[N_ON]--{FLT 7000 7002}"),
    rowOf(convertShape("conversion", kinds::kWord, kinds::kFloat, lowerFix), "FIX", "double to integer",
          "6.11.4, l.2494", "Result := the double, rounded toward zero. Outside 32 bits: FL_ER, not executed.",
          "|--[N_ON]--{FIX 7000 7002}"),
    rowOf(convertShape("conversion", kinds::kDouble, kinds::kFloat, lowerAngle), "DEG", "radians to degrees",
          "6.11.5, l.2519", "Result := operand * 180 / pi.", "|--[N_ON]--{DEG 7000 7002}", kToDegrees),
    rowOf(convertShape("conversion", kinds::kDouble, kinds::kFloat, lowerAngle), "RAD", "degrees to radians",
          "6.11.6, l.2534", "Result := operand * pi / 180.", "|--[N_ON]--{RAD 7000 7002}", kToRadians),

    rowOf(compareShape(kinds::kWord, kinds::kInteger, lowerCompare), "CMP", "compare two integers", "6.12.1, l.2553",
          "Sets exactly one of FL_GT, FL_EQ and FL_LT; they keep their values until the next CMP or FCMP.",
          "|--[N_ON]--{CMP 7000 #5}"),
    rowOf(compareShape(kinds::kDouble, kinds::kFloat, lowerFloatCompare), "FCMP", "compare two doubles",
          "6.12.1, l.2553", "Sets exactly one of FL_GT, FL_EQ and FL_LT. With a NaN: none of them, and FL_ER.",
          "|--[N_ON]--{FCMP 7000 *5.0}"),

    rowOf(kIntContact, "CLT", "contact a < b", "6.12.2, l.2613", "Power passes when Value < Data, signed.",
          "|--{CLT 7000 #5}--(7001.00)", kLess),
    rowOf(kIntContact, "CLE", "contact a <= b", "6.12.2, l.2614", "Power passes when Value <= Data, signed.",
          "|--{CLE 7000 #5}--(7001.00)", kLessEqual),
    rowOf(kIntContact, "CEQ", "contact a = b", "6.12.2, l.2615", "Power passes when Value = Data.",
          "|--{CEQ 7000 #5}--(7001.00)", kEqual),
    rowOf(kIntContact, "CNE", "contact a <> b", "6.12.2, l.2616", "Power passes when Value differs from Data.",
          "|--{CNE 7000 #5}--(7001.00)", kNotEqual),
    rowOf(kIntContact, "CGE", "contact a >= b", "6.12.2, l.2617", "Power passes when Value >= Data, signed.",
          "|--{CGE 7000 #5}--(7001.00)", kGreaterEqual),
    rowOf(kIntContact, "CGT", "contact a > b", "6.12.2, l.2618", "Power passes when Value > Data, signed.",
          "|--{CGT 7000 #5}--(7001.00)", kGreater),
    rowOf(kFloatContact, "FLLT", "contact a < b, doubles", "6.12.2, l.2622",
          "Power passes when Value < Data. A NaN: FL_ER, no power.", "|--{FLLT 7000 *5.0}--(7002.00)", kLess),
    rowOf(kFloatContact, "FLLE", "contact a <= b, doubles", "6.12.2, l.2623",
          "Power passes when Value <= Data. A NaN: FL_ER, no power.", "|--{FLLE 7000 *5.0}--(7002.00)", kLessEqual),
    rowOf(kFloatContact, "FLEQ", "contact a = b, doubles", "6.12.2, l.2624",
          "Power passes when Value = Data. A NaN: FL_ER, no power.", "|--{FLEQ 7000 *5.0}--(7002.00)", kEqual),
    rowOf(kFloatContact, "FLNE", "contact a <> b, doubles", "6.12.2, l.2625",
          "Power passes when Value differs from Data. A NaN: FL_ER, no power.", "|--{FLNE 7000 *5.0}--(7002.00)",
          kNotEqual),
    rowOf(kFloatContact, "FLGE", "contact a >= b, doubles", "6.12.2, l.2626",
          "Power passes when Value >= Data. A NaN: FL_ER, no power.", "|--{FLGE 7000 *5.0}--(7002.00)", kGreaterEqual),
    rowOf(kFloatContact, "FLGT", "contact a > b, doubles", "6.12.2, l.2627",
          "Power passes when Value > Data. A NaN: FL_ER, no power.", "|--{FLGT 7000 *5.0}--(7002.00)", kGreater),
};

} // namespace rung::frontend::nct
