// Cells to which the compiler gives places, in two versions: by what names they are the same, which bits have moved in
// a byte that is used as a whole, and which line numbers the program reads.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "tools/report/difference.h"

namespace rung::report {

// The former name of each cell that both versions have, by its name now; and of the state by which a mechanism
// continues, by its key. A name that only one version has belongs to a cell by another name in the other if it follows
// the same cell there and is of the same form: of several the one with which rungs do the same.
using FormerNames = std::map<std::string, std::string>;

FormerNames formerNames(const Version& before, const Version& after);
// The same for one version alone: each name is its own.
FormerNames ownNames(const FormerNames& former);

// Bits that are another bit of their byte now, or in another byte, where one version uses such a byte as a whole.
std::vector<NameChange> compareBits(const Version& before, const Version& after, const FormerNames& former);

// Cells that get the numbers of lines and that rungs of both versions read.
std::vector<LineChange> compareLines(const Version& before, const Version& after, const FormerNames& former);

} // namespace rung::report
