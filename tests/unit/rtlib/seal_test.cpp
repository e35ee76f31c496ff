// Seals and signatures: what holds, and that every change shows.
#include "rtlib/load/seal.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

using namespace rung::runtime;
using testing::HasSubstr;

const std::string kImage = "an image of some bytes";

SecretKey keyOf(char digit) { return SecretKey::parse("rung-secret-key-1 " + std::string(64, digit)).value(); }

bool isIntact(std::string_view file) {
  const SealedFile found = readSealed(file);
  return found.seal && found.damage.empty();
}

TEST(Seal, HoldsWhatWasSealed) {
  const std::string file = sealed(kImage);
  EXPECT_EQ(file.size(), kImage.size() + kSealSize);
  const SealedFile found = readSealed(file);
  EXPECT_EQ(found.image, kImage);
  EXPECT_EQ(found.damage, "");
  ASSERT_TRUE(found.seal);
  EXPECT_EQ(found.seal->digest, digestOf(kImage));
  EXPECT_FALSE(found.seal->signature);
}

// Files of former versions must stay readable.
TEST(Seal, HasTheFormatOfItsVersion) {
  const std::string file = sealed("abc");
  EXPECT_EQ(file.substr(3, 4), "\xba\x78\x16\xbf"); // FIPS 180-2, B.1
  EXPECT_EQ(file.substr(35, 84), std::string(84, '\0'));
  EXPECT_EQ(file.substr(file.size() - 12), std::string("\1\0\0\0RungSeal", 12));
}

TEST(Seal, IsReplacedByANewOne) {
  const SecretKey key = keyOf('1');
  const std::string twice = sealed(sealed(kImage, &key));
  EXPECT_EQ(twice, sealed(kImage));
}

TEST(Seal, IsMissingInShortAndOtherFiles) {
  for (const std::string& file : {std::string(), kImage, std::string("RungSeal"), std::string(kSealSize, 'x')}) {
    EXPECT_FALSE(readSealed(file).seal);
    EXPECT_EQ(readSealed(file).image, file);
    EXPECT_EQ(readSealed(file).damage, "");
  }
}

TEST(Seal, ShowsEveryChangeOfABitAndEveryLoss) {
  const SecretKey key = keyOf('1');
  for (const std::string& file : {sealed(kImage), sealed(kImage, &key)}) {
    ASSERT_TRUE(isIntact(file));
    for (size_t at = 0; at < file.size(); ++at) {
      for (int bit = 0; bit < 8; ++bit) {
        std::string changed = file;
        changed[at] = static_cast<char>(changed[at] ^ 1 << bit);
        EXPECT_FALSE(isIntact(changed)) << "bit " << bit << " of byte " << at;
      }
      EXPECT_FALSE(isIntact(std::string_view(file).substr(0, at))) << "cut after " << at;
      EXPECT_FALSE(isIntact(file.substr(0, at) + "x" + file.substr(at))) << "one more at " << at;
      EXPECT_FALSE(isIntact(file.substr(0, at) + file.substr(at + 1))) << "one less at " << at;
    }
    EXPECT_FALSE(isIntact(file + '\0'));
  }
}

TEST(Seal, SaysWhatIsWrong) {
  std::string file = sealed(kImage);
  file[0] ^= 1;
  EXPECT_EQ(readSealed(file).damage, "its content is not what was sealed");
  file = sealed(kImage);
  file[kImage.size()] ^= 1;
  EXPECT_EQ(readSealed(file).damage, "its seal is damaged");
  file = sealed(kImage);
  file[file.size() - 12] = 2;
  EXPECT_THAT(readSealed(file).damage, HasSubstr("version 2, and only version 1 is known"));
}

TEST(Signature, IsOfOneKeyAndOneDigest) {
  const SecretKey key = keyOf('1');
  const SecretKey other = keyOf('2');
  Seal seal = *readSealed(sealed(kImage, &key)).seal;
  ASSERT_TRUE(seal.signature);
  EXPECT_EQ(seal.signature->key, key.publicKey().id());
  EXPECT_TRUE(isSignedBy(seal, key.publicKey()));
  EXPECT_FALSE(isSignedBy(seal, other.publicKey()));
  // Another's signature under this key's name; this key's signature of something else.
  Seal forged = seal;
  forged.signature->bytes = other.sign(seal.digest).bytes;
  EXPECT_FALSE(isSignedBy(forged, key.publicKey()));
  seal.digest[0] ^= 1;
  EXPECT_FALSE(isSignedBy(seal, key.publicKey()));
  EXPECT_FALSE(isSignedBy(*readSealed(sealed(kImage)).seal, key.publicKey()));
}

TEST(Signature, IsNotOfTheBareDigest) {
  const Digest digest = digestOf(kImage);
  EXPECT_EQ(signedMessage(digest).substr(0, 12), "rung seal 1\n");
  EXPECT_EQ(signedMessage(digest).size(), 12 + digest.size());
}

TEST(Keys, AreLinesOfText) {
  const SecretKey key = SecretKey::make();
  EXPECT_NE(key.text(), SecretKey::make().text());
  const auto again = SecretKey::parse(key.text());
  ASSERT_TRUE(again);
  EXPECT_EQ(again->publicKey().bytes, key.publicKey().bytes);
  EXPECT_EQ(again->text(), key.text());
  const auto known = parsePublicKey(textOf(key.publicKey()));
  ASSERT_TRUE(known);
  EXPECT_EQ(known->bytes, key.publicKey().bytes);
  EXPECT_EQ(textOf(known->id()).size(), 32u);
}

TEST(Keys, OfAnotherFormAreNone) {
  const SecretKey key = keyOf('3');
  for (std::string text : {key.text(), textOf(key.publicKey())}) {
    const auto isKey = [](const std::string& t) { return SecretKey::parse(t) || parsePublicKey(t); };
    EXPECT_TRUE(isKey(text));
    EXPECT_FALSE(isKey(""));
    EXPECT_FALSE(isKey(text + "x"));
    EXPECT_FALSE(isKey(" " + text));
    EXPECT_FALSE(isKey(text.substr(0, text.size() - 2)));
    text[40] = 'g';
    EXPECT_FALSE(isKey(text));
  }
  EXPECT_FALSE(parsePublicKey(key.text()));
  EXPECT_FALSE(SecretKey::parse(textOf(key.publicKey())));
}

} // namespace
