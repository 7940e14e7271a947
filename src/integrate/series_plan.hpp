#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "integrate/series_majorant.hpp"
#include "strutt/integrate/hill_series.hpp"

namespace strutt::detail {

/// Plans for equations Y'' + W Y = 0 with W = mean + sum_f weight_f f over an interval. The equations are
/// sorted into classes by the size of W and by how much of it varies (SeriesClasses); a class has the
/// cheapest plan whose tail, at its largest equation, is small enough. It is looked for when the first
/// equation of the class comes.
class SeriesPlanner {
 public:
  /// For a truncation below about `tolerance` in the propagator of the whole interval, relative to its size.
  SeriesPlanner(std::span<const PeriodicFunction> basis, double from, double to, double tolerance);

  /// How the members of a class are integrated: the place of the plan in plans(), -1 where none serves, and a
  /// tail as HillSeries::tail gives it.
  struct Choice {
    int plan = -1;
    double tail = 0.0;
  };

  /// The class of each lane from `first` on. Depends on the lane only.
  void classify(const HillBatch& batch, std::size_t first, std::span<std::int64_t> classes) const;

  const Choice& choice(std::int64_t number) {
    const auto place = static_cast<std::size_t>(number);
    auto& known = place < choices_.size()
                      ? choices_[place]
                      : others_.try_emplace(number, Choice{.plan = kUnmade}).first->second;
    return known.plan == kUnmade ? known = cheapest(number) : known;
  }

  std::span<const HillSeriesPlan> plans() const { return plans_; }

 private:
  /// What a number of steps offers, whatever the equation.
  struct Rung {
    int steps;
    double radius, growth;                  // growth: of |f| within r of the real axis
    int kinds[3];                           // nodes of each Parity
    std::vector<CoefficientBounds> bounds;  // column by column, per unit of Y_c
    double cost(int terms) const;
  };
  /// The largest equation of a class.
  struct Corner {
    double size, mean;
    std::vector<double> varying;  // column by column
  };

  static constexpr int kUnmade = -2;

  const Rung& rung(std::size_t place);
  void count_kinds(Rung& rung, const SeriesNodes& nodes) const;
  Corner corner(std::int64_t number) const;
  double allowed_tail(const Rung& rung, const Corner& equation) const;
  double growth(const Rung& rung, const Corner& equation) const;
  bool too_much_rounding(const Rung& rung, const Corner& equation) const;
  SeriesMajorant majorant(const Rung& rung, const Corner& equation) const;
  Choice cheapest(std::int64_t number);
  int number_of(const HillSeriesPlan& plan);

  std::vector<PeriodicFunction> basis_;
  double from_, to_, tolerance_;
  std::vector<double> largest_, share_;  // see SeriesClasses
  std::vector<int> column_;
  int columns_ = 0;
  std::vector<std::optional<Rung>> rungs_;
  std::vector<Choice> choices_;  // of the classes that one function has
  std::unordered_map<std::int64_t, Choice> others_;
  std::vector<HillSeriesPlan> plans_;
};

}  // namespace strutt::detail
