// The structs of rung/program.h that compiled code accesses, as LLVM types for a target. Field numbers are those of the
// C structs, and their offsets are checked against the C layout of the target.
#pragma once
#include "rung/program.h"

namespace llvm {
class Constant;
class DataLayout;
class LLVMContext;
class Module;
class StructType;
} // namespace llvm

namespace rung::codegen {

struct AbiTypes {
  explicit AbiTypes(llvm::LLVMContext& context);
  // Stops the process if the layout of a struct differs from C's.
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

// The tables of a rung_program as LLVM constants, by walking the field lists of ir/image/abi_fields.h.

// Adds the exported constant rung_program_table and everything that it points to. `chunkTable` is the array of chunk
// functions.
void addProgramTables(llvm::Module& module, const rung_program& program, llvm::Constant* chunkTable);

} // namespace rung::codegen
