/* The runtime of compiled PLC programs as a library of C11: librung-runtime.
 *
 *   rung_image* image;                                     rung_instance* plc;
 *   rung_image_open("mill.so", NULL, &image);              rung_instance_new(image, NULL, &plc);
 *   rung_instance_power_on(plc, RUNG_WARM);                rung_instance_run_due(plc, 1000000); // every millisecond
 *
 * An image is a compiled program; an instance is a running copy of it with its memory, clock, queues, and the control
 * of its dialect (power-on, clocks, names of the NC's interface, handshake of functions).
 *
 * Results. A function that can fail returns an enum rung_status: 0 if it succeeded; above 0 for another outcome that is
 * not an error; below 0 after an error, in which case it has had no effect, and rung_error_text describes the error in
 * a sentence. Output parameters are unspecified after an error. No call aborts the process, and none throws.
 *
 * Threads. Any thread may use an image. An instance is used by one thread at a time, not necessarily always the same; a
 * call while another thread is in a call returns RUNG_WRONG_THREAD. [any] marks functions that one further thread may
 * call at the same time. A callback may only read cells of its instance that were found before, its state and its
 * fault.
 *
 * Real time. [rt] marks functions that allocate nothing, take no lock, do not block and make no system call, provided
 * that the callbacks do not either; their time is bounded by the work of the program. Other functions are for the
 * start, the end and other threads.
 *
 * Structs with a `size` may get further fields at their end: the caller sets `size` to sizeof, and only fields known to
 * both sides are copied. Texts are UTF-8. Times are in microseconds of the program's clock (_us) or nanoseconds of the
 * computer's clock (_ns). */
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
  RUNG_BAD_HANDLE = -1,   /* null, of another kind, or freed if that can be detected */
  RUNG_BAD_ARGUMENT = -2, /* null, out of range, or a wrong `size` */
  RUNG_WRONG_THREAD = -3, /* another thread is in a call for this instance */
  RUNG_WRONG_STATE = -4,  /* before the power-on, in a callback, a second time, ... */
  RUNG_NOT_FOUND = -5,    /* no such name, or the running program does not have it any more */
  RUNG_WRONG_TYPE = -6,   /* a text instead of a number, writing a cell found for reading, ... */
  RUNG_OVERWRITTEN = -7, /* the program would never see the value: another place is copied over the cell, or the control
                            itself writes it */
  RUNG_REFUSED = -8,     /* the file is damaged, may not be trusted, or is not a program of this version */
  RUNG_OUT_OF_MEMORY = -9,
  RUNG_FAILED = -10, /* an error of the system: a file cannot be written, a thread cannot be started */
};

/* The sentence of the last error in this thread, or of RUNG_LATER from rung_instance_replace, rung_instance_shadow and
 * rung_forces_new; "" before the first. Valid until the thread's next call. [any] [rt] */
RUNG_API const char* rung_error_text(void);

/* The version of this header. */
#define RUNG_RUNTIME_MAJOR 0u
#define RUNG_RUNTIME_MINOR 1u
/* The version of the library: major << 16 | minor. A host that was built with this header can use a library of the same
 * major and the same or a higher minor version. [any] [rt] */
RUNG_API uint32_t rung_runtime_version(void);

/* ---- images ---------------------------------------------------------------------------------------------------- */

typedef struct rung_image rung_image;

typedef struct rung_image_options {
  uint32_t size;
  uint32_t allow_unsealed; /* 1: accept a shared object that `rungc build` or `rungc seal` has not sealed; ignored in a
                              process with more privileges than its user */
  const char* keys_folder; /* folder of public keys; null: the system's. Ignored in a privileged process */
} rung_image_options;

/* Loads a compiled program. The seal and the owner of the file are checked before any of it is loaded (docs/security).
 * `options` may be null. RUNG_REFUSED, RUNG_OUT_OF_MEMORY. */
RUNG_API int32_t rung_image_open(const char* path, const rung_image_options* options, rung_image** image);

/* Loads a compiled program from a memory file (memfd_create) made by a process that the caller trusts, such as its own
 * compiler. The owner is not checked; the file must be sealed against every change (F_SEAL_WRITE, F_SEAL_SHRINK,
 * F_SEAL_GROW, F_SEAL_SEAL). Its contents are checked as those of a file. The descriptor still belongs to the caller;
 * errors refer to the file as `name`. RUNG_REFUSED, RUNG_OUT_OF_MEMORY. */
RUNG_API int32_t rung_image_open_memory(int32_t file, const char* name, rung_image** image);

/* Makes an image of a program that is already in memory, because it is linked into the host or was made by a compiler.
 * Its chunks find `engine` in rung_ctx::engine. `release`, which may be null, is called with `owner` when nothing uses
 * the image any more. RUNG_REFUSED: its tables are not those of a program of this version; then `release` is not
 * called. */
RUNG_API int32_t rung_image_adopt(const rung_program* program, void* engine, void (*release)(void* owner), void* owner,
                                  rung_image** image);

/* The program's tables, valid until the image is closed; null for a handle that is not an image's. [rt] */
RUNG_API const rung_program* rung_image_program(const rung_image* image);

/* Frees the handle of an image. The program stays loaded until all instances and replacements that use it are freed.
 * Null is allowed. */
RUNG_API int32_t rung_image_close(rung_image* image);

/* ---- instances ------------------------------------------------------------------------------------------------- */

typedef struct rung_instance rung_instance;

enum rung_log_level { RUNG_LOG_INFO = 0, RUNG_LOG_WARNING = 1, RUNG_LOG_ERROR = 2 };

/* The handling of a service request of the program (a window function, a macro variable, a block of movement). */
enum rung_answer {
  RUNG_REFUSE = 0, /* the control answers at once, as without a CNC */
  RUNG_ANSWER = 1, /* the reply is filled in */
  RUNG_QUEUE = 2,  /* the request is queued for rung_instance_next_request */
};

typedef struct rung_request {
  uint32_t size;
  uint32_t ticket;
  const char* service; /* as in rung_program::services: name, arguments, results; valid as long as the instance */
  uint32_t arg_count;
  uint32_t kind; /* number of this service, the same in all programs of the dialect; 0: unknown to the library */
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
  RUNG_MEASURE = 1,        /* the times of scans are measured, with two clock readings per slice */
  RUNG_QUEUE_REQUESTS = 2, /* without a `request` callback, requests are queued for rung_instance_next_request */
  RUNG_SAVE_AT_ONCE = 4,   /* memory that the program requests to be saved is on disk when a call returns, which then is
                              not real time: for hosts that run a program faster than its clock */
};

