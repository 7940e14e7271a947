#include "chart/surrogate_box.hpp"

#include <algorithm>
#include <cmath>

#include "chart/chebyshev.hpp"

namespace strutt {
namespace {

constexpr double kUnit = 0x1p-53;
constexpr int kFirstDegree = 8, kHighestDegree = 64;
// The rounding of nodes is independent from one to the next, and the squares of the Lagrange polynomials of
// Chebyshev points sum to at most 1: it does not grow between nodes. Their truncation is as smooth as the
// factors and does not either.
constexpr double kNodeErrorGrowth = 2.0;
constexpr double kLeastRounding = 64.0 * kUnit;  // of transform and sum, relative to the factors
constexpr double kShareAtNodes = 0.4;            // of the tolerance: between nodes the factors can be smaller
constexpr double kShareAfterCut = 0.8;           // the same, once coefficients that do not matter are dropped

/// Samples on the tensor grid of degrees nx, ny; node (i, j) at [i * (ny + 1) + j].
struct Grid {
  int nx = 0, ny = 0;
  std::vector<PropagatorSample> samples;

  std::size_t index(int i, int j) const { return static_cast<std::size_t>(i * (ny + 1) + j); }
};

/// The samples of `coarse` are every second, or all, of those of the finer grid.
bool refine(Grid& grid, int nx, int ny, const SurrogateBox& box, const Sampling& sampling, BoxBuild& build) {
  Grid fine{nx, ny, std::vector<PropagatorSample>(static_cast<std::size_t>((nx + 1) * (ny + 1)))};
  std::vector<std::array<double, 2>> points;
  std::vector<std::size_t> places;
  const int step_x = grid.nx == 0 ? 0 : nx / grid.nx, step_y = grid.ny == 0 ? 0 : ny / grid.ny;
  for (int i = 0; i <= nx; ++i) {
    for (int j = 0; j <= ny; ++j) {
      if (step_x > 0 && i % step_x == 0 && j % step_y == 0) {
        fine.samples[fine.index(i, j)] = grid.samples[grid.index(i / step_x, j / step_y)];
        continue;
      }
      const auto coordinate = [&](std::size_t axis, int k, int n) {
        return 0.5 * (box.low[axis] + box.high[axis]) +
               0.5 * (box.high[axis] - box.low[axis]) * chebyshev::point(k, n);
      };
      points.push_back({coordinate(0, i, nx), coordinate(1, j, ny)});
      places.push_back(fine.index(i, j));
    }
  }
  std::vector<PropagatorSample> found;
  if (!sampling(points, found)) return false;
  for (std::size_t k = 0; k < places.size(); ++k) {
    fine.samples[places[k]] = found[k];
    build.right_hand_sides += found[k].right_hand_sides;
  }
  build.nodes += points.size();
  grid = std::move(fine);
  return true;
}

/// Log of the size of a propagator, in the state scaled by the box's kappa.
double log2_size(const PropagatorSample& sample, double kappa) {
  const auto scaled = at_kappa(sample.value, sample.error, kappa);
  return std::log2(scaled.value.cwiseAbs().maxCoeff()) + static_cast<double>(sample.exponent);
}

/// The sums of |c| over the last rows (x) and columns (y), which stand for what lies beyond.
struct Tail {
  double x = 0.0, y = 0.0;
};

Tail tail_of(const Eigen::MatrixXd& c) {
  const auto last = [](Eigen::Index count) { return std::max<Eigen::Index>(3, count / 10); };
  return {c.bottomRows(last(c.rows())).cwiseAbs().sum(), c.rightCols(last(c.cols())).cwiseAbs().sum()};
}

/// Error from rounding: of the sum, the polynomials and the coordinates (a relative error `eta` of s and t).
double rounding_of(const Eigen::MatrixXd& c, const std::array<double, 2>& eta) {
  const auto square = [](Eigen::Index n) {
    return Eigen::ArrayXd::LinSpaced(n, 0.0, static_cast<double>(n - 1)).square();
  };
  const Eigen::MatrixXd size = c.cwiseAbs();
  const double slope_x = square(c.rows()).matrix().dot(size.rowwise().sum());
  const double slope_y = square(c.cols()).matrix().dot(size.colwise().sum().transpose());
  return static_cast<double>(c.rows() + c.cols() + 4) * kUnit * size.sum() +
         (eta[0] + 2.0 * kUnit) * slope_x + (eta[1] + 2.0 * kUnit) * slope_y;
}

/// The samples of a grid in the unit and the state of the box.
std::vector<PointPropagator> in_unit_of(const SurrogateBox& box, const Grid& grid) {
  std::vector<PointPropagator> result;
  for (const auto& sample : grid.samples) {
    auto scaled = at_kappa(sample.value, sample.error, box.kappa);
    const auto shift = static_cast<int>(std::max(sample.exponent - box.exponent, -2000L));
    for (auto* m : {&scaled.value, &scaled.error})
      *m = m->unaryExpr([shift](double v) { return std::ldexp(v, shift); });
    result.push_back(std::move(scaled));
  }
  return result;
}

/// Coefficients and error bounds from a full grid.
Tail fit(SurrogateBox& box, const Grid& grid, const std::array<double, 2>& coordinate_error) {
  const auto& middle = grid.samples[grid.index(grid.nx / 2, grid.ny / 2)];
  box.kappa = middle.kappa;
  box.exponent = middle.exponent;
  for (const auto& sample : grid.samples) box.exponent = std::max(box.exponent, sample.exponent);
  const auto samples = in_unit_of(box, grid);
  const Eigen::MatrixXd to_x = chebyshev::transform(grid.nx), to_y = chebyshev::transform(grid.ny);
  const std::array<double, 2> eta{3.0 * kUnit + 2.0 * coordinate_error[0] / (box.high[0] - box.low[0]),
                                  3.0 * kUnit + 2.0 * coordinate_error[1] / (box.high[1] - box.low[1])};
  const Eigen::Index n = middle.value.rows();
  box.coefficients.resize(static_cast<std::size_t>(n * n));
  box.error.resize(box.coefficients.size());
  Tail worst;
  for (std::size_t f = 0; f < box.coefficients.size(); ++f) {
    const Eigen::Index row = static_cast<Eigen::Index>(f) / n, column = static_cast<Eigen::Index>(f) % n;
    Eigen::MatrixXd values(grid.nx + 1, grid.ny + 1);
    double node_error = 0.0;
    for (int i = 0; i <= grid.nx; ++i) {
      for (int j = 0; j <= grid.ny; ++j) {
        const auto& sample = samples[grid.index(i, j)];
        values(i, j) = sample.value(row, column);
        node_error = std::max(node_error, sample.error(row, column));
      }
    }
    box.coefficients[f] = to_x * values * to_y.transpose();
    const Tail tail = tail_of(box.coefficients[f]);
    worst = {std::max(worst.x, tail.x), std::max(worst.y, tail.y)};
    // the transform errs like a random walk of its terms
    const double transform_error = 8.0 * kUnit * std::sqrt(grid.nx + grid.ny) * values.cwiseAbs().maxCoeff();
    box.error[f] = 2.0 * (tail.x + tail.y) + kNodeErrorGrowth * (node_error + transform_error) +
                   rounding_of(box.coefficients[f], eta);
  }
  return worst;
}

/// The largest scaled error of M at the nodes with these bounds of the entries, in the unit of the box.
double worst_error(const SurrogateBox& box, SurrogateKind kind, const Grid& grid,
                   const Eigen::MatrixXd& error) {
  double worst = 0.0;
  const auto samples = in_unit_of(box, grid);
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const auto& sample = grid.samples[k];
    const auto scaled = at_kappa(samples[k].value, error, sample.kappa / box.kappa);
    worst = std::max(worst, error_of_monodromy(kind, scaled, box.exponent, sample));
  }
  return worst;
}

/// The direction along which the size of the factors changes more.
BoxOutcome steeper(const SurrogateBox& box, const Grid& grid) {
  double along_x = 0.0, along_y = 0.0;
  const auto size = [&](int i, int j) { return log2_size(grid.samples[grid.index(i, j)], box.kappa); };
  for (int j = 0; j <= grid.ny; ++j) along_x = std::max(along_x, std::abs(size(0, j) - size(grid.nx, j)));
  for (int i = 0; i <= grid.nx; ++i) along_y = std::max(along_y, std::abs(size(i, 0) - size(i, grid.ny)));
  return along_x >= along_y ? BoxOutcome::split_x : BoxOutcome::split_y;
}

/// Whether most nodes miss the tolerance by their own errors, whatever stands beside them: a smaller box
/// would not help.
bool is_hopeless(SurrogateKind kind, const Grid& grid, double tolerance) {
  std::size_t missed = 0;
  for (const auto& sample : grid.samples) {
    const Eigen::MatrixXd error = kNodeErrorGrowth * sample.error + kLeastRounding * sample.value.cwiseAbs();
    const auto scaled = at_kappa(sample.value, error, sample.kappa);
    if (error_of_monodromy(kind, scaled, sample.exponent, sample) > kShareAtNodes * tolerance) ++missed;
  }
  return 2 * missed > grid.samples.size();
}

/// Drops the last rows and columns of all coefficients while what they add up to is below `allowed`.
void cut(SurrogateBox& box, std::vector<double> allowed) {
  bool rows_left = true, columns_left = true;
  const auto drop = [&](bool row) {
    auto& c = box.coefficients;
    const Eigen::Index rows = c[0].rows() - (row ? 1 : 0), columns = c[0].cols() - (row ? 0 : 1);
    if (rows < 1 || columns < 1) return false;
    std::vector<double> sum(c.size());
    for (std::size_t f = 0; f < c.size(); ++f) {
      sum[f] = row ? c[f].bottomRows(1).cwiseAbs().sum() : c[f].rightCols(1).cwiseAbs().sum();
      if (!(sum[f] <= allowed[f])) return false;
    }
    for (std::size_t f = 0; f < c.size(); ++f) {
      allowed[f] -= sum[f];
      box.error[f] += sum[f];
      c[f].conservativeResize(rows, columns);
    }
    return true;
  };
  while (rows_left || columns_left) {
    rows_left = rows_left && drop(true);
    columns_left = columns_left && drop(false);
  }
}

}  // namespace

