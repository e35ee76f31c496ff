/* The runtime of compiled PLC programs as a library of C11: librung-runtime.
 *
 *   rung_image* image;                                     rung_instance* plc;
 *   rung_image_open("mill.so", NULL, &image);              rung_instance_new(image, NULL, &plc);
 *   rung_instance_power_on(plc, RUNG_WARM);                rung_instance_run_due(plc, 1000000); // every millisecond
 *
 * An image is a compiled program, an instance is one that runs: its memory, clock, queues, and the part of the control
 * that belongs to its dialect (power-on, clocks, names of the NC's interface, handshake of functions).
 *
 * Results. A function that can fail gives an enum rung_status: 0, above 0 where there is nothing to report, below 0 an
 * error, in which case it has done nothing; rung_error_text says in a sentence what was wrong. What a function writes
 * through its last parameters is unspecified after an error. No call aborts the process, and no exception leaves one.
 *
 * Threads. An image may be used by all threads. An instance is used by one thread at a time, which need not always be
 * the same; a call that finds another thread inside gives RUNG_WRONG_THREAD. [any] marks what one further thread may
 * call at the same time. In a callback the cells of its instance that were found before may be read, its state and
 * fault looked at, and nothing else.
 *
 * Real time. [rt] marks what allocates nothing, takes no lock, does not block and makes no system call, as long as the
 * callbacks do not; its time is bounded by what the program does. The rest is for start, end and other threads.
 *
 * Structs with a `size` grow at their end: the caller sets it to sizeof, and gets or gives what both sides know.
 * Texts are UTF-8. Times are in microseconds of the program's clock (_us) or nanoseconds of the machine's (_ns). */
#ifndef RUNG_RUNTIME_H
#define RUNG_RUNTIME_H

#include <stddef.h>
#include <stdint.h>

#include "rung/program.h"

#if defined(RUNG_BUILDS_RUNTIME)
#define RUNG_API __attribute__((visibility("default")))
#else
#define RUNG_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ---- results --------------------------------------------------------------------------------------------------- */

enum rung_status {
  RUNG_OK = 0,
  RUNG_EMPTY = 1,         /* there is no (further) message, request, entry */
  RUNG_LATER = 2,         /* not at this moment of the schedule: try again after the next slice */
  RUNG_FAULTED = 3,       /* a fault has stopped the program, now or before: see rung_instance_fault */
  RUNG_BAD_HANDLE = -1,   /* null, of another kind, or freed where that can be seen */
  RUNG_BAD_ARGUMENT = -2, /* null, out of range, or a wrong `size` */
  RUNG_WRONG_THREAD = -3, /* another thread is inside a call for this instance */
  RUNG_WRONG_STATE = -4,  /* not before the power-on, not in a callback, not a second time, ... */
  RUNG_NOT_FOUND = -5,    /* no such name, or the program that runs now does not have it any more */
  RUNG_WRONG_TYPE = -6,   /* a text for a number, a cell found for reading that is written, ... */
  RUNG_OVERWRITTEN = -7, /* the program would never see the value: another place is copied over the cell, or the control
                            itself writes it */
  RUNG_REFUSED = -8,     /* the file is damaged, may not be trusted, or is not a program of this version */
  RUNG_OUT_OF_MEMORY = -9,
  RUNG_FAILED = -10, /* the system: a file that cannot be written, a thread that cannot be started */
};

/* The sentence for the last error that a call gave in this thread, and for RUNG_LATER of rung_instance_replace,
 * rung_instance_shadow and rung_forces_new; "" before the first. Until the thread's next call. [any] [rt] */
RUNG_API const char* rung_error_text(void);

/* Of this header. */
#define RUNG_RUNTIME_MAJOR 0u
#define RUNG_RUNTIME_MINOR 1u
/* Of the library: major << 16 | minor. A library of the same major version and no lower minor version serves a host
 * that was built with this header. [any] [rt] */
RUNG_API uint32_t rung_runtime_version(void);

/* ---- images ---------------------------------------------------------------------------------------------------- */

typedef struct rung_image rung_image;

typedef struct rung_image_options {
  uint32_t size;
  uint32_t allow_unsealed; /* 1: take a shared object that no `rungc build` or `rungc seal` has sealed; a process with
                              more privileges than its user never does */
  const char* keys_folder; /* of public keys for signed programs; null: the system's. Not for a privileged process */
} rung_image_options;

/* Loads a compiled program. Its seal is checked before anything of it is loaded, and whose file it is (docs/security).
 * `options` may be null. RUNG_REFUSED, RUNG_OUT_OF_MEMORY. */
RUNG_API int32_t rung_image_open(const char* path, const rung_image_options* options, rung_image** image);

/* Loads a compiled program from a memory file (memfd_create) that a process has made which the caller trusts, such as
 * its own compiler. Whose it is is not looked at; it must be sealed against every change (F_SEAL_WRITE, F_SEAL_SHRINK,
 * F_SEAL_GROW, F_SEAL_SEAL). Its contents are checked as those of a file. The descriptor stays the caller's; `name` is
 * what errors call it. RUNG_REFUSED, RUNG_OUT_OF_MEMORY. */
RUNG_API int32_t rung_image_open_memory(int32_t file, const char* name, rung_image** image);

/* An image over a program that is in memory already: linked into the host, or made by a compiler. `engine` is what its
 * chunks find in rung_ctx::engine. `release`, which may be null, is called with `owner` when nothing uses the image any
 * more. RUNG_REFUSED: its tables are not those of a program of this version; then `release` is not called. */
RUNG_API int32_t rung_image_adopt(const rung_program* program, void* engine, void (*release)(void* owner), void* owner,
                                  rung_image** image);

/* The program's tables, valid until the image is closed; null for a handle that is not an image's. [rt] */
RUNG_API const rung_program* rung_image_program(const rung_image* image);

/* The image is not used any more; what instances and replacements use of it stays until they are freed. Null is
 * allowed. */
RUNG_API int32_t rung_image_close(rung_image* image);

/* ---- instances ------------------------------------------------------------------------------------------------- */

typedef struct rung_instance rung_instance;

enum rung_log_level { RUNG_LOG_INFO = 0, RUNG_LOG_WARNING = 1, RUNG_LOG_ERROR = 2 };

