// Follows writes back through the past (see why.h).
#include "tools/replay/why.h"

#include <algorithm>
#include <bit>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <optional>
#include <tuple>
#include <utility>

#include "ir/core/op_info.h"
#include "ir/core/ops.h"
#include "rtlib/load/program_info.h"
#include "rtlib/nc/names/names.h"
#include "tools/replay/reasons.h"
#include "tools/report/place_names.h"
#include "tools/scenario/session.h"
#include "tools/scenario/values.h"

namespace rung::replay {
namespace {

using ir::Access;
using ir::BitRange;

// Bits of a space, or a slot.
struct Cell {
  BitRange bits;
  ir::SlotId slot;
  bool real = false;
  bool operator==(const Cell& other) const { return bits == other.bits && slot == other.slot; }
};

// A moment within a part: before the access with this number of the run of a rung with this one.
struct Within {
  size_t run = SIZE_MAX; // SIZE_MAX: the end of the part
  size_t access = SIZE_MAX;
};

struct PartFacts {
  std::optional<Flow> flow;                  // nothing: none, or another program's
  std::vector<std::vector<uint64_t>> values; // by run
  std::vector<uint8_t> before;               // memory; empty: it does not follow from before
  std::vector<core::ForcedBits> forced;
  std::vector<OutsideWrite> outside;
  int64_t us = 0;
};

// Bits of a cell that are forced, and to what.
struct Held {
  uint64_t mask = 0, value = 0;
  uint64_t in(uint64_t now) const { return (now & ~mask) | value; }
};

uint64_t maskOf(uint32_t bits) { return bits >= 64 ? ~uint64_t{0} : (uint64_t{1} << bits) - 1; }

class Inquiry {
public:
  Inquiry(Past& past, const WhyOptions& options)
      : past_(past), options_(options), compiled_(past.compiled()), engine_(past.flowEngine()),
        program_(past.instance().program()), programNumber_(past.programNumber()), asked_(past.part()) {}

  Explanation run(const runtime::Ref& place) {
    const uint64_t here = past_.part();
    Cell cell{report::bitsOf(place), {}, place.kind == runtime::RefKind::Real};
    cell.bits.count = std::min(cell.bits.count, 64u);
    Explanation explanation;
    explanation.reason = reasonOf(cell, here, {});
    addSkipped(cell, here, explanation);
    addChange(cell, here, explanation);
    (void)past_.goTo(here);
    return explanation;
  }

  std::vector<std::string> writes(const runtime::Ref& place) {
    const uint64_t here = past_.part();
    const Cell cell{report::bitsOf(place), {}};
    std::vector<std::string> lines;
    const PartFacts& facts = factsOf(here);
    if (facts.flow)
      for (const RungFlow& run : facts.flow->runs())
        for (const Access& access : facts.flow->accesses(run))
          if (access.writes && touches(access, cell))
            lines.push_back(fmt::format("{}: {} = {}", runtime::rungText(program_, run.lowered, lineOf(access)),
                                        nameOf({access.place, access.slot}), engine_.shownValue(access)));
    (void)past_.goTo(here);
    return lines;
  }

private:
  const ir::Uses& uses() const { return *compiled_.uses; }

  // ---- cells ----

  static bool touches(const Access& access, const Cell& cell) {
    if (cell.slot.valid() || access.slot.valid()) return access.slot == cell.slot;
    return ir::overlap(access.place, cell.bits);
  }

  uint64_t valueIn(std::span<const uint8_t> block, const Cell& cell) {
    if (cell.slot.valid()) {
      const ir::Slot& slot = compiled_.shape->slots[cell.slot.index];
      const uint32_t at = compiled_.layout->memory().slot(cell.slot);
      uint64_t value = 0;
      for (uint32_t i = 0; i < std::max(1u, ir::byteWidth(slot.type)); ++i) value |= uint64_t{block[at + i]} << (8 * i);
      return value;
    }
    const core::Memory memory(program_, const_cast<uint8_t*>(block.data())); // which is only read
    uint64_t value = 0;
    for (uint32_t i = 0; i < cell.bits.count;) {
      const uint32_t bit = cell.bits.first + i;
      if (bit % 8 == 0 && cell.bits.count - i >= 8) {
        value |= uint64_t{memory.readByte(cell.bits.space.index, bit / 8)} << i;
        i += 8;
      } else {
        value |= uint64_t{memory.readBit(cell.bits.space.index, bit / 8, bit % 8)} << i;
        ++i;
      }
    }
    return value;
  }

