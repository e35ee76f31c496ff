// The macros of generated C++: accesses to the memory block, faults and profile counters. They are macros and not
// functions so that debuggers and profilers see only the lines of the PLC source.
#ifndef RUNG_GEN_HPP
#define RUNG_GEN_HPP

#include "rung/program.h"
#include "rung/sem.hpp"

namespace rung::gen {
using namespace sem;
// Places in the memory block may overlap; m16u and the other types with a u may have any address, the others must be
// aligned to their size.
typedef u8 __attribute__((may_alias)) m8;
typedef u16 __attribute__((may_alias)) m16;
typedef u32 __attribute__((may_alias)) m32;
typedef u64 __attribute__((may_alias)) m64;
typedef double __attribute__((may_alias)) mf64;
typedef u16 __attribute__((aligned(1), may_alias)) m16u;
typedef u32 __attribute__((aligned(1), may_alias)) m32u;
typedef u64 __attribute__((aligned(1), may_alias)) m64u;
typedef double __attribute__((aligned(1), may_alias)) mf64u;
typedef bool __attribute__((may_alias)) mbool; // the runtime keeps these bytes at 0 or 1
} // namespace rung::gen

// Encloses the code of the source line named by the #line above it.
#ifndef RUNG_DEBUG
#define RUNG_LINE(...) __VA_ARGS__
#else
// At the beginning of a line the stores of earlier lines have reached memory, and its own loads have not been executed.
#define RUNG_LINE(...)                                                                                                 \
  asm volatile("" : : "r"(block) : "memory");                                                                          \
  __VA_ARGS__
// `mem` is for debuggers; volatile, so that it exists throughout the function.
#define RUNG_SHOW_MEMORY rung_memory* volatile mem = reinterpret_cast<rung_memory*>(block);
#endif

// A bit packed in a byte.
#define RUNG_BIT(offset, bit) ((block[offset] >> (bit)) & 1)
#define RUNG_SET_BIT(offset, bit, value)                                                                               \
  block[offset] = static_cast<u8>((block[offset] & ~(1u << (bit))) | (static_cast<unsigned>(value) << (bit)))
// A bit with a byte of its own.
#define RUNG_FLAG(offset) (*reinterpret_cast<const mbool*>(block + (offset)))
#define RUNG_SET_FLAG(offset, value) *reinterpret_cast<mbool*>(block + (offset)) = (value)
// m8 m16 m32 m64 mf64, m16u m32u m64u mf64u
#define RUNG_MEM(type, offset) (*reinterpret_cast<type*>(block + (offset)))

// Element i of a window of `count` elements, `unit` bytes apart; outside the window a read gives 0 and a write does
// nothing.
#define RUNG_AT(type, offset, count, unit, i)                                                                          \
  ((i) < (count) ? RUNG_MEM(type, (offset) + static_cast<u64>(i) * (unit)) : 0)
#define RUNG_SET_AT(type, offset, count, unit, i, value)                                                               \
  if ((i) < (count)) RUNG_MEM(type, (offset) + static_cast<u64>(i) * (unit)) = (value)
#define RUNG_BIT_AT(offset, count, unit, i, b)                                                                         \
  ((i) < (count) && (b) < (unit) * 8u ? RUNG_BIT((offset) + static_cast<u64>(i) * (unit) + (b) / 8, (b) % 8) : 0)
#define RUNG_SET_BIT_AT(offset, count, unit, i, b, value)                                                              \
  if ((i) < (count) && (b) < (unit) * 8u)                                                                              \
  RUNG_SET_BIT((offset) + static_cast<u64>(i) * (unit) + (b) / 8, (b) % 8, value)

#define RUNG_TRAP(condition, fault_code, rung_number, source_line)                                                     \
  if (condition) [[unlikely]] {                                                                                        \
    ctx->fault.code = (fault_code);                                                                                    \
    ctx->fault.rung = (rung_number);                                                                                   \
    ctx->fault.line = (source_line);                                                                                   \
    return RUNG_PC_FAULT;                                                                                              \
  }
#define RUNG_CALL(return_chunk, callee)                                                                                \
  {                                                                                                                    \
    ctx->stack[ctx->sp++] = (return_chunk);                                                                            \
    return (callee);                                                                                                   \
  }
#define RUNG_RETURN return ctx->stack[--ctx->sp]

#define RUNG_MESSAGE(message_op, number, channel, index, value, real, rung_number)                                     \
  {                                                                                                                    \
    const rung_message m = {                                                                                           \
        (message_op), (number),     static_cast<i32>(channel), static_cast<i32>(index), static_cast<i64>(value),       \
        (real),       (rung_number)};                                                                                  \
    ctx->host->message(ctx, &m);                                                                                       \
  }

// Ticks of the counter that the host calibrates (rtlib/core/ticks.h), read in program order. Only counters that do not
// trap in user mode are used.
#if defined(__x86_64__) || defined(__i386__)
#define RUNG_TICKS()                                                                                                   \
  ({                                                                                                                   \
    u32 low, high;                                                                                                     \
    asm volatile("lfence\n\trdtsc\n\tlfence" : "=a"(low), "=d"(high) : : "memory");                                    \
    static_cast<u64>(high) << 32 | low;                                                                                \
  })
#elif defined(__aarch64__)
#define RUNG_TICKS()                                                                                                   \
  ({                                                                                                                   \
    u64 now;                                                                                                           \
    asm volatile("isb\n\tmrs %0, cntvct_el0" : "=r"(now) : : "memory");                                                \
    now;                                                                                                               \
  })
#else
#define RUNG_TICKS() 0
#endif
#define RUNG_PROF_ENTER(rung_number) ctx->prof[rung_number].started = RUNG_TICKS()
#define RUNG_PROF_LEAVE(rung_number)                                                                                   \
  {                                                                                                                    \
    rung_prof& p = ctx->prof[rung_number];                                                                             \
    const u64 ticks = RUNG_TICKS() - p.started;                                                                        \
    p.count += 1;                                                                                                      \
    p.total += ticks;                                                                                                  \
    p.max = ticks > p.max ? ticks : p.max;                                                                             \
  }

#endif
