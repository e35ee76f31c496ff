// Stores object files on disk (see object_cache.h).
#include "codegen/jit/object_cache.h"

#include <cstring>

#include <fmt/format.h>
#include <llvm/ADT/StringExtras.h>
#include <llvm/Object/ObjectFile.h>
#include <llvm/Support/SHA256.h>

#include "codegen/llvm/code_unit_numbers.h"
#include "ir/core/op_info.h"
#include "ir/core/ops.h"
#include "ir/shape/partition.h"
#include "ir/support/put.h"
#include "ir/text/text.h"

namespace rung::codegen {
namespace {

CacheKey sha256(std::string_view bytes) {
  return llvm::SHA256::hash({reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()});
}

// Everything in a unit that determines its code, except its position in the program (CodeUnitNumbers) and memory that
// it does not access.
class CodeUnitText {
public:
  CodeUnitText(const ir::Layout& layout, const ModulePart& unit)
      : layout_(layout), partition_(layout.partition()), numbers_(layout.partition(), unit) {
    for (uint32_t i = 0; i < unit.chunkCount; ++i) putChunk(partition_.chunks()[unit.firstChunk + i]);
  }
  std::string take() { return std::move(text_); }

private:
  using Kind = CodeUnitNumbers::Kind;

  // The rungs of a chunk, and their destinations with extra weights.
  void putChunk(const ir::Chunk& chunk) {
    put(text_, "chunk {}\n", chunk.rungCount);
    first_ = chunk.firstRung;
    for (uint32_t i = chunk.firstRung; i < chunk.firstRung + chunk.rungCount; ++i) {
      putRung(partition_.module().at(chunk.routine).rungs[i], partition_.rungNumber(chunk.routine, i));
      putExit(ir::exitOf(partition_, chunk.routine, i));
    }
  }

  void putRung(const ir::Rung& rung, uint32_t number) {
    text_ += "rung";
    for (const ir::Type type : rung.values) put(text_, " {}", static_cast<int>(type));
    text_ += '\n';
    for (const ir::Op& op : rung.ops) {
      put(text_, "{} {} {} {}", static_cast<int>(op.code), static_cast<int>(op.type), op.result.index, op.count);
      putAttribute(op);
      for (int i = 0; i < op.argCount; ++i) put(text_, " {}", ir::arg(rung, op, i).index);
      if (op.code == ir::OpCode::Trap) put(text_, " @{}", numbers_.index(Kind::Line, lineOf(rung, op)));
      if (CodeUnitNumbers::namesRung(op.code)) put(text_, " #{}", numbers_.index(Kind::Rung, number));
      text_ += '\n';
    }
    put(text_, "{} {}\n", rung.transfer.cond.index, rung.transfer.value.index);
  }

  // Writes places as offsets in memory, because the numbers of slots and the places of other cells depend on the whole
  // program.
  void putAttribute(const ir::Op& op) {
    const ir::MemoryLayout& memory = layout_.memory();
    const auto byte = static_cast<uint32_t>(op.imm / 8);
    switch (ir::opInfo(op.code).attr) {
    case ir::Attr::Slot: return put(text_, " slot {}", memory.slot(ir::SlotId{op.ref}));
    case ir::Attr::Window:
      put(text_, " {} window", op.ref);
      if (op.count != 0)
        put(text_, " {} {}", memory.byte(ir::SpaceId{op.ref}, byte), partition_.module().spaces[op.ref].unitBytes);
      return;
    case ir::Attr::Place:
      if (op.type == ir::Type::Bit) {
        const ir::BitLocation at = memory.bit(ir::SpaceId{op.ref}, static_cast<uint64_t>(op.imm));
        return put(text_, " {} bit {} {} {}", op.ref, at.offset, at.bit, at.wholeByte);
      }
      return put(text_, " {} at {}", op.ref, memory.byte(ir::SpaceId{op.ref}, byte));
    default: return put(text_, " {} {}", op.ref, op.imm);
    }
  }

  void putExit(const ir::Exit& exit) {
    put(text_, "{}", static_cast<int>(exit.kind));
    putDestination(exit.taken);
    putDestination(exit.otherwise);
    for (const ir::Destination& to : exit.targets) putDestination(to);
    text_ += '\n';
  }