  // The value after a write.
  static uint64_t after(uint64_t value, const Access& access, const Cell& cell) {
    if (cell.slot.valid()) return access.value;
    for (uint32_t i = 0; i < cell.bits.count; ++i) {
      const uint32_t at = cell.bits.first + i - access.place.first;
      if (at < access.place.count) value = (value & ~(uint64_t{1} << i)) | ((access.value >> at & 1) << i);
    }
    return value;
  }

  std::optional<BitRange> known(const Cell& cell) {
    return cell.slot.valid() ? std::nullopt : report::knownPlace(program_, uses(), cell.bits);
  }
  runtime::Ref refOf(const BitRange& bits, bool real) {
    if (real) return runtime::realRef(bits.space.index, bits.first / 8);
    if (bits.count == 1) return runtime::bitRef(bits.space.index, bits.first / 8, bits.first % 8);
    return runtime::intRef(bits.space.index, bits.first / 8, bits.count);
  }
  std::string nameOf(const Cell& cell) {
    if (const std::optional<BitRange> bits = known(cell)) return report::shownName(program_, refOf(*bits, cell.real));
    if (!cell.slot.valid()) return "memory of its own";
    // The key of a slot is of the compiler; the part after the last slash says what it is for.
    const std::string& key = compiled_.shape->slots[cell.slot.index].key;
    return fmt::format("its own state {}", key);
  }
  std::string shown(uint64_t value, const Cell& cell) {
    if (cell.real) return scenario::show(scenario::realReading(std::bit_cast<double>(value)));
    const uint32_t width =
        cell.slot.valid() ? ir::bitWidth(compiled_.shape->slots[cell.slot.index].type) : cell.bits.count;
    return scenario::show({.kind = scenario::ValueKind::Int, .integer = value, .width = width});
  }
  bool isTransient(const Cell& cell) const {
    return cell.slot.valid() && compiled_.shape->slots[cell.slot.index].transient;
  }

  // ---- parts ----

  const PartFacts& factsOf(uint64_t part) {
    if (const auto found = facts_.find(part); found != facts_.end()) return *found->second;
    auto facts = std::make_unique<PartFacts>();
    (void)past_.goTo(part);
    facts->us = past_.instance().nowUs();
    if (past_.programNumber() == programNumber_) fill(*facts);
    return *facts_.emplace(part, std::move(facts)).first->second;
  }

  void fill(PartFacts& facts) {
    const Flow* flow = past_.flow(
        [&](size_t, std::span<const uint64_t> values) { facts.values.emplace_back(values.begin(), values.end()); });
    if (flow != nullptr) facts.flow = *flow;
    const std::span<const uint8_t> before = past_.blockBefore();
    facts.before.assign(before.begin(), before.end());
    const std::span<const core::ForcedBits> forced = past_.instance().forcedBits();
    facts.forced.assign(forced.begin(), forced.end());
    facts.outside.assign(past_.outsideWrites().begin(), past_.outsideWrites().end());
  }

  // The last part before `part`, or that part, after which the cell has another value than after the one before it, for
  // each cell; nothing: none has been found. If the program took over in between, its first part. One pass for all.
  std::vector<std::optional<uint64_t>> lastChanges(const std::vector<Cell>& cells, uint64_t part) {
    std::vector<std::optional<uint64_t>> changes(cells.size());
    uint64_t end = part, size = 64;
    const uint64_t first = past_.firstPart();
    uint64_t left = options_.mostParts;
    while (end > first && left > 0) {
      const uint64_t begin = end - first > size ? end - size : first;
      left -= std::min(left, end - begin);
      if (!past_.goTo(begin).empty()) break;
      std::vector<uint64_t> last(cells.size());
      const auto read = [&] {
        for (size_t i = 0; i < cells.size(); ++i) last[i] = valueIn(past_.instance().block(), cells[i]);
      };
      std::vector<std::optional<uint64_t>> here(cells.size());
      bool runs = past_.programNumber() == programNumber_, tookOver = !runs;
      if (runs) read();
      while (past_.part() < end && past_.next()) {
        const bool ran = std::exchange(runs, past_.programNumber() == programNumber_);
        tookOver = tookOver || !runs;
        if (!runs) continue;
        if (!ran) { // the program takes over: nothing is followed further back
          here.assign(cells.size(), past_.part());
          read();
          continue;
        }
        for (size_t i = 0; i < cells.size(); ++i) {
          if (changes[i]) continue;
          const uint64_t now = valueIn(past_.instance().block(), cells[i]);
          if (now != std::exchange(last[i], now)) here[i] = past_.part();
        }
      }
      for (size_t i = 0; i < cells.size(); ++i)
        if (!changes[i]) changes[i] = here[i];
      if (tookOver) break;
      if (std::ranges::all_of(changes, [](const auto& change) { return change.has_value(); })) break;
      end = begin;
      size = std::min<uint64_t>(size * 4, 16384);
    }
    return changes;
  }

