// What the collectors of both forms share: the program so far, the gap that grows, and the next network.
#pragma once
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "frontend/ladder/text/ladder_file.h"
#include "frontend/network/convert/source_model.h"
#include "frontend/network/read/context.h"
#include "frontend/network/read/title.h"

namespace rung::network::convert {

struct Collector {
  Context& context;
  std::span<const Network> networks; // those still to come
  SourceProgram program = {};
  Gap gap = {};

  const Network& takeNetwork() {
    const Network& network = networks.front();
    networks = networks.subspan(1);
    return network;
  }
  void comment(std::string_view text) {
    const auto section = sectionIn(text);
    gap.push_back({section ? Item::Kind::Section : Item::Kind::Comment, clean(section.value_or(text))});
  }
  void blank() { gap.push_back({Item::Kind::Blank}); }
  // `symbol`, `const` or `dialect`: the words of the statement and the comment after it.
  void statement(Item::Kind kind, std::span<const Word> words, std::string_view comment, bool first = false) {
    Item item{kind};
    if (words.size() > 1) item.text = words[1].text;
    if (words.size() > 2) item.value = words[2].text;
    item.comment = clean(comment);
    gap.insert(first ? gap.begin() : gap.end(), std::move(item));
  }
  Gap takeGap() { return std::exchange(gap, {}); }
};

void collectList(Collector& collector, FileId file);
void collectLadder(Collector& collector, const ladder::LadderFile& file);

} // namespace rung::network::convert
