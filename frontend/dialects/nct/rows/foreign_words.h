// Boxes of IEC 61131, FANUC, Mitsubishi and Rockwell ladders, and their equivalents in NCT. Included by
// instructions.cpp only.
#pragma once
#include "frontend/sema/foreign_word.h"

namespace rung::frontend::nct {

inline constexpr std::string_view kUseAdd = "ADD, whose result comes first";
inline constexpr std::string_view kUseSub = "SUB, whose result comes first";
inline constexpr std::string_view kUseMul = "MUL, whose result comes first";
inline constexpr std::string_view kUseDiv = "DIV, whose result comes first";
inline constexpr std::string_view kUseAddDoubles = "+F, whose result comes first; a constant is written *0.5";
inline constexpr std::string_view kUseSubDoubles = "-F, whose result comes first; a constant is written *0.5";
inline constexpr std::string_view kUseMulDoubles = "*F, whose result comes first; a constant is written *0.5";
inline constexpr std::string_view kUseDivDoubles = "/F, whose result comes first; a constant is written *0.5";
inline constexpr std::string_view kUseAddEither = "ADD, whose result comes first; +F for doubles";
inline constexpr std::string_view kUseSubEither = "SUB, whose result comes first; -F for doubles";
inline constexpr std::string_view kUseMulEither = "MUL, whose result comes first; *F for doubles";
inline constexpr std::string_view kUseDivEither = "DIV, whose result comes first; /F for doubles";
inline constexpr std::string_view kUseMoveDouble = "MOVF, whose result comes first: {MOVF x *0.5}";
inline constexpr std::string_view kUseSign = "CLT x #0, then SUB x #0 x; for doubles FLLT x *0.0, then -F x *0.0 x";
inline constexpr std::string_view kUseShiftLeft = "ASHL for a run of words; SHTR shifts one word by one bit";
inline constexpr std::string_view kUseShiftRight = "ASHR for a run of words; SHTR shifts one word by one bit";
inline constexpr std::string_view kUseRotateLeft = "ARTL for a run of words; ROT finds the way of a turret";
inline constexpr std::string_view kUseRotateRight = "ARTR for a run of words; ROT finds the way of a turret";
inline constexpr std::string_view kUseMove =
    "MOV, whose result comes first; MOVF for doubles, whose constants are written *0.5";
inline constexpr std::string_view kUseCompare =
    "CMP, which sets FL_GT, FL_EQ and FL_LT, or a comparing contact such as CEQ";
inline constexpr std::string_view kUseMessage = "MSG, and `message NUMBER \"text\"` for its text";

inline constexpr frontend::ForeignWord kForeignWords[] = {
    // equivalent, with the same operands
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
    // expressed differently here
    {"ABS", kUseSign},
    {"ADDB", kUseAdd},
    {"ADDD", kUseAddEither},
    {"ADDF", kUseAddDoubles},
    {"ADDP", "ADD after a contact [@x]; its result comes first"},
    {"CEQD", "CEQ; for doubles FLEQ"},
    {"CEQF", "FLEQ, whose constants are written *0.5"},
    {"CGED", "CGE; for doubles FLGE"},
    {"CGEF", "FLGE, whose constants are written *0.5"},
    {"CGTD", "CGT; for doubles FLGT"},
    {"CGTF", "FLGT, whose constants are written *0.5"},
    {"CLED", "CLE; for doubles FLLE"},
    {"CLEF", "FLLE, whose constants are written *0.5"},
    {"CLTD", "CLT; for doubles FLLT"},
    {"CLTF", "FLLT, whose constants are written *0.5"},
    {"CMPF", "FCMP, which sets FL_GT, FL_EQ and FL_LT, or a comparing contact such as FLEQ"},
    {"CNED", "CNE; for doubles FLNE"},
    {"CNEF", "FLNE, whose constants are written *0.5"},
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
    {"DIVD", kUseDivEither},
    {"DIVF", kUseDivDoubles},
    {"DMOV", kUseMove},
    {"DMUL", kUseMul},
    {"DSUB", kUseSub},
    {"EADD", kUseAddDoubles},
    {"EDIV", kUseDivDoubles},
    {"EMOV", kUseMoveDouble},
    {"EMUL", kUseMulDoubles},
    {"ESUB", kUseSubDoubles},
    {"FADD", kUseAddDoubles},
    {"FDIV", kUseDivDoubles},
    {"FMOV", "MOV once for each word; MOVF for a double; the result comes first"},
    {"FMUL", kUseMulDoubles},
    {"FSUB", kUseSubDoubles},
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
    {"MULD", kUseMulEither},
    {"MULF", kUseMulDoubles},
    {"MVF", kUseMoveDouble},
    {"NOT", "MVN, which moves the inverted bits; a closed contact is [/x]"},
    {"NUMEB", "MOV with a constant: {MOV x #5}"},
    {"REAL_TO_INT", "FIX, whose result comes first"},
    {"ROL", kUseRotateLeft},
    {"ROR", kUseRotateRight},
    {"ROTB", "ROT"},
    {"RS", "two coils, (S x) and (R x)"},
    {"R_TRIG", "a contact [@x], or DIFU"},
    {"SHL", kUseShiftLeft},
    {"SHR", kUseShiftRight},
    {"SP", "SBN with a number from #0 to #99"},
    {"SR", "two coils, (S x) and (R x)"},
    {"SUBB", kUseSub},
    {"SUBD", kUseSubEither},
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

} // namespace rung::frontend::nct
