// Makes seals and keys: for what builds program files. A host that loads them needs seal.h alone.
#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "rtlib/load/seal.h"

namespace rung::runtime {

// An Ed25519 key that signs; its bytes are wiped when it goes.
class SecretKey {
public:
  static SecretKey make();
  // The one line of a key file: "rung-secret-key-1 HEX". Nothing when it is something else.
  static std::optional<SecretKey> parse(std::string_view text);
  ~SecretKey();
  SecretKey(const SecretKey&) = default;
  SecretKey& operator=(const SecretKey&) = default;

  std::string text() const;
  PublicKey publicKey() const;
  Signature sign(const Digest& digest) const;

private:
  SecretKey() = default;
  std::array<uint8_t, 64> bytes_{}; // libsodium's: the seed and the public key
};

// Of a program file: others than its owner must not be able to write to it (see trust.h).
inline constexpr unsigned kProgramMode = 0755;

// The file with a seal, in place of the one that it may have.
std::string sealed(std::string_view file, const SecretKey* key = nullptr);

// A sealed program for those who load it: whole or not at all, and there after a power failure. "" or why it is not.
std::string writeProgram(const std::string& path, std::string_view file);

} // namespace rung::runtime
