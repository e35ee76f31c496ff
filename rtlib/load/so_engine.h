// The loader of compiled programs: a .so with the one data symbol RUNG_PROGRAM_SYMBOL.
//
// Loading a shared object runs code of it before anything of it can be looked at (constructors), and a damaged one
// makes the dynamic linker crash or end the process. So whether to load is decided on the file alone, before the
// dynamic linker sees it: its seal (seal.h), and whose it is (trust.h). The seal shows damage and no more; that the
// code is the right one follows from who can write the file, or from a signature. checkProgram comes last and protects
// from programs of other versions, not from malice: who may provide the file may do anything the process may do.
//
// What is checked is what is loaded: file or link are opened once, facts and bytes are those of the descriptor, and the
// library is loaded from the descriptor. A file that only a signature admits could be changed by its owner afterwards,
// so a sealed copy in memory takes its place before the check. Others than the process trusts cannot change the rest;
// they must replace the file (as rungc build does), not write into it while it is loaded.
//
// The dynamic linker knows an open library again by name or by file. A name is therefore used once in a process, and
// the descriptor stays open as long as the library: a rebuilt file at the same path is the new program even while the
// old one is loaded. The name is /proc/PID/fd/N, so that a debugger in another process finds the file, too, even when
// another has taken its place; profilers record the path of the mapped file. Copies in memory have none.
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

// How long the object stays loaded. Profilers look up lines when the process ends, and find none of what is gone.
enum class Loaded : uint8_t { WithEngine, WithProcess };

struct SoOptions {
  Loaded loaded = Loaded::WithEngine;
  bool mayLackSeal = false;             // load what another linker made as it is; a privileged process never does
  std::string keysFolder = kKeysFolder; // of public keys; a privileged process always takes kKeysFolder
};

class SoEngine final : public Engine {
public:
  // Null, and `error` says why, when the file is damaged, may not be trusted, cannot be loaded or is not a program of
  // this version.
  static std::unique_ptr<SoEngine> open(const std::string& path, std::string& error, const SoOptions& options = {});
  // The same of a memory file that a process has made which the caller trusts: what is in it is checked, and that it
  // can no longer be changed. `file` stays the caller's.
  static std::unique_ptr<SoEngine> openMemory(int file, const std::string& name, std::string& error);
  ~SoEngine() override;

  const rung_program& program() const override { return *program_; }
  std::string_view name() const override { return "so"; }
  const std::string& path() const { return path_; }
  // The file's bytes from `first` on, as it was loaded; gives how many there were. Nothing: it cannot be read.
  std::optional<size_t> readFile(uint64_t first, std::span<char> to) const;

private:
  SoEngine(void* library, const rung_program* program, std::string path, File file);
  static std::unique_ptr<SoEngine> load(const std::string& path, File file, std::string& error, Loaded loaded);
  void keepWithProcess(const std::string& name);

  void* library_;
  const rung_program* program_;
  std::string path_;
  File file_;      // what the library was loaded from
  int descriptor_; // the same
};

} // namespace rung::runtime
