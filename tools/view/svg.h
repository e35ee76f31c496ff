// Pictures as SVG: one of them as a part of a page, or a whole program as one drawing.
#pragma once
#include <string>

#include "rtlib/text/embedded.h"
#include "tools/view/layout.h"
#include "tools/view/program.h"

namespace rung::view {

// With <, &, quotes and what XML does not allow made harmless; good between tags and in attributes.
void appendEscaped(std::string& out, std::string_view text);
std::string escaped(std::string_view text);

// Lines and texts of a rung, for a <g> or <svg>. Names lead to their rows on a page, which has them.
void appendPicture(std::string& out, const Picture& picture, bool onPage);
// The rules of style that pictures need; on a page colours are named (see style.h).
std::string pictureStyle(bool onPage);

// Where the right rail is of all rungs that can be cut to it.
int commonRail(const Program& program);
// "Rung 3: start/stop latch".
std::string nameOf(const Figure& figure);
// "main.lad:12", or nothing.
std::string textOf(const Program& program, const Place& place);

// The files of page/; the build makes this function.
std::span<const text::EmbeddedFile> pageFiles();

std::string renderSvg(const Program& program);

} // namespace rung::view
