// The loader of compiled programs: a .so with the one data symbol RUNG_PROGRAM_SYMBOL.
//
// Loading a shared object runs its code (constructors) before any of it can be inspected, and a damaged one makes the
// dynamic linker crash or end the process. So the decision to load depends on the file alone, before the dynamic linker
// sees it: on its seal (seal.h) and its owner (trust.h). The seal detects only damage; that the code is the right one
// follows from who can write the file, or from a signature. checkProgram comes last and protects from programs of other
// versions, not from malice: the author of the file can do anything that the process may do.
//
// The checked file is the loaded file: the path is opened once, owner and bytes are read through the descriptor, and
// the library is loaded from the descriptor. A file that only a signature admits could be changed by its owner
// afterwards, so a sealed copy in memory replaces it before the check. Any other file can be changed only by users whom
// the process trusts; they must replace it (as rungc build does), not write into it while it is loaded.
//
// The dynamic linker recognises an open library by name or by file. A name is therefore used once in a process, and the
// descriptor stays open as long as the library: a rebuilt file at the same path is loaded as a new program even while
// the old one is loaded. The name is /proc/PID/fd/N, so that a debugger in another process finds the file, too, even if
// another one has replaced it; profilers record the path of the mapped file. Copies in memory have no path.
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "rtlib/load/engine.h"
#include "rtlib/load/file.h"
#include "rtlib/load/trust.h"

namespace rung::runtime {

// How long the object stays loaded. Profilers look up source lines when the process ends, which fails for unloaded
// objects.
enum class Loaded : uint8_t { WithEngine, WithProcess };

struct SoOptions {
  Loaded loaded = Loaded::WithEngine;
  bool mayLackSeal = false;             // accept a file without a seal; a privileged process never does
  std::string keysFolder = kKeysFolder; // folder of public keys; a privileged process always uses kKeysFolder
};

class SoEngine final : public Engine {
public:
  // Null, and `error` says why, if the file is damaged, may not be trusted, cannot be loaded or is not a program of
  // this version.
  static std::unique_ptr<SoEngine> open(const std::string& path, std::string& error, const SoOptions& options = {});
  // The same for a memory file made by a process that the caller trusts: its contents are checked, and that it is
  // sealed against changes. `file` still belongs to the caller.
  static std::unique_ptr<SoEngine> openMemory(int file, const std::string& name, std::string& error);
  ~SoEngine() override;

  const rung_program& program() const override { return *program_; }
  std::string_view name() const override { return "so"; }
  const std::string& path() const { return path_; }
  // Reads bytes of the loaded file from `first` on; returns their number. Nothing: the file cannot be read.
  std::optional<size_t> readFile(uint64_t first, std::span<char> to) const;

private:
  SoEngine(void* library, const rung_program* program, std::string path, File file);
  static std::unique_ptr<SoEngine> load(const std::string& path, File file, std::string& error, Loaded loaded);
  void keepWithProcess(const std::string& name);

  void* library_;
  const rung_program* program_;
  std::string path_;
  File file_;      // the file of the library
  int descriptor_; // of file_
};

} // namespace rung::runtime