/* What becomes of a service request of the program (a window function, a macro variable, a block of movement). */
enum rung_answer {
  RUNG_REFUSE = 0, /* the control answers at once, as where no CNC is there to serve it */
  RUNG_ANSWER = 1, /* the reply is filled in */
  RUNG_QUEUE = 2,  /* it waits for rung_instance_next_request */
};

typedef struct rung_request {
  uint32_t size;
  uint32_t ticket;
  const char* service; /* as rung_program::services has it: name, arguments, results; valid as long as the instance */
  uint32_t arg_count;
  uint32_t kind; /* a number for this text that all programs of the dialect have; 0: the library does not know it */
  int64_t args[RUNG_MAX_SERVICE_ARGS];
} rung_request;

typedef struct rung_reply {
  uint32_t size;
  uint32_t ticket;       /* of the request */
  uint32_t error;        /* 0: the service is done; 1: it failed */
  uint32_t result_count; /* at most RUNG_MAX_SERVICE_ARGS */
  int64_t results[RUNG_MAX_SERVICE_ARGS];
} rung_reply;

enum rung_instance_flags {
  RUNG_MEASURE = 1,        /* the times of scans are measured: two looks at the clock a slice */
  RUNG_QUEUE_REQUESTS = 2, /* without a `request` callback: requests wait for rung_instance_next_request */
  RUNG_SAVE_AT_ONCE = 4,   /* what the program asks to be saved is on disk when a call returns, which is not real time
                              then: for hosts whose program runs faster than its clock */
};

typedef struct rung_instance_options {
  uint32_t size;
  uint32_t flags; /* enum rung_instance_flags */
  /* The memory block: memory_size bytes at least, aligned as memory_align says (rung_image_program), for the life of
   * the instance. Null: the library allocates it, and where a task begins it copies of an NC's area only what rungs and
   * cells of the host look at, which takes less time; in a block of the host it copies all of it. */
  void* memory;
  size_t memory_bytes;
  void* user; /* for the callbacks, each of which may be null */
  /* What an operator should know: retained memory that was lost, a file that cannot be written. Never within a call
   * that is marked [rt]. */
  void (*log)(void* user, int32_t level, const char* text);
  /* The program asks for a service, within a scan or before a slice. An enum rung_answer. */
  int32_t (*request)(void* user, rung_instance* instance, const rung_request* request, rung_reply* reply);
  /* A fault has stopped the program, within a scan or the power-on: what its dialect clears is 0, and so are the bound
   * variables that the program writes. */
  void (*fault)(void* user, rung_instance* instance);
  /* Of rung_instance_run_due. How many scans run in one call where time was lost; 0: one, the scan that is due. */
  uint32_t catch_up;
  /* After so many scans in a row that begin where others were left out the machine is too slow for the program: the
   * fault "overrun". 0: 500; RUNG_NONE: never. */
  uint32_t most_overruns;
} rung_instance_options;

/* One program that runs, not switched on yet. `options` may be null. RUNG_OUT_OF_MEMORY. */
RUNG_API int32_t rung_instance_new(rung_image* image, const rung_instance_options* options, rung_instance** instance);

/* Ends it; does not switch it off (rung_instance_power_off): what it has written for the host stays. What was to be
 * saved is on disk when it returns, or has been tried. Null is allowed. Its watches, replacements and sets of forces
 * are freed before. */
RUNG_API int32_t rung_instance_free(rung_instance* instance);

/* ---- power ----------------------------------------------------------------------------------------------------- */

enum rung_power {
  RUNG_COLD = 0, /* memory as a new machine has it */
  RUNG_WARM = 1, /* retained memory keeps its contents: those on disk (rung_instance_keep), else the instance's own */
};

/* Switches the program on, or off and on again, after a fault too. What the program writes for the host (bound
 * variables and blocks) is 0 until its first slice. RUNG_FAULTED: what runs at a power-on has faulted; RUNG_FAILED: the
 * retained memory cannot be taken or saved (rung_instance_keep), and the program is off. */
RUNG_API int32_t rung_instance_power_on(rung_instance* instance, int32_t power);

/* A regular power-off: the scans that the dialect still needs run, and what is retained is on disk. RUNG_FAILED: it is
 * not, and rung_error_text says why; the program is switched off all the same. */
RUNG_API int32_t rung_instance_power_off(rung_instance* instance);

/* A regular power-off of a machine that moves: the program has its last scans with fresh inputs, and its outputs are
 * seen. RUNG_LATER: it needs some, the host runs it as ever, and asks again after each step. RUNG_OK: it needs no more,
 * or has had as many as it gets; then rung_instance_power_off switches it off. Where a host does not ask, that runs
 * them, with the inputs as they are. [rt] */
RUNG_API int32_t rung_instance_begin_power_off(rung_instance* instance);

/* The operator's stop and start: a stopped program lets its clock advance, and does nothing: what it has written for
 * the host stays. [rt] */
RUNG_API int32_t rung_instance_stop(rung_instance* instance);
RUNG_API int32_t rung_instance_start(rung_instance* instance);

/* ---- running --------------------------------------------------------------------------------------------------- */

/* The clock of the host has advanced by `elapsed_ns` (0 to one hour): what is due of the schedule runs now, slice by
 * slice. Where scans are late, `catch_up` of rung_instance_options run; the others are left out, and timers stay
 * right. RUNG_FAULTED. [rt] */
RUNG_API int32_t rung_instance_run_due(rung_instance* instance, int64_t elapsed_ns);

/* The same for a host that runs the fast task (INT0, Level 1, MODULE_FAST) in a place of its own: a slice that is due
 * runs up to the end of its fast task, and the rest of it, with the same inputs, and what is late in the next
 * rung_instance_run_due, whose `elapsed_ns` is what has passed since. Where no slice is due, or it has no fast task,
 * nothing runs. The same thread. RUNG_FAULTED. [rt] */
RUNG_API int32_t rung_instance_run_due_fast(rung_instance* instance, int64_t elapsed_ns);

/* One slice of the schedule: the clock advances to its time, and what belongs there runs (see `due_us` of rung_state).
 * The rest of a scan, whatever the time; the rest of a slot, for dialects that have slots; one run of the fast task by
 * itself. RUNG_FAULTED. [rt] */