  // ---- reasons ----

  Reason plain(const Cell& cell, uint64_t value, Reason::Kind kind, uint64_t part, int64_t us) {
    Reason reason;
    reason.kind = kind;
    reason.name = nameOf(cell);
    reason.value = shown(value, cell);
    reason.part = part;
    reason.us = us;
    return reason;
  }

  // The byte of the block and the bit in it; nothing: it does not have one of its own.
  std::optional<std::pair<uint32_t, uint32_t>> blockBit(const Cell& cell, uint32_t i) {
    const uint32_t bit = cell.bits.first + i;
    const core::Place at = core::Memory(program_, nullptr).locateBit(cell.bits.space.index, bit / 8, bit % 8);
    if (at.outside() || at.apart()) return std::nullopt;
    return std::pair(at.offset(), at.bit());
  }
  Held heldOf(const Cell& cell, std::span<const core::ForcedBits> forces) {
    Held held;
    if (cell.slot.valid() || forces.empty()) return held;
    for (uint32_t i = 0; i < cell.bits.count; ++i) {
      const auto at = blockBit(cell, i);
      if (!at) continue;
      for (const core::ForcedBits& forced : forces) {
        if (forced.offset != at->first || (forced.mask >> at->second & 1) == 0) continue;
        held.mask |= uint64_t{1} << i;
        held.value |= uint64_t{forced.value >> at->second & 1u} << i;
      }
    }
    return held;
  }
  bool isWhole(const Held& held, const Cell& cell) const { return held.mask == maskOf(cell.bits.count); }

  // The write before the moment by which the cell got the value that it has then; nothing: none in this part. `value`
  // becomes that value, `fromBefore` whether the cell had it when the part began.
  std::optional<Within> writeIn(const PartFacts& facts, const Cell& cell, const Within& moment, uint64_t& value,
                                bool& fromBefore) {
    std::optional<Within> last;
    const bool follows = !facts.before.empty() && !isTransient(cell);
    const Held held = heldOf(cell, facts.forced);
    const uint64_t first = follows ? valueIn(facts.before, cell) : 0;
    uint64_t now = held.in(first);
    bool written = !follows;
    if (facts.flow)
      for (size_t r = 0; r < facts.flow->runs().size() && r <= moment.run; ++r) {
        const std::span<const Access> accesses = facts.flow->accesses(facts.flow->runs()[r]);
        for (size_t a = 0; a < accesses.size() && (r < moment.run || a < moment.access); ++a) {
          if (!touches(accesses[a], cell)) continue;
          if (!accesses[a].writes) { // what others have written since is seen by a read of all of it
            const bool whole = cell.slot.valid() || accesses[a].place == cell.bits;
            if (whole && accesses[a].value != now) {
              now = accesses[a].value;
              last.reset();
            }
            continue;
          }
          const uint64_t next = held.in(after(now, accesses[a], cell));
          if (next != now || written) last = Within{r, a};
          written = false;
          now = next;
        }
      }
    value = now;
    fromBefore = follows && now == first && !last;
    return last;
  }

  Reason reasonOf(const Cell& cell, uint64_t part, const Within& moment, std::optional<uint64_t> seen = {}) {
    ++count_;
    const PartFacts& facts = factsOf(part);
    if (const Held held = heldOf(cell, facts.forced); held.mask != 0 && isWhole(held, cell))
      return forced(cell, held.value, part);
    uint64_t value = 0;
    bool fromBefore = false;
    const std::optional<Within> write = writeIn(facts, cell, moment, value, fromBefore);
    if (moment.run == SIZE_MAX) {
      (void)past_.goTo(part);
      const uint64_t end = valueIn(past_.instance().block(), cell);
      if (!isTransient(cell) && end != value) return outside(cell, end, part, facts);
    } else if (seen && *seen != value) {
      return outside(cell, *seen, part, facts);
    }
    if (write) return wrote(cell, value, part, facts, *write);
    if (!fromBefore) return outside(cell, value, part, facts);
    const std::optional<uint64_t> change = lastChanges({cell}, part - 1)[0];
    if (!change) return unchanged(cell, value, part, moment);
    Reason reason = changedIn(cell, value, *change);
    if (reason.kind != Reason::Kind::Forced && reason.note.empty()) reason.note = heldSince(cell, *change, part);
    return reason;
  }

