// DWARF for the functions of one module: which source line each instruction belongs to, and the names of the program's
// memory. In every function `mem` points to a struct of them (ir/shape/memory_members.h); `this` does the same, so
// that gdb, which takes the code for C++, finds a name alone as well.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "ir/shape/memory_members.h"

namespace llvm {
class BasicBlock;
class DIBuilder;
class DICompileUnit;
class DIFile;
class DILocation;
class DIScope;
class DISubprogram;
class DISubroutineType;
class DIType;
class Function;
class Module;
class Value;
} // namespace llvm

namespace rung::codegen {

class DebugInfo {
public:
  // `members`: of the source's memory block (memoryMembers).
  DebugInfo(llvm::Module& target, const ir::Module& source, const std::vector<ir::MemoryMember>& members,
            bool optimised);
  ~DebugInfo();

  // What follows belongs to `function`. Without a file it has no lines.
  void beginFunction(llvm::Function& function, const std::string& name, ir::FileIndex file, uint32_t line);
  // `slot` holds the address of the memory block from the end of `entry` on.
  void declareMemory(llvm::Value* slot, llvm::BasicBlock* entry);
  // Null where nothing is known.
  llvm::DILocation* at(ir::FileIndex file, uint32_t line);
  void finish();

private:
  llvm::Module& target_;
  std::unique_ptr<llvm::DIBuilder> builder_;
  std::vector<llvm::DIFile*> files_;
  llvm::DISubroutineType* type_ = nullptr;
  llvm::DIType* memory_ = nullptr; // the pointer's
  llvm::DISubprogram* function_ = nullptr;
  ir::FileIndex functionFile_;
  // The scope of the file last asked for; a function's rungs rarely come from more than one.
  llvm::DIScope* scope_ = nullptr;
  ir::FileIndex scopeFile_;
  bool optimised_;
};

} // namespace rung::codegen
