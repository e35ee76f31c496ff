// Random GSK programs without errors, as command lists: all functions of the table with their parameters, any balanced
// logic, regions, labels, calls, names, and comments wherever one may stand. The same seed gives the same program.
#pragma once
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "frontend/dialects/gsk/rows/instructions.h"

namespace rung::frontend::gsk::test {

class ProgramGenerator {
public:
  explicit ProgramGenerator(uint64_t seed) : random_(seed) {}

  std::string list();
  // Ladder text with comments, remarks and blank lines put in at random.
  std::string decorated(const std::string& ladder);

private:
  uint32_t below(uint32_t n) { return static_cast<uint32_t>(random_() % n); }
  bool chance(uint32_t percent) { return below(100) < percent; }
  template <class T>
  const T& one(const std::vector<T>& of) {
    return of[below(static_cast<uint32_t>(of.size()))];
  }

  std::string comment();
  void line(const std::string& statement);
  void between();
  void declarations();
  std::string bit(bool written);
  std::string respelled(std::string operand, const frontend::OperandKindInfo* kind);
  void logic(uint32_t values);
  void block(uint32_t contacts, uint32_t depth);
  void coils();
  void function(const Row& row);
  void function(const std::string& name, const std::string& parameter = {});
  void network();
  void region();
  void jump();
  void unit(uint32_t networks);

  std::mt19937_64 random_;
  std::string text_;
  std::vector<std::string> bits_;
  std::vector<std::string> constants_;
  std::vector<uint32_t> subprograms_; // that may be called from here
  uint32_t label_ = 0;
  uint32_t step_ = 0;
  bool numbered_ = false;
  bool inCom_ = false;
  bool inJmp_ = false;
};

} // namespace rung::frontend::gsk::test
