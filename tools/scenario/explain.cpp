// Explanation of a value (see explain.h).
#include "tools/scenario/explain.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

#include "ir/support/put.h"
#include "rtlib/load/program_info.h"
#include "rtlib/nc/names/names.h"
#include "tools/report/place_names.h"
#include "tools/scenario/values.h"

namespace rung::scenario {
namespace {

using ir::BitRange;
using ir::Use;
using report::bitsOf;
using report::refOf;
using report::shownName;
using report::shownRange;
using runtime::Ref;

// Limits of the text; omitted entries are counted.
constexpr size_t kWriters = 3;
constexpr size_t kListedWriters = 8; // of those that are only named
constexpr size_t kNames = 12;        // names that a writing rung reads
constexpr size_t kOthers = 2;        // rungs that decide whether it runs, call its routine, or pass it a register
constexpr size_t kOtherNames = 6;    // names that each of them reads
constexpr size_t kCopies = 4;        // followed from image to image

// A place of the same kind at another position.
Ref moved(Ref place, const BitRange& to) {
  place.space = to.space.index;
  place.byte = to.first / 8;
  place.bit = static_cast<uint8_t>(to.first % 8);
  return place;
}

std::vector<uint32_t> firstOf(std::vector<uint32_t> rungs, size_t most) {
  if (rungs.size() > most) rungs.resize(most);
  return rungs;
}

enum class Forced : uint8_t { No, Part, All };

class Explanation {
public:
  // `beginning`: the scan from which changes are known.
  Explanation(const Session& session, const ir::Uses& uses, const Changes& changes, std::string beginning)
      : session_(session), instance_(session.instance()), program_(instance_.program()), uses_(uses), changes_(changes),
        beginning_(std::move(beginning)) {}

  std::string of(const Ref& place) {
    expected_ = bitsOf(place);
    if (instance_.faulted()) line(4, "the program has stopped with a fault: {}", instance_.faultText());
    if (instance_.stopped()) line(4, "the program is stopped");
    line(4, "{}{}{}", shownName(program_, place), forceOf(place), age(place));
    sources(place, 0);
    return std::move(text_);
  }

private:
  template <class... Args>
  void line(int indent, fmt::format_string<Args...> format, Args&&... args) {
    text_ += "\n" + std::string(static_cast<size_t>(indent), ' ');
    rung::put(text_, format, std::forward<Args>(args)...);
  }
  std::string rungText(uint32_t rung) const { return runtime::rungText(program_, rung); }

  Forced forcedOf(const BitRange& bits) const;
  std::string forceOf(const Ref& place) const;
  std::string age(const Ref& place) const;
  void sources(const Ref& place, size_t copies);
  void writer(uint32_t rung, bool computed);
  void listed(const std::vector<uint32_t>& rungs);
  void registers(uint32_t rung);
  void others(std::string_view role, const std::vector<uint32_t>& rungs);
  void reads(int indent, uint32_t rung, size_t most);
  std::optional<std::string> nameLine(const Use& use) const;

