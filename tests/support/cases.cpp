// Cases of a file, and the file with what they become (see cases.h).
#include "tests/support/cases.h"

#include <gtest/gtest.h>

#include <set>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace rung::test {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kName = "=== ";
constexpr std::string_view kEnd = "---";

class Reader {
public:
  explicit Reader(const fs::path& file, const std::string& text) : file_(file), lines_(text) {}

  std::vector<Case> cases() {
    while (std::getline(lines_, line_)) {
      ++number_;
      read();
    }
    if (reading_ == Reading::Input) fail("the last case has no line " + std::string(kEnd));
    if (cases_.empty()) fail("there are no cases");
    return std::move(cases_);
  }

private:
  enum class Reading { Nothing, Input, Outcome };

  void read() {
    if (line_.starts_with(kName)) return begin(line_.substr(kName.size()));
    if (reading_ == Reading::Nothing) fail("a case begins with " + std::string(kName));
    if (reading_ == Reading::Outcome) return; // it is made anew
    if (line_ == kEnd) {
      reading_ = Reading::Outcome;
      return;
    }
    std::string& input = cases_.back().input;
    if (!first_) input += '\n';
    first_ = false;
    input += line_;
  }

  void begin(const std::string& name) {
    if (reading_ == Reading::Input) fail("the case before has no line " + std::string(kEnd));
    if (!names_.insert(name).second) fail("a second case of the name " + name);
    cases_.push_back({.name = name, .input = ""});
    reading_ = Reading::Input;
    first_ = true;
  }

  [[noreturn]] void fail(const std::string& why) const {
    throw std::runtime_error(file_.string() + ":" + std::to_string(number_) + ": " + why);
  }

  fs::path file_;
  std::istringstream lines_;
  std::string line_;
  size_t number_ = 0;
  Reading reading_ = Reading::Nothing;
  bool first_ = true; // line of its input
  std::set<std::string> names_;
  std::vector<Case> cases_;
};

} // namespace

void expectCases(Golden& golden, const fs::path& file, const std::function<std::string(const Case&)>& become) {
  std::string text;
  for (const Case& one : Reader(file, golden.read(file)).cases()) {
    SCOPED_TRACE(file.string() + ": " + one.name);
    std::string outcome = become(one);
    if (!outcome.empty() && !outcome.ends_with('\n')) outcome += '\n';
    if (!text.empty()) text += '\n';
    text += std::string(kName) + one.name + '\n' + one.input + '\n' + std::string(kEnd) + '\n' + outcome;
  }
  golden.expect(file.filename().string(), text);
}

std::map<std::string, std::string> filesIn(const std::string& input) {
  constexpr std::string_view kFile = ">>> ";
  std::map<std::string, std::string> files;
  std::istringstream lines(input);
  std::string* file = nullptr;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(kFile))
      file = &files[line.substr(kFile.size())];
    else if (file == nullptr)
      throw std::runtime_error("files begin with " + std::string(kFile) + "NAME: " + line);
    else
      *file += line + '\n';
  }
  return files;
}

} // namespace rung::test
