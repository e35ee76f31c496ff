// The seal of a program file: a SHA-256 digest of everything before it, and optionally an Ed25519 signature of the
// digest. It follows the image, where neither the dynamic linker nor a debugger reads. The digest detects damage and
// nothing else, because anyone who changes a file can seal it again. The origin of a file follows only from a signature
// or from its owner.
//
// Offsets from the start of the seal; numbers are little-endian:
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

// A file, divided into its image and its seal.
struct SealedFile {
  std::string_view image;
  std::optional<Seal> seal;
  std::string damage; // why the seal is invalid; empty if it is valid or missing
};

// Reads the seal and checks the digest. Signatures need a key and are checked by isSignedBy.
SealedFile readSealed(std::string_view file);

// The message that is signed: the digest after a prefix that no message signed for another purpose has.
std::string signedMessage(const Digest& digest);
bool isSignedBy(const Seal& seal, const PublicKey& key);

// Parses the line of a key file: the word, then exactly these bytes in hexadecimal digits. False: it has another form.
bool parseKeyLine(std::string_view text, std::string_view word, std::span<uint8_t> bytes);

// Parses the line of a file NAME.pub, "rung-public-key-1 HEX". Nothing if it has another form.
std::optional<PublicKey> parsePublicKey(std::string_view text);
std::string textOf(const PublicKey& key);
std::string textOf(const KeyId& id);

Digest digestOf(std::string_view bytes);
// The bytes of a seal as stored in a file.
std::string bytesOf(const Seal& seal);

// An Ed25519 key that signs; the destructor wipes its bytes. It and the functions after it are for tools that build
// program files.
class SecretKey {
public:
  static SecretKey make();
  // Parses the line of a key file, "rung-secret-key-1 HEX". Nothing if it has another form.
  static std::optional<SecretKey> parse(std::string_view text);
  ~SecretKey();
  SecretKey(const SecretKey&) = default;
  SecretKey& operator=(const SecretKey&) = default;

  std::string text() const;
  PublicKey publicKey() const;
  Signature sign(const Digest& digest) const;

private:
  SecretKey() = default;
  std::array<uint8_t, 64> bytes_{}; // as libsodium stores it: seed and public key
};

// Permissions of a program file: only its owner may write it (see trust.h).
inline constexpr unsigned kProgramMode = 0755;

// The file with a new seal, which replaces a seal that it may have.
std::string sealed(std::string_view file, const SecretKey* key = nullptr);

// Writes a sealed program file, atomically and so that it survives a power failure. Returns "", or the reason of a
// failure.
std::string writeProgram(const std::string& path, std::string_view file);

} // namespace rung::runtime
