// What a host and its compiler process agree on.
#pragma once
#include <cstddef>
#include <string_view>

namespace rung::compile {

// Open files of the process besides its standard output and error, which lead nowhere.
inline constexpr int kInputFile = 0;  // the packed sources, or forces
inline constexpr int kAnswerFile = 3; // a line with the verdict, then what it is about
inline constexpr int kImageFile = 4;  // a memory file for the program

inline constexpr std::string_view kForcesWord = "--forces"; // an argument: the input is packed forces

inline constexpr std::string_view kVerdictCompiled = "compiled"; // and warnings
inline constexpr std::string_view kVerdictErrors = "errors";     // as rungc prints them
inline constexpr std::string_view kVerdictFailed = "failed";     // a sentence
inline constexpr std::string_view kVerdictSources = "sources";   // packed: of files that were to be read

inline constexpr size_t kMostReport = size_t{256} << 10; // bytes of warnings and errors
inline constexpr unsigned kMostProcessorSeconds = 30;
inline constexpr size_t kMostMemory = size_t{2} << 30; // address space
inline constexpr size_t kMostImage = size_t{64} << 20; // bytes of a program's file, and of each file that it writes

} // namespace rung::compile
