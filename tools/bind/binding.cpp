// See binding.h.
#include "tools/bind/binding.h"

#include <algorithm>
#include <fmt/format.h>
#include <memory>
#include <optional>
#include <ranges>
#include <span>

#include "machine/host/mapping_file.h"
#include "rtlib/text/similar.h"
#include "rung/runtime.hpp"
#include "rung/types.hpp"

namespace rung::bind {
namespace {

using codegen::HostLayout;
using codegen::MemberKind;
using host::Mistake;

// The cell of a name.
struct Place {
  uint32_t type = RUNG_TYPE_BIT; // enum rung_type
  uint32_t space = RUNG_NONE;    // RUNG_NONE: a constant
  bool words = false;            // a real number stored in words

  bool isBit() const { return type == RUNG_TYPE_BIT; }
  bool isReal() const { return words || type == RUNG_TYPE_F64; }
  uint32_t width() const { return elementBits(type); }
};

constexpr uint32_t kSigned[] = {RUNG_HOST_I8, RUNG_HOST_I16, RUNG_HOST_I32, RUNG_HOST_I64};
constexpr uint32_t kUnsigned[] = {RUNG_HOST_U8, RUNG_HOST_U16, RUNG_HOST_U32, RUNG_HOST_I64};

size_t rankOf(uint64_t bytes) { return bytes == 1 ? 0 : bytes == 2 ? 1 : bytes == 4 ? 2 : 3; }

uint32_t hostType(const codegen::HostMember& member) {
  switch (member.kind) {
  case MemberKind::Bool: return RUNG_HOST_BOOL;
  case MemberKind::Real: return member.bytes == 4 ? RUNG_HOST_F32 : RUNG_HOST_F64;
  case MemberKind::Integer: return member.isSigned ? kSigned[rankOf(member.bytes)] : kUnsigned[rankOf(member.bytes)];
  case MemberKind::Record:
  case MemberKind::Other: break;
  }
  return 0;
}

class Binder {
public:
  Binder(const HostLayout& layout, rung_instance* instance, const rung_program& program, std::vector<Error>& errors)
      : layout_(layout), instance_(instance), program_(program), errors_(errors) {}

  std::optional<Row> row(const Entry& entry) {
    entry_ = &entry;
    const std::variant<Member, std::string> found = findMember(layout_, entry.member);
    if (const auto* wrong = std::get_if<std::string>(&found)) return fail(*wrong);
    const Member& member = std::get<Member>(found);
    if (const std::optional<Mistake> unfit = unfitMember(member)) return fail(*unfit);
    Row row{.name = entry.name,
            .member = entry.member,
            .direction = entry.input ? uint32_t{RUNG_TO_PROGRAM} : uint32_t{RUNG_FROM_PROGRAM},
            .scale = entry.scale,
            .at = member};
    placeIn(row);
    const bool good = row.type == 0 ? fitBlock(row) : fitCell(row);
    return good ? std::optional(std::move(row)) : std::nullopt;
  }

  void addCounters(const Counter& head, const Counter& tail, Binding& binding) {
    uint32_t bytes = 0;
    const std::optional<CounterRow> first = counter(head, bytes);
    const std::optional<CounterRow> last = counter(tail, bytes);
    if (!first || !last) return;
    binding.head = *first;
    binding.tail = *last;
    binding.counterBytes = bytes;
  }

private:
  std::optional<CounterRow> counter(const Counter& counter, uint32_t& bytes) {
    const std::variant<Member, std::string> found = findMember(layout_, counter.member);
    if (const auto* wrong = std::get_if<std::string>(&found)) return failCounter(counter, *wrong);
    const Member& member = std::get<Member>(found);
    const bool isCounter = member.is->kind == MemberKind::Integer && member.is->bits == 0 && member.lengths.empty() &&
                           !member.is->isSigned;
    if (!isCounter || (bytes != 0 && bytes != member.bytes()))
      return failCounter(counter, fmt::format("found {}, of type {}, expected an unsigned integer, of the same width "
                                              "as the other counter; count in one",
                                              counter.member, member.is->type));
    bytes = static_cast<uint32_t>(member.bytes());
    return CounterRow{counter.member, static_cast<uint32_t>(member.bit / 8)};
  }

