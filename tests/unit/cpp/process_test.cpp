// Child processes: what is found, run, and said about what cannot be run.
#include "codegen/process/process.h"

#include <csignal>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vector>

#include "codegen/cpp/cpp_emitter.h"
#include "ir/support/temporary_folder.h"

namespace rung::codegen {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;

Result<int> run(std::vector<std::string> words, const ProcessOutput& output = {}) { return runProgram(words, output); }

TEST(Process, FindsProgramsInPathAndByTheirPath) {
  EXPECT_THAT(findProgram("sh").value_or(""), EndsWith("/sh"));
  EXPECT_EQ(findProgram("/bin/sh"), "/bin/sh");
  EXPECT_EQ(findProgram("rung-no-such-program"), std::nullopt);
  EXPECT_EQ(findProgram("/no/such/program"), std::nullopt);
  EXPECT_EQ(findProgram("/tmp"), std::nullopt); // a folder
  EXPECT_EQ(findProgram(""), std::nullopt);
}

TEST(Process, GivesTheExitCode) {
  EXPECT_EQ(run({"sh", "-c", "exit 3"}).value(), 3);
  EXPECT_EQ(run({"true"}).value(), 0);
}

TEST(Process, ArgumentsArePassedAsTheyAre) {
  const TemporaryFolder folder;
  const std::string file = (folder / "out").string();
  EXPECT_EQ(run({"sh", "-c", "printf '%s|' \"$@\"; echo error >&2", "sh", "a b", "", "$HOME", "it's"},
                {.out = file, .error = file})
                .value(),
            0);
  EXPECT_EQ(folder.contentsOf("out"), "a b||$HOME|it's|error\n");
}

TEST(Process, SaysWhyAProgramDidNotRun) {
  EXPECT_EQ(run({"rung-no-such-program"}).error(),
            "'rung-no-such-program' is not an executable file, nor is it in a folder of PATH");
  EXPECT_FALSE(run({}).ok());
  const Result<int> killed = run({"sh", "-c", "kill -KILL $$"});
  ASSERT_FALSE(killed.ok());
  EXPECT_THAT(killed.error(), HasSubstr("Killed"));
  const TemporaryFolder folder;
  const std::string script = (folder / "script").string();
  std::ofstream(script) << "#!/no/such/interpreter\n";
  std::filesystem::permissions(script, std::filesystem::perms::owner_all);
  EXPECT_THAT(run({script}).error(), HasSubstr("No such file or directory"));
}

// Where somebody ignores the ends of children, the system keeps none.
TEST(Process, AnEndThatIsNotKnownIsAFailure) {
  const auto before = std::signal(SIGCHLD, SIG_IGN);
  const Result<int> done = run({"true"});
  std::signal(SIGCHLD, before);
  ASSERT_FALSE(done.ok());
  EXPECT_THAT(done.error(), HasSubstr("No child processes"));
}

TEST(Process, MistakesOfTheCompilerAreShown) {
  CppBuildOptions options;
  options.compiler = "rung-no-such-compiler -v";
  EXPECT_EQ(buildCppSharedObject("", options).error(),
            "cannot run the C++ compiler: 'rung-no-such-compiler' is not an executable file, nor is it in a folder of "
            "PATH");
  options.compiler = " ";
  EXPECT_EQ(buildCppSharedObject("", options).error(), "the name of the C++ compiler is empty");
  options.compiler = "false";
  EXPECT_EQ(buildCppSharedObject("", options).error(), "the C++ compiler 'false' failed: exit code 1");
  options.compiler = "clang++-19";
  const std::string error = buildCppSharedObject("int f() { return nothing; }", options).error();
  EXPECT_THAT(error, HasSubstr("the C++ compiler 'clang++-19' failed: exit code 1\n"));
  EXPECT_THAT(error, HasSubstr("undeclared identifier 'nothing'"));
}

} // namespace
} // namespace rung::codegen
