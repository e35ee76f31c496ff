// Code with forced cells for the programs that a host runs, made by its compiler process of the IR that they carry.
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

// For all threads. One set of forces at a time: another one takes its place.
class ForcedCodeMaker : public std::enable_shared_from_this<ForcedCodeMaker> {
public:
  static std::shared_ptr<ForcedCodeMaker> make() { return std::make_shared<ForcedCodeMaker>(); }

  // From now on rung_forces_new makes sets for a program of this image also where rungs write their cells: RUNG_LATER
  // as long as the process works. Its file is what has been loaded; no path is opened again.
  void serve(const Image& image);
  // Ends the process where one works.
  void abandon();

private:
  struct Wanted { // of which program, and which bits
    uint64_t codeHash = 0;
    uint64_t layoutHash = 0;
    std::vector<rung_forced_byte> bytes;
  };
  struct Made;
  // False: the process is at work. Throws std::runtime_error where there will be no such code.
  bool force(const rung_image* image, const rung_program& program, std::span<const rung_forced_byte> forced,
             rung_forced_code& code);
  void begin(const rung_image* image, Wanted wanted);
  bool isWanted(const Wanted& other) const;

  std::mutex mutex_; // of these two
  Wanted wanted_;
  std::unique_ptr<Compilation> compilation_; // of it
};

// The forces of a program on their way to a compiler process: which bits are held, and the file of the program that
// runs, which carries its IR.

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
