/* The contract between a compiled PLC program and the host that runs it, in plain C11.
 *
 * A program is one constant `rung_program`: tables of plain structs, and one function per *chunk* (a run of rungs that
 * is entered at its head only). The host owns all memory: one block of `memory_size` bytes per instance, with the
 * layout of the tables, and one `rung_ctx`. Generated code has no globals, so instances and generations can coexist.
 *
 * Rules for changes: fields are only added at the end; `size` says which exist; a test asserts every offset. A `.so`
 * exports exactly one symbol, the data object `rung_program_table`.
 */
#ifndef RUNG_PROGRAM_H
#define RUNG_PROGRAM_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define RUNG_ABI_VERSION 7u
#define RUNG_PROGRAM_SYMBOL "rung_program_table"
/* Prefix, before a struct's name, of the constant that identifies the layout of a host's struct for which the program
 * was compiled. Its value is the hash, its comment the text of rung_layout (rung/runtime.h). */
#define RUNG_LAYOUT_SYMBOL "struct "
#define RUNG_NONE 0xFFFFFFFFu     /* "not there" in every index field */
#define RUNG_PC_DONE 0xFFFFFFFFu  /* returned by a chunk when the task's run has ended */
#define RUNG_PC_FAULT 0xFFFFFFFEu /* returned by a chunk that has filled ctx->fault */
#define RUNG_STACK_DEPTH 128u     /* return addresses; the compiler proves that it suffices */
#define RUNG_MAX_SERVICE_ARGS 16u

typedef struct rung_ctx rung_ctx;

/* Runs a chunk on the memory block; returns the next chunk, RUNG_PC_DONE or RUNG_PC_FAULT. `chunk` is its own number,
 * which compiled code ignores; an interpreter has one function for all chunks. */
typedef uint32_t (*rung_chunk_fn)(uint8_t* mem, rung_ctx* ctx, uint32_t chunk);

/* ---- memory -------------------------------------------------------------------------------------------------- */

enum rung_repr {
  RUNG_REPR_PACKED = 0,       /* logical byte i lies at offset + i */
  RUNG_REPR_BYTE_PER_BIT = 1, /* logical bit b of byte i lies, as 0 or 1, in the byte at offset + 8 i + b */
};

/* A run of logical bytes of one space with one representation. The ranges of a space are sorted and cover it; no two
 * ranges, of whatever spaces, share a byte of the memory block. */
typedef struct rung_range {
  uint32_t first_byte; /* logical, within the space */
  uint32_t byte_count;
  uint32_t offset; /* in the memory block */
  uint32_t repr;   /* enum rung_repr */
} rung_range;

enum rung_space_flags {
  RUNG_SPACE_INPUT = 1,  /* the machine or the NC writes it */
  RUNG_SPACE_OUTPUT = 2, /* the program writes it for the machine or the NC */
  RUNG_SPACE_HIDDEN = 4, /* not for users: latches, registers, masks */
  /* The compiler assigns its addresses, which may differ when the program changes: cells are identified only by their
   * symbols. */
  RUNG_SPACE_ALLOCATED = 8,
};

/* An address space of the dialect. Multi-byte values are little-endian in every space. */
typedef struct rung_space {
  const char* name;
  uint32_t unit_bytes; /* bytes per address number: 1, 2, 4 or 8 */
  uint32_t byte_count;
  uint32_t flags; /* enum rung_space_flags */
  uint32_t range_count;
  const rung_range* ranges;
} rung_space;

enum rung_type {
  RUNG_TYPE_BIT = 1,
  RUNG_TYPE_I8 = 2,
  RUNG_TYPE_I16 = 3,
  RUNG_TYPE_I32 = 4,
  RUNG_TYPE_I64 = 5,
  RUNG_TYPE_F64 = 6,
  RUNG_TYPE_TEXT = 7, /* `count` bytes; a shorter text ends with 0 */
};

enum rung_symbol_flags {
  RUNG_SYMBOL_READONLY = 1, /* the program may not write it */
  RUNG_SYMBOL_HIDDEN = 2,   /* for the host's own use: a register, a mechanism's continuation */
  RUNG_SYMBOL_CONST = 4,    /* not memory: `byte` is unused, `value` is its value */
  RUNG_SYMBOL_AREA = 8,     /* the control's name for the beginning of an area, whose cells have other names */
};

