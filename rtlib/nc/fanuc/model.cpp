// See model.h.
#include "rtlib/nc/fanuc/model.h"

#include "rtlib/nc/fanuc/axis_commands.h"
#include "rtlib/nc/fanuc/services.h"
#include "rtlib/nc/fanuc/signals.h"
#include "rtlib/nc/fanuc/window_functions.h"

namespace rung::nc::fanuc {

const pmc::Model& model() {
  static const pmc::Model made{.signals = &fanucSignals,
                               .functions = {{
                                   {10, 4, {7, 0}, {5, 0}},  // MF, MFIN
                                   {14, 2, {8, 4}, {4, 4}},  // MF2, MFIN2
                                   {16, 2, {8, 5}, {4, 5}},  // MF3, MFIN3
                                   {568, 4, {8, 6}, {4, 6}}, // MF4, MFIN4
                                   {572, 4, {8, 7}, {4, 7}}, // MF5, MFIN5
                                   {22, 4, {7, 2}, {5, 2}},  // SF, SFIN
                                   {26, 4, {7, 3}, {5, 3}},  // TF, TFIN
                                   {30, 4, {7, 7}, {5, 7}},  // BF, BFIN
                                   {0, 0, {8, 0}, {4, 3}},   // EF: always FIN
                               }},
                               .axisCommands = axisCommands(),
                               .axisGroups = axisGroups(),
                               .services = kServices,
                               .windowRefused = kWindowNoFunction,
                               .constants = kConstantRelays,
                               .inverted = true,
                               .messages = pmc::MessageRule::ByTextList};
  return made;
}

} // namespace rung::nc::fanuc
