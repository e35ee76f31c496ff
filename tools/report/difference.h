// The changes from one version of a program to another, by what its rungs do and not by its lines.
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

// The value of a key of the configuration. Different texts may mean the same, so the meaning is compared and not the
// text.
struct Setting {
  std::string text;     // for messages
  std::string meaning;  // equal for equal settings
  uint64_t content = 0; // hash of the file that it names; 0: none
  bool operator==(const Setting& other) const { return meaning == other.meaning && content == other.content; }
};
using Settings = std::map<std::string, Setting>; // by key

// A version of the program as its front end built it; everything that it refers to must outlive the comparison.
struct Version {
  const ir::Module& module;
  const ir::GivenNumbers& given; // from frontend::CompileOptions::given
  const rung_program& program;   // with the module's names and initial contents
  Settings settings;
  std::set<std::string>
      controlNames; // names of the control, in upper case: the first rung that uses one does not declare it
};

enum class ChangeKind { Added, Removed, Changed, Moved };

std::string_view nameOf(ChangeKind kind); // "added"

// A rung with its routine.
struct ShownRung {
  const ir::Rung* rung = nullptr;       // null: the version has no such rung
  const ir::Routine* routine = nullptr; // the routine that contains it
};

// An exit of a rung that leads elsewhere in the other version.
struct ChangedPath {
  std::string before; // "rung 7 "lamps", old.lad:20", "the end of MAIN"
  std::string after;
  bool operator==(const ChangedPath&) const = default;
};

struct RungChange {
  ChangeKind kind = ChangeKind::Added;
  ShownRung before;               // null if added
  ShownRung after;                // null if removed
  std::vector<ChangedPath> paths; // changed exits of a rung that is otherwise the same
};

// A name, a message or a key of the configuration, with its meaning in both versions.
struct NameChange {
  ChangeKind kind = ChangeKind::Added;
  std::string name;
  std::string before; // "" if added
  std::string after;  // "" if removed
};

// A cell that holds the number of the line where a mechanism waits, with its possible values.
struct LineChange {
  std::string name;
  std::vector<uint32_t> before;
  std::vector<uint32_t> after;
};

struct Difference {
  std::vector<RungChange> rungs;    // in the order of the new program; a removed rung after the rung that it followed
  std::vector<NameChange> names;    // by name; also bits that have moved where their byte is used as a whole
  std::vector<NameChange> contents; // changed initial contents, by name
  std::vector<NameChange> messages; // by number
  std::vector<NameChange> settings; // by key
  std::vector<LineChange> lines;    // cells that rungs read, by name
  size_t same = 0;                  // number of unchanged rungs
  bool none() const {
    return rungs.empty() && names.empty() && contents.empty() && messages.empty() && settings.empty() && lines.empty();
  }
};

struct Options {
  bool messages = true; // whether messages are compared
  // How the author refers to a text of the program, such as "button 3"; "" for a message; null: all texts are messages.
  std::string (*textName)(uint32_t number) = nullptr;
};

// The result points into both modules.
Difference compare(const Version& before, const Version& after, const Options& options = {});

// The routine's name in reports: the module, level, subroutine or procedure.
std::string_view shownName(const ir::Routine& routine);

// The difference as text for a terminal, with the lines of rungs as written, "-" before removed and "+" before new
// ones; and as JSON.
std::string shownAsText(const Difference& difference, const ir::Module& before, const ir::Module& after);
std::string shownAsJson(const Difference& difference, const ir::Module& before, const ir::Module& after);

} // namespace rung::report
