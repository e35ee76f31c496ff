// The cross reference of a module, with all that it refers to.
#pragma once
#include "ir/image/program_image.h"
#include "tools/report/cross_reference.h"

namespace rung::report {

class ModuleReference {
public:
  // `module` and `shown` (see CrossReference) must outlive it.
  ModuleReference(const ir::Module& module, std::span<const std::string_view> shown)
      : layout_(module, {}), image_(layout_, 0), uses_(module), reference_(image_.program(), uses_, shown) {}
  ModuleReference(const ModuleReference&) = delete; // the parts refer to each other
  ModuleReference& operator=(const ModuleReference&) = delete;

  const CrossReference& get() const { return reference_; }

private:
  const ir::Layout layout_;
  const ir::ProgramImage image_;
  const ir::Uses uses_;
  const CrossReference reference_;
};

} // namespace rung::report
