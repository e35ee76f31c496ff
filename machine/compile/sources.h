// The sources of a program as the input of a compiler process: the texts of all files, including included ones, and the
// options of the compilation. Sockets and pipes carry them as bytes (docs/control-protocol.md).
#pragma once
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <sys/types.h>

#include "rung/runtime.hpp"

namespace rung::compile {

inline constexpr size_t kMostBytes = size_t{16} << 20; // of packed sources
inline constexpr size_t kMostFiles = 1000;

struct Sources {
  std::string dialect;                       // empty: the first file determines it
  std::string name;                          // of the project; empty: the program is named after its first file
  std::vector<std::string> files;            // in order; these paths are only names, and never opened
  std::vector<std::string> includePaths;     // folders
  std::map<std::string, std::string> config; // keys of the dialect's configuration
  bool profile = false;                      // count and time every rung
  std::map<std::string, std::string> texts;  // by path
};

std::string packed(const Sources& sources);
// Unpacks sources. Returns nothing, with the reason in `problem`, if they are not packed sources, or have too many
// files.
std::optional<Sources> unpacked(std::string_view bytes, std::string& problem);

// Numbers and texts in the input of a compiler process.

// Appends a number, low byte first.
inline void putNumber(std::string& out, uint64_t number, unsigned bytes) {
  for (unsigned i = 0; i < bytes; ++i) out += static_cast<char>(number >> i * 8 & 0xFF);
}

// Takes bytes from the front of an input. `good`: the input has been long enough so far.
class ByteReader {
public:
  explicit ByteReader(std::string_view bytes) : rest_(bytes) {}
  bool atEnd() const { return rest_.empty(); }
  bool good() const { return good_; }
  std::string_view rest() const { return rest_; }
  std::string_view take(size_t count) {
    good_ = good_ && count <= rest_.size();
    const std::string_view taken = rest_.substr(0, good_ ? count : 0);
    rest_.remove_prefix(taken.size());
    return taken;
  }
  uint64_t takeNumber(unsigned bytes) {
    uint64_t number = 0;
    unsigned shift = 0;
    for (const char byte : take(bytes)) {
      number |= uint64_t{static_cast<uint8_t>(byte)} << shift;
      shift += 8;
    }
    return number;
  }

private:
  std::string_view rest_;
  bool good_ = true;
};

// The interface between a host and its compiler process.

// File descriptors of the process besides its standard output and standard error, whose contents are discarded.
inline constexpr int kInputFile = 0;  // packed sources or forces
inline constexpr int kAnswerFile = 3; // one line with the verdict, then a text
inline constexpr int kImageFile = 4;  // a memory file that receives the program

inline constexpr std::string_view kForcesWord = "--forces"; // an argument: the input is packed forces

inline constexpr std::string_view kVerdictCompiled = "compiled"; // the text: warnings
inline constexpr std::string_view kVerdictErrors = "errors";     // the text: errors, as rungc prints them
inline constexpr std::string_view kVerdictFailed = "failed";     // the text: a sentence
inline constexpr std::string_view kVerdictSources = "sources";   // the text: the packed sources of the files

inline constexpr size_t kMostReport = size_t{256} << 10; // bytes of warnings and errors
inline constexpr unsigned kMostProcessorSeconds = 30;
inline constexpr size_t kMostMemory = size_t{2} << 30; // address space
inline constexpr size_t kMostImage = size_t{64} << 20; // bytes of a program, and of each file that the process writes

// The program that a host starts with: a compiled file, or sources that are compiled first.

// Compiles a source file or a project (its folder or project file) in a separate process, which reads the files with
// the rights of `user`, and waits for it. `warnings` receives the warnings that rungc would print. Throws
// std::runtime_error with all errors.
Image compiledImage(const std::string& path, uid_t user, std::string& warnings);

} // namespace rung::compile
