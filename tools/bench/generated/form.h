// A work in the language of a dialect.
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
  std::string file; // its ending says the dialect
  std::string text;
  int msAScan = 0;
  // Where the program keeps what the work numbers. Tables one after the other.
  std::vector<std::string> bits{}, words{}, tables{}, reals{};
  std::vector<std::pair<std::string, uint64_t>> constants{}; // written before the first scan
};

// One instruction, for a table of what each costs: rungs that are all the same.
struct Instruction {
  const char* title;
  const char* text; // of one rung; form.cpp says what {…} means
};

class Form {
public:
  virtual ~Form() = default;
  // Fails where the control has no room for it, or no such thing.
  virtual Result<Program> write(const Work& work) const = 0;
  virtual std::vector<Instruction> instructions() const = 0;
  // `count` rungs of that text (0: the empty program). `bits` are their conditions.
  virtual Program repeat(const std::string& text, uint32_t count) const = 0;
};

inline constexpr std::string_view kDialects[] = {"nct", "gsk", "technol"};
std::unique_ptr<Form> formOf(std::string_view dialect); // null: there is no such dialect
std::unique_ptr<Form> nctForm();
std::unique_ptr<Form> gskForm();
std::unique_ptr<Form> technolForm();

// Which of `count` conditions a rung has: neighbours do not have neighbours.
constexpr uint32_t conditionOf(uint32_t rung, uint32_t count) { return 7 * rung % count; }

// The text with each {name} replaced.
std::string filled(std::string text, const std::vector<std::pair<std::string, std::string>>& values);

} // namespace rung::bench
