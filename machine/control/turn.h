// Limits of each kind of work that one turn of the service thread does for a program, besides one request of each
// client. The remainder is done in the next turns, so that endless work delays neither a restart nor an answer.
#pragma once

namespace rung::control::turn {

constexpr int kMostMessages = 64;    // messages of the program
constexpr int kMostServices = 64;    // requests of the program to a CNC
constexpr int kMostScans = 500;      // scans sent to each client that watches all scans
constexpr int kMostShadowRuns = 200; // runs of a shadow that are compared

} // namespace rung::control::turn