typedef struct rung_instance_options {
  uint32_t size;
  uint32_t flags; /* enum rung_instance_flags */
  /* The memory block: at least memory_size bytes, aligned to memory_align (rung_image_program), for the life of the
   * instance. Null: the library allocates it, and the copies of an NC's area at the beginning of tasks are limited to
   * bytes that rungs and cells of the host access, which takes less time; in a block of the host everything is
   * copied. */
  void* memory;
  size_t memory_bytes;
  void* user; /* argument of the callbacks, each of which may be null */
  /* Receives messages for the operator: retained memory was lost, a file cannot be written. Never called within a call
   * marked [rt]. */
  void (*log)(void* user, int32_t level, const char* text);
  /* The program requests a service, within a scan or before a slice. Returns an enum rung_answer. */
  int32_t (*request)(void* user, rung_instance* instance, const rung_request* request, rung_reply* reply);
  /* A fault has stopped the program, within a scan or the power-on: the outputs that its dialect clears are 0, and so
   * are the bound variables that the program writes. */
  void (*fault)(void* user, rung_instance* instance);
  /* The maximum number of scans that one call of rung_instance_run_due runs after a delay; 0: one, the scan that is
   * due. */
  uint32_t catch_up;
  /* The number of successive scans, each after skipped ones, at which the computer counts as too slow for the program:
   * the fault "overrun". 0: 500; RUNG_NONE: never. */
  uint32_t most_overruns;
} rung_instance_options;

/* Makes an instance, which is not switched on yet. `options` may be null. RUNG_OUT_OF_MEMORY. */
RUNG_API int32_t rung_instance_new(rung_image* image, const rung_instance_options* options, rung_instance** instance);

/* Frees an instance without switching it off (rung_instance_power_off): values written for the host stay. Before it
 * returns, it tries to save retained memory that is not on disk yet. Null is allowed. Its watches, replacements and
 * sets of forces must be freed before. */
RUNG_API int32_t rung_instance_free(rung_instance* instance);

/* ---- power ----------------------------------------------------------------------------------------------------- */

enum rung_power {
  RUNG_COLD = 0, /* memory as in a new machine */
  RUNG_WARM = 1, /* retained memory keeps its contents: from disk (rung_instance_keep), else those of the instance */
};

/* Switches the program on, or off and on again, also after a fault. Bound variables and blocks that the program writes
 * are 0 until its first slice. RUNG_FAULTED: a task that runs at power-on has faulted; RUNG_FAILED: the retained memory
 * cannot be loaded or saved (rung_instance_keep), and the program is off. */
RUNG_API int32_t rung_instance_power_on(rung_instance* instance, int32_t power);

/* A regular power-off: runs the last scans that the dialect needs, and saves the retained memory to disk. RUNG_FAILED:
 * it could not be saved, and rung_error_text says why; the program is switched off nevertheless. */
RUNG_API int32_t rung_instance_power_off(rung_instance* instance);

/* Begins a regular power-off of a real machine, so that the last scans of the program have fresh inputs and the machine
 * gets their outputs. RUNG_LATER: the program needs further scans; the host runs it as usual, and calls this again
 * after each step. RUNG_OK: it needs no more, or has reached the limit; then rung_instance_power_off switches it off.
 * Without this call rung_instance_power_off runs the last scans, with the inputs as they are. [rt] */
RUNG_API int32_t rung_instance_begin_power_off(rung_instance* instance);

/* The operator's stop and start: in a stopped program only the clock advances, and values written for the host stay.
 * [rt] */
RUNG_API int32_t rung_instance_stop(rung_instance* instance);
RUNG_API int32_t rung_instance_start(rung_instance* instance);

/* ---- running --------------------------------------------------------------------------------------------------- */

/* The clock of the host has advanced by `elapsed_ns` (0 to one hour): runs the slices of the schedule that are due. Of
 * late scans up to `catch_up` (rung_instance_options) run; the others are skipped, and timers stay right. RUNG_FAULTED.
 * [rt] */
RUNG_API int32_t rung_instance_run_due(rung_instance* instance, int64_t elapsed_ns);

/* The same for a host that runs the fast task (INT0, Level 1, MODULE_FAST) separately: a slice that is due runs up to
 * the end of its fast task; the next rung_instance_run_due, with the time since this call as `elapsed_ns`, runs the
 * rest of it with the same inputs, and late slices. If no slice is due, or it has no fast task, nothing runs. To be
 * called by the same thread. RUNG_FAULTED. [rt] */
RUNG_API int32_t rung_instance_run_due_fast(rung_instance* instance, int64_t elapsed_ns);

/* Run one slice of the schedule, after advancing the clock to its time (see `due_us` of rung_state); the rest of a
 * scan, whatever the time; the rest of a slot, for dialects that have slots; one run of the fast task only.
 * RUNG_FAULTED. [rt] */
RUNG_API int32_t rung_instance_slice(rung_instance* instance);
RUNG_API int32_t rung_instance_scan(rung_instance* instance);
RUNG_API int32_t rung_instance_slot(rung_instance* instance);
RUNG_API int32_t rung_instance_fast(rung_instance* instance);

/* Takes a sample now for watches that have none yet: for hosts that do not run a program stopped by a fault. [rt] */
RUNG_API int32_t rung_instance_sample(rung_instance* instance);

/* Sets the time limit of a slice in nanoseconds, also if a call runs several slices; a slice that exceeds it is a
 * fault. 0: only the budgets of its tasks apply. [rt] */
RUNG_API int32_t rung_instance_limit(rung_instance* instance, int64_t ns);

/* Prefetches the code, tables and memory that a scan reads into the processor's caches, by reading one byte of each
 * 64-byte line, until all has been read or CLOCK_MONOTONIC reaches `until_ns`. Changes nothing and runs nothing. For
 * hosts that wake some microseconds before a slice is due. Code is read only if the program is in a file of its own.
 * [rt] */
RUNG_API int32_t rung_instance_prefetch(const rung_instance* instance, int64_t until_ns);

enum rung_state_flags {
  RUNG_STATE_ON = 1,       /* switched on */
  RUNG_STATE_STOPPED = 2,  /* stopped by rung_instance_stop */
  RUNG_STATE_FAULTED = 4,  /* stopped by a fault */
  RUNG_STATE_AT_START = 8, /* between two scans of the schedule */
  RUNG_STATE_UNSAVED = 16, /* the last attempt to write retained memory has failed */
};

