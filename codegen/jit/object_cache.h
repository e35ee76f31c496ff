// Object files kept in a folder, by key. A damaged file counts as absent. Several processes may use one folder.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "codegen/llvm/llvm_emitter.h"

namespace rung::codegen {

// All that decides what code a layout gives, on this machine and by this version of the back end.
uint64_t cacheKey(const ir::Layout& layout, uint64_t codeHash, const LlvmOptions& options, std::string_view machine);

class ObjectCache {
public:
  // An empty folder: nothing is kept or found.
  ObjectCache(std::string folder, uint64_t key) : folder_(std::move(folder)), key_(key) {}

  std::optional<std::string> find(uint32_t piece) const;
  Result<void> keep(uint32_t piece, std::string_view object) const;

private:
  std::string path(uint32_t piece) const;
  std::string folder_;
  uint64_t key_;
};

} // namespace rung::codegen
