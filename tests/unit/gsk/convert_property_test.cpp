// Generated programs there and back: the same commands, the same module, the same comments, and nothing moves twice.
#include <algorithm>
#include <set>
#include <sstream>

#include "frontend/network/format.h"
#include "frontend/network/read/list_reader.h"
#include "tests/support/long_run.h"
#include "tests/support/without_places.h"
#include "tests/unit/gsk/convert.h"
#include "tests/unit/gsk/program_generator.h"

namespace rung::frontend::gsk::test {
namespace {

using frontend::network::Command;

const uint64_t kPrograms = rung::testing::howMany(500, 2000);

// Commands of a list, one a line; functions by their mnemonic.
std::string commandsOf(const std::string& list) {
  SourceManager sources;
  const FileId file = sources.addBuffer("list", list);
  LineReader lines(sources, file);
  LineWords words;
  std::string result;
  for (SourceLine line; lines.next(line);) {
    splitWords(line, frontend::network::kListRules, words);
    const auto statement = frontend::network::statementOf(words);
    if (statement.empty()) continue;
    const Command command = *frontend::network::findCommand(kLanguage, statement[0].text);
    if (command >= Command::Dialect) continue;
    result += kLanguage.nameOf(command);
    for (const Word& word : statement.subspan(1)) {
      const auto number = command == Command::Function ? frontend::network::parseDigits(word.text) : std::nullopt;
      result += ' ';
      result += number ? kLanguage.findFunction(*number)->info.mnemonic : word.text;
    }
    result += '\n';
  }
  return result;
}

// What is said in comments of a list, without the ';' that keeps one from being a title.
std::multiset<std::string> commentsOf(const std::string& list) {
  std::multiset<std::string> result;
  std::istringstream stream(list);
  for (std::string line; std::getline(stream, line);) {
    const size_t at = line.find(';');
    if (at == std::string::npos) continue;
    std::string text = line.substr(at);
    std::replace(text.begin(), text.end(), '\t', ' ');
    text.erase(0, std::min(text.find_first_not_of("; "), text.size()));
    text.erase(text.find_last_not_of(' ') + 1);
    if (!text.empty()) result.insert(text);
  }
  return result;
}

std::string moduleOf(const std::string& name, const std::string& text) {
  const auto compiled = compileFiles({{name, text}});
  EXPECT_TRUE(compiled->module) << compiled->text() << text;
  return compiled->module ? frontend::test::withoutPlaces(*compiled->module) : "";
}

std::string formatted(const std::string& ladder) {
  SourceManager sources;
  Diagnostics diagnostics;
  return frontend::network::format(kLanguage, sources, sources.addBuffer("test.lad", ladder), diagnostics)
      .value_or("not formatted");
}

void checkThereAndBack(const std::string& list) {
  const std::string ladder = toLadder(list);
  ASSERT_FALSE(::testing::Test::HasFailure());
  ASSERT_EQ(formatted(ladder), ladder);
  const std::string again = toList(ladder);
  ASSERT_EQ(commandsOf(again), commandsOf(list)) << ladder;
  ASSERT_EQ(commentsOf(again), commentsOf(list)) << list << "\n=====\n" << ladder << "\n=====\n" << again;
  const std::string module = moduleOf("test.pmc", list);
  ASSERT_TRUE(moduleOf("test.lad", ladder) == module) << list << "\n=====\n" << ladder;
  ASSERT_TRUE(moduleOf("test.pmc", again) == module) << list << "\n=====\n" << again;
  ASSERT_EQ(toLadder(again), ladder) << list << "\n=====\n" << again;
}

TEST(GskConvertProperty, ListsThereAndBack) {
  for (uint64_t seed = 0; seed < kPrograms && !HasFailure(); ++seed) {
    SCOPED_TRACE(seed);
    checkThereAndBack(ProgramGenerator(seed).list());
  }
}

TEST(GskConvertProperty, LaddersThereAndBack) {
  for (uint64_t seed = 0; seed < kPrograms && !HasFailure(); ++seed) {
    SCOPED_TRACE(seed);
    ProgramGenerator generator(seed + kPrograms);
    const std::string ladder = generator.decorated(toLadder(generator.list()));
    const std::string list = toList(ladder);
    ASSERT_TRUE(moduleOf("test.pmc", list) == moduleOf("test.lad", ladder)) << ladder << "\n=====\n" << list;
    checkThereAndBack(list);
  }
}

TEST(GskConvertProperty, SymbolsWithinANetworkStayInOrder) {
  const std::string ladder = toLadder("FUNC 0\nLD X0.0\nsymbol B R5.0\nOR X0.1\nsymbol A R5.1\nOUT A\nFUNC 1\n");
  EXPECT_NE(ladder.find("symbol B R5.0\nsymbol A R5.1\n"), std::string::npos) << ladder;
}

TEST(GskConvertProperty, AFormInItselfIsANormalForm) {
  for (uint64_t seed = 0; seed < kPrograms / 10 && !HasFailure(); ++seed) {
    SCOPED_TRACE(seed);
    const std::string list = ProgramGenerator(seed).list();
    const auto normal = convertFiles({{"test.pmc", list}}, Form::List);
    ASSERT_TRUE(normal.text);
    EXPECT_EQ(commandsOf(*normal.text), commandsOf(list));
    EXPECT_EQ(convertFiles({{"test.pmc", *normal.text}}, Form::List).text, normal.text);
    const std::string ladder = toLadder(list);
    EXPECT_EQ(convertFiles({{"test.lad", ladder}}, Form::Ladder).text, ladder);
  }
}

} // namespace
} // namespace rung::frontend::gsk::test
