// See cells.h.
#include "machine/control/cells.h"

#include <algorithm>
#include <cstring>
#include <optional>
#include <span>
#include <utility>

#include <nlohmann/json.hpp>

#include "machine/control/turn.h"
#include "machine/control/values.h"
#include "rtlib/load/written_bits.h"
#include "rung/types.hpp"

namespace rung::control {

using nlohmann::json;

namespace {
constexpr uint32_t kScansKept = 4096; // for a client that watches all scans
}

// Cells that are looked up by name, and released with this object.
struct Cells::Found {
  explicit Found(rung_instance* instance) : of(instance) {}
  ~Found() {
    for (const rung_cell cell : cells) rung_instance_release(of, cell);
  }
  Found(Found&& other) noexcept : of(other.of), cells(std::exchange(other.cells, {})), infos(std::move(other.infos)) {}
  Found& operator=(Found&&) = delete;

  rung_instance* of;
  std::vector<rung_cell> cells;
  std::vector<rung_cell_info> infos;
};

struct Cells::Watching {
  Watching(rung_instance* instance, const Found& found, bool everyScan)
      : of(instance), cells(found.cells), all(everyScan), gone(found.cells.size()), values(found.cells.size()),
        sent(found.cells.size()) {
    for (const rung_cell_info& info : found.infos) types.push_back(info.type);
    check(rung_watch_new(of, found.cells.data(), static_cast<uint32_t>(found.cells.size()), all ? kScansKept : 0,
                         &watch));
  }
  ~Watching() { rung_watch_free(watch); }
  Watching(const Watching&) = delete;
  Watching& operator=(const Watching&) = delete;

  bool hasChanged(const rung_sample& sample) const {
    return sample.generation != generation ||
           std::memcmp(values.data(), sent.data(), values.size() * sizeof(rung_value)) != 0;
  }
  // null if the program no longer has the cell, or if its type differs from the one that the client knows.
  json valueOf(size_t i) const { return gone[i] ? json() : toJson(types[i], values[i]); }
  json event(const rung_sample& sample) {
    if (sample.generation != generation) {
      generation = sample.generation;
      for (size_t i = 0; i < cells.size(); ++i) {
        auto info = sized<rung_cell_info>();
        gone[i] = rung_instance_cell(of, cells[i], &info) != RUNG_OK || info.type != types[i];
      }
    }
    json list = json::array();
    for (size_t i = 0; i < values.size(); ++i) list.push_back(valueOf(i));
    sent = values;
    begun = true;
    return {{"event", "values"}, {"scan", sample.scan}, {"us", sample.now_us}, {"lost", sample.lost}, {"values", list}};
  }

