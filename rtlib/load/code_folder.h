// A folder of machine code that a process makes and runs again, such as the JIT's cache: what is taken from it is run,
// so the rules of trust.h hold for the folder and for each file. Several processes of one user may use one folder.
#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "rtlib/load/file.h"

namespace rung::runtime {

class CodeFolder {
public:
  // Made for its owner alone where there is none. Nothing, and `problem` says why, when it cannot be used or others
  // could put files there.
  static std::optional<CodeFolder> open(const std::string& path, std::string& problem);

  // Nothing when the file is not there, or is one that others could have written.
  std::optional<std::string> read(const std::string& name) const;
  // Empty, or what went wrong.
  std::string write(const std::string& name, std::string_view bytes) const;

private:
  explicit CodeFolder(File folder) : folder_(std::move(folder)) {}
  File folder_;
};

} // namespace rung::runtime
