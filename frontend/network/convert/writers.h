// A program as text: what the readers of both forms keep of it, and the writers of both.
#pragma once
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "frontend/network/program.h"
#include "frontend/syntax/page.h"

namespace rung::frontend::network {

// A program without errors, with everything that its author wrote. Both forms are read into it and written from it.

struct SourceProgram {
  const SourceManager& sources;
  Program program;
  Gap preamble;                        // up to the last declaration before all networks; includes the only Dialect
  Gap tail;                            // after all networks
  std::vector<Item> declarations = {}; // of a list that has them in sections
  std::deque<std::string> values = {}; // of constants, that are operands in their place
};

SourceProgram readSource(const Language& language, SourceManager& sources, std::span<const FileId> files);

// Makes a program one that a list can have: if lists have their declarations in sections, they leave the gaps, and the
// values of constants, which such lists do not have, take their place.
void prepareForList(const Language& language, SourceProgram& source);
std::string writeList(const Language& language, const SourceProgram& source);
std::string writeLadder(const Language& language, const SourceProgram& source);

// Gaps as text, for the writers of both forms.

enum class Form : uint8_t { List, Ladder };

// A command of a list with its operand, which may be empty.
std::string commandText(const Language& language, Command command, std::string_view operand);

// The text of a program, formatted as by `rungc format`.
class GapPage {
public:
  GapPage(const Language& language, Form form)
      : language_(language), form_(form), lines_({}, form == Form::List ? language.list.commentColumn : 0) {}
  void line(std::string_view text, std::string_view comment = {}) { lines_.line(std::string(text), remark(comment)); }
  void comment(std::string_view text) { lines_.comment(text.empty() ? ";" : std::string("; ").append(text)); }
  void blank() { lines_.blank(); }
  void gap(const Gap& gap);
  std::string take() { return lines_.take(); }

private:
  static std::string remark(std::string_view comment) {
    return comment.empty() ? std::string() : std::string("; ").append(comment);
  }
  void item(const Item& item);
  void declaration(const Item& item);
  bool isInBlock(const Item& item) const;

  const Language& language_;
  Form form_;
  Page lines_;
};

// Removes blank lines at both ends, merges others, and separates sections.
Gap tidy(const Gap& gap);
// `gap`, in which every comment that would be mistaken for the title gets another ';'.
Gap protect(Gap gap, std::string_view title);
// The index of the comment that the rule of titles finds; nullopt if there is none.
std::optional<size_t> titleIn(const Gap& gap);

} // namespace rung::frontend::network
