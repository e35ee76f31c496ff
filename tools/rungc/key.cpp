// rungc key: keys to sign programs with.
#include <cstdio>
#include <fmt/format.h>
#include <memory>

#include "rtlib/host/file.h"
#include "rtlib/host/sealing.h"
#include "rtlib/host/trust.h"
#include "tools/rungc/commands.h"

namespace rung::rungc {
namespace {

constexpr unsigned kSecretMode = 0600;
constexpr unsigned kPublicMode = 0644;

// A key is never written over another.
int newKey(const std::string& path) {
  const host::SecretKey key = host::SecretKey::make();
  const std::string publicPath = path + ".pub";
  std::string wrong = host::replaceFile(publicPath, host::textOf(key.publicKey()),
                                        {.mode = kPublicMode, .mayReplace = false, .lasts = true});
  if (!wrong.empty()) return environmentError(wrong);
  wrong = host::replaceFile(path, key.text(), {.mode = kSecretMode, .mayReplace = false, .lasts = true});
  if (!wrong.empty()) {
    std::remove(publicPath.c_str());
    return environmentError(wrong);
  }
  fmt::print("key {}: sign with {}, and keep it secret; install {} in {} on the machines\n",
             host::textOf(key.publicKey().id()), path, publicPath, host::kKeysFolder);
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
