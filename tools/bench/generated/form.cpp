// The forms of the dialects (see form.h). In the text of an instruction {not} is a bit that is always 0; the rung's own
// are: {in} its condition, {out} a bit, {a} {b} {to} words, {x} {y} {z} reals, {state} the instruction's state, {n} a
// number from 1 on.
#include "tools/bench/generated/form.h"

namespace rung::bench {

std::unique_ptr<Form> formOf(std::string_view dialect) {
  if (dialect == "nct") return nctForm();
  if (dialect == "gsk") return gskForm();
  if (dialect == "technol") return technolForm();
  return nullptr;
}

std::string filled(std::string text, const std::vector<std::pair<std::string, std::string>>& values) {
  for (const auto& [name, value] : values) {
    const std::string word = "{" + name + "}";
    for (size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + value.size()))
      text.replace(at, word.size(), value);
  }
  return text;
}

} // namespace rung::bench
