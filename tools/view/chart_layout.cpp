// The geometry of a chart (see layout.h): its parts from top to bottom on one line of control, what ends a wait beside
// the bar below the part, jumps on lanes to the left.
#include <algorithm>
#include <map>

#include "tools/view/layout.h"

namespace rung::view {

namespace {

using frontend::chart::kNone;
using frontend::chart::Line;
using frontend::chart::Part;

constexpr int kLane = 14;    // between lanes
constexpr int kPad = 10;     // within boxes
constexpr int kHead = 22;    // of a box
constexpr int kLeast = 220;  // width of a box
constexpr int kMost = 520;   // width of its texts
constexpr int kNumber = 40;  // width of the numbers of rungs
constexpr int kSpine = 36;   // x of the line of control in a box
constexpr int kBar = 14;     // half the length of a bar
constexpr int kBetween = 18; // from a box to the next one without a wait, from a box to a bar
constexpr int kMostCondition = 560;

// A text of a part.
struct Words {
  std::vector<std::string> lines;
  const Line* line = nullptr;
};

// The heights of a part.
struct Placed {
  int top = 0;
  int height = 0;
  int bar = 0; // 0: none
  std::vector<Words> words;
  std::vector<int> baselines; // of the first line of each
  std::vector<std::string> until;
  std::vector<std::string> remark;
};

// A jump; `part` is where it begins.
struct Arrow {
  uint32_t part = 0;
  uint32_t target = 0;
  int y = 0;
  bool fromBar = false;
};

std::string headOf(const Part& part) {
  std::string head;
  if (!part.states.empty()) head = part.states.size() > 1 ? "Steps" : "Step";
  for (size_t i = 0; i < part.states.size(); ++i)
    head.append(i == 0 ? " " : ", ").append(std::to_string(part.states[i]));
  if (part.end) head.append(head.empty() ? "" : ": ").append("end");
  if (!part.label.empty()) head.append(head.empty() ? "" : "  ").append(part.label);
  return head;
}

class ChartLayout {
public:
  explicit ChartLayout(const Chart& chart) : chart_(chart), parts_(chart.sequence.parts) {}

  Picture run();

private:
  void place();
  void placePart(const Part& part);
  void findArrows();
  void findLanes();
  void draw();
  void drawPart(uint32_t index);
  void drawBelow(uint32_t index);
  void drawArrows();
  void text(int x, int y, Style style, std::string_view text, Link link = {});
  int entryOf(uint32_t part) const { return placed_[part].top + kHead / 2; }

