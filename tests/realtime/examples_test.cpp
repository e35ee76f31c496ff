// Every example, compiled, in every host: not one allocation, lock or system call in several hundred slices with inputs
// that change, messages and retained memory. What lies in examples/ is found; nothing is listed here.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "ir/support/temporary_folder.h"
#include "rtlib/load/so_engine.h"
#include "tests/realtime/hosts.h"

namespace rung::test {
namespace {

namespace fs = std::filesystem;

constexpr uint64_t kFewestSlices = 400;

std::vector<std::string> exampleNames() {
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(RUNG_TEST_EXAMPLES))
    if (fs::exists(entry.path() / "rung.toml")) names.push_back(entry.path().filename().string());
  std::ranges::sort(names);
  return names;
}

// The maps that an example brings, and the one of all its bits.
std::vector<host::File> mapsOf(const fs::path& example, const rung_program& program) {
  std::vector<host::File> maps = {mapOfAll(program)};
  for (const fs::directory_entry& entry : fs::directory_iterator(example)) {
    if (entry.path().extension() != ".map") continue;
    std::ifstream file(entry.path(), std::ios::binary);
    const std::string text((std::istreambuf_iterator<char>(file)), {});
    std::vector<std::string> errors;
    maps.push_back(host::parseMap(text, entry.path().string(), errors));
    for (const std::string& error : errors) ADD_FAILURE() << error;
  }
  return maps;
}

[[noreturn]] void exitWith(const char* host, const Outcome& outcome) {
  std::string problem = outcome.problem;
  if (problem.empty() && outcome.slices < kFewestSlices) problem = "too few slices";
  if (problem.empty() && outcome.faults != 0) problem = "the program has stopped";
  std::fprintf(stderr, "%s: %s (%u slices, %u messages, %u faults)\n", host, problem.c_str(),
               static_cast<unsigned>(outcome.slices), static_cast<unsigned>(outcome.messages),
               static_cast<unsigned>(outcome.faults));
  std::exit(problem.empty() ? 0 : 1);
}

class Example : public testing::TestWithParam<std::string> {};

TEST_P(Example, IsCleanInRealTime) {
  const fs::path example = fs::path(RUNG_TEST_EXAMPLES) / GetParam();
  const TemporaryFolder folder;
  const std::string object = (folder / "program.so").string();
  const std::string build = std::string(RUNG_TEST_RUNGC) + " build -q " + example.string() + " -o " + object;
  ASSERT_EQ(std::system(build.c_str()), 0) << build;
  std::string error;
  const auto engine = runtime::SoEngine::open(object, error);
  ASSERT_NE(engine, nullptr) << error;
  const rung_program& program = engine->program();
  const auto retain = [&](const char* name) { return (folder / name).string(); };
  for (const host::File& map : mapsOf(example, program)) {
    SCOPED_TRACE(map.paths[0]);
    EXPECT_EXIT(exitWith("host", runInBox(program, map, retain("host"))), testing::ExitedWithCode(0), "host: ");
    EXPECT_EXIT(exitWith("apart", runFastApart(program, map)), testing::ExitedWithCode(0), "apart: ");
  }
  EXPECT_EXIT(exitWith("bare", runBare(program, retain("bare"))), testing::ExitedWithCode(0), "bare: ");
  EXPECT_EXIT(exitWith("clock", runOnClock(program, retain("clock"))), testing::ExitedWithCode(0), "clock: ");
}

INSTANTIATE_TEST_SUITE_P(Examples, Example, testing::ValuesIn(exampleNames()), [](const auto& tested) {
  std::string name = tested.param;
  std::ranges::replace(name, '-', '_');
  return name;
});

} // namespace
} // namespace rung::test
