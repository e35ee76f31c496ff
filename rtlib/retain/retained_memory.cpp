// Loading, offering and saving at the end.
#include "rtlib/retain/retained_memory.h"

#include <zlib.h>

#include <algorithm>
#include <optional>
#include <string>

#include "rtlib/retain/retained_cells.h"
#include "rtlib/text/controls.h"
#include "rtlib/text/number.h"
#include "rung/types.hpp"

namespace rung::runtime {

namespace {

// The period is short for requests, because the program waits for the answer.
std::chrono::milliseconds periodOf(RetainWhen when) {
  return std::chrono::milliseconds(when == RetainWhen::OnRequest ? 5 : 200);
}

} // namespace

RetainedMemory::RetainedMemory(const rung_program& program, const std::string& file, RetainWhen when, RetainTake take,
                               const Outside& outside, const Naming& naming)
    : RetainedMemory(program, file, when, take, outside.savePeriod.value_or(periodOf(when)), *outside.disk, naming) {}

RetainedMemory::RetainedMemory(const rung_program& program, const std::string& file, RetainWhen when, RetainTake take,
                               std::chrono::milliseconds period, Disk& disk, const Naming& naming)
    : map_(program), when_(when), take_(take), naming_(naming),
      store_(std::make_unique<RetainStore>(file, map_.layout(), map_.size(), disk)), period_(period) {}

bool RetainedMemory::load(Instance& instance, std::string& report, std::string& error) {
  if (!store_->lock(error)) return false;
  RetainImage image = store_->load();
  if (!image.description.empty()) {
    if (take_ != nullptr) take_(instance.program(), map_, image, naming_);
    if (!image.found) image.report += "; starting cold";
  }
  report = image.report;
  lost_ = !image.found && !report.empty();
  std::vector<uint8_t> raw(map_.rawSize());
  if (image.found) {
    map_.unpack(image.bytes, raw);
    instance.restoreRetained(raw);
  }
  std::vector<uint8_t> now(map_.size());
  instance.copyRetained(raw);
  map_.pack(raw, now);
  if (!store_->save(now, error)) return false;
  saver_ = std::make_unique<RetainSaver>(std::move(store_), std::make_unique<RetainChannel>(map_), period_);
  return image.found;
}

bool RetainedMemory::offer(const Instance& instance, bool asked) noexcept {
  if (instance.faulted()) return false;
  if (!asked) request_ = 0;
  const bool begins = asked && request_ == 0;
  if (instance.atListStart() && (begins || when_ == RetainWhen::Always)) {
    const uint64_t ticket = saver_->offer(instance);
    if (begins) request_ = ticket;
  }
  if (request_ == 0 || saver_->stored() < request_) return false;
  request_ = 0;
  return true;
}

std::string RetainedMemory::finish(const Instance& instance) {
  if (!instance.faulted()) saver_->offer(instance);
  return saver_->flush() ? std::string() : saver_->problem();
}

// Conversion between descriptions.

namespace {

constexpr size_t kMostText = 4 << 20;     // maximum length of a description
constexpr uint64_t kMostBytes = 1 << 20;  // of all spaces: planning a transfer takes 32 bytes for each
constexpr uint64_t kMostLooks = 64 << 20; // limit of comparisons of cells with runs

// Reads the fields of a line in order.
class Fields {
public:
  explicit Fields(std::string_view line) : rest_(line) {}
  std::string_view next() {
    const size_t end = std::min(rest_.find('\t'), rest_.size());
    const std::string_view field = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    return field;
  }
  std::string text() { return std::string(next()); }
  uint32_t number() {
    const std::optional<uint32_t> value = text::numberIn<uint32_t>(next());
    good_ = good_ && value.has_value();
    return value.value_or(0);
  }
  // Whether all fields were valid, and none is left.
  bool good() const { return good_ && rest_.empty(); }

private:
  std::string_view rest_;
  bool good_ = true;
};

// The contents of a description.
struct Cells {
  struct Space {
    std::string name;
    uint32_t flags = 0;
    uint32_t bytes = 0;
  };
  struct Cell {
    std::string name;
    uint32_t space = 0;
    uint32_t byte = 0;
    uint32_t bit = 0;
    uint32_t type = 0;
    uint32_t count = 0;
    uint32_t reach = 0;
  };

  bool readText(std::string_view text);
  bool isSound() const;

