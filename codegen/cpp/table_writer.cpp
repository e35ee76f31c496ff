// Writes tables as C++ text (see table_writer.h).
#include "codegen/cpp/table_writer.h"

#include <cstring>
#include <fmt/format.h>

#include "ir/image/abi_fields.h"
#include "ir/support/put.h"

namespace rung::codegen {

using namespace ir;

namespace {

class TableWriter {
public:
  TableWriter(std::string_view chunkTable, std::string& out) : chunkTable_(chunkTable), out_(out) {}

  // The initialiser of one struct; arrays to which it points are written before it.
  std::string structText(const StructInfo& info, const std::byte* base) {
    std::string text = "{";
    for (const FieldInfo& field : info.fields) {
      if (text.size() > 1) text += ", ";
      text += fieldText(info, field, base);
    }
    return text + "}";
  }

private:
  template <class T>
  static T read(const std::byte* at) {
    T value;
    std::memcpy(&value, at, sizeof value);
    return value;
  }

  std::string fieldText(const StructInfo& info, const FieldInfo& field, const std::byte* base) {
    const std::byte* at = base + field.offset;
    const auto count = [&] { return read<uint32_t>(base + field.countOffset); };
    switch (field.kind) {
    case FieldKind::U32: return fmt::format("{}u", read<uint32_t>(at));
    case FieldKind::OwnSize: return fmt::format("sizeof({})", info.name);
    case FieldKind::U64: return fmt::format("0x{:016x}ull", read<uint64_t>(at));
    case FieldKind::I64: return fmt::format("static_cast<int64_t>({}ull)", static_cast<uint64_t>(read<int64_t>(at)));
    case FieldKind::Text: return cppString(read<const char*>(at));
    case FieldKind::Bytes:
      return array("uint8_t", field.name, count(),
                   [&](uint32_t i) { return fmt::format("{}", read<const uint8_t*>(at)[i]); });
    case FieldKind::U32s:
      return array("uint32_t", field.name, count(),
                   [&](uint32_t i) { return fmt::format("{}u", read<const uint32_t*>(at)[i]); });
    case FieldKind::Texts:
      return array("char *const", field.name, count(),
                   [&](uint32_t i) { return cppString(read<const char* const*>(at)[i]); });
    case FieldKind::Structs: {
      const std::byte* first = read<const std::byte*>(at);
      return array(field.element->name, field.name, count(),
                   [&](uint32_t i) { return structText(*field.element, first + i * field.element->size); });
    }
    case FieldKind::ChunkFns: return std::string(chunkTable_);
    }
    return {};
  }

  template <class Element>
  std::string array(std::string_view type, std::string_view name, uint32_t count, Element element) {
    if (count == 0) return "nullptr";
    std::string body;
    for (uint32_t i = 0; i < count; ++i) {
      body += "    ";
      body += element(i);
      body += ",\n";
    }
    const std::string id = fmt::format("{}_{}", name, next_++);
    put(out_, "static const {} {}[] = {{\n{}}};\n", type, id, body);
    return id;
  }

  std::string_view chunkTable_;
  std::string& out_;
  int next_ = 0;
};

} // namespace

std::string cppString(std::string_view text) {
  std::string out = "\"";
  for (char c : text) {
    const unsigned char byte = static_cast<unsigned char>(c);
    // Three octal digits are complete, so a digit may follow; `?` is escaped against trigraphs.
    if (c == '"' || c == '\\' || c == '?')
      put(out, "\\{}", c);
    else if (byte < 32 || byte > 126)
      put(out, "\\{:03o}", byte);
    else
      out += c;
  }
  return out + "\"";
}

void writeTables(const rung_program& program, std::string_view chunkTable, std::string& out) {
  TableWriter writer(chunkTable, out);
  const std::string text = writer.structText(programInfo(), reinterpret_cast<const std::byte*>(&program));
  put(out,
      "\nextern \"C\" __attribute__((visibility(\"default\"))) const rung_program {0};\nconst rung_program "
      "{0} = {1};\n",
      RUNG_PROGRAM_SYMBOL, text);
}

} // namespace rung::codegen
