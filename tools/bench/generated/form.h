// A generated work written in the language of a dialect.
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ir/support/result.h"
#include "tools/bench/generated/work.h"

namespace rung::bench {

struct Program {
  std::string file; // its ending selects the dialect
  std::string text;
  int msAScan = 0;
  // Where the program keeps the numbered bits, words, tables and reals of the work. The entries of all tables follow
  // one another.
  std::vector<std::string> bits{}, words{}, tables{}, reals{};
  std::vector<std::pair<std::string, uint64_t>> constants{}; // written before the first scan
};

// One instruction of the table of instruction costs: a program of identical rungs.
struct Instruction {
  const char* title;
  const char* text; // text of one rung; form.cpp explains {…}
};

class Form {
public:
  virtual ~Form() = default;
  // The work as a program of this dialect. Fails if the control lacks the memory or the elements for it.
  virtual Result<Program> write(const Work& work) const = 0;
  virtual std::vector<Instruction> instructions() const = 0;
  // A program of `count` rungs with that text (0: an empty program). `bits` are the conditions of the rungs.
  virtual Program repeat(const std::string& text, uint32_t count) const = 0;
};

inline constexpr std::string_view kDialects[] = {"nct", "gsk", "technol"};
std::unique_ptr<Form> formOf(std::string_view dialect); // null: unknown dialect
std::unique_ptr<Form> nctForm();
std::unique_ptr<Form> gskForm();
std::unique_ptr<Form> technolForm();

// Which of `count` conditions a rung has: neighbouring rungs have conditions that are not neighbours.
constexpr uint32_t conditionOf(uint32_t rung, uint32_t count) { return 7 * rung % count; }

// The text with each {name} replaced.
std::string filled(std::string text, const std::vector<std::pair<std::string, std::string>>& values);

} // namespace rung::bench
