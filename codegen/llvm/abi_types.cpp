// The structs of the C ABI as LLVM types (see abi_types.h).
#include "codegen/llvm/abi_types.h"

#include <cstddef>

#include <llvm/IR/DataLayout.h>
#include <llvm/IR/DerivedTypes.h>

#include "ir/support/check.h"
#include "rung/program.h"

namespace rung::codegen {

AbiTypes::AbiTypes(llvm::LLVMContext& context) {
  llvm::Type* i32 = llvm::Type::getInt32Ty(context);
  llvm::Type* i64 = llvm::Type::getInt64Ty(context);
  llvm::Type* ptr = llvm::PointerType::getUnqual(context);
  fault = llvm::StructType::create({i32, i32, i32, i32}, "rung_fault");
  prof = llvm::StructType::create({i64, i64, i64, i64}, "rung_prof");
  message = llvm::StructType::create({i32, i32, i32, i32, i64, i32, i32}, "rung_message");
  hostApi = llvm::StructType::create({i32, i32, ptr, ptr, ptr, ptr}, "rung_host_api");
  ctx = llvm::StructType::create(
      {i64, ptr, ptr, ptr, ptr, fault, i32, i32, llvm::ArrayType::get(i32, RUNG_STACK_DEPTH)}, "rung_ctx");
}

namespace {

// Where the fields that code touches lie in C, for pointers of so many bytes. The asserts below hold this compiler's
// structs to the same formulas.
struct Offsets {
  uint64_t pointer;
  constexpr uint64_t ctxHost() const { return 8; }
  constexpr uint64_t ctxProf() const { return 8 + 2 * pointer; }
  constexpr uint64_t ctxFault() const { return 8 + 4 * pointer; }
  constexpr uint64_t ctxSp() const { return ctxFault() + 16; }
  constexpr uint64_t ctxExtraWeight() const { return ctxSp() + 4; }
  constexpr uint64_t ctxStack() const { return ctxSp() + 8; }
  constexpr uint64_t ctxSize() const { return ctxStack() + 4 * uint64_t{RUNG_STACK_DEPTH}; }
  constexpr uint64_t hostMessage() const { return 8; }
  constexpr uint64_t hostServiceResult() const { return 8 + 3 * pointer; }
};
constexpr Offsets kHere{sizeof(void*)};
static_assert(kHere.ctxHost() == offsetof(rung_ctx, host) && kHere.ctxProf() == offsetof(rung_ctx, prof) &&
              kHere.ctxFault() == offsetof(rung_ctx, fault) && kHere.ctxSp() == offsetof(rung_ctx, sp) &&
              kHere.ctxExtraWeight() == offsetof(rung_ctx, extra_weight) &&
              kHere.ctxStack() == offsetof(rung_ctx, stack) && kHere.ctxSize() == sizeof(rung_ctx));
static_assert(kHere.hostMessage() == offsetof(rung_host_api, message) &&
              kHere.hostServiceResult() == offsetof(rung_host_api, service_result));

} // namespace

void AbiTypes::check(const llvm::DataLayout& data) const {
  RUNG_CHECK(data.isLittleEndian(), "only little-endian targets");
  const Offsets inC{data.getPointerSize()};
  const auto at = [&](llvm::StructType* type, unsigned field) -> uint64_t {
    return data.getStructLayout(type)->getElementOffset(field);
  };
  RUNG_CHECK(at(ctx, kHost) == inC.ctxHost() && at(ctx, kProf) == inC.ctxProf() && at(ctx, kFault) == inC.ctxFault() &&
                 at(ctx, kSp) == inC.ctxSp() && at(ctx, kExtraWeight) == inC.ctxExtraWeight() &&
                 at(ctx, kStack) == inC.ctxStack() && data.getTypeAllocSize(ctx) == inC.ctxSize(),
             "rung_ctx lies as in C");
  RUNG_CHECK(at(hostApi, kMessage) == inC.hostMessage() && at(hostApi, kServiceResult) == inC.hostServiceResult(),
             "rung_host_api lies as in C");
  // Without pointers: the same everywhere.
  RUNG_CHECK(at(fault, kFaultTask) == offsetof(rung_fault, task), "rung_fault lies as in C");
  RUNG_CHECK(at(message, kValue) == offsetof(rung_message, value) &&
                 data.getTypeAllocSize(message) == sizeof(rung_message),
             "rung_message lies as in C");
  RUNG_CHECK(at(prof, kStarted) == offsetof(rung_prof, started) && data.getTypeAllocSize(prof) == sizeof(rung_prof),
             "rung_prof lies as in C");
}

} // namespace rung::codegen
