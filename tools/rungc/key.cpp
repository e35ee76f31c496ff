// rungc key: keys to sign programs with.
#include <cstdio>
#include <fmt/format.h>
#include <memory>

#include "rtlib/load/file.h"
#include "rtlib/load/seal.h"
#include "rtlib/load/trust.h"
#include "tools/rungc/commands.h"

namespace rung::rungc {
namespace {

constexpr unsigned kSecretMode = 0600;
constexpr unsigned kPublicMode = 0644;

// A key is never written over another.
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