typedef struct rung_state {
  uint32_t size;
  uint32_t flags;         /* enum rung_state_flags */
  uint32_t generation;    /* number of programs that have taken over: offsets and tables looked up before a change are
                             invalid */
  uint32_t due_us;        /* time on the program's clock until the next slice */
  int64_t now_us;         /* the program's clock */
  int64_t wait_ns;        /* for rung_instance_run_due: until the next slice is due; 0 or less: it is due */
  uint64_t scans;         /* scans of the schedule since the power-on */
  uint64_t missed;        /* scans that rung_instance_run_due has skipped */
  int64_t last_ns;        /* time of the last complete scan, with RUNG_MEASURE */
  int64_t worst_ns;       /* the longest since the power-on, with RUNG_MEASURE */
  uint32_t lost_messages; /* messages dropped because the host did not take them in time */
  uint32_t refused_requests; /* service requests refused because too many were unanswered */
  uint32_t stray_replies;    /* replies to tickets that were not pending */
  uint32_t program;          /* number of the running program (rung_instance_program) */
  uint64_t saves;            /* images of retained memory written */
  uint64_t failed_saves;     /* failed attempts to write one */
} rung_state;

/* [rt] */
RUNG_API int32_t rung_instance_state(const rung_instance* instance, rung_state* state);

/* The programs of an instance are numbered: 1 is that of rung_instance_new, and each replacement gets the next number
 * when it is made. */
typedef struct rung_program_info {
  uint32_t size;
  uint32_t number;  /* of the running program */
  uint32_t faulted; /* number of another program that a fault has stopped, until the next power-on; 0: none */
  uint32_t reserved;
  char name[128]; /* name of the running program; longer names are cut off */
  char faulted_name[128];
} rung_program_info;

/* The program that runs at this moment. [any] */
RUNG_API int32_t rung_instance_program(const rung_instance* instance, rung_program_info* program);

typedef struct rung_fault_info {
  uint32_t size;
  uint32_t rung; /* as drawn, from 1; 0: none */
  uint32_t line; /* 0: unknown */
  uint32_t reserved;
  const char* code; /* "dead-loop"; valid as long as the image; so are the next two */
  const char* file; /* "" if it is unknown */
  const char* task;
  char text[256]; /* the whole fault as a text */
} rung_fault_info;

/* The fault that has stopped the program. RUNG_EMPTY: there is none. */
RUNG_API int32_t rung_instance_fault(const rung_instance* instance, rung_fault_info* fault);

/* ---- names and values ------------------------------------------------------------------------------------------ */

/* A cell that was found by its name. It is valid until it is released or the instance is freed: when another program
 * takes over, it refers to the cell of that name there. An instance can have 65536 cells. */
typedef uint32_t rung_cell;

enum rung_access {
  RUNG_READ = 0,
  RUNG_WRITE = 1, /* for writing by the machine or a user, and for reading the place that is written */
  RUNG_REAL = 2,  /* in addition: the 64-bit real at that place, in a longer cell or in two words */
};

/* Finds a cell by a name of the program, an address of the dialect or a signal of the NC's interface, with index, bit
 * or width as the dialect writes them. The same name gives the same cell. RUNG_NOT_FOUND; RUNG_OVERWRITTEN with
 * RUNG_WRITE: the sentence says where to write; RUNG_WRONG_TYPE: a constant with RUNG_WRITE, or no space for a real
 * with RUNG_REAL. `access`: values of enum rung_access, added. Any thread. */
RUNG_API int32_t rung_instance_find(rung_instance* instance, const char* name, int32_t access, rung_cell* cell);

typedef struct rung_cell_info {
  uint32_t size;
  uint32_t type;   /* enum rung_type */
  uint32_t count;  /* elements; bytes of a text */
  uint32_t access; /* enum rung_access, as given to rung_instance_find */
  uint32_t space;  /* in rung_program::spaces; RUNG_NONE: a constant */
  uint32_t byte;   /* in the space */
  uint32_t bit;    /* of `byte` */
  uint32_t reserved;
  char address[64]; /* as the dialect writes it; a longer one is cut off */
} rung_cell_info;

/* Describes a cell in the running program. Errors as in rung_instance_find. Any thread. */
RUNG_API int32_t rung_instance_cell(const rung_instance* instance, rung_cell cell, rung_cell_info* info);

typedef struct rung_replacement rung_replacement; /* below */

/* Describes a name without making a cell: in the running program or, with a replacement, in the program that would take
 * over with it. `value`: of a constant. Errors as in rung_instance_find. Any thread. */
RUNG_API int32_t rung_instance_describe(const rung_instance* instance, const rung_replacement* replacement,
                                        const char* name, int32_t access, rung_cell_info* info, int64_t* value);

/* Releases a cell; a cell that was found several times must be released as often. Bound cells and those of watches stay
 * valid. Any thread. */
RUNG_API int32_t rung_instance_release(rung_instance* instance, rung_cell cell);

/* The value of an element: a double for cells of a real, for all others a sign-extended integer; cast it to an unsigned
 * type of the cell's width for an unsigned value. A bit is 0 or 1. When a narrower cell is written, it gets the lowest
 * bits. */
typedef union rung_value {
  int64_t integer;
  double real;
} rung_value;

/* Read or write `count` elements of a cell from index `first` on; for cells that are not arrays, one from index 0.
 * RUNG_BAD_ARGUMENT: there are not that many; RUNG_WRONG_TYPE: a text, or writing a cell found for reading. [rt] */
RUNG_API int32_t rung_instance_read(const rung_instance* instance, rung_cell cell, uint32_t first, uint32_t count,
                                    rung_value* values);
RUNG_API int32_t rung_instance_write(rung_instance* instance, rung_cell cell, uint32_t first, uint32_t count,
                                     const rung_value* values);

/* Read or write the first elements of `count` cells in one call, all at the same moment. Either all are written or
 * none. [rt] */
RUNG_API int32_t rung_instance_read_all(const rung_instance* instance, const rung_cell* cells, uint32_t count,
                                        rung_value* values);
RUNG_API int32_t rung_instance_write_all(rung_instance* instance, const rung_cell* cells, uint32_t count,
                                         const rung_value* values);

/* Read a text from the program's memory, null-terminated and cut off to `bytes`; write a text, cut off to the length of
 * the cell. RUNG_WRONG_TYPE. */
RUNG_API int32_t rung_instance_read_text(const rung_instance* instance, rung_cell cell, char* text, size_t bytes);
RUNG_API int32_t rung_instance_write_text(rung_instance* instance, rung_cell cell, const char* text);

/* The symbol with this index among the author's names, constants included, sorted by bytes. The name is valid as long
 * as the image. RUNG_EMPTY: there are not that many. [any] [rt] */
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
  RUNG_HOST_BOOL = 1, /* a byte: 0 is false */
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
  RUNG_TO_PROGRAM = 0,   /* copied before every slice; a block: when a task that reads it begins */
  RUNG_FROM_PROGRAM = 1, /* copied after every slice; 0 after a fault and after the power-off */
  RUNG_BOUND_REAL = 2,   /* in addition, for a variable: the real that RUNG_REAL finds */
};

