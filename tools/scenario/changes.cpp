// Tracks changes of bits (see changes.h).
#include "tools/scenario/changes.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace rung::scenario {
namespace {

constexpr uint32_t kBlock = 64; // bytes that are compared at once; spans closer together are merged

// Ascending, without overlaps.
std::vector<ir::BitRange> merged(std::vector<ir::BitRange> places) {
  std::ranges::sort(places, {}, [](const ir::BitRange& p) { return std::pair(p.space.index, p.first); });
  std::vector<ir::BitRange> out;
  for (const ir::BitRange& place : places) {
    if (!out.empty() && out.back().space == place.space && place.first <= out.back().first + out.back().count)
      out.back().count = std::max(out.back().count, place.first + place.count - out.back().first);
    else
      out.push_back(place);
  }
  return out;
}

// The places that rungs use, and the sources of copies to them: the rest of a latch or an image may change unnoticed,
// and comparing it would often cost more than the scan.
std::vector<ir::BitRange> placesOf(const ir::Uses& uses) {
  std::vector<ir::BitRange> places;
  for (uint32_t rung = 0; rung < uses.rungCount(); ++rung)
    for (const ir::Use& use : uses.of(rung)) places.push_back(use.place);
  places = merged(std::move(places));
  for (size_t i = 0, used = places.size(); i < used; ++i)
    for (const ir::BitRange& from : uses.copiedFrom(places[i])) places.push_back(from);
  return merged(std::move(places));
}

core::Place bitAt(const runtime::Instance& instance, const ir::BitRange& place, uint32_t bit) {
  const uint32_t at = place.first + bit;
  return instance.memory().locateBit(place.space.index, at / 8, at % 8);
}

} // namespace

// Adds the ranges of the memory block that contain the place.
void Changes::addPieces(const rung_program& program, const ir::BitRange& place, std::vector<Span>& pieces) {
  const rung_space& space = program.spaces[place.space.index];
  const uint32_t firstByte = place.first / 8;
  const uint32_t endByte = (place.first + place.count + 7) / 8;
  for (uint32_t i = 0; i < space.range_count; ++i) {
    const rung_range& range = space.ranges[i];
    const uint32_t first = std::max(firstByte, range.first_byte);
    const uint32_t end = std::min(endByte, range.first_byte + range.byte_count);
    const uint32_t each = range.repr == RUNG_REPR_BYTE_PER_BIT ? 8 : 1;
    if (first < end) pieces.push_back({range.offset + (first - range.first_byte) * each, (end - first) * each, 0});
  }
}

Changes::Changes(const Session& session, const ir::Uses& uses) {
  watch(session.instance().program(), placesOf(uses));
  for (const Span& span : spans_)
    std::memcpy(copy_.data() + span.copy, session.instance().block().data() + span.offset, span.size);
  scan_ = session.scans();
  noteTime(scan_, session.nowUs());
  begin_ = {scan_, session.nowUs()};
}

void Changes::watch(const rung_program& program, const std::vector<ir::BitRange>& places) {
  std::vector<Span> pieces;
  for (const ir::BitRange& place : places) addPieces(program, place, pieces);
  std::ranges::sort(pieces, {}, &Span::offset);
  for (const Span& piece : pieces) {
    if (!spans_.empty() && piece.offset < spans_.back().offset + spans_.back().size + kBlock)
      spans_.back().size = std::max(spans_.back().size, piece.offset + piece.size - spans_.back().offset);
    else
      spans_.push_back(piece);
  }
  uint32_t size = 0;
  for (Span& span : spans_) {
    span.copy = size;
    size += span.size;
  }
  copy_.resize(size);
  scans_.resize(size_t{size} * 8);
}

void Changes::beginAt(const Session& session, uint64_t scan) {
  scan_ = scan;
  continueIn(session);
  paces_.clear();
  noteTime(scan_, session.nowUs());
  begin_ = {scan_, session.nowUs()};
}

void Changes::scanned(const Session& session) {
  scan_ = session.scans() - ahead_;
  noteTime(scan_, session.nowUs());
  const uint8_t* block = session.instance().block().data();
  for (const Span& span : spans_)
    if (std::memcmp(copy_.data() + span.copy, block + span.offset, span.size) != 0) compare(span, block + span.offset);
}

void Changes::compare(const Span& span, const uint8_t* now) {
  for (uint32_t at = 0; at < span.size; at += kBlock) {
    const uint32_t end = std::min(at + kBlock, span.size);
    uint8_t* before = copy_.data() + span.copy;
    if (std::memcmp(before + at, now + at, end - at) == 0) continue;
    for (uint32_t i = at; i < end; ++i) {
      for (uint32_t changed = before[i] ^ now[i]; changed != 0; changed &= changed - 1)
        scans_[size_t{span.copy + i} * 8 + static_cast<uint32_t>(std::countr_zero(changed))] =
            static_cast<uint32_t>(scan_);
      before[i] = now[i];
    }
  }
}

void Changes::noteTime(uint64_t scan, int64_t us) {
  if (paces_.empty()) {
    paces_.push_back({scan, us, 0});
    return;
  }
  const int64_t step = us - timeOf(scan - 1);
  if (step != paces_.back().step) paces_.push_back({scan - 1, us - step, step});
}

int64_t Changes::timeOf(uint64_t scan) const {
  const auto after = std::ranges::upper_bound(paces_, scan, {}, &Pace::first);
  const Pace& pace = *std::prev(after);
  return pace.us + static_cast<int64_t>(scan - pace.first) * pace.step;
}

std::optional<size_t> Changes::indexOf(const runtime::Instance& instance, const ir::BitRange& place,
                                       uint32_t bit) const {
  const core::Place at = bitAt(instance, place, bit);
  if (at.outside()) return std::nullopt;
  const auto after = std::ranges::upper_bound(spans_, at.offset(), {}, &Span::offset);
  if (after == spans_.begin()) return std::nullopt;
  const Span& span = *std::prev(after);
  if (at.offset() - span.offset >= span.size) return std::nullopt;
  return size_t{span.copy + at.offset() - span.offset} * 8 + at.bit();
}

std::optional<Changes::Scan> Changes::last(const runtime::Instance& instance, const ir::BitRange& place) const {
  uint32_t scan = 0;
  for (uint32_t bit = 0; bit < place.count; ++bit) {
    const std::optional<size_t> index = indexOf(instance, place, bit);
    if (!index) return std::nullopt;
    scan = std::max(scan, scans_[*index]);
  }
  return scan == 0 ? Scan{} : Scan{scan, timeOf(scan)};
}

bool Changes::pending(const runtime::Instance& instance, const ir::BitRange& place) const {
  for (uint32_t bit = 0; bit < place.count; ++bit) {
    const std::optional<size_t> index = indexOf(instance, place, bit);
    const bool before = index && (copy_[*index / 8] >> (*index % 8) & 1) != 0;
    if (index && before != (instance.memory().read(bitAt(instance, place, bit)) != 0)) return true;
  }
  return false;
}

} // namespace rung::scenario
