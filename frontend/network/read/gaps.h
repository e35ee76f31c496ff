// What is between the commands of a program, while it is read: it belongs to what comes next.
#pragma once
#include "frontend/network/program.h"
#include "frontend/syntax/word_lexer.h"

namespace rung::frontend::network {

// A comment as an item has it: control characters become blanks, blanks at the ends go.
std::string clean(std::string_view text);

// A comment, or the section that it is.
Item commentItem(std::string_view text);

class Gaps {
public:
  // Until then nothing is kept.
  void keep() { kept_ = true; }
  bool areKept() const { return kept_; }

  void comment(std::string_view text);
  void blank() { add({Item::Kind::Blank}); }
  // It says something before all other statements; elsewhere its comment stays.
  void dialect(std::string_view comment);
  // `symbol` or `const`, and the comment after it.
  void declaration(Item::Kind kind, const Word& name, const Word& value, std::string_view comment);
  void section(std::string_view title, std::string_view comment);
  // That of a rung: in a list it is the first line of the last block of comment lines.
  void title(std::string_view text);
  // After the word that a rung begins with. A section goes before the title, which it would take away.
  void remark(std::string_view text);
  // What belongs to an end, which ladder text does not have.
  void giveBack(Gap&& gap);

  // For a network or a unit.
  Gap take();
  // Comments for a command inside a network, whose gap gets the statements: they go before everything that is there, as
  // after a title they would take it away.
  std::vector<std::string> takeComments(Gap& network);

private:
  void add(Item&& item) {
    if (kept_) gap_.push_back(std::move(item));
  }

  bool kept_ = false;
  bool begun_ = false; // there was a statement
  Gap gap_;
};

} // namespace rung::frontend::network