/* A name of the program. Sorted by strcmp of `name`; case-insensitive dialects store upper case. */
typedef struct rung_symbol {
  const char* name;
  const char* comment; /* "" if there is none */
  uint32_t space;
  uint32_t byte;  /* logical byte within the space */
  uint32_t bit;   /* 0..7, for RUNG_TYPE_BIT */
  uint32_t type;  /* enum rung_type */
  uint32_t count; /* elements of an array, or bytes of a text; 1 otherwise */
  uint32_t flags; /* enum rung_symbol_flags */
  int64_t value;  /* value of a constant */
  uint32_t reach; /* bytes from `byte` on that instructions access as one cell by this name; at least its own */
  uint32_t rung;  /* of a hidden name: the first rung that uses it, or RUNG_NONE */
} rung_symbol;

/* State that the compiler made: the last value of an edge, the elapsed time of a timer. Sorted by strcmp of `key`,
 * which stays the same as long as the instruction does. Among equal instructions of a routine the key of the second one
 * has "~1", and so on: in two programs such keys belong to the same instruction only within equal rungs. State that is
 * not used between two scans has no entry. Slots share no byte with a range of a space. */
typedef struct rung_slot {
  const char* key;
  uint32_t offset; /* in the memory block */
  uint32_t type;   /* enum rung_type, not text; a bit is a byte, 0 or 1 */
  uint32_t rung;   /* the first rung that uses it, or RUNG_NONE */
  uint32_t reserved;
} rung_slot;

/* A cell of 32 bits, in a slot or a space, that stores where a mechanism continues. Its value v selects points[v], a
 * key that stays the same as long as the instruction at that point does; 0 is the beginning. Sorted by strcmp of
 * `key`. */
typedef struct rung_continuation {
  const char* key;
  uint32_t offset; /* in the memory block */
  uint32_t point_count;
  const char* const* points;
} rung_continuation;

enum rung_timer_flags {
  RUNG_TIMER_DOWN = 1, /* its time falls to 0; otherwise it grows from 0 to the preset */
  RUNG_TIMER_RUNS = 2, /* it counts runs of its instruction, not microseconds */
};

/* A timer of the program, for displays. Its cells are described by a type (an enum rung_type of integers; 0: there is
 * no cell), a space and the logical byte in it. If the space is RUNG_NONE, the cell is in a slot, at this offset of the
 * memory block. */
typedef struct rung_timer {
  const char* name; /* the instruction as its dialect writes it: "TMRB 12" */
  int64_t preset;   /* without a cell; negative: not known */
  const uint32_t*
      units;           /* microseconds of a unit of the preset, by the number in the unit's cell; a larger one counts */
  uint32_t unit_count; /* as 0, as without a cell. At least 1 */
  uint32_t flags;      /* enum rung_timer_flags */
  uint32_t rung;       /* the first rung that uses its time, or RUNG_NONE */
  uint32_t time_us;    /* microseconds of a unit of its time */
  uint32_t time_type;
  uint32_t time_space;
  uint32_t time_at;
  uint32_t running_at;  /* offset of a slot that is 1 while it runs; RUNG_NONE: it runs while its time is neither 0, */
  uint32_t preset_type; /* negative, nor at its end */
  uint32_t preset_space;
  uint32_t preset_at;
  uint32_t unit_type;
  uint32_t unit_space;
  uint32_t unit_at;
} rung_timer;

/* Bytes of the memory block. A retained span consists of whole logical bytes of spaces. */
typedef struct rung_span {
  uint32_t offset;
  uint32_t size;
} rung_span;

/* Bits of the memory block that chunks may write: in each of `size` bytes the bits of the mask. If the mask is not 255,
 * `size` is 1. */
typedef struct rung_written {
  uint32_t offset;
  uint32_t size;
  uint32_t mask; /* 1 to 255 */
} rung_written;

/* Initial contents, in which expanded bits are 0 or 1; all other memory starts as 0. */
typedef struct rung_init {
  uint32_t offset;
  uint32_t size;
  const uint8_t* data;
} rung_init;

enum rung_copy_kind {
  RUNG_COPY_ALL = 0,    /* to := from */
  RUNG_COPY_MASKED = 1, /* to := (to and not mask) or (from and mask); mask := 0 */
};

/* A copy that the host makes at the entry or exit of a task's run: input latches, images, register sets. Source, target
 * and mask do not overlap; each lies in ranges that are adjacent in memory, and all have the same representation. */
typedef struct rung_copy {
  uint32_t kind; /* enum rung_copy_kind */
  uint32_t from; /* offsets in the memory block */
  uint32_t to;
  uint32_t mask; /* RUNG_COPY_MASKED only */
  uint32_t size;
} rung_copy;

/* Forced bits of one byte of a space. */
typedef struct rung_forced_byte {
  uint32_t space;
  uint32_t byte;  /* logical, within the space */
  uint32_t mask;  /* the forced bits, 1 to 255 */
  uint32_t value; /* their values; 0 outside the mask */
} rung_forced_byte;

