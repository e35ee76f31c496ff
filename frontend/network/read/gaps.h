// Collects what is between the commands of a program while it is read: it belongs to the command that follows.
#pragma once
#include "frontend/network/program.h"
#include "frontend/syntax/word_lexer.h"

namespace rung::frontend::network {

// The text of a comment item: control characters become blanks, blanks at the ends are removed.
std::string clean(std::string_view text);

// The item of a comment, or of the section that it contains.
Item commentItem(std::string_view text);

class Gaps {
public:
  // Enables collecting.
  void keep() { kept_ = true; }
  bool areKept() const { return kept_; }

  void comment(std::string_view text);
  void blank() { add({Item::Kind::Blank}); }
  // The statement is kept only before all other statements; elsewhere only its comment is.
  void dialect(std::string_view comment);
  // A declaration and the comment after it.
  void declaration(Item::Kind kind, const Word& name, const Word& value, std::string_view comment);
  void section(std::string_view title, std::string_view comment);
  // The title of a rung: in a list it becomes the first line of the last block of comment lines.
  void title(std::string_view text);
  // A comment after the word that begins a rung. A section is put before the title, because it would end the search for
  // it.
  void remark(std::string_view text);
  // Returns the gap before an end, which ladder text does not have.
  void giveBack(Gap&& gap);

  // For a network or a unit.
  Gap take();
  // Comments for a command within a network, whose gap receives the statements: they are put after the statements with
  // which it begins, because after a title they would end the search for it.
  std::vector<std::string> takeComments(Gap& network);

private:
  void add(Item&& item) {
    if (kept_) gap_.push_back(std::move(item));
  }

  bool kept_ = false;
  bool begun_ = false; // there was a statement before
  Gap gap_;
};

} // namespace rung::frontend::network
