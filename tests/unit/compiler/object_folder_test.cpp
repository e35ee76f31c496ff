// Shared objects that are kept in a folder: when one is built, and when it is taken from there.
#include "compiler/object_folder.h"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>

#include "ir/support/temporary_folder.h"
#include "rtlib/load/seal.h"

namespace rung::compiler {
namespace {

class ObjectFolder : public testing::Test {
protected:
  // The image that comes for an identity.
  std::string image(std::string_view identity, const std::string& folder) {
    const Result<std::string> file = sealedObject(folder, identity, [&]() -> Result<std::string> {
      ++built_;
      return "the object of " + std::string(identity);
    });
    return file.ok() ? std::string(runtime::readSealed(file.value()).image) : file.error();
  }
  std::string kept() const { return (scratch_ / "code").string(); }
  std::filesystem::path onlyFile() const { return std::filesystem::directory_iterator(kept())->path(); }

  TemporaryFolder scratch_;
  int built_ = 0;
};

TEST_F(ObjectFolder, BuildsAnObjectOnce) {
  EXPECT_EQ(image("a", kept()), "the object of a");
  EXPECT_EQ(image("a", kept()), "the object of a");
  EXPECT_EQ(built_, 1);
  EXPECT_EQ(image("b", kept()), "the object of b");
  EXPECT_EQ(built_, 2);
}

TEST_F(ObjectFolder, BuildsADamagedOneAgain) {
  image("a", kept());
  std::fstream(onlyFile(), std::ios::in | std::ios::out | std::ios::binary).write("T", 1);
  EXPECT_EQ(image("a", kept()), "the object of a");
  EXPECT_EQ(built_, 2);
  std::filesystem::resize_file(onlyFile(), 3);
  EXPECT_EQ(image("a", kept()), "the object of a");
  EXPECT_EQ(built_, 3);
}

TEST_F(ObjectFolder, BuildsOneAgainThatOthersCouldHaveWritten) {
  image("a", kept());
  std::filesystem::permissions(onlyFile(), std::filesystem::perms::others_write, std::filesystem::perm_options::add);
  EXPECT_EQ(image("a", kept()), "the object of a");
  EXPECT_EQ(built_, 2);
}

TEST_F(ObjectFolder, DoesWithoutAFolderAndWithoutOneThatWorks) {
  std::ofstream(scratch_ / "file") << "no folder";
  for (const std::string& folder : {std::string(), (scratch_ / "file").string()}) {
    EXPECT_EQ(image("a", folder), "the object of a");
    EXPECT_EQ(image("a", folder), "the object of a");
  }
  EXPECT_EQ(built_, 4);
}

TEST_F(ObjectFolder, KeepsNothingOfWhatCannotBeBuilt) {
  const auto fails = []() -> Result<std::string> { return failure("no compiler"); };
  EXPECT_EQ(sealedObject(kept(), "a", fails).error(), "no compiler");
  EXPECT_EQ(image("a", kept()), "the object of a");
}

} // namespace
} // namespace rung::compiler
