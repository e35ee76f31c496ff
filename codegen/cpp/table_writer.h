// Writes the tables of a rung_program as C++ constants, by walking the field lists of ir/image/abi_fields.h.
#pragma once
#include <string>

#include "rung/program.h"

namespace rung::codegen {

// Appends the constants and, last, the exported `rung_program_table`. `chunkTable` names the array of chunk functions.
void writeTables(const rung_program& program, std::string_view chunkTable, std::string& out);

// A C++ string literal of the text, in ASCII.
std::string cppString(std::string_view text);

} // namespace rung::codegen