  static void placeIn(Row& row) {
    const codegen::HostMember& is = *row.at.is;
    row.offset = static_cast<uint32_t>(row.at.bit / 8);
    row.bit = is.bits == 0 ? 0 : static_cast<uint32_t>(row.at.bit % 8);
    row.bits = is.bits;
    row.bytes = static_cast<uint32_t>(is.bits == 0 ? row.at.bytes() : (row.bit + is.bits + 7) / 8);
    row.type = row.at.lengths.empty() ? hostType(is) : 0;
  }

  // A member whose type a PLC does not have.
  std::optional<Mistake> unfitMember(const Member& member) const {
    const codegen::HostMember& is = *member.is;
    if (is.kind == MemberKind::Other)
      return Mistake{fmt::format("{} ({})", is.why, is.type), "a number, a bit or an array of integers",
                     "bind another member"};
    if (is.kind == MemberKind::Record)
      return Mistake{fmt::format("{} ({})", member.lengths.empty() ? "a whole struct" : "an array of structs", is.type),
                     "a member of it that is a number", "write for example " + exampleIn(member)};
    if (!member.lengths.empty() && is.kind != MemberKind::Integer)
      return Mistake{fmt::format("an array of {}", is.type), "one of integers, which is bound as bytes",
                     fmt::format("bind its elements: write \"{}[0]\" and so on", entry_->member)};
    if (is.bits != 0 && member.bit % 8 + is.bits > 64)
      return Mistake{fmt::format("a bit-field of {} bits over 9 bytes", is.bits), "one within 8 bytes",
                     "give it a place of its own in the struct"};
    if (entry_->scale != 0 && is.kind != MemberKind::Real)
      return Mistake{fmt::format("a scale of {}", is.type), "one of a float or a double", "remove scale"};
    return std::nullopt;
  }

  std::string exampleIn(const Member& member) const {
    std::string path = entry_->member;
    for (size_t i = 0; i < member.lengths.size(); ++i) path += "[0]";
    const std::vector<codegen::HostMember>& inside = layout_.records[member.is->record].members;
    const auto named = std::ranges::find_if(inside, [](const auto& inner) { return !inner.name.empty(); });
    return fmt::format("\"{}.{}\"", path, named == inside.end() ? "…" : named->name);
  }

  // ---- names

  // With the machine's access rights; what only the program writes may be read.
  std::optional<Place> placeOf(const std::string& name, bool input, bool real) const {
    const int32_t asReal = real ? RUNG_REAL : 0;
    std::optional<rung_cell_info> info = cellInfo(instance_, name, RUNG_WRITE | asReal);
    if (!info && !input) info = cellInfo(instance_, name, RUNG_READ | asReal);
    return info ? std::optional(Place{info->type, info->space, real}) : std::nullopt;
  }

  std::optional<Place> placeOfEntry() {
    if (const auto place = placeOf(entry_->name, entry_->input, false)) return place;
    const std::optional<rung_cell_info> info = cellInfo(instance_, entry_->name, RUNG_READ);
    if (!info) return fail(unknownName());
    if (info->space == RUNG_NONE)
      return fail(Mistake{"the constant " + entry_->name, "a place in the memory", "remove the line"});
    (void)cellInfo(instance_, entry_->name, RUNG_WRITE);
    return fail(Mistake{entry_->name, "a place where a value lasts", rung_error_text()});
  }