  // It has the value since the recording began: what writes it again and again says why, if anything does.
  Reason unchanged(const Cell& cell, uint64_t value, uint64_t part, const Within& moment) {
    uint64_t at = part;
    std::optional<Within> again = lastWriteIn(factsOf(at), cell, moment);
    for (const uint64_t first = scanBegin(part); !again && at > first;) again = lastWriteIn(factsOf(--at), cell, {});
    Reason reason =
        again ? wrote(cell, value, at, factsOf(at), *again) : plain(cell, value, Reason::Kind::Before, part, 0);
    reason.unchanged = true;
    reason.part = past_.firstPart();
    reason.us = timeOf(reason.part);
    if (reason.note.empty()) reason.note = heldSince(cell, reason.part, part);
    return reason;
  }
  // The first of the parts up to this one in which every task has had its turn: of a scan of several slices, or the
  // part itself.
  uint64_t scanBegin(uint64_t part) {
    if (!past_.goTo(part).empty()) return part;
    const uint64_t parts = past_.partsPerScan(), first = past_.firstPart() + 1;
    return std::max(std::min(first, part), part + 1 - std::min(parts, part));
  }
  // The last one before the moment, also of the value that it had.
  static std::optional<Within> lastWriteIn(const PartFacts& facts, const Cell& cell, const Within& moment) {
    std::optional<Within> last;
    if (!facts.flow) return last;
    for (size_t r = 0; r < facts.flow->runs().size() && r <= moment.run; ++r) {
      const std::span<const Access> accesses = facts.flow->accesses(facts.flow->runs()[r]);
      for (size_t a = 0; a < accesses.size() && (r < moment.run || a < moment.access); ++a)
        if (accesses[a].writes && touches(accesses[a], cell)) last = Within{r, a};
    }
    return last;
  }

  // The cell got the value in this part, and had it at its end.
  Reason changedIn(const Cell& cell, uint64_t value, uint64_t part) {
    const PartFacts& facts = factsOf(part);
    if (const Held held = heldOf(cell, facts.forced); held.mask != 0 && isWhole(held, cell))
      return forced(cell, value, part);
    uint64_t then = 0;
    bool fromBefore = false;
    const std::optional<Within> write = writeIn(facts, cell, {}, then, fromBefore);
    if (write && then == value) return wrote(cell, value, part, facts, *write);
    return outside(cell, value, part, facts);
  }

  // ---- forces ----

  // In the part that has led to `part`, and from when to when; the last force of it up to there.
  struct Force {
    uint64_t first = 0;           // the first part with it
    std::optional<uint64_t> last; // nothing: it is still in effect
    uint64_t value = 0;
  };
  std::optional<Force> lastForce(const Cell& cell, uint64_t upTo) {
    std::optional<Force> force;
    for (const ForceChange& change : past_.contents().forces) {
      if (change.part >= upTo) break;
      const Held held = heldOf(cell, change.bits);
      const bool all = held.mask != 0 && isWhole(held, cell);
      const bool goesOn = force && !force->last;
      if (goesOn && (!all || held.value != force->value)) force->last = change.part;
      if (all && (!goesOn || held.value != force->value)) force = Force{change.part + 1, std::nullopt, held.value};
    }
    return force;
  }

  Reason forced(const Cell& cell, uint64_t value, uint64_t part) {
    const std::optional<Force> force = lastForce(cell, part);
    const uint64_t since = force ? std::max(force->first, past_.firstPart()) : part;
    Reason reason = plain(cell, value, Reason::Kind::Forced, since, timeOf(since));
    reason.note = noteAt(reason.name, since);
    std::optional<uint64_t> until;
    for (const ForceChange& change : past_.contents().forces)
      if (change.part >= part && !until && heldOf(cell, change.bits).mask == 0) until = change.part;
    if (until && *until < asked_)
      reason.note += fmt::format("{}the force was removed after scan {}, and nothing has written another value",
                                 reason.note.empty() ? "" : "; ", *until);
    return reason;
  }

  // "" or that it was forced to the value that it has, after it got that in part `from`: what was written meanwhile had
  // no effect.
  std::string heldSince(const Cell& cell, uint64_t from, uint64_t part) {
    const std::optional<Force> force = lastForce(cell, part);
    if (!force || !force->last || *force->last <= from) return {};
    return fmt::format("it was forced to {} from scan {} to scan {}; what rungs wrote meanwhile had no effect",
                       shown(force->value, cell), std::max(force->first, from), *force->last);
  }