typedef struct rung_variable {
  const char* name;   /* as for rung_instance_find */
  void* address;      /* of the host's variable, aligned for its type, valid for the life of the instance */
  uint32_t type;      /* enum rung_host_type */
  uint32_t direction; /* values of enum rung_direction, added */
  double scale;       /* of RUNG_HOST_F32 and F64: units of the program per unit of the host; 0 means 1 */
} rung_variable;

/* Binds variables of the host to cells, in addition to those already bound: from now on they are copied before and
 * after slices. An integer is truncated to a narrower cell, and extended to a wider variable, with its sign if the
 * variable is signed. A real is rounded to an integer cell and saturated. Either all are bound or none; errors as in
 * rung_instance_find. */
RUNG_API int32_t rung_instance_bind(rung_instance* instance, const rung_variable* variables, uint32_t count);

/* Memory of the host for bytes of a space, in the layout of the dialect: little-endian, bit 0 is the lowest. */
typedef struct rung_block {
  const char* name;   /* of its first cell, as for rung_instance_find; it must begin at a byte */
  void* address;      /* of the host's memory, with any alignment, valid for the life of the instance */
  uint32_t bytes;     /* at least 1; at most up to the end of the space, or of a cell placed by the compiler */
  uint32_t direction; /* enum rung_direction */
} rung_block;

/* Binds blocks, in addition to those already bound. From a block to the program, each run of a task copies the bytes
 * that the task may read, once at its beginning, before its input copies; a task that begins within another one may
 * copy the same byte again. Bytes that no task of the schedule reads are copied before every slice, for the control and
 * the host. A block takes precedence over a variable bound to the same cell. Either all are bound or none; errors as in
 * rung_instance_find, RUNG_OVERWRITTEN for any of its bytes, RUNG_WRONG_TYPE for a constant. */
RUNG_API int32_t rung_instance_bind_blocks(rung_instance* instance, const rung_block* blocks, uint32_t count);

/* A member of a host's struct that is bound to a cell; rungc bind makes these tables (docs/bind.md). */
typedef struct rung_member {
  const char* name;   /* of the cell, as for rung_instance_find; for a block, of its first cell */
  const char* member; /* as written in C, "axis[0].position" */
  uint32_t offset;    /* in the struct */
  uint32_t bytes;     /* of the member; for a bit-field, the bytes that it occupies; at most 8 except for blocks */
  uint32_t type;      /* enum rung_host_type, of which a bit-field uses only the sign; 0: a block, see rung_block */
  uint32_t direction; /* values of enum rung_direction, added */
  uint32_t bit;       /* of a bit-field: its lowest bit, 0 to 7 of the byte at `offset` */
  uint32_t bits;      /* of a bit-field: its width, bit + bits at most 64; 0: it is not a bit-field */
  double scale;       /* as in rung_variable */
} rung_member;

/* A struct of the host in the layout of the host's compiler, and its bound members. */
typedef struct rung_layout {
  uint32_t size;
  uint32_t bytes;             /* of the host's struct */
  const char* name;           /* "NcBlock" */
  const char* text;           /* the bindings, one line for each member, for error texts */
  uint64_t hash;              /* of `text` */
  const rung_member* members; /* valid for the life of the instance, as the whole struct */
  uint32_t member_count;
  /* Counters by which a reader detects an inconsistent copy: the writer increments `head`, writes, and sets `tail` to
   * `head`. */
  uint32_t counter_bytes; /* 1, 2, 4 or 8; 0: there are none */
  uint32_t head;          /* offsets of the counters */
  uint32_t tail;
  /* Returns the name of a bit-field that the host's compiler places elsewhere than the table says, or null. The
   * function is null if the struct has no bit-fields. */
  const char* (*moved)(void);
} rung_layout;

/* Binds a struct, in addition to existing bindings. Members are copied like bound variables or blocks, with these
 * differences: a bit gets 0 if an integer member is 0, else 1, and members need not be aligned. Either all are bound or
 * none.
 *
 * With counters all members to the program are copied together before every slice, and checked: if the host wrote
 * during every attempt, the program gets the last consistent copy again, or zeros before the first one.
 *
 * RUNG_REFUSED: the program was compiled for another layout of the struct (rungc build --binding); a program that is to
 * replace it is refused, too. Other errors as in rung_instance_bind and rung_instance_bind_blocks. */
RUNG_API int32_t rung_instance_bind_struct(rung_instance* instance, const rung_layout* layout, void* address);

/* The number of successive slices, up to now, without a consistent copy of the struct at this address. RUNG_NOT_FOUND:
 * no struct with counters is bound there. [rt] */
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
  char text[400]; /* the number as the dialect writes it, and the text; "" for RUNG_MESSAGE_CLEAR */
} rung_message_info;

/* The next message that the program has shown, cleared or logged. RUNG_EMPTY. [any] [rt] */
RUNG_API int32_t rung_instance_next_message(rung_instance* instance, rung_message_info* message);

enum rung_message_flags {
  RUNG_MESSAGE_LASTS = 1,       /* shown until the program ends it; else until the operator confirms it */
  RUNG_MESSAGE_LOGGED_ONLY = 2, /* not shown to the operator */
};

/* Defines a message as the machine's configuration does, for dialects whose message texts are outside the program;
 * before the first power-on. `flags`: enum rung_message_flags. `text`: UTF-8; %d, %x and %X are placeholders for the
 * message's values, in order. The last definition of a number counts. RUNG_NOT_FOUND: the dialect has the texts in the
 * program. RUNG_WRONG_STATE: the program has been on. */
RUNG_API int32_t rung_instance_define_message(rung_instance* instance, uint32_t number, uint32_t flags,
                                              const char* text);

/* The message with this index among those that the operator sees now. RUNG_EMPTY: there are not that many. */
RUNG_API int32_t rung_instance_shown(const rung_instance* instance, uint32_t index, rung_message_info* message);

/* ---- services -------------------------------------------------------------------------------------------------- */

/* Takes the next queued request (RUNG_QUEUE). It is pending in the program until it is answered. RUNG_EMPTY. [any]
 * [rt] */
RUNG_API int32_t rung_instance_next_request(rung_instance* instance, rung_request* request);

/* Answers a request; the program sees the answer before its next slice. The same thread as rung_instance_next_request.
 * RUNG_LATER: there are more answers than requests that the program can have made. [any] [rt] */
