// Shared objects stored in a folder (see object_folder.h).
#include "compiler/object_folder.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rtlib/load/seal.h"
#include "rtlib/load/trust.h"

namespace rung::compiler {
namespace {

std::string nameOf(std::string_view identity) {
  return fmt::format("{:02x}.so", fmt::join(runtime::digestOf(identity), ""));
}

bool isWhole(std::string_view file) {
  const runtime::SealedFile read = runtime::readSealed(file);
  return read.seal.has_value() && read.damage.empty();
}

} // namespace

Result<std::string> sealedObject(const std::string& folder, std::string_view identity,
                                 const std::function<Result<std::string>()>& build) {
  std::string problem;
  const auto kept = folder.empty() ? std::nullopt : runtime::CodeFolder::open(folder, problem);
  const std::string name = kept ? nameOf(identity) : "";
  std::optional<std::string> found = kept ? kept->read(name) : std::nullopt;
  if (found && isWhole(*found)) return std::move(*found);
  const Result<std::string> built = build();
  if (!built.ok()) return built.failure();
  std::string file = runtime::sealed(built.value());
  if (kept) kept->write(name, file); // a failure such as a full disk is ignored: the next run builds it again
  return file;
}

} // namespace rung::compiler
