// Pictures as SVG: one picture as a part of a page, or a whole program as one drawing.
#pragma once
#include <string>

#include "rtlib/text/embedded.h"
#include "tools/view/layout.h"
#include "tools/view/program.h"

namespace rung::view {

// With <, &, quotes and characters that XML does not allow escaped; for text between tags and in attributes.
void appendEscaped(std::string& out, std::string_view text);
std::string escaped(std::string_view text);

// Lines and texts of a rung or a chart, for a <g> or <svg>. On a page, names link to their rows.
void appendPicture(std::string& out, const Picture& picture, bool onPage);
// The same for a page that follows a running program: what has power is drawn cell by cell, with the index of the cell
// in `data-n` (wires, by what gives them power) or `data-c` (contacts, coils, boxes), with its name and NameRow::id,
// and `data-v` is "CELL.OPERAND".
void appendLivePicture(std::string& out, const Picture& picture, const Sheet& sheet);
// The same of a chart: `data-c` is the index of a step in Picture::steps.
void appendLiveChart(std::string& out, const Picture& picture);
// The CSS that the program's pictures need; on a page, colours are referred to by name (see style.h).
std::string pictureStyle(const Program& program, bool onPage);

// The x of the right rail for all rungs that can be cut to it. `valueSpace`: see layOut.
int commonRail(const Program& program, int valueSpace = 0);
// The labels and the title of a rung: "NO_TOOL: nothing to change".
std::string captionOf(const Figure& figure);
// Its drawing, at a right rail of this x or further to the right.
Picture pictureOf(const Program& program, const Figure& figure, int rail);
// Such as "Rung 3: start/stop latch".
std::string nameOf(const Figure& figure);
// Such as "main.lad:12"; "" if there is no position.
std::string textOf(const Program& program, const Place& place);

// The files of page/, embedded by the build, which makes this function.
std::span<const text::EmbeddedFile> pageFiles();

std::string renderSvg(const Program& program);

} // namespace rung::view
