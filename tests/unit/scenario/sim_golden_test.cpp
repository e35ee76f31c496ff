// What the simulated controls refuse, and all that they say about it: a file of cases for each control. A case has
// lines of its configuration, then statements; what is said has the number of its line.
//
//   config KEY VALUE         KEY and VALUE without quotes; FOLDER is the one with the files of the case
//   connect SOURCE DESTINATION
//   event …, expect_sent …   as in a scenario
//   set QUANTITY VALUE       without NC.
//   cell NAME                why there is no such cell
//   write NAME VALUE         to a cell
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "ir/support/temporary_folder.h"
#include "sim/nct/channels.h"
#include "tests/support/cases.h"
#include "tests/unit/sim/pmc_machine.h"
#include "tests/unit/sim/technol_machine.h"
#include "tools/scenario/values.h"

namespace rung::sim {
namespace {

using Pairs = std::vector<std::pair<std::string, std::string>>;

// The simulated controls, each with what its cases may say.
template <const char* kDialect>
struct Pmc {
  static std::unique_ptr<SimulatedNc> bare() { return makeSimulatedNc(kDialect); }
  Pmc(const Pairs& config, const Pairs&) : machine(kDialect, config) {}
  SimulatedNc& nc() { return machine.nc(); }
  std::string event(const std::string& name, const std::vector<NcArgument>& keys) {
    return nc().event(machine.instance(), name, keys);
  }
  test::PmcMachine machine;
};
constexpr char kFanuc[] = "fanuc", kGsk[] = "gsk";

struct Technol {
  static std::unique_ptr<SimulatedNc> bare() { return makeSimulatedTechnol(); }
  Technol(const Pairs& config, const Pairs& connections) : machine(config, connections) { machine.scan(); }
  SimulatedNc& nc() { return machine.nc(); }
  std::string event(const std::string& name, const std::vector<NcArgument>& keys) {
    return machine.event(name.c_str(), keys);
  }
  TechnolMachine machine;
};

template <class Control>
class Conversation {
public:
  std::string run(const std::string& input) {
    std::istringstream lines(withFiles(input));
    std::string said;
    uint32_t number = 0;
    for (std::string line; std::getline(lines, line);) {
      const std::string answer = answerTo(line);
      ++number;
      if (!answer.empty()) said += std::to_string(number) + ": " + answer + '\n';
    }
    control();
    for (const auto& problem : control_->nc().connectionProblems()) said += "connections: " + problem.text + '\n';
    return withoutFolder(said);
  }

private:
  // Makes the files of a case, and gives what is left of it.
  std::string withFiles(const std::string& input) {
    if (!input.starts_with(">>> ")) return input;
    const std::map<std::string, std::string> files = rung::test::filesIn(input);
    for (const auto& [name, text] : files) std::ofstream(folder_ / name) << text;
    return files.at("statements");
  }
  std::string withoutFolder(std::string text) const {
    const std::string prefix = (folder_ / "").string();
    for (size_t at; (at = text.find(prefix)) != std::string::npos;) text.erase(at, prefix.size());
    return text;
  }

  Control& control() {
    if (!control_) control_.emplace(config_, connections_);
    return *control_;
  }

  std::string configure(std::string value, const std::string& key) {
    const size_t at = value.find("FOLDER/");
    if (at != std::string::npos) value.replace(at, std::string_view("FOLDER/").size(), (folder_ / "").string());
    std::string answer = bare_->config(key, value);
    if (answer.empty()) config_.emplace_back(key, value);
    return answer;
  }

  std::string answerTo(const std::string& line) {
    std::istringstream words(line);
    std::string kind, first, second;
    words >> kind;
    if (kind == "event" || kind == "expect_sent") return answerToStatement(line);
    words >> first;
    std::getline(words >> std::ws, second);
    if (kind == "config") return configure(second, first);
    if (kind == "connect") {
      connections_.emplace_back(first, second);
      return "";
    }
    if (kind == "set") return control().nc().setQuantity(first, std::stod(second));
    if (kind == "cell") return control().nc().readCell(first) ? "" : control().nc().cellProblem(first);
    if (kind == "write")
      return control().nc().writeCell(first, {.bits = std::stoull(second)}).value_or("(there is no such cell)");
    return "(an unknown line of a case)";
  }

  std::string answerToStatement(const std::string& line) {
    const Result<scenario::Statement> statement = scenario::parseStatement(line);
    if (!statement.ok()) return statement.error();
    const std::vector<NcArgument> keys = scenario::arguments(statement.value().keys);
    if (statement.value().kind == scenario::Kind::Event) return control().event(statement.value().name, keys);
    return control().nc().expectSent(statement.value().name, keys);
  }

  TemporaryFolder folder_;
  std::unique_ptr<SimulatedNc> bare_ = Control::bare(); // takes the configuration, wrong lines of it, too
  Pairs config_, connections_;
  std::optional<Control> control_;
};

// What the reader of part programs says about one.
std::string partProgramOfNct(const std::string& text) {
  nct::ChannelProgram program;
  return nct::readChannelProgram(text, program);
}

std::string become(const std::string& control, const std::string& input) {
  if (control == "fanuc") return Conversation<Pmc<kFanuc>>().run(input);
  if (control == "gsk") return Conversation<Pmc<kGsk>>().run(input);
  if (control == "technol") return Conversation<Technol>().run(input);
  if (control == "nct-programs") return partProgramOfNct(input);
  return "there is no such control: " + control;
}

TEST(SimGolden, WhatIsRefused) {
  rung::test::Golden golden("tests/golden/sim", {".cases"});
  for (const std::filesystem::path& file : golden.inputs())
    rung::test::expectCases(golden, file,
                            [&](const rung::test::Case& one) { return become(file.stem().string(), one.input); });
}

} // namespace
} // namespace rung::sim
