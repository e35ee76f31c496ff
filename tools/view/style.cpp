// Widths of characters.
#include "tools/view/style.h"

#include <algorithm>
#include <array>

#include "ir/support/put.h"
#include "ir/support/utf8.h"

namespace rung::view {
namespace {

constexpr std::array<StyleInfo, kStyles> kInfos = {{
    {"n", 12, true, true, false, Colour::Ink},
    {"a", 11, true, false, false, Colour::Soft},
    {"c", 11, false, false, false, Colour::Soft},
    {"m", 12, true, true, false, Colour::Ink},
    {"t", 13, true, true, false, Colour::Ink},
    {"p", 11, true, false, false, Colour::Ink},
    {"l", 11, false, false, false, Colour::Soft},
    {"r", 12, false, false, true, Colour::Note},
    {"u", 11, false, false, false, Colour::Link},
    {"k", 14, false, true, false, Colour::Ink},
    {"M", 22, false, true, false, Colour::Ink},
    {"S", 17, false, true, false, Colour::Ink},
    {"C", 13, false, false, false, Colour::Note},
    {"f", 12, true, false, false, Colour::Soft},
    {"g", 11, false, true, false, Colour::Warn},
}};

// Thousandths of the size of the font.
int sansWidth(uint32_t c) {
  if (c >= 0x80) return displayWidth(c) == 2 ? 1020 : displayWidth(c) == 0 ? 0 : 700;
  const char ch = static_cast<char>(c);
  if (std::string_view(" .,:;'|!ijlI/\\()[]").find(ch) != std::string_view::npos) return 395;
  if (std::string_view("mwMW@%#+=<>~^").find(ch) != std::string_view::npos) return 995;
  if (ch >= 'A' && ch <= 'Z') return 790;
  return 640;
}

int monoWidth(uint32_t c) { return 605 * static_cast<int>(displayWidth(c)); }

} // namespace

const StyleInfo& infoOf(Style style) { return kInfos[static_cast<size_t>(style)]; }

std::string colourRules() {
  std::string light, dark;
  for (const ColourInfo& info : kColourInfos) {
    put(light, "--{}:{};", info.name, info.light);
    put(dark, "--{}:{};", info.name, info.dark);
  }
  return fmt::format(":root {{ {0} }}\n:root[data-theme=dark] {{ {1} }}\n"
                     "@media (prefers-color-scheme: dark) {{ :root:not([data-theme=light]) {{ {1} }} }}\n",
                     light, dark);
}

int lineHeight(Style style) { return static_cast<int>(infoOf(style).size) + 3; }

int widthOf(std::string_view text, Style style) {
  const StyleInfo& info = infoOf(style);
  int64_t sum = 0;
  for (size_t at = 0; at < text.size();) {
    const CodePoint c = decodeUtf8(text, at);
    sum += info.mono ? monoWidth(c.value) : sansWidth(c.value) * (info.bold ? 110 : 100) / 100;
    at += c.length;
  }
  return static_cast<int>((sum * info.size + 999) / 1000);
}

std::vector<std::string> wrap(std::string_view text, Style style, int width) {
  std::vector<std::string> lines;
  int used = 0;
  const int blank = widthOf(" ", style);
  for (size_t at = text.find_first_not_of(' '); at < text.size();) {
    const size_t end = std::min(text.find(' ', at), text.size());
    const std::string_view word = text.substr(at, end - at);
    const int wide = widthOf(word, style);
    if (lines.empty() || used + blank + wide > width) {
      lines.emplace_back(word);
      used = wide;
    } else {
      lines.back().append(" ").append(word);
      used += blank + wide;
    }
    at = std::min(text.find_first_not_of(' ', end), text.size());
  }
  return lines;
}

void LinkedText::add(std::string_view more, Link link) {
  if (link.to != Link::To::Nothing) links.push_back({text.size(), text.size() + more.size(), link});
  text += more;
}

std::vector<LinkedText> wrap(const std::vector<LinkedText>& words, Style style, int width) {
  std::vector<LinkedText> lines;
  for (const LinkedText& word : words) {
    if (lines.empty() || widthOf(lines.back().text + " " + word.text, style) > width)
      lines.emplace_back();
    else
      lines.back().text += ' ';
    LinkedText& line = lines.back();
    for (LinkedText::Part part : word.links)
      line.links.push_back({part.begin + line.text.size(), part.end + line.text.size(), part.link});
    line.text += word.text;
  }
  return lines;
}

} // namespace rung::view
