// The structs of rung/program.h that code touches, as LLVM types for a target. Field numbers are those of the C
// structs, and their offsets are checked against where C puts them on the target.
#pragma once

namespace llvm {
class DataLayout;
class LLVMContext;
class StructType;
} // namespace llvm

namespace rung::codegen {

struct AbiTypes {
  explicit AbiTypes(llvm::LLVMContext& context);
  // Stops the process when a struct does not lie as in C.
  void check(const llvm::DataLayout& data) const;

  enum CtxField : unsigned { kNow, kHost, kHostData, kProf, kEngine, kFault, kSp, kExtraWeight, kStack };
  enum FaultField : unsigned { kFaultCode, kFaultRung, kFaultLine, kFaultTask };
  enum HostField : unsigned { kHostSize, kHostReserved, kMessage, kServiceRequest, kServicePoll, kServiceResult };
  enum MessageField : unsigned { kMessageOp, kNumber, kChannel, kIndex, kValue, kReal, kRung };
  enum ProfField : unsigned { kCount, kTotal, kMax, kStarted };

  llvm::StructType* fault;
  llvm::StructType* prof;
  llvm::StructType* message;
  llvm::StructType* hostApi;
  llvm::StructType* ctx;
};

} // namespace rung::codegen
