// The two commands of every native runner: `check FILE` and `time FILE`.
//
// An engine has the angles and rates of its joints in place, so that a call starts from inputs
// already in the engine's own layout: nothing is copied on its account.
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "craft.hpp"

constexpr int REPEATS = 3;
constexpr int BATCHES = 5000;
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

template <class Engine>
void print_times(Engine& engine, std::size_t joints) {
  const double guess = batch(engine, joints, 1 + 3000 / static_cast<long>(joints));
  const long calls = std::max(1L, std::lround(NANOSECONDS_A_BATCH / guess));
  std::vector<double> medians;
  double least = INFINITY, most = 0.0;
  for (int repeat = 0; repeat < REPEATS; ++repeat) {
    std::vector<double> means;
    for (int k = 0; k < BATCHES; ++k) means.push_back(batch(engine, joints, calls));
    std::sort(means.begin(), means.end());
    medians.push_back(means[BATCHES / 2]);
    least = std::min(least, means.front());
    most = std::max(most, means.back());
  }
  std::printf("{\"ns\": [%.1f, %.1f, %.1f], \"spread\": [%.1f, %.1f]}\n", medians[0], medians[1],
              medians[2], least, most);
}

inline void print_accelerations(const std::vector<double>& accelerations) {
  const char* before = "{\"accelerations\": [";
  for (const double x : accelerations) {
    std::printf("%s%.17g", before, x);
    before = ", ";
  }
  std::puts("]}");
}

template <class Engine>
int run(int count, char** words) {
  const std::string what = count == 3 ? words[1] : "";
  if (what != "check" && what != "time") {
    std::fprintf(stderr, "usage: %s check|time FILE\n", words[0]);
    return 2;
  }
  const Craft craft(words[2]);
  Engine engine(craft, words[2]);
  engine.evaluate();
  if (what == "check") {
    print_accelerations(engine.accelerations());
  } else {
    print_times(engine, craft.angles.size());
  }
  return 0;
}
