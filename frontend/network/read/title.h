// Which comment is the title of a network. Both source forms: the first line of the last block of comment lines
// before it. Lines without letters or digits are decoration; a comment that begins with a further ';' and a section
// are not titles; any statement in between begins anew.
#pragma once
#include <optional>
#include <string_view>

namespace rung::frontend::network {

// `section "text"` in a comment of a command list is ladder text's statement: its text.
std::optional<std::string_view> sectionIn(std::string_view comment);
// Whether a comment can be a title.
bool isTitle(std::string_view comment);

class TitleRule {
public:
  void comment(std::string_view text);
  void blank() { inBlock_ = false; }
  // Of one that does not take the title.
  void statement() { *this = {}; }
  std::string_view title() const { return title_; }

private:
  std::string_view title_;
  bool inBlock_ = false; // the line above was a comment with words
};

} // namespace rung::frontend::network
