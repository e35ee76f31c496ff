// The tables of a rung_program, made from a module and its layout, with their storage. The interpreter and the JIT use
// the image as it is; the emitters print it as C++ text or LLVM constants by walking abi_fields.h. chunk_fns is
// null here: whoever owns code fills it in.
#pragma once
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "ir/layout/layout.h"

namespace rung::ir {

class ProgramImage {
public:
  // `codeHash` names the code that will run (ir::hashOf its module); the image copies what it needs.
  ProgramImage(const Layout& layout, uint64_t codeHash);
  ProgramImage(const ProgramImage&) = delete;
  ProgramImage& operator=(const ProgramImage&) = delete;

  const rung_program& program() const { return program_; }
  rung_program& program() { return program_; }

private:
  friend class ImageBuilder;
  rung_program program_{};
  std::deque<std::string> strings_;
  std::deque<std::vector<rung_range>> ranges_;
  std::deque<std::vector<uint8_t>> initData_;
  std::vector<rung_space> spaces_;
  std::vector<rung_symbol> symbols_;
  std::vector<rung_slot> slots_;
  std::deque<std::vector<const char*>> points_;
  std::vector<rung_continuation> continuations_;
  std::vector<rung_init> inits_;
  std::vector<rung_span> retains_;
  std::vector<rung_span> safeSpans_;
  std::vector<rung_copy> copies_;
  std::vector<rung_chunk> chunks_;
  std::vector<rung_rung_info> rungs_;
  std::vector<rung_task> tasks_;
  std::vector<uint32_t> partEnds_;
  std::vector<rung_step> scan_;
  std::vector<rung_step> fast_;
  std::vector<rung_step> slices_;
  std::vector<const char*> routines_;
  std::vector<const char*> files_;
  std::vector<const char*> faults_;
  std::vector<const char*> services_;
  std::vector<rung_message_text> texts_;
  std::vector<rung_written> writes_;
  std::vector<rung_span> reads_;
  std::vector<uint32_t> changes_;
};

} // namespace rung::ir
