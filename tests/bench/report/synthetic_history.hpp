// Nights as they may be: what is random in them is the engine's own numbers, equal everywhere.
#pragma once

#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include "bench/report/judge_times.hpp"

namespace airybench::testing {

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_()) + 0.5) / 4294967296.0;
  }
  double normal(double deviation) {  // Box and Muller
    constexpr double pi = 3.14159265358979323846;
    const double radius = std::sqrt(-2 * std::log(uniform(0, 1)));
    return deviation * radius * std::cos(uniform(0, 2 * pi));
  }
  bool chance(double probability) { return uniform(0, 1) < probability; }

 private:
  std::mt19937 engine_;
};

struct SyntheticNoise {
  std::size_t cases = 50;
  double least_scatter = 0.02, most_scatter = 0.04;  // of a case's median from night to night
  double night_scatter = 0.05, night_memory = 0.8;   // of the common factor, autoregressive
  double outlier_chance = 0.05;                      // of a case in a night, and of a whole night
  double drifting_share = 0.1, drift_per_night = 3e-4;
  double kernel_scatter = 0.01;
};

// Makes nights one after another.
class SyntheticHistory {
 public:
  SyntheticHistory(const SyntheticNoise& noise, unsigned seed) : noise_(noise), random_(seed) {
    for (std::size_t c = 0; c < noise.cases; ++c)
      cases_.push_back({random_.uniform(-6, 1),
                        random_.uniform(noise.least_scatter, noise.most_scatter),
                        random_.chance(noise.drifting_share)
                            ? (random_.chance(0.5) ? 1 : -1) * noise.drift_per_night
                            : 0.0});
    night_ = random_.normal(noise.night_scatter);
    table.log_times.resize(noise.cases);
    table.starts.resize(noise.cases, 0);
  }

  void add_night() {
    night_ = noise_.night_memory * night_ +
             random_.normal(noise_.night_scatter *
                            std::sqrt(1 - noise_.night_memory * noise_.night_memory));
    const double disturbed = outlier();  // what slows the cases of a night, not the kernel
    for (std::size_t c = 0; c < cases_.size(); ++c) {
      Case& one = cases_[c];
      one.level += one.drift;
      table.log_times[c].push_back(one.level + night_ + disturbed + random_.normal(one.scatter) +
                                   outlier());
    }
    table.log_kernel.push_back(night_ + random_.normal(noise_.kernel_scatter) + outlier());
  }
  void add_nights(int count) {
    for (int i = 0; i < count; ++i) add_night();
  }

  void slow_down(std::size_t c, double factor) { cases_[c].level += std::log(factor); }
  void slow_down_all(double factor) {
    for (Case& one : cases_) one.level += std::log(factor);
  }
  std::size_t nights() const { return table.log_kernel.size(); }

  TimeTable table;

 private:
  struct Case {
    double level, scatter, drift;
  };
  double outlier() {
    return random_.chance(noise_.outlier_chance) ? std::log(random_.uniform(1.1, 1.5)) : 0;
  }

  SyntheticNoise noise_;
  Random random_;
  std::vector<Case> cases_;
  double night_ = 0;
};

}  // namespace airybench::testing
