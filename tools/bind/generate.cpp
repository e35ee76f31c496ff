// See generate.h.
#include "tools/bind/generate.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <set>

#include "tools/bind/member.h"

namespace rung::bind {

namespace {

using codegen::HostLayout;
using codegen::MemberKind;

constexpr const char* kHostTypes[] = {"0",
                                      "RUNG_HOST_BOOL",
                                      "RUNG_HOST_I8",
                                      "RUNG_HOST_U8",
                                      "RUNG_HOST_I16",
                                      "RUNG_HOST_U16",
                                      "RUNG_HOST_I32",
                                      "RUNG_HOST_U32",
                                      "RUNG_HOST_I64",
                                      "RUNG_HOST_F32",
                                      "RUNG_HOST_F64"};

// A C string literal.
std::string literal(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) out += c == '"' || c == '\\' ? std::string{'\\', c} : c == '?' ? "\\?" : std::string{c};
  return out + "\"";
}

// Turns ns::Block into ns_Block.
std::string identifierOf(std::string_view name) {
  std::string out;
  for (const char c : name) {
    const bool colon = c == ':';
    if (!colon)
      out += c;
    else if (!out.ends_with('_'))
      out += '_';
  }
  return out;
}

class Writer {
public:
  Writer(const Binding& binding, const HostLayout& layout, const Names& names)
      : binding_(binding), layout_(layout), names_(names), id_(identifierOf(layout.name)),
        text_(describe(binding, layout)) {}

  std::string write() {
    head();
    assertions();
    put("#pragma GCC diagnostic pop\n");
    table();
    bitFields();
    layout();
    bindFunction();
    put("#endif\n");
    return out_;
  }

private:
  template <class... Args>
  void put(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(out_), format, std::forward<Args>(args)...);
  }

  void head() {
    put("/* Made by rungc bind; do not change it. {} has what the layout was then:\n *   {}\n */\n", names_.header,
        names_.command);
    put("#ifndef RUNG_BINDING_{0}_H\n#define RUNG_BINDING_{0}_H\n\n", id_);
    put("#include <assert.h>\n#include <stddef.h>\n#include <string.h>\n\n");
    put("#include \"{}\"\n#include <rung/runtime.h>\n\n", names_.header);
    out_ += claimText(layout_.name, text_);
    put("\n/* offsetof of a member of a member, and of a derived struct: gcc and clang have it. */\n"
        "#pragma GCC diagnostic push\n#pragma GCC diagnostic ignored \"-Wpedantic\"\n"
        "#ifdef __cplusplus\n#pragma GCC diagnostic ignored \"-Winvalid-offsetof\"\n#endif\n");
  }

  // ---- assertions

  void check(const std::string& condition, const std::string& what) {
    put("static_assert({}, {});\n", condition,
        literal(fmt::format("{} since rungc bind has read {}: run it again", what, names_.header)));
  }

  std::string at(const std::string& member) const { return fmt::format("((({}*)0)->{})", layout_.type, member); }

  void checkPlace(const std::string& member, uint32_t offset, uint32_t bytes, const std::string& type) {
    const std::string what = fmt::format("{}.{} was {} at {} and has changed", layout_.name, member, type, offset);
    check(fmt::format("offsetof({}, {}) == {} && sizeof({}) == {}", layout_.type, member, offset, at(member), bytes),
          what);
  }

  // Asserts that a number has not changed to another kind of number of the same size.
  void checkKind(const Row& row) {
    const bool real = row.at.is->kind == MemberKind::Real;
    const std::string what = fmt::format("{}.{} was {} and has changed", layout_.name, row.member, typeText(row));
    check(fmt::format("(__builtin_classify_type({}) == 8) == {}", at(row.member), real ? 1 : 0), what);
    const bool hasSign = row.at.is->kind == MemberKind::Integer && row.bytes < 8;
    if (hasSign)
      check(fmt::format("((long long)(__typeof__({}))-1 < 0) == {}", at(row.member), row.at.is->isSigned ? 1 : 0),
            what);
  }

  void checkRow(const Row& row) {
    if (row.bits != 0) return; // moved() checks these
    checkPlace(row.member, row.offset, row.bytes, typeText(row));
    if (row.type != 0) checkKind(row);
  }

  void checkConstants() {
    std::set<uint32_t> all;
    for (const Row& row : binding_.rows) all.insert(row.at.is->constants.begin(), row.at.is->constants.end());
    for (const uint32_t number : all) {
      const codegen::EnumConstant& constant = layout_.constants[number];
      check(fmt::format("(long long){} == {}", constant.name, valueText(constant.value)),
            fmt::format("{} was {} and has changed", constant.name, constant.value));
    }
  }

  static std::string valueText(int64_t value) {
    return value == INT64_MIN ? "(-9223372036854775807LL - 1)" : fmt::format("{}LL", value);
  }

  void assertions() {
    put("static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, \"PLC memory is little-endian\");\n");
    check(fmt::format("sizeof({}) == {}", layout_.type, layout_.bytes),
          fmt::format("{} had {} bytes and has changed", layout_.name, layout_.bytes));
    for (const Row& row : binding_.rows) checkRow(row);
    checkConstants();
    if (!guarded()) return;
    checkPlace(binding_.head.member, binding_.head.offset, binding_.counterBytes, "a counter");
    checkPlace(binding_.tail.member, binding_.tail.offset, binding_.counterBytes, "a counter");
  }

