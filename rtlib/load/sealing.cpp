// Seals and keys, by libsodium (see sealing.h).
#include "rtlib/load/sealing.h"

#include <algorithm>
#include <sodium.h>

#include "rtlib/load/file.h"

namespace rung::runtime {
namespace {

constexpr std::string_view kSecretWord = "rung-secret-key-1 ";
constexpr size_t kSeedSize = crypto_sign_SEEDBYTES;

} // namespace

SecretKey SecretKey::make() {
  SecretKey key;
  PublicKey ignored;
  crypto_sign_keypair(ignored.bytes.data(), key.bytes_.data());
  return key;
}

std::optional<SecretKey> SecretKey::parse(std::string_view text) {
  std::array<uint8_t, kSeedSize> seed{};
  if (!parseKeyLine(text, kSecretWord, seed)) return std::nullopt;
  SecretKey key;
  PublicKey ignored;
  crypto_sign_seed_keypair(ignored.bytes.data(), key.bytes_.data(), seed.data());
  sodium_memzero(seed.data(), seed.size());
  return key;
}

SecretKey::~SecretKey() { sodium_memzero(bytes_.data(), bytes_.size()); }

std::string SecretKey::text() const {
  std::array<char, 2 * kSeedSize + 1> hex{};
  return std::string(kSecretWord) + sodium_bin2hex(hex.data(), hex.size(), bytes_.data(), kSeedSize) + "\n";
}

PublicKey SecretKey::publicKey() const {
  PublicKey key;
  std::copy_n(bytes_.begin() + kSeedSize, key.bytes.size(), key.bytes.begin());
  return key;
}

Signature SecretKey::sign(const Digest& digest) const {
  Signature signature{.key = publicKey().id(), .bytes = {}};
  const std::string message = signedMessage(digest);
  crypto_sign_detached(signature.bytes.data(), nullptr, reinterpret_cast<const uint8_t*>(message.data()),
                       message.size(), bytes_.data());
  return signature;
}

std::string sealed(std::string_view file, const SecretKey* key) {
  const std::string_view image = readSealed(file).image;
  Seal seal{.digest = digestOf(image), .signature = {}};
  if (key != nullptr) seal.signature = key->sign(seal.digest);
  return std::string(image) + bytesOf(seal);
}

std::string writeProgram(const std::string& path, std::string_view file) {
  return replaceFile(path, file, {.mode = kProgramMode, .lasts = true});
}

} // namespace rung::runtime