RUNG_API int32_t rung_instance_answer(rung_instance* instance, const rung_reply* reply);

/* ---- functions of a part program -------------------------------------------------------------------------------- */

enum rung_function_kind {
  RUNG_FUNCTION_M = 0,
  RUNG_FUNCTION_S = 1,
  RUNG_FUNCTION_T = 2,
  RUNG_FUNCTION_B = 3,
  RUNG_FUNCTION_H = 4,
  RUNG_FUNCTION_KEY = 5 /* a key of the panel or the screen: it is pressed and released */
};

/* Starts a function of a channel (from 0) by the handshake of the dialect; `function` is its handle until it is
 * finished. RUNG_LATER: the signals that it needs are in use; RUNG_NOT_FOUND: the control has no such channel, or no
 * signals for this function. [rt] */
RUNG_API int32_t rung_instance_begin_function(rung_instance* instance, uint32_t channel, int32_t kind, uint32_t code,
                                              uint32_t* function);
/* RUNG_OK: the program has finished it; RUNG_LATER: not yet. [rt] */
RUNG_API int32_t rung_instance_function_done(rung_instance* instance, uint32_t channel, uint32_t function);
/* Reset, emergency stop: functions under way in the channel end at once, without an answer. [rt] */
RUNG_API int32_t rung_instance_abort_functions(rung_instance* instance, uint32_t channel);

/* Whether the dialect has signals for this function in the channel. RUNG_NOT_FOUND: no. [rt] */
RUNG_API int32_t rung_instance_supports_function(const rung_instance* instance, uint32_t channel, int32_t kind,
                                                 uint32_t code);
/* Assigns this M function to a group, from now on. RUNG_NOT_FOUND: the dialect has no such group, or the group of the
 * function is fixed. */
RUNG_API int32_t rung_instance_group_function(rung_instance* instance, uint32_t channel, uint32_t code, uint32_t group);
/* From now on the program finishes each kind of function by a separate signal, so that kinds do not wait for each
 * other. RUNG_NOT_FOUND: the dialect has no such handshake. */
RUNG_API int32_t rung_instance_high_speed_functions(rung_instance* instance, uint32_t channel);

/* Sets whether a CNC carries out the requests of the program; initially yes. Without a CNC no signal reports that an
 * axis of the program has stopped; an axis that was moving raises an alarm of its dialect, and is stopped when the CNC
 * returns. [rt] */
RUNG_API int32_t rung_instance_serving(rung_instance* instance, int32_t is_served);

/* ---- axes of the program --------------------------------------------------------------------------------------- */

/* From now on the program commands an axis by the signals of a group, both from 0, and the host moves it: each command
 * is a service request "AXLCTL axis command data-1 data-2", made between two slices, with command and data as in the
 * program; command -1 stops the axis. The host answers it when the axis has executed it, or with an error.
 * RUNG_NOT_FOUND: the dialect has no such axis or group. */
RUNG_API int32_t rung_instance_axis_group(rung_instance* instance, uint32_t axis, uint32_t group);

/* ---- retained memory -------------------------------------------------------------------------------------------- */

/* Stores retained memory in FILE.a and FILE.b, where FILE is `path`, written in turn, so that a crash at any moment
 * leaves a good one. To be called before the first power-on, which checks the files; a warm power-on loads the contents
 * from them. A thread of the library saves. */
RUNG_API int32_t rung_instance_keep(rung_instance* instance, const char* path);

/* Waits until the present retained memory is on disk. RUNG_FAILED: it is not. Not in real time. */
RUNG_API int32_t rung_instance_flush(rung_instance* instance);

/* Why the last attempt to write retained memory failed, null-terminated and cut off to `bytes`. RUNG_EMPTY: it did not
 * fail (see RUNG_STATE_UNSAVED). [any] */
RUNG_API int32_t rung_instance_unsaved(const rung_instance* instance, char* text, size_t bytes);

/* ---- state ------------------------------------------------------------------------------------------------------ */

/* The state between two scans as bytes: everything on which further scans depend except the host and the settings that
 * it has made. It includes the memory with the compiler's own cells, the clock, a fault, the operator's stop, the
 * tickets of requests with the requests and replies that wait, the control's handshakes and messages, a simulated
 * control with its machine, and the number of scans. The same program has the same states on every engine and machine.
 */

/* Writes the state to `bytes`; `used` receives its size. A null pointer with size 0 only asks for the size. RUNG_LATER:
 * within a scan. RUNG_BAD_ARGUMENT: the state is larger than `size`; the contents of `bytes` are unspecified.
 * RUNG_WRONG_STATE: off. [rt] */
RUNG_API int32_t rung_instance_save(const rung_instance* instance, void* bytes, size_t size, size_t* used);

/* Continues from a state of the same program, which must be switched on. Messages that wait for the host stay. No other
 * thread may take requests or answer them meanwhile; requests that had been taken when the state was saved are open
 * again, and wait for an answer by their tickets. RUNG_REFUSED: a state of another program, or damaged; after a damaged
 * one the program is off. RUNG_WRONG_STATE: other cells are forced than when it was saved, or with other values. */
RUNG_API int32_t rung_instance_load(rung_instance* instance, const void* bytes, size_t size);

/* Sets the program's clock, between two slices; timers see the difference as elapsed time. RUNG_BAD_ARGUMENT: it would
 * go back, or advance by more than an hour. [rt] */
RUNG_API int32_t rung_instance_set_clock(rung_instance* instance, int64_t now_us);

/* ---- recording -------------------------------------------------------------------------------------------------- */

/* What the host does to an instance while its program runs, in files of a folder (docs/recording.md), from which a
 * developer computes every moment again: inputs, written cells, answers, functions, forces, replacements, the clock,
 * and the whole state now and then. The scan thread hands over a few bytes and never waits; a thread of the library
 * packs and writes them. If it cannot keep pace or the disk is full, the recording has gaps, which it names. */

typedef struct rung_recording_options {
  uint32_t size;
  uint32_t state_ms;    /* of the program's clock, between two whole states; 0: 10000 */
  const char* folder;   /* made if it does not exist; one instance records into it at a time */
  uint64_t limit_bytes; /* of all files but kept ones; the oldest are deleted. 0: 512 MB */
  uint64_t kept_bytes;  /* the same of kept ones; 0: 256 MB */
} rung_recording_options;

/* Begins to record an instance, best before the first power-on; null ends the recording. No other thread may be using
 * the other functions of this section meanwhile. RUNG_FAILED: the folder or the file of the program cannot be written,
 * or another process records there. RUNG_WRONG_STATE: it is recorded already, or blocks or structs are bound that the
 * program reads. */