  std::string dialect;
  std::vector<Space> spaces;
  std::vector<RetainRun> runs; // `space` is an index in `spaces`
  std::vector<Cell> cells;     // sorted by name
};

std::optional<Cells> read(std::string_view description) {
  if (description.size() < 4) return std::nullopt;
  uLongf length = 0;
  for (size_t i = 0; i < 4; ++i) length |= uLongf{static_cast<uint8_t>(description[i])} << (8 * i);
  if (length > kMostText) return std::nullopt;
  std::string plain(length, 0);
  const auto* packed = reinterpret_cast<const Bytef*>(description.data() + 4);
  if (uncompress(reinterpret_cast<Bytef*>(plain.data()), &length, packed, description.size() - 4) != Z_OK ||
      length != plain.size())
    return std::nullopt;
  Cells cells;
  if (!cells.readText(plain) || !cells.isSound()) return std::nullopt;
  return cells;
}

bool Cells::readText(std::string_view text) {
  while (!text.empty()) {
    const size_t end = std::min(text.find('\n'), text.size() - 1);
    Fields fields(text.substr(0, end));
    text.remove_prefix(end + 1);
    const std::string_view kind = fields.next();
    if (kind == "dialect")
      dialect = fields.next();
    else if (kind == "space")
      spaces.push_back({.name = fields.text(), .flags = fields.number(), .bytes = fields.number()});
    else if (kind == "kept")
      runs.push_back({.space = fields.number(), .first = fields.number(), .count = fields.number()});
    else if (kind == "cell")
      cells.push_back({.name = fields.text(),
                       .space = fields.number(),
                       .byte = fields.number(),
                       .bit = fields.number(),
                       .type = fields.number(),
                       .count = fields.number(),
                       .reach = fields.number()});
    else
      return false;
    if (!fields.good()) return false;
  }
  return true;
}

// Whether the contents are as valid as the tables of a program that has passed its check.
bool Cells::isSound() const {
  uint64_t bytes = 0;
  for (const Space& space : spaces) bytes += space.bytes;
  if (bytes > kMostBytes || uint64_t{cells.size()} * runs.size() > kMostLooks) return false;
  const auto goodRun = [&](const RetainRun& run) {
    return run.space < spaces.size() && uint64_t{run.first} + run.count <= spaces[run.space].bytes;
  };
  const auto goodCell = [&](const Cell& cell) {
    const uint64_t bits = uint64_t{elementBits(cell.type)} * cell.count;
    return bits != 0 && cell.bit < 8 && (cell.bit == 0 || cell.type == RUNG_TYPE_BIT) &&
           isRetained(runs, cell.space, 8 * uint64_t{cell.byte} + cell.bit, bits);
  };
  return std::ranges::all_of(runs, goodRun) && std::ranges::all_of(cells, goodCell) &&
         std::ranges::is_sorted(cells, {}, &Cell::name);
}

// ---- conversion --------------------------------------------------------------------------------------------------

// The cells as a program without code, whose spaces are adjacent, and a memory block for it.
class Tables {
public:
  explicit Tables(const Cells& cells) : cells_(cells) {
    uint32_t offset = 0;
    for (const Cells::Space& space : cells.spaces) {
      ranges_.push_back({0, space.bytes, offset, RUNG_REPR_PACKED});
      offset += space.bytes;
    }
    for (size_t i = 0; i < cells.spaces.size(); ++i) {
      const Cells::Space& space = cells.spaces[i];
      spaces_.push_back({space.name.c_str(), 1, space.bytes, space.flags, 1, &ranges_[i]});
    }
    for (const Cells::Cell& cell : cells.cells)
      symbols_.push_back(
          {cell.name.c_str(), "", cell.space, cell.byte, cell.bit, cell.type, cell.count, 0, 0, cell.reach, RUNG_NONE});
    for (const RetainRun& run : cells.runs) retains_.push_back({ranges_[run.space].offset + run.first, run.count});
    block_.resize(offset);
    program_.size = sizeof program_;
    program_.dialect = cells.dialect.c_str();
    program_.memory_size = offset;
    program_.space_count = static_cast<uint32_t>(spaces_.size());
    program_.spaces = spaces_.data();
    program_.symbol_count = static_cast<uint32_t>(symbols_.size());
    program_.symbols = symbols_.data();
    program_.retain_count = static_cast<uint32_t>(retains_.size());
    program_.retains = retains_.data();
  }
  Tables(const Tables&) = delete;
  Tables& operator=(const Tables&) = delete;

