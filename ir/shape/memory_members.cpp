// Collects the members (see memory_members.h): symbols first, then the remaining addresses.
#include "ir/shape/memory_members.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>
#include <string_view>
#include <tuple>
#include <unordered_set>

#include "ir/core/op_info.h"
#include "rtlib/text/letters.h"

namespace rung::ir {
namespace {

// Names that a C++ compiler or gdb does not accept for a member; `rung_memory` is the struct itself.
constexpr std::string_view kReserved[] = {"_FORTIFY_SOURCE",
                                          "_GNU_SOURCE",
                                          "_LP64",
                                          "_REENTRANT",
                                          "_STDC_PREDEF_H",
                                          "alignas",
                                          "alignof",
                                          "and",
                                          "and_eq",
                                          "asm",
                                          "auto",
                                          "bitand",
                                          "bitor",
                                          "bool",
                                          "break",
                                          "case",
                                          "catch",
                                          "char",
                                          "char16_t",
                                          "char32_t",
                                          "char8_t",
                                          "class",
                                          "co_await",
                                          "co_return",
                                          "co_yield",
                                          "compl",
                                          "concept",
                                          "const",
                                          "const_cast",
                                          "consteval",
                                          "constexpr",
                                          "constinit",
                                          "continue",
                                          "decltype",
                                          "default",
                                          "delete",
                                          "do",
                                          "double",
                                          "dynamic_cast",
                                          "else",
                                          "enum",
                                          "explicit",
                                          "export",
                                          "extern",
                                          "false",
                                          "float",
                                          "for",
                                          "friend",
                                          "goto",
                                          "i386",
                                          "if",
                                          "inline",
                                          "int",
                                          "linux",
                                          "long",
                                          "mutable",
                                          "namespace",
                                          "new",
                                          "noexcept",
                                          "not",
                                          "not_eq",
                                          "nullptr",
                                          "operator",
                                          "or",
                                          "or_eq",
                                          "private",
                                          "protected",
                                          "public",
                                          "register",
                                          "reinterpret_cast",
                                          "requires",
                                          "return",
                                          "rung_memory",
                                          "short",
                                          "signed",
                                          "sizeof",
                                          "static",
                                          "static_assert",
                                          "static_cast",
                                          "struct",
                                          "switch",
                                          "template",
                                          "this",
                                          "thread_local",
                                          "throw",
                                          "true",
                                          "try",
                                          "typedef",
                                          "typeid",
                                          "typename",
                                          "typeof",
                                          "union",
                                          "unix",
                                          "unsigned",
                                          "using",
                                          "virtual",
                                          "void",
                                          "volatile",
                                          "wchar_t",
                                          "while",
                                          "xor",
                                          "xor_eq"};
static_assert(std::ranges::is_sorted(kReserved));

std::string identifier(std::string_view name) {
  std::string out;
  if (name.empty() || text::isDigit(name.front())) out += '_';
  for (const char c : name) out += text::isDigit(c) || text::isLetter(c) ? c : '_';
  // Names with this beginning may be macros of the compiler: __FILE__, __x86_64__.
  if (std::ranges::binary_search(kReserved, std::string_view(out)) || out.starts_with("__")) out += '_';
  return out;
}

Type elementType(const Symbol& symbol) {
  switch (symbol.type) {
  case RUNG_TYPE_BIT: return Type::Bit;
  case RUNG_TYPE_I16: return Type::I16;
  case RUNG_TYPE_I32: return Type::I32;
  case RUNG_TYPE_I64: return Type::I64;
  case RUNG_TYPE_F64: return Type::F64;
  default: return Type::I8; // a text is an array of bytes
  }
}

bool isShown(const Symbol& symbol) {
  return (symbol.flags & (RUNG_SYMBOL_CONST | RUNG_SYMBOL_HIDDEN)) == 0 && symbol.space.valid();
}

// A place in an operation: a bit, or the first byte of a cell.
struct Address {
  SpaceId space;
  uint64_t bit = 0; // from the beginning of the space
  Type type = Type::Bit;

  uint32_t byte() const { return static_cast<uint32_t>(bit / 8); }
  auto key() const { return std::tuple(space.index, bit, type); }
  bool operator<(const Address& other) const { return key() < other.key(); }
};

class Collector {
public:
  explicit Collector(const MemoryLayout& layout) : layout_(layout), module_(layout.module()) {
    for (const Space& space : module_.spaces)
      cells_.emplace_back(static_cast<size_t>(space.units) * space.unitBytes, nullptr);
  }

  std::vector<MemoryMember> run() {
    // A symbol that is an identifier keeps its name, even if others are mapped to it.
    for (const bool mapped : {false, true})
      for (const Symbol& symbol : module_.symbols)
        if (isShown(symbol) && (identifier(symbol.name) != symbol.name) == mapped) addSymbol(symbol);
    for (const Address& address : addressesOfRungs()) {
      addAddress(address);
      // Reals are also copied as bit patterns.
      if (address.type == Type::I64) addAddress({address.space, address.bit, Type::F64});
    }
    std::ranges::sort(members_, {}, [](const MemoryMember& m) { return std::tie(m.firstBit, m.name); });
    return std::move(members_);
  }

private:
  void addSymbol(const Symbol& symbol) {
    const std::string name = uniqueName(identifier(symbol.name));
    const Type type = elementType(symbol);
    const uint64_t first = uint64_t{symbol.byte} * 8;
    if (type != Type::Bit) {
      coverCells(symbol, byteWidth(type) * symbol.count);
      return add(name, {symbol.space, first, type}, symbol.count, symbol.type == RUNG_TYPE_TEXT);
    }
    for (uint32_t i = 0; i < symbol.count; ++i) {
      const Address bit{symbol.space, first + symbol.bit + i, type};
      namedBits_.insert(bit);
      add(symbol.count == 1 ? name : uniqueName(fmt::format("{}_{}", name, i)), bit, 1, false);
    }
  }