RUNG_API int32_t rung_instance_record(rung_instance* instance, const rung_recording_options* options);

/* Writes a text of at most 400 bytes into the recording, and keeps the files of now. [any] */
RUNG_API int32_t rung_instance_mark(rung_instance* instance, const char* text);

/* Keeps the files of now: they are not deleted before `kept_bytes` is reached. [any] */
RUNG_API int32_t rung_instance_keep_recording(rung_instance* instance);

/* For two seconds what is recorded is in the file after 33 ms instead of 80 ms. [any] */
RUNG_API int32_t rung_instance_follow_recording(rung_instance* instance);

typedef struct rung_recording_info {
  uint32_t size;
  uint32_t reserved;
  int64_t since_us; /* since 1970, UTC: when the oldest file began; 0: there is none */
  uint64_t bytes;   /* of all files of recordings in the folder */
  uint64_t written; /* bytes written since the recording began */
  uint64_t losses;  /* gaps since then: the ring was full, or the disk */
  char folder[512];
  char file[512];    /* that is written now; "": none */
  char problem[512]; /* why nothing is written; "": all is well */
} rung_recording_info;

/* RUNG_WRONG_STATE: nothing is recorded. [any] */
RUNG_API int32_t rung_instance_recording(const rung_instance* instance, rung_recording_info* info);

/* ---- profile ---------------------------------------------------------------------------------------------------- */

typedef struct rung_profile {
  uint32_t size;
  uint32_t rung; /* as drawn, from 1; 0: made by the compiler */
  uint32_t line; /* the first line */
  uint32_t reserved;
  const char* file; /* valid as long as the image; so is `title` */
  const char* title;
  uint64_t runs;
  double total_ns; /* without the cost of measuring */
  double max_ns;
} rung_profile;

/* Counts and times of the rung with this index in the program's tables, since the power-on or
 * rung_instance_clear_profile. RUNG_EMPTY: there are not that many; RUNG_WRONG_STATE: the program was not built for it
 * (rungc build --profile). [rt] */
RUNG_API int32_t rung_instance_profile(const rung_instance* instance, uint32_t index, rung_profile* profile);

/* The rung with the longest single run. RUNG_EMPTY: none has run. */
RUNG_API int32_t rung_instance_worst_rung(const rung_instance* instance, rung_profile* profile);

/* Resets counts and times of all rungs. RUNG_WRONG_STATE as above. [rt] */
RUNG_API int32_t rung_instance_clear_profile(rung_instance* instance);

/* ---- timers ----------------------------------------------------------------------------------------------------- */

typedef struct rung_timer_info {
  uint32_t size;
  uint32_t rung;    /* as drawn, from 1; 0: none */
  uint32_t line;    /* the rung's first line */
  uint32_t running; /* 1: its time has begun, and is not over */
  uint32_t runs;    /* 1: it counts runs of its instruction; 0: microseconds */
  uint32_t reserved;
  const char* name; /* the instruction as its dialect writes it; valid as long as the image, like the next two */
  const char* file;
  const char* title;
  int64_t elapsed;   /* 0 if it does not run; negative: not known, as the next two */
  int64_t remaining; /* 0 if it does not run */
  int64_t preset;
} rung_timer_info;

/* The timer with this index in the program's tables, between two scans. Not among them are timers whose place the
 * program computes. RUNG_EMPTY: there are not that many. [rt] */
RUNG_API int32_t rung_instance_timer(const rung_instance* instance, uint32_t index, rung_timer_info* timer);

/* ---- watching --------------------------------------------------------------------------------------------------- */

/* Cells that other threads watch while the program runs: their values at the end of a scan, all of the same scan. The
 * scan never waits for these threads. */
typedef struct rung_watch rung_watch;

#define RUNG_MOST_WATCHES 16u /* maximum for an instance */

typedef struct rung_sample {
  uint32_t size;
  uint32_t generation; /* see rung_state */
  uint64_t scan;       /* number of the scan since the power-on, from 1, also of a scan ended by a fault */
  int64_t now_us;      /* the program's clock */
  uint64_t lost;       /* scans that were not kept for rung_watch_next, since the watch was made */
} rung_sample;

/* Watches the first elements of `count` cells, from the end of the current scan on. `depth`: number of scans kept for
 * rung_watch_next, at most 1000000; 0: none. RUNG_WRONG_TYPE: a text; RUNG_WRONG_STATE: there are RUNG_MOST_WATCHES
 * watches. Any thread. */
RUNG_API int32_t rung_watch_new(rung_instance* instance, const rung_cell* cells, uint32_t count, uint32_t depth,
                                rung_watch** watch);
/* Null is allowed. Any thread; before its instance is freed. */
RUNG_API int32_t rung_watch_free(rung_watch* watch);

/* The values at the end of the last complete scan, or at the moment of a fault. RUNG_EMPTY: no scan has ended since the
 * watch was made; RUNG_LATER: every attempt to read was interrupted for several scans. A cell that the program no
 * longer has is 0. Any thread, also several at a time; never waits. [rt] */
RUNG_API int32_t rung_watch_newest(const rung_watch* watch, rung_value* values, rung_sample* sample);

/* Takes the values of the next scan that was kept. RUNG_EMPTY: there is none. Any thread, one at a time. [rt] */
RUNG_API int32_t rung_watch_next(rung_watch* watch, rung_value* values, rung_sample* sample);

/* The scans of a watch as a file for wave viewers (value change dump); it takes them instead of rung_watch_next. */
typedef struct rung_trace rung_trace;

/* Begins a file. RUNG_FAILED: it cannot be written; RUNG_BAD_ARGUMENT: the watch keeps no scans. Any thread. */
RUNG_API int32_t rung_trace_new(rung_watch* watch, const char* path, rung_trace** trace);
/* Writes all scans that were kept, with a remark if some were lost. RUNG_EMPTY: there were none; RUNG_FAILED. The
 * thread that takes the watch's scans. */
RUNG_API int32_t rung_trace_write(rung_trace* trace);
/* Writes the remaining scans, and ends the file. RUNG_FAILED: it could not be written. Null is allowed. Before its
 * watch is freed. */
RUNG_API int32_t rung_trace_free(rung_trace* trace);

/* ---- another program while it runs ------------------------------------------------------------------------------ */

/* Prepares another program of the same dialect to take over from the running one, and determines what happens to the
 * state. `memory`: the memory block of the new program, as in rung_instance_options; null: the library allocates it.
 * Any thread: the instance may run in its own thread meanwhile, but must not be freed; if another program takes over
 * meanwhile, the replacement is for the former one. Measures the time of the new program's code on this computer, in
 * separate memory. RUNG_REFUSED: the program has another dialect. */
