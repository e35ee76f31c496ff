// The commands at the prompt of `rungc replay`: moving in the past of a program, and looking at it.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/simulated_nc.h"
#include "tools/replay/condition.h"
#include "tools/replay/past.h"
#include "tools/scenario/console.h"

namespace rung::replay {

class Console final : public scenario::Interpreter {
public:
  // The past outlives it.
  Console(Past& past, scenario::Print print);

  scenario::Outcome execute(std::string_view line) override;
  std::string prompt() const override;
  std::vector<std::string> completions(std::string_view line) override;
  std::string_view greeting() const override {
    return "The past of a program; Tab completes, help lists the commands, quit ends.";
  }

  // The place of a name in the program of the present position.
  Result<runtime::Ref> locate(std::string_view name) const;
  // "NAME = VALUE" at the present position.
  Result<std::string> shown(const std::string& name);
  // Writes the values of names in parts `from` to `to` to FILE.vcd or FILE.csv; without names, all that rungs use. Or a
  // scenario that does the same to FILE.scn. A sentence for each thing that the file lacks.
  Result<std::vector<std::string>> exportTo(const std::string& path, uint64_t from, uint64_t to,
                                            std::vector<std::string> names);
  // `NAME`, `NAME @ SCAN`. The error says what is wrong.
  Result<std::string> why(std::span<const std::string> words, bool asJson);
  // Where the condition begins to hold, in all of the recording; at most `most`.
  Result<std::vector<uint64_t>> findAll(std::string_view condition, size_t most);

private:
  using Words = std::span<const std::string>;
  struct Command {
    std::string_view word, form, meaning;
    bool takesNames = false;
    scenario::Outcome (Console::*run)(Words words) = nullptr;
  };
  static std::span<const Command> commands();
  scenario::Outcome fail(const std::string& message);
  scenario::Outcome say(const std::string& text);
  scenario::Outcome arrived(const std::string& problem);

  scenario::Outcome scan(Words words);
  scenario::Outcome time(Words words);
  scenario::Outcome next(Words words) { return move(words, true); }
  scenario::Outcome back(Words words) { return move(words, false); }
  scenario::Outcome show(Words words);
  scenario::Outcome rung(Words words);
  scenario::Outcome find(Words words);
  scenario::Outcome whyCommand(Words words);
  scenario::Outcome writes(Words words);
  scenario::Outcome marks(Words words);
  scenario::Outcome faults(Words words);
  scenario::Outcome messages(Words words);
  scenario::Outcome compare(Words words);
  scenario::Outcome exportCommand(Words words);
  scenario::Outcome help(Words words);
  scenario::Outcome quit(Words) { return scenario::Outcome::Quit; }
  std::vector<std::string> gaps(uint64_t from, uint64_t to) const;
  Result<std::vector<std::string>> exportScenario(const std::string& path, uint64_t from, uint64_t to);
  Result<std::vector<std::string>> exportTrace(const std::string& path, uint64_t from, uint64_t to,
                                               std::vector<std::string> names);
  scenario::Outcome move(Words words, bool forwards);
  scenario::Outcome moveByRungs(uint64_t count, bool forwards, bool byTask);
  bool ranToRung();
  std::string landmarkText(const Landmark& landmark) const;

  Past& past_;
  scenario::Print print_;
  std::unique_ptr<sim::SimulatedNc> nc_;
  std::string condition_; // the last one of find
  // Within the part that has led to the position: so many runs of rungs are done. Nothing: all of it.
  std::optional<size_t> runs_;
  size_t runCount_ = 0; // of that part
};

} // namespace rung::replay