  const rung_program& program() const { return program_; }
  uint8_t* block() { return block_.data(); }

  size_t imageSize() const {
    size_t size = 0;
    for (const RetainRun& run : cells_.runs) size += run.count;
    return size;
  }
  void fill(std::span<const uint8_t> image) {
    size_t from = 0;
    for (const RetainRun& run : cells_.runs) {
      std::copy_n(image.begin() + static_cast<ptrdiff_t>(from), run.count, at(run));
      from += run.count;
    }
  }
  // Copies the retained bytes of `other` at the same addresses.
  void fillSame(const Tables& other) {
    for (const RetainRun& run : other.cells_.runs) {
      const std::string& name = other.cells_.spaces[run.space].name;
      for (size_t i = 0; i < spaces_.size(); ++i) {
        if (name != spaces_[i].name || run.first >= spaces_[i].byte_count) continue;
        const uint32_t count = std::min(run.count, spaces_[i].byte_count - run.first);
        std::copy_n(other.at(run), count, &block_[ranges_[i].offset + run.first]);
      }
    }
  }
  std::vector<uint8_t> image() const {
    std::vector<uint8_t> out;
    for (const RetainRun& run : cells_.runs) out.insert(out.end(), at(run), at(run) + run.count);
    return out;
  }

private:
  const uint8_t* at(const RetainRun& run) const { return block_.data() + ranges_[run.space].offset + run.first; }
  uint8_t* at(const RetainRun& run) { return block_.data() + ranges_[run.space].offset + run.first; }

  const Cells& cells_;
  std::vector<rung_range> ranges_;
  std::vector<rung_space> spaces_;
  std::vector<rung_symbol> symbols_;
  std::vector<rung_span> retains_;
  std::vector<uint8_t> block_;
  rung_program program_{};
};

} // namespace

// Cells found by address that the former program did not retain get their initial contents.
RetainedTaken takeRetained(std::string_view now, std::string_view former, std::span<const uint8_t> image,
                           std::span<const uint8_t> initial, const Naming& naming) {
  const std::optional<Cells> cells = read(now);
  const std::optional<Cells> formerCells = read(former);
  if (!cells || !formerCells) return {};
  if (cells->dialect != formerCells->dialect) return {.otherDialect = formerCells->dialect};
  Tables from(*formerCells);
  Tables to(*cells);
  if (image.size() != from.imageSize() || initial.size() != to.imageSize()) return {};
  to.fill(initial);
  from.fillSame(to);
  from.fill(image);
  const StateTransfer transfer(from.program(), to.program(), naming);
  transfer.run(from.block(), to.block());
  return {true, to.image(), {transfer.changes().begin(), transfer.changes().end()}, {}};
}

namespace {

constexpr size_t kListed = 8; // maximum number of changes in a report

std::string textOf(const std::vector<StateChange>& changes) {
  std::string text;
  for (size_t i = 0; i < std::min(changes.size(), kListed); ++i) {
    text += i == 0 ? ": " : ", ";
    text += kChangeKinds[static_cast<size_t>(changes[i].kind)];
    if (!changes[i].formerName.empty()) text += " " + changes[i].formerName;
    text += " " + changes[i].name;
  }
  return changes.size() <= kListed ? text : text + " and " + std::to_string(changes.size() - kListed) + " more";
}

std::vector<uint8_t> initialImage(const rung_program& program, const RetainMap& map) {
  const Instance cold(program);
  std::vector<uint8_t> raw(map.rawSize());
  std::vector<uint8_t> image(map.size());
  cold.copyRetained(raw);
  map.pack(raw, image);
  return image;
}

} // namespace

void takeRetainedOf(const rung_program& program, const RetainMap& map, RetainImage& image, const Naming& naming) {
  RetainedTaken taken =
      takeRetained(map.layout().description, image.description, image.bytes, initialImage(program, map), naming);
  image.found = taken.good;
  image.bytes = std::move(taken.image);
  if (!taken.otherDialect.empty())
    image.report += "; that one is of the dialect " + text::withoutControls(taken.otherDialect) + ", this one of " +
                    program.dialect;
  if (image.found) image.report += "; its cells are taken by name and address" + textOf(taken.changes);
}

} // namespace rung::runtime
