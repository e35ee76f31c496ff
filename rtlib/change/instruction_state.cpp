// Matching by rungs, and then by keys (see instruction_state.h).
#include "rtlib/change/instruction_state.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <tuple>
#include <unordered_map>
#include <utility>

namespace rung::runtime {
namespace {

constexpr char kNumber = '~'; // before the number of an instruction, see rung_slot

// The key without numbers, and these: the order of the instructions that are alike.
using Alike = std::pair<std::string, std::vector<uint32_t>>;

Alike alike(std::string_view key) {
  Alike out;
  while (!key.empty()) {
    const size_t at = std::min(key.find(kNumber), key.size());
    out.first += key.substr(0, at);
    key.remove_prefix(std::min(at + 1, key.size()));
    uint32_t number = 0;
    const auto [end, error] = std::from_chars(key.data(), key.data() + key.size(), number);
    key.remove_prefix(static_cast<size_t>(end - key.data()));
    if (error == std::errc()) out.second.push_back(number);
  }
  return out;
}

// Of a rung, those of one key, in the order of their instructions.
using Groups = std::map<std::pair<uint32_t, std::string>, std::vector<std::pair<std::vector<uint32_t>, uint32_t>>>;

Groups grouped(std::span<const InstructionState> all, const std::vector<bool>& done, bool byRung) {
  Groups groups;
  for (uint32_t i = 0; i < all.size(); ++i) {
    if (done[i] || (byRung && all[i].rung == RUNG_NONE)) continue;
    auto [key, numbers] = alike(all[i].key);
    groups[{byRung ? all[i].rung : 0, std::move(key)}].emplace_back(std::move(numbers), i);
  }
  for (auto& [key, members] : groups) std::ranges::sort(members);
  return groups;
}

class Matcher {
public:
  Matcher(std::span<const InstructionState> before, std::span<const InstructionState> after)
      : before_(before), after_(after), isGone_(before.size(), false), isFound_(after.size(), false),
        found_(after.size(), RUNG_NONE) {}

  std::vector<uint32_t> run(std::span<const RungPair> rungs) {
    const Groups former = grouped(before_, isGone_, true);
    const Groups now = grouped(after_, isFound_, true);
    std::unordered_map<uint32_t, uint32_t> formerRung;
    for (const RungPair& pair : rungs) formerRung.emplace(pair.after, pair.before);
    for (const auto& [of, members] : now) {
      const auto rung = formerRung.find(of.first);
      if (rung == formerRung.end()) continue;
      if (const auto there = former.find({rung->second, of.second}); there != former.end())
        pair(there->second, members);
    }
    const Groups left = grouped(before_, isGone_, false);
    for (const auto& [of, members] : grouped(after_, isFound_, false))
      if (const auto there = left.find(of); there != left.end() && there->second.size() == members.size())
        pair(there->second, members);
    return std::move(found_);
  }

private:
  using Members = Groups::mapped_type;

  void pair(const Members& before, const Members& after) {
    for (size_t i = 0; i < std::min(before.size(), after.size()); ++i) {
      isGone_[before[i].second] = isFound_[after[i].second] = true;
      found_[after[i].second] = before[i].second;
    }
  }

  std::span<const InstructionState> before_, after_;
  std::vector<bool> isGone_, isFound_;
  std::vector<uint32_t> found_;
};

} // namespace

std::vector<uint32_t> matchState(std::span<const InstructionState> before, std::span<const InstructionState> after,
                                 std::span<const RungPair> rungs) {
  return Matcher(before, after).run(rungs);
}

std::string withoutNumbers(std::string_view key) { return alike(key).first; }

} // namespace rung::runtime
