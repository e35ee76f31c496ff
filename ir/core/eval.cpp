// Evaluates operations without effects (see eval.h).
#include "ir/core/eval.h"

#include "ir/core/op_info.h"
#include "ir/core/ops.h"
#include "ir/support/check.h"
#include "rung/sem.hpp"

namespace rung::ir {
namespace {

// ---- bits as values of C++ types, and back -----------------------------------------------------------------------

template <class T>
T valueOf(uint64_t bits) {
  if constexpr (std::is_same_v<T, double>)
    return sem::fromBits(bits);
  else
    return static_cast<T>(bits);
}
template <class T>
uint64_t bitsOf(T value) {
  if constexpr (std::is_same_v<T, double>)
    return sem::toBits(value);
  else
    return static_cast<uint64_t>(value);
}

// Calls f with a zero of the C++ type of `type`, which must be in `Types`.
template <TypeSet Types, class F>
uint64_t withType(Type type, F f) {
  if constexpr (contains(Types, Type::Bit))
    if (type == Type::Bit) return f(false);
  if constexpr (contains(Types, Type::I8))
    if (type == Type::I8) return f(sem::u8{});
  if constexpr (contains(Types, Type::I16))
    if (type == Type::I16) return f(sem::u16{});
  if constexpr (contains(Types, Type::I32))
    if (type == Type::I32) return f(sem::u32{});
  if constexpr (contains(Types, Type::I64))
    if (type == Type::I64) return f(sem::u64{});
  if constexpr (contains(Types, Type::F64))
    if (type == Type::F64) return f(double{});
  RUNG_CHECK(false, "an operation of a type that its row does not have");
  return 0;
}

// ---- operands, by the signature of the row -----------------------------------------------------------------------

// Operands of an operation: a zero of its type T selects the C++ type.
struct Input {
  const uint64_t* bits;
  Type first; // of the first operand
};

template <class T>
uint64_t Unary(T, const Input& in, auto f) {
  return bitsOf(f(T{}, valueOf<T>(in.bits[0])));
}
template <class T>
uint64_t Binary(T, const Input& in, auto f) {
  return bitsOf(f(T{}, valueOf<T>(in.bits[0]), valueOf<T>(in.bits[1])));
}
template <class T>
uint64_t Shift(T, const Input& in, auto f) {
  return bitsOf(f(T{}, valueOf<T>(in.bits[0]), static_cast<uint32_t>(in.bits[1])));
}
template <class T>
uint64_t Choice(T, const Input& in, auto f) {
  return bitsOf(f(T{}, in.bits[0] != 0, valueOf<T>(in.bits[1]), valueOf<T>(in.bits[2])));
}
template <class T>
uint64_t FromF64(T, const Input& in, auto f) {
  return bitsOf(f(T{}, sem::fromBits(in.bits[0])));
}
template <class T>
uint64_t FromI64(T, const Input& in, auto f) {
  return bitsOf(f(T{}, in.bits[0]));
}
template <TypeSet Types, class T>
uint64_t fromOneOf(T, const Input& in, auto f) {
  return withType<Types>(in.first, [&](auto from) { return bitsOf(f(T{}, valueOf<decltype(from)>(in.bits[0]))); });
}
template <class T>
uint64_t FromNarrower(T zero, const Input& in, auto f) {
  return fromOneOf<kBitToI32>(zero, in, f);
}
template <class T>
uint64_t FromWider(T zero, const Input& in, auto f) {
  return fromOneOf<kInts>(zero, in, f);
}
template <class T>
uint64_t FromInt(T zero, const Input& in, auto f) {
  return fromOneOf<kInts>(zero, in, f);
}

} // namespace

// NOLINTNEXTLINE(readability-function-size): a case for every operation
uint64_t evalPure(OpCode code, Type type, Type first, const uint64_t* args) {
  const Input in{args, first};
  switch (code) {
#define RUNG_OP(code, ...) case OpCode::code:
#define RUNG_VALUE_OP(...)
#include "ir/core/ops.def"
    break;
#define RUNG_OP(...)
#define RUNG_VALUE_OP(code, name, types, signature, result, function, doc)                                             \
  case OpCode::code:                                                                                                   \
    return withType<k##types>(type, [&](auto zero) {                                                                   \
      return signature(zero, in, []<class T>([[maybe_unused]] T, auto... a) { return sem::function(a...); });          \
    });
#include "ir/core/ops.def"
  }
  RUNG_CHECK(false, "not an operation that can be evaluated");
  return 0;
}

} // namespace rung::ir
