// Rungs and texts in a program's tables (see image_tables.h).
#include "ir/image/image_tables.h"

#include <algorithm>
#include <map>
#include <string_view>

namespace rung::ir {
namespace {

class RungTables {
public:
  RungTables(ImageTables& tables, const Layout& layout) : tables_(tables), layout_(layout), module_(layout.module()) {}

  void run() {
    addRungs();
    addTexts();
  }

private:
  void addRungs() {
    tables_.rungs.resize(layout_.partition().rungCount());
    std::vector<const std::string*> homes(layout_.partition().rungCount());
    for (uint32_t r = 0; r < module_.routines.size(); ++r) {
      for (uint32_t i = 0; i < module_.routines[r].rungs.size(); ++i) {
        const Rung& rung = module_.routines[r].rungs[i];
        const uint32_t number = layout_.partition().rungNumber(RoutineId{r}, i);
        homes[number] = &homeOf(module_.routines[r], rung);
        tables_.rungs[number] = {rung.title.empty() ? "" : tables_.text(rung.title),
                                 rung.begin.file.index,
                                 rung.begin.line,
                                 std::max(rung.begin.line, rung.lastLine),
                                 RUNG_NONE,
                                 rung.key,
                                 rung.number,
                                 rung.copy};
      }
    }
    nameRoutines(homes);
  }

  // Of each rung.
  void nameRoutines(const std::vector<const std::string*>& homes) {
    std::map<std::string_view, uint32_t> known;
    for (size_t i = 0; i < homes.size(); ++i) {
      const auto [at, isNew] = known.try_emplace(*homes[i], static_cast<uint32_t>(known.size()));
      if (isNew) tables_.routines.push_back(tables_.text(*homes[i]));
      tables_.rungs[i].routine = at->second;
    }
  }

  void addTexts() {
    for (const std::string& s : module_.files) tables_.files.push_back(tables_.text(s));
    for (const std::string& s : module_.faults) tables_.faults.push_back(tables_.text(s));
    for (const std::string& s : module_.services) tables_.services.push_back(tables_.text(s));
    std::vector<MessageText> messages = module_.messages;
    std::ranges::stable_sort(messages, {}, &MessageText::number);
    for (const MessageText& m : messages) {
      tables_.texts.push_back({m.number, 0, tables_.text(m.text)});
    }
  }

  ImageTables& tables_;
  const Layout& layout_;
  const Module& module_;
};

} // namespace

void fillRungTables(ImageTables& tables, const Layout& layout) { RungTables(tables, layout).run(); }

} // namespace rung::ir
