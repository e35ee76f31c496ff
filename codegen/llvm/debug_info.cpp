// DWARF of one module (see debug_info.h).
#include "codegen/llvm/debug_info.h"

#include <llvm/BinaryFormat/Dwarf.h>
#include <llvm/IR/DIBuilder.h>
#include <llvm/IR/Module.h>

namespace rung::codegen {

using namespace ir;

namespace {

// Builds the struct type with the names of the memory block.
class MemoryType {
public:
  MemoryType(llvm::DIBuilder& builder, llvm::DIFile* file) : builder_(builder), file_(file) {}

  llvm::DIType* make(const std::vector<MemoryMember>& members) {
    std::vector<llvm::Metadata*> fields;
    for (const MemoryMember& member : members) fields.push_back(field(member));
    return builder_.createStructType(file_, "rung_memory", file_, 0, uint64_t{bytesOf(members)} * 8, 8,
                                     llvm::DINode::FlagZero, nullptr, builder_.getOrCreateArray(fields));
  }

private:
  llvm::DIType* field(const MemoryMember& member) {
    if (member.isBitField()) {
      llvm::DIType* storage = member.width == 1 ? type("bool", 8, llvm::dwarf::DW_ATE_boolean)
                                                : type("int", 32, llvm::dwarf::DW_ATE_signed);
      return builder_.createBitFieldMemberType(file_, member.name, file_, 0, member.width, member.firstBit,
                                               member.firstBit / 8 * 8, llvm::DINode::FlagZero, storage);
    }
    llvm::DIType* element = elementType(member);
    if (member.count > 1 || member.text) element = arrayOf(element, member.count);
    return builder_.createMemberType(file_, member.name, file_, 0, member.endBit() - member.firstBit, 8,
                                     member.firstBit, llvm::DINode::FlagZero, element);
  }

  llvm::DIType* elementType(const MemoryMember& member) {
    switch (member.type) {
    case Type::None:
    case Type::Bit: return type("bool", 8, llvm::dwarf::DW_ATE_boolean);
    case Type::I8:
      return member.text ? type("char", 8, llvm::dwarf::DW_ATE_signed_char)
                         : type("signed char", 8, llvm::dwarf::DW_ATE_signed_char);
    case Type::I16: return type("short", 16, llvm::dwarf::DW_ATE_signed);
    case Type::I32: return type("int", 32, llvm::dwarf::DW_ATE_signed);
    case Type::I64: return type("long long", 64, llvm::dwarf::DW_ATE_signed);
    case Type::F64: return type("double", 64, llvm::dwarf::DW_ATE_float);
    }
    return nullptr;
  }

  llvm::DIType* type(const char* name, uint64_t bits, unsigned encoding) {
    return builder_.createBasicType(name, bits, encoding);
  }

  llvm::DIType* arrayOf(llvm::DIType* element, uint32_t count) {
    llvm::Metadata* range = builder_.getOrCreateSubrange(0, count);
    return builder_.createArrayType(element->getSizeInBits() * count, 0, element, builder_.getOrCreateArray(range));
  }

  llvm::DIBuilder& builder_;
  llvm::DIFile* file_;
};

} // namespace

DebugInfo::DebugInfo(llvm::Module& target, const Module& source, const std::vector<MemoryMember>& members,
                     bool optimised)
    : target_(target), builder_(std::make_unique<llvm::DIBuilder>(target)), optimised_(optimised) {
  target.addModuleFlag(llvm::Module::Warning, "Debug Info Version", llvm::DEBUG_METADATA_VERSION);
  target.addModuleFlag(llvm::Module::Warning, "Dwarf Version", 4);
  // No directory: debuggers look for the files in their working directory, and the output is the same wherever it was
  // made.
  for (const std::string& file : source.files) files_.push_back(builder_->createFile(file, ""));
  llvm::DIFile* first = files_.empty() ? builder_->createFile(source.name, "") : files_.front();
  builder_->createCompileUnit(llvm::dwarf::DW_LANG_C_plus_plus, first, "rungc", optimised, "", 0);
  type_ = builder_->createSubroutineType(builder_->getOrCreateTypeArray({}));
  memory_ = builder_->createPointerType(MemoryType(*builder_, first).make(members),
                                        target.getDataLayout().getPointerSizeInBits());
}

DebugInfo::~DebugInfo() = default;

void DebugInfo::beginFunction(llvm::Function& function, const std::string& name, FileIndex file, uint32_t line) {
  function_ = nullptr;
  functionFile_ = scopeFile_ = file;
  if (!file.valid()) return;
  auto flags = llvm::DISubprogram::SPFlagDefinition | llvm::DISubprogram::SPFlagLocalToUnit;
  if (optimised_) flags |= llvm::DISubprogram::SPFlagOptimized;
  function_ = builder_->createFunction(files_[file.index], name, name, files_[file.index], line, type_, line,
                                       llvm::DINode::FlagZero, flags);
  function.setSubprogram(function_);
  scope_ = function_;
}

void DebugInfo::declareMemory(llvm::Value* slot, llvm::BasicBlock* entry) {
  if (function_ == nullptr) return;
  llvm::DILocation* location = llvm::DILocation::get(target_.getContext(), function_->getLine(), 0, function_);
  for (const char* name : {"mem", "this"}) {
    llvm::DILocalVariable* variable =
        builder_->createAutoVariable(function_, name, function_->getFile(), function_->getLine(), memory_, true);
    builder_->insertDeclare(slot, variable, builder_->createExpression(), location, entry);
  }
}

llvm::DILocation* DebugInfo::at(FileIndex file, uint32_t line) {
  if (function_ == nullptr || !file.valid()) return nullptr;
  if (file != scopeFile_) {
    scopeFile_ = file;
    scope_ = function_;
    if (file != functionFile_) scope_ = builder_->createLexicalBlockFile(function_, files_[file.index]);
  }
  return llvm::DILocation::get(target_.getContext(), line, 0, scope_);
}

void DebugInfo::finish() { builder_->finalize(); }

} // namespace rung::codegen
