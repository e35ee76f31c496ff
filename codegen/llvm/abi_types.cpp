// The structs of the C ABI as LLVM types.
#include "codegen/llvm/abi_types.h"

#include <llvm/IR/Constants.h>
#include <llvm/IR/DataLayout.h>
#include <llvm/IR/DerivedTypes.h>
#include <llvm/IR/Module.h>

#include <cstddef>
#include <cstring>
#include <string>
#include <string_view>
#include <unordered_map>

#include "ir/image/abi_fields.h"
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

// The C offsets of the fields that code accesses, for a given size of pointers. The checks below apply the same
// formulas to this compiler's structs.
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
  // Without pointers: the same on every target.
  RUNG_CHECK(at(fault, kFaultTask) == offsetof(rung_fault, task), "rung_fault lies as in C");
  RUNG_CHECK(at(message, kValue) == offsetof(rung_message, value) &&
                 data.getTypeAllocSize(message) == sizeof(rung_message),
             "rung_message lies as in C");
  RUNG_CHECK(at(prof, kStarted) == offsetof(rung_prof, started) && data.getTypeAllocSize(prof) == sizeof(rung_prof),
             "rung_prof lies as in C");
}

// Tables as LLVM constants.

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

  // Equal texts are stored once.
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
