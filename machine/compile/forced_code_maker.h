// Code with forced cells for the programs that a host runs, made by its compiler process of the IR that they carry.
#pragma once
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "machine/compile/compilation.h"
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

} // namespace rung::compile