RUNG_API int32_t rung_replacement_new(rung_instance* instance, rung_image* image, void* memory, size_t memory_bytes,
                                      rung_replacement** replacement);
/* Null is allowed. Any thread, but not during rung_instance_replace with it. */
RUNG_API int32_t rung_replacement_free(rung_replacement* replacement);

typedef struct rung_replacement_info {
  uint32_t size;
  uint32_t kept_cells;  /* names that keep their place and contents */
  uint32_t kept_states; /* states of edges, timers and counters that are kept */
  uint32_t changes;     /* number of changes, see rung_replacement_change */
  uint64_t bytes;       /* bytes that the replacement copies; its time is proportional to them */
  uint64_t steps;       /* of the new program, at most, for the slice with the least reserve of time */
  uint64_t slice_ns;    /* upper bound for this slice here: its steps times the highest measured time of a step */
  uint64_t period_ns;   /* its time until the next slice; 0: the schedule takes no time */
  const char* bound;    /* these figures as text, with the costliest rung; valid as long as the replacement */
  uint32_t program;     /* the number of the new program (rung_instance_program) */
  uint32_t next; /* the number of the program that takes over with the next rung_instance_replace; 0: none, because a
                    fault of the new program has put the former one back */
} rung_replacement_info;

/* Describes the effect of the next rung_instance_replace. Any thread. */
RUNG_API int32_t rung_replacement_report(const rung_replacement* replacement, rung_replacement_info* info);

/* Allows the new program to take over although a slice of it may last longer than its period. Any thread. */
RUNG_API int32_t rung_replacement_allow_late(rung_replacement* replacement);

enum rung_change_kind {
  RUNG_CHANGE_NEW = 0,      /* starts with its initial contents */
  RUNG_CHANGE_REMOVED = 1,  /* its contents are lost */
  RUNG_CHANGE_MOVED = 2,    /* is at another place; keeps its contents */
  RUNG_CHANGE_RENAMED = 3,  /* a cell with a new name; keeps its contents */
  RUNG_CHANGE_RETYPED = 4,  /* has another type: starts with its initial contents */
  RUNG_CHANGE_RELEASED = 5, /* an output that the new program does not write: starts anew */
  RUNG_CHANGE_CUT = 6,      /* is at another place with less room: bytes that instructions reached past it are lost */
};

typedef struct rung_change {
  uint32_t size;
  uint32_t kind;     /* enum rung_change_kind */
  uint32_t is_state; /* 1: state of an edge, timer or counter, made by the compiler; 0: a cell with a name */
  uint32_t reserved;
  const char* name;   /* in the new program; if it was removed, in the old one. Valid as long as the replacement */
  const char* former; /* RUNG_CHANGE_RENAMED: the old name; else "" */
} rung_change;

/* The change with this index, cells before states, each sorted by name. RUNG_EMPTY: there are not that many. */
RUNG_API int32_t rung_replacement_change(const rung_replacement* replacement, uint32_t index, rung_change* change);

enum rung_rung_change_kind {
  RUNG_RUNG_NEW = 0,
  RUNG_RUNG_REMOVED = 1,
  RUNG_RUNG_CHANGED = 2, /* keeps the state of its remaining instructions */
  RUNG_RUNG_MOVED = 3,   /* between other rungs, or to another routine; keeps its state */
};

typedef struct rung_rung_change {
  uint32_t size;
  uint32_t kind; /* enum rung_rung_change_kind */
  uint32_t rung; /* as drawn, in the new program; if removed, in the former one. So are the next three */
  uint32_t line;
  const char* file; /* valid as long as the replacement; so is `title` */
  const char* title;
} rung_rung_change;

/* The rung with this index among those that differ between the programs: in the order of the new program, then the
 * removed ones. RUNG_EMPTY: there are not that many. Any thread. */
RUNG_API int32_t rung_replacement_rung(const rung_replacement* replacement, uint32_t index, rung_rung_change* change);

/* The program of the replacement takes over, with its state; the clock, queues and bound variables continue. The
 * replacement then holds the former program, and its report describes the rollback: a second call puts the former
 * program back, and cells reported as new begin with their initial contents. As long as the replacement exists, a fault
 * of the new program also puts the former one back, but with such cells as they were when the new program took over:
 * the former program is then stopped until the next power-on, rung_instance_fault still reports the fault, and the new
 * program cannot take over again (RUNG_WRONG_STATE) unless it is prepared anew. If the result at the fault would be
 * RUNG_LATER, the new program stays. RUNG_REFUSED: a slice of the new program may last longer than its period, and the
 * sentence has the figures (see rung_replacement_allow_late). Loops count once in this bound: rung_instance_limit
 * limits their time. RUNG_LATER: a scan of the schedule has not ended, or a mechanism or a service request is waiting
 * that the new program does not have; RUNG_WRONG_STATE: the replacement was made for another program than the running
 * one. [rt] */
RUNG_API int32_t rung_instance_replace(rung_instance* instance, rung_replacement* replacement);

/* ---- a program beside the one that runs -------------------------------------------------------------------------- */

/* Another program of the same dialect and schedule, which runs on the inputs and answers of the instance's program, so
 * that its outputs can be compared before it takes over. It writes only its own memory; its messages and requests are
 * discarded, and a request that both programs make in the same run of a task gets the same answer for both. */
typedef struct rung_shadow rung_shadow;

enum rung_shadow_state {
  RUNG_SHADOW_PREPARED = 0,
  RUNG_SHADOW_RUNNING = 1,
  RUNG_SHADOW_FINISHED = 2, /* all scans have been compared */
  RUNG_SHADOW_TOO_SLOW = 3, /* there was no room for a run, or a run made more than 32 requests */
  RUNG_SHADOW_STOPPED = 4,  /* ended by the host, or by a fault, power-on or replacement of the instance's program */
  RUNG_SHADOW_FAULTED = 5,  /* the new program has faulted */
};

#define RUNG_MOST_SHADOW_SCANS 1000000u
#define RUNG_MOST_SHADOW_ROOM 4096u

/* Prepares a shadow for `scans` scans of the schedule, with room for `room` recorded runs of tasks that wait for
 * rung_shadow_work. Each takes twice the size of the instance's memory block. Any thread: the instance may run in its
 * own thread meanwhile, but must not be freed. RUNG_REFUSED: the program has another dialect or schedule. */
RUNG_API int32_t rung_shadow_new(rung_instance* instance, rung_image* image, uint32_t scans, uint32_t room,
                                 rung_shadow** shadow);
