// The tables of a rung_program, made from a module and its layout, with their storage. The interpreter and the JIT use
// the image directly; the emitters print it as C++ text or LLVM constants by walking abi_fields.h. chunk_fns is null
// here; the engine that runs the image sets it.
#pragma once
#include <deque>
#include <string>
#include <vector>

#include "ir/shape/layout.h"

namespace rung::ir {

// The tables with their storage.
struct ImageTables {
  std::deque<std::string> strings;
  std::deque<std::vector<rung_range>> ranges;
  std::deque<std::vector<uint8_t>> initData;
  std::deque<std::vector<const char*>> points;
  std::deque<std::vector<uint32_t>> units;
  // Memory of the program.
  std::vector<rung_space> spaces;
  std::vector<rung_symbol> symbols;
  std::vector<rung_slot> slots;
  std::vector<rung_continuation> continuations;
  std::vector<rung_timer> timers;
  std::vector<rung_init> inits;
  std::vector<rung_span> retains;
  std::vector<rung_span> safeSpans;
  std::vector<rung_written> writes;
  // Tasks and the schedule.
  std::vector<rung_task> tasks;
  std::vector<rung_copy> copies;
  std::vector<uint32_t> partEnds;
  std::vector<rung_span> reads;
  std::vector<uint32_t> changes;
  std::vector<rung_chunk> chunks;
  std::vector<rung_step> scan;
  std::vector<rung_step> fast;
  std::vector<rung_step> slices;
  // Texts for output.
  std::vector<rung_info> rungs;
  std::vector<const char*> routines;
  std::vector<const char*> files;
  std::vector<const char*> faults;
  std::vector<const char*> services;
  std::vector<rung_message_text> texts;

  // A copy of the text that lives as long as the tables.
  const char* text(const std::string& s) { return strings.emplace_back(s).c_str(); }
};

class ProgramImage {
public:
  // `codeHash` identifies the code that will run (hashOf its module); the image copies what it needs.
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