  // No rung wrote it in the part.
  Reason outside(const Cell& cell, uint64_t value, uint64_t part, const PartFacts& facts) {
    if (facts.before.empty()) return plain(cell, value, Reason::Kind::Start, part, facts.us);
    if (!cell.slot.valid()) {
      const std::vector<BitRange> sources = uses().copiedFrom(cell.bits);
      if (!sources.empty()) {
        Reason reason = plain(cell, value, Reason::Kind::Copy, part, facts.us);
        const Cell source{sources[0], {}, cell.real};
        if (visit(source, part)) reason.because.push_back(ofSource(source, part));
        return reason;
      }
    }
    Reason reason = plain(cell, value, writer(cell, facts), part, facts.us);
    if (reason.kind == Reason::Kind::Outside) reason.note = noteAt(reason.name, part);
    return reason;
  }
  // Who wrote it, as far as the recording says.
  Reason::Kind writer(const Cell& cell, const PartFacts& facts) {
    const bool controlRuns = past_.recording().mode == runtime::RecordingMode::Control && !cell.slot.valid();
    Reason::Kind kind = controlRuns ? Reason::Kind::Control : Reason::Kind::Outside;
    for (const OutsideWrite& write : facts.outside) {
      bool touches = false;
      for (uint32_t i = 0; i < cell.bits.count && !touches && !cell.slot.valid(); ++i) {
        const auto at = blockBit(cell, i);
        touches = at && at->first - write.offset < write.count;
      }
      if (!touches) continue;
      switch (write.by) {
      case OutsideWrite::By::Machine: kind = Reason::Kind::Machine; break;
      case OutsideWrite::By::Client: kind = Reason::Kind::Client; break;
      case OutsideWrite::By::Control: kind = Reason::Kind::Control; break;
      case OutsideWrite::By::Any: kind = Reason::Kind::Outside; break;
      }
    }
    return kind;
  }
  // What was copied at the beginning of a run is as before its first rung, what is copied at the end as after its last.
  Reason ofSource(const Cell& source, uint64_t part) { return reasonOf(source, part, {}); }

  // The statements of a scenario that did something before the part: that of the cell, otherwise all if they are few.
  std::string noteAt(const std::string& name, uint64_t part) const {
    constexpr size_t kFew = 3;
    const std::string symbol = " " + name.substr(0, name.find(' ')) + " ";
    const auto acts = [](std::string_view text) {
      constexpr std::string_view kActing[] = {"set ", "block ", "event ", "plc ", "reply "};
      return std::ranges::any_of(kActing, [&](std::string_view word) {
        const size_t at = text.find(word);
        return at == 0 || (at != std::string_view::npos && text[at - 1] == ' ');
      });
    };
    std::vector<std::string> acting;
    for (const Landmark& note : past_.contents().landmarks) {
      if (note.kind != Landmark::Kind::Note || note.part + 1 != part || note.text.find("expect") != std::string::npos)
        continue;
      if (note.text.find(symbol) != std::string::npos) return note.text;
      if (acts(note.text)) acting.push_back(note.text);
    }
    return acting.size() > kFew ? std::string() : fmt::format("{}", fmt::join(acting, "; "));
  }

  bool visit(const Cell& cell, uint64_t part) {
    if (count_ >= options_.most) return false;
    for (const auto& [known, at] : visited_)
      if (known == cell && at == part) return false;
    visited_.emplace_back(cell, part);
    return true;
  }

  uint32_t lineOf(const Access& access) {
    const ir::Rung& rung = engine_.rung(access.rung);
    return ir::lineOf(rung, rung.ops[access.operation]);
  }

  Reason wrote(const Cell& cell, uint64_t value, uint64_t part, const PartFacts& facts, const Within& write) {
    Reason reason = plain(cell, value, Reason::Kind::Rung, part, facts.us);
    const RungFlow& run = facts.flow->runs()[write.run];
    const std::span<const Access> accesses = facts.flow->accesses(run);
    const Access& access = accesses[write.access];
    const ir::Rung& rung = engine_.rung(run.lowered);
    const ir::Op& op = rung.ops[access.operation];
    reason.lowered = run.lowered;
    reason.line = ir::lineOf(rung, op);
    reason.rung = runtime::rungText(program_, run.lowered, reason.line);
    if (rung.begin.file.valid()) reason.file = compiled_.shape->files[rung.begin.file.index];
    reason.computed = op.code == ir::OpCode::StoreAt || op.code == ir::OpCode::StoreBitAt;
    if (run.faulted || facts.values[write.run].empty()) return reason;
    const RungReasons reasons(rung, facts.values[write.run]);
    const std::vector<Leaf> leaves = reasons.of(access.operation);
    follow(reason, leaves, part, facts, write.run);
    return reason;
  }