RUNG_API int32_t rung_instance_slice(rung_instance* instance);
RUNG_API int32_t rung_instance_scan(rung_instance* instance);
RUNG_API int32_t rung_instance_slot(rung_instance* instance);
RUNG_API int32_t rung_instance_fast(rung_instance* instance);

/* Watches that have no sample yet get one of this moment: for hosts that do not run a program which a fault has
 * stopped. [rt] */
RUNG_API int32_t rung_instance_sample(rung_instance* instance);

/* How long a slice of the program may run before that counts as a fault, in nanoseconds, also where a call runs several
 * slices; 0: the budgets of its tasks alone count. [rt] */
RUNG_API int32_t rung_instance_limit(rung_instance* instance, int64_t ns);

/* Reads what a scan reads, code, tables and the program's part of the memory block, a byte of each line of 64, until
 * all has been read or CLOCK_MONOTONIC has come to `until_ns`; changes nothing and runs nothing. For hosts that wake
 * some microseconds before a slice is due: the processor has it in its caches then. The code is that of a program in a
 * file of its own. [rt] */
RUNG_API int32_t rung_instance_prefetch(const rung_instance* instance, int64_t until_ns);

enum rung_state_flags {
  RUNG_STATE_ON = 1,       /* switched on */
  RUNG_STATE_STOPPED = 2,  /* by rung_instance_stop */
  RUNG_STATE_FAULTED = 4,  /* by a fault */
  RUNG_STATE_AT_START = 8, /* between two scans of the schedule */
  RUNG_STATE_UNSAVED = 16, /* the last try to write retained memory has failed */
};

typedef struct rung_state {
  uint32_t size;
  uint32_t flags;            /* enum rung_state_flags */
  uint32_t generation;       /* how many programs have taken over: offsets and tables looked up before are old */
  uint32_t due_us;           /* from now on the program's clock to the next slice */
  int64_t now_us;            /* the program's clock */
  int64_t wait_ns;           /* of rung_instance_run_due: until the next slice is due; 0 or less: it is */
  uint64_t scans;            /* of the schedule, since the power-on */
  uint64_t missed;           /* scans that rung_instance_run_due has left out */
  int64_t last_ns;           /* time of the last scan that is over, with RUNG_MEASURE */
  int64_t worst_ns;          /* the longest since the power-on, with RUNG_MEASURE */
  uint32_t lost_messages;    /* dropped, because the host did not take them in time */
  uint32_t refused_requests; /* of services: too many were unanswered */
  uint32_t stray_replies;    /* to tickets that nothing waited for */
  uint32_t program;          /* the number of the one that runs (rung_instance_program) */
  uint64_t saves;            /* images of retained memory that were written */
  uint64_t failed_saves;     /* tries that went wrong */
} rung_state;

/* [rt] */
RUNG_API int32_t rung_instance_state(const rung_instance* instance, rung_state* state);

/* An instance has one program, and for each replacement another. Each has a number, from 1: that of rung_instance_new,
 * and on in the order in which replacements were made. */
typedef struct rung_program_info {
  uint32_t size;
  uint32_t number;  /* of the program that runs */
  uint32_t faulted; /* of another one that a fault has stopped, until the next power-on; 0: there is none */
  uint32_t reserved;
  char name[128]; /* of both, cut off where they are longer; "" where there is none */
  char faulted_name[128];
} rung_program_info;

/* Who runs at this moment. [any] */
RUNG_API int32_t rung_instance_program(const rung_instance* instance, rung_program_info* program);

typedef struct rung_fault_info {
  uint32_t size;
  uint32_t rung; /* as drawn, from 1; 0: none */
  uint32_t line; /* 0: unknown */
  uint32_t reserved;
  const char* code; /* "dead-loop"; valid as long as the image; so are the next two */
  const char* file; /* "" where it is unknown */
  const char* task;
  char text[256]; /* all of it, for people */
} rung_fault_info;

/* RUNG_EMPTY: there is none. */
RUNG_API int32_t rung_instance_fault(const rung_instance* instance, rung_fault_info* fault);

/* ---- names and values ------------------------------------------------------------------------------------------ */

/* A cell that was found by its name. It stays good until it is released, or for the life of the instance: when another
 * program takes over, it is the cell of that name there. An instance has room for 65536. */
typedef uint32_t rung_cell;

enum rung_access {
  RUNG_READ = 0,
  RUNG_WRITE = 1, /* by the machine or a person; reading is included, of the place that is written */
  RUNG_REAL = 2,  /* in addition: the real of 64 bits that begins there, in a longer cell or in two words */
};

/* Finds a cell by a name of the program, an address of the dialect or a signal of the NC's interface, with index, bit
 * or width as the dialect writes them. The same name gives the same cell. RUNG_NOT_FOUND; RUNG_OVERWRITTEN for
 * RUNG_WRITE: the sentence says where to write; RUNG_WRONG_TYPE: a constant, for RUNG_WRITE, or no room for RUNG_REAL.
 * `access`: enum rung_access, added up. Any thread. */
RUNG_API int32_t rung_instance_find(rung_instance* instance, const char* name, int32_t access, rung_cell* cell);

typedef struct rung_cell_info {
  uint32_t size;
  uint32_t type;   /* enum rung_type */
  uint32_t count;  /* elements; bytes of a text */
  uint32_t access; /* enum rung_access, as it was found */
  uint32_t space;  /* in rung_program::spaces; RUNG_NONE: a constant */
  uint32_t byte;   /* in the space */
  uint32_t bit;    /* of `byte` */
  uint32_t reserved;
  char address[64]; /* as the dialect writes it; cut off where it is longer */
} rung_cell_info;

/* In the program that runs now. Errors as of rung_instance_find. Any thread. */
RUNG_API int32_t rung_instance_cell(const rung_instance* instance, rung_cell cell, rung_cell_info* info);

typedef struct rung_replacement rung_replacement; /* below */

/* What a name is, without a cell for it: in the program that runs or, with a replacement, in the one that would take
 * over with it. Errors as of rung_instance_find. `value`: of a constant. Any thread. */
RUNG_API int32_t rung_instance_describe(const rung_instance* instance, const rung_replacement* replacement,
                                        const char* name, int32_t access, rung_cell_info* info, int64_t* value);

/* A cell that was found is not used any more; one that was found several times is released as often. Those that are
 * bound, and those of watches, stay. Any thread. */
