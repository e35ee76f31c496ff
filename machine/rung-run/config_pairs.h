// The option --config, a list of KEY=VALUE.
#pragma once
#include <stdexcept>
#include <string>
#include <vector>

namespace rung::rung_run {

struct WrongOption : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Passes each pair to `set(key, value)`, which returns "" or an error. Throws WrongOption with that error, or if a text
// is not a pair.
template <class Set>
void forPairs(const std::vector<std::string>& pairs, const Set& set) {
  for (const std::string& pair : pairs) {
    const size_t equals = pair.find('=');
    if (equals == std::string::npos) throw WrongOption("--config: found " + pair + ", expected KEY=VALUE");
    const std::string wrong = set(pair.substr(0, equals), pair.substr(equals + 1));
    if (!wrong.empty()) throw WrongOption("--config: " + wrong);
  }
}

} // namespace rung::rung_run
