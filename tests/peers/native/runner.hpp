// The commands of every native runner: `check FILE`, `time FILE` and `turns FILE`.
//
// An engine has the angles and rates of its joints in place, so that a call starts from inputs
// already in the engine's own layout: nothing is copied on its account.
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <string>
#include <vector>

#include "craft.hpp"

// As of the runners in Python and of Precess.
constexpr int REPEATS = 21;
constexpr double NANOSECONDS_A_TURN = 5e7;
// Far shorter than a scheduler's time slice: what else the machine does spoils few batches, and
// the median none. Far longer than it takes to read the clock.
constexpr double NANOSECONDS_A_BATCH = 1e5;

// Mean nanoseconds of one evaluation over a batch.
//
// One angle and one rate change before each call, a joint in turn: no result can be kept from
// the call before, and the cost of the change stays below a nanosecond.
template <class Engine>
double batch(Engine& engine, std::size_t joints, long calls) {
  using clock = std::chrono::steady_clock;
  double *const angles = engine.angles(), *const rates = engine.rates();
  std::size_t joint = 0;
  const auto start = clock::now();
  for (long call = 0; call < calls; ++call) {
    angles[joint] += 1e-9;
    rates[joint] += 1e-9;
    joint = joint + 1 == joints ? 0 : joint + 1;
    engine.evaluate();
  }
  return std::chrono::duration<double, std::nano>(clock::now() - start).count() / calls;
}

// The median of as many batches as a turn has time for.
template <class Engine>
double turn(Engine& engine, std::size_t joints, long calls) {
  std::vector<double> means;
  for (double spent = 0.0; spent < NANOSECONDS_A_TURN; spent += means.back() * calls)
    means.push_back(batch(engine, joints, calls));
  std::sort(means.begin(), means.end());
  return means[means.size() / 2];
}

// So many turns; or one after each line of the input, first that all is ready.
template <class Engine>
void print_turns(Engine& engine, std::size_t joints, bool by_line) {
  const double guess = batch(engine, joints, 1 + 3000 / static_cast<long>(joints));
  const long calls = std::max(1L, std::lround(NANOSECONDS_A_BATCH / guess));
  if (by_line) {
    std::puts("{\"ready\": true}");
    std::fflush(stdout);
    for (std::string line; std::getline(std::cin, line);) {
      std::printf("{\"ns\": %.2f}\n", turn(engine, joints, calls));
      std::fflush(stdout);
    }
    return;
  }
  for (int repeat = 0; repeat < REPEATS; ++repeat)
    std::printf("%s%.2f", repeat == 0 ? "{\"ns\": [" : ", ", turn(engine, joints, calls));
  std::puts("]}");
}

// Numbers in a row, after a text.
inline void print_numbers(const char* before, const std::vector<double>& numbers) {
  for (const double x : numbers) {
    std::printf("%s%.17g", before, x);
    before = ", ";
  }
  std::fputs("]", stdout);
}

// What an engine that has no accelerations to compare prints by itself.
template <class Engine>
auto print_result(const Engine& engine, int) -> decltype(engine.print()) {
  engine.print();
}

inline void print_accelerations(const std::vector<double>& accelerations) {
  print_numbers("{\"accelerations\": [", accelerations);
  std::puts("}");
}

template <class Engine>
void print_result(const Engine& engine, long) {
  print_accelerations(engine.accelerations());
}

template <class Engine, class Given = Craft>
int run(int count, char** words) {
  const std::string what = count == 3 ? words[1] : "";
  if (what != "check" && what != "time" && what != "turns") {
    std::fprintf(stderr, "usage: %s check|time|turns FILE\n", words[0]);
    return 2;
  }
  const Given craft(words[2]);
  Engine engine(craft, words[2]);
  engine.evaluate();
  if (what == "check") {
    print_result(engine, 0);
  } else {
    print_turns(engine, craft.angles.size(), what == "turns");
  }
  return 0;
}