  const Chart& chart_;
  const std::vector<Part>& parts_;
  std::vector<Placed> placed_;
  std::vector<Arrow> arrows_;
  std::map<uint32_t, int> laneOf_; // by target
  int lanes_ = 0;
  int left_ = 0; // x of the boxes
  int width_ = kLeast;
  int y_ = 4;
  Picture picture_;
};

void ChartLayout::placePart(const Part& part) {
  Placed placed{.top = y_};
  int y = y_ + kHead + 4;
  width_ = std::max(width_, widthOf(headOf(part), Style::Title) + 2 * kPad);
  const auto put = [&](std::vector<std::string> lines, Style style, int indent, const Line* line) {
    if (lines.empty()) return;
    for (const std::string& one : lines) width_ = std::max(width_, indent + widthOf(one, style) + kPad);
    placed.baselines.push_back(y + static_cast<int>(infoOf(style).size));
    y += static_cast<int>(lines.size()) * lineHeight(style) + 3;
    placed.words.push_back({std::move(lines), line});
  };
  put(wrap(part.title, Style::Note, kMost), Style::Note, kPad, nullptr);
  for (const Line& line : part.lines) put(wrap(line.text, Style::Pin, kMost), Style::Pin, kNumber, &line);
  placed.height = placed.words.empty() ? kHead : y + 3 - y_;
  y_ += placed.height + kBetween;
  if (!part.until.empty()) {
    placed.bar = y_;
    placed.until = wrap(part.until, Style::Name, kMostCondition);
    placed.remark = wrap(part.remark, Style::Remark, kMostCondition);
    const int below = static_cast<int>(placed.until.size()) * lineHeight(Style::Name) - 8 +
                      static_cast<int>(placed.remark.size()) * lineHeight(Style::Remark) +
                      (part.otherwise.empty() ? 0 : lineHeight(Style::Note));
    y_ += std::max(below, 0) + kBetween;
  }
  placed_.push_back(std::move(placed));
}

void ChartLayout::place() {
  for (const Part& part : parts_) {
    if (!placed_.empty()) picture_.breaks.push_back(y_ - 4);
    placePart(part);
  }
  picture_.height = placed_.back().top + placed_.back().height + 6;
}

void ChartLayout::findArrows() {
  for (uint32_t i = 0; i < parts_.size(); ++i) {
    for (size_t k = 0; k < placed_[i].words.size(); ++k) {
      const Line* line = placed_[i].words[k].line;
      if (line != nullptr && line->target != kNone)
        arrows_.push_back({i, line->target, placed_[i].baselines[k] - 4, false});
    }
    if (parts_[i].target != kNone) arrows_.push_back({i, parts_[i].target, placed_[i].bar, true});
  }
}

// Arrows to one part are on one lane; lanes that would meet are beside each other, short ones inside.
void ChartLayout::findLanes() {
  struct Reach {
    uint32_t target = 0;
    int top = 0;
    int bottom = 0;
  };
  std::map<uint32_t, Reach> reaches;
  for (const Arrow& arrow : arrows_) {
    const int y = entryOf(arrow.target);
    Reach& reach = reaches.try_emplace(arrow.target, Reach{arrow.target, y, y}).first->second;
    reach.top = std::min(reach.top, arrow.y);
    reach.bottom = std::max(reach.bottom, arrow.y);
  }
  std::vector<Reach> order;
  for (const auto& [target, reach] : reaches) order.push_back(reach);
  std::ranges::stable_sort(order, {}, [](const Reach& reach) { return reach.bottom - reach.top; });
  std::vector<std::vector<Reach>> lanes;
  for (const Reach& reach : order) {
    const auto isFree = [&](const std::vector<Reach>& lane) {
      return std::ranges::none_of(
          lane, [&](const Reach& other) { return reach.top <= other.bottom + 6 && other.top <= reach.bottom + 6; });
    };
    const auto free = std::ranges::find_if(lanes, isFree);
    laneOf_[reach.target] = static_cast<int>(free - lanes.begin());
    (free == lanes.end() ? lanes.emplace_back() : *free).push_back(reach);
  }
  lanes_ = static_cast<int>(lanes.size());
  left_ = 12 + kLane * lanes_ + (lanes_ == 0 ? 0 : 10);
}

void ChartLayout::text(int x, int y, Style style, std::string_view text, Link link) {
  LinkedText whole;
  whole.add(text, link);
  picture_.texts.push_back({{x, y}, Anchor::Start, style, std::move(whole.text), std::move(whole.links)});
  picture_.width = std::max(picture_.width, x + widthOf(text, style) + 8);
}

void ChartLayout::drawPart(uint32_t index) {
  const Part& part = parts_[index];
  const Placed& placed = placed_[index];
  picture_.frames.push_back({{left_, placed.top}, width_, placed.height, kHead});
  if (!part.states.empty())
    picture_.steps.push_back(
        {{left_, placed.top}, width_, placed.height, chart_.sequence.continuation, part.states, chart_.waits[index]});
  text(left_ + kPad, placed.top + 16, Style::Title, headOf(part));
  for (size_t i = 0; i < placed.words.size(); ++i) {
    const Words& words = placed.words[i];
    const Style style = words.line == nullptr ? Style::Note : Style::Pin;
    int y = placed.baselines[i];
    if (words.line != nullptr && words.line->rung != 0)
      text(left_ + kPad, y, Style::Uses, std::to_string(words.line->rung), {Link::To::Rung, words.line->rung});
    for (const std::string& one : words.lines) {
      text(left_ + (words.line == nullptr ? kPad : kNumber), y, style, one);
      y += lineHeight(style);
    }
  }
}

// The line of control to the next part, with its bar.
void ChartLayout::drawBelow(uint32_t index) {
  const Part& part = parts_[index];
  const Placed& placed = placed_[index];
  if (!part.falls || index + 1 == parts_.size()) return;
  const int x = left_ + kSpine;
  picture_.wires.push_back({{x, placed.top + placed.height}, {x, placed_[index + 1].top}});
  if (placed.bar == 0) return;
  picture_.bars.push_back({{x - kBar, placed.bar}, {x + kBar, placed.bar}});
  int y = placed.bar + 4;
  const int beside = x + kBar + 8;
  if (part.rung != 0) {
    const std::string number = std::to_string(part.rung);
    text(beside, y, Style::Uses, number, {Link::To::Rung, part.rung});
  }
  const int words = beside + (part.rung == 0 ? 0 : widthOf(std::to_string(part.rung), Style::Uses) + 8);
  for (const std::string& line : placed.until) {
    text(words, y, Style::Name, line);
    y += lineHeight(Style::Name);
  }
  for (const std::string& line : placed.remark) {
    text(words, y, Style::Remark, line);
    y += lineHeight(Style::Remark);
  }
  if (!part.otherwise.empty()) text(words, y, Style::Note, part.otherwise);
}

void ChartLayout::drawArrows() {
  std::map<uint32_t, std::pair<int, int>> reaches; // by target: of its lane
  for (const Arrow& arrow : arrows_) {
    const int x = left_ - 10 - kLane * (laneOf_[arrow.target] + 1) + 4;
    const int from = arrow.fromBar ? left_ + kSpine - kBar : left_;
    picture_.wires.push_back({{x, arrow.y}, {from, arrow.y}});
    const int y = entryOf(arrow.target);
    auto& [top, bottom] = reaches.try_emplace(arrow.target, std::pair(y, y)).first->second;
    top = std::min(top, arrow.y);
    bottom = std::max(bottom, arrow.y);
  }
  for (const auto& [target, reach] : reaches) {
    const int x = left_ - 10 - kLane * (laneOf_[target] + 1) + 4;
    picture_.wires.push_back({{x, reach.first}, {x, reach.second}});
    picture_.wires.push_back({{x, entryOf(target)}, {left_, entryOf(target)}});
    picture_.arrows.push_back({left_, entryOf(target)});
  }
}

void ChartLayout::draw() {
  for (uint32_t i = 0; i < parts_.size(); ++i) {
    drawPart(i);
    drawBelow(i);
  }
  drawArrows();
}

Picture ChartLayout::run() {
  place();
  findArrows();
  findLanes();
  draw();
  picture_.width = std::max(picture_.width, left_ + width_ + 8);
  return std::move(picture_);
}

} // namespace

Picture layOut(const Chart& chart) { return ChartLayout(chart).run(); }

} // namespace rung::view
