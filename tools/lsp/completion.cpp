// What may be written at a place: instructions, names, signals of the control, words that begin a statement.
#include <algorithm>
#include <set>
#include <string>

#include <fmt/format.h>

#include "compiler/reference.h"
#include "frontend/ladder/text/keywords.h"
#include "rtlib/text/letters.h"
#include "tools/lsp/features.h"

namespace rung::lsp {
namespace {

enum class ItemKind : int { Function = 3, Variable = 6, Keyword = 14, Constant = 21, Event = 23 };

constexpr size_t kMost = 500; // items of an answer; a longer word gives others

// What is expected, by what is before the word on its line.
enum class Expected : uint8_t { Statement, Instruction, Operand };

class Completion {
public:
  Completion(const Place& place, std::string_view before)
      : program_(place.program), isLadderText_(isLadderText(place.program, place.file)),
        dialect_(*place.program.dialect()), word_(text::lower(wordBefore(before))),
        expected_(expectedAfter(before.substr(0, before.size() - word_.size()))) {}

  json items() {
    if (expected_ == Expected::Statement)
      for (const frontend::ladder::Keyword& keyword : frontend::ladder::kKeywords)
        add(keyword.word, "", keyword.meaning, ItemKind::Keyword);
    if (expected_ == Expected::Instruction) addInstructions();
    if (expected_ == Expected::Operand) {
      addDefinitions();
      addSignals();
    }
    return {{"isIncomplete", isCut_}, {"items", std::move(items_)}};
  }

private:
  static std::string_view wordBefore(std::string_view before) {
    size_t begin = before.size();
    while (begin > 0 && !source::endsWord(before[begin - 1]) &&
           std::string_view("/@%").find(before[begin - 1]) == std::string_view::npos)
      --begin;
    return before.substr(begin);
  }
  // In a drawing a box begins with its instruction; a list has the instruction first.
  Expected expectedAfter(std::string_view before) const {
    const size_t last = before.find_last_not_of(" \t");
    const bool drawn = dialect_.findBox != nullptr && before.find('|') != std::string_view::npos;
    if (drawn) return last != std::string_view::npos && before[last] == '{' ? Expected::Instruction : Expected::Operand;
    if (last == std::string_view::npos) return isLadderText_ ? Expected::Statement : Expected::Instruction;
    return Expected::Operand;
  }
  void add(std::string_view name, std::string_view detail, std::string_view text, ItemKind kind) {
    if (!text::lower(name).starts_with(word_) || !names_.insert(std::string(name)).second) return;
    if (items_.size() >= kMost) {
      isCut_ = true;
      return;
    }
    json item{{"label", name}, {"kind", static_cast<int>(kind)}};
    if (!detail.empty()) item["detail"] = detail;
    if (!text.empty()) item["documentation"] = text;
    items_.push_back(std::move(item));
  }
  void addInstructions() {
    for (const frontend::InstructionInfo* instruction : dialect_.instructions)
      if (dialect_.isBuilt(*instruction))
        add(instruction->mnemonic, instruction->title, compiler::withoutManualLines(instruction->doc),
            ItemKind::Function);
  }
  void addDefinitions() {
    if (program_.analysis() == nullptr) return;
    for (const frontend::Definition& definition : program_.analysis()->definitions())
      if (definition.range.valid())
        add(definition.name, definition.value, definition.comment,
            definition.isConstant() ? ItemKind::Constant : ItemKind::Variable);
  }
  void addSignals() {
    for (const nc::Signal& signal : dialect_.signals())
      add(signal.symbol, signal.address, signal.meaning, ItemKind::Event);
  }

  Program& program_;
  const bool isLadderText_;
  const frontend::Dialect& dialect_;
  std::string word_; // in lower case
  Expected expected_;
  std::set<std::string> names_;
  json items_ = json::array();
  bool isCut_ = false;
};

} // namespace

json completion(const Place& place) {
  if (place.program.dialect() == nullptr) return json::array();
  const SourceManager& sources = place.program.sources();
  const SourceManager::LineStart start = sources.lineStart(place.at);
  const std::string_view before =
      sources.text(place.file).substr(start.offset, sources.offsetOf(place.at) - start.offset);
  return Completion(place, before).items();
}

} // namespace rung::lsp
