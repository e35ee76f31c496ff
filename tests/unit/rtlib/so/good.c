/* A program written by hand: D0 counts scans. RUNG_TEST_VERSION makes it one of another ABI version,
   RUNG_TEST_STEP another program. */
#include "rung/program.h"

#ifndef RUNG_TEST_VERSION
#define RUNG_TEST_VERSION RUNG_ABI_VERSION
#endif

#ifndef RUNG_TEST_STEP
#define RUNG_TEST_STEP 1
#endif

static uint32_t count(uint8_t* mem, rung_ctx* ctx, uint32_t chunk) {
  (void)ctx, (void)chunk;
  mem[0] += RUNG_TEST_STEP;
  return RUNG_PC_DONE;
}

static const rung_range ranges[] = {{0, 4, 0, RUNG_REPR_PACKED}};
static const rung_space spaces[] = {{"D", 1, 4, 0, 1, ranges}};
static const rung_chunk chunks[] = {{0, 1, 1}};
static const rung_info rungs[] = {{"", 0, 1, 1, 0, 0, 1, 0}};
static const char* const routines[] = {"MAIN"};
static const char* const files[] = {"good.lad"};
static const char* const faults[] = {"dead-loop"};
static const uint32_t part_ends[] = {RUNG_PC_DONE};
static const rung_task tasks[] = {{"MAIN", 0, 8000, 10, 0, 0, 0, 0, 0, 0, 1}};
static const rung_step scan[] = {{RUNG_STEP_ADVANCE, RUNG_NONE, 8000}, {RUNG_STEP_RUN, 0, 1}};
static const rung_chunk_fn functions[] = {count};

extern const rung_program rung_program_table;
const rung_program rung_program_table = {
    .size = sizeof(rung_program),
    .abi_version = RUNG_TEST_VERSION,
    .name = "good",
    .dialect = "gsk",
    .compiler = "hand",
    .memory_size = 16,
    .memory_align = 8,
    .fast_task = RUNG_NONE,
    .space_count = 1,
    .chunk_count = 1,
    .rung_count = 1,
    .routine_count = 1,
    .file_count = 1,
    .task_count = 1,
    .part_end_count = 1,
    .scan_count = 2,
    .fault_count = 1,
    .spaces = spaces,
    .chunks = chunks,
    .rungs = rungs,
    .routines = routines,
    .files = files,
    .tasks = tasks,
    .part_ends = part_ends,
    .scan = scan,
    .faults = faults,
    .chunk_fns = functions,
};
