// The file of message texts: what it says, and what is wrong with it.
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "ir/support/temporary_folder.h"
#include "tests/unit/gsk/compile.h"

namespace rung::frontend::gsk::test {
namespace {

class Messages : public ::testing::Test {
protected:
  std::unique_ptr<Compiled> compileWith(const std::string& messages, const std::string& name = "texts.txt") {
    std::ofstream(folder_ / "texts.txt") << messages;
    frontend::CompileOptions options;
    options.config["messages"] = name;
    return compileFiles({{(folder_ / "plc.pmc").string(), "FUNC 0\nLD X9.0\nOUT A0.0\nFUNC 1\n"}}, options);
  }
  TemporaryFolder folder_;
};

TEST_F(Messages, TextsByNumberAndByBit) {
  const auto result = compileWith("; alarms\n1 \"EMERGENCY STOP\" ; A0.0\n\nA31.7 \"LAST; ONE\"\na0.1 \"SECOND\"\n");
  ASSERT_NE(result->module, nullptr) << result->text();
  const auto& texts = result->module->messages;
  ASSERT_EQ(texts.size(), 3u);
  EXPECT_EQ(texts[0].number, 1u);
  EXPECT_EQ(texts[0].text, "EMERGENCY STOP");
  EXPECT_EQ(texts[1].number, 2u);
  EXPECT_EQ(texts[2].number, 256u);
  EXPECT_EQ(texts[2].text, "LAST; ONE");
}

TEST_F(Messages, MistakesHaveTheirPlace) {
  const auto result =
      compileWith("x \"a\"\n1\n2 text\n3 \"open\n4 \"a\" b\n0 \"a\"\n257 \"a\"\n5 \"a\"\nA0.4 \"b\"\nA32.0 \"c\"\n"
                  "A1.8 \"d\"\n");
  EXPECT_EQ(result->module, nullptr);
  EXPECT_EQ(result->codes(), (Codes{"1 bad-message", "2 bad-message", "3 bad-message", "4 bad-message", "5 bad-message",
                                    "6 constant-out-of-range", "7 constant-out-of-range", "9 duplicate-symbol",
                                    "10 constant-out-of-range", "11 bad-message"}));
  EXPECT_NE(result->text().find("texts.txt:3:3"), std::string::npos) << result->text();
}

TEST_F(Messages, AFileThatIsNotThere) { EXPECT_EQ(compileWith("", "other.txt")->codes(), Codes{"- file-not-found"}); }

} // namespace
} // namespace rung::frontend::gsk::test
