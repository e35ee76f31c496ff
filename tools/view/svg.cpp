// Converts shapes to SVG (see svg.h).
#include "tools/view/svg.h"

#include <algorithm>
#include <array>
#include <map>

#include <fmt/ranges.h>

#include "ir/support/put.h"
#include "tools/view/overlay.h"

namespace rung::view {
namespace {

constexpr int kLeastRail = 560;
constexpr int kMostRail = 880; // x of the right rail; wider drawings are cut
constexpr int kIndent = 24;    // indent of rungs below their captions

void appendRails(std::string& out, const Picture& picture) {
  if (picture.rail == 0) return;
  put(out, R"(<path class="e" d="M{0} {1}v{3}M{2} {1}v{3}"/>)", kLeft, picture.top, picture.rail, picture.height);
}

void appendLine(std::string& out, const Line& line) {
  put(out, "M{} {}", line.from.x, line.from.y);
  if (line.from.y == line.to.y)
    put(out, "h{}", line.to.x - line.from.x);
  else
    put(out, "v{}", line.to.y - line.from.y);
}

void appendDots(std::string& out, const Picture& picture) {
  if (picture.dots.empty()) return;
  out += "<path class=\"d\" d=\"";
  for (Point dot : picture.dots) put(out, "M{} {}h0", dot.x, dot.y);
  out += "\"/>";
}

void appendWires(std::string& out, const Picture& picture) {
  out += "<path class=\"w\" d=\"";
  for (const Line& line : picture.wires) appendLine(out, line);
  out += "\"/>";
  appendDots(out, picture);
}

void appendSymbol(std::string& out, const Symbol& symbol) {
  const int x = symbol.left.x;
  const int top = symbol.left.y - kSymbolHalf;
  const int height = 2 * kSymbolHalf;
  if (symbol.glyph == Glyph::Contact) {
    put(out, "M{} {}v{}M{} {}v{}", x, top, height, x + symbol.width, top, height);
  } else {
    put(out, "M{} {}a14.6 14.6 0 0 0 0 {}", x + 5, top, height);
    put(out, "M{} {}a14.6 14.6 0 0 1 0 {}", x + symbol.width - 5, top, height);
  }
  const int in = symbol.glyph == Glyph::Contact ? 1 : 5;
  if (symbol.slash) put(out, "M{} {}l{} {}", x + in, top + height - 3, symbol.width - 2 * in, 6 - height);
}

void appendSymbols(std::string& out, const Picture& picture) {
  if (picture.symbols.empty()) return;
  out += "<path class=\"s\" d=\"";
  for (const Symbol& symbol : picture.symbols) appendSymbol(out, symbol);
  out += "\"/>";
}

void appendFrames(std::string& out, const Picture& picture) {
  for (const Frame& frame : picture.frames) {
    put(out, R"(<path class="h" d="M{} {}h{}v{}h-{}z"/>)", frame.corner.x, frame.corner.y, frame.width, frame.head,
        frame.width);
    put(out, R"(<path class="b" d="M{} {}h{}v{}h-{}z"/>)", frame.corner.x, frame.corner.y, frame.width, frame.height,
        frame.width);
  }
}

void appendSteps(std::string& out, const Picture& picture) {
  for (const Step& step : picture.steps)
    put(out, R"(<rect class="{}" x="{}" y="{}" width="{}" height="{}" data-cell="{}" data-states="{}"/>)",
        step.waits ? "st at" : "st", step.corner.x, step.corner.y, step.width, step.height, escaped(step.continuation),
        fmt::join(step.states, " "));
}

void appendBars(std::string& out, const Picture& picture) {
  if (picture.bars.empty() && picture.arrows.empty()) return;
  out += "<path class=\"e\" d=\"";
  for (const Line& bar : picture.bars) put(out, "M{} {}h{}", bar.from.x, bar.from.y, bar.to.x - bar.from.x);
  out += "\"/>";
  if (picture.arrows.empty()) return;
  out += "<path class=\"v\" d=\"";
  for (const Point arrow : picture.arrows) put(out, "M{} {}l-8 -4v8z", arrow.x, arrow.y);
  out += "\"/>";
}

void appendLiveWires(std::string& out, const Picture& picture) {
  std::map<uint32_t, std::string> byCell;
  for (const Line& line : picture.wires) appendLine(byCell[line.cell], line);
  for (const auto& [cell, lines] : byCell) put(out, R"(<path class="w" data-n="{}" d="{}"/>)", cell, lines);
  appendDots(out, picture);
}

void appendCell(std::string& out, const Sheet& sheet, uint32_t index) {
  const Cell& cell = sheet.cells[index];
  const bool box = cell.kind == Cell::Kind::Box;
  put(out, R"(data-c="{}" data-name="{}" data-mark="{}")", index, escaped(box ? cell.title : cell.operand.name),
      escaped(cell.mark));
  if (cell.operand.link.to == Link::To::Name) put(out, R"( data-id="{}")", cell.operand.link.id);
}

// Contacts and coils have a surface, which shows the state more clearly than lines do.
void appendLiveSymbols(std::string& out, const Picture& picture, const Sheet& sheet) {
  for (const Symbol& symbol : picture.symbols) {
    const int top = symbol.left.y - kSymbolHalf;
    const bool coil = symbol.glyph == Glyph::Coil;
    put(out, R"(<g class="{}" )", coil ? "k o" : "k");
    appendCell(out, sheet, symbol.cell);
    put(out, R"(><rect x="{}" y="{}" width="{}" height="{}"{}/><path class="s" d=")", symbol.left.x, top, symbol.width,
        2 * kSymbolHalf, coil ? R"( rx="10")" : "");
    appendSymbol(out, symbol);
    out += "\"/></g>";
  }
}

void appendLiveFrames(std::string& out, const Picture& picture, const Sheet& sheet) {
  for (const Frame& frame : picture.frames) {
    const Point at = frame.corner;
    out += R"(<g class="x" )";
    appendCell(out, sheet, frame.cell);
    put(out, R"(><path class="h" d="M{} {}h{}v{}h-{}z"/>)", at.x, at.y, frame.width, frame.head, frame.width);
    put(out, R"(<path class="b" d="M{} {}h{}v{}h-{}z"/></g>)", at.x, at.y, frame.width, frame.height, frame.width);
  }
}

void appendHalos(std::string& out, const Picture& picture) {
  for (const Halo& halo : picture.halos) {
    const char* name = halo.seen == Seen::All ? "qa" : halo.seen == Seen::Part ? "qp" : "qn";
    put(out, R"(<rect class="{}" x="{}" y="{}" width="{}" height="{}"><title>)", name, halo.corner.x, halo.corner.y,
        halo.width, halo.height);
    appendEscaped(out, halo.detail);
    out += "</title></rect>";
  }
}

void appendLinked(std::string& out, const Text& text, bool onPage) {
  size_t at = 0;
  for (const LinkedText::Part& part : text.links) {
    if (part.link.to == Link::To::Name && !onPage) continue;
    appendEscaped(out, std::string_view(text.text).substr(at, part.begin - at));
    put(out, "<a href=\"#{}{}\">", part.link.to == Link::To::Rung ? 'r' : 'n', part.link.id);
    appendEscaped(out, std::string_view(text.text).substr(part.begin, part.end - part.begin));
    out += "</a>";
    at = part.end;
  }
  appendEscaped(out, std::string_view(text.text).substr(at));
}

// Texts of one style and anchor are in one group.
void appendTexts(std::string& out, const Picture& picture, bool onPage) {
  std::array<std::array<std::string, kStyles>, 3> groups;
  for (const Text& text : picture.texts) {
    std::string& group = groups[static_cast<size_t>(text.anchor)][static_cast<size_t>(text.style)];
    put(group, "<text x=\"{}\" y=\"{}\">", text.at.x, text.at.y);
    appendLinked(group, text, onPage);
    group += "</text>";
  }
  constexpr std::string_view kAnchors[] = {"", " am", " ae"};
  for (size_t anchor = 0; anchor < groups.size(); ++anchor)
    for (size_t style = 0; style < kStyles; ++style)
      if (!groups[anchor][style].empty())
        put(out, "<g class=\"{}{}\">{}</g>", infoOf(static_cast<Style>(style)).cssClass, kAnchors[anchor],
            groups[anchor][style]);
}

// Draws the whole program from top to bottom.
class Poster {
public:
  explicit Poster(const Program& program) : program_(program), rail_(commonRail(program)) {
    for (const Figure& figure : program.figures) hottest_ = std::max(hottest_, figure.run.heat);
  }
  std::string run();

private:
  void text(Style style, int x, std::string_view text, int space);
  void lines(Style style, int x, std::string_view text);
  void block(const Block& block);
  void figure(const Figure& figure);
  void chart(const Chart& chart);
  void heat(const Run& run, int top);

