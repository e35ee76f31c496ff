// The tables of a rung_program, made from a module and its layout, with their storage. The interpreter and the JIT use
// the image as it is; the emitters print it as C++ text or LLVM constants by walking abi_fields.h. chunk_fns is
// null here; the engine that runs the image sets it.
#pragma once
#include "ir/image/image_tables.h"

namespace rung::ir {

class ProgramImage {
public:
  // `codeHash` names the code that will run (hashOf its module); the image copies what it needs.
  ProgramImage(const Layout& layout, uint64_t codeHash);
  ProgramImage(const ProgramImage&) = delete;
  ProgramImage& operator=(const ProgramImage&) = delete;

  const rung_program& program() const { return program_; }
  rung_program& program() { return program_; }

private:
  rung_program program_{};
  ImageTables tables_;
};

} // namespace rung::ir
