// Object files kept in a folder, by key. A damaged file counts as absent, and so does one that others could have
// written (see host::CodeFolder). Several processes may use one folder.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "codegen/llvm/llvm_emitter.h"
#include "rtlib/host/code_folder.h"

namespace rung::codegen {

// All that decides what code a layout gives, on this machine and by this version of the back end.
uint64_t cacheKey(const ir::Layout& layout, uint64_t codeHash, const LlvmOptions& options, std::string_view machine);

class ObjectCache {
public:
  // An empty folder: nothing is kept or found.
  ObjectCache(const std::string& folder, uint64_t key);

  std::optional<std::string> find(uint32_t piece) const;
  Result<void> keep(uint32_t piece, std::string_view object) const;

private:
  std::string name(uint32_t piece) const;
  std::optional<host::CodeFolder> folder_;
  std::string problem_; // of a folder that cannot be used
  uint64_t key_;
};

} // namespace rung::codegen
