// See html_page.h.
#include "tools/view/html_page.h"

#include "tools/view/colours.h"
#include "tools/view/html_parts.h"
#include "tools/view/put.h"
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

} // namespace

void beginPage(std::string& out, std::string_view title, std::string_view style) {
  put(out, "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n");
  put(out, "<meta name=\"viewport\" content=\"width=device-width\">\n<title>{}</title>\n", escaped(title));
  put(out, "<style>\n{}{}{}{}</style>\n</head>\n<body>\n<h1>{}</h1>\n", colourRules(), kPageStyle, pictureStyle(true),
      style, escaped(title));
}

void endPage(std::string& out) { put(out, "<script>{}</script>\n</body>\n</html>\n", kPageScript); }

} // namespace rung::view