  const Program& program_;
  int rail_;
  double hottest_ = 0;
  int y_ = 8;
  int width_ = 0;
  std::string body_;
};

void Poster::text(Style style, int x, std::string_view text, int space) {
  y_ += space + static_cast<int>(infoOf(style).size);
  put(body_, "<text class=\"{}\" x=\"{}\" y=\"{}\">", infoOf(style).cssClass, x, y_);
  appendEscaped(body_, text);
  body_ += "</text>\n";
  y_ += 3;
  width_ = std::max(width_, x + widthOf(text, style));
}

void Poster::lines(Style style, int x, std::string_view whole) {
  while (!whole.empty()) {
    const size_t end = std::min(whole.find('\n'), whole.size());
    for (const std::string& line : wrap(whole.substr(0, end), style, rail_ + kMargin - x)) text(style, x, line, 0);
    whole.remove_prefix(std::min(end + 1, whole.size()));
  }
}

// A bar to the left of the rung.
void Poster::heat(const Run& run, int top) {
  const int step = heatStep(run, hottest_);
  const bool never = run.state == Run::State::Never;
  if (step == 0 && !never) return;
  const auto colour = never ? Colour::Warn : static_cast<Colour>(static_cast<int>(Colour::Heat1) + step - 1);
  put(body_, "<path d=\"M2.5 {}v{}\" style=\"stroke:{};stroke-width:5{}\"/>\n", top, y_ - top, infoOf(colour).light,
      never ? ";stroke-dasharray:3 3" : "");
}

void Poster::figure(const Figure& figure) {
  const std::string number = std::to_string(figure.number);
  y_ += 18;
  const int base = y_;
  text(Style::Caption, 8, number, 0);
  const int x = std::max(kIndent + 16, 8 + widthOf(number, Style::Caption) + 12);
  const std::string place = textOf(program_, figure.place);
  const int left = rail_ + kMargin - widthOf(place, Style::Place) - 8;
  y_ = base;
  text(Style::Place, left, place, 2);
  y_ = base;
  const std::vector<std::string> title = wrap(captionOf(figure), Style::Caption, left - x - 16);
  for (const std::string& line : title) text(Style::Caption, x, line, 0);
  if (title.empty()) y_ = base + static_cast<int>(infoOf(Style::Caption).size) + 3;
  lines(Style::Badge, x, labelOf(figure.run));
  for (const std::string& comment : figure.comments) lines(Style::Comment, x, comment);
  const Picture picture = pictureOf(program_, figure, rail_);
  y_ += 4;
  put(body_, "<g id=\"r{}\" transform=\"translate(0 {})\"><title>", figure.number, y_);
  appendEscaped(body_, nameOf(figure));
  body_ += "</title>";
  appendPicture(body_, picture, false);
  body_ += "</g>\n";
  y_ += picture.height;
  heat(figure.run, base);
  width_ = std::max(width_, picture.width);
}

// Of a module, which has no rung for it.
void Poster::chart(const Chart& chart) {
  const Picture picture = layOut(chart);
  y_ += 12;
  put(body_, "<g transform=\"translate(0 {})\"><title>{}</title>", y_, escaped(chart.sequence.name));
  appendPicture(body_, picture, false);
  body_ += "</g>\n";
  y_ += picture.height;
  width_ = std::max(width_, picture.width);
}

void Poster::block(const Block& block) {
  switch (block.kind) {
  case Block::Kind::File: text(Style::Section, 8, block.text, 24); break;
  case Block::Kind::Module:
    text(Style::Module, 8, block.text + (block.title.empty() ? "" : ": " + block.title), 28);
    break;
  case Block::Kind::Section: text(Style::Section, 8, block.text, 22); break;
  case Block::Kind::Comment: y_ += 12; return lines(Style::Comment, 8, block.text);
  case Block::Kind::Rung: return figure(program_.figures[block.figure]);
  case Block::Kind::Chart: return chart(program_.charts[block.figure]);
  }
  lines(Style::Comment, 8, block.comment);
}

std::string Poster::run() {
  text(Style::Module, 8, program_.title, 4);
  text(Style::Comment, 8, program_.control, 2);
  for (const Block& one : program_.blocks) block(one);
  std::string out;
  const int width = width_ + 8;
  const int height = y_ + 12;
  put(out,
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" role=\"img\">\n",
      width, height);
  put(out, "<title>{}</title>\n<style>\n{}</style>\n", escaped(program_.title), pictureStyle(program_, false));
  put(out, "<rect width=\"{}\" height=\"{}\" fill=\"#fff\"/>\n{}</svg>\n", width, height, body_);
  return out;
}

} // namespace

