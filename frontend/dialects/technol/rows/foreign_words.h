// Words of the 80386's assembler, of IEC 61131 instruction lists, of FANUC, Siemens and Mitsubishi programs, and their
// equivalents in TECHNOL (man. ch. 3). Included by instructions.cpp only.
#pragma once
#include "frontend/sema/foreign_word.h"

namespace rung::frontend::technol {

inline constexpr std::string_view kBegins = "LDR where an equation begins, LA after it";
inline constexpr std::string_view kBeginsInverted = "LDR -X where an equation begins, LA -X after it";
inline constexpr std::string_view kStores = "LDR, which stores RLO while an equation is open";
inline constexpr std::string_view kStoresInverted = "LDR -X, which stores RLO while an equation is open";
inline constexpr std::string_view kWritesInverted = "CA, which inverts RLO, then WR";
inline constexpr std::string_view kRising = "EDGE_H where an equation begins";
inline constexpr std::string_view kFalling = "EDGE_L where an equation begins";
inline constexpr std::string_view kRisingBefore =
    "EDGE_H and WR of a bit of its own before the equation, which reads it";
inline constexpr std::string_view kFallingBefore =
    "EDGE_L and WR of a bit of its own before the equation, which reads it";
inline constexpr std::string_view kRisingOfResult = "WR of a bit, then EDGE_H of it";
inline constexpr std::string_view kFallingOfResult = "WR of a bit, then EDGE_L of it";
inline constexpr std::string_view kSetAtEdge = "WR of a bit, EDGE_H of it, then FL1 1,X";
inline constexpr std::string_view kResetAtEdge = "WR of a bit, EDGE_H of it, then FL1 0,X";
inline constexpr std::string_view kTimer =
    "TM in a DFTM block, which counts its periods (`rungc explain DFTM1`); a mechanism waits by TIM -,N";
inline constexpr std::string_view kCondition = "LDR of the condition, then JL0 to a label after what it is for";
inline constexpr std::string_view kAfterwards = "a label, to which JL0 or JUM leads";

inline constexpr ForeignWord kForeignWords[] = {
    // equivalent, with the same operand
    {"CAL", "PROC_CALL", true},
    {"JMPC", "JL1", true},
    {"JMPCN", "JL0", true},
    {"WRT", "WR", true},
    // expressed differently here
    {"A", kBegins},
    {"ADD", "AD"},
    {"AN", kBeginsInverted},
    {"ANB", "LA without an operand"},
    {"AND", "LA on bits, ANDB on data"},
    {"AND LD", "LA without an operand"},
    {"AND NOT", "LA -X"},
    {"AND.NOT", "LA -X"},
    {"AND.STK", "LA without an operand"},
    {"ANDF", kFallingBefore},
    {"ANDLD", "LA without an operand"},
    {"ANDN", "LA -X"},
    {"ANDNOT", "LA -X"},
    {"ANDP", kRisingBefore},
    {"ANI", "LA -X"},
    {"BT", "LDR"},
    {"CALL", "PROC_CALL"},
    {"CMP", "EQ, LT, GT, LE, GE"},
    {"CTD", "CD"},
    {"CTU", "CU"},
    {"DEC", "LOD, DCR and STO"},
    {"DIV", "DIVB"},
    {"FADD", "AD REAL."},
    {"FDIV", "DIVB REAL."},
    {"FILD", "LOD and REAL"},
    {"FLD", "LOD REAL."},
    {"FMUL", "MULB REAL."},
    {"FN", kFallingOfResult},
    {"FP", kRisingOfResult},
    {"FST", "STO REAL."},
    {"FSTP", "STO REAL."},
    {"FSUB", "SU REAL."},
    {"ELSE", kAfterwards},
    {"ENDIF", kAfterwards},
    {"END_IF", kAfterwards},
    {"F_TRIG", "EDGE_L"},
    {"IDIV", "DIVB"},
    {"IF", kCondition},
    {"IMUL", "MULB"},
    {"INC", "LOD, INR and STO"},
    {"JE", "EQ and JL1"},
    {"JMP", "JUM"},
    {"JNE", "EQ and JL0"},
    {"JNZ", "LDR and JL1"},
    {"JZ", "LDR and JL0"},
    {"L", "LOD"},
    {"LAN", "LA -X"},
    {"LD", "LDR on bits, LOD on data"},
    {"LD NOT", "LDR -X"},
    {"LDF", kFalling},
    {"LDI", "LDR -X"},
    {"LDN", "LDR -X"},
    {"LDNOT", "LDR -X"},
    {"LDP", kRising},
    {"LDRN", "LDR -X"},
    {"LON", "LO -X"},
    {"LXN", "LX -X"},
    {"MOVP", "EDGE_H of the condition, then LOD and STO1"},
    {"MOVSB", "MV"},
    {"MOVSW", "MV"},
    {"MOVSX", "LOD"},
    {"MOVZX", "LOD"},
    {"MUL", "MULB"},
    {"NE", "EQ, then CA"},
    {"NEG", "INV"},
    {"NOT", "CA on RLO"},
    {"O", "LO"},
    {"ON", "LO -X"},
    {"OR", "LO on bits, ORB on data"},
    {"OR LD", "LO without an operand"},
    {"OR NOT", "LO -X"},
    {"OR.NOT", "LO -X"},
    {"OR.STK", "LO without an operand"},
    {"ORF", kFallingBefore},
    {"ORI", "LO -X"},
    {"ORLD", "LO without an operand"},
    {"ORN", "LO -X"},
    {"ORNOT", "LO -X"},
    {"ORP", kRisingBefore},
    {"OUT", "WR"},
    {"OUT -", kWritesInverted},
    {"OUT NOT", kWritesInverted},
    {"OUTN", kWritesInverted},
    {"PLF", kFallingOfResult},
    {"PLS", kRisingOfResult},
    {"R", "FL1 0,X"},
    {"RD", kBegins},
    {"RD.NOT", "LDR -X"},
    {"RD.NOT.STK", kStoresInverted},
    {"RD.STK", kStores},
    {"RET", "PROC_END"},
    {"RST", "FL1 0,X"},
    {"RSTP", kResetAtEdge},
    {"R_TRIG", "EDGE_H"},
    {"S", "FL1 1,X"},
    {"SET", "FL1 1,X"},
    {"SETP", kSetAtEdge},
    {"SHL", "RL"},
    {"SHR", "RR"},
    {"ST", "WR on bits, STO on data"},
    {"ST -", kWritesInverted},
    {"ST NOT", kWritesInverted},
    {"STN", kWritesInverted},
    {"STORE", "STO on data, WR on bits"},
    {"SUB", "SU"},
    {"T", "STO"},
    {"TEST", "LDR"},
    {"TOF", kTimer},
    {"TON", kTimer},
    {"TP", kTimer},
    {"U", kBegins},
    {"UN", kBeginsInverted},
    {"WRN", kWritesInverted},
    {"WRT -", kWritesInverted},
    {"WRT NOT", kWritesInverted},
    {"WRT.NOT", kWritesInverted},
    {"XCHG", "LOD and STO"},
    {"XOR", "LX on bits, XORB on data"},
    {"XOR NOT", "LX -X"},
    {"XORN", "LX -X"},
};

} // namespace rung::frontend::technol