RUNG_API int32_t rung_instance_release(rung_instance* instance, rung_cell cell);

/* The value of an element. Cells of a real have a double; all others an integer, extended by its sign: cast it to an
 * unsigned type of the cell's width to read it without one. A bit is 0 or 1; of a value for a narrower cell the lowest
 * bits are written. */
typedef union rung_value {
  int64_t integer;
  double real;
} rung_value;

/* `count` elements of a cell from the first-th on; 0 and 1 for all but arrays. RUNG_BAD_ARGUMENT: there are not so
 * many; RUNG_WRONG_TYPE: a text, or a cell found for reading. [rt] */
RUNG_API int32_t rung_instance_read(const rung_instance* instance, rung_cell cell, uint32_t first, uint32_t count,
                                    rung_value* values);
RUNG_API int32_t rung_instance_write(rung_instance* instance, rung_cell cell, uint32_t first, uint32_t count,
                                     const rung_value* values);

/* The first elements of `count` cells in one call, all of one moment. All or nothing is written. [rt] */
RUNG_API int32_t rung_instance_read_all(const rung_instance* instance, const rung_cell* cells, uint32_t count,
                                        rung_value* values);
RUNG_API int32_t rung_instance_write_all(rung_instance* instance, const rung_cell* cells, uint32_t count,
                                         const rung_value* values);

/* A text of the program's memory, ended by 0 and cut off where `bytes` does not hold it; and one into memory, cut off
 * where the cell does not hold it. RUNG_WRONG_TYPE. */
RUNG_API int32_t rung_instance_read_text(const rung_instance* instance, rung_cell cell, char* text, size_t bytes);
RUNG_API int32_t rung_instance_write_text(rung_instance* instance, rung_cell cell, const char* text);

/* The author's names, in the order of their bytes, constants included: the index-th of them. The name is valid as long
 * as the image. RUNG_EMPTY: there are not so many. [any] [rt] */
typedef struct rung_symbol_info {
  uint32_t size;
  uint32_t type;  /* enum rung_type */
  uint32_t count; /* elements; bytes of a text */
  uint32_t flags; /* enum rung_symbol_flags */
  uint32_t space; /* in rung_program::spaces; RUNG_NONE: a constant */
  uint32_t byte;  /* in the space */
  uint32_t bit;   /* of `byte` */
  uint32_t reserved;
  int64_t value; /* of a constant */
  const char* name;
  const char* comment;
} rung_symbol_info;

RUNG_API int32_t rung_image_symbol(const rung_image* image, uint32_t index, rung_symbol_info* symbol);

/* ---- host variables and blocks --------------------------------------------------------------------------------- */

enum rung_host_type {
  RUNG_HOST_BOOL = 1, /* a byte: 0, or not */
  RUNG_HOST_I8 = 2,
  RUNG_HOST_U8 = 3,
  RUNG_HOST_I16 = 4,
  RUNG_HOST_U16 = 5,
  RUNG_HOST_I32 = 6,
  RUNG_HOST_U32 = 7,
  RUNG_HOST_I64 = 8,
  RUNG_HOST_F32 = 9,
  RUNG_HOST_F64 = 10,
};

enum rung_direction {
  RUNG_TO_PROGRAM = 0,   /* before every slice; of a block, where a task begins that reads it */
  RUNG_FROM_PROGRAM = 1, /* after every slice, as the machine sees it; 0 after a fault and after the power-off */
  RUNG_BOUND_REAL = 2,   /* in addition, of a variable: the real that RUNG_REAL would find */
};

typedef struct rung_variable {
  const char* name;   /* as for rung_instance_find */
  void* address;      /* of the host's variable, aligned for its type, for the life of the instance */
  uint32_t type;      /* enum rung_host_type */
  uint32_t direction; /* enum rung_direction, added up */
  double scale;       /* of RUNG_HOST_F32 and F64: units of the program in one of the host's; 0: 1 */
} rung_variable;

/* Binds variables of the host to cells, in addition to those that are bound: from now on they are copied before and
 * after slices. An integer that a narrower cell does not hold loses its upper bits; of a wider variable from a cell the
 * upper ones are its sign, or 0 where the variable has none. A real is rounded to an integer cell and held in its
 * range. All or none; errors as of rung_instance_find. */
RUNG_API int32_t rung_instance_bind(rung_instance* instance, const rung_variable* variables, uint32_t count);

/* Memory of the host for bytes of a space, as the dialect lays them out: little-endian, bit 0 the lowest. */
typedef struct rung_block {
  const char* name;   /* of its first cell, as for rung_instance_find; it begins with a byte */
  void* address;      /* of the host's memory, of any alignment, for the life of the instance */
  uint32_t bytes;     /* at least 1; to the end of the space at most; of a cell that the compiler placed: of the cell */
  uint32_t direction; /* enum rung_direction */
} rung_block;

/* Binds blocks, in addition to those that are bound. Of a block to the program, a run of a task takes the bytes that
 * the task may read, once, where it begins, before its input copies; a task that begins within another one may take the
 * same byte again. Bytes that no task of the schedule reads are taken before every slice, for the control and
 * for the host. Where a variable is bound to the same cell, the block counts. All or none; errors as of
 * rung_instance_find, RUNG_OVERWRITTEN for any of its bytes, RUNG_WRONG_TYPE for a constant. */
RUNG_API int32_t rung_instance_bind_blocks(rung_instance* instance, const rung_block* blocks, uint32_t count);

/* A member of a struct of the host that is bound to a cell; rungc bind makes these tables (docs/bind.md). */
typedef struct rung_member {
  const char* name;   /* of the cell, as for rung_instance_find; of a block, of its first one */
  const char* member; /* as C writes it, "axis[0].position" */
  uint32_t offset;    /* in the struct */
  uint32_t bytes;     /* of the member; of a bit-field those that it has bits in; at most 8 but for blocks */
  uint32_t type; /* enum rung_host_type; of a bit-field its sign counts alone; 0: a block of bytes, see rung_block */
  uint32_t direction; /* enum rung_direction, added up */
  uint32_t bit;       /* of a bit-field: the lowest, 0 to 7 of the byte at `offset` */
  uint32_t bits;      /* of a bit-field: how many, bit + bits at most 64; 0: it is none */
  double scale;       /* as in rung_variable */
} rung_member;

