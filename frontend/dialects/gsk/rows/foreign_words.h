// Words of IEC 61131 instruction lists, of FANUC, Mitsubishi, Omron, Siemens and TECHNOL programs, and their
// equivalents in GSK (man. Part I §4, §5). Included by language.cpp only.
#pragma once
#include "frontend/sema/foreign_word.h"

namespace rung::frontend::gsk {

inline constexpr std::string_view kBegins = "LD where a block begins, AND after it";
inline constexpr std::string_view kBeginsClosed = "LDI where a block begins, ANI after it";
inline constexpr std::string_view kOnDelay = "the function TMRB, an on-delay timer";
inline constexpr std::string_view kOffDelay = "an OUTI after the function TMRB with the inverted condition";
inline constexpr std::string_view kCounter = "the function CTR, a counter by its number";
inline constexpr std::string_view kRisingEdge = "the function DIFU, a rising edge by its number";
inline constexpr std::string_view kFallingEdge = "the function DIFD, a falling edge by its number";
inline constexpr std::string_view kJump = "the function JMPB, which jumps to a label LBL";
inline constexpr std::string_view kReturn = "the function SPE where the subprogram ends";
inline constexpr std::string_view kAtRising =
    "LD, AND or OR of the coil of the function DIFU, a rising edge by its number";
inline constexpr std::string_view kAtFalling =
    "LD, AND or OR of the coil of the function DIFD, a falling edge by its number";
inline constexpr std::string_view kSetAtRising =
    "SET after LD of the coil of the function DIFU, a rising edge by its number";
inline constexpr std::string_view kResetAtRising =
    "RST after LD of the coil of the function DIFU, a rising edge by its number";
inline constexpr std::string_view kStarts = "OUT, as ST of IEC 61131; LD, as ST of Panasonic; or a slip of SET or RST";
inline constexpr std::string_view kInverts = "OUT of a relay, which LDI reads";
inline constexpr std::string_view kKeeps = "OUT of a relay, which LD reads again";
inline constexpr std::string_view kAndBracket = "LD where the bracket begins, ANB where it ends";
inline constexpr std::string_view kOrBracket = "LD where the bracket begins, ORB where it ends";

inline constexpr frontend::ForeignWord kForeignWords[] = {
    // equivalent, with the same operand
    {"=", "OUT", true},
    {"AND LD", "ANB", true},
    {"AND NOT", "ANI", true},
    {"AND.NOT", "ANI", true},
    {"AND.STK", "ANB", true},
    {"ANDI", "ANI", true},
    {"ANDLD", "ANB", true},
    {"ANDN", "ANI", true},
    {"ANDNOT", "ANI", true},
    {"LD NOT", "LDI", true},
    {"LDN", "LDI", true},
    {"LDNOT", "LDI", true},
    {"OR LD", "ORB", true},
    {"OR NOT", "ORI", true},
    {"OR.NOT", "ORI", true},
    {"OR.STK", "ORB", true},
    {"ORLD", "ORB", true},
    {"ORN", "ORI", true},
    {"ORNOT", "ORI", true},
    {"OUT NOT", "OUTI", true},
    {"OUTN", "OUTI", true},
    {"R", "RST", true},
    {"RD", "LD", true},
    {"RD.NOT", "LDI", true},
    {"RD.NOT.STK", "LDI", true},
    {"RD.STK", "LD", true},
    {"RESET", "RST", true},
    {"S", "SET", true},
    {"ST NOT", "OUTI", true},
    {"STN", "OUTI", true},
    {"WR", "OUT", true},
    {"WRN", "OUTI", true},
    {"WRT", "OUT", true},
    {"WRT.NOT", "OUTI", true},
    // expressed differently here
    {")", "ANB or ORB where a bracket ends"},
    {"A", kBegins},
    {"ADD", "the function ADDB"},
    {"AN", kBeginsClosed},
    {"AND(", kAndBracket},
    {"ANDF", kAtFalling},
    {"ANDNT", kAtFalling},
    {"ANDP", kAtRising},
    {"ANDPT", kAtRising},
    {"CA", kInverts},
    {"CAL", "the function CALL"},
    {"CALC", "the function CALL with a condition before it"},
    {"CJ", kJump},
    {"CMP", "the function COMPB"},
    {"COMP", "the function COMPB"},
    {"CTD", kCounter},
    {"CTU", kCounter},
    {"CTUD", kCounter},
    {"DEC", "the function SUBB with 1"},
    {"DECP", "the function SUBB with 1 after the function DIFU"},
    {"DIV", "the function DIVB"},
    {"EDGE_H", kRisingEdge},
    {"EDGE_L", kFallingEdge},
    {"END", "FUNC END1 ends Level 1, FUNC END2 Level 2"},
    {"FL1", "SET or RST"},
    {"FN", kFallingEdge},
    {"FP", kRisingEdge},
    {"F_TRIG", kFallingEdge},
    {"INC", "the function ADDB with 1"},
    {"INCP", "the function ADDB with 1 after the function DIFU"},
    {"INV", kInverts},
    {"JMP", "the function JMPB jumps to a label LBL; JMP skips what comes before a JMPE"},
    {"JMPC", "the function JMPB jumps to a label LBL when its condition is on; JMPC leaves a subprogram"},
    {"LA", "AND, or ANB without an operand"},
    {"LAN", "ANI"},
    {"LDF", kAtFalling},
    {"LDP", kAtRising},
    {"LDR", kBegins},
    {"LDRN", kBeginsClosed},
    {"LO", "OR, or ORB without an operand"},
    {"LON", "ORI"},
    {"MC", "the function COM"},
    {"MCR", "the function COME"},
    {"MEF", kFallingEdge},
    {"MEP", kRisingEdge},
    {"MOV", "the function MOVB, MOVW or MOVN"},
    {"MOVP", "the function MOVB, MOVW or MOVN after the function DIFU"},
    {"MPP", kKeeps},
    {"MPS", kKeeps},
    {"MRD", kKeeps},
    {"MUL", "the function MULB"},
    {"NOP", "nothing: leave the line out"},
    {"NOT", "LDI, ANI, ORI or OUTI; the function NOT inverts bytes"},
    {"O", "OR"},
    {"ON", "ORI"},
    {"OR(", kOrBracket},
    {"ORF", kAtFalling},
    {"ORNT", kAtFalling},
    {"ORP", kAtRising},
    {"ORPT", kAtRising},
    {"OUTP", kRisingEdge},
    {"PLF", kFallingEdge},
    {"PLS", kRisingEdge},
    {"RDNT", kAtFalling},
    {"RDPT", kAtRising},
    {"RET", kReturn},
    {"RSET", "RST, or a slip of SET"},
    {"RSTP", kResetAtRising},
    {"R_TRIG", kRisingEdge},
    {"SETP", kSetAtRising},
    {"SRET", kReturn},
    {"ST", kStarts},
    {"SUB", "FUNC with a function's name; the numbers of functions are this control's own"},
    {"TOF", kOffDelay},
    {"TON", kOnDelay},
    {"TP", "a relay that DIFU sets and TMRB resets"},
    {"U", kBegins},
    {"UN", kBeginsClosed},
    {"XOR", "the function EOR on bytes; on bits LD, ANI, LDI, AND, ORB"},
};

} // namespace rung::frontend::gsk
