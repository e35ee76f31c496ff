// Writes the rows as constexpr C++ and the order of their names.
#include "rtlib/nc/gen/gen.h"

#include <algorithm>
#include <numeric>
#include <string_view>
#include <unordered_map>

#include "rtlib/text/letters.h"

namespace rung::nc::gen {

namespace {

constexpr std::string_view kNoteMark = " // ";

const char* typeName(SignalType type) {
  switch (type) {
  case SignalType::Bit: return "Bit";
  case SignalType::Byte: return "Byte";
  case SignalType::Word: return "Word";
  case SignalType::Dword: return "Dword";
  case SignalType::Qword: return "Qword";
  case SignalType::Real: return "Real";
  case SignalType::Struct: return "Struct";
  case SignalType::String: return "String";
  }
  return "";
}

const char* directionName(Direction direction) {
  switch (direction) {
  case Direction::In: return "In";
  case Direction::Out: return "Out";
  case Direction::InOut: return "InOut";
  }
  return "";
}

std::string literal(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + '"';
}

std::string sortKey(const std::string& name, bool ignoreCase) { return ignoreCase ? text::upper(name) : name; }

void emitRow(std::ostream& out, const Row& row) {
  out << "    Signal{" << literal(row.symbol) << ", " << literal(row.address) << ", " << literal(row.area) << ", "
      << row.byteOffset << ", " << row.bit << ", SignalType::" << typeName(row.type)
      << ", Direction::" << directionName(row.direction) << ", " << row.count << ", " << row.strideBytes << ", "
      << literal(row.structure) << ", " << literal(row.group) << ", " << literal(row.meaning) << ", " << row.manualLine
      << ", " << (row.inferred ? "true" : "false") << "},\n";
}

} // namespace

Row commonColumns(const Table& table, size_t i) {
  static const std::unordered_map<std::string_view, SignalType> kTypes = {
      {"bit", SignalType::Bit},     {"byte", SignalType::Byte},     {"word", SignalType::Word},
      {"dword", SignalType::Dword}, {"qword", SignalType::Qword},   {"real", SignalType::Real},
      {"double", SignalType::Real}, {"struct", SignalType::Struct}, {"string", SignalType::String}};
  static const std::unordered_map<std::string_view, Direction> kDirections = {
      {"in", Direction::In}, {"out", Direction::Out}, {"inout", Direction::InOut}};
  const auto type = kTypes.find(table.at(i, "type"));
  const auto direction = kDirections.find(table.at(i, "direction"));
  if (type == kTypes.end()) table.fail(i, "unknown type");
  if (direction == kDirections.end()) table.fail(i, "unknown direction");
  Row row;
  row.symbol = table.at(i, "symbol");
  const std::string& meaning = table.at(i, "meaning");
  const size_t note = std::min(meaning.find(kNoteMark), meaning.size());
  row.meaning = meaning.substr(0, note);
  if (note < meaning.size()) row.note = meaning.substr(note + kNoteMark.size());
  if (table.has("manual_line")) row.manualLine = table.number(i, "manual_line");
  row.type = type->second;
  row.direction = direction->second;
  return row;
}

void emit(std::ostream& out, const std::vector<Row>& rows, bool ignoreCase) {
  out << "// Generated from signals.csv.\nconstexpr bool kIgnoreCase = " << (ignoreCase ? "true" : "false")
      << ";\nconstexpr std::array<Signal, " << rows.size() << "> kSignals = {{\n";
  for (const Row& row : rows) emitRow(out, row);
  std::vector<std::string> keys;
  keys.reserve(rows.size());
  for (const Row& row : rows) keys.push_back(sortKey(row.symbol, ignoreCase));
  std::vector<size_t> order(rows.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return keys[a] < keys[b]; });
  out << "}};\nconstexpr std::array<uint16_t, " << rows.size() << "> kByName = {";
  for (size_t i = 0; i < order.size(); ++i) out << (i % 20 == 0 ? "\n    " : " ") << order[i] << ',';
  out << "\n};\nconstexpr SignalNote kNotes[] = {\n";
  for (size_t i = 0; i < rows.size(); ++i)
    if (!rows[i].note.empty()) out << "    {" << i << ", " << literal(rows[i].note) << "},\n";
  out << "};\n";
}

} // namespace rung::nc::gen
