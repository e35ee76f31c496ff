// See model.h.
#include "rtlib/nc/gsk/model.h"

#include "rtlib/nc/gsk/axis_commands.h"
#include "rtlib/nc/gsk/services.h"
#include "rtlib/nc/gsk/signals.h"
#include "rtlib/nc/gsk/window_functions.h"

namespace rung::nc::gsk {

const pmc::Model& model() {
  static const pmc::Model made{.signals = &gskSignals,
                               .functions = {{
                                   {10, 4, {7, 0}, {5, 0}}, // MF, MFIN
                                   {14, 4, {7, 5}, {4, 4}}, // MF2, MFIN2
                                   {18, 4, {7, 6}, {4, 5}}, // MF3, MFIN3
                                   {},
                                   {},
                                   {22, 4, {7, 2}, {5, 2}}, // SF, SFIN
                                   {26, 4, {7, 3}, {5, 3}}, // TF, TFIN
                                   {30, 4, {7, 4}, {5, 7}}, // BF, SFIN2
                                   {0, 0, {8, 0}, {4, 3}},  // EF: always FIN, and its falling edge (l.9450-9454)
                               }},
                               .axisCommands = axisCommands(),
                               .axisGroups = axisGroups(),
                               .services = kServices,
                               .windowRefused = kWindowNotProvided, // man. l.8668-8676
                               .inverted = false,
                               .messages = pmc::MessageRule::ByBit};
  return made;
}

} // namespace rung::nc::gsk
