// The request for the program that a tool of the bench is given: files, or the project of a rung.toml.
#pragma once
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "compiler/compile.h"
#include "ir/support/result.h"

namespace rung::bench {

template <class T>
T good(Result<T> result) {
  if (!result.ok()) throw std::runtime_error(result.error());
  return std::move(result).value();
}

// A project's configuration is that of the request. Throws std::runtime_error if a file cannot be read.
compiler::CompileRequest requestOf(SourceManager& sources, const std::vector<std::string>& paths,
                                   std::vector<FileId>& files);

} // namespace rung::bench
