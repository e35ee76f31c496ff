// The memory of a program (see loaded_program.h).
#include "rtlib/host/loaded_program.h"

#include <algorithm>
#include <cstring>
#include <new>

namespace rung::host {

namespace {

uint32_t blockBytes(const rung_program& program) { return std::max(program.memory_size, rt::Memory::kLeastBlock); }

// At least a cache line.
uint32_t alignOf(const rung_program& program) { return std::max(program.memory_align, 64u); }

uint32_t retainedBytes(const rung_program& program) {
  uint32_t sum = 0;
  for (uint32_t i = 0; i < program.retain_count; ++i) sum += program.retains[i].size;
  return sum;
}

} // namespace

void LoadedProgram::FreeBlock::operator()(uint8_t* bytes) const { ::operator delete(bytes, std::align_val_t{align}); }

LoadedProgram::LoadedProgram(const rung_program& loaded, void* context)
    : program(&loaded), engine(context),
      block(static_cast<uint8_t*>(::operator new(blockBytes(loaded), std::align_val_t{alignOf(loaded)})),
            FreeBlock{alignOf(loaded)}),
      profile(loaded.instrumented != 0 ? loaded.rung_count : 0), parts(loaded.task_count),
      retained(retainedBytes(loaded)), overwritten(loaded) {
  clear();
}

void LoadedProgram::clear() noexcept {
  std::memset(block.get(), 0, program->memory_size);
  for (uint32_t i = 0; i < program->init_count; ++i)
    std::memcpy(block.get() + program->inits[i].offset, program->inits[i].data, program->inits[i].size);
}

} // namespace rung::host