  const Session& session_;
  const runtime::Instance& instance_;
  const rung_program& program_;
  const ir::Uses& uses_;
  const Changes& changes_;
  std::string beginning_;
  BitRange expected_;
  std::string text_;
};

// A force applies to a cell and to everything that it is copied to or from.
Forced Explanation::forcedOf(const BitRange& bits) const {
  const auto isForced = [&](uint32_t bit) {
    const core::Place at = instance_.memory().locateBit(bits.space.index, bit / 8, bit % 8);
    return !at.outside() && std::ranges::any_of(instance_.forcedBits(), [&](const core::ForcedBits& forced) {
      return forced.offset == at.offset() && (forced.mask >> at.bit() & 1) != 0;
    });
  };
  uint32_t count = 0;
  for (uint32_t i = 0; i < bits.count; ++i) count += isForced(bits.first + i) ? 1 : 0;
  if (count == 0) return Forced::No;
  return count == bits.count ? Forced::All : Forced::Part;
}

// " is forced to 1"
std::string Explanation::forceOf(const Ref& place) const {
  switch (forcedOf(bitsOf(place))) {
  case Forced::No: return {};
  case Forced::Part: return ", a part of which is forced";
  case Forced::All: break;
  }
  return " is forced to " + show(readValue(instance_, session_.nc().control(), place, false));
}

// ", changed in scan 5 (0.050 s)"
std::string Explanation::age(const Ref& place) const {
  if (changes_.pending(instance_, bitsOf(place))) return fmt::format(", set after scan {}", changes_.scan());
  const auto last = changes_.last(instance_, bitsOf(place));
  if (!last) return {};
  if (last->number == 0) return ", unchanged since " + beginning_;
  return fmt::format(", changed in {}", scanText(last->number, last->us));
}

// ---- writers -------------------------------------------------------------------------------------------------------

// Explains the rungs that write the place, or those that write the source of its copy.
void Explanation::sources(const Ref& place, size_t copies) {
  const ir::Uses::Writers writers = uses_.writersOf(bitsOf(place));
  std::vector<uint32_t> all = writers.certain;
  all.insert(all.end(), writers.computed.begin(), writers.computed.end());
  for (size_t i = 0; i < std::min(all.size(), kWriters); ++i) writer(all[i], i >= writers.certain.size());
  if (all.size() > kWriters) listed({all.begin() + kWriters, all.end()});
  if (!all.empty()) return;
  for (const BitRange& from : uses_.copiedFrom(bitsOf(place))) {
    const Ref source = moved(place, from);
    if (copies >= kCopies || from == expected_ || uses_.writersOf(from).none()) continue;
    line(4, "copied from {}", shownName(program_, source));
    return sources(source, copies + 1);
  }
  line(4, "{}",
       report::isWrittenByControl(program_, uses_, place) ? "written by the control or the machine, by no rung"
                                                          : "written by no rung");
}

void Explanation::writer(uint32_t rung, bool computed) {
  line(4, "{} {}", computed ? "may be written, at a computed address, by" : "written by", rungText(rung));
  reads(6, rung, kNames);
  registers(rung);
  others("whether it is reached is decided in", uses_.decidersOf(rung));
  others("the subprogram is called in", uses_.callersOf(rung));
}

void Explanation::listed(const std::vector<uint32_t>& rungs) {
  for (uint32_t rung : firstOf(rungs, kListedWriters)) line(4, "also by {}", rungText(rung));
  if (rungs.size() > kListedWriters) line(4, "and by {} more", rungs.size() - kListedWriters);
}

// ---- values that they read -----------------------------------------------------------------------------------------

// Earlier rungs whose register this one uses. Rungs added by the compiler, such as the one that reads the clock for all
// timers, are not shown: they are in no drawing, and a mistake of the program cannot be there.
void Explanation::registers(uint32_t rung) {
  std::vector<uint32_t> from = uses_.registersFrom(rung);
  std::erase_if(from, [&](uint32_t one) { return program_.rungs[one].number == 0; });
  others("it uses the result of", from);
  if (!from.empty() && from.size() <= kOthers && uses_.calls(from.back()))
    line(8, "and of the routine that is called there");
}

void Explanation::others(std::string_view role, const std::vector<uint32_t>& rungs) {
  for (uint32_t rung : firstOf(rungs, kOthers)) {
    line(6, "{} {}", role, rungText(rung));
    reads(8, rung, kOtherNames);
  }
  if (rungs.size() > kOthers) line(6, "and {} more", rungs.size() - kOthers);
}

void Explanation::reads(int indent, uint32_t rung, size_t most) {
  std::vector<std::string> names;
  for (const Use& use : uses_.of(rung)) {
    if (use.writes || use.place == expected_) continue;
    auto name = nameLine(use);
    if (name && std::ranges::find(names, *name) == names.end()) names.push_back(std::move(*name));
  }
  for (size_t i = 0; i < std::min(names.size(), most); ++i) line(indent, "{}", names[i]);
  if (names.size() > most) line(indent, "and {} more", names.size() - most);
}

// Nothing for areas without names, unless the place was copied from one that has them.
std::optional<std::string> Explanation::nameLine(const Use& use) const {
  const std::optional<BitRange> shown = report::knownPlace(program_, uses_, use.place);
  if (!shown) return std::nullopt;
  if (use.computed) return shownRange(program_, *shown) + ", at a computed address";
  const Ref place = nc::meant(program_, refOf(use));
  const Forced forced = forcedOf(use.place);
  return fmt::format("{} = {}{}{}", shownName(program_, moved(place, *shown)),
                     show(readValue(instance_, session_.nc().control(), place, false)),
                     forced == Forced::All    ? ", forced"
                     : forced == Forced::Part ? ", forced in part"
                                              : "",
                     age(place));
}

} // namespace

std::string Explainer::why(std::string_view name, bool wantReal) const {
  std::optional<Ref> place = session_.nc().readPlace(session_.instance().program(), name);
  if (place && wantReal) place = runtime::asReal(session_.instance().memory(), *place).value_or(*place);
  if (uses_ == nullptr || !place || place->kind == runtime::RefKind::Constant) return {};
  const Changes::Scan begin = changes_->begin();
  std::string since = since_.empty() ? "the start" : fmt::format("{}{}", since_, scanText(begin.number, begin.us));
  return Explanation(session_, *uses_, *changes_, std::move(since)).of(*place);
}

} // namespace rung::scenario
