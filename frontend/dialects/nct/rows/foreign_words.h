// Boxes of IEC 61131, FANUC, Mitsubishi and Rockwell ladders, and what NCT has for them. Included by instructions.cpp
// only.
#pragma once
#include "frontend/sema/foreign_word.h"

namespace rung::nct {

inline constexpr std::string_view kUseAdd = "ADD, whose result comes first";
inline constexpr std::string_view kUseSub = "SUB, whose result comes first";
inline constexpr std::string_view kUseMul = "MUL, whose result comes first";
inline constexpr std::string_view kUseDiv = "DIV, whose result comes first";
inline constexpr std::string_view kUseAddDoubles = "+F, whose result comes first; a constant is written *0.5";
inline constexpr std::string_view kUseSubDoubles = "-F, whose result comes first; a constant is written *0.5";
inline constexpr std::string_view kUseMulDoubles = "*F, whose result comes first; a constant is written *0.5";
inline constexpr std::string_view kUseDivDoubles = "/F, whose result comes first; a constant is written *0.5";
inline constexpr std::string_view kUseMove =
    "MOV, whose result comes first; MOVF for doubles, whose constants are written *0.5";
inline constexpr std::string_view kUseCompare =
    "CMP, which sets FL_GT, FL_EQ and FL_LT, or a comparing contact such as CEQ";
inline constexpr std::string_view kUseMessage = "MSG, and `message NUMBER \"text\"` for its text";

inline constexpr frontend::ForeignWord kForeignWords[] = {
    // the same with the same operands
    {"CAL", "SBS", true},
    {"CALL", "SBS", true},
    {"EQ", "CEQ", true},
    {"GE", "CGE", true},
    {"GT", "CGT", true},
    {"JSR", "SBS", true},
    {"LBL", "JME", true},
    {"LE", "CLE", true},
    {"LT", "CLT", true},
    {"NE", "CNE", true},
    {"PLF", "DIFD", true},
    {"PLS", "DIFU", true},
    {"SPE", "RET", true},
    {"SRET", "RET", true},
    {"TOF", "TOFFD", true},
    {"TON", "TOND", true},
    // said otherwise here
    {"ADDB", kUseAdd},
    {"ADDF", kUseAddDoubles},
    {"ADDP", "ADD after a contact [@x]; its result comes first"},
    {"CMPF", "FCMP, which sets FL_GT, FL_EQ and FL_LT, or a comparing contact such as FLEQ"},
    {"COIN", "a comparing contact, CEQ"},
    {"COMP", kUseCompare},
    {"COMPB", kUseCompare},
    {"CTD", "CNT, whose pin U/D is on to count down"},
    {"CTR", "CNT, or the ring counter CNTR"},
    {"CTU", "CNT, whose pin U/D is off to count up"},
    {"CTUD", "CNT, whose pin U/D says where it counts"},
    {"DADD", kUseAdd},
    {"DDIV", kUseDiv},
    {"DEC", "SUB x x #1"},
    {"DECB", "comparing contacts such as CEQ, and coils"},
    {"DECP", "SUB x x #1 after a contact [@y]"},
    {"DISP", kUseMessage},
    {"DISPB", kUseMessage},
    {"DIVB", kUseDiv},
    {"DIVF", kUseDivDoubles},
    {"DMOV", kUseMove},
    {"DMUL", kUseMul},
    {"DSUB", kUseSub},
    {"EADD", kUseAddDoubles},
    {"EDIV", kUseDivDoubles},
    {"EMOV", "MOVF, whose result comes first: {MOVF x *0.5}"},
    {"EMUL", kUseMulDoubles},
    {"ESUB", kUseSubDoubles},
    {"F_TRIG", "a contact [%x], or DIFD"},
    {"INC", "ADD x x #1"},
    {"INCP", "ADD x x #1 after a contact [@y]"},
    {"INT_TO_REAL", "FLT, whose result comes first"},
    {"MOVB", kUseMove},
    {"MOVD", kUseMove},
    {"MOVE", kUseMove},
    {"MOVN", "MOV once for each word; the result comes first"},
    {"MOVP", "MOV after a contact [@x]; its result comes first"},
    {"MOVW", kUseMove},
    {"MULB", kUseMul},
    {"MULF", kUseMulDoubles},
    {"NOT", "MVN, which moves the inverted bits; a closed contact is [/x]"},
    {"NUMEB", "MOV with a constant: {MOV x #5}"},
    {"R_TRIG", "a contact [@x], or DIFU"},
    {"REAL_TO_INT", "FIX, whose result comes first"},
    {"ROTB", "ROT"},
    {"RS", "two coils, (S x) and (R x)"},
    {"SP", "SBN with a number from #0 to #99"},
    {"SR", "two coils, (S x) and (R x)"},
    {"SUBB", kUseSub},
    {"SUBF", kUseSubDoubles},
    {"SUBP", "SUB after a contact [@x]; its result comes first"},
    {"TMR", "TOND, an on-delay timer"},
    {"TMRB", "TOND, an on-delay timer"},
    {"TP", "TPULSE, whose pulse ends when its condition does"},
    {"TRUNC", "FIX, whose result comes first"},
    {"WAND", "AND, whose result comes first"},
    {"WOR", "OR, whose result comes first"},
    {"WXOR", "XOR, whose result comes first"},
};

} // namespace rung::nct
