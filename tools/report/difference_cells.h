// Cells to which the compiler gives places, in two versions: by what names they are the same, which bits have moved in
// a byte that is used as a whole, and which line numbers the program reads.
#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "rung/program.h"
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

// What the memory of a program holds at its start, by the names of its variables.

// By name and element: "'text'", "0.5", "12". All variables to which the compiler gives places; of arrays those
// elements that are not 0.
using Contents = std::map<std::pair<std::string, uint32_t>, std::string>;

Contents initialContents(const rung_program& program);
// Of an element that is in the contents of one program, and in the other 0: how that is written.
std::string zeroLike(const std::string& text);

} // namespace rung::report
