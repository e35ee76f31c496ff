// Random FANUC programs without errors, as mnemonic files: all functions of the table with their parameters, any
// balanced logic, levels, regions, labels, calls, symbols, and remarks wherever one may stand. The same seed gives the
// same program.
#pragma once
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "frontend/dialects/fanuc/rows/instructions.h"

namespace rung::frontend::fanuc::test {

class ProgramGenerator {
public:
  explicit ProgramGenerator(uint64_t seed) : random_(seed) {}

  std::string list();

private:
  uint32_t below(uint32_t n) { return static_cast<uint32_t>(random_() % n); }
  bool chance(uint32_t percent) { return below(100) < percent; }
  template <class T>
  const T& one(const std::vector<T>& of) {
    return of[below(static_cast<uint32_t>(of.size()))];
  }

  std::string remark();
  void line(const std::string& statement);
  void between();
  void symbols();
  std::string bit(bool written);
  std::string respelled(const std::string& operand, const frontend::OperandInfo& info);
  void logic(uint32_t values);
  void block(uint32_t contacts, uint32_t room, bool begins);
  void coils();
  void function(const Row& row);
  void function(const std::string& mnemonic, const std::string& parameter = {});
  void network();
  void region();
  void jump();
  void unit(uint32_t networks);

  std::mt19937_64 random_;
  std::string text_;
  std::vector<std::string> bits_;
  std::vector<uint32_t> subprograms_; // that may be called from here
  uint32_t label_ = 0;
  uint32_t net_ = 0;
  bool inCom_ = false;
  bool inJmp_ = false;
};

} // namespace rung::frontend::fanuc::test