/* A struct of the host, as its compiler lays it out, and its members that are bound. */
typedef struct rung_layout {
  uint32_t size;
  uint32_t bytes;             /* of the host's struct */
  const char* name;           /* "NcBlock" */
  const char* text;           /* what is bound where, a line a member: for sentences */
  uint64_t hash;              /* of that */
  const rung_member* members; /* valid for the life of the instance, as all of this */
  uint32_t member_count;
  /* Counters by which a reader knows a whole copy: the writer counts `head` up, writes, and sets `tail` to `head`. */
  uint32_t counter_bytes; /* 1, 2, 4 or 8; 0: there are none */
  uint32_t head;          /* offsets */
  uint32_t tail;
  /* A bit-field that the host's compiler lays elsewhere than the table says, or null; null: it has none. */
  const char* (*moved)(void);
} rung_layout;

/* Binds a struct, in addition to what is bound. Members are copied as bound variables are, and as blocks where they are
 * blocks, with these differences: a bit takes whether an integer is 0, and no member needs to be aligned. All or none.
 *
 * With counters the members to the program are copied as a whole before every slice, and checked: of a copy during
 * which the host wrote, after some tries, the program sees nothing, but the last whole one again; 0 before the first.
 *
 * RUNG_REFUSED: the program was compiled for another layout of the struct (rungc build --binding); the same is said of
 * a program that is to replace it. Other errors as of rung_instance_bind and rung_instance_bind_blocks. */
RUNG_API int32_t rung_instance_bind_struct(rung_instance* instance, const rung_layout* layout, void* address);

/* How many slices in a row, up to now, no whole copy of the struct at this address could be had. RUNG_NOT_FOUND: none
 * with counters is bound there. [rt] */
RUNG_API int32_t rung_instance_inconsistent(const rung_instance* instance, const void* address, uint32_t* slices);

/* ---- messages -------------------------------------------------------------------------------------------------- */

typedef struct rung_message_info {
  uint32_t size;
  uint32_t op; /* enum rung_message_op */
  uint32_t number;
  int32_t channel;
  int32_t index;
  uint32_t real; /* 1: `value` is a real */
  rung_value value;
  char text[400]; /* its number as the dialect writes it, and its text; "" for RUNG_MESSAGE_CLEAR */
} rung_message_info;

/* The next message that the program has shown, cleared or logged. RUNG_EMPTY. [any] [rt] */
RUNG_API int32_t rung_instance_next_message(rung_instance* instance, rung_message_info* message);

enum rung_message_flags {
  RUNG_MESSAGE_LASTS = 1,       /* it is shown until the program ends it, else until the operator confirms it */
  RUNG_MESSAGE_LOGGED_ONLY = 2, /* the operator does not see it */
};

/* What the configuration of a machine says of a message, for dialects that have the texts outside of the program;
 * before the first power-on. `flags`: of enum rung_message_flags. `text`: UTF-8; %d, %x and %X are places for the
 * message's values, in their order. The last definition of a number counts. RUNG_NOT_FOUND: the dialect has the texts
 * in the program. RUNG_WRONG_STATE: the program was on. */
RUNG_API int32_t rung_instance_define_message(rung_instance* instance, uint32_t number, uint32_t flags,
                                              const char* text);

/* What the operator sees now: the index-th message. RUNG_EMPTY: there are not so many. */
RUNG_API int32_t rung_instance_shown(const rung_instance* instance, uint32_t index, rung_message_info* message);

/* ---- services -------------------------------------------------------------------------------------------------- */

/* The next request that waits (RUNG_QUEUE). It stays pending in the program until it is answered. RUNG_EMPTY.
 * [any] [rt] */
RUNG_API int32_t rung_instance_next_request(rung_instance* instance, rung_request* request);

/* The program sees the answer before its next slice. The same thread as rung_instance_next_request. RUNG_LATER: there
 * are more answers than the program can have asked for. [any] [rt] */
RUNG_API int32_t rung_instance_answer(rung_instance* instance, const rung_reply* reply);

/* ---- functions of a part program -------------------------------------------------------------------------------- */

enum rung_function_kind {
  RUNG_FUNCTION_M = 0,
  RUNG_FUNCTION_S = 1,
  RUNG_FUNCTION_T = 2,
  RUNG_FUNCTION_B = 3,
  RUNG_FUNCTION_H = 4,
  RUNG_FUNCTION_KEY = 5 /* one of the panel or the screen: it is pressed and released */
};

/* Hands a function of a channel (from 0) over to the program, by the handshake of its dialect; `line` is
 * its own until it is finished. RUNG_LATER: the signals that it needs are in use; RUNG_NOT_FOUND: the control has no
 * such channel, or no signals for this function. [rt] */
RUNG_API int32_t rung_instance_begin_function(rung_instance* instance, uint32_t channel, int32_t kind, uint32_t code,
                                              uint32_t* line);
/* RUNG_OK: the program has finished it; RUNG_LATER: not yet. [rt] */
RUNG_API int32_t rung_instance_function_done(rung_instance* instance, uint32_t channel, uint32_t line);
/* Reset, emergency stop: what is under way in the channel ends at once, unanswered. [rt] */
RUNG_API int32_t rung_instance_abort_functions(rung_instance* instance, uint32_t channel);

/* Whether the dialect has signals for this function in the channel. RUNG_NOT_FOUND: no. [rt] */
RUNG_API int32_t rung_instance_carries_function(const rung_instance* instance, uint32_t channel, int32_t kind,
                                                uint32_t code);
/* The machine has this M function in a group of its choice, from now on. RUNG_NOT_FOUND: the dialect has no such group,
 * or the function has its group for good. */
RUNG_API int32_t rung_instance_group_function(rung_instance* instance, uint32_t channel, uint32_t code, uint32_t group);
/* From now on the program finishes every kind of function by a signal of its own, so that kinds do not wait for each
 * other. RUNG_NOT_FOUND: the dialect has no such handshake. */
RUNG_API int32_t rung_instance_high_speed_functions(rung_instance* instance, uint32_t channel);

/* Whether a CNC carries out the requests of the program; initially yes. Without a CNC no signal says that an axis of
 * the program has stopped; an axis that was moving is an alarm of its dialect, and is stopped when the CNC is there
 * again. [rt] */
