// Makes code with forced cells for a host's programs: a compiler process compiles the IR that the programs contain.
#pragma once
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "machine/compile/compilation.h"
#include "machine/compile/sources.h"
#include "rung/program.h"
#include "rung/runtime.hpp"

namespace rung::compile {

// Any thread. Compiles one set of forces at a time; a new one replaces it.
class ForcedCodeMaker : public std::enable_shared_from_this<ForcedCodeMaker> {
public:
  static std::shared_ptr<ForcedCodeMaker> make() { return std::make_shared<ForcedCodeMaker>(); }

  // Attaches the compiler to an image: from now on rung_forces_new also accepts cells that rungs of its program write,
  // and returns RUNG_LATER while the process works. The process gets the file that was loaded; no path is opened again.
  void serve(const Image& image);
  // Ends the compiler process, if one is running.
  void abandon();

private:
  struct Wanted { // the program and its forced bits
    uint64_t codeHash = 0;
    uint64_t layoutHash = 0;
    std::vector<rung_forced_byte> bytes;
  };
  struct Made;
  // Returns false while the process is running. Throws std::runtime_error if no such code can be made.
  bool force(const rung_image* image, const rung_program& program, std::span<const rung_forced_byte> forced,
             rung_forced_code& code);
  void begin(const rung_image* image, Wanted wanted);
  bool isWanted(const Wanted& other) const;

  std::mutex mutex_; // protects wanted_ and compilation_
  Wanted wanted_;
  std::unique_ptr<Compilation> compilation_; // makes the code for `wanted_`
};

// Packed forces, the input of a compiler process: the forced bits, and the file of the running program, which contains
// its IR.

inline constexpr size_t kMostForcedBytes = 4096;
inline constexpr size_t kMostPackedForces = kMostImage + (size_t{1} << 20);

struct Forces {
  uint64_t codeHash = 0; // hashes of the running program, as in its tables
  uint64_t layoutHash = 0;
  std::vector<rung_forced_byte> bytes; // sorted by space and byte, each once
  std::string_view program;            // its file
};

std::string packed(const Forces& forces);
// Unpacks forces. Returns nothing, with the reason in `problem`, if they are not packed forces. The program may be any
// bytes; it is a view of `bytes`.
std::optional<Forces> unpackedForces(std::string_view bytes, std::string& problem);

} // namespace rung::compile
