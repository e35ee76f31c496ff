// DWARF for the functions of one module: the source line of each instruction, and the names of the program's memory. In
// every function `mem` points to a struct of them (ir/shape/memory_members.h); so does `this`, so that gdb, which takes
// the code for C++, also finds an unqualified name.
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
  // `members`: of the memory block of `source` (memoryMembers).
  DebugInfo(llvm::Module& target, const ir::Module& source, const std::vector<ir::MemoryMember>& members,
            bool optimised);
  ~DebugInfo();

  // Subsequent code belongs to `function`. Without a file it has no lines.
  void beginFunction(llvm::Function& function, const std::string& name, ir::FileIndex file, uint32_t line);
  // `slot` holds the address of the memory block from the end of `entry` on.
  void declareMemory(llvm::Value* slot, llvm::BasicBlock* entry);
  // Null if there is no line.
  llvm::DILocation* at(ir::FileIndex file, uint32_t line);
  void finish();

private:
  llvm::Module& target_;
  std::unique_ptr<llvm::DIBuilder> builder_;
  std::vector<llvm::DIFile*> files_;
  llvm::DISubroutineType* type_ = nullptr;
  llvm::DIType* memory_ = nullptr; // type of the pointer to memory
  llvm::DISubprogram* function_ = nullptr;
  ir::FileIndex functionFile_;
  // The scope of the last file; the rungs of a function rarely come from more than one.
  llvm::DIScope* scope_ = nullptr;
  ir::FileIndex scopeFile_;
  bool optimised_;
};

} // namespace rung::codegen