/* ---- code ---------------------------------------------------------------------------------------------------- */

typedef struct rung_chunk {
  uint32_t first_rung; /* in `rungs` */
  uint32_t rung_count; /* at least 1; the rungs after the first may be anywhere in `rungs` */
  uint32_t weight;     /* steps of its shortest path, for budgets; at least 1 */
} rung_chunk;

#define RUNG_MOST_TIMER_LIMIT (INT64_MAX >> 16)

typedef struct rung_info {
  const char* title; /* the rung's comment, "" if there is none */
  uint32_t file;     /* in `files`; RUNG_NONE: made by the compiler */
  uint32_t first_line;
  uint32_t last_line;
  uint32_t routine; /* in `routines` */
  uint64_t key;     /* stable while the rung's text is unchanged */
  uint32_t number;  /* as drawn: from 1, counted over all files; 0: made by the compiler */
  uint32_t copy;    /* number of earlier rungs of its routine with the same text; part of `key` (rung/types.hpp) */
} rung_info;

/* A part of the program that the host can start: `begin` copies, chunks from `entry` until RUNG_PC_DONE, `end` copies.
 * A task that is cut into parts runs one part per RUNG_STEP_PART, and one run always takes `part_count` of them: if the
 * program ends early, the remaining parts do nothing. Part i runs until control reaches, outside calls, a chunk that is
 * not below part_ends[part_first + i]. The `begin` copies belong to the first part, the `end` copies to every part. */
typedef struct rung_task {
  const char* name;
  uint32_t entry;        /* chunk */
  uint32_t period_us;    /* 0: only when the schedule or the control starts it */
  uint32_t budget;       /* maximum weight of one run; more is the fault `budget_fault` */
  uint32_t budget_fault; /* in `faults` */
  uint32_t begin_first;  /* in `copies` */
  uint32_t begin_count;
  uint32_t end_first;
  uint32_t end_count;
  uint32_t part_first; /* in `part_ends` */
  uint32_t part_count; /* 1: not cut into parts */
  uint32_t longest;    /* weight of the longest run, or, if cut, of the longest part; at most `budget` */
  uint32_t loops;      /* 1: it may have loops; `longest` counts each once, and `budget` ends them */
  uint32_t read_first; /* in `reads`: bytes of spaces that a run may read, with its `begin` copies */
  uint32_t read_count;
  uint32_t change_first;     /* in `changes`: all places that a run may change. If a run changes nothing, a run */
  uint32_t change_count;     /* right after it does not either. 0: not known, or too many places */
  uint32_t loop_free_chunk;  /* from this chunk on there are no loops outside calls; RUNG_PC_DONE: nowhere */
  uint32_t loop_free_weight; /* of the longest path from it, or from a later chunk */
} rung_task;

#define RUNG_MOST_CHANGES 16u /* maximum `change_count` of a task */

enum rung_step_op {
  RUNG_STEP_ADVANCE = 0, /* the clock advances by `arg` microseconds */
  RUNG_STEP_RUN = 1,     /* run `task` `arg` times */
  RUNG_STEP_PART = 2,    /* run the next part of `task`; after the last part a new run begins */
  RUNG_STEP_HOOK = 3,    /* call the dialect's control for work number `arg` */
  RUNG_STEP_SLOT = 4,    /* a slot ends here */
};

typedef struct rung_step {
  uint32_t op;   /* enum rung_step_op */
  uint32_t task; /* RUNG_NONE if `op` has no task */
  uint32_t arg;
} rung_step;

typedef struct rung_message_text {
  uint32_t number; /* of the message */
  uint32_t reserved;
  const char* text;
} rung_message_text;

/* Counters of one rung; times in ticks of the host's cycle counter. */
typedef struct rung_prof {
  uint64_t count;
  uint64_t total;
  uint64_t max;
  uint64_t started; /* scratch of the running measurement */
} rung_prof;

/* ---- host ---------------------------------------------------------------------------------------------------- */

typedef struct rung_fault {
  uint32_t code; /* in `faults`; RUNG_NONE: no fault */
  uint32_t rung; /* in `rungs` */
  uint32_t line; /* source line of the operation; 0: only the rung is known */
  uint32_t task; /* in `tasks` */
} rung_fault;

enum rung_message_op {
  RUNG_MESSAGE_CLEAR = 0,
  RUNG_MESSAGE_SHOW = 1,
  RUNG_MESSAGE_SHOW_LOG = 2,
  RUNG_MESSAGE_LOG = 3,
};

