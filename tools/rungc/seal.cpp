// rungc seal and key: seals program files, with a key also signs them; makes signing keys.
#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <optional>
#include <string_view>

#include "rtlib/load/elf_file.h"
#include "rtlib/load/file.h"
#include "rtlib/load/seal.h"
#include "rtlib/load/trust.h"
#include "rtlib/text/regular_file.h"
#include "rung/program.h"
#include "tools/rungc/commands.h"

namespace rung::rungc {
namespace {

constexpr size_t kMostBytes = size_t{1} << 30;

struct SealOptions {
  std::vector<std::string> files;
  std::string key;
  bool quiet = false;
};

Result<std::string> contentsOf(const runtime::File& file, const std::string& path, const std::string& problem) {
  std::string bytes;
  const std::string wrong = file.ok() ? runtime::readAll(file.fd(), kMostBytes, bytes) : problem;
  return wrong.empty() ? Result<std::string>(std::move(bytes))
                       : failure(fmt::format("cannot read {}: {}", path, wrong));
}

runtime::File opened(const std::string& path, std::string& problem) {
  return runtime::File(text::openRegular(path, problem));
}

Result<runtime::SecretKey> readKey(const std::string& path) {
  std::string problem;
  const runtime::File file = opened(path, problem);
  const Result<std::string> text = contentsOf(file, path, problem);
  if (!text.ok()) return text.failure();
  const auto facts = runtime::factsOf(file.fd());
  if (facts && (facts->mode & 077) != 0)
    return failure(
        fmt::format("{}: other users may read this secret key (mode {:04o}); chmod 600 {}", path, facts->mode, path));
  std::optional<runtime::SecretKey> key = runtime::SecretKey::parse(text.value());
  if (!key)
    return failure(
        fmt::format("{} is not a secret key; name the file without .pub that `rungc key new` has written", path));
  return *key;
}

// Why these bytes must not be sealed.
std::string wrongProgram(std::string_view bytes) {
  const runtime::SealedFile file = runtime::readSealed(bytes);
  if (!file.damage.empty()) return "its seal shows damage: " + file.damage + "; build it again";
  const runtime::ElfObject object = runtime::readElf(file.image);
  if (!object.problem.empty()) return object.problem + "; expected a shared object (.so)";
  if (std::ranges::find(object.exported, RUNG_PROGRAM_SYMBOL) == object.exported.end())
    return "it is not a compiled PLC program: it exports no symbol " RUNG_PROGRAM_SYMBOL;
  return {};
}

int sealFile(const std::string& path, const runtime::SecretKey* key, bool quiet) {
  std::string problem;
  const runtime::File file = opened(path, problem);
  const Result<std::string> bytes = contentsOf(file, path, problem);
  if (!bytes.ok()) return environmentError(bytes.error());
  if (const std::string wrong = wrongProgram(bytes.value()); !wrong.empty()) {
    fmt::print(stderr, "rungc: {}: {}\n", path, wrong);
    return kWrong;
  }
  const int status = writeProgram(path, runtime::sealed(bytes.value(), key));
  if (status != kOk || quiet) return status;
  fmt::print("sealed {}{}\n", path, key != nullptr ? ", signed by key " + runtime::textOf(key->publicKey().id()) : "");
  return kOk;
}

int sealFiles(const SealOptions& options) {
  std::optional<runtime::SecretKey> key;
  if (!options.key.empty()) {
    const Result<runtime::SecretKey> read = readKey(options.key);
    if (!read.ok()) return environmentError(read.error());
    key = read.value();
  }
  int status = kOk;
  for (const std::string& file : options.files)
    status = std::max(status, sealFile(file, key ? &*key : nullptr, options.quiet));
  return status;
}

} // namespace

int writeProgram(const std::string& out, const std::string& file) {
  const std::string wrong = runtime::writeProgram(out, file);
  return wrong.empty() ? kOk : environmentError(wrong);
}

void addSeal(CommandLine& app, int& status) {
  Command command = app.add("seal", "Seal programs made by another linker, or sign programs");
  auto options = std::make_shared<SealOptions>();
  command.option("FILE", options->files, "Compiled programs (.so); an existing seal is replaced").required();
  command.option("--sign", options->key, "Sign with this secret key (see rungc help key)");
  command.flag("-q,--quiet", options->quiet, "Print only errors");
  command.onRun([options, &status] { status = sealFiles(*options); });
}

// rungc key: makes keys to sign programs with.

namespace {

constexpr unsigned kSecretMode = 0600;
constexpr unsigned kPublicMode = 0644;

// Never overwrites a key.
int newKey(const std::string& path) {
  const runtime::SecretKey key = runtime::SecretKey::make();
  const std::string publicPath = path + ".pub";
  std::string wrong = runtime::replaceFile(publicPath, runtime::textOf(key.publicKey()),
                                           {.mode = kPublicMode, .mayReplace = false, .lasts = true});
  if (!wrong.empty()) return environmentError(wrong);
  wrong = runtime::replaceFile(path, key.text(), {.mode = kSecretMode, .mayReplace = false, .lasts = true});
  if (!wrong.empty()) {
    std::remove(publicPath.c_str());
    return environmentError(wrong);
  }
  fmt::print("key {}: sign with {}, and keep it secret; install {} in {} on the machines\n",
             runtime::textOf(key.publicKey().id()), path, publicPath, runtime::kKeysFolder);
  return kOk;
}

} // namespace

void addKey(CommandLine& app, int& status) {
  struct Options {
    std::string action;
    std::string file;
  };
  Command command = app.add("key", "Create a key for signing programs");
  auto options = std::make_shared<Options>();
  command.option("ACTION", options->action, "new: create a key").required().oneOf({"new"});
  command.option("FILE", options->file, "The file of the secret key; FILE.pub becomes the public key").required();
  command.onRun([options, &status] { status = newKey(options->file); });
}

} // namespace rung::rungc