  Mistake unknownName() const {
    const std::string_view head = std::string_view(entry_->name).substr(0, entry_->name.find_first_of(".,[:+"));
    const auto isShown = [](const rung_symbol& symbol) {
      return (symbol.flags & (RUNG_SYMBOL_HIDDEN | RUNG_SYMBOL_CONST)) == 0;
    };
    const std::span symbols(program_.symbols, program_.symbol_count);
    const std::string_view meant = text::mostSimilar(head, symbols | std::views::filter(isShown), &rung_symbol::name);
    return {"an unknown name " + entry_->name, "a symbol or an address of the program, or a signal of the NC interface",
            meant.empty() ? "write the name as the program has it" : fmt::format("did you mean {}?", meant)};
  }

  bool isOutputOnly(const Place& place) const {
    const uint32_t flags = program_.spaces[place.space].flags;
    return (flags & RUNG_SPACE_OUTPUT) != 0 && (flags & RUNG_SPACE_INPUT) == 0;
  }

  // ---- what fits

  bool fitCell(Row& row) {
    std::optional<Place> place = placeOfEntry();
    if (!place) return false;
    if (const std::optional<Mistake> unfit = unfitPlace(row, *place)) return fail(*unfit), false;
    if (row.at.is->kind == MemberKind::Real && !place->isReal())
      if (const auto words = placeOf(row.name, entry_->input, true)) {
        row.direction |= RUNG_BOUND_REAL;
        return true;
      }
    if (const std::optional<Mistake> narrow = cutOff(row, *place)) return fail(*narrow), false;
    return true;
  }

  std::optional<Mistake> unfitPlace(const Row& row, const Place& place) const {
    const codegen::HostMember& is = *row.at.is;
    if (place.space == RUNG_NONE)
      return Mistake{"the constant " + row.name, "a place in the memory", "remove the line"};
    if (place.type == RUNG_TYPE_TEXT)
      return Mistake{"the text " + row.name, "a bit or a number",
                     "bind an array of bytes to the address where the text begins"};
    if (entry_->input && isOutputOnly(place))
      return Mistake{row.name + ", an output of the program", "a name that the host may write",
                     "move the line to [out]"};
    if (place.isBit() && is.kind == MemberKind::Real)
      return Mistake{fmt::format("the bit {} for a {}", row.name, is.type), "a number", "name a cell"};
    return std::nullopt;
  }

  // Upper bits that the other side does not store.
  std::optional<Mistake> cutOff(const Row& row, const Place& place) const {
    if (entry_->cut || place.isBit() || place.isReal() || row.at.is->kind != MemberKind::Integer) return std::nullopt;
    const uint32_t member = row.bits != 0 ? row.bits : 8 * row.bytes;
    const uint32_t from = entry_->input ? member : place.width();
    const uint32_t to = entry_->input ? place.width() : member;
    if (from <= to || (entry_->input && constantsFit(row, to))) return std::nullopt;
    return Mistake{fmt::format("{} bits of {} for the {} bits of {}", from, entry_->input ? row.member : row.name, to,
                               entry_->input ? row.name : row.member),
                   "as many, or room for more",
                   fmt::format("name a {} {}, or write cut = true where the value always fits",
                               entry_->input ? "longer cell" : "shorter one",
                               entry_->input ? "(D10:4 of GSK has 4 bytes)" : "or bind a longer member")};
  }

  // Whether all constants of an enumeration fit.
  bool constantsFit(const Row& row, uint32_t width) const {
    const std::vector<uint32_t>& constants = row.at.is->constants;
    const int64_t half = int64_t{1} << (width - 1);
    return !constants.empty() && std::ranges::all_of(constants, [&](uint32_t number) {
      const int64_t value = layout_.constants[number].value;
      return value >= -half && value < 2 * half;
    });
  }

