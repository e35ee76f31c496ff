// What has changed from one version of a program to another, by what its rungs do and not by its lines.
#pragma once
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "ir/core/marks.h"
#include "ir/core/module.h"

namespace rung::report {

// What a key of the configuration says. Texts that are distinct may mean the same, so what is compared is beside them.
struct Setting {
  std::string text;     // for people
  std::string meaning;  // equal: the same
  uint64_t content = 0; // of the file that it names, as a hash; 0: none
  bool operator==(const Setting& other) const { return meaning == other.meaning && content == other.content; }
};
using Settings = std::map<std::string, Setting>; // by key

// A version of the program, as its front end built it; what it refers to outlives the comparison.
struct Version {
  const ir::Module& module;
  const ir::GivenNumbers& given; // (frontend::CompileOptions::given)
  const rung_program& program;   // with the module's names and initial contents
  Settings settings;
  std::set<std::string>
      controlNames; // of the control's own, in upper case: a rung that uses them first declares nothing
};

enum class ChangeKind { Added, Removed, Changed, Moved };

std::string_view nameOf(ChangeKind kind); // "added"

// A rung as its author sees it.
struct ShownRung {
  const ir::Rung* rung = nullptr;       // null: there is none
  const ir::Routine* routine = nullptr; // that it is in
};

// Where a rung leads that does not lead there in the other version.
struct OtherWay {
  std::string before; // "rung 7 "lamps", old.lad:20", "the end of MAIN"
  std::string after;
  bool operator==(const OtherWay&) const = default;
};

struct RungChange {
  ChangeKind kind = ChangeKind::Added;
  ShownRung before;            // none: added
  ShownRung after;             // none: removed
  std::vector<OtherWay> paths; // of a rung that is the same but for where it leads
};

// A name, a message, a key of the configuration, and what it means.
struct NameChange {
  ChangeKind kind = ChangeKind::Added;
  std::string name;
  std::string before; // "" of an added one
  std::string after;  // "" of a removed one
};

// A cell that holds the number of the line where a mechanism waits: which numbers it gets, line by line.
struct LineChange {
  std::string name;
  std::vector<uint32_t> before;
  std::vector<uint32_t> after;
};

struct Difference {
  std::vector<RungChange> rungs;    // in the order of the new program, removed ones after what they followed
  std::vector<NameChange> names;    // by name; also bits that have moved where their byte is used as a whole
  std::vector<NameChange> contents; // initial ones, of names
  std::vector<NameChange> messages; // by number
  std::vector<NameChange> settings; // by key
  std::vector<LineChange> lines;    // that rungs read, by the name of the cell
  size_t same = 0;                  // rungs
  bool none() const {
    return rungs.empty() && names.empty() && contents.empty() && messages.empty() && settings.empty() && lines.empty();
  }
};

struct Options {
  bool messages = true; // they are compared
  // What a text of the program is to its author, as "button 3"; "" for a message; null: all are messages.
  std::string (*textName)(uint32_t number) = nullptr;
};

// The result points into both modules.
Difference compare(const Version& before, const Version& after, const Options& options = {});

// The routine's name for people: the module, level, subroutine or procedure.
std::string_view shownName(const ir::Routine& routine);

// For people: with the lines of rungs as they are written, "-" before those that are gone and "+" before new ones.
std::string shownAsText(const Difference& difference, const ir::Module& before, const ir::Module& after);
std::string shownAsJson(const Difference& difference, const ir::Module& before, const ir::Module& after);

} // namespace rung::report
