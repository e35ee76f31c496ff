/* The compiler of PLC programs as a library of C11: librung-compiler, beside librung-runtime (rung/runtime.h), which
 * runs what it makes. It brings LLVM along: a machine that loads compiled programs does not need it.
 *
 *   rung_source source = {.name = "mill.pmc"};
 *   rung_compilation* compilation;
 *   if (rung_compile(&source, 1, NULL, &compilation) == RUNG_OK) rung_compilation_image(compilation, &image);
 *
 * Results, texts and structs with a `size` are as in rung/runtime.h; the sentence for an error is that of
 * rung_compiler_error_text. An error of the compiler itself is RUNG_FAILED, and does not end the process. Every
 * function may be called by every thread, a compilation by one at a time. None is for real time. */
#ifndef RUNG_COMPILER_H
#define RUNG_COMPILER_H

#include "rung/runtime.h"

#if defined(RUNG_BUILDS_COMPILER)
#define RUNG_COMPILER_API __attribute__((visibility("default")))
#else
#define RUNG_COMPILER_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* As rung_error_text, of the functions of this header. */
RUNG_COMPILER_API const char* rung_compiler_error_text(void);

typedef struct rung_compilation rung_compilation;

/* A file of a program. */
typedef struct rung_source {
  const char* name; /* in diagnostics; its ending may say the dialect */
  const char* text; /* null: the file `name` is read */
  size_t bytes;     /* of `text` */
} rung_source;

/* A key of the dialect's configuration, and its value: docs/reference. */
typedef struct rung_setting {
  const char* key;
  const char* value;
} rung_setting;

enum rung_engine {
  RUNG_ENGINE_JIT = 0,    /* machine code, optimised */
  RUNG_ENGINE_FAST = 1,   /* machine code, compiled fast */
  RUNG_ENGINE_INTERP = 2, /* the interpreter: there at once, and slow */
  RUNG_ENGINE_TIERED = 3, /* the interpreter until optimised machine code is there, which helper threads compile */
};

enum rung_compile_flags {
  RUNG_COMPILE_STRICT = 1,  /* warnings that the control's own rules call errors are errors */
  RUNG_COMPILE_PROFILE = 2, /* count and time every rung */
  RUNG_COMPILE_DEBUG = 4,   /* with debug information for the PLC source */
};

typedef struct rung_compile_options {
  uint32_t size;
  uint32_t flags;  /* enum rung_compile_flags */
  uint32_t engine; /* enum rung_engine, of rung_compilation_image */
  uint32_t setting_count;
  const rung_setting* settings;
  const char* dialect;      /* "nct", "gsk" or "technol"; null: the first file says it */
  const char* cache_folder; /* where machine code is kept for the next time; null: nowhere */
} rung_compile_options;

/* Compiles a program of `count` files, in their order. RUNG_OK; RUNG_REFUSED: it has errors; in both cases the
 * compilation has the diagnostics. RUNG_NOT_FOUND: a file cannot be read; RUNG_BAD_ARGUMENT: also a setting that the
 * dialect does not have. `options` may be null. */
RUNG_COMPILER_API int32_t rung_compile(const rung_source* sources, uint32_t count, const rung_compile_options* options,
                                       rung_compilation** compilation);

/* Null is allowed. Images that were made of it stay. */
RUNG_COMPILER_API int32_t rung_compilation_free(rung_compilation* compilation);

enum rung_severity { RUNG_SEVERITY_WARNING = 0, RUNG_SEVERITY_ERROR = 1 };

typedef struct rung_diagnostic {
  uint32_t size;
  uint32_t severity; /* enum rung_severity */
  uint32_t line;     /* from 1; 0: it has no place */
  uint32_t column;   /* from 1, in characters */
  /* Valid as long as the compilation. */
  const char* file;    /* "": it has no place */
  const char* code;    /* "bad-operand" */
  const char* message; /* what was found, and what was expected */
} rung_diagnostic;

/* The index-th diagnostic, in the order of the files and lines. RUNG_EMPTY: there are not so many. */
RUNG_COMPILER_API int32_t rung_compilation_diagnostic(const rung_compilation* compilation, uint32_t index,
                                                      rung_diagnostic* diagnostic);

/* All of them for people, each with its line of the source, notes and fixes; valid as long as the compilation, null for
 * what is not one. */
RUNG_COMPILER_API const char* rung_compilation_report(const rung_compilation* compilation);

/* The program, ready to run: an image as rung_image_open gives it, with the engine of the options. RUNG_WRONG_STATE: it
 * has errors. */
RUNG_COMPILER_API int32_t rung_compilation_image(rung_compilation* compilation, rung_image** image);

/* Serves an image that rung_image_open has given: its code can be made again, from the IR that its file carries, where
 * cells that it writes are forced (rung_forces_new). Images of rung_compilation_image are served from the beginning.
 * RUNG_REFUSED: the file carries no IR (rungc build --no-ir), or that of another version of this compiler;
 * RUNG_WRONG_STATE: it is served. */
RUNG_COMPILER_API int32_t rung_compiler_serve(rung_image* image);

/* The program as a sealed shared object, with its IR, for rung_image_open. RUNG_FAILED: the file cannot be written. */
RUNG_COMPILER_API int32_t rung_compilation_write(rung_compilation* compilation, const char* path);

#ifdef __cplusplus
}
#endif

#endif
