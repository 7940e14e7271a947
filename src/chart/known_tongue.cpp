#include "chart/known_tongue.hpp"

#include <algorithm>

#include "chart/surrogate_scope.hpp"
#include "floquet/cancellable_width.hpp"

namespace strutt {
namespace {

// Costs in margins of a plain equation, some 0.1 ms, from times for 1 to 32 harmonics: the elimination in 34
// digits grows with the cube of the highest order, the edges in double with its square.
int highest_order(const PeriodicFunction& v) {
  return v.harmonics().empty() ? 1 : v.harmonics().back().order;
}

std::int64_t edge_cost(const PeriodicFunction& v) {
  const std::int64_t order = highest_order(v);
  return 1 + order * order / 8;
}

std::int64_t width_cost(const PeriodicFunction& v) {
  const std::int64_t order = highest_order(v);
  return 10 + order * order * order;
}

std::int64_t growth_cost(const PeriodicFunction& v) { return 1 + width_cost(v) / 5; }

}  // namespace

bool same_function(const PeriodicFunction& a, const PeriodicFunction& b) {
  if (is_square(a) || is_square(b))
    return is_square(a) && is_square(b) && a.square_amplitude() == b.square_amplitude();
  return std::ranges::equal(a.harmonics(), b.harmonics(), [](const Harmonic& x, const Harmonic& y) {
    return x.order == y.order && x.cosine == y.cosine && x.sine == y.sine;
  });
}

void KnownTongue::count(std::int64_t evaluations) {
  if (evaluations_ != nullptr) evaluations_->add(evaluations);
}

TongueEdges KnownTongue::edges(const PeriodicFunction& v, const std::function<TongueEdges()>& find) {
  if (last_ && same_function(last_->v, v)) return last_->edges;
  count(edge_cost(v));
  last_ = Of{.v = v, .edges = find()};
  return last_->edges;
}

KnownTongue::Of& KnownTongue::of(const PeriodicFunction& v, const TongueEdges& edges) {
  if (!last_ || !same_function(last_->v, v)) last_ = Of{.v = v, .edges = edges};
  return *last_;
}

KnownTongue::Of& KnownTongue::of(const PeriodicFunction& v, const TongueEdges& edges,
                                 double coefficient_error) {
  Of& known = of(v, edges);
  if (known.width && known.coefficient_error == coefficient_error) return known;
  count(width_cost(v));
  known.coefficient_error = coefficient_error;
  known.width = cancellable_width(v, edges, coefficient_error, cancel_);
  known.growth.reset();
  return known;
}

TongueWidth KnownTongue::width(const PeriodicFunction& v, const TongueEdges& edges,
                               double coefficient_error) {
  return *of(v, edges, coefficient_error).width;
}

double KnownTongue::growth(const PeriodicFunction& v, const TongueEdges& edges, double coefficient_error) {
  Of& known = of(v, edges, coefficient_error);
  if (known.growth) return *known.growth;
  count(growth_cost(v));
  known.growth = narrow_tongue_growth(v, edges, *known.width);
  return *known.growth;
}

double KnownTongue::growth_bound(const PeriodicFunction& v, const TongueEdges& edges) {
  Of& known = of(v, edges);
  if (!known.growth_bound) {
    const double most = edges.upper.value - edges.lower->value + edges.upper.error + edges.lower->error;
    count(growth_cost(v));
    known.growth_bound = narrow_tongue_growth(v, edges, {most, 0.0});
  }
  return *known.growth_bound;
}

}  // namespace strutt
