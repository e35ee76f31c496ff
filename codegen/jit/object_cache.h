// Object files kept in a folder, one a unit, by the hash of all that makes the unit's code, before any pass of LLVM:
// of a program that changes in one rung the other units are found, also where they have moved, but for those whose
// cells lie elsewhere in memory now. The key is also in the object (see CodeUnitIdentity) and is compared there: a file
// under a right name with other contents counts as absent, as a damaged one does, and one that others could have
// written (see runtime::CodeFolder). Several processes may use one folder.
#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "codegen/llvm/embedded.h"
#include "codegen/llvm/llvm_emitter.h"
#include "codegen/llvm/module_part.h"
#include "rtlib/load/trust.h"

namespace rung::codegen {

// Keys of the units of one program for one machine. `version` is that of the compiler, which tests exchange.
class CacheKeys {
public:
  CacheKeys(const ir::Layout& layout, uint64_t codeHash, const LlvmOptions& options, std::string_view machine,
            std::string_view version = codeVersion());
  CacheKey of(const ModulePart& unit) const;

private:
  const ir::Layout& layout_;
  bool debugInfo_;
  CacheKey whole_ = {}; // all that the units share
};

// What follows an object's bytes in its file; a file that does not end in it was cut or changed.
std::string cacheSeal(std::string_view object);

class ObjectCache {
public:
  // An empty folder: nothing is kept or found.
  explicit ObjectCache(const std::string& folder);

  std::optional<std::string> find(const ModulePart& unit) const;
  Result<void> keep(const ModulePart& unit, std::string_view object) const;

private:
  static std::string name(const ModulePart& unit);
  std::optional<runtime::CodeFolder> folder_;
  std::string problem_; // of a folder that cannot be used
};

} // namespace rung::codegen
