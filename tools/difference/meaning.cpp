// The meaning of a rung as a hash (see meaning.h).
#include "tools/difference/meaning.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>

#include "ir/core/op_info.h"
#include "ir/core/ops.h"
#include "ir/support/hash.h"
#include "ir/support/put.h"
#include "rtlib/text/letters.h"

namespace rung::difference {
namespace {

using namespace ir;

class Meanings {
public:
  explicit Meanings(const Module& module) : module_(module) {
    for (const Symbol& symbol : module.symbols)
      if (symbol.space.valid() && (module.at(symbol.space).flags & RUNG_SPACE_ALLOCATED) != 0)
        names_[symbol.space.index].emplace(symbol.byte * 8 + symbol.bit, symbol.name);
  }

  void add(const Routine& routine, const Rung& rung, std::string& out) const {
    const bool byText = std::ranges::any_of(
        rung.ops, [&](const Op& op) { return opInfo(op.code).attr == Attr::Window && isAllocated(op); });
    for (const Op& op : rung.ops)
      if (op.code != OpCode::Note && !(byText && op.code == OpCode::Const)) addOp(rung, op, out);
    if (byText) addWords(rung.sourceText, out);
    const Transfer& transfer = rung.transfer;
    put(out, "{} {} {}", static_cast<int>(transfer.kind), transfer.cond.index, transfer.value.index);
    if (transfer.kind == TransferKind::Call) put(out, " {}", module_.at(transfer.callee).name);
    if (transfer.kind == TransferKind::Goto) addTarget(routine, transfer.target, out);
    for (const uint32_t target : transfer.targets) addTarget(routine, target, out);
    out += '\n';
  }

private:
  static void addTarget(const Routine& routine, uint32_t target, std::string& out) {
    if (target < routine.rungs.size()) put(out, " {:x}", routine.rungs[target].key);
  }

  bool isAllocated(const Op& op) const { return (module_.spaces[op.ref].flags & RUNG_SPACE_ALLOCATED) != 0; }

  // Which of several that are alike an instruction is ("~1") depends on the others, and says nothing of it.
  static std::string withoutOrdinals(std::string_view key) {
    std::string text;
    for (size_t at = 0; at < key.size();) {
      const size_t digits = key[at] == '~' ? key.find_first_not_of("0123456789", at + 1) : at;
      const size_t end = std::min(digits, key.size());
      const bool isOrdinal = end > at + 1 && (end == key.size() || key[end] == '/');
      if (isOrdinal)
        at = end;
      else
        text += key[at++];
    }
    return text;
  }

  // Without remarks and spaces.
  static void addWords(std::string_view text, std::string& out) {
    bool remark = false;
    for (const char c : text) {
      remark = c != '\n' && (remark || c == ';');
      if (!remark && c != ' ' && c != '\t') out += text::upper(c);
    }
  }

  void addOp(const Rung& rung, const Op& op, std::string& out) const {
    put(out, "{} {}", static_cast<int>(op.code), static_cast<int>(op.type));
    for (int i = 0; i < op.argCount; ++i) put(out, " %{}", arg(rung, op, i).index);
    addAttribute(op, out);
    out += '\n';
  }

  void addAttribute(const Op& op, std::string& out) const {
    switch (opInfo(op.code).attr) {
    case Attr::Place: return put(out, " {}", textOf(op, static_cast<uint32_t>(op.imm)));
    case Attr::Window: // one that is all of what the compiler gives out grows with it
      if (isAllocated(op)) return put(out, " {}", module_.spaces[op.ref].name);
      return put(out, " {} {}", textOf(op, static_cast<uint32_t>(op.imm)), op.count);
    case Attr::Slot: return put(out, " {}", withoutOrdinals(module_.at(SlotId{op.ref}).key));
    case Attr::Service: return put(out, " {}", module_.services[op.ref]);
    case Attr::Fault: return put(out, " {}", module_.faults[op.ref]);
    case Attr::Literal:
    case Attr::ResultNo: return put(out, " {}", op.imm);
    case Attr::Count: return put(out, " {}", op.count);
    case Attr::MessageOp: return put(out, " {}", op.ref);
    case Attr::Odds:
    case Attr::Text:
    case Attr::None: return;
    }
  }

  // Where the compiler gives addresses out: the name that begins at the place or before it, and the distance.
  std::string textOf(const Op& op, uint32_t bit) const {
    const auto names = names_.find(op.ref);
    if (names == names_.end()) return fmt::format("{}+{}", module_.spaces[op.ref].name, bit);
    const auto next = names->second.upper_bound(bit);
    if (next == names->second.begin()) return fmt::format("+{}", bit);
    const auto& [begin, name] = *std::prev(next);
    return fmt::format("{}+{}", withoutOrdinals(name), bit - begin);
  }

  const Module& module_;
  std::map<uint32_t, std::multimap<uint32_t, std::string>> names_; // by allocated space and bit
};

} // namespace

std::vector<DrawnRung> drawnRungs(const Module& module) {
  const Meanings meanings(module);
  std::vector<DrawnRung> drawn;
  for (const Routine& routine : module.routines)
    for (size_t i = 0; i < routine.rungs.size();) {
      std::string text;
      const Rung& first = routine.rungs[i];
      do meanings.add(routine, routine.rungs[i++], text);
      while (i < routine.rungs.size() && routine.rungs[i].number == first.number);
      if (first.number != 0) drawn.push_back({&routine, &first, hashBytes(text)});
    }
  return drawn;
}

} // namespace rung::difference