void appendEscaped(std::string& out, std::string_view text) {
  for (char c : text) {
    switch (c) {
    case '&': out += "&amp;"; break;
    case '<': out += "&lt;"; break;
    case '>': out += "&gt;"; break;
    case '"': out += "&quot;"; break;
    default: out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
  }
}

std::string escaped(std::string_view text) {
  std::string out;
  appendEscaped(out, text);
  return out;
}

// Of a chart: its steps are the cells.
void appendLiveChart(std::string& out, const Picture& picture) {
  for (size_t i = 0; i < picture.steps.size(); ++i) {
    const Step& step = picture.steps[i];
    put(out, R"(<rect class="st" data-c="{}" data-step="{}" x="{}" y="{}" width="{}" height="{}"/>)", i,
        fmt::join(step.states, ", "), step.corner.x, step.corner.y, step.width, step.height);
  }
  appendFrames(out, picture);
  appendWires(out, picture);
  appendBars(out, picture);
  appendTexts(out, picture, true);
}

void appendPicture(std::string& out, const Picture& picture, bool onPage) {
  appendSteps(out, picture);
  appendFrames(out, picture);
  appendWires(out, picture);
  appendBars(out, picture);
  appendSymbols(out, picture);
  appendRails(out, picture);
  appendHalos(out, picture);
  appendTexts(out, picture, onPage);
}

void appendLivePicture(std::string& out, const Picture& picture, const Sheet& sheet) {
  appendLiveFrames(out, picture, sheet);
  appendLiveWires(out, picture);
  appendLiveSymbols(out, picture, sheet);
  appendRails(out, picture);
  appendTexts(out, picture, true);
  for (const ValueSpace& value : picture.values)
    put(out, R"(<text class="v" data-v="{}.{}" x="{}" y="{}"></text>)", value.cell, value.operand, value.at.x,
        value.at.y);
}

std::string pictureStyle(const Program& program, bool onPage) {
  std::array<std::string, kColours> colours;
  std::array<text::Mark, kColours> marks;
  for (size_t i = 0; i < kColours; ++i) {
    const ColourInfo& info = kColourInfos[i];
    colours[i] = onPage ? fmt::format("var(--{})", info.name) : std::string(info.light);
    marks[i] = {info.name, colours[i]};
  }
  std::string css = text::filled(text::textOf(pageFiles(), "picture.css"), marks);
  if (!program.charts.empty()) css += text::filled(text::textOf(pageFiles(), "chart.css"), marks);
  for (size_t i = 0; i < kStyles; ++i) {
    const StyleInfo& info = infoOf(static_cast<Style>(i));
    put(css, ".{} {{ font: {}{}{}px {}; fill: {}; }}\n", info.cssClass, info.italic ? "italic " : "",
        info.bold ? "bold " : "", info.size,
        info.mono ? "DejaVu Sans Mono, Consolas, Menlo, monospace" : "Arial, Helvetica, DejaVu Sans, sans-serif",
        colours[static_cast<size_t>(info.colour)]);
  }
  return css;
}

int commonRail(const Program& program, int valueSpace) {
  int rail = kLeastRail;
  for (const Figure& figure : program.figures) rail = std::max(rail, neededRail(figure.sheet, valueSpace));
  return std::min(rail, kMostRail);
}

std::string captionOf(const Figure& figure) {
  std::string caption;
  for (const std::string& label : figure.labels) caption += label + ": ";
  return caption + figure.title;
}

std::string nameOf(const Figure& figure) {
  const std::string caption = captionOf(figure);
  return fmt::format("Rung {}", figure.number) + (caption.empty() ? "" : ": " + caption);
}

Picture pictureOf(const Program& program, const Figure& figure, int rail) {
  return figure.chart == kNoChart ? layOut(figure.sheet, rail) : layOut(program.charts[figure.chart]);
}

std::string textOf(const Program& program, const Place& place) {
  return place.line == 0 ? "" : fmt::format("{}:{}", program.files[place.file].name, place.line);
}

std::string renderSvg(const Program& program) { return Poster(program).run(); }

} // namespace rung::view
