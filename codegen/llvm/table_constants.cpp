// Tables as LLVM constants (see table_constants.h).
#include "codegen/llvm/table_constants.h"

#include <cstring>
#include <string>
#include <string_view>
#include <unordered_map>

#include <llvm/IR/Constants.h>
#include <llvm/IR/Module.h>

#include "ir/image/abi_fields.h"
#include "ir/support/check.h"

namespace rung::codegen {

using namespace ir;

namespace {

class TableBuilder {
public:
  TableBuilder(llvm::Module& module, llvm::Constant* chunkTable)
      : module_(module), context_(module.getContext()), ptr_(llvm::PointerType::getUnqual(context_)),
        null_(llvm::ConstantPointerNull::get(ptr_)), chunkTable_(chunkTable) {}

  llvm::StructType* structType(const StructInfo& info) {
    llvm::StructType*& type = types_[&info];
    if (type != nullptr) return type;
    std::vector<llvm::Type*> fields;
    for (const FieldInfo& field : info.fields) fields.push_back(fieldType(field.kind));
    type = llvm::StructType::create(context_, fields, std::string_view(info.name));
    checkOffsets(info, type);
    return type;
  }

  llvm::Constant* structConstant(const StructInfo& info, const std::byte* base) {
    std::vector<llvm::Constant*> fields;
    fields.reserve(info.fields.size());
    for (const FieldInfo& field : info.fields) fields.push_back(fieldConstant(info, field, base));
    return llvm::ConstantStruct::get(structType(info), fields);
  }

private:
  template <class T>
  static T read(const std::byte* at) {
    T value;
    std::memcpy(&value, at, sizeof value);
    return value;
  }

  llvm::Type* fieldType(FieldKind kind) const {
    switch (kind) {
    case FieldKind::U32:
    case FieldKind::OwnSize: return llvm::Type::getInt32Ty(context_);
    case FieldKind::U64:
    case FieldKind::I64: return llvm::Type::getInt64Ty(context_);
    case FieldKind::Text:
    case FieldKind::Bytes:
    case FieldKind::U32s:
    case FieldKind::Texts:
    case FieldKind::Structs:
    case FieldKind::ChunkFns: break;
    }
    return ptr_;
  }

  void checkOffsets(const StructInfo& info, llvm::StructType* type) const {
    const llvm::DataLayout& data = module_.getDataLayout();
    const TargetStruct inC = targetStruct(info, data.getPointerSize());
    for (unsigned i = 0; i < info.fields.size(); ++i)
      RUNG_CHECK(data.getStructLayout(type)->getElementOffset(i) == inC.offsets[i], "a struct of the ABI lies as in C");
    RUNG_CHECK(data.getTypeAllocSize(type) == inC.size, "a struct of the ABI is as long as in C");
  }

  llvm::GlobalVariable* global(llvm::Constant* value, std::string_view name) {
    auto* variable =
        new llvm::GlobalVariable(module_, value->getType(), true, llvm::GlobalValue::PrivateLinkage, value, name);
    variable->setUnnamedAddr(llvm::GlobalValue::UnnamedAddr::Global);
    return variable;
  }

  // Equal texts are there once.
  llvm::Constant* textConstant(const char* text) {
    llvm::Constant*& constant = texts_[text];
    if (constant == nullptr) constant = global(llvm::ConstantDataArray::getString(context_, text), "text");
    return constant;
  }

  llvm::Constant* bytesConstant(const uint8_t* bytes, uint32_t count) {
    if (count == 0) return null_;
    return global(llvm::ConstantDataArray::get(context_, llvm::ArrayRef(bytes, count)), "data");
  }

  template <class Element>
  llvm::Constant* array(llvm::Type* type, std::string_view name, uint32_t count, Element element) {
    if (count == 0) return null_;
    std::vector<llvm::Constant*> elements;
    elements.reserve(count);
    for (uint32_t i = 0; i < count; ++i) elements.push_back(element(i));
    return global(llvm::ConstantArray::get(llvm::ArrayType::get(type, count), elements), name);
  }

  llvm::Constant* fieldConstant(const StructInfo& info, const FieldInfo& field, const std::byte* base) {
    const std::byte* at = base + field.offset;
    const auto count = [&] { return read<uint32_t>(base + field.countOffset); };
    switch (field.kind) {
    case FieldKind::U32: return llvm::ConstantInt::get(fieldType(field.kind), read<uint32_t>(at));
    case FieldKind::OwnSize:
      return llvm::ConstantInt::get(fieldType(field.kind), module_.getDataLayout().getTypeAllocSize(structType(info)));
    case FieldKind::U64:
    case FieldKind::I64: return llvm::ConstantInt::get(fieldType(field.kind), read<uint64_t>(at));
    case FieldKind::Text: return textConstant(read<const char*>(at));
    case FieldKind::Bytes: return bytesConstant(read<const uint8_t*>(at), count());
    case FieldKind::U32s: {
      llvm::Type* i32 = llvm::Type::getInt32Ty(context_);
      return array(i32, field.name, count(),
                   [&](uint32_t i) { return llvm::ConstantInt::get(i32, read<const uint32_t*>(at)[i]); });
    }
    case FieldKind::Texts:
      return array(ptr_, field.name, count(),
                   [&](uint32_t i) { return textConstant(read<const char* const*>(at)[i]); });
    case FieldKind::Structs: {
      const std::byte* first = read<const std::byte*>(at);
      const StructInfo& element = *field.element;
      return array(structType(element), field.name, count(),
                   [&](uint32_t i) { return structConstant(element, first + i * element.size); });
    }
    case FieldKind::ChunkFns: return chunkTable_;
    }
    return null_;
  }

  llvm::Module& module_;
  llvm::LLVMContext& context_;
  llvm::PointerType* ptr_;
  llvm::Constant* null_;
  llvm::Constant* chunkTable_;
  std::unordered_map<const StructInfo*, llvm::StructType*> types_;
  std::unordered_map<std::string, llvm::Constant*> texts_;
};

} // namespace

void addProgramTables(llvm::Module& module, const rung_program& program, llvm::Constant* chunkTable) {
  TableBuilder builder(module, chunkTable);
  llvm::Constant* value = builder.structConstant(programInfo(), reinterpret_cast<const std::byte*>(&program));
  new llvm::GlobalVariable(module, value->getType(), true, llvm::GlobalValue::ExternalLinkage, value,
                           RUNG_PROGRAM_SYMBOL);
}

} // namespace rung::codegen
