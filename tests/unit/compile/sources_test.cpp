// Packed sources: what goes in comes out, and nothing else does.
#include "machine/compile/sources.h"

#include <gmock/gmock.h>
#include <random>

namespace rung::compile {
namespace {

Sources machine() {
  return {.dialect = "technol",
          .name = "mill",
          .files = {"b.plc", "a.plc"},
          .includePaths = {"../common", "/shared"},
          .config = {{"period_us", "1000"}, {"encoding", "cp852"}},
          .profile = true,
          .texts = {{"a.plc", "text\n"}, {"b.plc", std::string("\0\xFF\n", 3)}, {"names.inc", ""}}};
}

std::string problemOf(std::string_view bytes) {
  std::string problem;
  EXPECT_FALSE(unpacked(bytes, problem));
  return problem;
}

TEST(PackedSources, ComeOutAsTheyWentIn) {
  std::string problem;
  const std::optional<Sources> out = unpacked(packed(machine()), problem);
  ASSERT_TRUE(out) << problem;
  EXPECT_EQ(out->dialect, "technol");
  EXPECT_EQ(out->name, "mill");
  EXPECT_EQ(out->files, machine().files);
  EXPECT_EQ(out->includePaths, machine().includePaths);
  EXPECT_EQ(out->config, machine().config);
  EXPECT_TRUE(out->profile);
  EXPECT_EQ(out->texts, machine().texts);
}

TEST(PackedSources, AreRefusedWhereTheyAreNone) {
  constexpr const char* kNone = "found bytes that are not sources, or not all of them";
  EXPECT_EQ(problemOf(""), kNone);
  EXPECT_EQ(problemOf("rung-sources 2\n"), kNone);
  EXPECT_EQ(problemOf("rung-sources 1\n"), kNone);
  EXPECT_EQ(problemOf(packed({})), "found no file, expected one at least");
  EXPECT_EQ(problemOf(packed({.files = {"a"}})), "found no text of the file a, expected one");
  const std::string good = packed(machine());
  for (size_t length = 0; length < good.size(); ++length) {
    const std::string problem = problemOf(good.substr(0, length));
    EXPECT_FALSE(problem.empty()) << length;
  }
  EXPECT_EQ(problemOf(good + "z" + std::string(8, '\0')), kNone);
}

TEST(PackedSources, HaveALimit) {
  Sources many{.files = {"0"}};
  for (size_t i = 0; i <= kMostFiles; ++i) many.texts[std::to_string(i)] = "";
  EXPECT_EQ(problemOf(packed(many)), "found more than 1000 files");
}

TEST(PackedSources, OfAnyBytesDoNoHarm) {
  std::mt19937 chance(4711);
  const std::string good = packed(machine());
  for (int i = 0; i < 20000; ++i) {
    std::string bytes = good;
    for (int change = 0; change < 3; ++change) bytes[15 + chance() % (bytes.size() - 15)] = static_cast<char>(chance());
    std::string problem;
    unpacked(bytes, problem);
  }
}

} // namespace
} // namespace rung::compile
