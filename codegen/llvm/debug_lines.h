// DWARF for the functions of one module: which source line each instruction belongs to, and nothing more.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "ir/core/module.h"

namespace llvm {
class DIBuilder;
class DICompileUnit;
class DIFile;
class DILocation;
class DIScope;
class DISubprogram;
class DISubroutineType;
class Function;
class Module;
} // namespace llvm

namespace rung::codegen {

class DebugLines {
public:
  DebugLines(llvm::Module& target, const ir::Module& source, bool optimised);
  ~DebugLines();

  // What follows belongs to `function`. Without a file it has no lines.
  void beginFunction(llvm::Function& function, const std::string& name, ir::FileIndex file, uint32_t line);
  // Null where nothing is known.
  llvm::DILocation* at(ir::FileIndex file, uint32_t line);
  void finish();

private:
  llvm::Module& target_;
  std::unique_ptr<llvm::DIBuilder> builder_;
  std::vector<llvm::DIFile*> files_;
  llvm::DISubroutineType* type_ = nullptr;
  llvm::DISubprogram* function_ = nullptr;
  ir::FileIndex functionFile_;
  // The scope of the file last asked for; a function's rungs rarely come from more than one.
  llvm::DIScope* scope_ = nullptr;
  ir::FileIndex scopeFile_;
  bool optimised_;
};

} // namespace rung::codegen
