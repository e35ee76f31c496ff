// See block_bytes.h.
#include "rtlib/load/block_bytes.h"

namespace rung::runtime {

BlockBytes readBytes(const rung_program& program) {
  BlockBytes bytes(program.memory_size);
  for (const rung_span& span : std::span(program.reads, program.read_count)) mark(bytes, span.offset, span.size);
  return bytes;
}

BlockBytes chunkBytes(const rung_program& program) {
  BlockBytes bytes(program.memory_size);
  for (const rung_written& written : std::span(program.writes, program.write_count))
    mark(bytes, written.offset, written.size);
  return bytes;
}

BlockBytes writtenBytes(const rung_program& program) {
  BlockBytes bytes = chunkBytes(program);
  for (const rung_copy& copy : std::span(program.copies, program.copy_count)) mark(bytes, copy.to, copy.size);
  return bytes;
}

BlockBytes bitBytes(const rung_program& program) {
  BlockBytes bytes(program.memory_size);
  eachBits(program, [&](size_t offset, size_t count) { mark(bytes, offset, count); });
  return bytes;
}

} // namespace rung::runtime
