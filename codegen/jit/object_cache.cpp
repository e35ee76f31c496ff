// Object files on disk (see object_cache.h).
#include "codegen/jit/object_cache.h"

#include <iterator>

#include <fmt/format.h>

#include "codegen/llvm/embedded.h"
#include "ir/support/hash.h"

namespace rung::codegen {
namespace {

// Behind the object's bytes; a file that does not end in it was cut or changed.
std::string seal(std::string_view object) { return fmt::format("rung-object {:016x}\n", hashBytes(object)); }

} // namespace

uint64_t cacheKey(const ir::Layout& layout, uint64_t codeHash, const LlvmOptions& options, std::string_view machine) {
  std::string text = fmt::format("{} {} {} {:x} {:x} {} {} {}\n", llvmBackEndVersion(), machine, RUNG_ABI_VERSION,
                                 codeHash, layout.hash(), static_cast<int>(options.level), options.debugInfo,
                                 options.sabotage ? static_cast<int>(*options.sabotage) : -1);
  for (const std::string& file : layout.module().files) text += file + "\n";
  for (const ir::Chunk& chunk : layout.chunks())
    fmt::format_to(std::back_inserter(text), "{} {} {}\n", chunk.routine.index, chunk.firstRung, chunk.rungCount);
  return hashBytes(text);
}

ObjectCache::ObjectCache(const std::string& folder, uint64_t key) : key_(key) {
  if (!folder.empty()) folder_ = host::CodeFolder::open(folder, problem_);
}

std::string ObjectCache::name(uint32_t piece) const { return fmt::format("{:016x}-{}.o", key_, piece); }

std::optional<std::string> ObjectCache::find(uint32_t piece) const {
  std::optional<std::string> bytes = folder_ ? folder_->read(name(piece)) : std::nullopt;
  const size_t sealSize = seal({}).size();
  if (!bytes || bytes->size() < sealSize) return std::nullopt;
  const std::string_view object(bytes->data(), bytes->size() - sealSize);
  if (seal(object) != std::string_view(*bytes).substr(object.size())) return std::nullopt;
  bytes->resize(object.size());
  return bytes;
}

Result<void> ObjectCache::keep(uint32_t piece, std::string_view object) const {
  if (!problem_.empty()) return failure(problem_);
  if (!folder_) return {};
  std::string wrong = folder_->write(name(piece), std::string(object) + seal(object));
  return wrong.empty() ? Result<void>() : failure(std::move(wrong));
}

} // namespace rung::codegen