RUNG_API int32_t rung_instance_serving(rung_instance* instance, int32_t is_served);

/* ---- axes of the program --------------------------------------------------------------------------------------- */

/* The program commands an axis by the signals of a group, both from 0, and the host moves it:
 * each command is a service request "AXLCTL axis command data-1 data-2", made between two slices, with the command and
 * data as the program has them; command -1 stops the axis. It is answered when the axis has carried it out, with an
 * error where it cannot. RUNG_NOT_FOUND: the dialect has no such axis or group. */
RUNG_API int32_t rung_instance_axis_group(rung_instance* instance, uint32_t axis, uint32_t group);

/* ---- retained memory -------------------------------------------------------------------------------------------- */

/* Keeps retained memory in FILE.a and FILE.b, written in turn, so that a crash at any moment leaves a good one; FILE is
 * `path`. Before the first power-on, which looks at the place; a warm one then takes the contents from there. Saving is
 * done by a thread of the library. */
RUNG_API int32_t rung_instance_keep(rung_instance* instance, const char* path);

/* Waits until what the program has left so far is on disk. RUNG_FAILED: it is not. Not while the scan thread must not
 * wait. */
RUNG_API int32_t rung_instance_flush(rung_instance* instance);

/* Why the last try to write retained memory failed, ended by 0 and cut off where `bytes` does not hold it. RUNG_EMPTY:
 * it did not (see RUNG_STATE_UNSAVED). [any] */
RUNG_API int32_t rung_instance_unsaved(const rung_instance* instance, char* text, size_t bytes);

/* ---- profile ---------------------------------------------------------------------------------------------------- */

typedef struct rung_profile {
  uint32_t size;
  uint32_t rung; /* as drawn, from 1; 0: made by the compiler */
  uint32_t line; /* the first */
  uint32_t reserved;
  const char* file; /* valid as long as the image; so is `title` */
  const char* title;
  uint64_t runs;
  double total_ns; /* without what measuring costs */
  double max_ns;
} rung_profile;

/* Of the index-th rung of the program's tables, since the power-on or rung_instance_clear_profile. RUNG_EMPTY: there
 * are not so many; RUNG_WRONG_STATE: the program was not built for it (rungc build --profile). [rt] */
RUNG_API int32_t rung_instance_profile(const rung_instance* instance, uint32_t index, rung_profile* profile);

/* The rung whose longest run took longest. RUNG_EMPTY: none has run. */
RUNG_API int32_t rung_instance_worst_rung(const rung_instance* instance, rung_profile* profile);

/* Counts and times of all rungs begin anew. RUNG_WRONG_STATE as above. [rt] */
RUNG_API int32_t rung_instance_clear_profile(rung_instance* instance);

/* ---- watching --------------------------------------------------------------------------------------------------- */

/* Cells that other threads look at while the program runs: their values at the end of a scan, all of one scan. Looking
 * does not disturb the scan, which never waits for it. */
typedef struct rung_watch rung_watch;

#define RUNG_MOST_WATCHES 16u /* of an instance */

typedef struct rung_sample {
  uint32_t size;
  uint32_t generation; /* see rung_state */
  uint64_t scan;       /* of the schedule, since the power-on, from 1; also the one that a fault has ended */
  int64_t now_us;      /* the program's clock */
  uint64_t lost;       /* scans since the power-on of the watch that rung_watch_next could not keep */
} rung_sample;

/* Watches the first elements of `count` cells, from the end of this scan on. `depth`: how many scans are kept for
 * rung_watch_next, at most 1000000; 0: none. RUNG_WRONG_TYPE: a text; RUNG_WRONG_STATE: there are RUNG_MOST_WATCHES.
 * Any thread. */
RUNG_API int32_t rung_watch_new(rung_instance* instance, const rung_cell* cells, uint32_t count, uint32_t depth,
                                rung_watch** watch);
/* Null is allowed. Any thread; before its instance. */
RUNG_API int32_t rung_watch_free(rung_watch* watch);

/* The values of the last scan that is over, or of the moment of a fault. RUNG_EMPTY: none has ended since the watch
 * began; RUNG_LATER: the calling thread was interrupted for several scans while it read, several times. A cell that
 * the program no longer has is 0. Any thread, and several at a time; it never waits. [rt] */
RUNG_API int32_t rung_watch_newest(const rung_watch* watch, rung_value* values, rung_sample* sample);

/* The values of every scan, one after the other. RUNG_EMPTY: none waits. Any thread, one at a time. [rt] */
RUNG_API int32_t rung_watch_next(rung_watch* watch, rung_value* values, rung_sample* sample);

/* The scans of a watch as a file for wave viewers (value change dump): it takes them in the place of
 * rung_watch_next. */
typedef struct rung_trace rung_trace;

/* Begins a file. RUNG_FAILED: it cannot be written; RUNG_BAD_ARGUMENT: the watch keeps no scans. Any thread. */
RUNG_API int32_t rung_trace_new(rung_watch* watch, const char* path, rung_trace** trace);
/* Writes all scans that wait; where some were lost, a remark says so. RUNG_EMPTY: none waited; RUNG_FAILED. The thread
 * that takes the watch's scans. */
RUNG_API int32_t rung_trace_write(rung_trace* trace);
/* Writes what waits, and ends the file. RUNG_FAILED: it could not be written. Null is allowed. Before its watch. */
RUNG_API int32_t rung_trace_free(rung_trace* trace);

/* ---- another program while it runs ------------------------------------------------------------------------------ */

/* Prepares another program of the same dialect to take over from the one that runs, and finds out what becomes of its
 * state. `memory`: as in rung_instance_options, of the new program; null: the library's. Any thread: the instance may
 * be scanned by its own meanwhile, but must not be freed; where another program takes over meanwhile, the replacement
 * is for the former one. Measures what the new program costs on this machine, with what its code does to memory of its
 * own. RUNG_REFUSED: of another dialect. */
RUNG_API int32_t rung_replacement_new(rung_instance* instance, rung_image* image, void* memory, size_t memory_bytes,
                                      rung_replacement** replacement);
/* Null is allowed. Any thread, but not while rung_instance_replace has it. */
RUNG_API int32_t rung_replacement_free(rung_replacement* replacement);

