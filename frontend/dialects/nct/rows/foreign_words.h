// Boxes of IEC 61131, FANUC, Mitsubishi and Rockwell ladders, and what NCT has for them. Included by instructions.cpp
// only.
#pragma once
#include "frontend/sema/foreign_word.h"

namespace rung::nct {

inline constexpr std::string_view kSetCoil = "a coil (S x)";
inline constexpr std::string_view kResetCoil = "a coil (R x)";

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
    {"COMP", "CMP, which sets FL_GT, FL_EQ and FL_LT, or a comparing contact such as CEQ"},
    {"CTD", "CNT, whose pin U/D is on to count down"},
    {"CTR", "CNT, or the ring counter CNTR"},
    {"CTU", "CNT, whose pin U/D is off to count up"},
    {"CTUD", "CNT, whose pin U/D says where it counts"},
    {"F_TRIG", "a contact [%x], or DIFD"},
    {"MOVE", "MOV, whose result comes first"},
    {"NOT", "MVN, which moves the inverted bits; a closed contact is [/x]"},
    {"OTE", "a coil (x)"},
    {"OTL", kSetCoil},
    {"OTU", kResetCoil},
    {"R_TRIG", "a contact [@x], or DIFU"},
    {"RESET", kResetCoil},
    {"RS", "two coils, (S x) and (R x)"},
    {"RST", kResetCoil},
    {"SET", kSetCoil},
    {"SP", "SBN with a number from #0 to #99"},
    {"SR", "two coils, (S x) and (R x)"},
    {"TMR", "TOND, an on-delay timer"},
    {"TMRB", "TOND, an on-delay timer"},
    {"TP", "TPULSE, whose pulse ends when its condition does"},
};

} // namespace rung::nct
