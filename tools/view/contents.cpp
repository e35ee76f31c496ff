// See contents.h.
#include "tools/view/contents.h"

namespace rung::view {
namespace {

using Kind = ContentsEntry::Kind;

class Collector {
public:
  explicit Collector(const Program& program) : program_(program) {}

  std::vector<ContentsEntry> run() {
    for (uint32_t i = 0; i < program_.blocks.size(); ++i) add(i);
    close(0);
    return std::move(entries_);
  }

private:
  void add(uint32_t index);
  void open(Kind kind, uint32_t index, const std::string& title);
  // Entries of this rank and below end here.
  void close(uint32_t rank) {
    while (!open_.empty() && rankOf(entries_[open_.back()].kind) >= rank) open_.pop_back();
  }
  static uint32_t rankOf(Kind kind) { return static_cast<uint32_t>(kind); }

  const Program& program_;
  std::vector<ContentsEntry> entries_;
  std::vector<size_t> open_; // those that what comes next is part of
};

void Collector::open(Kind kind, uint32_t index, const std::string& title) {
  const Block& block = program_.blocks[index];
  const bool first = !entries_.empty() && entries_.back().kind == Kind::File && entries_.back().firstRung == 0;
  if (kind == Kind::Module && first) { // most files are one module
    entries_.back().title = block.text + (title.empty() ? "" : ": " + title);
    return;
  }
  close(rankOf(kind));
  const auto level = static_cast<uint32_t>(open_.size());
  open_.push_back(entries_.size());
  entries_.push_back({kind, index, level, block.text, title, 0, 0});
}

void Collector::add(uint32_t index) {
  const Block& block = program_.blocks[index];
  switch (block.kind) {
  case Block::Kind::Comment: return;
  case Block::Kind::File: return open(Kind::File, index, block.comment);
  case Block::Kind::Module: return open(Kind::Module, index, block.title.empty() ? block.comment : block.title);
  case Block::Kind::Section: return open(Kind::Section, index, block.comment);
  case Block::Kind::Rung: break;
  }
  const uint32_t number = program_.figures[block.figure].number;
  for (size_t entry : open_) {
    if (entries_[entry].firstRung == 0) entries_[entry].firstRung = number;
    entries_[entry].lastRung = number;
  }
}

} // namespace

std::vector<ContentsEntry> contentsOf(const Program& program) { return Collector(program).run(); }

} // namespace rung::view