/* Ends a shadow and frees it, in the thread of the instance; a shadow that has ended (rung_instance_shadow with null)
 * may be freed by any thread. Null is allowed. Before its instance is freed; no other thread may be using the
 * shadow. */
RUNG_API int32_t rung_shadow_free(rung_shadow* shadow);

/* Begins a shadow with the present state of the instance; null: ends the running one. While it runs, every run of a
 * task copies the memory block twice, and the instance never waits for the shadow: if it has no room for a run, it
 * ends. RUNG_LATER: as for rung_instance_replace; RUNG_FAULTED; RUNG_WRONG_STATE: the instance already has a shadow, or
 * this one has begun before, or was made for another program than the running one. [rt] */
RUNG_API int32_t rung_instance_shadow(rung_instance* instance, rung_shadow* shadow);

/* Executes and compares one recorded run of a task. RUNG_EMPTY: there is none. Any thread, but only one at a time may
 * be in this function, rung_shadow_report or rung_shadow_difference. */
RUNG_API int32_t rung_shadow_work(rung_shadow* shadow);

typedef struct rung_shadow_info {
  uint32_t size;
  uint32_t state;       /* enum rung_shadow_state */
  uint32_t differences; /* see rung_shadow_difference */
  uint32_t reserved;
  uint64_t runs;     /* runs of tasks that were compared */
  const char* fault; /* of the new program, "" without one; valid until the next report */
} rung_shadow_info;

RUNG_API int32_t rung_shadow_report(rung_shadow* shadow, rung_shadow_info* info);

typedef struct rung_difference {
  uint32_t size;
  uint32_t type;      /* enum rung_type; 0: a service, named by `name`, that only the new program requests */
  const char* name;   /* of an output, or, if the dialect does not define its outputs, of any cell with a name in both
                         programs. Valid until the next report */
  int64_t first_us;   /* time of the first occurrence on the program's clock */
  uint64_t runs;      /* runs of tasks after which it occurred; for requests, their number */
  rung_value running; /* the values at the first occurrence */
  rung_value next;
} rung_difference;

/* The difference with this index in the last report, sorted by name. RUNG_EMPTY: there are not that many. */
RUNG_API int32_t rung_shadow_difference(const rung_shadow* shadow, uint32_t index, rung_difference* difference);

/* ---- forcing ----------------------------------------------------------------------------------------------------- */

/* Cells that a user forces to a value: every reader within a scan gets that value, even after a rung has written the
 * cell. A set of forces is prepared, and then activated as a whole; one set is active at a time. */
typedef struct rung_forces rung_forces;

typedef struct rung_forced_cell {
  const char* name;  /* as for rung_instance_find, for reading; of an array the first element is forced */
  const char* owner; /* the user who forces it, for display; null: "" */
  rung_value value;
  uint32_t access; /* RUNG_READ, or RUNG_REAL: the real that RUNG_REAL finds */
  uint32_t reserved;
} rung_forced_cell;

/* Prepares a set of forces for the running program or, with a replacement, for that of the replacement. Chunks that
 * write a forced cell are recompiled by the compiler that made the image or is attached to it (rung/compiler.h). Any
 * thread: the instance may run in its own thread meanwhile, but must not be freed. RUNG_NOT_FOUND; RUNG_WRONG_TYPE: a
 * text, a constant, or no space for a real with RUNG_REAL; RUNG_BAD_ARGUMENT: two cells force different values in one
 * place, or an unknown `access`; RUNG_REFUSED: the program writes a cell, and no compiler is attached to its image;
 * RUNG_LATER: the code is still being compiled; call again later with the same cells. The compilers of rung/compiler.h
 * never return RUNG_LATER. */
RUNG_API int32_t rung_forces_new(rung_instance* instance, rung_replacement* replacement, const rung_forced_cell* cells,
                                 uint32_t count, rung_forces** forces);
/* Null is allowed. Any thread, before its instance is freed; freeing an active set ends it, and counts as a call for
 * the instance. */
RUNG_API int32_t rung_forces_free(rung_forces* forces);

/* Activates a set instead of the former one, from this call on; null: ends all forces. A cell keeps its value when its
 * force ends, until it is written. All forces end automatically at a power-on, a stop, a fault (its safe outputs are
 * not forced), and when another program takes over: a set that was made with the replacement can be activated before
 * its first scan. RUNG_FAULTED; RUNG_WRONG_STATE: the program is stopped, or the set is for another program. [rt] */
RUNG_API int32_t rung_instance_force(rung_instance* instance, rung_forces* forces);

typedef struct rung_force_info {
  uint32_t size;
  uint32_t type; /* enum rung_type */
  rung_value value;
  int64_t since_us; /* on the program's clock: the time since which this owner forces it to this value */
  const char* name; /* valid as long as its set; so is `owner` */
  const char* owner;
} rung_force_info;

/* The active force with this index, sorted by name. RUNG_EMPTY: there are not that many. [rt] */
RUNG_API int32_t rung_instance_forced(const rung_instance* instance, uint32_t index, rung_force_info* force);

/* For compilers: recompiled code of an image. */
typedef struct rung_forced_code {
  const rung_chunk_fn* chunk_fns; /* by chunk */
  void* engine;                   /* rung_ctx::engine for these chunks */
  void (*release)(void* owner);   /* called with `owner` when the code is no longer used */
  void* owner;
} rung_forced_code;

typedef struct rung_code_maker {
  uint32_t size;
  uint32_t reserved;
  /* Makes code for all chunks of the image's program, which runs with `engine`, that does not change the forced bits;
   * `forced` is sorted by space and byte. The handle of the image is valid only during this call. Returns an enum
   * rung_status; RUNG_LATER: the code is being compiled. After an error or RUNG_LATER, `problem` must have a sentence
   * of less than `problem_bytes` bytes. Called by several threads at a time. */
  int32_t (*force)(void* user, const rung_image* image, void* engine, const rung_forced_byte* forced, uint32_t count,
                   rung_forced_code* code, char* problem, size_t problem_bytes);
  void (*release)(void* user); /* called when nothing uses the image any more; may be null */
  void* user;
} rung_code_maker;

/* Attaches a compiler to the image. RUNG_WRONG_STATE: another one is attached. [any] */
RUNG_API int32_t rung_image_serve(rung_image* image, const rung_code_maker* maker);

/* Reads bytes from `first` on of the file from which the image was opened, such as the data that a compiler stores
 * there. `count` is the number of bytes wanted, and on return the number read. RUNG_EMPTY: it was not opened from a
 * file. [any] */
RUNG_API int32_t rung_image_file(const rung_image* image, uint64_t first, void* bytes, size_t* count);

#ifdef __cplusplus
}
#endif

#endif