  bool guarded() const { return binding_.counterBytes != 0; }

  // ---- tables

  void table() {
    put("\nstatic const rung_member rung_members_{}[] = {{\n", id_);
    for (const Row& row : binding_.rows)
      put("    {{{}, {}, {}, {}, {}, {}, {}, {}, {}}},\n", literal(row.name), literal(row.member), row.offset,
          row.bytes, kHostTypes[row.type], directionOf(row), row.bit, row.bits, row.scale);
    put("}};\n\n");
  }

  static std::string directionOf(const Row& row) {
    const bool fromProgram = (row.direction & RUNG_FROM_PROGRAM) != 0;
    const bool real = (row.direction & RUNG_BOUND_REAL) != 0;
    return std::string(fromProgram ? "RUNG_FROM_PROGRAM" : "RUNG_TO_PROGRAM") + (real ? " | RUNG_BOUND_REAL" : "");
  }

  bool hasBitFields() const {
    return std::ranges::any_of(binding_.rows, [](const Row& row) { return row.bits != 0; });
  }

  // The positions of bit-fields are checked by their values if certain bits of the struct are set, and if all others
  // are.
  void bitFields() {
    if (!hasBitFields()) return;
    put("/* Compilers make nothing of this but its result. */\n");
    put("static inline const char* rung_moved_{}(void) {{\n", id_);
    put("  unsigned char bytes[sizeof({})];\n  {} probe;\n", layout_.type, layout_.type);
    for (const Row& row : binding_.rows)
      if (row.bits != 0) probe(row);
    put("  return NULL;\n}}\n\n");
  }

  void probe(const Row& row) {
    const bool isNegative = row.at.is->kind == MemberKind::Integer && row.at.is->isSigned;
    const std::string all = isNegative ? "-1" : fmt::format("(long long){:#x}ULL", maskOf(row));
    setBits(row, 0, all);
    setBits(row, 255, "0");
  }

  void setBits(const Row& row, int others, const std::string& expected) {
    put("  memset(bytes, {}, sizeof bytes);\n", others);
    for (uint32_t i = 0; i < row.bytes; ++i) {
      const auto mask = static_cast<unsigned>((maskOf(row) << row.bit) >> (8 * i) & 255);
      put("  bytes[{}] = {:#04x};\n", row.offset + i, others == 0 ? mask : 255 - mask);
    }
    put("  memcpy((void*)&probe, bytes, sizeof bytes);\n");
    put("  if ((long long)probe.{} != {}) return {};\n", row.member, expected, literal(row.member));
  }

  static uint64_t maskOf(const Row& row) { return ~uint64_t{0} >> (64 - row.bits); }

  void layout() {
    put("static const rung_layout rung_layout_{} = {{\n    sizeof(rung_layout),\n    sizeof({}),\n    {},\n", id_,
        layout_.type, literal(layout_.name));
    std::string_view rest = text_;
    while (!rest.empty()) {
      const size_t end = rest.find('\n');
      std::string line = literal(rest.substr(0, end));
      line.insert(line.size() - 1, "\\n");
      rest.remove_prefix(end + 1);
      put("    {}{}\n", line, rest.empty() ? "," : "");
    }
    put("    {:#018x}ULL,\n    rung_members_{},\n    {},\n    {},\n    {},\n    {},\n    {},\n}};\n\n", hashOf(text_),
        id_, binding_.rows.size(), binding_.counterBytes, binding_.head.offset, binding_.tail.offset,
        hasBitFields() ? "rung_moved_" + id_ : "NULL");
  }

  void bindFunction() {
    const bool writes =
        std::ranges::any_of(binding_.rows, [](const Row& row) { return (row.direction & RUNG_FROM_PROGRAM) != 0; });
    put("/* See rung_instance_bind_struct: the struct lives as long as the instance. */\n");
    put("static inline int32_t rung_bind_{}(rung_instance* plc, {}{}* block) {{\n", id_, writes ? "" : "const ",
        layout_.type);
    put("  return rung_instance_bind_struct(plc, &rung_layout_{}, {}block);\n}}\n\n", id_,
        writes ? "" : "(void*)(uintptr_t)");
  }

  const Binding& binding_;
  const HostLayout& layout_;
  const Names& names_;
  std::string id_;
  std::string text_;
  std::string out_;
};

} // namespace

std::string generate(const Binding& binding, const HostLayout& layout, const Names& names) {
  return Writer(binding, layout, names).write();
}

std::string templateOf(const codegen::HostLayout& layout) {
  std::string text =
      fmt::format("# {}: its members, and where they lie. Move those that the program reads below [in], "
                  "those that\n# it writes below [out], and give each the program's name.\n[in]\n\n[out]\n\n",
                  layout.name);
  forEachNumber(layout, [&](const std::string& path, const Member& member) {
    std::string type = member.is->type;
    for (const uint64_t length : member.lengths) type += fmt::format("[{}]", length);
    if (member.is->bits != 0) type += fmt::format(" : {}", member.is->bits);
    const std::string place =
        member.is->bits == 0 ? fmt::format("{}", member.bit / 8) : fmt::format("{}.{}", member.bit / 8, member.bit % 8);
    text += fmt::format("# {} = \"\" # {} at {}\n",
                        path.find('[') == std::string::npos ? path : fmt::format("\"{}\"", path), type, place);
  });
  return text;
}

} // namespace rung::bind
