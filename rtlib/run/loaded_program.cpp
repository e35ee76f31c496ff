// The memory of a program (see loaded_program.h).
#include "rtlib/run/loaded_program.h"

#include <algorithm>
#include <cstring>
#include <new>

namespace rung::runtime {

namespace {

uint32_t bytesFor(const Runnable& runnable, uint32_t leastBytes) {
  const uint32_t size = std::max(runnable.program.memory_size, core::Memory::kLeastBlock);
  return runnable.memory != nullptr ? size : std::max(size + size / 8, leastBytes);
}

// At least a cache line.
uint32_t alignOf(const rung_program& program) { return std::max(program.memory_align, 64u); }

std::unique_ptr<uint8_t, LoadedProgram::FreeBlock> blockFor(const Runnable& runnable, uint32_t bytes) {
  using FreeBlock = LoadedProgram::FreeBlock;
  if (runnable.memory != nullptr) return {runnable.memory, FreeBlock{0}};
  const uint32_t align = alignOf(runnable.program);
  return {static_cast<uint8_t*>(::operator new(bytes, std::align_val_t{align})), FreeBlock{align}};
}

uint32_t retainedBytes(const rung_program& program) {
  uint32_t sum = 0;
  for (uint32_t i = 0; i < program.retain_count; ++i) sum += program.retains[i].size;
  return sum;
}

} // namespace

void LoadedProgram::FreeBlock::operator()(uint8_t* bytes) const {
  if (align != 0) ::operator delete(bytes, std::align_val_t{align});
}

LoadedProgram::LoadedProgram(const Runnable& runnable, uint32_t leastBytes)
    : program(&runnable.program), engine(runnable.engine),
      services(runnable.services != nullptr ? runnable.services : program->services),
      blockBytes(bytesFor(runnable, leastBytes)), block(blockFor(runnable, blockBytes)),
      profile(program->instrumented != 0 ? program->rung_count : 0), parts(program->task_count),
      steps(program->scan_count), retained(retainedBytes(*program)), overwritten(*program),
      copyLists(std::make_shared<const CopyLists>(*program, runnable.memory != nullptr)),
      neededCopies(copyLists->views()) {
  clear();
}

void LoadedProgram::clear() noexcept {
  std::memset(block.get(), 0, program->memory_size);
  for (uint32_t i = 0; i < program->init_count; ++i)
    std::memcpy(block.get() + program->inits[i].offset, program->inits[i].data, program->inits[i].size);
}

} // namespace rung::runtime