  // Of the rung that wrote the bit last in the part of the question; if none did, of the one that gave it the value.
  void addChange(const Cell& cell, uint64_t part, Explanation& explanation) {
    if (cell.bits.count != 1 || explanation.reason.kind != Reason::Kind::Rung) return;
    std::optional<Within> write = lastWriteIn(factsOf(part), cell, {});
    if (!write && explanation.skipped.empty() && part != explanation.reason.part)
      write = lastWriteIn(factsOf(part = explanation.reason.part), cell, {});
    const PartFacts& facts = factsOf(part);
    if (!write || facts.values[write->run].empty()) return;
    const RungFlow& run = facts.flow->runs()[write->run];
    const ir::Rung& rung = engine_.rung(run.lowered);
    const RungReasons reasons(rung, facts.values[write->run]);
    for (const Leaf& leaf : reasons.toChange(facts.flow->accesses(run)[write->access].operation)) {
      const auto [read, value] = cellOf(leaf, rung, facts, run);
      explanation.toChange.push_back(
          read ? fmt::format("{} = {}", nameOf(*read), value == 0 ? 1 : 0)
               : fmt::format("the result of line {}", ir::lineOf(rung, rung.ops[leaf.operation])));
    }
  }

  // What a load has read; nothing for other leaves.
  std::pair<std::optional<Cell>, uint64_t> cellOf(const Leaf& leaf, const ir::Rung& rung, const PartFacts& facts,
                                                  const RungFlow& run, size_t* number = nullptr) {
    const std::span<const Access> accesses = facts.flow->accesses(run);
    for (size_t a = accesses.size(); a-- > 0;) {
      if (accesses[a].operation != leaf.operation || accesses[a].writes) continue;
      if (number != nullptr) *number = a;
      const bool real = rung.ops[leaf.operation].type == ir::Type::F64;
      return {Cell{accesses[a].place, accesses[a].slot, real}, accesses[a].value};
    }
    return {std::nullopt, 0};
  }

  // A leaf of a run that ran at `moment` within the part.
  struct Operand {
    Leaf leaf;
    Cell cell;
    uint64_t value = 0;
    Within at;
    int rank = 0;                  // the chain prefers a higher one
    std::optional<uint64_t> since; // the part of its last change; nothing: before the recording
  };
  struct Operands {
    std::vector<Operand> all;
    bool clock = false, answer = false;
    bool hasNames() const {
      return std::ranges::any_of(all, [](const Operand& o) { return !o.cell.slot.valid(); });
    }
  };

  // What the author named comes before what the rung keeps for itself, and that before state of the compiler.
  void add(Operands& to, const std::vector<Leaf>& leaves, const PartFacts& facts, size_t runNumber) {
    const RungFlow& run = facts.flow->runs()[runNumber];
    const ir::Rung& rung = engine_.rung(run.lowered);
    for (const Leaf& leaf : leaves) {
      const ir::OpCode code = rung.ops[leaf.operation].code;
      size_t number = 0;
      const auto [cell, value] = cellOf(leaf, rung, facts, run, &number);
      to.clock = to.clock || code == ir::OpCode::Now || (cell && isClock(*cell));
      to.answer = to.answer || code == ir::OpCode::ServicePoll || code == ir::OpCode::ServiceResult;
      if (!cell || isClock(*cell)) continue;
      const bool own = std::ranges::any_of(facts.flow->accesses(run), [&, c = *cell](const Access& access) {
        return access.writes && touches(access, c);
      });
      const int rank = cell->slot.valid() ? 0 : own ? 1 : 2;
      const auto same = std::ranges::find_if(to.all, [&, c = *cell](const Operand& o) { return o.cell == c; });
      if (same == to.all.end()) to.all.push_back({leaf, *cell, value, {runNumber, number}, rank, {}});
    }
  }

  // What led to a rung that does not always run: the last rung before it in the part that decides whether it does; in a
  // routine that has none, whether the routine is called.
  void addDecider(Operands& to, const PartFacts& facts, size_t runNumber) {
    const uint32_t led = facts.flow->runs()[runNumber].lowered;
    if (addLast(to, facts, runNumber, uses().decidersOf(led))) return;
    const std::vector<uint32_t> callers = uses().callersOf(led);
    if (addLast(to, facts, runNumber, callers)) return;
    for (size_t r = runNumber; r-- > 0;)
      if (std::ranges::find(callers, facts.flow->runs()[r].lowered) != callers.end()) return addDecider(to, facts, r);
  }

