/* The C ABI compiles as C11, and no field of any structure moves: an offset that changes here breaks every compiled
 * program. Fields are added at the end; their lines are added here. The numbers hold for 64-bit pointers. */
#include <stddef.h>

#include "rung/program.h"

#define AT(type, field, offset) _Static_assert(offsetof(type, field) == (offset), #type "." #field)
#define SIZE(type, size) _Static_assert(sizeof(type) == (size), #type)

#if UINTPTR_MAX == 0xFFFFFFFFFFFFFFFFu

AT(rung_range, first_byte, 0);
AT(rung_range, byte_count, 4);
AT(rung_range, offset, 8);
AT(rung_range, repr, 12);
SIZE(rung_range, 16);

AT(rung_space, name, 0);
AT(rung_space, unit_bytes, 8);
AT(rung_space, byte_count, 12);
AT(rung_space, flags, 16);
AT(rung_space, range_count, 20);
AT(rung_space, ranges, 24);
SIZE(rung_space, 32);

AT(rung_symbol, name, 0);
AT(rung_symbol, comment, 8);
AT(rung_symbol, space, 16);
AT(rung_symbol, byte, 20);
AT(rung_symbol, bit, 24);
AT(rung_symbol, type, 28);
AT(rung_symbol, count, 32);
AT(rung_symbol, flags, 36);
AT(rung_symbol, value, 40);
AT(rung_symbol, reach, 48);
AT(rung_symbol, rung, 52);
SIZE(rung_symbol, 56);

AT(rung_span, offset, 0);
AT(rung_span, size, 4);
SIZE(rung_span, 8);

AT(rung_slot, key, 0);
AT(rung_slot, offset, 8);
AT(rung_slot, type, 12);
AT(rung_slot, rung, 16);
AT(rung_slot, reserved, 20);
SIZE(rung_slot, 24);

AT(rung_continuation, key, 0);
AT(rung_continuation, offset, 8);
AT(rung_continuation, point_count, 12);
AT(rung_continuation, points, 16);
SIZE(rung_continuation, 24);

AT(rung_timer, name, 0);
AT(rung_timer, preset, 8);
AT(rung_timer, units, 16);
AT(rung_timer, unit_count, 24);
AT(rung_timer, flags, 28);
AT(rung_timer, rung, 32);
AT(rung_timer, time_us, 36);
AT(rung_timer, time_type, 40);
AT(rung_timer, time_space, 44);
AT(rung_timer, time_at, 48);
AT(rung_timer, running_at, 52);
AT(rung_timer, preset_type, 56);
AT(rung_timer, preset_space, 60);
AT(rung_timer, preset_at, 64);
AT(rung_timer, unit_type, 68);
AT(rung_timer, unit_space, 72);
AT(rung_timer, unit_at, 76);
SIZE(rung_timer, 80);

AT(rung_written, offset, 0);
AT(rung_written, size, 4);
AT(rung_written, mask, 8);
SIZE(rung_written, 12);

AT(rung_forced_byte, space, 0);
AT(rung_forced_byte, byte, 4);
AT(rung_forced_byte, mask, 8);
AT(rung_forced_byte, value, 12);
SIZE(rung_forced_byte, 16);

AT(rung_init, offset, 0);
AT(rung_init, size, 4);
AT(rung_init, data, 8);
SIZE(rung_init, 16);

AT(rung_copy, kind, 0);
AT(rung_copy, from, 4);
AT(rung_copy, to, 8);
AT(rung_copy, mask, 12);
AT(rung_copy, size, 16);
SIZE(rung_copy, 20);

AT(rung_message_text, number, 0);
AT(rung_message_text, reserved, 4);
AT(rung_message_text, text, 8);
SIZE(rung_message_text, 16);

AT(rung_chunk, first_rung, 0);
AT(rung_chunk, rung_count, 4);
AT(rung_chunk, weight, 8);
SIZE(rung_chunk, 12);

AT(rung_info, title, 0);
AT(rung_info, file, 8);
AT(rung_info, first_line, 12);
AT(rung_info, last_line, 16);
AT(rung_info, routine, 20);
AT(rung_info, key, 24);
AT(rung_info, number, 32);
AT(rung_info, copy, 36);
SIZE(rung_info, 40);

AT(rung_task, name, 0);
AT(rung_task, entry, 8);
AT(rung_task, period_us, 12);
AT(rung_task, budget, 16);
AT(rung_task, budget_fault, 20);
AT(rung_task, begin_first, 24);
AT(rung_task, begin_count, 28);
AT(rung_task, end_first, 32);
AT(rung_task, end_count, 36);
AT(rung_task, part_first, 40);
AT(rung_task, part_count, 44);
AT(rung_task, longest, 48);
AT(rung_task, loops, 52);
AT(rung_task, read_first, 56);
AT(rung_task, read_count, 60);
AT(rung_task, change_first, 64);
AT(rung_task, change_count, 68);
AT(rung_task, loop_free_chunk, 72);
AT(rung_task, loop_free_weight, 76);
SIZE(rung_task, 80);

