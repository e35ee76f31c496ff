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
#include "rtlib/run/timer_state.h"
#include "sim/simulated_nc.h"
#include "tools/replay/reasons.h"
#include "tools/replay/record_run.h"
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
    explanation.beginning = options_.beginning;
    explanation.reason = reasonOf(cell, here, {});
    addOthers(cell, here, explanation);
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
  bool isReal(const BitRange& bits) { return nc::meant(program_, refOf(bits, false)).kind == runtime::RefKind::Real; }
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
    const Held held = heldOf(cell, factsOf(part).forced);
    if (held.mask != 0 && isWhole(held, cell)) return forced(cell, held.value, part);
    Reason reason = ofWrites(cell, part, moment, seen);
    reason.partForced = held.mask != 0;
    return reason;
  }

  Reason ofWrites(const Cell& cell, uint64_t part, const Within& moment, std::optional<uint64_t> seen) {
    const PartFacts& facts = factsOf(part);
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
    Reason reason = again ? wrote(cell, value, at, factsOf(at), *again) : asItBegan(cell, value, part);
    reason.unchanged = true;
    reason.part = past_.firstPart();
    reason.us = timeOf(reason.part);
    if (reason.note.empty()) reason.note = heldSince(cell, reason.part, part);
    return reason;
  }
  // No rung has written it in this scan: a statement before the first scan has, or nothing at all.
  Reason asItBegan(const Cell& cell, uint64_t value, uint64_t part) {
    Reason reason = plain(cell, value, Reason::Kind::Before, part, 0);
    if (cell.slot.valid() || past_.firstPart() != 0) return reason;
    reason.note = setAt(cell, 1);
    if (!reason.note.empty()) reason.kind = Reason::Kind::Outside;
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
    reason.note = noteAt(cell, since);
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
    if (facts.before.empty()) {
      Reason reason = plain(cell, value, Reason::Kind::Start, part, facts.us);
      reason.note = startedAt(part);
      return reason;
    }
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
    if (reason.kind == Reason::Kind::Outside) reason.note = noteAt(cell, part);
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

  // Statements that have something done to the program before the part, as their marks say it, and what they say.
  std::vector<std::pair<const std::string*, scenario::Statement>> statementsAt(uint64_t part) const {
    std::vector<std::pair<const std::string*, scenario::Statement>> found;
    for (const Landmark& note : past_.contents().landmarksAt(part - 1))
      if (note.kind == Landmark::Kind::Note)
        if (std::optional<scenario::Statement> statement = statementOf(note.text))
          found.emplace_back(&note.text, std::move(*statement));
    return found;
  }
  // The last one that gave the cell a value; "": none.
  std::string setAt(const Cell& cell, uint64_t part) const {
    std::string last;
    for (const auto& [text, statement] : statementsAt(part)) {
      if (statement.kind != scenario::Kind::Set && statement.kind != scenario::Kind::Force) continue;
      for (const auto& place :
           {names_->readPlace(program_, statement.name), names_->writePlace(program_, statement.name)})
        if (place && place->kind != runtime::RefKind::Constant && ir::overlap(report::bitsOf(*place), cell.bits))
          last = *text;
    }
    return last;
  }
  // The one that started the program or loaded a state; "": none.
  std::string startedAt(uint64_t part) const {
    std::string last;
    for (const auto& [text, statement] : statementsAt(part)) {
      using enum scenario::Kind;
      const scenario::Kind kind = statement.kind;
      if (kind == ColdStart || kind == WarmStart || kind == Restore || kind == Replace) last = *text;
    }
    return last;
  }
  // That which set it; otherwise all that did something, if they are few.
  std::string noteAt(const Cell& cell, uint64_t part) const {
    constexpr size_t kFew = 3;
    if (std::string set = setAt(cell, part); !set.empty()) return set;
    std::vector<std::string> acting;
    for (const auto& [text, statement] : statementsAt(part)) {
      using enum scenario::Kind;
      const scenario::Kind kind = statement.kind;
      if (kind == Set || kind == Block || kind == Event || kind == Plc || kind == Reply) acting.push_back(*text);
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
    for (const Leaf& leaf : changeOf(reasons, cell, facts.flow->accesses(run), *write)) {
      const auto [read, value] = cellOf(leaf, rung, facts, run);
      explanation.toChange.push_back(read ? fmt::format("{} = {}", nameOf(*read), value == 0 ? 1 : 0)
                                          : resultText(leaf, reasons, part, facts, run));
    }
  }

  // A result that would have to be different: of a timer, or computed otherwise.
  std::string resultText(const Leaf& leaf, const RungReasons& reasons, uint64_t part, const PartFacts& facts,
                         const RungFlow& run) {
    const ir::Rung& rung = engine_.rung(run.lowered);
    const std::vector<Timed> timers = timersOf(reasons.ofValue(leaf.value), facts, run);
    if (timers.empty()) return fmt::format("the result of line {}", ir::lineOf(rung, rung.ops[leaf.operation]));
    return fmt::format("the time of {} {}", timers[0].timer->name, isOver(timers[0], part) ? "not over" : "over");
  }

  // ---- timers ----

  struct Timed {
    const rung_timer* timer;
    Cell time;
  };
  bool isTimeOf(const rung_timer& timer, const Cell& cell) const {
    if (cell.slot.valid())
      return timer.time_space == RUNG_NONE && timer.time_at == compiled_.layout->memory().slot(cell.slot);
    return timer.time_space == cell.bits.space.index && timer.time_at == cell.bits.first / 8;
  }
  // Those whose time is among what was read.
  std::vector<Timed> timersOf(const std::vector<Leaf>& leaves, const PartFacts& facts, const RungFlow& run) {
    std::vector<Timed> timers;
    for (const Leaf& leaf : leaves) {
      const std::optional<Cell> cell = cellOf(leaf, engine_.rung(run.lowered), facts, run).first;
      for (const rung_timer& timer : std::span(program_.timers, program_.timer_count))
        if (cell && isTimeOf(timer, *cell) && std::ranges::find(timers, &timer, &Timed::timer) == timers.end())
          timers.push_back({&timer, *cell});
    }
    return timers;
  }
  runtime::TimerState stateOf(const Timed& timed, uint64_t part) {
    (void)past_.goTo(part);
    return runtime::stateOf(past_.instance().memory(), *timed.timer);
  }
  // Of one whose time was read, so that it is not idle.
  bool isOver(const Timed& timed, uint64_t part) {
    const runtime::TimerState state = stateOf(timed, part);
    if (state.running) return false;
    const auto time = static_cast<int64_t>(valueIn(past_.instance().block(), timed.time));
    return (timed.timer->flags & RUNG_TIMER_DOWN) != 0 || time * timed.timer->time_us >= state.preset;
  }
  // "": its preset is not known.
  std::string timerText(const Timed& timed, uint64_t part) {
    const runtime::TimerState state = stateOf(timed, part);
    if (state.preset < 0) return {};
    const bool counts = (timed.timer->flags & RUNG_TIMER_RUNS) != 0;
    const auto shown = [&](int64_t time) {
      return counts ? fmt::format("{}", time) : fmt::format("{:.3f} s", static_cast<double>(time) / 1e6);
    };
    const std::string_view unit = counts ? " runs of its instruction" : "";
    if (isOver(timed, part)) return fmt::format("{} has run out: {}{}", timed.timer->name, shown(state.preset), unit);
    return fmt::format("{} runs: {} of {}{}", timed.timer->name, shown(state.elapsed), shown(state.preset), unit);
  }
  // Where the compiler keeps what belongs to the timer; its key begins as those of the timer's other state.
  bool isStateOf(const rung_timer& timer, const Cell& cell) const {
    if (!cell.slot.valid()) return false;
    const std::string& key = compiled_.shape->slots[cell.slot.index].key;
    return key.find(fmt::format("/{}/", timer.name)) != std::string::npos;
  }

  // Not by the place itself, if there is another way.
  static std::vector<Leaf> changeOf(const RungReasons& reasons, const Cell& cell, std::span<const Access> accesses,
                                    const Within& write) {
    const uint32_t store = accesses[write.access].operation;
    std::vector<uint32_t> own;
    for (const Access& access : accesses)
      if (!access.writes && touches(access, cell)) own.push_back(access.operation);
    std::vector<Leaf> leaves = reasons.toChange(store, own);
    return leaves.empty() && !own.empty() ? reasons.toChange(store, {}) : leaves;
  }

  // What a load has read; nothing for other leaves.
  std::pair<std::optional<Cell>, uint64_t> cellOf(const Leaf& leaf, const ir::Rung& rung, const PartFacts& facts,
                                                  const RungFlow& run, size_t* number = nullptr) {
    const std::span<const Access> accesses = facts.flow->accesses(run);
    for (size_t a = accesses.size(); a-- > 0;) {
      if (accesses[a].operation != leaf.operation || accesses[a].writes) continue;
      if (number != nullptr) *number = a;
      const bool real =
          rung.ops[leaf.operation].type == ir::Type::F64 || (!accesses[a].slot.valid() && isReal(accesses[a].place));
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
    for (const Timed& timed : timersOf(leaves, facts, facts.flow->runs()[runNumber])) {
      std::string text = timerText(timed, part);
      if (text.empty()) continue;
      reason.timers.push_back(std::move(text));
      std::erase_if(operands.all, [&](const Operand& operand) {
        return operand.cell == timed.time || isStateOf(*timed.timer, operand.cell);
      });
    }
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
      next.partForced = next.kind != Reason::Kind::Forced && heldOf(operand.cell, facts.forced).mask != 0;
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
    return key.starts_with("@clock/") || key.starts_with("@scan/") || key.ends_with("/time/passed");
  }

  int64_t timeOf(uint64_t part) {
    if (!past_.goTo(std::max(part, past_.firstPart())).empty()) return 0;
    return past_.instance().nowUs();
  }

  struct Ran {
    const PartFacts* facts = nullptr; // null: it did not run
    size_t run = 0;
  };
  // The last run of the rung in these parts.
  Ran lastRun(uint32_t lowered, uint64_t first, uint64_t last) {
    for (uint64_t at = last + 1; at-- > first;) {
      const PartFacts& facts = factsOf(at);
      for (size_t r = facts.flow ? facts.flow->runs().size() : 0; r-- > 0;)
        if (facts.flow->runs()[r].lowered == lowered) return {&facts, r};
    }
    return {};
  }

  // The rungs that write the place, apart from the one that explains its value.
  void addOthers(const Cell& cell, uint64_t part, Explanation& explanation) {
    if (!factsOf(part).flow || cell.slot.valid()) return;
    const uint64_t first = scanBegin(part);
    const ir::Uses::Writers writers = uses().writersOf(cell.bits);
    std::vector<uint32_t> also;
    for (const uint32_t writer : writers.certain) {
      if (lastRun(writer, first, part).facts != nullptr) {
        if (writer != explanation.reason.lowered) also.push_back(writer);
      } else
        explanation.skipped.push_back(fmt::format("{} did not run in this scan{}", runtime::rungText(program_, writer),
                                                  whyNot(writer, first, part)));
    }
    addNoWriter(cell, writers, explanation);
    if (also.empty()) return;
    const bool known = explanation.reason.kind != Reason::Kind::Before;
    explanation.also = (known ? "also written by " : "not written by ") + runtime::rungText(program_, also[0]);
    if (also.size() > 1) explanation.also += fmt::format(", and by {} more", also.size() - 1);
  }

  // What leads to a value that no rung has written, as far as it is not known yet.
  void addNoWriter(const Cell& cell, const ir::Uses::Writers& writers, Explanation& explanation) {
    if (explanation.reason.kind != Reason::Kind::Before) return;
    for (const uint32_t writer : writers.computed)
      explanation.skipped.push_back(
          fmt::format("{} has not written it, but may, at a computed address", runtime::rungText(program_, writer)));
    const auto isWritten = [this](const BitRange& from) { return !uses().writersOf(from).none(); };
    if (!writers.none() || std::ranges::any_of(uses().copiedFrom(cell.bits), isWritten)) return;
    explanation.skipped.emplace_back(report::isWrittenByControl(program_, uses(), refOf(cell.bits, cell.real))
                                         ? "only the control or the machine writes it"
                                         : "no rung writes it");
  }

  // "; rung 1, main.pmc:7 jumped over it: GATE = 0", or that another one did not call its routine.
  std::string whyNot(uint32_t writer, uint64_t first, uint64_t part) {
    for (const uint32_t decider : uses().decidersOf(writer))
      if (const Ran ran = lastRun(decider, first, part); ran.facts != nullptr)
        return fmt::format("; {} jumped over it{}", runtime::rungText(program_, decider), conditionOf(ran));
    for (const uint32_t caller : uses().callersOf(writer))
      if (const Ran ran = lastRun(caller, first, part); ran.facts != nullptr)
        return fmt::format("; {} did not call its routine{}", runtime::rungText(program_, caller), conditionOf(ran));
    return {};
  }
  // ": GATE = 0", what decided which way the program took after the rung.
  std::string conditionOf(const Ran& ran) {
    const RungFlow& run = ran.facts->flow->runs()[ran.run];
    const ir::Rung& rung = engine_.rung(run.lowered);
    const ir::ValueId condition = rung.transfer.cond.valid() ? rung.transfer.cond : rung.transfer.value;
    if (!condition.valid() || ran.facts->values[ran.run].empty()) return {};
    std::string text;
    for (const Leaf& leaf : RungReasons(rung, ran.facts->values[ran.run]).ofValue(condition.index))
      if (const auto [cell, value] = cellOf(leaf, rung, *ran.facts, run); cell && !cell->slot.valid())
        text += fmt::format("{}{} = {}", text.empty() ? ": " : ", ", nameOf(*cell), shown(value, *cell));
    return text;
  }

  Past& past_;
  const WhyOptions& options_;
  // Of the program of the question, also while other parts are visited.
  const compiler::Compiled& compiled_;
  FlowEngine& engine_;
  const rung_program& program_;
  const uint32_t programNumber_; // changes of the program end the search
  const uint64_t asked_;         // the part of the question
  const std::unique_ptr<sim::SimulatedNc> names_{sim::makeSimulatedNc(program_.dialect)}; // it drives nothing
  std::map<uint64_t, std::unique_ptr<PartFacts>> facts_;
  std::vector<std::pair<Cell, uint64_t>> visited_;
  size_t count_ = 0;
};

} // namespace

// ---- text --------------------------------------------------------------------------------------------------------

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

class Text {
public:
  Text(const Explanation& explanation, const TextLimits& limits) : explanation_(explanation), limits_(limits) {}

  std::string run() {
    text_ = valueText(explanation_.reason);
    put(explanation_.reason);
    listed("\n  ", explanation_.skipped, [](const std::string& skipped) { return skipped; });
    if (!explanation_.also.empty()) text_ += "\n  " + explanation_.also;
    if (!explanation_.toChange.empty())
      text_ += fmt::format("\n  it would be different with {}", fmt::join(explanation_.toChange, " and "));
    return std::move(text_);
  }

private:
  std::string sinceText(const Reason& reason) const {
    if (reason.kind == Reason::Kind::Before || reason.unchanged) return "unchanged since " + explanation_.beginning;
    return "since " + scenario::scanText(reason.part, reason.us);
  }
  std::string valueText(const Reason& reason) const {
    return fmt::format("{} = {}{}, {}", reason.name, reason.value, reason.partForced ? ", forced in part" : "",
                       sinceText(reason));
  }
  std::string placeText(const Reason& reason) const {
    if (reason.kind == Reason::Kind::Clock || reason.kind == Reason::Kind::Answer) return reason.name;
    return fmt::format("{}{}{}", valueText(reason), reason.alone ? ", decided alone" : "",
                       reason.isIndex ? ", determined the address" : "");
  }
  template <class T, class Show>
  void listed(std::string_view indent, const std::vector<T>& all, Show show) {
    const size_t count = std::min(all.size(), limits_.places);
    for (size_t i = 0; i < count; ++i) text_ += fmt::format("{}{}", indent, show(all[i]));
    if (count < all.size()) text_ += fmt::format("{}and {} more", indent, all.size() - count);
  }
  void put(const Reason& reason) {
    if (const std::string kind = kindText(reason); !kind.empty()) text_ += fmt::format("\n    {}", kind);
    if (!reason.note.empty()) text_ += fmt::format("\n      {}", reason.note);
    for (const std::string& timer : reason.timers) text_ += "\n      " + timer;
    listed("\n      ", reason.because, [this](const Reason& because) { return placeText(because); });
    for (const Reason& because : reason.because) {
      const bool goesOn = !kindText(because).empty();
      if (!goesOn || (because.kind != Reason::Kind::Copy && ++steps_ >= limits_.steps)) continue;
      text_ += fmt::format("\n  {}", valueText(because));
      put(because);
    }
  }

  const Explanation& explanation_;
  const TextLimits& limits_;
  size_t steps_ = 0;
  std::string text_;
};

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
  if (reason.partForced) json["part_forced"] = true;
  if (reason.isIndex) json["index"] = true;
  if (reason.computed) json["computed"] = true;
  if (!reason.note.empty()) json["note"] = reason.note;
  if (!reason.timers.empty()) json["timers"] = reason.timers;
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

std::string textOf(const Explanation& explanation, const TextLimits& limits) { return Text(explanation, limits).run(); }

std::string jsonOf(const Explanation& explanation) {
  nlohmann::json json = jsonOfReason(explanation.reason);
  if (!explanation.toChange.empty()) json["to_change"] = explanation.toChange;
  if (!explanation.skipped.empty()) json["skipped"] = explanation.skipped;
  if (!explanation.also.empty()) json["also"] = explanation.also;
  return json.dump(2);
}

} // namespace rung::replay
