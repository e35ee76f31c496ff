// DWARF of one module (see debug_lines.h).
#include "codegen/llvm/debug_lines.h"

#include <llvm/BinaryFormat/Dwarf.h>
#include <llvm/IR/DIBuilder.h>
#include <llvm/IR/Module.h>

namespace rung::codegen {

using namespace ir;

DebugLines::DebugLines(llvm::Module& target, const Module& source, bool optimised)
    : target_(target), builder_(std::make_unique<llvm::DIBuilder>(target)), optimised_(optimised) {
  target.addModuleFlag(llvm::Module::Warning, "Debug Info Version", llvm::DEBUG_METADATA_VERSION);
  target.addModuleFlag(llvm::Module::Warning, "Dwarf Version", 4);
  // No directory: debuggers look for the files where they run, and the output is the same wherever it was made.
  for (const std::string& file : source.files) files_.push_back(builder_->createFile(file, ""));
  llvm::DIFile* first = files_.empty() ? builder_->createFile(source.name, "") : files_.front();
  builder_->createCompileUnit(llvm::dwarf::DW_LANG_C99, first, "rungc", optimised, "", 0);
  type_ = builder_->createSubroutineType(builder_->getOrCreateTypeArray({}));
}

DebugLines::~DebugLines() = default;

void DebugLines::beginFunction(llvm::Function& function, const std::string& name, FileIndex file, uint32_t line) {
  function_ = nullptr;
  functionFile_ = scopeFile_ = file;
  if (!file.valid()) return;
  auto flags = llvm::DISubprogram::SPFlagDefinition | llvm::DISubprogram::SPFlagLocalToUnit;
  if (optimised_) flags |= llvm::DISubprogram::SPFlagOptimized;
  function_ = builder_->createFunction(files_[file.index], name, "", files_[file.index], line, type_, line,
                                       llvm::DINode::FlagZero, flags);
  function.setSubprogram(function_);
  scope_ = function_;
}

llvm::DILocation* DebugLines::at(FileIndex file, uint32_t line) {
  if (function_ == nullptr || !file.valid()) return nullptr;
  if (file != scopeFile_) {
    scopeFile_ = file;
    scope_ = function_;
    if (file != functionFile_) scope_ = builder_->createLexicalBlockFile(function_, files_[file.index]);
  }
  return llvm::DILocation::get(target_.getContext(), line, 0, scope_);
}

void DebugLines::finish() { builder_->finalize(); }

} // namespace rung::codegen
