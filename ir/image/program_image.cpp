// The tables of a program, filled and joined (see program_image.h).
#include "ir/image/program_image.h"

#include "rtlib/text/version.h"

namespace rung::ir {
namespace {

template <class T>
void point(const std::vector<T>& from, const T*& to, uint32_t& count) {
  to = from.empty() ? nullptr : from.data();
  count = static_cast<uint32_t>(from.size());
}
void pointTexts(const std::vector<const char*>& from, const char* const*& to, uint32_t& count) {
  to = from.empty() ? nullptr : from.data();
  count = static_cast<uint32_t>(from.size());
}

void link(rung_program& p, const ImageTables& tables) {
  point(tables.spaces, p.spaces, p.space_count);
  point(tables.symbols, p.symbols, p.symbol_count);
  point(tables.slots, p.slots, p.slot_count);
  point(tables.continuations, p.continuations, p.continuation_count);
  point(tables.inits, p.inits, p.init_count);
  point(tables.retains, p.retains, p.retain_count);
  point(tables.safeSpans, p.safe_spans, p.safe_count);
  point(tables.copies, p.copies, p.copy_count);
  point(tables.chunks, p.chunks, p.chunk_count);
  point(tables.rungs, p.rungs, p.rung_count);
  point(tables.tasks, p.tasks, p.task_count);
  point(tables.partEnds, p.part_ends, p.part_end_count);
  point(tables.scan, p.scan, p.scan_count);
  point(tables.fast, p.fast, p.fast_count);
  point(tables.slices, p.slices, p.slice_count);
  pointTexts(tables.routines, p.routines, p.routine_count);
  pointTexts(tables.files, p.files, p.file_count);
  pointTexts(tables.faults, p.faults, p.fault_count);
  pointTexts(tables.services, p.services, p.service_count);
  point(tables.texts, p.texts, p.text_count);
  point(tables.writes, p.writes, p.write_count);
  point(tables.reads, p.reads, p.read_count);
  point(tables.changes, p.changes, p.change_count);
}

} // namespace

ProgramImage::ProgramImage(const Layout& layout, uint64_t codeHash) {
  const Module& module = layout.module();
  rung_program& p = program_;
  p.size = sizeof(rung_program); // here; FieldKind::OwnSize
  p.abi_version = RUNG_ABI_VERSION;
  p.name = tables_.text(module.name);
  p.dialect = tables_.text(module.dialect);
  p.compiler = text::compilerName();
  p.layout_hash = layout.memory().hash();
  p.code_hash = codeHash;
  p.memory_size = layout.memory().size();
  p.memory_align = kBlockAlign;
  p.instrumented = module.instrumented ? 1 : 0;
  p.main_task = module.mainTask.index;
  p.fast_task = module.fastTask.index;
  fillMemoryTables(tables_, layout);
  fillTaskTables(tables_, layout);
  fillRungTables(tables_, layout);
  link(p, tables_);
}

} // namespace rung::ir