  void putDestination(const ir::Destination& to) {
    if (to.inside())
      put(text_, " +{} {}", to.rung - first_, to.extra);
    else if (to.chunk == RUNG_NONE)
      text_ += " back";
    else
      put(text_, " {}", numbers_.index(Kind::Chunk, to.chunk));
  }

  const ir::Layout& layout_;
  const ir::Partition& partition_;
  CodeUnitNumbers numbers_;
  uint32_t first_ = 0; // first rung of the current chunk
  std::string text_;
};

// The identity in an object; nothing if it is not an object or has no identity.
std::optional<CodeUnitIdentity> identityIn(std::string_view object) {
  const llvm::MemoryBufferRef bytes({object.data(), object.size()}, "");
  llvm::Expected<std::unique_ptr<llvm::object::ObjectFile>> file = llvm::object::ObjectFile::createObjectFile(bytes);
  if (!file) {
    llvm::consumeError(file.takeError());
    return std::nullopt;
  }
  const auto valueOf = [](auto expected) {
    using Value = std::remove_cvref_t<decltype(*expected)>;
    if (expected) return std::optional<Value>(*expected);
    llvm::consumeError(expected.takeError());
    return std::optional<Value>();
  };
  for (const llvm::object::SymbolRef& symbol : (*file)->symbols()) {
    if (valueOf(symbol.getName()) != llvm::StringRef(kCodeUnitIdentity)) continue;
    const auto section = valueOf(symbol.getSection());
    const auto offset = valueOf(symbol.getValue());
    if (!section || *section == (*file)->section_end() || !offset) return std::nullopt;
    const auto contents = valueOf((*section)->getContents());
    CodeUnitIdentity identity{};
    if (!contents || *offset > contents->size() || contents->size() - *offset < sizeof identity) return std::nullopt;
    std::memcpy(&identity, contents->data() + *offset, sizeof identity);
    return identity;
  }
  return std::nullopt;
}

} // namespace

std::string cacheSeal(std::string_view object) {
  return fmt::format("rung-object {}\n", llvm::toHex(sha256(object), true));
}

CacheKeys::CacheKeys(const ir::Layout& layout, uint64_t codeHash, const LlvmOptions& options, std::string_view machine,
                     std::string_view version)
    : layout_(layout), debugInfo_(options.debugInfo) {
  std::string text = fmt::format("{} {} {} {} {}\n", version, machine, RUNG_ABI_VERSION,
                                 static_cast<int>(options.level), options.debugInfo);
  // Debug information contains all names and the positions of units.
  if (debugInfo_) text += fmt::format("{:x}\n", codeHash) + layout.memory().text() + ir::print(layout.module());
  whole_ = sha256(text);
}

CacheKey CacheKeys::of(const ModulePart& unit) const {
  std::string text = fmt::format("{} {}\n", llvm::toHex(whole_, true), debugInfo_ ? unit.firstChunk : 0);
  return sha256(text + CodeUnitText(layout_, unit).take());
}

ObjectCache::ObjectCache(const std::string& folder) {
  if (!folder.empty()) folder_ = runtime::CodeFolder::open(folder, problem_);
}

std::string ObjectCache::name(const ModulePart& unit) { return llvm::toHex(unit.key, true) + ".o"; }

std::optional<std::string> ObjectCache::find(const ModulePart& unit) const {
  std::optional<std::string> bytes = folder_ ? folder_->read(name(unit)) : std::nullopt;
  const size_t sealSize = cacheSeal({}).size();
  if (!bytes || bytes->size() < sealSize) return std::nullopt;
  const std::string_view object(bytes->data(), bytes->size() - sealSize);
  if (cacheSeal(object) != std::string_view(*bytes).substr(object.size())) return std::nullopt;
  if (identityIn(object) != CodeUnitIdentity{unit.key, unit.chunkCount}) return std::nullopt;
  bytes->resize(object.size());
  return bytes;
}

Result<void> ObjectCache::keep(const ModulePart& unit, std::string_view object) const {
  if (!problem_.empty()) return failure(problem_);
  if (!folder_) return {};
  std::string wrong = folder_->write(name(unit), std::string(object) + cacheSeal(object));
  return wrong.empty() ? Result<void>() : failure(std::move(wrong));
}

} // namespace rung::codegen