typedef struct rung_replacement_info {
  uint32_t size;
  uint32_t kept_cells;  /* names that stay where they are, with their contents */
  uint32_t kept_states; /* of edges, timers, counters */
  uint32_t changes;     /* see rung_replacement_change */
  uint64_t bytes;       /* that the change copies: its time is in proportion to them */
  uint64_t steps;       /* of the new program, at most: of the slice that comes nearest to the time it has */
  uint64_t slice_ns;    /* that this slice may last here: its steps times the most that one was found to cost */
  uint64_t period_ns;   /* the time it has, up to the next slice; 0: the schedule takes no time */
  const char* bound;    /* these figures for people, with the dearest rung; valid as long as the replacement */
  uint32_t program;     /* the number of the new program (rung_instance_program) */
  uint32_t next;        /* the number of the one that takes over with the next rung_instance_replace; 0: none does, as a
                           fault of the new program has put the former one back */
} rung_replacement_info;

/* Of what the next rung_instance_replace does. Any thread. */
RUNG_API int32_t rung_replacement_report(const rung_replacement* replacement, rung_replacement_info* info);

/* Lets the new program take over although a slice of it may last longer than its period. Any thread. */
RUNG_API int32_t rung_replacement_allow_late(rung_replacement* replacement);

enum rung_change_kind {
  RUNG_CHANGE_NEW = 0,      /* starts with its initial contents */
  RUNG_CHANGE_REMOVED = 1,  /* its contents are lost */
  RUNG_CHANGE_MOVED = 2,    /* is elsewhere now; keeps its contents */
  RUNG_CHANGE_RENAMED = 3,  /* a cell that had another name; keeps its contents */
  RUNG_CHANGE_RETYPED = 4,  /* of another type now: starts with its initial contents */
  RUNG_CHANGE_RELEASED = 5, /* an output that the new program does not write: starts anew */
  RUNG_CHANGE_CUT = 6,      /* is elsewhere now; instructions reached more of it than there is room for: that is lost */
};

typedef struct rung_change {
  uint32_t size;
  uint32_t kind;     /* enum rung_change_kind */
  uint32_t is_state; /* 1: of an edge, timer or counter, which the compiler made; 0: a cell with a name */
  uint32_t reserved;
  const char* name;   /* in the new program; of what is removed, in the old one. Valid as long as the replacement */
  const char* former; /* RUNG_CHANGE_RENAMED: the old name; else "" */
} rung_change;

/* The index-th change, cells before states, each in the order of their names. RUNG_EMPTY: there are not so many. */
RUNG_API int32_t rung_replacement_change(const rung_replacement* replacement, uint32_t index, rung_change* change);

enum rung_rung_change_kind {
  RUNG_RUNG_NEW = 0,
  RUNG_RUNG_REMOVED = 1,
  RUNG_RUNG_CHANGED = 2, /* keeps the state of the instructions that it still has */
  RUNG_RUNG_MOVED = 3,   /* among others, or to another routine; keeps its state */
};

typedef struct rung_rung_change {
  uint32_t size;
  uint32_t kind; /* enum rung_rung_change_kind */
  uint32_t rung; /* as drawn, in the new program; of one that was removed, in the former one. So are the next three */
  uint32_t line;
  const char* file; /* valid as long as the replacement; so is `title` */
  const char* title;
} rung_rung_change;

/* The index-th rung that is not the same in both programs: in the order of the new one, then those that were removed.
 * RUNG_EMPTY: there are not so many. Any thread. */
RUNG_API int32_t rung_replacement_rung(const rung_replacement* replacement, uint32_t index, rung_rung_change* change);

/* The program of the replacement takes over, with its state; the clock, queues and bound variables continue. The
 * replacement then holds the former program, and reports the way back: given again, it puts that back, and what is
 * reported as new begins with its initial contents. So does, as long as the replacement exists, a fault of the new
 * program, but that leaves such cells as they were when it took over: the former program then waits for the next
 * power-on, rung_instance_fault still says what happened, and the new one does not come again (RUNG_WRONG_STATE) unless
 * it is prepared anew. Where RUNG_LATER would be given at a fault, the new program stays.
 * RUNG_REFUSED: a slice of the new program may last longer than its period, and the sentence has the figures (see
 * rung_replacement_allow_late). Of jumps that may go in loops each counts once: rung_instance_limit ends them in
 * time. RUNG_LATER: within a scan of the schedule, or a mechanism or a service request waits that the new program does
 * not know; RUNG_WRONG_STATE: it was made for another program than the one that runs. [rt] */
RUNG_API int32_t rung_instance_replace(rung_instance* instance, rung_replacement* replacement);

/* ---- a program beside the one that runs -------------------------------------------------------------------------- */

/* Another program of the same dialect and schedule, which runs on what the instance's program reads and is answered:
 * so that its outputs can be compared before it takes over. It writes nothing but memory of its own; its messages and
 * requests go nowhere, and a request that both programs make in the same run of a task has one answer for both. */
typedef struct rung_shadow rung_shadow;

enum rung_shadow_state {
  RUNG_SHADOW_PREPARED = 0,
  RUNG_SHADOW_RUNNING = 1,
  RUNG_SHADOW_FINISHED = 2, /* all scans are compared */
  RUNG_SHADOW_TOO_SLOW = 3, /* there was no room for a run, or for its more than 32 requests */
  RUNG_SHADOW_STOPPED = 4,  /* by the host, a fault of the instance's program, its power-on or its replacement */
  RUNG_SHADOW_FAULTED = 5,  /* the new program */
};

#define RUNG_MOST_SHADOW_SCANS 1000000u
#define RUNG_MOST_SHADOW_ROOM 4096u

/* Prepares a shadow for `scans` scans of the schedule, with room for `room` runs of tasks that wait for
 * rung_shadow_work: its time. Each takes the instance's memory block twice. Any thread: the instance may be scanned by
 * its own meanwhile, but must not be freed. RUNG_REFUSED: of another dialect or schedule. */
RUNG_API int32_t rung_shadow_new(rung_instance* instance, rung_image* image, uint32_t scans, uint32_t room,
                                 rung_shadow** shadow);
/* Ends it, too, in the thread of the instance; one that has ended (rung_instance_shadow with null) may be freed by any.
 * Null is allowed. Before its instance; no other thread uses the shadow. */
RUNG_API int32_t rung_shadow_free(rung_shadow* shadow);

