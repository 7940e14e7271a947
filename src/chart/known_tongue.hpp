#pragma once

#include <functional>
#include <optional>

#include "chart/evaluations.hpp"
#include "strutt/floquet/tongue_width.hpp"

namespace strutt {

/// Tongue n of X'' + (mean + V) X = 0 for the V that was asked for last. On many lines V stays the same, also
/// from one line to the next: neither the damping nor the frequency of a support changes it.
class KnownTongue {
 public:
  /// `evaluations` counts what is computed, by its cost.
  explicit KnownTongue(int order, const std::atomic<bool>* cancel = nullptr,
                       Evaluations* evaluations = nullptr)
      : order_(order), cancel_(cancel), evaluations_(evaluations) {}

  int order() const { return order_; }

  /// As computed by `find` unless V is still the same.
  TongueEdges edges(const PeriodicFunction& v, const std::function<TongueEdges()>& find);

  /// tongue_width, of the edges that belong to V.
  TongueWidth width(const PeriodicFunction& v, const TongueEdges& edges, double coefficient_error);

  /// narrow_tongue_growth.
  double growth(const PeriodicFunction& v, const TongueEdges& edges, double coefficient_error);

  /// More than the growth: that of a tongue as wide as its edges leave open, at a fraction of the cost.
  double growth_bound(const PeriodicFunction& v, const TongueEdges& edges);

 private:
  struct Of {
    PeriodicFunction v;
    TongueEdges edges;
    double coefficient_error = 0.0;  ///< of width and growth
    std::optional<TongueWidth> width{};
    std::optional<double> growth{}, growth_bound{};
  };
  Of& of(const PeriodicFunction& v, const TongueEdges& edges);
  Of& of(const PeriodicFunction& v, const TongueEdges& edges, double coefficient_error);
  void count(std::int64_t evaluations);

  int order_;
  const std::atomic<bool>* cancel_;
  Evaluations* evaluations_;
  std::optional<Of> last_;
};

/// Both have the same harmonics, or are the same square wave.
bool same_function(const PeriodicFunction& a, const PeriodicFunction& b);

}  // namespace strutt
