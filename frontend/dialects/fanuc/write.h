// Writes mnemonic files, for conversions.
#pragma once
#include <span>
#include <string>
#include <string_view>

#include "frontend/network/language.h"
#include "frontend/network/program.h"

namespace rung::frontend::fanuc {

// A line of a ladder; functions by their numbers, which every tool reads. `begins`: the first command of its network.
std::string mnemonicCommand(const network::Language& language, const network::Written& command, bool begins);
// A complete file with the sections of these declarations, and the comments of `head` before them.
std::string mnemonicFile(std::span<const network::Item> head, std::span<const network::Item> declarations,
                         std::string_view ladder);

} // namespace rung::frontend::fanuc