  // Lets the library check the block, with temporary memory in place of the host's.
  bool fitBlock(const Row& row) {
    std::vector<uint8_t>& memory = *memory_.emplace_back(std::make_unique<std::vector<uint8_t>>(row.bytes));
    const rung_block block{row.name.c_str(), memory.data(), row.bytes, row.direction};
    const std::optional<Place> place = placeOf(row.name, entry_->input, false);
    if (place && entry_->input && place->space != RUNG_NONE && isOutputOnly(*place))
      return fail(Mistake{row.name + ", an output of the program", "a name that the host may write",
                          "move the line to [out]"}),
             false;
    if (rung_instance_bind_blocks(instance_, &block, 1) == RUNG_OK) return true;
    const std::string problem = rung_error_text();
    if (!cellInfo(instance_, row.name, RUNG_READ)) return fail(unknownName()), false;
    return fail(Mistake{fmt::format("{} bytes of {} for {}", row.bytes, row.member, row.name),
                        "room for a block of them", problem}),
           false;
  }

  // ---- mistakes

  std::nullopt_t fail(const std::string& what) {
    errors_.push_back({entry_->at, fmt::format("{}.{}: {}", entry_->input ? "in" : "out", entry_->member, what)});
    return std::nullopt;
  }
  std::nullopt_t fail(const Mistake& mistake) { return fail(mistake.text()); }
  std::nullopt_t failCounter(const Counter& counter, const std::string& what) {
    errors_.push_back({counter.at, "counters: " + what});
    return std::nullopt;
  }

  const HostLayout& layout_;
  rung_instance* instance_;
  const rung_program& program_;
  std::vector<Error>& errors_;
  const Entry* entry_ = nullptr;                              // the entry that is being checked
  std::vector<std::unique_ptr<std::vector<uint8_t>>> memory_; // memory of blocks, for the life of the instance
};

std::string constantsText(const HostLayout& layout, const codegen::HostMember& member) {
  std::string text;
  for (const uint32_t number : member.constants) {
    const codegen::EnumConstant& constant = layout.constants[number];
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", constant.name, constant.value);
  }
  return text;
}

std::string placeText(const Row& row) {
  return row.bits == 0 ? std::to_string(row.offset) : fmt::format("{}.{}", row.offset, row.bit);
}

std::string lineOf(const Row& row, const HostLayout& layout) {
  std::string line = fmt::format("{} {}: {} at {} = {}", (row.direction & RUNG_FROM_PROGRAM) != 0 ? "out" : "in",
                                 row.member, typeText(row), placeText(row), row.name);
  if (row.scale != 0) line += fmt::format(", scale {}", row.scale);
  if (!row.at.is->constants.empty()) line += fmt::format(" ({})", constantsText(layout, *row.at.is));
  return line + "\n";
}

} // namespace

Binding bind(const File& file, const HostLayout& layout, rung_instance* instance, const rung_program& program,
             std::vector<Error>& errors) {
  Binder binder(layout, instance, program, errors);
  Binding binding;
  for (const Entry& entry : file.entries)
    if (std::optional<Row> row = binder.row(entry)) binding.rows.push_back(std::move(*row));
  if (file.head && file.tail) binder.addCounters(*file.head, *file.tail, binding);
  if (file.entries.empty() && errors.empty())
    errors.push_back({{}, "the file binds nothing; write members below [in] and [out], or begin with --template"});
  return binding;
}

std::string typeText(const Row& row) {
  constexpr const char* kNames[] = {"", "bool", "i8", "u8", "i16", "u16", "i32", "u32", "i64", "float", "double"};
  if (row.type == 0) return fmt::format("{} bytes", row.bytes);
  if (row.bits != 0)
    return fmt::format("{} {}{}", row.bits, row.at.is->isSigned ? "signed " : "", row.bits == 1 ? "bit" : "bits");
  return kNames[row.type];
}

std::string describe(const Binding& binding, const HostLayout& layout) {
  std::string text = fmt::format("{}: {} bytes\n", layout.name, layout.bytes);
  for (const Row& row : binding.rows) text += lineOf(row, layout);
  if (binding.counterBytes != 0)
    text += fmt::format("counters {} at {} and {} at {}: u{}\n", binding.head.member, binding.head.offset,
                        binding.tail.member, binding.tail.offset, 8 * binding.counterBytes);
  return text;
}

} // namespace rung::bind
