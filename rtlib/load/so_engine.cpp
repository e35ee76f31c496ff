// Checks the file, then calls dlopen (see so_engine.h).
#include "rtlib/load/so_engine.h"

#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include "rtlib/load/file.h"
#include "rtlib/load/program_info.h"

namespace rung::runtime {
namespace {

constexpr size_t kMostBytes = size_t{256} << 20;

std::string becauseOfErrno() { return std::strerror(errno); }

// ---- the file ----

constexpr int kSeals = F_SEAL_WRITE | F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL;

// A sealed memory file with the bytes of another file.
File sealedCopy(int from, std::string& problem) {
  std::string bytes;
  problem = readAll(from, kMostBytes, bytes);
  if (!problem.empty()) return File();
  File copy(::memfd_create("rung-program", MFD_CLOEXEC | MFD_ALLOW_SEALING));
  if (!copy.ok() || !writeAll(copy.fd(), bytes) || ::fcntl(copy.fd(), F_ADD_SEALS, kSeals) != 0) {
    problem = "it cannot be copied to memory: " + becauseOfErrno();
    return File();
  }
  return copy;
}

// The state of a seal; `remark` says why a key could not be looked up.
SealState stateOf(const std::optional<Seal>& seal, const ProcessIds& ids, const SoOptions& options,
                  std::string& remark) {
  if (!seal) return SealState::Missing;
  if (!seal->signature) return SealState::Unsigned;
  const std::optional<PublicKey> key = findKey(seal->signature->key, options.keysFolder, ids, remark);
  if (!key) {
    remark = "its signature is by key " + textOf(seal->signature->key) + ", which is not among the known keys" +
             (remark.empty() ? "" : " (" + remark + ")");
    return SealState::UnknownKey;
  }
  return isSignedBy(*seal, *key) ? SealState::Signed : SealState::WrongSignature;
}

// Why a file with these bytes and facts must not be loaded, or "".
std::string contentProblem(std::string_view bytes, const FileFacts& facts, const ProcessIds& ids,
                           const SoOptions& options) {
  const SealedFile file = readSealed(bytes);
  if (!file.damage.empty()) return file.damage + "; build or copy it again";
  const ElfObject object = readElf(file.image);
  if (!object.problem.empty() && (file.seal || !isElf(file.image))) return object.problem;
  std::string remark;
  const SealState state = stateOf(file.seal, ids, options, remark);
  const std::string wrong = loadProblem(facts, ids, state, options.mayLackSeal);
  if (!wrong.empty()) return remark.empty() ? wrong : wrong + "; " + remark;
  if (object.problem.empty() && object.machine != machineHere())
    return "it is for processor " + object.machine + ", and this one is " + std::string(machineHere()) +
           "; build it for this one (rungc build --target)";
  return isPrivileged(ids) ? dependencyProblem(object) : object.problem;
}

// Opens the file to load. Not open: `problem` says why.
File openTrusted(const std::string& path, const SoOptions& options, std::string& problem) {
  // O_NONBLOCK, because opening a pipe would wait for its other end.
  File file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY));
  const std::optional<FileFacts> facts = factsOf(file.fd());
  if (!facts) {
    problem = becauseOfErrno();
    return File();
  }
  if (!facts->isRegular) {
    problem = "it is not a regular file";
    return File();
  }
  const ProcessIds ids = idsOfThisThread();
  std::string bytes;
  if (!ownerProblem(*facts, ids).empty()) file = sealedCopy(file.fd(), problem);
  if (problem.empty()) problem = readAll(file.fd(), kMostBytes, bytes);
  if (problem.empty()) problem = contentProblem(bytes, *facts, ids, options);
  return problem.empty() ? std::move(file) : File();
}

