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

void AbiTypes::check(const llvm::DataLayout& data) const {
  RUNG_CHECK(data.isLittleEndian(), "only little-endian targets");
  if (data.getPointerSize() != sizeof(void*)) return;
  const auto at = [&](llvm::StructType* type, unsigned field) -> uint64_t {
    return data.getStructLayout(type)->getElementOffset(field);
  };
  RUNG_CHECK(at(ctx, kHost) == offsetof(rung_ctx, host) && at(ctx, kProf) == offsetof(rung_ctx, prof) &&
                 at(ctx, kFault) == offsetof(rung_ctx, fault) && at(ctx, kSp) == offsetof(rung_ctx, sp) &&
                 at(ctx, kExtraWeight) == offsetof(rung_ctx, extra_weight) &&
                 at(ctx, kStack) == offsetof(rung_ctx, stack) && data.getTypeAllocSize(ctx) == sizeof(rung_ctx),
             "rung_ctx lies as in C");
  RUNG_CHECK(at(fault, kFaultTask) == offsetof(rung_fault, task), "rung_fault lies as in C");
  RUNG_CHECK(at(hostApi, kMessage) == offsetof(rung_host_api, message) &&
                 at(hostApi, kServiceResult) == offsetof(rung_host_api, service_result),
             "rung_host_api lies as in C");
  RUNG_CHECK(at(message, kValue) == offsetof(rung_message, value) &&
                 data.getTypeAllocSize(message) == sizeof(rung_message),
             "rung_message lies as in C");
  RUNG_CHECK(at(prof, kStarted) == offsetof(rung_prof, started) && data.getTypeAllocSize(prof) == sizeof(rung_prof),
             "rung_prof lies as in C");
}

} // namespace rung::codegen
