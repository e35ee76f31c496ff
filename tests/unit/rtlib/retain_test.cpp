// The retained image on disk: generations, every kind of damage, and the saving thread.
#include "rtlib/host/retain.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <thread>

#include "tests/unit/rtlib/test_program.h"

namespace {

using namespace rung::host;
using rung::test::TestProgram;
using testing::HasSubstr;
namespace fs = std::filesystem;

using Bytes = std::vector<uint8_t>;
constexpr uint64_t kLayout = 0x1122334455667788;

class RetainTest : public testing::Test {
protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "rung_retain_XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder = pattern;
    base = (folder / "plc").string();
  }
  void TearDown() override { fs::remove_all(folder); }

  RetainStore store(uint64_t layout = kLayout, uint32_t size = 3) { return {base, layout, size}; }
  void save(RetainStore& to, const Bytes& bytes) {
    std::string error;
    ASSERT_TRUE(to.save(bytes, error)) << error;
  }
  // Three saves: generation 1 and 3 in .a, 2 in .b.
  void saveThree() {
    RetainStore s = store();
    for (uint8_t i = 1; i <= 3; ++i) save(s, {i, i, i});
  }
  void change(const char* ending, std::streamoff at, char value) {
    std::fstream file(base + ending, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(at);
    file.put(value);
    ASSERT_TRUE(file.good());
  }
  RetainImage load() { return store().load(); }

  fs::path folder;
  std::string base;
};

TEST_F(RetainTest, NothingThereIsAQuietColdStart) {
  const RetainImage image = load();
  EXPECT_FALSE(image.found);
  EXPECT_EQ(image.report, "");
}

TEST_F(RetainTest, NewestGenerationWins) {
  saveThree();
  const RetainImage image = load();
  EXPECT_TRUE(image.found);
  EXPECT_EQ(image.bytes, (Bytes{3, 3, 3}));
  EXPECT_EQ(image.generation, 3u);
  EXPECT_EQ(image.report, "");
  RetainStore next = store(); // a new process goes on counting
  save(next, {4, 4, 4});
  EXPECT_EQ(load().generation, 4u);
  EXPECT_EQ(load().bytes, (Bytes{4, 4, 4}));
}

// Any changed byte of the newest file makes the older one count.
TEST_F(RetainTest, EveryDamagedByteIsNoticed) {
  saveThree();
  const auto size = static_cast<std::streamoff>(fs::file_size(base + ".a"));
  ASSERT_EQ(size, 35);
  for (std::streamoff at = 0; at < size; ++at) {
    SCOPED_TRACE(at);
    std::ifstream in(base + ".a", std::ios::binary);
    in.seekg(at);
    const char good = static_cast<char>(in.get());
    change(".a", at, static_cast<char>(good ^ 0x10));
    const RetainImage image = load();
    EXPECT_TRUE(image.found);
    EXPECT_EQ(image.bytes, (Bytes{2, 2, 2}));
    EXPECT_THAT(image.report, HasSubstr("plc.a"));
    EXPECT_THAT(image.report, HasSubstr("generation 2"));
    change(".a", at, good);
  }
  EXPECT_EQ(load().bytes, (Bytes{3, 3, 3}));
}

TEST_F(RetainTest, TruncatedAtAnyLengthIsNoticed) {
  saveThree();
  for (uintmax_t size = 35; size-- > 0;) {
    SCOPED_TRACE(size);
    fs::resize_file(base + ".a", size);
    EXPECT_EQ(load().bytes, (Bytes{2, 2, 2}));
  }
}

TEST_F(RetainTest, BothDamagedIsAReportedColdStart) {
  saveThree();
  change(".a", 34, 77);
  change(".b", 20, 77);
  const RetainImage image = load();
  EXPECT_FALSE(image.found);
  EXPECT_THAT(image.report, HasSubstr("plc.a: wrong checksum"));
  EXPECT_THAT(image.report, HasSubstr("plc.b: wrong checksum"));
  EXPECT_THAT(image.report, HasSubstr("starting cold"));
}

TEST_F(RetainTest, SavingOverwritesTheDamagedFile) {
  saveThree();
  change(".a", 34, 77);
  RetainStore s = store();
  EXPECT_EQ(s.load().bytes, (Bytes{2, 2, 2}));
  save(s, {9, 9, 9});
  EXPECT_EQ(load().bytes, (Bytes{9, 9, 9}));
  EXPECT_EQ(load().report, "");
  change(".a", 34, 77); // the good one was not touched
  EXPECT_EQ(load().bytes, (Bytes{2, 2, 2}));
}

TEST_F(RetainTest, SavingWithoutLoadingKeepsTheOrder) {
  saveThree();
  RetainStore s = store();
  save(s, {8, 8, 8});
  EXPECT_EQ(load().bytes, (Bytes{8, 8, 8}));
  EXPECT_EQ(load().generation, 4u);
}

TEST_F(RetainTest, LeftoverOfACrashIsIgnored) {
  saveThree();
  std::ofstream(base + ".b.tmp") << "half a fi";
  EXPECT_EQ(load().bytes, (Bytes{3, 3, 3}));
  EXPECT_EQ(load().report, "");
}

TEST_F(RetainTest, AnotherLayoutOrSizeIsNotTaken) {
  saveThree();
  const RetainImage other = store(kLayout + 1).load();
  EXPECT_FALSE(other.found);
  EXPECT_THAT(other.report, HasSubstr("another memory layout"));
  EXPECT_FALSE(store(kLayout, 4).load().found);
  // After the other program saved, the old image is out of date.
  RetainStore s = store(kLayout + 1);
  save(s, {5, 5, 5});
  EXPECT_FALSE(load().found);
  EXPECT_TRUE(store(kLayout + 1).load().found);
}

TEST_F(RetainTest, ErrorsAreReported) {
  std::string error;
  RetainStore s = store();
  EXPECT_FALSE(s.save(Bytes{1}, error));
  EXPECT_THAT(error, HasSubstr("wrong size"));
  RetainStore nowhere((folder / "none" / "plc").string(), kLayout, 3);
  EXPECT_FALSE(nowhere.save(Bytes{1, 2, 3}, error));
  EXPECT_THAT(error, HasSubstr("No such file"));
}

TEST_F(RetainTest, SaverWritesWhatWasOffered) {
  TestProgram test;
  test.addPacked("R", 1, 8, 0);
  test.retains = {{1, 3}};
  test.link();
  Instance instance(test.program);
  {
    RetainSaver saver(store(), RetainMap(test.program), std::chrono::milliseconds(1));
    for (uint32_t i = 1; i <= 5; ++i) {
      EXPECT_EQ(instance.write(intRef(0, 1, 8), i), "");
      while (!saver.offer(instance)) std::this_thread::yield();
    }
    EXPECT_EQ(saver.failed(), 0u);
  } // writes the last one
  EXPECT_EQ(load().bytes, (Bytes{5, 0, 0}));
  EXPECT_EQ(load().generation, 5u);
}

TEST_F(RetainTest, SaverCountsFailures) {
  TestProgram test;
  test.addPacked("R", 1, 8, 0);
  test.retains = {{1, 3}};
  test.link();
  Instance instance(test.program);
  RetainSaver saver(RetainStore((folder / "none" / "plc").string(), kLayout, 3), RetainMap(test.program),
                    std::chrono::milliseconds(1));
  EXPECT_TRUE(saver.offer(instance));
  for (int i = 0; i < 5000 && saver.failed() == 0; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_EQ(saver.failed(), 1u);
  EXPECT_THAT(saver.lastError(), HasSubstr("No such file"));
}

} // namespace
