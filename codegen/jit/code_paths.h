// Machine code as a graph, and its longest path. Does not include LLVM.
#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace rung::codegen {

inline constexpr uint32_t kNoLoop = UINT32_MAX;

// Instructions that always run together.
struct CodeBlock {
  uint64_t instructions = 0;
  std::vector<std::string> calls{}; // functions of the same code unit that it calls
  std::vector<uint32_t> next{};
  uint32_t loop = kNoLoop; // the innermost loop that contains it
};

struct CodeLoop {
  uint32_t header = 0;       // the only block through which the loop is entered
  uint32_t parent = kNoLoop; // precedes it in the list
  uint64_t rounds = 0;       // most executions of the header each time the loop is entered
};

struct FunctionCode {
  std::vector<CodeBlock> blocks{}; // the first one is the entry
  std::vector<CodeLoop> loops{};
  std::string unknown{}; // not empty: why its length cannot be determined
};

struct CodeLength {
  uint64_t instructions = 0; // UINT64_MAX: at least this number
  std::string unknown{};
};

// Lengths by function name, each computed once.
class CodeLengths {
public:
  explicit CodeLengths(std::map<std::string, FunctionCode> functions) : functions_(std::move(functions)) {}
  // The length of the longest path through a function.
  const CodeLength& of(const std::string& function);

private:
  std::map<std::string, FunctionCode> functions_;
  std::map<std::string, CodeLength> known_;
};

} // namespace rung::codegen
