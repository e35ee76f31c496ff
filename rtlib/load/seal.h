// The seal of a program file: a SHA-256 digest of all that lies before it, and optionally an Ed25519 signature of the
// digest. It follows the image, where neither the dynamic linker nor a debugger looks. The digest shows damage, and
// nothing else: everyone who changes a file can seal it again. Its origin is shown only by a signature and by its
// owner.
//
// From the start of the seal, numbers with the low byte first:
//    0  digest of the image, SHA-256            32 bytes
//   32  1: signed, 0: the next two are zero      4
//   36  identity of the signer's public key     16
//   52  signature, Ed25519                      64
//  116  check: of the SHA-256 of bytes 0 to 115, the first                8
//  124  version of this format                   4
//  128  "RungSeal"                               8   the last bytes of the file
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace rung::runtime {

inline constexpr size_t kSealSize = 136;
inline constexpr uint32_t kSealVersion = 1;

using Digest = std::array<uint8_t, 32>;
using KeyId = std::array<uint8_t, 16>; // the first bytes of the key's SHA-256

struct PublicKey {
  std::array<uint8_t, 32> bytes{};
  KeyId id() const;
};

struct Signature {
  KeyId key{};
  std::array<uint8_t, 64> bytes{};
};

struct Seal {
  Digest digest{};
  std::optional<Signature> signature;
};

// A file cut where its seal begins.
struct SealedFile {
  std::string_view image;
  std::optional<Seal> seal;
  std::string damage; // why the seal does not hold; empty when it does, and when there is none
};

// Checks the digest; signatures are checked with a key only (isSignedBy).
SealedFile readSealed(std::string_view file);

// What is signed: the digest, in words that no signature for another purpose begins with.
std::string signedMessage(const Digest& digest);
bool isSignedBy(const Seal& seal, const PublicKey& key);

// The one line of a key file: the word, then exactly these bytes in hexadecimal digits. False: it is something else.
bool parseKeyLine(std::string_view text, std::string_view word, std::span<uint8_t> bytes);

// The one line of a file NAME.pub: "rung-public-key-1 HEX". Nothing when it is something else.
std::optional<PublicKey> parsePublicKey(std::string_view text);
std::string textOf(const PublicKey& key);
std::string textOf(const KeyId& id);

Digest digestOf(std::string_view bytes);
// A seal as the bytes that it has in a file.
std::string bytesOf(const Seal& seal);

// Makes seals and keys: for what builds program files. A host that loads them needs seal.h alone.

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
