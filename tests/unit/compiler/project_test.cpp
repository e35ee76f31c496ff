// The project file: what is read, and every mistake with its place.
#include "compiler/project.h"
#include "ir/support/diag/source.h"

#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>

#include "ir/support/diag_render.h"

namespace rung::compiler {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class ProjectFile : public testing::Test {
protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("rung-project-" + std::to_string(getpid()));
    fs::create_directories(folder_ / "common");
    fs::create_directories(folder_ / "tests");
    for (const char* name : {"main.plc", "more.plc", "b.scn", "a.scn", "tests/c.scn", ".hidden.scn"}) write(name, "");
  }
  void TearDown() override { fs::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) { std::ofstream(folder_ / name) << text; }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  std::optional<Project> read(const std::string& text) {
    write("rung.toml", text);
    return load(sources_, path("rung.toml"), diagnostics_);
  }
  // "line:column code" of everything reported.
  std::vector<std::string> mistakes(const std::string& text) {
    EXPECT_FALSE(read(text));
    std::vector<std::string> found;
    for (const Diagnostic* d : diagnostics_.sorted()) {
      const LineCol at = sources_.lineCol(d->range.begin);
      found.push_back(std::to_string(at.line) + ":" + std::to_string(at.column) + " " +
                      std::string(diagInfo(d->id).code));
    }
    return found;
  }
  std::string text() const { return renderText(diagnostics_, sources_); }

  fs::path folder_;
  SourceManager sources_;
  Diagnostics diagnostics_;
};

constexpr const char* kGood = R"(name = "mill"
dialect = "technol"
files = ["main.plc", "more.plc"]
include = ["common"]
scenarios = ["*.scn", "tests/*.scn"]

encoding = "utf-8"

[config]
TOOL_LIFE = 90
GAIN = 1.5
const.CMD_CHIPS = 102
"Limit.Invert" = 1
)";

TEST_F(ProjectFile, HoldsTheProgramAndItsConfiguration) {
  const auto project = read(kGood);
  ASSERT_TRUE(project) << text();
  EXPECT_EQ(project->name, "mill");
  EXPECT_EQ(project->dialect, "technol");
  EXPECT_THAT(project->files, ElementsAre(path("main.plc"), path("more.plc")));
  EXPECT_THAT(project->includePaths, ElementsAre(path("common")));
  EXPECT_THAT(project->scenarios, ElementsAre(path("a.scn"), path("b.scn"), path("tests/c.scn")));
  std::vector<std::string> config;
  for (const Setting& setting : project->config) config.push_back(setting.key + "=" + setting.value);
  EXPECT_THAT(config,
              ElementsAre("encoding=utf-8", "TOOL_LIFE=90", "GAIN=1.5", "const.CMD_CHIPS=102", "Limit.Invert=1"));
  EXPECT_EQ(std::string(kGood).substr(project->config[1].begin, project->config[1].end - project->config[1].begin),
            "90");
}

TEST_F(ProjectFile, TheSimulatedControlIsAKeyOfItsOwn) {
  write("lamp.lad", "");
  const auto project = read("dialect = \"nct\"\nfiles = [\"lamp.lad\"]\nnc = \"simulated\"\n");
  ASSERT_TRUE(project) << text();
  EXPECT_EQ(project->name, folder_.filename().string());
  ASSERT_EQ(project->config.size(), 1u);
  EXPECT_EQ(project->config[0].key + project->config[0].value, "ncsimulated");
}

TEST_F(ProjectFile, ReportsEveryMistakeWithItsPlace) {
  EXPECT_THAT(mistakes("dialekt = \"nct\"\n"
                       "dialect = \"siemens\"\n"
                       "files = [\"main.plc\", \"gone.plc\", 7]\n"
                       "include = \"common\"\n"
                       "nc = \"real\"\n"
                       "scenarios = [\"gone.scn\", \"none-*.scn\"]\n"
                       "[config]\n"
                       "machine = true\n"
                       "nc = \"simulated\"\n"),
              ElementsAre("1:1 unknown-project-key", "2:11 project-value", "3:22 missing-project-file",
                          "3:34 project-value", "4:11 project-value", "5:6 project-value", "6:14 missing-project-file",
                          "8:11 project-value", "9:6 project-value"));
  EXPECT_THAT(text(), HasSubstr("did you mean dialect?"));
  EXPECT_THAT(text(), HasSubstr("found \"siemens\"; 'dialect' takes \"fanuc\", \"gsk\", \"nct\" or \"technol\""));
  EXPECT_THAT(text(), HasSubstr("gone.plc' is not a file"));
  EXPECT_THAT(text(), HasSubstr("found 7; 'files' takes a list of texts such as"));
  EXPECT_THAT(text(), HasSubstr("found true; 'machine' takes a text or a number"));
}

TEST_F(ProjectFile, SaysWhatStandsForAKeyOfAnotherDialect) {
  EXPECT_THAT(mistakes("messages = \"main.msg\"\ndialect = \"nct\"\nfiles = [\"main.plc\"]\n"),
              ElementsAre("1:1 unknown-project-key"));
  EXPECT_THAT(text(), HasSubstr("in this language: a statement of the program, `message 20 \"text\"`"));
}

TEST_F(ProjectFile, NeedsADialectAndFiles) {
  EXPECT_THAT(mistakes("name = \"x\"\n"), ElementsAre("1:1 missing-project-key", "1:1 missing-project-key"));
}

TEST_F(ProjectFile, NeedsAtLeastOneFileAndANameWithoutAFolder) {
  EXPECT_THAT(mistakes("name = \"a/b\"\ndialect = \"nct\"\nfiles = []\n"),
              ElementsAre("1:8 project-value", "3:9 project-value"));
}

TEST_F(ProjectFile, MistakesOfToml) {
  EXPECT_THAT(mistakes("dialect = \"nct\"\n\xC3\xA4 = \"\xC3\xBC\" x\n"), ElementsAre("2:1 project-syntax"));
}

TEST_F(ProjectFile, AFileThatCannotBeRead) {
  EXPECT_FALSE(load(sources_, path("none.toml"), diagnostics_));
  EXPECT_TRUE(diagnostics_.has(diag::FileNotFound));
}

TEST_F(ProjectFile, IsFoundUpwards) {
  write("rung.toml", kGood);
  EXPECT_EQ(findUpwards(path("tests")), path("rung.toml"));
  EXPECT_EQ(findUpwards(path("tests/")), path("rung.toml"));
  EXPECT_EQ(findUpwards(folder_.string()), path("rung.toml"));
  EXPECT_EQ(findUpwards("/"), std::nullopt);
}

TEST_F(ProjectFile, KnowsItsFilesHoweverTheyAreWritten) {
  const auto project = read(kGood);
  ASSERT_TRUE(project) << text();
  EXPECT_TRUE(hasFile(*project, path("tests/../more.plc")));
  EXPECT_FALSE(hasFile(*project, path("a.scn")));
  EXPECT_FALSE(hasFile(*project, path("none.plc")));
}

TEST_F(ProjectFile, PatternsMatchAsInAShell) {
  EXPECT_THAT(matchPattern(folder_.string(), "[ab].scn"), ElementsAre(path("a.scn"), path("b.scn")));
  EXPECT_THAT(matchPattern(folder_.string(), "*/?.scn"), ElementsAre(path("tests/c.scn")));
  EXPECT_THAT(matchPattern(folder_.string(), "*.none"), IsEmpty());
  EXPECT_THAT(matchPattern(folder_.string(), path("tests") + "/*.scn"), ElementsAre(path("tests/c.scn")));
}

} // namespace
} // namespace rung::compiler
