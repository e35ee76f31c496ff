// The rows of the table (man. Part I §4 and §5). Texts restate the manual; P numbers mark our reading where it is
// silent.
#include "frontend/dialects/gsk/instructions.h"

#include <algorithm>
#include <array>

#include "frontend/dialects/gsk/address.h"
#include "frontend/dialects/gsk/lower.h"

namespace rung::gsk {
namespace {

using frontend::Access;
using frontend::FixedList;
using frontend::InstructionInfo;
using frontend::OperandInfo;
using frontend::Output;
using frontend::PinInfo;
using frontend::Placement;

constexpr OperandInfo in(std::string_view name, Kind kind, std::string_view doc = {}) {
  return {.name = name, .kind = kindName(kind), .access = Access::Read, .doc = doc};
}
constexpr OperandInfo out(std::string_view name, Kind kind, std::string_view doc = {}) {
  return {.name = name, .kind = kindName(kind), .access = Access::Write, .doc = doc};
}
constexpr OperandInfo inout(std::string_view name, Kind kind, std::string_view doc = {}) {
  return {.name = name, .kind = kindName(kind), .access = Access::ReadWrite, .doc = doc};
}
constexpr OperandInfo number(std::string_view name, int64_t min, int64_t max, std::string_view doc = {}) {
  return {.name = name, .kind = "number", .access = Access::None, .doc = doc, .min = min, .max = max};
}
constexpr OperandInfo kFormat = {.name = "format", .kind = "format", .access = Access::None, .doc = "length in bytes"};
constexpr OperandInfo kFormatA = {
    .name = "format", .kind = "format-a", .access = Access::None, .doc = "constant or address, and length in bytes"};
constexpr OperandInfo kLabel = {
    .name = "label", .kind = "label", .access = Access::None, .doc = "L1-L9999", .min = 1, .max = 9999};
constexpr OperandInfo kSubprogram = {
    .name = "subprogram", .kind = "subprogram", .access = Access::None, .doc = "P1-P512", .min = 1, .max = 512};

constexpr PinInfo kAct = {.name = "ACT", .doc = "1: execute"};
constexpr PinInfo kRst = {.name = "RST", .doc = "1: the output becomes 0; goes before ACT (P17)"};
constexpr PinInfo kCn0 = {.name = "CN0", .doc = "numbers begin with 0 or 1"};
constexpr PinInfo kUpDown = {.name = "UPDOWN", .doc = "0 up, 1 down"};
constexpr PinInfo kCount = {.name = "ACT", .doc = "counts at its rising edge", .edge = true};

constexpr Row basic(std::string_view mnemonic, std::string_view title, OperandInfo operand, std::string_view ref,
                    std::string_view doc) {
  Row row;
  row.info.mnemonic = mnemonic;
  row.info.title = title;
  row.info.group = operand.access == Access::Write || operand.access == Access::ReadWrite ? "coils" : "contacts";
  if (!operand.name.empty()) row.info.operands = {operand};
  row.info.placement = Placement::Anywhere;
  row.info.ref = ref;
  row.info.doc = doc;
  return row;
}
constexpr OperandInfo kBitRead = in("bit", Kind::Bit);

constexpr Row kRows[] = {
    basic("LD", "normally open contact, new block", kBitRead, "4.1, l.820", "Pushes the bit onto the stack register."),
    basic("LDI", "normally closed contact, new block", kBitRead, "4.1, l.821",
          "Pushes the inverted bit onto the stack register."),
    basic("OUT", "coil", out("bit", Kind::Coil), "4.1, l.822", "The bit becomes ST0; ST0 stays."),
    basic("OUTI", "inverted coil", out("bit", Kind::Coil), "4.1, l.823",
          "The bit becomes the inverse of ST0; ST0 stays."),
    basic("AND", "contact in series", kBitRead, "4.2, l.824", "ST0 := ST0 and bit."),
    basic("ANI", "normally closed contact in series", kBitRead, "4.2, l.825", "ST0 := ST0 and not bit."),
    basic("OR", "contact in parallel", kBitRead, "4.3, l.826", "ST0 := ST0 or bit."),
    basic("ORI", "normally closed contact in parallel", kBitRead, "4.3, l.827", "ST0 := ST0 or not bit."),
    basic("ORB", "blocks in parallel", {}, "4.4, l.828", "ST1 := ST1 or ST0, and ST0 is dropped."),
    basic("ANB", "blocks in series", {}, "4.5, l.829", "ST1 := ST1 and ST0, and ST0 is dropped."),
    basic("SET", "set", inout("bit", Kind::Coil), "4.6, l.830", "The bit becomes 1 when ST0 is 1, and stays."),
    basic("RST", "reset", inout("bit", Kind::Coil), "4.6, l.831", "The bit becomes 0 when ST0 is 1, and stays."),

    {.info = {.mnemonic = "END1",
              .title = "end of Level 1",
              .group = "ends",
              .number = 0,
              .placement = Placement::AtRail,
              .ref = "5.1, l.1040",
              .doc = "Ends the Level 1 program. Stands once, also where Level 1 is empty.",
              .example = "FUNC 0"},
     .control = Control::End1,
     .lower = &lowerEnd},
    {.info = {.mnemonic = "END2",
              .title = "end of Level 2",
              .group = "ends",
              .number = 1,
              .placement = Placement::AtRail,
              .ref = "5.2, l.1054",
              .doc = "Ends the Level 2 program. Only subprograms may follow.",
              .example = "FUNC 1"},
     .control = Control::End2,
     .lower = &lowerEnd},

    {.info = {.mnemonic = "TMR",
              .title = "on-delay timer",
              .group = "timers",
              .number = 2,
              .pins = {kAct},
              .operands = {number("number", 1, 100)},
              .output = Output::Always,
              .stateful = true,
              .ref = "5.3, l.1074",
              .doc = "OUT becomes 1 when ACT has been 1 for the preset time, which is set on the timer page and kept "
                     "through power-off: "
                     "timers 1-20 in units of 48 ms, 21-100 in units of 8 ms, the remainder dropped. ACT=0: OUT=0, the "
                     "time is forgotten. "
                     "The time counts from the first scan with ACT=1 (P23).",
              .example = "LD X9.0\nFUNC 2\nPRM 1\nOUT Y9.0"},
     .numbers = Row::Numbers::Timer,
     .lower = &lowerTimer,
     .variant = kTimerPage},
    {.info = {.mnemonic = "TMRB",
              .title = "fixed on-delay timer",
              .group = "timers",
              .number = 3,
              .pins = {kAct},
              .operands = {number("number", 1, 200),
                           number("preset", 8, 999999, "milliseconds; a remainder of 8 is dropped")},
              .output = Output::Always,
              .stateful = true,
              .ref = "5.4, l.1118",
              .doc = "As TMR, but the preset stands in the program, in milliseconds and units of 8 ms. Its numbers are "
                     "a set of their own.",
              .example = "LD X9.0\nFUNC 3\nPRM 1\nPRM 1000\nOUT Y9.0"},
     .numbers = Row::Numbers::Timer,
     .lower = &lowerTimer,
     .variant = kTimerFixed},
    {.info = {.mnemonic = "TMRC",
              .title = "on-delay timer, preset in memory",
              .group = "timers",
              .number = 4,
              .pins = {kAct},
              .operands = {number("accuracy", 0, 2, "0: 8 ms, 1: 48 ms, 2: 1 s"),
                           in("preset", Kind::Word, "unsigned, in units of the accuracy"),
                           inout("register", Kind::WorkArea, "for the control's own use")},
              .output = Output::Always,
              .stateful = true,
              .ref = "5.5, l.1164",
              .doc = "As TMR, but the preset is a word of memory that may change at any time. The contents of the "
                     "register are not defined.",
              .example = "LD X9.0\nFUNC 4\nPRM 0\nPRM D10\nPRM R100\nOUT Y9.0"},
     .lower = &lowerTimer,
     .variant = kTimerMemory},

    {.info = {.mnemonic = "DECB",
              .title = "binary decoding",
              .group = "decoding",
              .number = 5,
              .pins = {kAct},
              .operands = {kFormat, in("code", Kind::Data), in("first code", Kind::Constant),
                           out("result", Kind::Byte)},
              .ref = "5.6, l.1217",
              .doc = "Bit i of the result becomes 1 when the code equals first code + i, for i = 0-7; the others "
                     "become 0. Codes are compared as "
                     "bit patterns (P25). ACT=0: all eight bits become 0.",
              .example = "LD F7.0\nFUNC 5\nPRM 2\nPRM F10\nPRM 3\nPRM R200"},
     .lower = &lowerDecode},

    {.info = {.mnemonic = "CTR",
              .title = "ring counter",
              .group = "counters",
              .number = 6,
              .pins = {kCn0, kUpDown, kRst, kCount},
              .operands = {number("number", 1, 100)},
              .output = Output::Always,
              .stateful = true,
              .ref = "5.7, l.1271",
              .doc = "Counts rising edges of ACT. Up: from the start value (CN0) to the preset, the next pulse begins "
                     "again. Down: from the preset "
                     "to CN0 (P26). RST=1 sets the start value and OUT=0. OUT=1 when a count arrives at the end of its "
                     "way. Preset and value lie in "
                     "C, two bytes each from C(4(n-1)), and are kept through power-off (P8).",
              .example = "LD R0.0\nLD R0.1\nLD R0.2\nLD X9.0\nFUNC 6\nPRM 1\nOUT Y9.0"},
     .numbers = Row::Numbers::Counter,
     .lower = &lowerCounter,
     .variant = kCounterPage},
    {.info =
         {.mnemonic = "CTRC",
          .title = "ring counter, preset in memory",
          .group = "counters",
          .number = 7,
          .pins = {kCn0, kUpDown, kRst, kCount},
          .operands = {in("preset", Kind::Word, "0-32767"),
                       inout("register", Kind::Dword, "+0 current value, +2 for the control's own use")},
          .output = Output::Always,
          .stateful = true,
          .ref = "5.8, l.1340",
          .doc =
              "As CTR, with preset and current value in memory. With its register in R it begins at 0 after power-on.",
          .example = "LD R0.0\nLD R0.1\nLD R0.2\nLD X9.0\nFUNC 7\nPRM D10\nPRM D12\nOUT Y9.0"},
     .lower = &lowerCounter,
     .variant = kCounterMemory},

    {.info = {.mnemonic = "ROTB",
              .title = "rotation control",
              .group = "rotation",
              .number = 8,
              .pins = {kCn0, PinInfo{.name = "DIR", .doc = "0 always forward, 1 the shorter way"},
                       PinInfo{.name = "POS", .doc = "0 the target, 1 the position before it"},
                       PinInfo{.name = "INC", .doc = "0 the result is a position, 1 a number of steps"}, kAct},
              .operands = {kFormat, in("positions", Kind::Data), in("current", Kind::Data), in("target", Kind::Data),
                           out("result", Kind::Data)},
              .output = Output::Always,
              .stateful = true,
              .ref = "5.9, l.1425",
              .doc = "Way of a turret or magazine from the current to the target position. OUT: 0 forward (numbers "
                     "increase), 1 reverse; equal ways go "
                     "forward (P30). ACT=0, or a position outside the table: result and OUT stay (P31).",
              .example = "LD R0.0\nLD R0.1\nLD R0.2\nLD R0.3\nLD X9.0\nFUNC 8\nPRM 1\nPRM D10\nPRM D11\nPRM D12\nPRM "
                         "D13\nOUT Y9.0"},
     .lower = &lowerRotation},
    {.info = {.mnemonic = "CODB",
              .title = "code conversion by a table",
              .group = "conversion",
              .number = 9,
              .pins = {kRst, kAct},
              .operands = {kFormat, number("capacity", 1, 256, "rows of the table"), in("index", Kind::Byte),
                           out("result", Kind::Data)},
              .output = Output::Always,
              .stateful = true,
              .ref = "5.10, l.1509",
              .doc = "result := row `index` of the table that follows as TABLE rows, the first being number 0. OUT=1 "
                     "when there is no such row (P32).",
              .example = "LD R0.0\nLD X9.0\nFUNC 9\nPRM 1\nPRM 2\nPRM D10\nPRM D11\nTABLE 10\nTABLE 20\nOUT Y9.0"},
     .hasTable = true,
     .lower = &lowerCodeTable},

    {.info = {.mnemonic = "MOVE",
              .title = "masked transfer",
              .group = "transfers",
              .number = 10,
              .pins = {kAct},
              .operands = {in("high mask", Kind::Mask), in("low mask", Kind::Mask), in("source", Kind::Byte),
                           out("target", Kind::Byte)},
              .ref = "5.11, l.1570",
              .doc = "target := source and mask. ACT=0: nothing happens.",
              .example = "LD X9.0\nFUNC 10\nPRM 0000\nPRM 1111\nPRM D10\nPRM D11"},
     .lower = &lowerMoveMasked},
    {.info = {.mnemonic = "MOVOR",
              .title = "transfer with or",
              .group = "transfers",
              .number = 11,
              .pins = {kAct},
              .operands = {in("source", Kind::Byte), in("or data", Kind::Byte), out("target", Kind::Byte)},
              .ref = "5.12, l.1607",
              .doc = "target := source or data. ACT=0: nothing happens.",
              .example = "LD X9.0\nFUNC 11\nPRM D10\nPRM D11\nPRM D12"},
     .lower = &lowerMoveOr},
    {.info = {.mnemonic = "MOVB",
              .title = "transfer of a byte",
              .group = "transfers",
              .number = 12,
              .pins = {kAct},
              .operands = {in("source", Kind::Byte), out("target", Kind::Byte)},
              .ref = "5.13, l.1643",
              .doc = "target := source, one byte. ACT=0: nothing happens.",
              .example = "LD X9.0\nFUNC 12\nPRM D10\nPRM D11"},
     .lower = &lowerMove,
     .variant = 1},
    {.info = {.mnemonic = "MOVW",
              .title = "transfer of two bytes",
              .group = "transfers",
              .number = 13,
              .pins = {kAct},
              .operands = {in("source", Kind::Word), out("target", Kind::Word)},
              .ref = "5.14, l.1676",
              .doc = "target := source, two bytes. ACT=0: nothing happens.",
              .example = "LD X9.0\nFUNC 13\nPRM D10\nPRM D12"},
     .lower = &lowerMove,
     .variant = 2},
    {.info = {.mnemonic = "MOVN",
              .title = "transfer of a block",
              .group = "transfers",
              .number = 14,
              .pins = {kAct},
              .operands = {number("bytes", 1, 200), in("source", Kind::Block), out("target", Kind::Block)},
              .ref = "5.15, l.1705",
              .doc = "target := source, 1-200 bytes; areas that overlap behave as if copied at once (P33). ACT=0: "
                     "nothing happens.",
              .example = "LD X9.0\nFUNC 14\nPRM 10\nPRM D10\nPRM D100"},
     .lower = &lowerMoveBlock},

    {.info = {.mnemonic = "PARI",
              .title = "parity check",
              .group = "checks",
              .number = 15,
              .pins = {PinInfo{.name = "OE", .doc = "0 even, 1 odd parity demanded"}, kRst, kAct},
              .operands = {in("data", Kind::Byte)},
              .output = Output::Always,
              .stateful = true,
              .ref = "5.16, l.1741",
              .doc = "OUT=1 when the number of ones in the byte does not have the demanded parity. ACT=0: OUT stays.",
              .example = "LD R0.0\nLD R0.1\nLD X9.0\nFUNC 15\nPRM D10\nOUT Y9.0"},
     .lower = &lowerParity},
    {.info = {.mnemonic = "DCNVB",
              .title = "binary and BCD",
              .group = "conversion",
              .number = 16,
              .pins = {PinInfo{.name = "SIN", .doc = "sign of BCD input, 1 negative"},
                       PinInfo{.name = "CNV", .doc = "0 binary to BCD, 1 BCD to binary"}, kRst, kAct},
              .operands = {kFormat, in("source", Kind::Data), out("result", Kind::Data)},
              .output = Output::Always,
              .stateful = true,
              .ref = "5.17, l.1788",
              .doc = "Converts between signed binary and BCD of the same length. OUT=1 when a digit is above 9 or the "
                     "number has too many digits; the "
                     "result is not written then. Binary to BCD: R1000.1 is the sign, R1000.5 the overflow (P22).",
              .example = "LD R0.0\nLD R0.1\nLD R0.2\nLD X9.0\nFUNC 16\nPRM 2\nPRM D10\nPRM D12\nOUT Y9.0"},
     .lower = &lowerBcd},

    {.info = {.mnemonic = "COMPB",
              .title = "comparison",
              .group = "comparison",
              .number = 17,
              .pins = {kAct},
              .operands = {kFormatA, in("benchmark", Kind::ConstantOrData), in("data", Kind::Data),
                           out("result", Kind::Byte)},
              .ref = "5.18, l.1873",
              .doc = "Signed comparison. The result becomes 1 when benchmark = data, 2 when benchmark > data, 4 when "
                     "benchmark < data (P34). ACT=0: nothing happens.",
              .example = "LD X9.0\nFUNC 17\nPRM 0001\nPRM 10\nPRM D10\nPRM R10"},
     .lower = &lowerCompare},
    {.info = {.mnemonic = "COIN",
              .title = "coincidence",
              .group = "comparison",
              .number = 18,
              .pins = {kAct},
              .operands = {kFormatA, in("benchmark", Kind::ConstantOrData), in("data", Kind::Data)},
              .output = Output::Always,
              .stateful = true,
              .ref = "5.19, l.1921",
              .doc = "OUT=1 when both are equal. ACT=0: OUT stays.",
              .example = "LD X9.0\nFUNC 18\nPRM 0001\nPRM 10\nPRM D10\nOUT Y9.0"},
     .lower = &lowerCoincidence},

    {.info = {.mnemonic = "DSCHB",
              .title = "search in a data table",
              .group = "data tables",
              .number = 19,
              .pins = {kRst, kAct},
              .operands = {kFormat, in("last entry", Kind::Data, "number of the last entry"),
                           in("table", Kind::DataTable), in("searched", Kind::Data), out("result", Kind::Data)},
              .output = Output::Always,
              .stateful = true,
              .ref = "5.20, l.1969",
              .doc = "result := number of the lowest entry that holds the searched data (P35), OUT=0; OUT=1 when there "
                     "is none. Entries are 0 to the number given.",
              .example = "LD R0.0\nLD X9.0\nFUNC 19\nPRM 1\nPRM D10\nPRM D20\nPRM D11\nPRM D12\nOUT Y9.0"},
     .lower = &lowerSearch},
    {.info = {.mnemonic = "XMOVB",
              .title = "indexed transfer",
              .group = "data tables",
              .number = 20,
              .pins = {PinInfo{.name = "RW", .doc = "0 read from the table, 1 write into it"}, kRst, kAct},
              .operands = {kFormat, in("entries", Kind::Data, "number of entries"), inout("table", Kind::DataTable),
                           inout("data", Kind::Data), in("index", Kind::Data)},
              .output = Output::Always,
              .stateful = true,
              .ref = "5.21, l.2044",
              .doc = "Moves data between a place and an entry of a table. OUT=1 when the index is not below the number "
                     "of entries (P36); nothing is moved then.",
              .example = "LD R0.0\nLD R0.1\nLD X9.0\nFUNC 20\nPRM 1\nPRM D10\nPRM D20\nPRM D11\nPRM D12\nOUT Y9.0"},
     .lower = &lowerIndexedMove},

    {.info = {.mnemonic = "ADDB",
              .title = "addition",
              .group = "arithmetic",
              .number = 21,
              .pins = {kRst, kAct},
              .operands = {kFormatA, in("augend", Kind::Data), in("addend", Kind::ConstantOrData),
                           out("result", Kind::Data)},
              .output = Output::Always,
              .stateful = true,
              .ref = "5.22, l.2121",
              .doc = "result := augend + addend, signed. OUT=1 when the sum does not fit; the low bytes are stored all "
                     "the same (P38). R1000 gets zero (bit 0), "
                     "negative (bit 1), overflow (bit 5) (P22).",
              .example = "LD R0.0\nLD X9.0\nFUNC 21\nPRM 0002\nPRM D10\nPRM 1000\nPRM D20\nOUT R10.0"},
     .lower = &lowerArithmetic,
     .variant = kAdd},
    {.info = {.mnemonic = "SUBB",
              .title = "subtraction",
              .group = "arithmetic",
              .number = 22,
              .pins = {kRst, kAct},
              .operands = {kFormatA, in("minuend", Kind::Data), in("subtrahend", Kind::ConstantOrData),
                           out("result", Kind::Data)},
              .output = Output::Always,
              .stateful = true,
              .ref = "5.23, l.2188",
              .doc = "result := minuend - subtrahend, signed; else as ADDB.",
              .example = "LD R0.0\nLD X9.0\nFUNC 22\nPRM 0002\nPRM D10\nPRM 1000\nPRM D20\nOUT R10.0"},
     .lower = &lowerArithmetic,
     .variant = kSubtract},
    {.info = {.mnemonic = "MULB",
              .title = "multiplication",
              .group = "arithmetic",
              .number = 23,
              .pins = {kRst, kAct},
              .operands = {kFormatA, in("multiplicand", Kind::Data), in("multiplier", Kind::ConstantOrData),
                           out("result", Kind::Data)},
              .output = Output::Always,
              .stateful = true,
              .ref = "5.24, l.2251",
              .doc = "result := multiplicand * multiplier, signed; else as ADDB. RST=1: OUT=0 (P16).",
              .example = "LD R0.0\nLD X9.0\nFUNC 23\nPRM 0002\nPRM D10\nPRM 3\nPRM D20\nOUT R10.0"},
     .lower = &lowerArithmetic,
     .variant = kMultiply},
    {.info = {.mnemonic = "DIVB",
              .title = "division",
              .group = "arithmetic",
              .number = 24,
              .pins = {kRst, kAct},
              .operands = {kFormatA, in("dividend", Kind::Data), in("divisor", Kind::ConstantOrData),
                           out("result", Kind::Data)},
              .output = Output::Always,
              .stateful = true,
              .ref = "5.25, l.2318",
              .doc = "result := dividend / divisor, toward zero (P37); the remainder, with the sign of the dividend, "
                     "goes to R1002. OUT=1 when the divisor is 0, "
                     "which changes nothing else (P38), or when the quotient does not fit. RST=1: OUT=0 (P16).",
              .example = "LD R0.0\nLD X9.0\nFUNC 24\nPRM 0002\nPRM D10\nPRM 3\nPRM D20\nOUT R10.0"},
     .lower = &lowerDivision},
    {.info = {.mnemonic = "NUMEB",
              .title = "definition of a constant",
              .group = "arithmetic",
              .number = 25,
              .pins = {kAct},
              .operands = {kFormat, in("constant", Kind::Constant), out("target", Kind::Data)},
              .ref = "5.26, l.2385",
              .doc = "target := constant. ACT=0: nothing happens.",
              .example = "LD X9.0\nFUNC 25\nPRM 2\nPRM 1000\nPRM D10"},
     .lower = &lowerNumber},

    {.info = {.mnemonic = "DIFU",
              .title = "rising edge",
              .group = "edges",
              .number = 26,
              .pins = {kAct},
              .operands = {number("number", 1, 200)},
              .output = Output::Always,
              .stateful = true,
              .ref = "5.27, l.2427",
              .doc = "OUT=1 for one scan after ACT has become 1. The memory belongs to the instruction, not to the "
                     "number (P39).",
              .example = "LD X9.0\nFUNC 26\nPRM 1\nOUT R9.0"},
     .numbers = Row::Numbers::Edge,
     .lower = &lowerEdge,
     .variant = kRising},
    {.info = {.mnemonic = "DIFD",
              .title = "falling edge",
              .group = "edges",
              .number = 27,
              .pins = {kAct},
              .operands = {number("number", 1, 200)},
              .output = Output::Always,
              .stateful = true,
              .ref = "5.28, l.2465",
              .doc = "OUT=1 for one scan after ACT has become 0. The memory belongs to the instruction, not to the "
                     "number (P39).",
              .example = "LD X9.0\nFUNC 27\nPRM 2\nOUT R9.1"},
     .numbers = Row::Numbers::Edge,
     .lower = &lowerEdge,
     .variant = kFalling},
    {.info = {.mnemonic = "SFT",
              .title = "shift register",
              .group = "shifts",
              .number = 28,
              .pins = {PinInfo{.name = "DIR", .doc = "0 left, 1 right"},
                       PinInfo{.name = "CONT", .doc = "1: bits that were 1 stay 1"}, kRst, kAct},
              .operands = {inout("data", Kind::Word)},
              .output = Output::Always,
              .stateful = true,
              .ref = "5.29, l.2503",
              .doc = "Shifts two bytes by one bit in every scan with ACT=1. OUT=1 when a 1 fell out. RST=1: OUT=0, the "
                     "data stay (P40).",
              .example = "LD R0.0\nLD R0.1\nLD R0.2\nLD X9.0\nFUNC 28\nPRM D10\nOUT Y9.0"},
     .lower = &lowerShift},

    {.info = {.mnemonic = "EOR",
              .title = "exclusive or of bytes",
              .group = "logic",
              .number = 29,
              .pins = {kAct},
              .operands = {kFormatA, in("A", Kind::Data), in("B", Kind::ConstantOrData), out("C", Kind::Data)},
              .ref = "5.30, l.2565",
              .doc = "C := A xor B. ACT=0: nothing happens.",
              .example = "LD X9.0\nFUNC 29\nPRM 0001\nPRM D10\nPRM 85\nPRM D11"},
     .lower = &lowerLogic,
     .variant = static_cast<int>(ir::OpCode::Xor)},
    {.info = {.mnemonic = "ANDF",
              .title = "and of bytes",
              .group = "logic",
              .number = 30,
              .pins = {kAct},
              .operands = {kFormatA, in("A", Kind::Data), in("B", Kind::ConstantOrData), out("C", Kind::Data)},
              .ref = "5.31, l.2621",
              .doc = "C := A and B. ACT=0: nothing happens.",
              .example = "LD X9.0\nFUNC 30\nPRM 0001\nPRM D10\nPRM 85\nPRM D11"},
     .lower = &lowerLogic,
     .variant = static_cast<int>(ir::OpCode::And)},
    {.info = {.mnemonic = "ORF",
              .title = "or of bytes",
              .group = "logic",
              .number = 31,
              .pins = {kAct},
              .operands = {kFormatA, in("A", Kind::Data), in("B", Kind::ConstantOrData), out("C", Kind::Data)},
              .ref = "5.32, l.2676",
              .doc = "C := A or B. ACT=0: nothing happens.",
              .example = "LD X9.0\nFUNC 31\nPRM 0001\nPRM D10\nPRM 85\nPRM D11"},
     .lower = &lowerLogic,
     .variant = static_cast<int>(ir::OpCode::Or)},
    {.info = {.mnemonic = "NOT",
              .title = "complement of bytes",
              .group = "logic",
              .number = 32,
              .pins = {kAct},
              .operands = {kFormat, in("A", Kind::Data), out("B", Kind::Data)},
              .ref = "5.33, l.2732",
              .doc = "B := not A. ACT=0: nothing happens.",
              .example = "LD X9.0\nFUNC 32\nPRM 1\nPRM D10\nPRM D11"},
     .lower = &lowerNot},

    {.info = {.mnemonic = "COM",
              .title = "common line",
              .group = "regions",
              .number = 33,
              .pins = {kAct},
              .ref = "5.34, l.2782",
              .doc = "ACT=0: until COME every OUT becomes 0 and every OUTI 1, whatever its condition; SET and RST do "
                     "nothing; functions run as usual and "
                     "only the coils behind them are forced (P41). ACT=1: no effect.",
              .example = "LD X9.0\nFUNC 33"},
     .control = Control::Com,
     .lower = &lowerCommonLine},
    {.info = {.mnemonic = "COME",
              .title = "end of a common line",
              .group = "regions",
              .number = 34,
              .placement = Placement::AtRail,
              .ref = "5.35, l.2811",
              .doc = "Ends the region of COM.",
              .example = "FUNC 34"},
     .control = Control::Come,
     .lower = &lowerMark},
    {.info = {.mnemonic = "JMP",
              .title = "jump over a region",
              .group = "jumps",
              .number = 35,
              .pins = {kAct},
              .operands = {number("coils", 0, 0, "number of coils: always 0")},
              .ref = "5.36, l.2829",
              .doc = "ACT=1: everything up to JMPE is not executed; coils keep their state, timers stand still (P19). "
                     "Regions do not nest (P42).",
              .example = "LD X9.0\nFUNC 35\nPRM 0"},
     .control = Control::Jmp,
     .lower = &lowerJump},
    {.info = {.mnemonic = "JMPE",
              .title = "end of a jumped region",
              .group = "jumps",
              .number = 36,
              .placement = Placement::AtRail,
              .ref = "5.37, l.2861",
              .doc = "Ends the region of JMP.",
              .example = "FUNC 36"},
     .control = Control::Jmpe,
     .lower = &lowerMark},
    {.info = {.mnemonic = "CALL",
              .title = "conditional call",
              .group = "subprograms",
              .number = 37,
              .pins = {kAct},
              .operands = {kSubprogram},
              .ref = "5.38, l.2879",
              .doc = "ACT=1: runs the subprogram, then goes on behind the call. Coils of a subprogram that is not "
                     "called keep their state.",
              .example = "LD X9.0\nFUNC 37\nPRM P1"},
     .control = Control::Call,
     .lower = &lowerCall},
    {.info = {.mnemonic = "CALLU",
              .title = "call",
              .group = "subprograms",
              .number = 38,
              .operands = {kSubprogram},
              .placement = Placement::AtRail,
              .ref = "5.39, l.2917",
              .doc = "Runs the subprogram in every scan.",
              .example = "FUNC 38\nPRM P1"},
     .control = Control::CallU,
     .lower = &lowerCall},
    {.info = {.mnemonic = "JMPB",
              .title = "jump to a label",
              .group = "jumps",
              .number = 39,
              .pins = {kAct},
              .operands = {kLabel},
              .ref = "5.40, l.2940",
              .doc = "ACT=1: goes on at the label, forward or backward, in the same level or subprogram. A loop that "
                     "does not end is stopped with the fault "
                     "dead-loop (P6).",
              .example = "LD X9.0\nFUNC 39\nPRM L1"},
     .control = Control::Jmpb,
     .lower = &lowerJump},
    {.info = {.mnemonic = "JMPC",
              .title = "jump out of subprograms",
              .group = "jumps",
              .number = 40,
              .pins = {kAct},
              .operands = {kLabel},
              .tasks = "subprograms of Level 2",
              .ref = "5.41, l.2982",
              .doc = "ACT=1: leaves all subprograms and goes on at a label of the Level 2 main program (P43).",
              .example = "LD X9.0\nFUNC 40\nPRM L1"},
     .control = Control::Jmpc,
     .lower = &lowerLeave},
    {.info = {.mnemonic = "LBL",
              .title = "label",
              .group = "jumps",
              .number = 41,
              .operands = {kLabel},
              .placement = Placement::Anywhere,
              .ref = "5.42, l.3016",
              .doc = "The place that JMPB and JMPC lead to. A number stands once in the whole program (P44). A "
                     "condition in front has no effect (P13).",
              .example = "FUNC 41\nPRM L1"},
     .control = Control::Lbl,
     .lower = &lowerMark},
    {.info = {.mnemonic = "SP",
              .title = "begin of a subprogram",
              .group = "subprograms",
              .number = 42,
              .operands = {kSubprogram},
              .placement = Placement::AtRail,
              .tasks = "behind END2",
              .ref = "5.43, l.3040",
              .doc = "Begins a subprogram. A condition in front has no effect (P13).",
              .example = "FUNC 42\nPRM P1"},
     .control = Control::Sp,
     .lower = &lowerMark},
    {.info = {.mnemonic = "SPE",
              .title = "end of a subprogram",
              .group = "subprograms",
              .number = 43,
              .placement = Placement::AtRail,
              .tasks = "behind END2",
              .ref = "5.44, l.3069",
              .doc = "Returns to the caller.",
              .example = "FUNC 43"},
     .control = Control::Spe,
     .lower = &lowerEnd},

    {.info = {.mnemonic = "WINDR",
              .title = "window, read",
              .group = "window",
              .number = 44,
              .pins = {kAct},
              .operands = {in("control data", Kind::Byte, "10 bytes and the data"), out("result", Kind::Byte)},
              .output = Output::Always,
              .stateful = true,
              .ref = "5.45, l.3089",
              .doc = "Reads data of the CNC through a control block."}},
    {.info = {.mnemonic = "WINDW",
              .title = "window, write",
              .group = "window",
              .number = 45,
              .pins = {kAct},
              .operands = {in("control data", Kind::Byte, "10 bytes and the data"), out("result", Kind::Byte)},
              .output = Output::Always,
              .stateful = true,
              .ref = "5.46, l.3148",
              .doc = "Writes data of the CNC through a control block."}},
    {.info = {.mnemonic = "AXLCTL",
              .title = "axis control",
              .group = "axis control",
              .number = 46,
              .pins = {kRst, kAct},
              .operands = {number("group", 1, 8), in("control data", Kind::Byte, "8 bytes"), out("result", Kind::Byte)},
              .output = Output::Always,
              .stateful = true,
              .ref = "5.47, l.3241",
              .doc = "Hands a command to an axis of the PLC."}},
    {.info = {.mnemonic = "PSGNL",
              .title = "position signals",
              .group = "position",
              .number = 48,
              .pins = {kAct},
              .operands = {in("zones", Kind::Byte, "29 bytes"), out("area", Kind::Byte), out("result", Kind::Byte)},
              .ref = "5.48, l.3397",
              .doc = "Tells in which zone a machine position lies."}},
    {.info = {.mnemonic = "PSGN2",
              .title = "position signal",
              .group = "position",
              .number = 49,
              .pins = {kAct},
              .operands = {in("zone", Kind::Byte), out("result", Kind::Byte)},
              .output = Output::Always,
              .stateful = true,
              .ref = "5.49, l.3490",
              .doc = "Tells whether a machine position lies in a zone."}},
};
constexpr size_t kRowCount = std::size(kRows);

constexpr bool rowsAreSound() {
  int last = -1;
  for (const Row& row : kRows) {
    if (row.info.mnemonic.empty() || row.info.title.empty() || row.info.doc.empty() || row.info.ref.empty())
      return false;
    if (row.info.number >= 0 && row.info.number <= last) return false; // functions in the order of their numbers
    if (row.info.number >= 0) last = row.info.number;
    if (row.info.number >= 0 && row.lower != nullptr && row.info.example.empty()) return false;
    for (const OperandInfo& operand : row.info.operands.all())
      if (std::find(kKindNames.begin(), kKindNames.end(), operand.kind) == kKindNames.end()) return false;
  }
  return true;
}
static_assert(rowsAreSound(), "a row lacks a text, stands out of order or names an unknown kind of operand");

constexpr std::array<const InstructionInfo*, kRowCount> infoPointers() {
  std::array<const InstructionInfo*, kRowCount> result{};
  for (size_t i = 0; i < kRowCount; ++i) result[i] = &kRows[i].info;
  return result;
}
constexpr std::array<const InstructionInfo*, kRowCount> kInfos = infoPointers();

// The names of all pins, one behind the other, so that furtherPinsOf can give a span of them.
struct PinNames {
  std::array<std::array<std::string_view, 6>, kRowCount> names{};
};
constexpr PinNames pinNames() {
  PinNames result;
  for (size_t i = 0; i < kRowCount; ++i)
    for (size_t pin = 0; pin < kRows[i].info.pins.size(); ++pin) result.names[i][pin] = kRows[i].info.pins[pin].name;
  return result;
}
constexpr PinNames kPinNames = pinNames();

constexpr int kFunctionNumbers = 50;
constexpr std::array<const Row*, kFunctionNumbers> rowsByNumber() {
  std::array<const Row*, kFunctionNumbers> result{};
  for (const Row& row : kRows)
    if (row.info.number >= 0) result[static_cast<size_t>(row.info.number)] = &row;
  return result;
}
constexpr std::array<const Row*, kFunctionNumbers> kByNumber = rowsByNumber();

} // namespace

std::span<const Row> allRows() { return kRows; }

const Row* findFunction(uint64_t number) { return number < kFunctionNumbers ? kByNumber[number] : nullptr; }

const Row* findFunction(std::string_view mnemonic) {
  for (const Row& row : kRows)
    if (row.info.number >= 0 && equalNoCase(row.info.mnemonic, mnemonic)) return &row;
  return nullptr;
}

std::span<const std::string_view> furtherPinsOf(const Row& row) {
  const size_t count = row.info.pins.size();
  if (count < 2) return {};
  return std::span(kPinNames.names[static_cast<size_t>(&row - kRows)]).subspan(1, count - 1);
}

std::span<const InstructionInfo* const> instructionInfos() { return kInfos; }

} // namespace rung::gsk
