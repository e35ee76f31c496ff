// Goldens of many small inputs, where a file for each would hide the whole. A file has them case for case:
//
//   === a name of its own
//   the input, of any number of lines
//   ---
//   what it becomes; nothing, where it becomes nothing
//
//   === the next one
//
// RUNG_UPDATE=1 writes what they become; a new case needs no more than its name and its input, after which comes `---`.
#pragma once
#include <functional>
#include <map>
#include <string>

#include "tests/support/golden.h"

namespace rung::test {

struct Case {
  std::string name;
  std::string input; // without the end of its last line: an input that has it is followed by an empty line
};

// Each case of `file`, an input of `golden`, has become what `become` makes of it. Lines end with '\n'; the last may
// lack it.
void expectCases(Golden& golden, const std::filesystem::path& file,
                 const std::function<std::string(const Case&)>& become);

// Several files in an input, each after a line `>>> NAME`.
std::map<std::string, std::string> filesIn(const std::string& input);

} // namespace rung::test
