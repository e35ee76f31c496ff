// Object files on disk (see object_cache.h).
#include "codegen/jit/object_cache.h"

#include <cstring>

#include <fmt/format.h>
#include <llvm/ADT/StringExtras.h>
#include <llvm/Object/ObjectFile.h>
#include <llvm/Support/SHA256.h>

#include "ir/chunks/cut.h"
#include "ir/support/put.h"
#include "ir/text/text.h"

namespace rung::codegen {
namespace {

CacheKey sha256(std::string_view bytes) {
  return llvm::SHA256::hash({reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()});
}

void putDestination(const ir::Destination& to, std::string& text) {
  put(text, " {}:{}+{}", to.chunk, to.rung, to.extra);
}

// All of a rung that its code depends on; lines of the source only where a fault names them.
void putRung(const ir::Rung& rung, uint32_t number, std::string& text) {
  put(text, "rung {}", number);
  for (const ir::Type type : rung.values) put(text, " {}", static_cast<int>(type));
  text += '\n';
  for (const ir::Op& op : rung.ops) {
    put(text, "{} {} {} {} {} {}", static_cast<int>(op.code), static_cast<int>(op.type), op.result.index, op.ref,
        op.count, op.imm);
    for (int i = 0; i < op.argCount; ++i) put(text, " {}", ir::arg(rung, op, i).index);
    if (op.code == ir::OpCode::Trap) put(text, " @{}", op.line != 0 ? op.line : rung.begin.line);
    text += '\n';
  }
  put(text, "{} {}\n", rung.transfer.cond.index, rung.transfer.value.index);
}

// The cut of a chunk, its rungs, and where they go with which extra weight.
void putChunk(const ir::Cut& cut, const ir::Chunk& chunk, std::string& text) {
  const ir::Routine& routine = cut.module().at(chunk.routine);
  put(text, "chunk {} {} {}\n", routine.name, chunk.firstRung, chunk.rungCount);
  for (uint32_t i = chunk.firstRung; i < chunk.firstRung + chunk.rungCount; ++i)
    putRung(routine.rungs[i], cut.rungNumber(chunk.routine, i), text);
  for (const ir::Exit& exit : ir::exitsOf(cut, chunk)) {
    put(text, "{}", static_cast<int>(exit.kind));
    putDestination(exit.taken, text);
    putDestination(exit.otherwise, text);
    for (const ir::Destination& to : exit.targets) putDestination(to, text);
    text += '\n';
  }
}

// What the object exports under that name; nothing when it is not an object or has none.
std::optional<PieceIdentity> identityIn(std::string_view object, const std::string& name) {
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
    if (valueOf(symbol.getName()) != llvm::StringRef(name)) continue;
    const auto section = valueOf(symbol.getSection());
    const auto offset = valueOf(symbol.getValue());
    if (!section || *section == (*file)->section_end() || !offset) return std::nullopt;
    const auto contents = valueOf((*section)->getContents());
    PieceIdentity identity{};
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
    : layout_(layout) {
  std::string text = fmt::format("{} {} {} {} {}\n", version, machine, RUNG_ABI_VERSION,
                                 static_cast<int>(options.level), options.debugInfo);
  text += layout.memory().text();
  if (options.debugInfo) text += fmt::format("{:x}\n", codeHash) + ir::print(layout.module()); // it has all names
  whole_ = sha256(text);
}

CacheKey CacheKeys::of(const ModulePart& piece) const {
  std::string text = fmt::format("{} {} {}\n", llvm::toHex(whole_, true), piece.firstChunk, piece.chunkCount);
  for (uint32_t i = 0; i < piece.chunkCount; ++i)
    putChunk(layout_.cut(), layout_.cut().chunks()[piece.firstChunk + i], text);
  return sha256(text);
}

ObjectCache::ObjectCache(const std::string& folder) {
  if (!folder.empty()) folder_ = host::CodeFolder::open(folder, problem_);
}

std::string ObjectCache::name(const ModulePart& piece) { return llvm::toHex(piece.key, true) + ".o"; }

std::optional<std::string> ObjectCache::find(const ModulePart& piece) const {
  std::optional<std::string> bytes = folder_ ? folder_->read(name(piece)) : std::nullopt;
  const size_t sealSize = cacheSeal({}).size();
  if (!bytes || bytes->size() < sealSize) return std::nullopt;
  const std::string_view object(bytes->data(), bytes->size() - sealSize);
  if (cacheSeal(object) != std::string_view(*bytes).substr(object.size())) return std::nullopt;
  if (identityIn(object, piece.identityName()) != PieceIdentity{piece.key, piece.firstChunk, piece.chunkCount})
    return std::nullopt;
  bytes->resize(object.size());
  return bytes;
}

Result<void> ObjectCache::keep(const ModulePart& piece, std::string_view object) const {
  if (!problem_.empty()) return failure(problem_);
  if (!folder_) return {};
  std::string wrong = folder_->write(name(piece), std::string(object) + cacheSeal(object));
  return wrong.empty() ? Result<void>() : failure(std::move(wrong));
}

} // namespace rung::codegen