/* The shadow begins with the state that the instance has now; null: it ends. While it runs, every run of a task copies
 * the memory block twice, and nothing waits for the shadow: where it has no room, it ends. RUNG_LATER: as for
 * rung_instance_replace; RUNG_FAULTED; RUNG_WRONG_STATE: the instance has a shadow, or this one has begun before, or
 * was made for another program than the one that runs. [rt] */
RUNG_API int32_t rung_instance_shadow(rung_instance* instance, rung_shadow* shadow);

/* Runs and compares one run of a task that was recorded. RUNG_EMPTY: none waits. Any thread, one at a time with
 * rung_shadow_report and rung_shadow_difference. */
RUNG_API int32_t rung_shadow_work(rung_shadow* shadow);

typedef struct rung_shadow_info {
  uint32_t size;
  uint32_t state;       /* enum rung_shadow_state */
  uint32_t differences; /* see rung_shadow_difference */
  uint32_t reserved;
  uint64_t runs;     /* of tasks that were compared */
  const char* fault; /* of the new program, "" without one; valid until the next report */
} rung_shadow_info;

RUNG_API int32_t rung_shadow_report(rung_shadow* shadow, rung_shadow_info* info);

typedef struct rung_difference {
  uint32_t size;
  uint32_t type;      /* enum rung_type; 0: a service that the new program alone requests, named by `name` */
  const char* name;   /* of an output; where the dialect does not say what its outputs are, of any cell with a name that
                       * both programs have. Valid until the next report */
  int64_t first_us;   /* of the program's clock, when it was seen first */
  uint64_t runs;      /* of tasks after which it was seen; of requests, how many */
  rung_value running; /* the values that were seen first */
  rung_value next;
} rung_difference;

/* The index-th difference of the last report, in the order of the names. RUNG_EMPTY: there are not so many. */
RUNG_API int32_t rung_shadow_difference(const rung_shadow* shadow, uint32_t index, rung_difference* difference);

/* ---- forcing ----------------------------------------------------------------------------------------------------- */

/* Cells that a person holds at a value: every reader within a scan gets that value, even after a rung has written the
 * cell. A set is prepared, and then put in effect as a whole; one set is in effect at a time. */
typedef struct rung_forces rung_forces;

typedef struct rung_forced_cell {
  const char* name;  /* as for rung_instance_find, for reading; of an array the first element is forced */
  const char* owner; /* who forces it, for others to see; null: "" */
  rung_value value;
  uint32_t access; /* RUNG_READ, or RUNG_REAL: the real that this would find */
  uint32_t reserved;
} rung_forced_cell;

/* Prepares a set of forces: for the program that runs, or, with a replacement, for that of the replacement. Where
 * chunks of the program write a cell, they are compiled anew, by the compiler that made the image or serves it
 * (rung/compiler.h). Any thread: the instance may be scanned by its own meanwhile, but must not be freed.
 * RUNG_NOT_FOUND; RUNG_WRONG_TYPE: a text, a constant, or no room for RUNG_REAL; RUNG_BAD_ARGUMENT: two
 * cells want different values in one place, or an unknown `access`; RUNG_REFUSED: the program writes a cell, and no
 * compiler serves its image; RUNG_LATER: the code is still being compiled; call again later with the same
 * cells. Those of rung/compiler.h never give that. */
RUNG_API int32_t rung_forces_new(rung_instance* instance, rung_replacement* replacement, const rung_forced_cell* cells,
                                 uint32_t count, rung_forces** forces);
/* Null is allowed. Any thread, before its instance; one that is in effect ends, and is freed as a call for the instance
 * is made. */
RUNG_API int32_t rung_forces_free(rung_forces* forces);

/* Puts a set in effect in the place of the one before, from this call on; null: ends all forces. A cell keeps its value
 * when its force ends, until it is written. All forces end by themselves at a power-on, a stop and a fault, whose safe
 * outputs are not forced, and when another program takes over: a set that was made with the replacement can be put in
 * effect before its first scan. RUNG_FAULTED; RUNG_WRONG_STATE: the program is stopped, or the set is of another one.
 * [rt] */
RUNG_API int32_t rung_instance_force(rung_instance* instance, rung_forces* forces);

typedef struct rung_force_info {
  uint32_t size;
  uint32_t type; /* enum rung_type */
  rung_value value;
  int64_t since_us; /* of the program's clock: since when it has been forced to this value by this owner */
  const char* name; /* valid as long as its set; so is `owner` */
  const char* owner;
} rung_force_info;

/* The index-th force in effect, in the order of the names. RUNG_EMPTY: there are not so many. [rt] */
RUNG_API int32_t rung_instance_forced(const rung_instance* instance, uint32_t index, rung_force_info* force);

/* For compilers: how code of an image is made anew. */
typedef struct rung_forced_code {
  const rung_chunk_fn* chunk_fns; /* by chunk */
  void* engine;                   /* what they find in rung_ctx::engine */
  void (*release)(void* owner);   /* called with `owner` when the code runs no longer */
  void* owner;
} rung_forced_code;

typedef struct rung_code_maker {
  uint32_t size;
  uint32_t reserved;
  /* Code for all chunks of the image's program, which runs with `engine`, that leaves the forced bits as they are;
   * `forced` is in the order of space and byte. The handle of the image is for this call alone. An enum rung_status;
   * RUNG_LATER: it is being made. After an error, and RUNG_LATER, `problem` has a sentence of less than
   * `problem_bytes`. By several threads at a time. */
  int32_t (*force)(void* user, const rung_image* image, void* engine, const rung_forced_byte* forced, uint32_t count,
                   rung_forced_code* code, char* problem, size_t problem_bytes);
  void (*release)(void* user); /* called when nothing uses the image any more; may be null */
  void* user;
} rung_code_maker;

/* From now on the maker serves the image. RUNG_WRONG_STATE: another one does. [any] */
RUNG_API int32_t rung_image_serve(rung_image* image, const rung_code_maker* maker);

/* The bytes of the file that the image was opened from, from `first` on: what a compiler has left there for itself.
 * `count` is how many are wanted, and then how many there were. RUNG_EMPTY: it was not opened from a file. [any] */
RUNG_API int32_t rung_image_file(const rung_image* image, uint64_t first, void* bytes, size_t* count);

#ifdef __cplusplus
}
#endif

#endif
