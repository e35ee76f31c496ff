// How much of each kind of work a turn of the thread that serves does for a program, beside one request of each client.
// What is left is done in the next turns: who waits for a restart or an answer does not wait for what never ends.
#pragma once

namespace rung::control::turn {

constexpr int kMostMessages = 64;    // that the program has shown
constexpr int kMostServices = 64;    // requests of the program to a CNC
constexpr int kMostScans = 500;      // of each client that watches all of them
constexpr int kMostShadowRuns = 200; // that are compared

} // namespace rung::control::turn
