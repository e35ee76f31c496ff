// The field lists (see abi_fields.h).
#include "ir/image/abi_fields.h"

#include <algorithm>

namespace rung::ir {
namespace {

// Private to this file: a row names its field once, struct and member.
#define RUNG_FIELD(st, member, kind)                                                                                   \
  FieldInfo { #member, FieldKind::kind, offsetof(st, member) }
#define RUNG_ARRAY(st, member, counter, kind)                                                                          \
  FieldInfo { #member, FieldKind::kind, offsetof(st, member), offsetof(st, counter) }
#define RUNG_STRUCTS(st, member, counter, info)                                                                        \
  FieldInfo { #member, FieldKind::Structs, offsetof(st, member), offsetof(st, counter), &(info) }

constexpr FieldInfo kRangeFields[] = {RUNG_FIELD(rung_range, first_byte, U32), RUNG_FIELD(rung_range, byte_count, U32),
                                      RUNG_FIELD(rung_range, offset, U32), RUNG_FIELD(rung_range, repr, U32)};
constexpr StructInfo kRange{"rung_range", sizeof(rung_range), kRangeFields};

constexpr FieldInfo kSpaceFields[] = {
    RUNG_FIELD(rung_space, name, Text),       RUNG_FIELD(rung_space, unit_bytes, U32),
    RUNG_FIELD(rung_space, byte_count, U32),  RUNG_FIELD(rung_space, flags, U32),
    RUNG_FIELD(rung_space, range_count, U32), RUNG_STRUCTS(rung_space, ranges, range_count, kRange)};
constexpr StructInfo kSpace{"rung_space", sizeof(rung_space), kSpaceFields};

constexpr FieldInfo kSymbolFields[] = {
    RUNG_FIELD(rung_symbol, name, Text), RUNG_FIELD(rung_symbol, comment, Text), RUNG_FIELD(rung_symbol, space, U32),
    RUNG_FIELD(rung_symbol, byte, U32),  RUNG_FIELD(rung_symbol, bit, U32),      RUNG_FIELD(rung_symbol, type, U32),
    RUNG_FIELD(rung_symbol, count, U32), RUNG_FIELD(rung_symbol, flags, U32),    RUNG_FIELD(rung_symbol, value, I64),
    RUNG_FIELD(rung_symbol, reach, U32), RUNG_FIELD(rung_symbol, rung, U32)};
constexpr StructInfo kSymbol{"rung_symbol", sizeof(rung_symbol), kSymbolFields};

constexpr FieldInfo kSlotFields[] = {RUNG_FIELD(rung_slot, key, Text), RUNG_FIELD(rung_slot, offset, U32),
                                     RUNG_FIELD(rung_slot, type, U32), RUNG_FIELD(rung_slot, rung, U32),
                                     RUNG_FIELD(rung_slot, reserved, U32)};
constexpr StructInfo kSlot{"rung_slot", sizeof(rung_slot), kSlotFields};

constexpr FieldInfo kContinuationFields[] = {
    RUNG_FIELD(rung_continuation, key, Text), RUNG_FIELD(rung_continuation, offset, U32),
    RUNG_FIELD(rung_continuation, point_count, U32), RUNG_ARRAY(rung_continuation, points, point_count, Texts)};
constexpr StructInfo kContinuation{"rung_continuation", sizeof(rung_continuation), kContinuationFields};

constexpr FieldInfo kTimerFields[] = {RUNG_FIELD(rung_timer, name, Text),
                                      RUNG_FIELD(rung_timer, preset, I64),
                                      RUNG_ARRAY(rung_timer, units, unit_count, U32s),
                                      RUNG_FIELD(rung_timer, unit_count, U32),
                                      RUNG_FIELD(rung_timer, flags, U32),
                                      RUNG_FIELD(rung_timer, rung, U32),
                                      RUNG_FIELD(rung_timer, time_us, U32),
                                      RUNG_FIELD(rung_timer, time_type, U32),
                                      RUNG_FIELD(rung_timer, time_space, U32),
                                      RUNG_FIELD(rung_timer, time_at, U32),
                                      RUNG_FIELD(rung_timer, running_at, U32),
                                      RUNG_FIELD(rung_timer, preset_type, U32),
                                      RUNG_FIELD(rung_timer, preset_space, U32),
                                      RUNG_FIELD(rung_timer, preset_at, U32),
                                      RUNG_FIELD(rung_timer, unit_type, U32),
                                      RUNG_FIELD(rung_timer, unit_space, U32),
                                      RUNG_FIELD(rung_timer, unit_at, U32)};
constexpr StructInfo kTimer{"rung_timer", sizeof(rung_timer), kTimerFields};

constexpr FieldInfo kInitFields[] = {RUNG_FIELD(rung_init, offset, U32), RUNG_FIELD(rung_init, size, U32),
                                     RUNG_ARRAY(rung_init, data, size, Bytes)};
constexpr StructInfo kInit{"rung_init", sizeof(rung_init), kInitFields};

constexpr FieldInfo kMessageTextFields[] = {RUNG_FIELD(rung_message_text, number, U32),
                                            RUNG_FIELD(rung_message_text, reserved, U32),
                                            RUNG_FIELD(rung_message_text, text, Text)};
constexpr StructInfo kMessageText{"rung_message_text", sizeof(rung_message_text), kMessageTextFields};

constexpr FieldInfo kSpanFields[] = {RUNG_FIELD(rung_span, offset, U32), RUNG_FIELD(rung_span, size, U32)};
constexpr StructInfo kSpan{"rung_span", sizeof(rung_span), kSpanFields};

constexpr FieldInfo kWrittenFields[] = {RUNG_FIELD(rung_written, offset, U32), RUNG_FIELD(rung_written, size, U32),
                                        RUNG_FIELD(rung_written, mask, U32)};
constexpr StructInfo kWritten{"rung_written", sizeof(rung_written), kWrittenFields};

constexpr FieldInfo kCopyFields[] = {RUNG_FIELD(rung_copy, kind, U32), RUNG_FIELD(rung_copy, from, U32),
                                     RUNG_FIELD(rung_copy, to, U32), RUNG_FIELD(rung_copy, mask, U32),
                                     RUNG_FIELD(rung_copy, size, U32)};
constexpr StructInfo kCopy{"rung_copy", sizeof(rung_copy), kCopyFields};

constexpr FieldInfo kChunkFields[] = {RUNG_FIELD(rung_chunk, first_rung, U32), RUNG_FIELD(rung_chunk, rung_count, U32),
                                      RUNG_FIELD(rung_chunk, weight, U32)};
constexpr StructInfo kChunk{"rung_chunk", sizeof(rung_chunk), kChunkFields};

constexpr FieldInfo kRungFields[] = {RUNG_FIELD(rung_info, title, Text),     RUNG_FIELD(rung_info, file, U32),
                                     RUNG_FIELD(rung_info, first_line, U32), RUNG_FIELD(rung_info, last_line, U32),
                                     RUNG_FIELD(rung_info, routine, U32),    RUNG_FIELD(rung_info, key, U64),
                                     RUNG_FIELD(rung_info, number, U32),     RUNG_FIELD(rung_info, copy, U32)};
constexpr StructInfo kRung{"rung_info", sizeof(rung_info), kRungFields};

constexpr FieldInfo kTaskFields[] = {
    RUNG_FIELD(rung_task, name, Text),           RUNG_FIELD(rung_task, entry, U32),
    RUNG_FIELD(rung_task, period_us, U32),       RUNG_FIELD(rung_task, budget, U32),
    RUNG_FIELD(rung_task, budget_fault, U32),    RUNG_FIELD(rung_task, begin_first, U32),
    RUNG_FIELD(rung_task, begin_count, U32),     RUNG_FIELD(rung_task, end_first, U32),
    RUNG_FIELD(rung_task, end_count, U32),       RUNG_FIELD(rung_task, part_first, U32),
    RUNG_FIELD(rung_task, part_count, U32),      RUNG_FIELD(rung_task, longest, U32),
    RUNG_FIELD(rung_task, loops, U32),           RUNG_FIELD(rung_task, read_first, U32),
    RUNG_FIELD(rung_task, read_count, U32),      RUNG_FIELD(rung_task, change_first, U32),
    RUNG_FIELD(rung_task, change_count, U32),    RUNG_FIELD(rung_task, loop_free_chunk, U32),
    RUNG_FIELD(rung_task, loop_free_weight, U32)};
constexpr StructInfo kTask{"rung_task", sizeof(rung_task), kTaskFields};

constexpr FieldInfo kStepFields[] = {RUNG_FIELD(rung_step, op, U32), RUNG_FIELD(rung_step, task, U32),
                                     RUNG_FIELD(rung_step, arg, U32)};
constexpr StructInfo kStep{"rung_step", sizeof(rung_step), kStepFields};

constexpr FieldInfo kProgramFields[] = {RUNG_FIELD(rung_program, size, OwnSize),
                                        RUNG_FIELD(rung_program, abi_version, U32),
                                        RUNG_FIELD(rung_program, name, Text),
                                        RUNG_FIELD(rung_program, dialect, Text),
                                        RUNG_FIELD(rung_program, compiler, Text),
                                        RUNG_FIELD(rung_program, layout_hash, U64),
                                        RUNG_FIELD(rung_program, code_hash, U64),
                                        RUNG_FIELD(rung_program, memory_size, U32),
                                        RUNG_FIELD(rung_program, memory_align, U32),
                                        RUNG_FIELD(rung_program, instrumented, U32),
                                        RUNG_FIELD(rung_program, main_task, U32),
                                        RUNG_FIELD(rung_program, fast_task, U32),
                                        RUNG_FIELD(rung_program, space_count, U32),
                                        RUNG_FIELD(rung_program, symbol_count, U32),
                                        RUNG_FIELD(rung_program, init_count, U32),
                                        RUNG_FIELD(rung_program, retain_count, U32),
                                        RUNG_FIELD(rung_program, safe_count, U32),
                                        RUNG_FIELD(rung_program, copy_count, U32),
                                        RUNG_FIELD(rung_program, chunk_count, U32),
                                        RUNG_FIELD(rung_program, rung_count, U32),
                                        RUNG_FIELD(rung_program, routine_count, U32),
                                        RUNG_FIELD(rung_program, file_count, U32),
                                        RUNG_FIELD(rung_program, task_count, U32),
                                        RUNG_FIELD(rung_program, part_end_count, U32),
                                        RUNG_FIELD(rung_program, scan_count, U32),
                                        RUNG_FIELD(rung_program, fast_count, U32),
                                        RUNG_FIELD(rung_program, slice_count, U32),
                                        RUNG_FIELD(rung_program, fault_count, U32),
                                        RUNG_FIELD(rung_program, service_count, U32),
                                        RUNG_FIELD(rung_program, text_count, U32),
                                        RUNG_FIELD(rung_program, slot_count, U32),
                                        RUNG_FIELD(rung_program, continuation_count, U32),
                                        RUNG_FIELD(rung_program, timer_count, U32),
                                        RUNG_FIELD(rung_program, write_count, U32),
                                        RUNG_FIELD(rung_program, read_count, U32),
                                        RUNG_FIELD(rung_program, change_count, U32),
                                        RUNG_STRUCTS(rung_program, spaces, space_count, kSpace),
                                        RUNG_STRUCTS(rung_program, symbols, symbol_count, kSymbol),
                                        RUNG_STRUCTS(rung_program, slots, slot_count, kSlot),
                                        RUNG_STRUCTS(rung_program, continuations, continuation_count, kContinuation),
                                        RUNG_STRUCTS(rung_program, timers, timer_count, kTimer),
                                        RUNG_STRUCTS(rung_program, inits, init_count, kInit),
                                        RUNG_STRUCTS(rung_program, retains, retain_count, kSpan),
                                        RUNG_STRUCTS(rung_program, safe_spans, safe_count, kSpan),
                                        RUNG_STRUCTS(rung_program, copies, copy_count, kCopy),
                                        RUNG_STRUCTS(rung_program, chunks, chunk_count, kChunk),
                                        RUNG_STRUCTS(rung_program, rungs, rung_count, kRung),
                                        RUNG_ARRAY(rung_program, routines, routine_count, Texts),
                                        RUNG_ARRAY(rung_program, files, file_count, Texts),
                                        RUNG_STRUCTS(rung_program, tasks, task_count, kTask),
                                        RUNG_ARRAY(rung_program, part_ends, part_end_count, U32s),
                                        RUNG_STRUCTS(rung_program, scan, scan_count, kStep),
                                        RUNG_STRUCTS(rung_program, fast, fast_count, kStep),
                                        RUNG_STRUCTS(rung_program, slices, slice_count, kStep),
                                        RUNG_ARRAY(rung_program, faults, fault_count, Texts),
                                        RUNG_ARRAY(rung_program, services, service_count, Texts),
                                        RUNG_STRUCTS(rung_program, texts, text_count, kMessageText),
                                        RUNG_ARRAY(rung_program, chunk_fns, chunk_count, ChunkFns),
                                        RUNG_STRUCTS(rung_program, writes, write_count, kWritten),
                                        RUNG_STRUCTS(rung_program, reads, read_count, kSpan),
                                        RUNG_ARRAY(rung_program, changes, change_count, U32s)};
constexpr StructInfo kProgram{"rung_program", sizeof(rung_program), kProgramFields};

#undef RUNG_FIELD
#undef RUNG_ARRAY
#undef RUNG_STRUCTS

} // namespace

const StructInfo& programInfo() { return kProgram; }

TargetStruct targetStruct(const StructInfo& info, size_t pointerBytes) {
  const auto sizeOf = [&](FieldKind kind) -> size_t {
    if (kind == FieldKind::U32 || kind == FieldKind::OwnSize) return 4;
    return kind == FieldKind::U64 || kind == FieldKind::I64 ? 8 : pointerBytes;
  };
  const auto alignUp = [](size_t value, size_t align) { return (value + align - 1) / align * align; };
  TargetStruct out{.offsets = {}, .size = 0};
  size_t widest = 1;
  for (const FieldInfo& field : info.fields) {
    const size_t size = sizeOf(field.kind);
    out.offsets.push_back(alignUp(out.size, size));
    out.size = out.offsets.back() + size;
    widest = std::max(widest, size);
  }
  out.size = alignUp(out.size, widest);
  return out;
}

} // namespace rung::ir
