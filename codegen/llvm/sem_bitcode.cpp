// The functions of sem.hpp under C names, for the LLVM back end: clang compiles this file to bitcode at build time, and
// the emitter links what a program uses. A name is rung_sem_OPERATION_TYPE, in the words of the table of operations.
// Numbers only, no pointers: one bitcode serves every target.
#include "rung/sem.hpp"

using namespace rung::sem;

// Each value operation for each of its types, except those that widen or narrow, for which LLVM has instructions.
#define RUNG_TYPES_Bit(X, ...) X(bit, bool, __VA_ARGS__)
#define RUNG_TYPES_I64(X, ...) X(i64, u64, __VA_ARGS__)
#define RUNG_TYPES_Float(X, ...) X(f64, double, __VA_ARGS__)
#define RUNG_TYPES_Ints(X, ...)                                                                                        \
  X(i8, u8, __VA_ARGS__) X(i16, u16, __VA_ARGS__) X(i32, u32, __VA_ARGS__) X(i64, u64, __VA_ARGS__)
#define RUNG_TYPES_BitsAndInts(X, ...) RUNG_TYPES_Bit(X, __VA_ARGS__) RUNG_TYPES_Ints(X, __VA_ARGS__)
#define RUNG_TYPES_IntsAndFloat(X, ...) RUNG_TYPES_Ints(X, __VA_ARGS__) RUNG_TYPES_Float(X, __VA_ARGS__)
#define RUNG_TYPES_AllTypes(X, ...) RUNG_TYPES_BitsAndInts(X, __VA_ARGS__) RUNG_TYPES_Float(X, __VA_ARGS__)
#define RUNG_TYPES_BitToI32(X, ...)

#define RUNG_RESULT_Same(U) U
#define RUNG_RESULT_Bit(U) bool

#define RUNG_FUNCTION(type, U, name, result, function, parameters, arguments)                                          \
  extern "C" RUNG_RESULT_##result(U) rung_sem_##name##_##type parameters noexcept {                                    \
    using T [[maybe_unused]] = U;                                                                                      \
    return function arguments;                                                                                         \
  }
#define RUNG_Unary(type, U, name, result, function) RUNG_FUNCTION(type, U, name, result, function, (U a), (a))
#define RUNG_Binary(type, U, name, result, function) RUNG_FUNCTION(type, U, name, result, function, (U a, U b), (a, b))
#define RUNG_Shift(type, U, name, result, function) RUNG_FUNCTION(type, U, name, result, function, (U a, u32 n), (a, n))
#define RUNG_Choice(type, U, name, result, function)                                                                   \
  RUNG_FUNCTION(type, U, name, result, function, (bool which, U a, U b), (which, a, b))
#define RUNG_FromF64(type, U, name, result, function) RUNG_FUNCTION(type, U, name, result, function, (double a), (a))
#define RUNG_FromI64(type, U, name, result, function) RUNG_FUNCTION(type, U, name, result, function, (u64 a), (a))
#define RUNG_FromNarrower(...)
#define RUNG_FromWider(...)
#define RUNG_FromInt(...)

#define RUNG_OP(...)
#define RUNG_VALUE_OP(code, name, types, signature, result, function, doc)                                             \
  RUNG_TYPES_##types(RUNG_##signature, name, result, function)
#include "ir/core/ops.def"
