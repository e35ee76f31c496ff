// Data files of PLC tables as they are written (see plc_table_files.h).
#include "machine/io/tables/plc_table_files.h"

namespace rung::io {
namespace {

// Line ends are references, so that an element stays in its line and no parser makes one of another.
void escape(std::string& out, std::string_view text) {
  for (const char c : text) {
    switch (c) {
    case '&': out += "&amp;"; break;
    case '<': out += "&lt;"; break;
    case '>': out += "&gt;"; break;
    case '"': out += "&quot;"; break;
    case '\t': out += "&#9;"; break;
    case '\n': out += "&#10;"; break;
    case '\r': out += "&#13;"; break;
    default: out += c;
    }
  }
}

void writeLine(std::string& out, const TableLine& line) {
  out += "  <Line No=\"" + std::to_string(line.number) + "\">\n";
  for (const TableElement& element : line.elements) {
    out += "    <Col ColID=\"";
    escape(out, element.column);
    out += "\">";
    escape(out, element.value);
    out += "</Col>\n";
  }
  out += "  </Line>\n";
}

} // namespace

std::string tableDataText(const TableData& data) {
  std::string out = "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<PLCTable>\n  <Definition>\n    <DefinitionID>";
  escape(out, data.definition);
  out += "</DefinitionID>\n    <LinesCount>" + std::to_string(data.lineCount) + "</LinesCount>\n";
  if (data.selected != 0) out += "    <SelLine>" + std::to_string(data.selected) + "</SelLine>\n";
  out += "  </Definition>\n";
  for (const TableLine& line : data.lines) writeLine(out, line);
  return out + "</PLCTable>\n";
}

} // namespace rung::io
