// Forces on their way: what comes back is what was sent, and nothing else is taken for forces.
#include "machine/compile/forced_code_maker.h"

#include <gmock/gmock.h>

namespace rung::compile {
namespace {

using testing::HasSubstr;

Forces example() {
  return {.codeHash = 0xFEDCBA9876543210,
          .layoutHash = 1,
          .bytes = {{0, 7, 0x81, 0x80}, {0, 8, 0xFF, 0}, {3, 0, 1, 1}},
          .program = "the file"};
}

std::string problemOf(const Forces& forces) {
  std::string problem;
  EXPECT_FALSE(unpackedForces(packed(forces), problem));
  return problem;
}

TEST(Forces, ComeBack) {
  const std::string bytes = packed(example());
  std::string problem;
  const std::optional<Forces> back = unpackedForces(bytes, problem);
  ASSERT_TRUE(back) << problem;
  EXPECT_EQ(back->codeHash, example().codeHash);
  EXPECT_EQ(back->layoutHash, example().layoutHash);
  EXPECT_EQ(back->program, "the file");
  EXPECT_EQ(packed(*back), bytes);
}

TEST(Forces, NotWithoutTheirEnd) {
  const std::string bytes = packed(example());
  std::string problem;
  for (size_t size = 0; size < bytes.size() - example().program.size(); ++size) {
    EXPECT_FALSE(unpackedForces(bytes.substr(0, size), problem)) << size;
    EXPECT_THAT(problem, HasSubstr("not forces, or not all of them")) << size;
  }
}

TEST(Forces, OnlyAsTheRuntimeHasThem) {
  Forces forces = example();
  forces.bytes = {};
  EXPECT_THAT(problemOf(forces), HasSubstr("found no forced byte"));
  forces.bytes = {{0, 7, 0, 0}};
  EXPECT_THAT(problemOf(forces), HasSubstr("without bits"));
  forces.bytes = {{0, 7, 0x100, 0}};
  EXPECT_THAT(problemOf(forces), HasSubstr("without bits"));
  forces.bytes = {{0, 7, 1, 2}};
  EXPECT_THAT(problemOf(forces), HasSubstr("others than its own"));
  forces.bytes = {{0, 7, 1, 1}, {0, 7, 2, 2}};
  EXPECT_THAT(problemOf(forces), HasSubstr("not in their order"));
  forces.bytes = {{1, 0, 1, 1}, {0, 7, 2, 2}};
  EXPECT_THAT(problemOf(forces), HasSubstr("not in their order"));
}

TEST(Forces, NotTooMany) {
  Forces forces = example();
  forces.bytes.clear();
  for (uint32_t byte = 0; byte <= kMostForcedBytes; ++byte) forces.bytes.push_back({0, byte, 1, 1});
  EXPECT_EQ(problemOf(forces), "found 4097 forced bytes, expected at most 4096");
  forces.bytes.pop_back();
  std::string problem;
  EXPECT_TRUE(unpackedForces(packed(forces), problem)) << problem;
}

} // namespace
} // namespace rung::compile
