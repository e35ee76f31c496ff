// The functions of sem.hpp under C names, for the LLVM back end: clang makes bitcode of this file at build time, and
// the emitter links what a program uses. A name is rung_sem_OPERATION_TYPE, in the words of the table of operations.
// Numbers only, no pointers: one bitcode serves every target.
#include "rung/sem.hpp"

using namespace rung::sem;

#define RUNG_SEM_INTEGER(T, U)                                                                                         \
  extern "C" U rung_sem_div_s_##T(U a, U b) noexcept { return divS(a, b); }                                            \
  extern "C" U rung_sem_div_u_##T(U a, U b) noexcept { return divU(a, b); }                                            \
  extern "C" U rung_sem_rem_s_##T(U a, U b) noexcept { return remS(a, b); }                                            \
  extern "C" U rung_sem_rem_u_##T(U a, U b) noexcept { return remU(a, b); }                                            \
  extern "C" U rung_sem_shl_##T(U a, u32 n) noexcept { return shl(a, n); }                                             \
  extern "C" U rung_sem_shr_u_##T(U a, u32 n) noexcept { return shrU(a, n); }                                          \
  extern "C" U rung_sem_shr_s_##T(U a, u32 n) noexcept { return shrS(a, n); }                                          \
  extern "C" U rung_sem_bcd_encode_##T(U a) noexcept { return bcdEncode(a); }                                          \
  extern "C" U rung_sem_bcd_decode_##T(U a) noexcept { return bcdDecode(a); }                                          \
  extern "C" U rung_sem_f_to_int_##T(double a) noexcept { return fToInt<U>(a); }

RUNG_SEM_INTEGER(i8, u8)
RUNG_SEM_INTEGER(i16, u16)
RUNG_SEM_INTEGER(i32, u32)
RUNG_SEM_INTEGER(i64, u64)

extern "C" double rung_sem_fadd_f64(double a, double b) noexcept { return fadd(a, b); }
extern "C" double rung_sem_fsub_f64(double a, double b) noexcept { return fsub(a, b); }
extern "C" double rung_sem_fmul_f64(double a, double b) noexcept { return fmul(a, b); }
extern "C" double rung_sem_fdiv_f64(double a, double b) noexcept { return fdiv(a, b); }
extern "C" double rung_sem_fpow_f64(double a, double b) noexcept { return fpow(a, b); }
#define RUNG_OP(name, text)
#define RUNG_EVALUABLE_OP(name, text)
#define RUNG_REAL_FUNCTION(name, function)                                                                             \
  extern "C" double rung_sem_##function##_f64(double a) noexcept { return function(a); }
#include "ir/core/ops.def"

extern "C" u64 rung_sem_f_to_int_nearest_i64(double a) noexcept { return fToIntNearest(a); }
