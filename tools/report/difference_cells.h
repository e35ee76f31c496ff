// Cells whose places the compiler assigns, in two versions: which names correspond, which bits have moved in a byte
// that is used as a whole, and which line numbers the program reads.
#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "rung/program.h"
#include "tools/report/difference.h"

namespace rung::report {

// The former name of each cell that both versions have, by its present name; and of the state by which a mechanism
// continues, by its key. A name that only one version has matches a cell of another name in the other version if it
// follows the same cell there and has the same form; of several, the cell with which rungs do the same is taken.
using FormerNames = std::map<std::string, std::string>;

FormerNames formerNames(const Version& before, const Version& after);
// The same map for one version alone: each name maps to itself.
FormerNames ownNames(const FormerNames& former);

// Bits that are now another bit of their byte, or in another byte, if one version uses such a byte as a whole.
std::vector<NameChange> compareBits(const Version& before, const Version& after, const FormerNames& former);

// Cells that receive line numbers and that rungs of both versions read.
std::vector<LineChange> compareLines(const Version& before, const Version& after, const FormerNames& former);

// The initial contents of a program's memory, by the names of its variables.

// By name and element: "'text'", "0.5", "12". Contains all variables whose places the compiler assigns; of arrays, the
// elements that are not 0.
using Contents = std::map<std::pair<std::string, uint32_t>, std::string>;

Contents initialContents(const rung_program& program);
// The text of a zero of the same form, for an element that only one program's contents have.
std::string zeroLike(const std::string& text);

} // namespace rung::report