AT(rung_step, op, 0);
AT(rung_step, task, 4);
AT(rung_step, arg, 8);
SIZE(rung_step, 12);

AT(rung_prof, count, 0);
AT(rung_prof, total, 8);
AT(rung_prof, max, 16);
AT(rung_prof, started, 24);
SIZE(rung_prof, 32);

AT(rung_fault, code, 0);
AT(rung_fault, rung, 4);
AT(rung_fault, line, 8);
AT(rung_fault, task, 12);
SIZE(rung_fault, 16);

AT(rung_message, op, 0);
AT(rung_message, number, 4);
AT(rung_message, channel, 8);
AT(rung_message, index, 12);
AT(rung_message, value, 16);
AT(rung_message, real, 24);
AT(rung_message, rung, 28);
SIZE(rung_message, 32);

AT(rung_host_api, size, 0);
AT(rung_host_api, reserved, 4);
AT(rung_host_api, message, 8);
AT(rung_host_api, service_request, 16);
AT(rung_host_api, service_poll, 24);
AT(rung_host_api, service_result, 32);
SIZE(rung_host_api, 40);

AT(rung_ctx, now_us, 0);
AT(rung_ctx, host, 8);
AT(rung_ctx, host_data, 16);
AT(rung_ctx, prof, 24);
AT(rung_ctx, engine, 32);
AT(rung_ctx, fault, 40);
AT(rung_ctx, sp, 56);
AT(rung_ctx, extra_weight, 60);
AT(rung_ctx, stack, 64);
SIZE(rung_ctx, 576);

AT(rung_program, size, 0);
AT(rung_program, abi_version, 4);
AT(rung_program, name, 8);
AT(rung_program, dialect, 16);
AT(rung_program, compiler, 24);
AT(rung_program, layout_hash, 32);
AT(rung_program, code_hash, 40);
AT(rung_program, memory_size, 48);
AT(rung_program, memory_align, 52);
AT(rung_program, instrumented, 56);
AT(rung_program, main_task, 60);
AT(rung_program, fast_task, 64);
AT(rung_program, space_count, 68);
AT(rung_program, symbol_count, 72);
AT(rung_program, init_count, 76);
AT(rung_program, retain_count, 80);
AT(rung_program, safe_count, 84);
AT(rung_program, copy_count, 88);
AT(rung_program, chunk_count, 92);
AT(rung_program, rung_count, 96);
AT(rung_program, routine_count, 100);
AT(rung_program, file_count, 104);
AT(rung_program, task_count, 108);
AT(rung_program, part_end_count, 112);
AT(rung_program, scan_count, 116);
AT(rung_program, fast_count, 120);
AT(rung_program, slice_count, 124);
AT(rung_program, fault_count, 128);
AT(rung_program, service_count, 132);
AT(rung_program, text_count, 136);
AT(rung_program, slot_count, 140);
AT(rung_program, continuation_count, 144);
AT(rung_program, timer_count, 148);
AT(rung_program, write_count, 152);
AT(rung_program, read_count, 156);
AT(rung_program, change_count, 160);
AT(rung_program, spaces, 168);
AT(rung_program, symbols, 176);
AT(rung_program, slots, 184);
AT(rung_program, continuations, 192);
AT(rung_program, timers, 200);
AT(rung_program, inits, 208);
AT(rung_program, retains, 216);
AT(rung_program, safe_spans, 224);
AT(rung_program, copies, 232);
AT(rung_program, chunks, 240);
AT(rung_program, rungs, 248);
AT(rung_program, routines, 256);
AT(rung_program, files, 264);
AT(rung_program, tasks, 272);
AT(rung_program, part_ends, 280);
AT(rung_program, scan, 288);
AT(rung_program, fast, 296);
AT(rung_program, slices, 304);
AT(rung_program, faults, 312);
AT(rung_program, services, 320);
AT(rung_program, texts, 328);
AT(rung_program, chunk_fns, 336);
AT(rung_program, writes, 344);
AT(rung_program, reads, 352);
AT(rung_program, changes, 360);
SIZE(rung_program, 368);

#endif

/* Called by the test, so that this file is linked and not only compiled. */
uint32_t rung_test_c11_program_size(void);
uint32_t rung_test_c11_program_size(void) { return (uint32_t)sizeof(rung_program); }
