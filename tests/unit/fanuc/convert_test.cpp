// Mnemonic files as ladder text and back: the same module each time, and nothing moves twice.
#include <filesystem>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "frontend/dialects/fanuc/fanuc.h"
#include "frontend/network/convert/convert.h"
#include "tests/support/compiled.h"
#include "tests/support/golden.h"
#include "tests/support/without_places.h"

namespace rung::frontend::fanuc::test {
namespace {

using frontend::test::Codes;
using frontend::test::Compiled;
using frontend::test::compileFiles;
using frontend::test::File;
using frontend::test::listed;
using network::Form;

struct Converted {
  std::optional<std::string> text;
  Codes errors; // of the conversion, as of Compiled
  bool compiles = false;
};

Converted convert(const std::vector<File>& texts, Form to) {
  Compiled state;
  std::vector<FileId> files;
  for (const File& file : texts) files.push_back(state.sources.addBuffer(file.name, file.text));
  const auto program = kFanuc.check(state.sources, files, {}, state.diagnostics);
  Converted result;
  result.compiles = !state.diagnostics.hasErrors();
  if (!result.compiles) return result;
  state.diagnostics = Diagnostics();
  const NetworkSource networks = *program->networks();
  result.text = network::convertProgram(networks.language, state.sources, networks.files, to, state.diagnostics);
  result.errors = state.codes();
  return result;
}

std::string toLadder(const std::string& mnemonic) {
  const Converted result = convert({{"test.mne", mnemonic}}, Form::Ladder);
  EXPECT_TRUE(result.text) << listed(result.errors) << '\n' << mnemonic;
  return result.text.value_or("");
}
std::string toList(const std::string& ladder) {
  const Converted result = convert({{"test.lad", ladder}}, Form::List);
  EXPECT_TRUE(result.text) << listed(result.errors) << '\n' << ladder;
  return result.text.value_or("");
}

std::string moduleOf(const std::string& name, const std::string& text) {
  const auto compiled = compileFiles(kFanuc, {{name, text}});
  EXPECT_TRUE(compiled->module) << compiled->text() << text;
  return compiled->module ? frontend::test::withoutPlaces(*compiled->module) : "";
}

std::string formatted(const std::string& name, const std::string& text) {
  SourceManager sources;
  Diagnostics diagnostics;
  return kFanuc.format(sources, sources.addBuffer(name, text), diagnostics).value_or("not formatted");
}

void checkThereAndBack(const std::string& mnemonic) {
  const std::string ladder = toLadder(mnemonic);
  const std::string back = toList(ladder);
  const std::string module = moduleOf("test.mne", mnemonic);
  EXPECT_TRUE(moduleOf("test.lad", ladder) == module) << ladder;
  EXPECT_TRUE(moduleOf("test.mne", back) == module) << back;
  EXPECT_EQ(toList(toLadder(back)), back) << "sections and comments have their places";
  EXPECT_EQ(formatted("test.lad", ladder), ladder);
  EXPECT_EQ(formatted("test.mne", back), back);
}

std::string contentsOf(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

TEST(FanucConvert, Forms) {
  rung::test::Golden golden("tests/golden/fanuc-forms", {".mne"});
  for (const std::filesystem::path& program : golden.inputs()) {
    SCOPED_TRACE(program);
    const std::string mnemonic = golden.read(program);
    const std::string ladder = toLadder(mnemonic);
    golden.expect(program, ".lad", ladder);
    golden.expect(program, ".back", toList(ladder));
    checkThereAndBack(mnemonic);
  }
}

// Those of the scenarios that need no configuration.
TEST(FanucConvert, ProgramsOfScenariosThereAndBack) {
  int programs = 0;
  for (const auto& entry : std::filesystem::directory_iterator("tests/scenarios/fanuc")) {
    if (entry.path().extension() != ".mne") continue;
    const std::string mnemonic = contentsOf(entry.path());
    if (!convert({{"test.mne", mnemonic}}, Form::Ladder).compiles) continue;
    SCOPED_TRACE(entry.path());
    checkThereAndBack(mnemonic);
    if (HasFailure()) return;
    ++programs;
  }
  EXPECT_GT(programs, 100);
}

TEST(FanucConvert, SeveralFilesBecomeOne) {
  const std::vector<File> files = {
      {"ladder.mne", "%@3\nEND1\nRD START\nWRT Y9.0\nEND2\nEND\n%\n%@4\nA0.0 1000 GUARD\n%\n"},
      {"symbols.mne", "%@2-E(SYM=2 ADR=1 CM1=3)\nX9.0,START,\"key, green\"\n%\n"},
      {"system.mne", "%@0\n4 PMC-SB7\n%\n"}};
  const Converted ladder = convert(files, Form::Ladder);
  ASSERT_TRUE(ladder.text);
  EXPECT_EQ(*ladder.text, "dialect fanuc\n"
                          "\nmodule LEVEL2\n\nrung\n|--[START]--(Y9.0)\n"
                          "\nmessage A0.0 \"1000 GUARD\"\nsymbol START X9.0  ; key, green\ndata %@0 \"4 PMC-SB7\"\n");
  EXPECT_EQ(toList(*ladder.text),
            "%@A\n%@0\n4 PMC-SB7\n%\n"
            "%@2-E (SYM=1 ADR=2 CM1=3)\nSTART,X9.0,\"key, green\"\n%\n"
            "%@3\nSUB        1\n\nRD         START\nWRT        Y9.0\n\nSUB        2\n\nSUB        64\n%\n"
            "%@4\nA0.0 1000 GUARD\n%\n%@E\n");
}

TEST(FanucConvert, SectionsBesideLadderText) {
  const std::vector<File> files = {{"symbols.mne", "%@2\nX9.0 START\n%\n%@4\nA0.0 1000 GUARD\n%\n"},
                                   {"main.lad", "dialect fanuc\nmodule LEVEL2\nrung\n|--[START]--(A0.0)\n"}};
  const auto compiled = compileFiles(kFanuc, files);
  ASSERT_TRUE(compiled->module) << compiled->text();
  EXPECT_EQ(compiled->module->messages.size(), 1u);
  const Converted list = convert(files, Form::List);
  ASSERT_TRUE(list.text);
  EXPECT_EQ(moduleOf("symbols.mne", *list.text), frontend::test::withoutPlaces(*compiled->module));
}

TEST(FanucConvert, AConstantIsItsValueInAMnemonicFile) {
  const std::string list =
      toList("dialect fanuc\nconst MOST 0016\nmodule LEVEL2\nrung\n|--[X9.0]--{NUMEB 1 most D0}\n");
  EXPECT_NE(list.find("NUMEB"), 0u);
  EXPECT_NE(list.find("SUB        40\n1\n0016\nD0\n"), std::string::npos) << list;
  EXPECT_NE(list.find("; const MOST 0016\n"), std::string::npos) << list;
}

TEST(FanucConvert, ANameThatLadderTextCannotDeclareIsAComment) {
  const std::string ladder = toLadder("%@2\nR1.5 \"SPARE\"\nR1.6 GR\xC3\x9CN\n%\n%@3\nEND1\nEND2\nEND\n%\n");
  EXPECT_EQ(ladder, "dialect fanuc\n; symbol \"SPARE\" R1.5\n; symbol GR\u00DCN R1.6\n\nmodule LEVEL2\n");
}

TEST(FanucConvert, TextsInLatin1) {
  const std::string list = "%@3\nEND1\nEND2\nEND\n%\n%@4\nA0.0 1000 T\xDCR\n%\n";
  EXPECT_NE(toLadder(list).find("message A0.0 \"1000 T\u00DCR\"\n"), std::string::npos);
}

TEST(FanucConvert, WhatLadderTextCannotHold) {
  const auto errors = [](const std::string& text) {
    return listed(convert({{"test.mne", text}}, Form::Ladder).errors);
  };
  EXPECT_EQ(errors("%@2\nX9.0 A[1]\n%\n%@3\nEND1\nRD A[1]\nWRT Y9.0\nEND2\nEND\n%\n"), "6 no-ladder-text");
  EXPECT_EQ(errors("%@2\nX9.0 A[1]\n%\n%@3\nEND1\nRD X9.0\nWRT Y9.0\nEND2\nEND\n%\n"), "") << "nothing uses it";
  EXPECT_EQ(errors("%@3\nEND1\nEND2\nEND\n%\n%@4\nA0.0 1000 3.5\" DISK\n%\n"), "7 no-ladder-text");
  EXPECT_EQ(errors("%@1\n1 3.5\" DISK\n%\n%@3\nEND1\nEND2\nEND\n%\n"), "2 no-ladder-text");
}

} // namespace
} // namespace rung::frontend::fanuc::test
