// Object files in a folder, one per code unit, by the hash of everything that determines the unit's code, before any
// pass of LLVM: if one rung of a program changes, the other units are found, even if they have moved, except those
// whose cells have other places in memory now. The object contains the key, too (see CodeUnitIdentity), which is
// compared: a file with the right name and other contents counts as absent, as do damaged files and files that other
// users could have written (see runtime::CodeFolder). Several processes may share a folder.
#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "codegen/llvm/embedded.h"
#include "codegen/llvm/llvm_emitter.h"
#include "codegen/llvm/module_part.h"
#include "rtlib/load/trust.h"

namespace rung::codegen {

// Keys of the code units of one program for one machine. `version`: of the compiler; tests substitute it.
class CacheKeys {
public:
  CacheKeys(const ir::Layout& layout, uint64_t codeHash, const LlvmOptions& options, std::string_view machine,
            std::string_view version = codeVersion());
  CacheKey of(const ModulePart& unit) const;

private:
  const ir::Layout& layout_;
  bool debugInfo_;
  CacheKey whole_ = {}; // hash of everything that all units share
};

// The trailer of an object in its file; a file that does not end with it was truncated or changed.
std::string cacheSeal(std::string_view object);

class ObjectCache {
public:
  // With an empty folder name nothing is stored or found.
  explicit ObjectCache(const std::string& folder);

  std::optional<std::string> find(const ModulePart& unit) const;
  Result<void> keep(const ModulePart& unit, std::string_view object) const;

private:
  static std::string name(const ModulePart& unit);
  std::optional<runtime::CodeFolder> folder_;
  std::string problem_; // why the folder cannot be used
};

} // namespace rung::codegen
