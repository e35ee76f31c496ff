// Finds elements (see elements.h).
#include "tools/replay/elements.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

namespace rung::replay {

// Rungs with the same number are one rung of the source, marks at the same place one element, and marks of it with the
// same text one pin; of several in one rung of the module the first ones of each correspond.
class ElementsBuilder {
public:
  explicit ElementsBuilder(Elements& to) : to_(to) {}

  void add(const ir::Module& module, const ir::Routine& routine, const ir::Rung& rung, std::span<const ir::Mark> marks,
           uint32_t lowered) {
    if (lowered >= to_.codes_.size()) to_.codes_.resize(lowered + 1);
    if (rung.number == 0) return;
    const auto [found, isNew] = rungs_.try_emplace(rung.number, static_cast<uint32_t>(drawn_.size()));
    if (isNew) drawn_.push_back({describe(module, routine, rung), {}});
    Drawn& drawn = drawn_[found->second];
    drawn.rung.lowered.push_back(lowered);
    const std::vector<std::vector<report::Guard>> guards = report::guardsOf(rung);
    std::map<std::tuple<uint32_t, uint32_t, ir::MarkKind, std::string>, uint32_t> seen; // pins so far
    for (const ir::Mark& mark : marks) {
      const uint32_t earlier = seen[{mark.line, mark.column, mark.kind, mark.text}]++;
      const auto [element, pin] = place(drawn, mark, earlier);
      places_.push_back({found->second, element, pin, lowered});
      to_.codes_[lowered].points.push_back({0, mark.value.index, guards[mark.value.index]});
    }
    to_.codes_[lowered].rung = found->second;
  }

  void finish() {
    for (Drawn& drawn : drawn_) {
      drawn.rung.firstElement = static_cast<uint32_t>(to_.elements_.size());
      drawn.rung.elementCount = static_cast<uint32_t>(drawn.elements.size());
      for (Element& element : drawn.elements) {
        element.rung = static_cast<uint32_t>(to_.rungs_.size());
        element.firstPin = to_.pinCount();
        to_.elementOfPin_.resize(to_.pinCount() + element.pins.size(), static_cast<uint32_t>(to_.elements_.size()));
        to_.elements_.push_back(std::move(element));
      }
      to_.rungs_.push_back(std::move(drawn.rung));
    }
    std::vector<size_t> next(to_.codes_.size(), 0);
    for (const At& at : places_)
      to_.codes_[at.lowered].points[next[at.lowered]++].pin =
          to_.elements_[to_.rungs_[at.rung].firstElement + at.element].firstPin + at.pin;
  }

private:
  struct Drawn {
    SourceRung rung;
    std::vector<Element> elements;
  };
  struct At {
    uint32_t rung, element, pin, lowered;
  };

  static SourceRung describe(const ir::Module& module, const ir::Routine& routine, const ir::Rung& rung) {
    SourceRung out;
    out.number = rung.number;
    out.title = rung.title;
    out.routine = ir::homeOf(routine, rung);
    if (rung.begin.file.valid()) out.file = module.files[rung.begin.file.index];
    out.line = rung.begin.line;
    return out;
  }

  static ElementKind kindOf(ir::MarkKind kind) {
    if (kind == ir::MarkKind::Contact) return ElementKind::Contact;
    return kind == ir::MarkKind::Coil ? ElementKind::Coil : ElementKind::Box;
  }

  // The element and its pin; both are added if they are new. `earlier`: marks of the rung that are the same.
  static std::pair<uint32_t, uint32_t> place(Drawn& drawn, const ir::Mark& mark, uint32_t earlier) {
    auto element = std::ranges::find_if(
        drawn.elements, [&](const Element& e) { return e.line == mark.line && e.column == mark.column; });
    if (element == drawn.elements.end()) {
      Element& added = drawn.elements.emplace_back();
      added.kind = kindOf(mark.kind);
      added.line = mark.line;
      added.column = mark.column;
      element = drawn.elements.end() - 1;
    }
    auto pin = element->pins.begin();
    for (;; ++pin) {
      if (pin == element->pins.end()) pin = element->pins.insert(pin, {mark.kind, mark.text});
      if (pin->kind == mark.kind && pin->text == mark.text && earlier-- == 0) break;
    }
    return {static_cast<uint32_t>(element - drawn.elements.begin()),
            static_cast<uint32_t>(pin - element->pins.begin())};
  }

  Elements& to_;
  std::map<uint32_t, uint32_t> rungs_; // by number: index in drawn_
  std::vector<Drawn> drawn_;
  std::vector<At> places_; // of the points, in their order
};

namespace {

struct Home {
  const ir::Routine* routine;
  const ir::Rung* rung;
};

// By number over all routines as built.
std::vector<Home> asBuilt(const ir::Module& module) {
  std::vector<Home> rungs;
  for (const ir::Routine& routine : module.routines)
    for (const ir::Rung& rung : routine.rungs) rungs.push_back({&routine, &rung});
  if (std::ranges::none_of(rungs, [](const Home& home) { return home.rung->origin.index != RUNG_NONE; })) return rungs;
  std::vector<Home> built(rungs.size());
  for (const Home& home : rungs) built[home.rung->origin.index] = home;
  return built;
}

} // namespace

// The name of a routine as built is different from that of the one before, so that its rungs are found by it.
Elements::Elements(const ir::Module& module, const ir::Marks& marks) {
  ElementsBuilder builder(*this);
  const std::vector<Home> rungs = asBuilt(module);
  uint32_t routine = 0, first = 0;
  for (uint32_t i = 0; i < rungs.size(); ++i) {
    if (i > 0 && homeOf(*rungs[i].routine, *rungs[i].rung) != homeOf(*rungs[i - 1].routine, *rungs[i - 1].rung)) {
      ++routine;
      first = i;
    }
    builder.add(module, *rungs[i].routine, *rungs[i].rung, marks.of(ir::RoutineId{routine}, i - first), i);
  }
  builder.finish();
}

} // namespace rung::replay
