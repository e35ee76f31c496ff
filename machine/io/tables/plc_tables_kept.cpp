// The image of PLC tables that outlives a power-off (see plc_tables.h): a head, and each table with a head of its own.
#include <algorithm>
#include <cstring>

#include "machine/io/tables/plc_tables.h"

namespace rung::io {
namespace {

constexpr uint64_t kMagic = 0x32304C4254434C50; // "PLCTBL02": changes with the form of the image

struct TableHead {
  uint64_t origin;
  uint32_t table;
  uint32_t count;
  uint32_t selected;
  uint32_t bytes; // of lines and texts
  uint32_t textsEnd;
  uint32_t textsInUse;
};

uint32_t contentBytes(const PlcTable& table) {
  return static_cast<uint32_t>(table.bytes.size() + table.texts.size()); // all tables have at most 2^25
}

uint32_t keptBytes(const PlcTable& table) { return static_cast<uint32_t>(sizeof(TableHead)) + contentBytes(table); }

void append(std::span<uint8_t>& to, const void* from, size_t size) {
  if (size > 0) std::memcpy(to.data(), from, size);
  to = to.subspan(size);
}

// The head of the next table, which is whole; false where the rest is something else.
bool takeHead(std::span<const uint8_t>& from, TableHead& head) {
  if (from.size() < sizeof head) return false;
  std::memcpy(&head, from.data(), sizeof head);
  from = from.subspan(sizeof head);
  return head.bytes <= from.size();
}

bool fits(const TableHead& head, const PlcTable& table, const uint8_t* bytes) {
  return head.origin == table.origin && head.bytes == contentBytes(table) && head.count <= table.capacity &&
         (head.selected == 0 || head.selected < head.count) &&
         table.textsFit(bytes, head.count, head.textsEnd, head.textsInUse);
}

void restore(PlcTable& table, const TableHead& head, const uint8_t* bytes) {
  table.count = head.count;
  table.selected = head.selected;
  table.textsEnd = head.textsEnd;
  table.textsInUse = head.textsInUse;
  std::copy_n(bytes, table.bytes.size(), table.bytes.begin());
  std::copy_n(bytes + table.bytes.size(), table.texts.size(), table.texts.begin());
  std::fill(table.line(head.count), table.line(table.capacity), uint8_t{0});
  table.dirty = true;
}

} // namespace

uint32_t PlcTables::keptSize() const noexcept {
  uint32_t size = 0;
  for (const auto& table : tables_)
    if (table) size += keptBytes(*table);
  return size == 0 ? 0 : size + static_cast<uint32_t>(sizeof kMagic);
}

void PlcTables::copyKept(std::span<uint8_t> image) const noexcept {
  if (image.empty() || image.size() != keptSize()) return;
  append(image, &kMagic, sizeof kMagic);
  for (uint32_t i = 0; i < kTables; ++i) {
    if (!exists(i)) continue;
    const PlcTable& t = *tables_[i];
    const TableHead head{t.origin, i, t.count, t.selected, contentBytes(t), t.textsEnd, t.textsInUse};
    append(image, &head, sizeof head);
    append(image, t.bytes.data(), t.bytes.size());
    append(image, t.texts.data(), t.texts.size());
  }
}

bool PlcTables::restoreKept(std::span<const uint8_t> image) noexcept {
  forgetChanges();
  if (image.empty()) return true;
  if (image.size() < sizeof kMagic || std::memcmp(image.data(), &kMagic, sizeof kMagic) != 0) return false;
  image = image.subspan(sizeof kMagic);
  bool all = true;
  for (TableHead head{}; !image.empty(); image = image.subspan(head.bytes)) {
    if (!takeHead(image, head)) return false;
    if (exists(head.table) && fits(head, *tables_[head.table], image.data()))
      restore(*tables_[head.table], head, image.data());
    else
      all = false;
  }
  return all;
}

void PlcTables::forgetChanges() noexcept {
  for (const auto& table : tables_)
    if (table) table->elementChanged = table->selectionChanged = false;
}

} // namespace rung::io
