// Runs a C++ compiler on generated text (see cpp_emitter.h).
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <optional>
#include <sstream>
#include <vector>

#include "codegen/cpp/cpp_emitter.h"
#include "codegen/process/process.h"
#include "ir/support/put.h"
#include "ir/support/temporary_folder.h"

namespace rung::codegen {
namespace {

namespace fs = std::filesystem;

bool writeFile(const fs::path& path, std::string_view text) {
  std::error_code error;
  fs::create_directories(path.parent_path(), error);
  std::ofstream out(path, std::ios::binary);
  out.write(text.data(), static_cast<std::streamsize>(text.size()));
  return out.good();
}

void appendWords(std::string_view text, std::vector<std::string>& words) {
  std::istringstream in{std::string(text)};
  for (std::string word; in >> word;) words.push_back(word);
}

// Vectors would combine coils of neighbouring rungs, and cost more to assemble than their stores do.
constexpr std::string_view kFlags = "-x c++ -std=c++20 -fPIC -shared -fvisibility=hidden -fno-exceptions -fno-rtti "
                                    "-ffp-contract=off -fno-math-errno -fno-strict-aliasing -fno-tree-slp-vectorize -w";

// The driver with its flags, followed by those of the build.
std::vector<std::string> driverWords(const CppBuildOptions& options) {
  std::vector<std::string> words;
  appendWords(options.compiler, words);
  if (words.empty()) return words;
  appendWords(kFlags, words);
  words.push_back(options.optimisation);
  if (options.debugInfo) words.push_back("-gdwarf-4");
  return words;
}

// Identifies a compiler by its file: a new version has another size or time.
std::string compilerFacts(std::string_view name) {
  const std::string path = findProgram(name).value_or(std::string(name));
  std::error_code none;
  const fs::path file = fs::canonical(path, none);
  return fmt::format("{} {} {}", file.string(), fs::file_size(file, none),
                     fs::last_write_time(file, none).time_since_epoch().count());
}

} // namespace

std::string cppBuildIdentity(std::string_view text, const CppBuildOptions& options) {
  const std::vector<std::string> words = driverWords(options);
  std::string identity = words.empty() ? "" : compilerFacts(words[0]);
  for (const std::string& word : words) identity += '\n' + word;
  for (const text::EmbeddedFile& header : abiHeaders()) put(identity, "\n{}\n{}", header.name, header.text);
  return identity.append("\n").append(text);
}

Result<std::string> buildCppSharedObject(std::string_view text, const CppBuildOptions& options) {
  TemporaryFolder folder;
  if (!folder.ok()) return failure(fmt::format("cannot make a temporary folder: {}", std::strerror(errno)));
  bool written = writeFile(folder / "program.cpp", text);
  for (const text::EmbeddedFile& header : abiHeaders())
    written = written && writeFile(folder / header.name, header.text);
  if (!written) return failure("cannot write the generated C++ to a temporary folder");

  std::vector<std::string> words = driverWords(options);
  if (words.empty()) return failure("the name of the C++ compiler is empty");
  for (std::string word : {std::string("-I"), (folder / ".").string(), (folder / "program.cpp").string(),
                           std::string("-o"), (folder / "program.so").string()})
    words.push_back(std::move(word));
  const std::string log = (folder / "log").string();
  const auto logged = [&folder] {
    const std::string lines = folder.contentsOf("log").value_or("");
    return lines.empty() ? lines : "\n" + lines;
  };
  const Result<int> code = runProgram(words, {.out = log, .error = log});
  if (!code.ok()) return failure(fmt::format("cannot run the C++ compiler: {}{}", code.error(), logged()));
  if (code.value() != 0)
    return failure(fmt::format("the C++ compiler '{}' failed: exit code {}{}", words[0], code.value(), logged()));
  std::optional<std::string> image = folder.contentsOf("program.so");
  if (!image) return failure(fmt::format("the C++ compiler '{}' made no shared object", words[0]));
  return std::move(*image);
}

} // namespace rung::codegen
