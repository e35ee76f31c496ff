// The tables of a rung_program as LLVM constants, by walking the field lists of ir/image/abi_fields.h.
#pragma once
#include "rung/program.h"

namespace llvm {
class Constant;
class Module;
} // namespace llvm

namespace rung::codegen {

// Adds the exported constant rung_program_table and all that it points to. `chunkTable` is the array of chunk
// functions.
void addProgramTables(llvm::Module& module, const rung_program& program, llvm::Constant* chunkTable);

} // namespace rung::codegen