Eigen::MatrixXd error_matrix(const SurrogateBox& box) {
  const auto n = static_cast<Eigen::Index>(std::lround(std::sqrt(static_cast<double>(box.error.size()))));
  return Eigen::Map<const Eigen::MatrixXd>(box.error.data(), n, n).transpose();
}

BoxBuild build_box(SurrogateBox& box, SurrogateKind kind, const Sampling& sampling,
                   const std::array<double, 2>& coordinate_error, double tolerance, double affordable) {
  BoxBuild build;
  Grid grid;
  int nx = kFirstDegree, ny = kFirstDegree;
  for (;;) {
    if ((nx + 1.0) * (ny + 1.0) > affordable) return build;
    if (!refine(grid, nx, ny, box, sampling, build)) {
      build.outcome = BoxOutcome::cancelled;
      return build;
    }
    const bool valid =
        std::all_of(grid.samples.begin(), grid.samples.end(), [](const auto& s) { return s.valid; });
    if (!valid) return build;
    const Tail tail = fit(box, grid, coordinate_error);
    const double error = worst_error(box, kind, grid, error_matrix(box));
    if (error <= kShareAtNodes * tolerance) {
      std::vector<double> allowed = box.error;
      for (double& a : allowed) a *= kShareAfterCut * tolerance / error - 1.0;
      cut(box, allowed);
      box.interpolated = true;
      build.outcome = BoxOutcome::interpolated;
      return build;
    }
    // Nothing but the bounds of nodes and rounding left: more nodes do not help, less range of sizes does.
    const auto n = grid.samples[0].value.rows();
    const Eigen::MatrixXd from_tail = Eigen::MatrixXd::Constant(n, n, 2.0 * (tail.x + tail.y));
    if (worst_error(box, kind, grid, from_tail) <= 0.1 * error) {
      if (is_hopeless(kind, grid, tolerance)) return build;
      build.outcome = steeper(box, grid);
      return build;
    }
    const bool in_x = tail.x >= tail.y;
    if ((in_x ? nx : ny) >= kHighestDegree) {
      build.outcome = in_x ? BoxOutcome::split_x : BoxOutcome::split_y;
      return build;
    }
    (in_x ? nx : ny) *= 2;
  }
}

Eigen::MatrixXd evaluate(const SurrogateBox& box, double x, double y) {
  const auto local = [&](std::size_t axis, double v) {
    const double middle = 0.5 * (box.low[axis] + box.high[axis]),
                 half = 0.5 * (box.high[axis] - box.low[axis]);
    return (v - middle) / half;
  };
  const double s = local(0, x), t = local(1, y);
  Eigen::MatrixXd in_x, in_y;
  chebyshev::polynomials({&s, 1}, static_cast<int>(box.coefficients[0].rows()) - 1, in_x);
  chebyshev::polynomials({&t, 1}, static_cast<int>(box.coefficients[0].cols()) - 1, in_y);
  Eigen::MatrixXd result = error_matrix(box);  // of the same shape
  for (std::size_t f = 0; f < box.coefficients.size(); ++f) {
    const auto n = static_cast<std::size_t>(result.rows());
    result(static_cast<Eigen::Index>(f / n), static_cast<Eigen::Index>(f % n)) =
        (in_x * box.coefficients[f] * in_y.transpose())(0, 0);
  }
  return result;
}

}  // namespace strutt
