// The forces of a program on their way to a compiler process: which bits are held, and the file of the program that
// runs, which carries its IR.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "machine/compile/limits.h"
#include "rung/program.h"

namespace rung::compile {

inline constexpr size_t kMostForcedBytes = 4096;
inline constexpr size_t kMostPackedForces = kMostImage + (size_t{1} << 20);

struct Forces {
  uint64_t codeHash = 0; // of the program that runs, as its tables have them
  uint64_t layoutHash = 0;
  std::vector<rung_forced_byte> bytes; // in the order of space and byte, each once
  std::string_view program;            // the file
};

std::string packed(const Forces& forces);
// Nothing, and `problem` says why, where they are not packed forces. The file may be any bytes; it is those of `bytes`.
std::optional<Forces> unpackedForces(std::string_view bytes, std::string& problem);

} // namespace rung::compile
