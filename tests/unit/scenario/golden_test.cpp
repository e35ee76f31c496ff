// Scenarios that are wrong or fail, and all that is said about each: a file of cases for each stage that says it.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "ir/support/temporary_folder.h"
#include "tests/support/cases.h"
#include "tools/replay/session_past.h"
#include "tools/scenario/requests.h"

namespace rung::scenario {
namespace {

std::string linesOf(const std::vector<Problem>& problems) {
  std::string text;
  for (const Problem& problem : problems) text += textOf(problem) + '\n';
  return text;
}

std::string wrongStatement(const std::string& line) {
  return linesOf(parse("t.scn", "program a.lad\n" + line + "\n").problems);
}

// The files of a case in a folder of their own, which the text does not name; t.scn is run.
std::string runOf(const std::map<std::string, std::string>& files) {
  const TemporaryFolder folder;
  for (const auto& [name, text] : files) std::ofstream(folder / name) << text;
  const RunResult result = replay::runAndExplain(parse((folder / "t.scn").string(), files.at("t.scn")),
                                                 {.engines = {compiler::EngineKind::Interp}});
  std::string text = result.passed ? "passed" : result.environment + linesOf(result.problems);
  const std::string prefix = (folder / "").string();
  for (size_t at; (at = text.find(prefix)) != std::string::npos;) text.erase(at, prefix.size());
  return text;
}

std::string runOfTheLamp(const std::string& statements) {
  constexpr const char* kLamp = "dialect nct\nmodule MAIN\n\nrung\n|--[5100.00]--[/5100.01]--(5101.00)\n";
  return runOf({{"lamp.lad", kLamp}, {"t.scn", "program lamp.lad\n" + statements + "\n"}});
}

// A service, and in the second line a statement with its keys.
std::string wrongKeys(const std::string& text) {
  const size_t end = text.find('\n');
  const std::string signature = text.substr(0, end);
  const ServiceSignature service(nc::ServiceRow(nc::kUnknownService, signature.c_str()));
  const Statement prepare = parse("t.scn", "program a\n" + text.substr(end + 1) + "\n").statements.at(1);
  return keyProblem(service, prepare.keys, prepare.results);
}

std::string become(const std::string& kind, const std::string& input) {
  if (kind == "statements") return wrongStatement(input);
  if (kind == "runs") return runOfTheLamp(input);
  if (kind == "explanations") return runOf(test::filesIn(input));
  if (kind == "services") return wrongKeys(input);
  return "there are no such cases: " + kind;
}

TEST(ScenarioGolden, WhatIsSaid) {
  test::Golden golden("tests/golden/scenario", {".cases"});
  for (const std::filesystem::path& file : golden.inputs())
    test::expectCases(golden, file, [&](const test::Case& one) { return become(file.stem().string(), one.input); });
}

} // namespace
} // namespace rung::scenario
