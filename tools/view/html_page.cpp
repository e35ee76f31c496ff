// See html_page.h.
#include "tools/view/html_page.h"

#include "ir/support/put.h"
#include "tools/view/colours.h"
#include "tools/view/html_parts.h"
#include "tools/view/svg.h"

namespace rung::view {
namespace {

// The colours as properties: those of paper, in the dark the others.
std::string colourRules() {
  std::string light;
  std::string dark;
  for (const ColourInfo& info : kColourInfos) {
    put(light, "--{}:{};", info.name, info.light);
    put(dark, "--{}:{};", info.name, info.dark);
  }
  return fmt::format(":root{{color-scheme:light dark;{}}}\n"
                     "@media screen and (prefers-color-scheme:dark){{:root{{{}}}}}\n",
                     light, dark);
}

// On paper: title and control on top; revision, date, file and page below.
std::string paperRules(const PageHead& head, const PageOptions& options) {
  std::string state = options.revision.empty() ? "" : "Revision " + options.revision;
  if (!options.date.empty()) state += (state.empty() ? "" : ", ") + options.date;
  constexpr std::string_view kFont = "font:11px Arial,Helvetica,sans-serif;vertical-align:middle";
  std::string css;
  const auto box = [&](std::string_view where, std::string_view content, std::string_view more) {
    put(css, "@{}{{content:{};{}{}}}", where, content, kFont, more);
  };
  css += "@page{margin:17mm 10mm 17mm 12mm;";
  box("top-left", cssText(head.title), ";font-weight:bold;width:60%");
  box("top-right", cssText(head.control), "");
  box("bottom-left", cssText(state), ";width:35%");
  box("bottom-center", "\"\"", "");
  box("bottom-right", "\"Page \" counter(page) \" of \" counter(pages)", ";width:35%");
  css += "}\n";
  return css;
}

} // namespace

std::string cssText(std::string_view text) {
  std::string out = "\"";
  for (char c : text) {
    if (c == '"' || c == '\\' || c == '<' || static_cast<unsigned char>(c) < 0x20)
      put(out, "\\{:x} ", static_cast<unsigned char>(c));
    else
      out += c;
  }
  return out + '"';
}

void appendPlace(std::string& out, const SourceFile& file, uint32_t line, const PageOptions& options) {
  if (line == 0) return;
  const std::string link = options.linkTo ? options.linkTo(file, line) : "";
  const std::string text = fmt::format("{}:{}", escaped(file.name), line);
  if (link.empty())
    put(out, "<i class=\"f\">{}</i>", text);
  else
    put(out, "<a class=\"f\" href=\"{}\">{}</a>", escaped(link), text);
}

void beginPage(std::string& out, const PageHead& head, const PageOptions& options) {
  const std::string title = escaped(head.title);
  put(out, "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n");
  put(out, "<meta name=\"viewport\" content=\"width=device-width\">\n<title>{}</title>\n", title);
  put(out, "<style>\n{}{}{}{}{}</style>\n</head>\n<body>\n<h1>{}</h1>\n", colourRules(), kPageStyle, pictureStyle(true),
      paperRules(head, options), head.style, title);
  put(out, "<p class=\"tb\"><span>{}</span><span>{} rung{}</span>", escaped(head.control), head.rungs,
      head.rungs == 1 ? "" : "s");
  if (!options.revision.empty()) put(out, "<span>Revision {}</span>", escaped(options.revision));
  if (!options.date.empty()) put(out, "<span>{}</span>", escaped(options.date));
  out += "</p>\n";
}

void endPage(std::string& out) { put(out, "<script>{}</script>\n</body>\n</html>\n", kPageScript); }

} // namespace rung::view