// The same for a memory file that the caller trusts.
File openSealed(int from, std::string& problem) {
  const int seals = ::fcntl(from, F_GET_SEALS);
  if (seals < 0 || (seals & kSeals) != kSeals) {
    problem = seals < 0 ? "it is not a memory file" : "it is not sealed, so others could still change it";
    return File();
  }
  std::string bytes;
  problem = readAll(from, kMostBytes, bytes);
  if (!problem.empty()) return File();
  constexpr FileFacts kNobodyCanChangeIt{.uid = 0, .gid = 0, .mode = 0400};
  problem = contentProblem(bytes, kNobodyCanChangeIt, idsOfThisThread(), {});
  File file(problem.empty() ? ::fcntl(from, F_DUPFD_CLOEXEC, 0) : -1);
  if (problem.empty() && !file.ok()) problem = becauseOfErrno();
  return file;
}

// ---- the library ----

// A path of the descriptor that this process has not used for another file: the dynamic linker reuses a library that is
// open under the same name, whatever file the name refers to now.
std::string freshNameOf(int fd) {
  static std::atomic<uint64_t> loads = 0; // for the whole process, as names of the dynamic linker
  const std::string self = std::to_string(::getpid());
  // If /proc shows another PID name space, the number would belong to another process there.
  std::array<char, 32> shown{};
  const ssize_t length = ::readlink("/proc/self", shown.data(), shown.size());
  const bool isSelf = length > 0 && self == std::string_view(shown.data(), static_cast<size_t>(length));
  std::string name = isSelf ? "/proc/" + self + "/fd" : "/proc/self/fd";
  for (uint64_t load = loads++; load != 0; load >>= 1) name += (load & 1) != 0 ? "/." : "/";
  return name + "/" + std::to_string(fd);
}

std::string lastReason() {
  const char* reason = dlerror();
  return reason != nullptr ? reason : "unknown reason";
}

} // namespace

SoEngine::SoEngine(void* library, const rung_program* program, std::string path, File file)
    : library_(library), program_(program), path_(std::move(path)), file_(std::move(file)), descriptor_(file_.fd()) {}

// Keeps the library loaded, and its descriptor open, until the process ends.
void SoEngine::keepWithProcess(const std::string& name) {
  dlopen(name.c_str(), RTLD_NOW | RTLD_NOLOAD | RTLD_NODELETE);
  file_.release();
}

SoEngine::~SoEngine() { dlclose(library_); }

std::optional<size_t> SoEngine::readFile(uint64_t first, std::span<char> to) const {
  size_t done = 0;
  while (done < to.size()) {
    const ssize_t got = ::pread(descriptor_, to.data() + done, to.size() - done, static_cast<off_t>(first + done));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return std::nullopt;
    if (got == 0) break;
    done += static_cast<size_t>(got);
  }
  return done;
}

std::unique_ptr<SoEngine> SoEngine::open(const std::string& path, std::string& error, const SoOptions& options) {
  std::string problem;
  File file = openTrusted(path, options, problem);
  if (problem.empty()) return load(path, std::move(file), error, options.loaded);
  error = "cannot load " + path + ": " + problem;
  return nullptr;
}

std::unique_ptr<SoEngine> SoEngine::openMemory(int file, const std::string& name, std::string& error) {
  std::string problem;
  File own = openSealed(file, problem);
  if (problem.empty()) return load(name, std::move(own), error, Loaded::WithEngine);
  error = "cannot load " + name + ": " + problem;
  return nullptr;
}

std::unique_ptr<SoEngine> SoEngine::load(const std::string& path, File file, std::string& error, Loaded loaded) {
  const std::string name = freshNameOf(file.fd());
  void* library = dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    error = "cannot load " + path + ": " + lastReason();
    return nullptr;
  }
  const auto* program = static_cast<const rung_program*>(dlsym(library, RUNG_PROGRAM_SYMBOL));
  error.clear();
  if (program == nullptr) {
    error = path + " is not a compiled PLC program: it has no symbol " RUNG_PROGRAM_SYMBOL;
  } else {
    const MappedFile mapped(library);
    if (const std::string wrong = checkProgram(*program, &mapped); !wrong.empty())
      error = path + " cannot be run: " + wrong + "; compile it again";
  }
  if (!error.empty()) {
    dlclose(library);
    return nullptr;
  }
  std::unique_ptr<SoEngine> engine(new SoEngine(library, program, path, std::move(file)));
  if (loaded == Loaded::WithProcess) engine->keepWithProcess(name);
  return engine;
}

} // namespace rung::runtime