  // Of the runs before this one, the last one of such a rung whose transfer has a condition with names.
  bool addLast(Operands& to, const PartFacts& facts, size_t runNumber, const std::vector<uint32_t>& rungs) {
    for (size_t r = runNumber; r-- > 0;) {
      const uint32_t lowered = facts.flow->runs()[r].lowered;
      if (std::ranges::find(rungs, lowered) == rungs.end() || facts.values[r].empty()) continue;
      const ir::Transfer& transfer = engine_.rung(lowered).transfer;
      const ir::ValueId value = transfer.cond.valid() ? transfer.cond : transfer.value;
      if (!value.valid()) continue;
      add(to, RungReasons(engine_.rung(lowered), facts.values[r]).ofValue(value.index), facts, r);
      if (to.hasNames()) return true;
    }
    return false;
  }

  void follow(Reason& reason, const std::vector<Leaf>& leaves, uint64_t part, const PartFacts& facts,
              size_t runNumber) {
    Operands operands;
    add(operands, leaves, facts, runNumber);
    if (!operands.hasNames()) addDecider(operands, facts, runNumber);
    findSince(operands.all, part, facts);
    // Of those that have changed, what has a name comes first, and of these the one that changed last: it is the cause
    // of the change, and the chain continues there.
    std::ranges::stable_sort(operands.all, [](const Operand& a, const Operand& b) {
      return std::tuple(a.since.has_value(), a.rank, a.since, a.leaf.alone) >
             std::tuple(b.since.has_value(), b.rank, b.since, b.leaf.alone);
    });
    for (const Operand& operand : operands.all) {
      const uint64_t since = operand.since.value_or(past_.firstPart());
      const Reason::Kind kept = operand.since ? Reason::Kind::Kept : Reason::Kind::Before;
      Reason next = reason.because.empty() && visit(operand.cell, since)
                        ? reasonOf(operand.cell, part, operand.at, operand.value)
                        : plain(operand.cell, operand.value, kept, since, timeOf(since));
      next.alone = operand.leaf.alone;
      next.isIndex = operand.leaf.isIndex;
      reason.because.push_back(std::move(next));
    }
    if (operands.clock) reason.because.push_back(bare(Reason::Kind::Clock, part, facts));
    if (operands.answer) reason.because.push_back(bare(Reason::Kind::Answer, part, facts));
  }

  void findSince(std::vector<Operand>& operands, uint64_t part, const PartFacts& facts) {
    std::vector<Cell> cells;
    std::vector<Operand*> whose;
    for (Operand& operand : operands) {
      uint64_t value = 0;
      bool fromBefore = false;
      const bool here = writeIn(facts, operand.cell, operand.at, value, fromBefore).has_value() || !fromBefore ||
                        value != operand.value;
      if (here) {
        operand.since = part;
        continue;
      }
      cells.push_back(operand.cell);
      whose.push_back(&operand);
    }
    if (cells.empty() || part == 0) return;
    const std::vector<std::optional<uint64_t>> changes = lastChanges(cells, part - 1);
    for (size_t i = 0; i < cells.size(); ++i) whose[i]->since = changes[i];
  }

  static Reason bare(Reason::Kind kind, uint64_t part, const PartFacts& facts) {
    Reason reason;
    reason.kind = kind;
    reason.name = kind == Reason::Kind::Clock ? "the clock" : "an answer of the control";
    reason.part = part;
    reason.us = facts.us;
    return reason;
  }
  // Where the compiler keeps the time of a task for all its timers.
  bool isClock(const Cell& cell) const {
    if (!cell.slot.valid()) return false;
    const std::string& key = compiled_.shape->slots[cell.slot.index].key;
    return key.starts_with("@clock/") || key.starts_with("@scan/");
  }

  int64_t timeOf(uint64_t part) {
    if (!past_.goTo(std::max(part, past_.firstPart())).empty()) return 0;
    return past_.instance().nowUs();
  }

  void addSkipped(const Cell& cell, uint64_t part, Explanation& explanation) {
    if (!factsOf(part).flow || cell.slot.valid()) return;
    const uint64_t first = scanBegin(part);
    const auto ran = [&](uint32_t lowered) {
      for (uint64_t at = first; at <= part; ++at)
        if (const PartFacts& facts = factsOf(at); facts.flow)
          for (const RungFlow& run : facts.flow->runs())
            if (run.lowered == lowered) return true;
      return false;
    };
    for (const uint32_t writer : uses().writersOf(cell.bits).certain) {
      if (ran(writer)) continue;
      std::string text = fmt::format("{} did not run in this scan", runtime::rungText(program_, writer));
      for (const uint32_t decider : uses().decidersOf(writer))
        if (ran(decider)) {
          text += fmt::format("; {} jumped over it", runtime::rungText(program_, decider));
          break;
        }
      explanation.skipped.push_back(std::move(text));
    }
  }

