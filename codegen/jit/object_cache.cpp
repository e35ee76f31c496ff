// Object files on disk (see object_cache.h).
#include "codegen/jit/object_cache.h"

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <unistd.h>

#include <fmt/format.h>

#include "codegen/llvm/embedded.h"
#include "ir/support/hash.h"

namespace rung::codegen {
namespace {

namespace fs = std::filesystem;

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

std::string ObjectCache::path(uint32_t piece) const {
  return (fs::path(folder_) / fmt::format("{:016x}-{}.o", key_, piece)).string();
}

std::optional<std::string> ObjectCache::find(uint32_t piece) const {
  if (folder_.empty()) return std::nullopt;
  std::ifstream in(path(piece), std::ios::binary);
  std::string bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  const size_t sealSize = seal({}).size();
  if (!in || bytes.size() < sealSize) return std::nullopt;
  const std::string_view object(bytes.data(), bytes.size() - sealSize);
  if (seal(object) != std::string_view(bytes).substr(object.size())) return std::nullopt;
  bytes.resize(object.size());
  return bytes;
}

Result<void> ObjectCache::keep(uint32_t piece, std::string_view object) const {
  if (folder_.empty()) return {};
  std::error_code error;
  fs::create_directories(folder_, error);
  // Renamed when complete: readers never see half a file.
  const std::string unfinished = fmt::format("{}.{}.tmp", path(piece), getpid());
  std::ofstream out(unfinished, std::ios::binary);
  out << object << seal(object);
  out.close();
  if (!out) {
    fs::remove(unfinished, error);
    return failure(fmt::format("cannot write {}", unfinished));
  }
  fs::rename(unfinished, path(piece), error);
  if (error) return failure(fmt::format("cannot write {}: {}", path(piece), error.message()));
  return {};
}

} // namespace rung::codegen
