// Reading and matching (see baseline.h).
#include "tools/report/profile_baseline.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

namespace rung::report {
namespace {

using Json = nlohmann::json;

constexpr double kClearShare = 0.01; // of the whole time: a smaller difference of one rung is noise
constexpr double kClearRatio = 1.25;

Row readRow(const Json& json) {
  Row row;
  row.number = json.at("rung");
  const std::string key = json.at("key");
  std::from_chars(key.data(), key.data() + key.size(), row.key, 16);
  row.routine = json.at("routine");
  row.title = json.at("title");
  row.file = json.at("file");
  row.line = json.at("line");
  row.operations = json.value("operations", uint64_t{0});
  row.scans = json.value("scans", uint64_t{0});
  row.meanNs = json.value("mean_ns", 0.0);
  row.time = json.value("time_ns", 0.0);
  return row;
}

Baseline readProfile(const Json& json) {
  Baseline baseline;
  baseline.program = json.at("program");
  baseline.scenarios = json.at("scenarios");
  baseline.scans = json.at("scans");
  baseline.operations = json.at("operations");
  baseline.time = json.at("time_ns");
  baseline.scanOperations.median = json.at("scan_operations").at("median");
  baseline.scanMedianNs = json.at("deadlines").at(0).at("ns").at("median");
  for (const char* list : {"rungs", "added", "never"})
    for (const Json& row : json.at(list)) baseline.rows.push_back(readRow(row));
  return baseline;
}

std::vector<Row> allRows(const ProfileReport& report) {
  std::vector<Row> rows = report.rows;
  rows.insert(rows.end(), report.added.begin(), report.added.end());
  rows.insert(rows.end(), report.never.begin(), report.never.end());
  return rows;
}

// Rows of both profiles, each pair of the same rung. In the order of the programs, so that rungs of one text keep
// theirs.
class Matching {
public:
  Matching(std::vector<Row> now, std::vector<Row> old) : now_(std::move(now)), old_(std::move(old)) {
    for (std::vector<Row>* rows : {&now_, &old_})
      std::stable_sort(rows->begin(), rows->end(), [](const Row& a, const Row& b) { return a.number < b.number; });
    partner_.assign(now_.size(), nullptr);
    taken_.assign(old_.size(), false);
    match([](const Row& row) { return std::to_string(row.key); });
    match([](const Row& row) { return row.title.empty() ? std::string() : row.routine + '\n' + row.title; });
  }

  template <class Pair, class Gone>
  void forEach(Pair pair, Gone gone) const {
    for (size_t i = 0; i < now_.size(); ++i) pair(now_[i], partner_[i]);
    for (size_t i = 0; i < old_.size(); ++i)
      if (!taken_[i]) gone(old_[i]);
  }

private:
  // Pairs what is left and has the same name; an empty name fits nothing.
  template <class Name>
  void match(Name name) {
    std::multimap<std::string, size_t> byName;
    for (size_t i = 0; i < old_.size(); ++i)
      if (!taken_[i]) byName.emplace(name(old_[i]), i);
    for (size_t i = 0; i < now_.size(); ++i) {
      if (partner_[i] != nullptr || name(now_[i]).empty()) continue;
      const auto found = byName.find(name(now_[i])); // the first in the program
      if (found == byName.end()) continue;
      partner_[i] = &old_[found->second];
      taken_[found->second] = true;
      byName.erase(found);
    }
  }

  std::vector<Row> now_;
  std::vector<Row> old_;
  std::vector<const Row*> partner_;
  std::vector<bool> taken_;
};

void sortChanges(Comparison& result) {
  const auto sortBy = [](std::vector<Change>& list, auto measure) {
    std::stable_sort(list.begin(), list.end(),
                     [&](const Change& a, const Change& b) { return measure(a) > measure(b); });
  };
  const auto operations = [](const Change& c) {
    return std::abs(static_cast<double>(c.row.operations) - static_cast<double>(c.oldOperations));
  };
  const auto time = [](const Change& c) {
    return std::abs(c.row.meanNs - c.oldMeanNs) * static_cast<double>(c.row.scans);
  };
  for (std::vector<Change>* list : {&result.more, &result.fewer, &result.added, &result.gone})
    sortBy(*list, operations);
  for (std::vector<Change>* list : {&result.slower, &result.faster}) sortBy(*list, time);
}

} // namespace

Result<Baseline> readBaseline(std::string_view text) {
  const Json json = Json::parse(text, nullptr, false);
  if (json.is_discarded()) return failure("it is not JSON; write it with rungc profile --json");
  if (!json.is_object() || json.value("profile", 0) != 1)
    return failure("it is not a profile; write it with rungc profile --json");
  try {
    return readProfile(json);
  } catch (const Json::exception& error) {
    return failure(std::string("a field of the profile is missing or has another type: ") + error.what());
  }
}

Comparison compare(const ProfileReport& now, Baseline old) {
  Comparison result;
  const Matching matching(allRows(now), old.rows);
  matching.forEach(
      [&](const Row& row, const Row* before) {
        if (before == nullptr) return result.added.push_back({row, 0, 0});
        const Change change{row, before->operations, before->meanNs};
        if (row.operations != before->operations)
          return (row.operations > before->operations ? result.more : result.fewer).push_back(change);
        const double difference = (row.meanNs - before->meanNs) * static_cast<double>(row.scans);
        const double larger = std::max(row.meanNs, before->meanNs);
        const double smaller = std::min(row.meanNs, before->meanNs);
        if (std::abs(difference) < kClearShare * old.time || larger < kClearRatio * smaller) return;
        (difference > 0 ? result.slower : result.faster).push_back(change);
      },
      [&](const Row& before) { result.gone.push_back({before, before.operations, before.meanNs}); });
  sortChanges(result);
  result.old = std::move(old);
  return result;
}

} // namespace rung::report
