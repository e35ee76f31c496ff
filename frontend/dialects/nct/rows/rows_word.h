// Rows: moving, timers, counters, rotation, shifts, logic, integer arithmetic (man. §6.3-§6.9). Included by
// instructions.cpp only.
#pragma once
#include "frontend/dialects/nct/rows/rows_bit.h"

namespace rung::frontend::nct {

inline constexpr frontend::PinInfo kEnable{"EN", "enables the instruction in every cycle"};

// Operands: result and one source.
constexpr Row convertShape(std::string_view group, const OperandKind& resultKind, const OperandKind& sourceKind,
                           LowerFn lower) {
  return {.info = {.group = group,
                   .pins = {kEnable},
                   .operands = {O{"Result", &resultKind, Access::Write, "where the result goes"},
                                O{"Operand", &sourceKind, Access::Read, "the source"}},
                   .output = Output::Optional},
          .lower = lower};
}

// Operands: result, a register and a second operand.
constexpr Row binaryShape(std::string_view group, const OperandKind& secondKind, LowerFn lower) {
  return {.info = {.group = group,
                   .pins = {kEnable},
                   .operands = {O{"Result", &kinds::kWord, Access::Write, "where the result goes"},
                                O{"1st Operand", &kinds::kWord, Access::Read, "register"},
                                O{"2nd Operand", &secondKind, Access::Read, "constant or register"}},
                   .output = Output::Optional},
          .lower = lower};
}

inline constexpr Row kTimerShape = {
    .info = {.group = "timer",
             .pins = {P{"EN", "the condition of the timer"}},
             .operands = {O{"Address of Timer", &kinds::kUserWord, Access::ReadWrite,
                            "time that remains, in milliseconds"},
                          O{"Set Value", &kinds::kDecimal, Access::Read, "at most 2147483 s, 35791 min or 596 h", 0,
                            INT32_MAX},
                          O{"Time Basis", &kinds::kDecimal, Access::Read, "#0 ms, #1 s, #2 min, #3 h", 0, 3}},
             .output = Output::Always,
             .stateful = true},
    .lower = lowerTimer,
    .check = checkTimer,
    .reservation = Reservation::Once};

inline constexpr Row kCounterShape = {
    .info = {.group = "counter",
             .pins = {P{"CK", "counts on its rising edge", true}, P{"U/D", "FALSE up, TRUE down"},
                      P{"R", "TRUE: back to the starting value"}},
             .operands = {O{"Address of Counter", &kinds::kUserWord, Access::ReadWrite, "the content"},
                          O{"Starting Value", &kinds::kDecimal, Access::Read, "", 0, INT32_MAX},
                          O{"Ending Value", &kinds::kDecimal, Access::Read, "", 0, INT32_MAX},
                          O{"Compare Value", &kinds::kDecimal, Access::Read, "", 0, INT32_MAX}},
             .output = Output::Always,
             .stateful = true},
    .lower = lowerCounter,
    .reservation = Reservation::Once};

constexpr Row arrayShape(std::string_view count) {
  return {.info = {.group = "shift",
                   .pins = {kEnable},
                   .operands = {O{"Starting Address", &kinds::kWord, Access::ReadWrite, "word with the lowest bits"},
                                O{"Ending Address", &kinds::kWord, Access::ReadWrite, "word with the highest bits"},
                                O{count, &kinds::kDecimal, Access::Read, "", 0, INT32_MAX}},
                   .output = Output::Optional},
          .lower = lowerArray,
          .usesScratch = true};
}

inline constexpr Row kWordRows[] = {
    rowOf(convertShape("data-move", kinds::kWord, kinds::kInteger, lowerMove), "MOV", "move a double word",
          "6.3.1, l.1269", "Result := Operand.", "|--[N_ON]--{MOV 7000 #25}", kMove),
    rowOf(convertShape("data-move", kinds::kWord, kinds::kHex, lowerMove), "MVN",
          "move the complement of a double word", "6.3.1, l.1281",
          "Result := NOT Operand, bit by bit. A constant is hexadecimal.", "|--[N_ON]--{MVN 7000 #$FF}",
          kMoveComplement),
    rowOf(convertShape("data-move", kinds::kDouble, kinds::kFloat, lowerMoveDouble), "MOVF", "move a double",
          "6.3.2, l.1294", "Result and the word after it := Operand, as a bit pattern.", "|--[N_ON]--{MOVF 7000 *3.5}"),

    rowOf(kTimerShape, "TOND", "on-delay", "6.4.1, l.1391",
          "The output turns TRUE when the input has been TRUE for the set time. The register counts down to 0 from "
          "the rising edge of the input, and holds the set value again while the input is FALSE.",
          "|--[START]--{TOND 7000 #500 #0}--(STARTED)", kOnDelay),
    rowOf(kTimerShape, "TOFFD", "off-delay", "6.4.2, l.1407",
          "The output is TRUE with the input and stays TRUE for the set time after it. The register counts down "
          "from the falling edge.",
          "|--[RUN]--{TOFFD 7000 #5 #1}--(FAN)", kOffDelay),
    rowOf(kTimerShape, "TPULSE", "pulse of programmable width", "6.4.3, l.1423",
          "The output turns TRUE with the input and FALSE after the set time, or at once when the input turns "
          "FALSE before.",
          "|--[LUBE]--{TPULSE 7000 #3 #1}--(PUMP)", kTimedPulse),

    rowOf(kCounterShape, "CNT", "counter", "6.5.1, l.1507",
          "Each rising edge of CK counts up or down by 1 until the content equals the ending value; there it stops "
          "until R loads the starting value. The output is TRUE while the content equals the compare value.",
          "|--[PART]--{CNT 7000 #0 #10 #10}--(FULL)", kStopping),
    rowOf(kCounterShape, "CNTR", "ring counter", "6.5.2, l.1543",
          "As CNT, but counting up at the ending value leads to the starting value, counting down at the "
          "starting value to the ending one. A start above the end sets FL_ER and nothing is counted.",
          "|--[STEP]--{CNTR 7000 #1 #8 #1}--(HOME)", kRing),

    {.info = {.mnemonic = "ROT",
              .title = "rotation control",
              .group = "rotation",
              .pins = {P{"EN", "calculates on its rising edge", true}, P{"BID", "TRUE: the shorter way"},
                       P{"DIR", "without BID: 0 positive, 1 negative"},
                       P{"INC", "FALSE position, TRUE number of steps"},
                       P{"PRE", "TRUE: one position before the goal"}},
              .operands = {O{"Position to Go", &kinds::kWord, Access::Write, "the result"},
                           O{"Current Position", &kinds::kWord, Access::Read, ""},
                           O{"Goal Position", &kinds::kWord, Access::Read, ""},
                           O{"Starting Value", &kinds::kDecimal, Access::Read, "lowest position", 0, INT32_MAX},
                           O{"Ending Value", &kinds::kDecimal, Access::Read, "highest position", 0, INT32_MAX}},
              .output = Output::Always,
              .stateful = true,
              .ref = "6.6, l.1571",
              .doc = "Finds the way of a turret or magazine from the current position to the goal: the direction "
                     "(output, TRUE negative) and the position or number of steps to go.",
              .example = "|--[@M6]--{ROT TOGO POS GOAL #1 #12}--(NEGATIVE)"},
     .lower = lowerRotation},

    {.info = {.mnemonic = "SHTR",
              .title = "shift register",
              .group = "shift",
              .pins = {P{"CK", "shifts on its rising edge", true}, P{"L/R", "FALSE left, TRUE right"},
                       P{"D", "the bit that enters"}},
              .operands = {O{"Address of Shift Register", &kinds::kWord, Access::ReadWrite, "the 32 bits"}},
              .output = Output::Always,
              .stateful = true,
              .ref = "6.7.1, l.1683",
              .doc = "Shifts a word by one bit; the output is the bit that left it last.",
              .example = "|--[STEP]--{SHTR 7000}--(OUT)"},
     .lower = lowerShiftRegister},
    rowOf(arrayShape("Shift Value"), "ASHL", "shift an array left", "6.7.2, l.1735",
          "Shifts the bits of a run of words towards higher words; zeros enter.", "|--[@STEP]--{ASHL 7000 7003 #4}",
          kShiftLeft),
    rowOf(arrayShape("Shift Value"), "ASHR", "shift an array right", "6.7.2, l.1735",
          "Shifts the bits of a run of words towards lower words; zeros enter.", "|--[@STEP]--{ASHR 7000 7003 #4}",
          kShiftRight),
    rowOf(arrayShape("Rotation Value"), "ARTL", "rotate an array left", "6.7.3, l.1802",
          "Rotates the bits of a run of words towards higher words.", "|--[@STEP]--{ARTL 7000 7003 #4}", kRotateLeft),
    rowOf(arrayShape("Rotation Value"), "ARTR", "rotate an array right", "6.7.3, l.1802",
          "Rotates the bits of a run of words towards lower words.", "|--[@STEP]--{ARTR 7000 7003 #4}", kRotateRight),

    rowOf(convertShape("logic", kinds::kWord, kinds::kHex, lowerMove), "NEG", "complement", "6.8.1, l.1868",
          "Result := NOT Operand, bit by bit: the one's complement, as MVN.", "|--[N_ON]--{NEG 7000 7001}",
          kMoveComplement),
    rowOf(binaryShape("logic", kinds::kHex, lowerLogic), "AND", "32 bit AND", "6.8.2, l.1900",
          "Result := 1st AND 2nd, bit by bit. A constant is hexadecimal.", "|--[N_ON]--{AND 7000 7001 #$FF}", kAnd),
    rowOf(binaryShape("logic", kinds::kHex, lowerLogic), "OR", "32 bit OR", "6.8.2, l.1900",
          "Result := 1st OR 2nd, bit by bit. A constant is hexadecimal.", "|--[N_ON]--{OR 7000 7001 #$FF}", kOr),
    rowOf(binaryShape("logic", kinds::kHex, lowerLogic), "XOR", "32 bit exclusive OR", "6.8.2, l.1900",
          "Result := 1st XOR 2nd, bit by bit. A constant is hexadecimal.", "|--[N_ON]--{XOR 7000 7001 #$FF}", kXor),

    rowOf(binaryShape("integer", kinds::kInteger, lowerAddSub), "ADD", "signed addition", "6.9.1, l.2021",
          "Result := 1st + 2nd modulo 2^32. FL_CY is the unsigned carry; FL_OF: two non-negative numbers gave a "
          "negative one; FL_UF: two negative ones a non-negative one.",
          "|--[@PART]--{ADD PARTS PARTS #1}", kAdd),
    rowOf(binaryShape("integer", kinds::kInteger, lowerAddSub), "SUB", "signed subtraction", "6.9.2, l.2043",
          "Result := 1st - 2nd modulo 2^32. FL_CY is the unsigned borrow; FL_OF: non-negative minus negative gave "
          "a negative number; FL_UF: negative minus non-negative a non-negative one.",
          "|--[@PART]--{SUB LEFT LEFT #1}", kSubtract),
    rowOf(binaryShape("integer", kinds::kInteger, lowerMul), "MUL", "signed multiplication", "6.9.3, l.2067",
          "Result := low 32 bits of 1st * 2nd. FL_OF: the product does not fit.", "|--[N_ON]--{MUL 7000 7001 #3}"),
    rowOf(binaryShape("integer", kinds::kInteger, lowerDiv), "DIV", "signed division", "6.9.4, l.2095",
          "Result := 1st / 2nd, rounded toward zero. By 0: the result is 0, FL_ER is set and the output is FALSE. "
          "-2147483648 / -1 sets FL_OF.",
          "|--[N_ON]--{DIV 7000 7001 #3}"),
};

} // namespace rung::frontend::nct
