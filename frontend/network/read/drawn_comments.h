// Comments of a drawing, and the commands to which they belong: by their position, or by a tag if a command has no
// position in the drawing or shares it (docs/dialects/gsk.md):
//   ; [A] text               after the command of contact [A]; its second one is [A]#2
//   ; -> {TMRB preset} text  a comment line before the parameter `preset`
// A comment in this form whose tag names nothing is an ordinary comment.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "frontend/ladder/text/ladder_file.h"
#include "frontend/network/program.h"

namespace rung::frontend::network {

// The commands of the first and the last element of a line; kNone if it has none.
struct LineEnds {
  uint32_t first = kNone;
  uint32_t last = kNone;

  // The places of two commands of the line must compare as their columns do.
  template <class PlaceOf>
  void add(uint32_t command, PlaceOf placeOf) {
    if (first == kNone || placeOf(command) < placeOf(first)) first = command;
    if (last == kNone || placeOf(last) < placeOf(command)) last = command;
  }
};

// Whether a drawing has an element for the command.
constexpr bool isElement(Command command) {
  return isContact(command) || isCoil(command) || command == Command::Function;
}
// Whether a drawing can hold an operand: names of some languages have characters of drawings.
bool canBeDrawn(std::string_view operand);
// An operand in a drawing: in quotes if it begins with what is a mark there.
std::string drawnOperand(std::string_view operand);
// Its element, "[/A]", "(S B)"; functions are "{TMRB}".
std::string elementText(Command command, std::string_view operand);

// A unique tag for every command of a network; blocks are "[ORB]".
std::vector<std::string> tagsOf(const Language& language, const Network& network);
inline constexpr std::string_view kBefore = "->"; // before a tag: a comment line
// Whether a comment has the form of one with a tag.
bool looksTagged(std::string_view comment);

// The hint of blocks (canonical.h): the line after the word `rung`.
std::optional<std::vector<Logic>> blocksIn(const Language& language, const ladder::Rung& rung);
// Adds the comments of a rung to the network that it draws, except a hint that was used.
void attachComments(const Language& language, const ladder::Rung& rung, Network& network);

// Determines which comment is the title of a network. In both source forms: the first line of the last block of comment
// lines before it. Lines without letters or digits are decoration; a comment that begins with a further ';' and a
// section are not titles; any statement in between begins a new search.

// `section "text"` in a comment of a command list is the statement of ladder text: its text.
std::optional<std::string_view> sectionIn(std::string_view comment);
// Whether a comment can be a title.
bool isTitle(std::string_view comment);

class TitleRule {
public:
  void comment(std::string_view text);
  void blank() { inBlock_ = false; }
  // A statement other than the one that takes the title.
  void statement() { *this = {}; }
  std::string_view title() const { return title_; }

private:
  std::string_view title_;
  bool inBlock_ = false; // the line above was a comment with words
};

} // namespace rung::frontend::network