  void coverCells(const Symbol& symbol, uint32_t bytes) {
    std::vector<const Symbol*>& cells = cells_[symbol.space.index];
    const size_t end = std::min<size_t>(cells.size(), size_t{symbol.byte} + bytes);
    for (size_t i = symbol.byte; i < end; ++i)
      // Of several symbols, the one with the fewest bytes is the most specific.
      if (cells[i] == nullptr ||
          symbol.count * byteWidth(elementType(symbol)) < cells[i]->count * byteWidth(elementType(*cells[i])))
        cells[i] = &symbol;
  }

  std::set<Address> addressesOfRungs() const {
    std::set<Address> found;
    for (const Routine& routine : module_.routines)
      for (const Rung& rung : routine.rungs)
        for (const Op& op : rung.ops) {
          if (opInfo(op.code).attr != Attr::Place) continue;
          const Address address = original({SpaceId{op.ref}, static_cast<uint64_t>(op.imm), op.type});
          if ((module_.at(address.space).flags & RUNG_SPACE_HIDDEN) == 0) found.insert(address);
        }
    return found;
  }

  // A latch is in a hidden space; users know the place from which it was copied.
  Address original(const Address& address) const {
    if ((module_.at(address.space).flags & RUNG_SPACE_HIDDEN) == 0) return address;
    for (const Task& task : module_.tasks)
      for (const Copy& copy : task.begin)
        if (copy.to == address.space && address.byte() - copy.toByte < copy.from.size)
          return {copy.from.space, address.bit - uint64_t{copy.toByte} * 8 + uint64_t{copy.from.byte} * 8,
                  address.type};
    return address;
  }

  void addAddress(const Address& address) {
    if (address.type == Type::Bit && namedBits_.contains(address)) return;
    const Symbol* cell = cells_[address.space.index][address.byte()];
    const std::string name = cell != nullptr ? nameInCell(*cell, address) : addressName(address);
    if (!name.empty() && !names_.contains(name)) add(uniqueName(name), address, 1, false);
  }

  // Empty if the symbol's own member shows it.
  std::string nameInCell(const Symbol& cell, const Address& address) const {
    const Type type = elementType(cell);
    const uint64_t into = address.bit - uint64_t{cell.byte} * 8;
    const std::string element = cell.count == 1 ? "" : fmt::format("_{}", into / bitWidth(type));
    const uint64_t rest = into % bitWidth(type);
    if (address.type == Type::Bit) return fmt::format("{}{}_{}", identifier(cell.name), element, rest);
    if (rest != 0) return addressName(address);
    if (address.type == type) return {};
    return fmt::format("{}{}_{}", identifier(cell.name), element, typeName(address.type));
  }

  // X2_1, D10, D10_i16: the space's name, the number of the unit, and the bit in it or a type other than the unit's.
  std::string addressName(const Address& address) const {
    const Space& space = module_.at(address.space);
    const uint64_t unitBits = uint64_t{space.unitBytes} * 8;
    std::string unit = identifier(fmt::format("{}{}", space.name, address.bit / unitBits));
    const uint64_t rest = address.bit % unitBits;
    if (address.type == Type::Bit) return fmt::format("{}_{}", unit, rest);
    const std::string byte = rest == 0 ? "" : fmt::format("_byte{}", rest / 8);
    if (rest == 0 && address.type == intOfBytes(space.unitBytes)) return unit;
    return fmt::format("{}{}_{}", unit, byte, typeName(address.type));
  }

  void add(const std::string& name, const Address& address, uint32_t count, bool text) {
    MemoryMember member{.name = name, .count = count, .type = address.type, .text = text};
    if (address.type == Type::Bit) {
      const BitLocation place = layout_.bit(address.space, address.bit);
      member.firstBit = uint64_t{place.offset} * 8 + place.bit;
      member.width = place.wholeByte ? 8 : 1;
    } else {
      member.firstBit = uint64_t{layout_.byte(address.space, address.byte())} * 8;
      member.width = bitWidth(address.type);
    }
    members_.push_back(std::move(member));
  }

  std::string uniqueName(const std::string& wanted) {
    std::string name = wanted;
    for (int i = 2; !names_.insert(name).second; ++i) name = fmt::format("{}_{}", wanted, i);
    return name;
  }

  const MemoryLayout& layout_;
  const Module& module_;
  std::vector<std::vector<const Symbol*>> cells_; // by space and byte: the symbol of the cell that contains it
  std::set<Address> namedBits_;
  std::unordered_set<std::string> names_;
  std::vector<MemoryMember> members_;
};

} // namespace

uint32_t bytesOf(const std::vector<MemoryMember>& members) {
  uint64_t end = 0;
  for (const MemoryMember& member : members) end = std::max(end, member.endBit());
  return static_cast<uint32_t>((end + 7) / 8);
}

std::vector<MemoryMember> memoryMembers(const MemoryLayout& layout) { return Collector(layout).run(); }

} // namespace rung::ir
