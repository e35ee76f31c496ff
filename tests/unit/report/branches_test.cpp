// Branches of rungs, counted by their values, and the file of the counts.
#include "ir/core/op_info.h"
#include "tools/report/profile_branches.h"

#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

namespace {

using namespace rung;
using rung::ir::Branch;
using testing::ElementsAre;
using testing::HasSubstr;

// An if, another one in its else, and one after them.
ir::Module nestedIfs() {
  ir::Module module;
  ir::Rung rung;
  rung.key = 7;
  rung.values = {ir::Type::Bit, ir::Type::Bit};
  rung.args = {ir::ValueId{0}, ir::ValueId{1}, ir::ValueId{1}};
  const auto add = [&](std::string_view name, uint16_t args, uint32_t first) {
    rung.ops.push_back({.code = ir::findOp(name)->code, .argCount = args, .firstArg = first});
  };
  add("if", 1, 0);
  add("else", 0, 1);
  add("if", 1, 1);
  add("endif", 0, 2);
  add("endif", 0, 2);
  add("if", 1, 2);
  add("endif", 0, 3);
  module.routines.push_back({.name = "R", .rungs = {rung}});
  return module;
}

TEST(Branches, CountOnlyWhereTheyAreReached) {
  ir::BranchCounts counts;
  report::BranchCounter counter(nestedIfs(), counts);
  const uint64_t both[] = {1, 1}, second[] = {0, 1}, none[] = {0, 0};
  counter.rungRan(0, both);
  counter.rungRan(0, second);
  counter.rungRan(0, none);
  counter.rungRan(0, {}); // a fault
  EXPECT_THAT(counts.at(7), ElementsAre(Branch{3, 1}, Branch{2, 1}, Branch{3, 2}));
}

class BranchFile : public testing::Test {
protected:
  ~BranchFile() override { std::filesystem::remove(path_); }
  std::string errorOf(std::string_view text) {
    std::ofstream(path_) << text;
    return report::branchesIn(path_).error();
  }
  const std::string path_ = testing::TempDir() + "branches." + std::to_string(getpid());
};

TEST_F(BranchFile, IsReadAsItWasWritten) {
  const ir::BranchCounts counts{{7, {{3, 1}, {2, 2}}}, {UINT64_MAX, {{9, 0}}}};
  std::ofstream(path_) << report::branchesJson(counts);
  EXPECT_EQ(report::branchesIn(path_).value(), counts);
}

TEST_F(BranchFile, OtherFilesAreRefused) {
  EXPECT_THAT(report::branchesIn("/nonexistent.prof").error(), HasSubstr("cannot read '/nonexistent.prof'"));
  EXPECT_THAT(errorOf("{"), HasSubstr(path_ + ": "));
  EXPECT_THAT(errorOf("{}"), HasSubstr("not written by rungc profile -o"));
  EXPECT_THAT(errorOf(R"({"format": "rung branches", "version": 2})"), HasSubstr("another version"));
  const std::string head = R"({"format": "rung branches", "version": 1, "rungs": [)";
  EXPECT_THAT(errorOf(head + R"({"key": "x", "ifs": []}]})"), HasSubstr("not a hexadecimal number"));
  EXPECT_THAT(errorOf(head + R"({"key": "7", "ifs": [[1, 2]]}]})"), HasSubstr("more often than it was reached"));
  EXPECT_THAT(errorOf(head + R"({"key": "7", "ifs": [[1]]}]})"), HasSubstr("out of range"));
}

} // namespace
