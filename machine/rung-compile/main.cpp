// rung-compile: compiles sources, or a program with forced cells, for the host that starts it, without the host's
// rights (docs/security.md); or reads sources for it, with the rights of their user.
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <iostream>
#include <string>
#include <string_view>
#include <vector>

#include "machine/compile/forced_code_maker.h"
#include "machine/compile/sources.h"
#include "machine/rung-compile/collect.h"
#include "machine/rung-compile/compile_forces.h"
#include "machine/rung-compile/compile_sources.h"
#include "machine/rung-compile/sandbox.h"
#include "rtlib/load/file.h"

namespace {

using namespace rung;
using rung_compile::Limits;

constexpr int kWrongUsage = 2;
constexpr Limits kLimits{.processorSeconds = compile::kMostProcessorSeconds,
                         .memory = compile::kMostMemory,
                         .fileSize = compile::kMostImage};

int answer(std::string_view verdict, std::string_view text) {
  const std::string line = std::string(verdict) + "\n";
  return runtime::writeAll(compile::kAnswerFile, line) && runtime::writeAll(compile::kAnswerFile, text) ? 0 : 1;
}

// Replaces standard output by a memory file for the linker.
bool makeOutput() {
  const int file = memfd_create("rung-linked", MFD_CLOEXEC);
  return file >= 0 && dup2(file, STDOUT_FILENO) >= 0 && close(file) == 0;
}

// A first compilation opens and loads everything that the compiler needs, before any data of a client is read.
std::string warmUp() {
  if (!makeOutput()) return std::string("cannot make a memory file: ") + std::strerror(errno);
  const std::string name = "warm-up.pmc";
  const std::string text = "dialect gsk\nFUNC END1\nLD X0.0\nOUT Y0.0\nFUNC END2\n";
  const rung_compile::Outcome outcome =
      rung_compile::compileSources(compile::packed(compile::Sources{.files = {name}, .texts = {{name, text}}}));
  return outcome.verdict == compile::kVerdictCompiled ? "" : "the compiler does not work: " + outcome.report;
}

// Returns false if the input is too long.
bool readInput(std::string& bytes, size_t most) {
  constexpr size_t kPiece = size_t{1} << 20;
  size_t used = 0;
  ssize_t got = 1;
  while (got != 0 && used <= most) {
    bytes.resize(used + kPiece);
    got = read(compile::kInputFile, bytes.data() + used, kPiece);
    if (got > 0) used += static_cast<size_t>(got);
    if (got < 0 && errno != EINTR) got = 0;
  }
  bytes.resize(used);
  return used <= most;
}

// Returns "", or an error. The file is sealed: no process can change it from then on.
std::string writeImage(std::string_view bytes) {
  constexpr int kSeals = F_SEAL_WRITE | F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL;
  if (runtime::writeAll(compile::kImageFile, bytes) && fcntl(compile::kImageFile, F_ADD_SEALS, kSeals) == 0) return "";
  return std::string("cannot write the program: ") + std::strerror(errno);
}

struct Work { // what the process is started for
  const char* input;
  size_t most; // input bytes
  rung_compile::Outcome (*compile)(std::string_view bytes);
};
constexpr Work kSources{"sources", compile::kMostBytes, &rung_compile::compileSources};
constexpr Work kForces{"forces", compile::kMostPackedForces, &rung_compile::compileForces};

int compileInput(const Work& work) {
  std::string bytes;
  if (!readInput(bytes, work.most))
    return answer(compile::kVerdictFailed, std::string("the ") + work.input + " have more than " +
                                               std::to_string(work.most) + " bytes, expected no more");
  const rung_compile::Outcome outcome = work.compile(bytes);
  if (outcome.verdict != compile::kVerdictCompiled) return answer(outcome.verdict, outcome.report);
  const std::string problem = writeImage(outcome.image);
  return problem.empty() ? answer(outcome.verdict, outcome.report) : answer(compile::kVerdictFailed, problem);
}

int compileForHost(const Work& work) {
  std::string problem = rung_compile::giveUpRights(compile::kImageFile, kLimits);
  if (problem.empty()) problem = warmUp();
  if (problem.empty()) problem = rung_compile::enterSandbox();
  return problem.empty() ? compileInput(work) : answer(compile::kVerdictFailed, problem);
}

int collectForHost(std::string_view number, const std::vector<std::string>& files) {
  uid_t user = 0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), user);
  if (error != std::errc() || end != number.data() + number.size() || files.empty()) return kWrongUsage;
  if (const std::string problem = rung_compile::becomeUser(user, kLimits); !problem.empty())
    return answer(compile::kVerdictFailed, problem);
  const rung_compile::Collected collected = rung_compile::collect(files);
  return collected.sources ? answer(compile::kVerdictSources, compile::packed(*collected.sources))
                           : answer(compile::kVerdictErrors, collected.report);
}

bool isOpen(int file) { return fcntl(file, F_GETFD) >= 0; }

} // namespace

// Without arguments: compile::packed sources on standard input. --forces: compile::packed forces. --collect --user
// NUMBER -- FILE…: reads files.
int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  const bool hasFiles = fcntl(compile::kImageFile, F_GET_SEALS) >= 0 && isOpen(compile::kAnswerFile);
  if (words.empty() && hasFiles) return compileForHost(kSources);
  if (words.size() == 1 && words[0] == compile::kForcesWord && hasFiles) return compileForHost(kForces);
  if (words.size() > 4 && words[0] == "--collect" && words[1] == "--user" && isOpen(compile::kAnswerFile))
    return collectForHost(words[2], {words.begin() + 4, words.end()});
  std::cerr << "rung-compile: only hosts of PLC programs, such as rung_hal and rung-run, start this program\n";
  return kWrongUsage;
}
