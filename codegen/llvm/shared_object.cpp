// Links an object file to a shared object in the process (see llvm_emitter.h).
#include <cerrno>
#include <cstring>
#include <mutex>
#include <sys/mman.h>
#include <unistd.h>

#include <fmt/format.h>
#include <lld/Common/Driver.h>
#include <llvm/Support/raw_ostream.h>
#include <llvm/TargetParser/Host.h>
#include <llvm/TargetParser/Triple.h>

#include "codegen/llvm/llvm_emitter.h"
#include "ir/support/temporary_folder.h"

LLD_HAS_DRIVER(elf)

namespace rung::codegen {
namespace {

// Bytes under a name that the linker can open, never on a disk.
class MemoryFile {
public:
  explicit MemoryFile(std::string_view bytes) : file_(memfd_create("rung-object", MFD_CLOEXEC)) {
    while (file_ >= 0 && !bytes.empty()) {
      const ssize_t done = write(file_, bytes.data(), bytes.size());
      if (done < 0 && errno == EINTR) continue;
      if (done < 0) {
        close(file_);
        file_ = -1;
        return;
      }
      bytes.remove_prefix(static_cast<size_t>(done));
    }
  }
  ~MemoryFile() {
    if (file_ >= 0) close(file_);
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  bool ok() const { return file_ >= 0; }
  std::string path() const { return fmt::format("/proc/self/fd/{}", file_); }

private:
  int file_;
};

Result<void> runLinker(const std::vector<std::string>& inputs, const std::string& out) {
  std::vector<const char*> args{"ld.lld", "-shared", "--hash-style=gnu", "--build-id=sha1",
                                "-zdefs", "-znow",   "-zrelro",          "--threads=1"}; // for one small object
  for (const std::string& input : inputs) args.push_back(input.c_str());
  args.insert(args.end(), {"-o", out.c_str()});
  std::string text;
  llvm::raw_string_ostream report(text);
  // The linker keeps its state in globals.
  static std::mutex one;
  static bool usable = true;
  const std::lock_guard lock(one);
  if (!usable) return failure("the linker failed before and cannot run again in this process");
  const lld::Result result = lld::lldMain(args, llvm::nulls(), report, {{lld::Gnu, &lld::elf::link}});
  usable = result.canRunAgain;
  if (result.retCode != 0) return failure(fmt::format("the linker failed: {}", text));
  return {};
}

// The bytes written to standard output.
Result<std::string> contentsOfOutput() {
  std::string bytes(1 << 16, '\0');
  std::string all;
  ssize_t got = 0;
  while ((got = pread(STDOUT_FILENO, bytes.data(), bytes.size(), static_cast<off_t>(all.size()))) != 0) {
    if (got > 0) all.append(bytes, 0, static_cast<size_t>(got));
    if (got < 0 && errno != EINTR) return failure(fmt::format("cannot read standard output: {}", std::strerror(errno)));
  }
  return all;
}

// The result of linking `inputs`.
Result<std::string> linkedByOutput(const std::vector<std::string>& inputs) {
  if (ftruncate(STDOUT_FILENO, 0) != 0 || lseek(STDOUT_FILENO, 0, SEEK_SET) != 0)
    return failure(fmt::format("cannot write standard output: {}", std::strerror(errno)));
  const Result<void> done = runLinker(inputs, "-");
  return done.ok() ? contentsOfOutput() : done.failure();
}

Result<std::string> linkedByFile(const std::vector<std::string>& inputs) {
  const TemporaryFolder folder; // the linker can only write to files
  if (!folder.ok()) return failure(fmt::format("cannot make a temporary folder: {}", std::strerror(errno)));
  const Result<void> done = runLinker(inputs, (folder / "program.so").string());
  if (!done.ok()) return done.failure();
  std::optional<std::string> image = folder.contentsOf("program.so");
  if (!image) return failure("the linker made no shared object");
  return std::move(*image);
}

using Linker = Result<std::string>(const std::vector<std::string>& inputs);

// A stub of libgcc_s.so.1 for the linker, which every 32-bit ARM system has: functions that the processor lacks, 64-bit
// division and conversions.
Result<std::string> libraryOfArm(Linker& linked, const MemoryFile& nothing) {
  std::vector<std::string> inputs{"-marmelf_linux_eabi", "--soname=libgcc_s.so.1"};
  for (const char* name : {"ldivmod", "uldivmod", "idivmod", "uidivmod", "idiv", "uidiv", "lmul", "llsl", "llsr",
                           "lasr", "l2d", "ul2d", "d2lz", "d2ulz"})
    inputs.push_back(fmt::format("--defsym=__aeabi_{}=0", name));
  inputs.insert(inputs.end(), {"--format=binary", nothing.path()});
  return linked(inputs);
}

Result<std::string> build(const ir::Layout& layout, uint64_t codeHash, const LlvmOptions& options, Linker& linked) {
  Result<std::string> object = emitObject(layout, codeHash, options);
  if (!object.ok()) return object.failure();
  const std::string target = options.target.empty() ? llvm::sys::getProcessTriple() : options.target;
  std::string library;
  const MemoryFile file(object.value()), nothing("");
  if (llvm::Triple(target).isARM() && file.ok() && nothing.ok()) {
    Result<std::string> made = libraryOfArm(linked, nothing);
    if (!made.ok()) return made.failure();
    library = std::move(made).value();
  }
  const MemoryFile libraryFile(library);
  if (!file.ok() || !nothing.ok() || !libraryFile.ok())
    return failure(fmt::format("cannot hold the object file in memory: {}", std::strerror(errno)));
  std::vector<std::string> inputs{file.path()};
  if (!library.empty()) inputs.push_back(libraryFile.path());
  return linked(inputs);
}

} // namespace

Result<std::string> buildLlvmSharedObjectByOutput(const ir::Layout& layout, uint64_t codeHash,
                                                  const LlvmOptions& options) {
  return build(layout, codeHash, options, linkedByOutput);
}

Result<std::string> buildLlvmSharedObject(const ir::Layout& layout, uint64_t codeHash, const LlvmOptions& options) {
  return build(layout, codeHash, options, linkedByFile);
}

} // namespace rung::codegen