typedef struct rung_message {
  uint32_t op; /* enum rung_message_op */
  uint32_t number;
  int32_t channel;
  int32_t index;
  int64_t value; /* integer; if `real` is 1, the bits of a double */
  uint32_t real;
  uint32_t rung;
} rung_message;

enum rung_service_state {
  RUNG_SERVICE_NONE = 0, /* unknown ticket, or the queue was full */
  RUNG_SERVICE_PENDING = 1,
  RUNG_SERVICE_DONE = 2,
  RUNG_SERVICE_ERROR = 3,
};

/* Functions that generated code may call, on the scan thread within a chunk. Their time is bounded; none allocates,
 * locks or blocks. `size` as in rung_program. None may write to the memory block, and only service_request may read it:
 * all spaces are up to date then, everything else in the block may be out of date. */
typedef struct rung_host_api {
  uint32_t size;
  uint32_t reserved;
  void (*message)(rung_ctx* ctx, const rung_message* message);
  /* Queues a request; returns its ticket, or 0 if the queue is full (counted, reported). */
  uint32_t (*service_request)(rung_ctx* ctx, uint32_t service, const int64_t* args, uint32_t count);
  uint32_t (*service_poll)(rung_ctx* ctx, uint32_t ticket); /* enum rung_service_state */
  int64_t (*service_result)(rung_ctx* ctx, uint32_t ticket, uint32_t index);
} rung_host_api;

struct rung_ctx {
  int64_t now_us; /* fixed while a task runs */
  const rung_host_api* host;
  void* host_data;
  rung_prof* prof; /* one per rung; only instrumented programs use it */
  void* engine;    /* private to the engine, such as the interpreter */
  rung_fault fault;
  uint32_t sp;           /* used entries of `stack` */
  uint32_t extra_weight; /* by which a chunk's path exceeded its weight; the host resets it */
  uint32_t stack[RUNG_STACK_DEPTH];
};

/* ---- the program --------------------------------------------------------------------------------------------- */

typedef struct rung_program {
  uint32_t size; /* of this struct in the compiler's version */
  uint32_t abi_version;
  const char* name;
  const char* dialect;
  const char* compiler;
  uint64_t layout_hash; /* equal hashes: memory images are interchangeable */
  uint64_t code_hash;
  uint32_t memory_size;
  uint32_t memory_align; /* a power of two, at most 4096 */
  uint32_t instrumented; /* 1: counts and times rungs */
  uint32_t main_task;    /* the task whose run is a scan */
  uint32_t fast_task;    /* RUNG_NONE: there is none */

  uint32_t space_count;
  uint32_t symbol_count;
  uint32_t init_count;
  uint32_t retain_count;
  uint32_t safe_count;
  uint32_t copy_count;
  uint32_t chunk_count;
  uint32_t rung_count;
  uint32_t routine_count;
  uint32_t file_count;
  uint32_t task_count;
  uint32_t part_end_count;
  uint32_t scan_count;
  uint32_t fast_count;
  uint32_t slice_count;
  uint32_t fault_count;
  uint32_t service_count;
  uint32_t text_count;
  uint32_t slot_count;
  uint32_t continuation_count;
  uint32_t timer_count;
  uint32_t write_count;
  uint32_t read_count;
  uint32_t change_count;

  const rung_space* spaces;
  const rung_symbol* symbols;
  const rung_slot* slots;
  const rung_continuation* continuations;
  const rung_timer* timers; /* in program order */
  const rung_init* inits;
  const rung_span* retains;    /* retained through power-off */
  const rung_span* safe_spans; /* cleared when a fault stops the program */
  const rung_copy* copies;
  const rung_chunk* chunks;
  const rung_info* rungs;
  const char* const* routines;
  const char* const* files;
  const rung_task* tasks;
  const uint32_t* part_ends; /* chunk before which a part ends, ascending; RUNG_PC_DONE for the last part of a task */
  const rung_step* scan;   /* one scan, repeated; its ADVANCE steps take time, or without any the main task's period */
  const rung_step* fast;   /* one run of the fast task only */
  const rung_step* slices; /* `scan` for a real clock, if its order differs; else none. It takes the same time */
  const char* const* faults;
  const char* const* services;
  const rung_message_text* texts; /* sorted by number; of equal numbers the first counts */

  const rung_chunk_fn* chunk_fns; /* by chunk */
  const rung_written* writes;     /* all bits of spaces that chunks may write, ascending, without overlap */
  const rung_span* reads;         /* of each task, ascending, not adjacent */
  const uint32_t* changes;        /* of each task: offsets of eight bytes of the memory block, ascending */
} rung_program;

#ifdef __cplusplus
}
#endif

#endif
