// What has changed from one version of a program to another, by what its rungs do and not by its lines.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "ir/core/module.h"

namespace rung::difference {

enum class ChangeKind { Added, Removed, Changed, Moved };

std::string_view nameOf(ChangeKind kind); // "added"

struct RungChange {
  ChangeKind kind = ChangeKind::Added;
  const ir::Rung* before = nullptr; // null: added
  const ir::Rung* after = nullptr;  // null: removed
};

// A name or a message's number, and what it means.
struct NameChange {
  ChangeKind kind = ChangeKind::Added;
  std::string name;
  std::string before; // "" of an added one
  std::string after;  // "" of a removed one
};

struct Difference {
  std::vector<RungChange> rungs;    // in the order of the new program, removed ones after what they followed
  std::vector<NameChange> names;    // by name
  std::vector<NameChange> messages; // by number
  size_t same = 0;                  // rungs
  bool none() const { return rungs.empty() && names.empty() && messages.empty(); }
};

// Of modules as a front end built them; the result points into both.
Difference compare(const ir::Module& before, const ir::Module& after);

// For people: with the lines of rungs as they are written, "-" before those that are gone and "+" before new ones.
std::string shownAsText(const Difference& difference, const ir::Module& before, const ir::Module& after);
std::string shownAsJson(const Difference& difference, const ir::Module& before, const ir::Module& after);

} // namespace rung::difference
