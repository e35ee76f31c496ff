// Structures of a program: `NAME struc`, members, `NAME ends`, and data of such a type: `V NAME <1,2>` (man. l.4074,
// l.7423, l.13525). Members follow one another without padding; a member's name is the constant of its offset in bytes.
#pragma once

#include "frontend/dialects/technol/read/structure.h"

namespace rung::frontend::technol {

inline constexpr int64_t kMaxData = 16 << 20; // bytes; more than any control has, limits offsets

class Structures {
public:
  Structures(ReadContext& context, const Structure& structure, uint32_t file)
      : c_(context), structure_(structure), file_(file) {}

  // Takes lines from `NAME struc` to `NAME ends`; false for any other line. A statement of the language within a
  // structure ends it with a report.
  bool line(std::span<const Token> tokens);
  bool isOpen() const { return open_; }
  // Called when something else follows: the structure was not closed.
  void abandon(SourceRange at, std::string_view found);

  // The structure that a word names, in Declarations::structures; kNone if there is none.
  uint32_t find(const Token& word) const;
  // The initial memory of `<a,b>`, `?` or `n DUP(<a,b>)`; after a report still with the size of the structure.
  std::vector<uint8_t> instance(uint32_t structure, std::span<const Token> value, SourceRange otherwise);

private:
  // The type of one value: a number of bytes, or a structure.
  struct Element {
    uint32_t bytes = 1;
    uint32_t structure = kNone;
  };

  void begin(const Token& name, const Token& keyword);
  void end(const Token& name);
  bool isMember(std::span<const Token> tokens);
  void member(const Token* name, const Token& keyword, Element element, std::span<const Token> value);
  bool values(Element element, std::span<const Token> tokens, SourceRange otherwise, std::vector<uint8_t>& out);
  bool value(Element element, std::span<const Token> tokens, SourceRange otherwise, std::vector<uint8_t>& out);
  bool repeated(Element element, std::span<const Token> tokens, size_t dup, std::vector<uint8_t>& out);
  bool fields(uint32_t structure, std::span<const Token> tokens, SourceRange otherwise, std::vector<uint8_t>& out);
  bool number(uint32_t bytes, std::span<const Token> tokens, SourceRange otherwise, std::vector<uint8_t>& out);
  bool room(int64_t bytes, SourceRange at);
  bool syntax(std::string_view expected, std::span<const Token> tokens, SourceRange otherwise);

  ReadContext& c_;
  const Structure& structure_;
  uint32_t file_;
  bool open_ = false;
  bool full_ = false;
  Token name_;
  StructureType made_;
};

} // namespace rung::frontend::technol