  Past& past_;
  const WhyOptions& options_;
  // Of the program of the question, also while other parts are visited.
  const compiler::Compiled& compiled_;
  FlowEngine& engine_;
  const rung_program& program_;
  const uint32_t programNumber_; // changes of the program end the search
  const uint64_t asked_;         // the part of the question
  std::map<uint64_t, std::unique_ptr<PartFacts>> facts_;
  std::vector<std::pair<Cell, uint64_t>> visited_;
  size_t count_ = 0;
};

// ---- text --------------------------------------------------------------------------------------------------------

std::string sinceText(const Reason& reason) {
  if (reason.kind == Reason::Kind::Before || reason.unchanged) return "unchanged since the recording began";
  return "since " + scenario::scanText(reason.part, reason.us);
}

} // namespace

std::string kindText(const Reason& reason) {
  switch (reason.kind) {
  case Reason::Kind::Rung:
    return fmt::format("written by {}{}", reason.rung, reason.computed ? ", at a computed address" : "");
  case Reason::Kind::Copy: return "copied when a task began or ended";
  case Reason::Kind::Outside: return "written from outside: by the machine, the control or a person";
  case Reason::Kind::Machine: return "an input, written by the machine";
  case Reason::Kind::Client: return "written by a person or another program, through the host";
  case Reason::Kind::Control: return "written by the control or the machine";
  case Reason::Kind::Forced: return "forced by a person";
  case Reason::Kind::Start: return "as the program was started, or a state loaded";
  case Reason::Kind::Before:
  case Reason::Kind::Clock:
  case Reason::Kind::Answer:
  case Reason::Kind::Kept: break;
  }
  return {};
}

namespace {

std::string operandText(const Reason& reason) {
  if (reason.kind == Reason::Kind::Clock || reason.kind == Reason::Kind::Answer) return reason.name;
  return fmt::format("{} = {}, {}{}{}", reason.name, reason.value, sinceText(reason),
                     reason.alone ? ", decided alone" : "", reason.isIndex ? ", determined the address" : "");
}

void put(const Reason& reason, std::string& text) {
  if (const std::string kind = kindText(reason); !kind.empty()) text += fmt::format("\n    {}", kind);
  if (!reason.note.empty()) text += fmt::format("\n      {}", reason.note);
  for (const Reason& because : reason.because) text += fmt::format("\n      {}", operandText(because));
  for (const Reason& because : reason.because) {
    const bool goesOn = !kindText(because).empty();
    if (!goesOn) continue;
    text += fmt::format("\n  {} = {}, {}", because.name, because.value, sinceText(because));
    put(because, text);
  }
}

constexpr std::string_view kKindNames[] = {"rung",  "copy",   "outside", "machine", "client", "control", "forced",
                                           "start", "before", "clock",   "answer",  "kept"}; // by Reason::Kind

nlohmann::json jsonOfReason(const Reason& reason) {
  nlohmann::json json{{"kind", kKindNames[static_cast<size_t>(reason.kind)]},
                      {"name", reason.name},
                      {"value", reason.value},
                      {"scan", reason.part},
                      {"us", reason.us}};
  if (reason.kind == Reason::Kind::Rung)
    json.update({{"rung", reason.rung}, {"file", reason.file}, {"line", reason.line}});
  if (reason.unchanged) json["unchanged"] = true;
  if (reason.alone) json["alone"] = true;
  if (reason.isIndex) json["index"] = true;
  if (reason.computed) json["computed"] = true;
  if (!reason.note.empty()) json["note"] = reason.note;
  for (const Reason& because : reason.because) json["because"].push_back(jsonOfReason(because));
  return json;
}

} // namespace

Explanation why(Past& past, const runtime::Ref& place, const WhyOptions& options) {
  return Inquiry(past, options).run(place);
}

std::vector<std::string> writesOf(Past& past, const runtime::Ref& place) {
  const WhyOptions options;
  return Inquiry(past, options).writes(place);
}

std::string textOf(const Explanation& explanation) {
  std::string text = operandText(explanation.reason);
  put(explanation.reason, text);
  for (const std::string& skipped : explanation.skipped) text += fmt::format("\n  {}", skipped);
  if (!explanation.toChange.empty())
    text += fmt::format("\n  it would be different with {}", fmt::join(explanation.toChange, " and "));
  return text;
}

std::string jsonOf(const Explanation& explanation) {
  nlohmann::json json = jsonOfReason(explanation.reason);
  if (!explanation.toChange.empty()) json["to_change"] = explanation.toChange;
  if (!explanation.skipped.empty()) json["skipped"] = explanation.skipped;
  return json.dump(2);
}

} // namespace rung::replay
