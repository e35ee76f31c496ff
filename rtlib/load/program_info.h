// Look-ups in the tables of a rung_program, and the check before it is used: a program that passes checkProgram can be
// run without further checks of its tables.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "rung/program.h"

namespace rung::runtime {

class MappedFile;

// Returns the first error of the tables, with its entry; "" if there is none. Takes time in proportion to the tables,
// and allocates. The code is not checked: a program can still write anywhere.
//
// `file`: the memory that must contain its tables, texts and code; null: this is not checked.
std::string checkProgram(const rung_program& program, const MappedFile* file = nullptr);

// Indices by name; RUNG_NONE if there is none.
uint32_t findSpace(const rung_program& program, std::string_view name);
uint32_t findTask(const rung_program& program, std::string_view name);
uint32_t findService(const rung_program& program, std::string_view name);

// The symbol with exactly this name, and the first one whose name is not less than `name` (in byte order, as the
// table). Null if there is none.
const rung_symbol* findSymbol(const rung_program& program, std::string_view name);
const rung_symbol* firstSymbolFrom(const rung_program& program, std::string_view name);

// The logical byte of a space at an offset of the memory block, which holds the byte or one of its bits; nothing for a
// slot of the compiler.
struct LogicalByte {
  uint32_t space = RUNG_NONE;
  uint32_t byte = 0;
};
std::optional<LogicalByte> byteAt(const rung_program& program, uint32_t offset);

// Of the memory block.
uint32_t slotBytes(const rung_slot& slot);

std::string_view serviceName(const rung_program& program, uint32_t service); // "" when there is none
std::string_view messageText(const rung_program& program, uint32_t number);  // "" when there is none

// The sum of the ADVANCE steps of a list.
uint64_t advanceUs(std::span<const rung_step> steps);
// The duration of one scan: the sum of its ADVANCE steps, or without these the main task's period.
uint64_t scanPeriodUs(const rung_program& program);

// `rung 3 "title", main.pmc:12`, or `LEVEL1, main.pmc:12` for a rung that is not drawn; line 0 means the rung's first
// line.
std::string rungText(const rung_program& program, uint32_t rung, uint32_t line = 0);
inline constexpr std::string_view kOverrunText = "overrun: this machine is too slow for the program";
// `dead-loop (rung 3 "title", main.pmc:12)`; "" when there is no fault.
std::string faultText(const rung_program& program, const rung_fault& fault);

} // namespace rung::runtime
