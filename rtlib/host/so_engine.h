// The loader of compiled programs: a .so with the one data symbol RUNG_PROGRAM_SYMBOL.
#pragma once
#include <cstdint>
#include <memory>
#include <string>

#include "rtlib/host/engine.h"

namespace rung::host {

// How long the object stays loaded. Profilers look up lines when the process ends, and find none of what is gone.
enum class Loaded : uint8_t { WithEngine, WithProcess };

class SoEngine final : public Engine {
public:
  // Null, and `error` says why, when the file cannot be loaded or is not a program of this version.
  static std::unique_ptr<SoEngine> open(const std::string& path, std::string& error,
                                        Loaded loaded = Loaded::WithEngine);
  ~SoEngine() override;

  const rung_program& program() const override { return *program_; }
  std::string_view name() const override { return "so"; }
  const std::string& path() const { return path_; }

private:
  SoEngine(void* library, const rung_program* program, std::string path);
  void* library_;
  const rung_program* program_;
  std::string path_;
};

} // namespace rung::host
