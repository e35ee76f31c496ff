// Seals as bytes, and their verification with libsodium.
#include "rtlib/load/seal.h"

#include <sodium.h>

#include <algorithm>
#include <cstring>

#include "rtlib/load/file.h"

namespace rung::runtime {

namespace {

constexpr std::string_view kMagic = "RungSeal";
constexpr std::string_view kPublicWord = "rung-public-key-1 ";
constexpr size_t kSigned = 32;
constexpr size_t kKey = 36;
constexpr size_t kSignature = 52;
constexpr size_t kCheck = 116;
constexpr size_t kVersion = 124;
constexpr size_t kMagicAt = 128;
constexpr size_t kCheckSize = kVersion - kCheck;

const uint8_t* bytesIn(std::string_view text) { return reinterpret_cast<const uint8_t*>(text.data()); }

uint32_t numberAt(std::string_view text, size_t at) {
  uint32_t number = 0;
  for (size_t i = 4; i-- > 0;) number = number << 8 | bytesIn(text)[at + i];
  return number;
}

void put(std::string& text, uint32_t number) {
  for (int i = 0; i < 4; ++i) text += static_cast<char>(number >> 8 * i & 0xFF);
}

template <size_t N>
void put(std::string& text, const std::array<uint8_t, N>& bytes) {
  text.append(reinterpret_cast<const char*>(bytes.data()), N);
}

template <size_t N>
void take(std::string_view text, size_t at, std::array<uint8_t, N>& bytes) {
  std::memcpy(bytes.data(), text.data() + at, N);
}

std::string_view firstBytes(const Digest& digest, size_t count) {
  return {reinterpret_cast<const char*>(digest.data()), count};
}

template <size_t N>
std::string hexOf(const std::array<uint8_t, N>& bytes) {
  std::array<char, 2 * N + 1> text{};
  return sodium_bin2hex(text.data(), text.size(), bytes.data(), N);
}

bool allZero(std::string_view bytes) {
  return std::all_of(bytes.begin(), bytes.end(), [](char c) { return c == 0; });
}

// Why the bytes of a seal are not valid, whatever the file.
std::string wrongBytes(std::string_view seal) {
  if (const uint32_t version = numberAt(seal, kVersion); version != kSealVersion)
    return "its seal has version " + std::to_string(version) + ", and only version " + std::to_string(kSealVersion) +
           " is known here";
  const bool checks = seal.substr(kCheck, kCheckSize) == firstBytes(digestOf(seal.substr(0, kCheck)), kCheckSize);
  const uint32_t hasSignature = numberAt(seal, kSigned);
  const bool fits = hasSignature == 1 || (hasSignature == 0 && allZero(seal.substr(kKey, kCheck - kKey)));
  return checks && fits ? "" : "its seal is damaged";
}

} // namespace

Digest digestOf(std::string_view bytes) {
  Digest digest{};
  crypto_hash_sha256(digest.data(), bytesIn(bytes), bytes.size());
  return digest;
}

KeyId PublicKey::id() const {
  const Digest digest = digestOf({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  KeyId id{};
  std::copy_n(digest.begin(), id.size(), id.begin());
  return id;
}

SealedFile readSealed(std::string_view file) {
  if (file.size() < kSealSize || !file.ends_with(kMagic)) return {.image = file, .seal = {}, .damage = {}};
  const std::string_view bytes = file.substr(file.size() - kSealSize);
  SealedFile found{.image = file.substr(0, file.size() - kSealSize), .seal = Seal{}, .damage = wrongBytes(bytes)};
  if (!found.damage.empty()) return found;
  take(bytes, 0, found.seal->digest);
  if (numberAt(bytes, kSigned) == 1) {
    Signature& signature = found.seal->signature.emplace();
    take(bytes, kKey, signature.key);
    take(bytes, kSignature, signature.bytes);
  }
  if (digestOf(found.image) != found.seal->digest) found.damage = "its content is not what was sealed";
  return found;
}

std::string bytesOf(const Seal& seal) {
  std::string bytes;
  put(bytes, seal.digest);
  put(bytes, seal.signature ? 1 : 0);
  const Signature signature = seal.signature.value_or(Signature{});
  put(bytes, signature.key);
  put(bytes, signature.bytes);
  bytes += firstBytes(digestOf(bytes), kCheckSize);
  put(bytes, kSealVersion);
  static_assert(kMagicAt + kMagic.size() == kSealSize);
  return bytes += kMagic;
}

std::string signedMessage(const Digest& digest) {
  std::string message = "rung seal 1\n";
  put(message, digest);
  return message;
}

bool isSignedBy(const Seal& seal, const PublicKey& key) {
  if (!seal.signature || seal.signature->key != key.id()) return false;
  const std::string message = signedMessage(seal.digest);
  return crypto_sign_verify_detached(seal.signature->bytes.data(), bytesIn(message), message.size(),
                                     key.bytes.data()) == 0;
}

bool parseKeyLine(std::string_view text, std::string_view word, std::span<uint8_t> bytes) {
  if (!text.starts_with(word)) return false;
  text.remove_prefix(word.size());
  if (text.ends_with('\n')) text.remove_suffix(1);
  size_t length = 0;
  return text.size() == 2 * bytes.size() &&
         sodium_hex2bin(bytes.data(), bytes.size(), text.data(), text.size(), nullptr, &length, nullptr) == 0 &&
         length == bytes.size();
}

std::optional<PublicKey> parsePublicKey(std::string_view text) {
  PublicKey key;
  return parseKeyLine(text, kPublicWord, key.bytes) ? std::optional(key) : std::nullopt;
}

std::string textOf(const PublicKey& key) { return std::string(kPublicWord) + hexOf(key.bytes) + "\n"; }
std::string textOf(const KeyId& id) { return hexOf(id); }

// Making seals and keys with libsodium.

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
