// Words of IEC 61131 instruction lists and of GSK, Mitsubishi and Siemens programs, and their equivalents here.
// Included by language.cpp only.
#pragma once
#include "frontend/sema/foreign_word.h"

namespace rung::frontend::fanuc {

inline constexpr std::string_view kBegins = "RD where a network begins, RD.STK where a block begins";
inline constexpr std::string_view kBeginsClosed = "RD.NOT where a network begins, RD.NOT.STK where a block begins";
inline constexpr std::string_view kOnDelay = "the function TMRB, an on-delay timer";
inline constexpr std::string_view kOffDelay = "the function TMRBF, an off-delay timer";
inline constexpr std::string_view kCounter = "the function CTR, a counter by its number";
inline constexpr std::string_view kRisingEdge = "the function DIFU, a rising edge by its number";
inline constexpr std::string_view kFallingEdge = "the function DIFD, a falling edge by its number";
inline constexpr std::string_view kCompares = "EQB, NEB, GTB, LTB, GEB, LEB, and the same with W and D";

inline constexpr frontend::ForeignWord kForeignWords[] = {
    // equivalent, with the same operand
    {"=", "WRT", true},
    {"AND NOT", "AND.NOT", true},
    {"ANB", "AND.STK", true},
    {"ANDN", "AND.NOT", true},
    {"ANI", "AND.NOT", true},
    {"OR NOT", "OR.NOT", true},
    {"ORB", "OR.STK", true},
    {"ORI", "OR.NOT", true},
    {"ORN", "OR.NOT", true},
    {"OUT", "WRT", true},
    {"OUTI", "WRT.NOT", true},
    {"RESET", "RST", true},
    {"ST", "WRT", true},
    {"STN", "WRT.NOT", true},
    // another form
    {"CMP", kCompares, false},
    {"CONST", "constants are numbers; a symbol of an address is in a section %@2", false},
    {"CTU", kCounter, false},
    {"DIALECT", "left out: the name of the file says it", false},
    {"FUNC", "SUB with the number of a function, or its name; parameters follow on lines of their own", false},
    {"LD", kBegins, false},
    {"LDI", kBeginsClosed, false},
    {"LDN", kBeginsClosed, false},
    {"PLF", kFallingEdge, false},
    {"PLS", kRisingEdge, false},
    {"PRM", "the parameter alone, on a line after its function", false},
    {"SYMBOL", "a line with an address and its symbol, in a section %@2", false},
    {"TABLE", "the value alone, on a line after the parameters", false},
    {"TOF", kOffDelay, false},
    {"TON", kOnDelay, false},
};

} // namespace rung::frontend::fanuc
