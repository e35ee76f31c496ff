// Every program of the examples and scenarios, laid out: it is the same program, or has the same mistakes.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "compiler/project.h"
#include "tests/support/formatting.h"

namespace rung {
namespace {

namespace fs = std::filesystem;
using Texts = std::map<std::string, std::string>; // of files, by their paths

std::string contentsOf(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

bool isSource(const fs::path& path) {
  const std::string extension = path.extension();
  return extension == ".lad" || extension == ".mne" || extension == ".pmc" || extension == ".plc" ||
         extension == ".inc" || extension == ".INC";
}

// The sources of a folder, and the same laid out, everything on the line that it was on.
class Folder {
public:
  Folder(const frontend::Dialect& dialect, const std::string& folder) : dialect_(dialect) {
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
      if (entry.is_regular_file()) add(entry.path());
  }

  // False where neither compiles.
  bool isTheSame(const std::vector<std::string>& files, const frontend::CompileOptions& options) {
    const test::Meaning meaning = meaningOf(original_, files, options);
    const test::Meaning formatted = meaningOf(formatted_, files, options);
    EXPECT_TRUE(formatted == meaning) << test::differenceOf(meaning, formatted);
    return !meaning.module.empty();
  }

private:
  void add(const fs::path& path) {
    const std::string original = contentsOf(path);
    original_[path] = formatted_[path] = asRead(original);
    if (!isSource(path)) return;
    SCOPED_TRACE(path);
    const auto formatted = format(path, original);
    if (!formatted) return;
    EXPECT_EQ(format(path, *formatted), formatted) << "it is not laid out the same way twice";
    const auto lines = test::onItsLines(asRead(*formatted), original_[path]);
    EXPECT_TRUE(lines) << *formatted;
    if (lines) formatted_[path] = *lines;
  }

  std::optional<std::string> format(const fs::path& path, const std::string& text) {
    SourceManager sources;
    Diagnostics diagnostics;
    const FileId file = sources.addBytes(path, text);
    const auto formatted = dialect_.format(sources, file, diagnostics);
    return formatted ? sources.bytesOf(file, *formatted) : std::nullopt;
  }

  // The text of a file of these bytes.
  static std::string asRead(const std::string& bytes) {
    SourceManager sources;
    return std::string(sources.text(sources.addBytes("", bytes)));
  }

  test::Meaning meaningOf(const Texts& texts, const std::vector<std::string>& files,
                          const frontend::CompileOptions& options) {
    SourceManager sources(texts);
    std::vector<FileId> ids;
    for (const std::string& file : files) {
      const Result<FileId> id = sources.addFile(file);
      EXPECT_TRUE(id.ok()) << file;
      if (id.ok()) ids.push_back(id.value());
    }
    return test::meaningOf(dialect_, sources, ids, options);
  }

  const frontend::Dialect& dialect_;
  Texts original_;
  Texts formatted_;
};

// What a scenario says of its program.
struct Said {
  std::vector<std::string> files;
  frontend::CompileOptions options;
};

Said readScenario(const fs::path& path) {
  Said said;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line.substr(0, line.find('#')));
    std::string word, key, value;
    words >> word;
    if (word == "config" && words >> key >> value) said.options.config[key] = value;
    if (word == "program")
      while (words >> word) said.files.push_back((path.parent_path() / word).lexically_normal());
  }
  return said;
}

class FormattedScenarios : public testing::TestWithParam<const char*> {};

TEST_P(FormattedScenarios, AreTheSamePrograms) {
  const frontend::Dialect* dialect = frontend::findDialect(GetParam());
  ASSERT_NE(dialect, nullptr);
  const std::string folder = std::string("tests/scenarios/") + GetParam();
  Folder programs(*dialect, folder);
  int compiled = 0;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".scn") continue;
    SCOPED_TRACE(entry.path());
    const Said said = readScenario(entry.path());
    if (!said.files.empty()) compiled += programs.isTheSame(said.files, said.options) ? 1 : 0;
  }
  EXPECT_GE(compiled, 100) << "hardly a program is read as its scenario says";
}

INSTANTIATE_TEST_SUITE_P(Dialects, FormattedScenarios, testing::Values("fanuc", "gsk", "nct", "technol"),
                         [](const auto& tested) { return std::string(tested.param); });

TEST(FormattedExamples, AreTheSamePrograms) {
  int compiled = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator("examples")) {
    const fs::path file = entry.path() / compiler::kFileName;
    if (!fs::exists(file)) continue;
    SCOPED_TRACE(file);
    SourceManager sources;
    Diagnostics diagnostics;
    const auto project = compiler::load(sources, file, diagnostics);
    ASSERT_TRUE(project);
    frontend::CompileOptions options{.includePaths = project->includePaths};
    for (const compiler::Setting& setting : project->config) { // a file is beside the program
      const bool isFile = fs::path(setting.value).is_absolute();
      options.config[setting.key] = isFile ? fs::path(setting.value).filename().string() : setting.value;
    }
    Folder programs(*frontend::findDialect(project->dialect), entry.path());
    compiled += programs.isTheSame(project->files, options) ? 1 : 0;
  }
  EXPECT_EQ(compiled, 9) << "an example is forgotten, or does not compile";
}

} // namespace
} // namespace rung
