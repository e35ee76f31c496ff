// Programs that tools are held against: drawn from seeds, in each dialect.
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "compiler/engines.h"
#include "rtlib/run/instance.h"
#include "tests/random/random_source.h"

namespace rung::truth {

// RUNG_TRUTH=large: the form of `./dev check truth`.
bool isLarge();

struct Text {
  std::string file; // its ending says the dialect
  std::string text;
};

// All instructions of GSK, and what the bench generates in each dialect.
std::vector<Text> drawnTexts();

// A program with what it was made from.
class Program {
public:
  // Empty, after a failure of the test, where it does not compile.
  static std::unique_ptr<Program> of(const Text& text);

  const compiler::Compiled& compiled() const { return *compiled_; }
  const Text& text() const { return text_; }

private:
  explicit Program(const Text& text) : text_(text) {}

  const Text text_;
  SourceManager sources_;
  Diagnostics diagnostics_;
  std::optional<compiler::Compiled> compiled_;
};

// Any contents of the memory that programs see.
void scatter(runtime::Instance& instance, ir::RandomSource& random);

} // namespace rung::truth