  rung_instance* of;
  std::vector<rung_cell> cells;
  rung_watch* watch = nullptr;
  std::vector<uint32_t> types;
  bool all;
  uint32_t generation = 0; // generation of the program for which `gone` is valid
  std::vector<bool> gone;
  bool begun = false;
  std::vector<rung_value> values, sent;
};

Cells::Cells(PlcAccess& plc) : plc_(plc) {}
Cells::~Cells() = default;

// ---- names ---------------------------------------------------------------------------------------------------------

namespace {

// The bits of a byte that rungs write, in the byte itself or in a process image of it.
uint8_t writtenBits(const rung_program& program, const rung_range& range, uint32_t byte) {
  const auto written = [&](uint32_t offset) {
    uint8_t mask = runtime::writtenBits(program, offset);
    runtime::forCopiesOf(program, offset, [&](uint32_t copy) { mask |= runtime::writtenBits(program, copy); });
    return mask;
  };
  if (range.repr != RUNG_REPR_BYTE_PER_BIT) return written(range.offset + byte);
  uint8_t mask = 0;
  for (uint32_t bit = 0; bit < 8; ++bit)
    if (written(range.offset + 8 * byte + bit) != 0) mask |= static_cast<uint8_t>(1U << bit);
  return mask;
}

} // namespace

void Cells::learn(const rung_program& program) {
  written_.assign(program.space_count, {});
  for (uint32_t number = 0; number < program.space_count; ++number) {
    const rung_space& space = program.spaces[number];
    written_[number].resize(space.byte_count);
    for (const rung_range& range : std::span(space.ranges, space.range_count))
      for (uint32_t byte = 0; byte < range.byte_count; ++byte)
        written_[number][range.first_byte + byte] = writtenBits(program, range, byte);
  }
  formerSymbols_ = std::exchange(symbols_, {});
  for (const rung_symbol& symbol : std::span(program.symbols, program.symbol_count))
    if ((symbol.flags & RUNG_SYMBOL_HIDDEN) == 0) symbols_.emplace_back(symbol.name);
}

// The most similar name of the running program; "" if none is close.
std::string Cells::meantBy(const std::string& name) const {
  for (const std::vector<std::string>& symbols : {symbols_, formerSymbols_})
    if (std::string meant = host::meantName(name, symbols);
        !meant.empty() && cellInfo(plc_.instance(), meant, RUNG_READ))
      return meant;
  return {};
}

rung_cell_info Cells::describe(const std::string& name, int32_t access) const {
  auto info = sized<rung_cell_info>();
  int64_t value = 0;
  const int32_t status = rung_instance_describe(plc_.instance(), nullptr, name.c_str(), access, &info, &value);
  if (status == RUNG_NOT_FOUND) {
    const std::string problem = rung_error_text(); // meantBy overwrites the error text
    throw Refused(problem + text::didYouMean(meantBy(name)));
  }
  check(status);
  if (info.type == RUNG_TYPE_TEXT) throw Refused(name + " is a text, expected a bit or a number");
  return info;
}

Cells::Found Cells::find(const std::vector<std::string>& names, int32_t access) const {
  Found all(plc_.instance());
  for (const std::string& name : names) {
    all.infos.push_back(describe(name, access));
    rung_cell cell = 0;
    check(rung_instance_find(plc_.instance(), name.c_str(), access, &cell));
    all.cells.push_back(cell);
  }
  return all;
}

// ---- reading -------------------------------------------------------------------------------------------------------

std::string Cells::whyNoScanEnds() {
  const std::optional<rung_state> now = plc_.state();
  if (!now) return "the scan thread does not run";
  if (const std::optional<rung_fault_info> fault = plc_.host().running() ? std::nullopt : plc_.host().fault())
    return std::string("the program has not finished a scan: it is stopped by a fault: ") + fault->text;
  if ((now->flags & RUNG_STATE_STOPPED) != 0)
    return "the program has not finished a scan since it was switched on: it is stopped by the operator";
  return "the program has not finished a scan within a second";
}

// Answers with the values at the end of a scan.
json Cells::get(const Peer&, const json& request) {
  const std::vector<std::string> names = namesOf(request);
  if (plc_.host().ended()) throw Refused("the program has been switched off");
  const Found found = find(names, RUNG_READ);
  Watching once(plc_.instance(), found, false);
  auto sample = sized<rung_sample>();
  const int64_t end = plc_.host().clock().nowNs() + std::chrono::nanoseconds(host::PlcHost::kPatience).count();
  while (rung_watch_newest(once.watch, once.values.data(), &sample) != RUNG_OK) {
    if (plc_.host().clock().nowNs() >= end) throw Refused(whyNoScanEnds());
    host::Command look{.kind = host::Command::Kind::State}; // waits for a step of the scan thread
    plc_.host().post(look);
  }
  json values = json::object();
  for (size_t i = 0; i < names.size(); ++i) values[names[i]] = toJson(once.types[i], once.values[i]);
  return {{"scan", sample.scan}, {"us", sample.now_us}, {"values", values}};
}

json Cells::watch(const Peer& peer, const json& request) {
  const std::vector<std::string> names = namesOf(request);
  const Found found = find(names, RUNG_READ);
  watching_[peer.number] = std::make_unique<Watching>(plc_.instance(), found, flagOf(request, "all"));
  json described = json::array();
  for (size_t i = 0; i < names.size(); ++i)
    described.push_back(
        {{"name", names[i]}, {"type", typeName(found.infos[i].type)}, {"address", found.infos[i].address}});
  return {{"names", described}};
}

void Cells::gone(const Peer& peer) { watching_.erase(peer.number); }

void Cells::sendValues(Sink& sink) {
  for (auto& [peer, watching] : watching_) {
    auto sample = sized<rung_sample>();
    if (watching->all) {
      for (int i = 0; i < turn::kMostScans; ++i) {
        if (rung_watch_next(watching->watch, watching->values.data(), &sample) != RUNG_OK) break;
        sink.send(peer, watching->event(sample));
      }
    } else if (rung_watch_newest(watching->watch, watching->values.data(), &sample) == RUNG_OK &&
               (!watching->begun || watching->hasChanged(sample))) {
      sink.send(peer, watching->event(sample));
    }
  }
}

// ---- writing -------------------------------------------------------------------------------------------------------

// The ranges that the program reads under this name, and that the machine writes.
std::vector<Cells::Range> Cells::rangesOf(const std::string& name) const {
  std::vector<Range> ranges;
  for (const int32_t access : {RUNG_READ, RUNG_WRITE}) {
    const std::optional<rung_cell_info> info = cellInfo(plc_.instance(), name, access);
    if (!info || info->space == RUNG_NONE) continue;
    constexpr uint64_t kBitsOfAByte = 8;
    ranges.push_back({info->space, info->byte * kBitsOfAByte + info->bit,
                      uint64_t{elementBits(info->type)} * std::max<uint32_t>(1, info->count)});
  }
  return ranges;
}

// How much of `wanted` lies in the cell of this name.
Cells::Share Cells::shareOf(const std::string& name, const std::vector<Range>& wanted) const {
  const std::vector<Range> held = rangesOf(name);
  const auto meets = [&](const Range& range) {
    return std::ranges::any_of(held, [&](const Range& by) { return by.meets(range); });
  };
  const auto lies = [&](const Range& range) {
    return std::ranges::any_of(held, [&](const Range& by) { return by.covers(range); });
  };
  if (wanted.empty() || std::ranges::none_of(wanted, meets)) return Share::None;
  return std::ranges::all_of(wanted, lies) ? Share::All : Share::Part;
}

void Cells::refuseProtected(const std::string& name) const {
  const std::vector<Range> wanted = rangesOf(name);
  for (const host::Protected& cell : plc_.host().map().protectedCells) {
    const std::vector<Range> kept = rangesOf(cell.name);
    if (kept.empty()) throw Refused("whether " + name + " is protected is not known: " + cell.name + " is not found");
    if (shareOf(cell.name, wanted) != Share::None)
      throw Refused(name + " is protected by the mapping file ([rungctl] protected)");
  }
}

// The pins of a cell's bits that write `wanted`; all of its pins if none of its bits is wanted.
std::string Cells::writerOf(const host::PlcHost::Feed& feed, const std::vector<Range>& wanted) const {
  if (feed.bits.empty()) return feed.by;
  std::vector<std::string> pins;
  for (const Range& held : rangesOf(feed.name))
    for (uint64_t bit = 0; bit < feed.bits.size(); ++bit) {
      const Range place{held.space, held.first + bit, 1};
      const bool isWanted = std::ranges::any_of(wanted, [&](const Range& range) { return range.meets(place); });
      if (isWanted && std::ranges::find(pins, feed.bits[bit]) == pins.end()) pins.push_back(feed.bits[bit]);
    }
  if (pins.empty()) pins = feed.bits;
  return pins.size() == 1 ? "pin " + pins.front() : "pins " + pins.front() + " to " + pins.back();
}

// Throws Refused if a write would be overwritten before the program sees it, or if a force holds part of the cell.
// Otherwise returns "", or the sentence that part of the cell is written by pins.
std::string Cells::refuseWithoutEffect(const std::string& name) {
  const std::vector<Range> wanted = rangesOf(name);
  for (const rung_force_info& force : plc_.activeForces())
    if (const Share share = shareOf(force.name, wanted); share != Share::None)
      throw Refused(name +
                    (share == Share::Part ? " has " + std::string(force.name) + ", which is forced to "
                     : name == force.name ? " is forced to "
                                          : " is forced as " + std::string(force.name) + " to ") +
                    textOf(force.type, force.value) + ": it stays so");
  std::string kept;
  for (const host::PlcHost::Feed& feed : plc_.host().feeds()) {
    const Share share = shareOf(feed.name, wanted);
    if (share == Share::All)
      throw Refused(name + " is written before every slice by " + writerOf(feed, wanted) +
                    ": setting it has no effect, forcing it has (rungctl force " + name + " VALUE)");
    if (share == Share::Part) kept += (kept.empty() ? "" : ", ") + feed.name + " by " + writerOf(feed, wanted);
  }
  return kept.empty()
             ? ""
             : "part of " + name + " is written before every slice, so setting it has no effect there: " + kept;
}

// "", or the sentence that rungs write the cell, too.
std::string Cells::noteOfRungs(const std::string& name) const {
  for (const Range& range : rangesOf(name))
    for (uint64_t bit = range.first; bit < range.first + range.count; ++bit)
      if (range.space < written_.size() && bit / 8 < written_[range.space].size() &&
          (written_[range.space][bit / 8] >> (bit % 8) & 1) != 0)
        return "rungs write " + name + ", or may write it by a computed address, so the next scan may overwrite it: " +
               "forcing it holds it (rungctl force " + name + " VALUE)";
  return {};
}

json Cells::set(const Peer& peer, const json& request) {
  const std::string name = textOf(request, "name");
  if (!request.contains("value")) throw Refused("found no \"value\" in the request, expected one");
  const Found found = find({name}, RUNG_WRITE);
  const uint32_t type = found.infos.front().type;
  refuseProtected(name);
  std::string note = refuseWithoutEffect(name);
  if (note.empty()) note = noteOfRungs(name);
  const rung_value value = fromJson(type, request["value"], name);
  const host::Command done =
      plc_.post({.kind = host::Command::Kind::Write, .cell = found.cells.front(), .value = value});
  plc_.logChange(peer, LogKind::Set,
                 "set " + name + " from " + textOf(type, done.former) + " to " + textOf(type, value));
  json answer = {{"name", name}, {"former", toJson(type, done.former)}, {"value", toJson(type, value)}};
  if ((done.state.flags & RUNG_STATE_FAULTED) != 0)
    note = "a fault has stopped the program: only inputs that are set now survive the reset";
  if (!note.empty()) answer["note"] = note;
  return answer;
}

} // namespace rung::control
