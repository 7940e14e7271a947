#include "chart/surrogate_box.hpp"

#include <algorithm>
#include <cmath>

#include "base/constants.hpp"
#include "chart/box_error.hpp"
#include "chart/chebyshev.hpp"
#include "chart/clenshaw_kernel.hpp"
#include "chart/degree_ladder.hpp"

namespace strutt {
namespace {

Tail tail_of(const Eigen::MatrixXd& c) {
  return {c.bottomRows(tail_length(c.rows())).cwiseAbs().sum(),
          c.rightCols(tail_length(c.cols())).cwiseAbs().sum()};
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

/// The nodes of a box on the tensor grid of degrees nx, ny; node (i, j) at [i * (ny + 1) + j].
class Grid {
 public:
  Grid(SurrogateBox& box, const Sampling& sampling, const std::array<double, 2>& coordinate_error)
      : box_(box), sampling_(sampling) {
    for (const std::size_t i : {0, 1})
      eta_[i] = 3.0 * kUnit + 2.0 * coordinate_error[i] / (box.high[i] - box.low[i]);
  }

  const std::vector<PropagatorSample>& samples() const { return samples_; }
  long right_hand_sides() const { return right_hand_sides_; }

  /// The samples so far are every second, or all, of those of the finer grid.
  bool refine(int nx, int ny) {
    std::vector<PropagatorSample> fine(static_cast<std::size_t>((nx + 1) * (ny + 1))), found;
    std::vector<std::array<double, 2>> points;
    std::vector<std::size_t> places;
    const int step_x = nx_ == 0 ? 0 : nx / nx_, step_y = ny_ == 0 ? 0 : ny / ny_;
    for (int i = 0; i <= nx; ++i) {
      for (int j = 0; j <= ny; ++j) {
        const auto place = static_cast<std::size_t>(i * (ny + 1) + j);
        if (step_x > 0 && i % step_x == 0 && j % step_y == 0) {
          fine[place] = samples_[index(i / step_x, j / step_y)];
          continue;
        }
        points.push_back({chebyshev::point(i, nx, box_.low[0], box_.high[0]),
                          chebyshev::point(j, ny, box_.low[1], box_.high[1])});
        places.push_back(place);
      }
    }
    if (!sampling_(points, found)) return false;
    for (std::size_t k = 0; k < places.size(); ++k) {
      right_hand_sides_ += found[k].right_hand_sides;
      fine[places[k]] = std::move(found[k]);
    }
    samples_ = std::move(fine);
    nx_ = nx;
    ny_ = ny;
    return true;
  }

  /// Coefficients, unit and error bounds of the box.
  Tail fit() {
    const auto& middle = samples_[index(nx_ / 2, ny_ / 2)];
    set_unit(box_, middle, samples_);
    const auto samples = in_unit_of(box_, samples_);
    const Eigen::MatrixXd to_x = chebyshev::transform(nx_), to_y = chebyshev::transform(ny_);
    const Eigen::Index n = middle.value.rows();
    box_.coefficients.resize(static_cast<std::size_t>(n * n));
    box_.error.resize(box_.coefficients.size());
    Tail worst;
    for (std::size_t f = 0; f < box_.coefficients.size(); ++f) {
      const Eigen::Index row = static_cast<Eigen::Index>(f) / n, column = static_cast<Eigen::Index>(f) % n;
      Eigen::MatrixXd values(nx_ + 1, ny_ + 1);
      double node_error = 0.0;
      for (int i = 0; i <= nx_; ++i) {
        for (int j = 0; j <= ny_; ++j) {
          const auto& sample = samples[index(i, j)];
          values(i, j) = sample.value(row, column);
          node_error = std::max(node_error, sample.error(row, column));
        }
      }
      auto& c = box_.coefficients[f] = to_x * values * to_y.transpose();
      const Tail tail = tail_of(c);
      worst = {std::max(worst.x, tail.x), std::max(worst.y, tail.y)};
      node_error += transform_error(nx_, ny_, values.cwiseAbs().maxCoeff());
      box_.error[f] = 2.0 * (tail.x + tail.y) + kNodeErrorGrowth * node_error + rounding_of(c, eta_);
    }
    return worst;
  }

  /// The direction along which the size of the factors changes more.
  BoxOutcome steeper() const {
    double along_x = 0.0, along_y = 0.0;
    const auto size = [&](int i, int j) { return log2_size(samples_[index(i, j)], box_.kappa); };
    for (int j = 0; j <= ny_; ++j) along_x = std::max(along_x, std::abs(size(0, j) - size(nx_, j)));
    for (int i = 0; i <= nx_; ++i) along_y = std::max(along_y, std::abs(size(i, 0) - size(i, ny_)));
    return along_x >= along_y ? BoxOutcome::split_x : BoxOutcome::split_y;
  }

 private:
  std::size_t index(int i, int j) const { return static_cast<std::size_t>(i * (ny_ + 1) + j); }

  SurrogateBox& box_;
  const Sampling& sampling_;
  std::array<double, 2> eta_{};  // relative error of s and t
  int nx_ = 0, ny_ = 0;
  std::vector<PropagatorSample> samples_;
  long right_hand_sides_ = 0;
};

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
  Grid grid(box, sampling, coordinate_error);
  const auto ladder = raise_degrees(grid, box, kind, tolerance, affordable);
  if (ladder.outcome == BoxOutcome::interpolated) {
    std::vector<double> allowed = box.error;
    for (double& a : allowed) a *= kShareAfterCut * tolerance / ladder.error - 1.0;
    cut(box, allowed);
    box.interpolated = true;
  }
  return {ladder.outcome, grid.samples().size(), grid.right_hand_sides()};
}

void evaluate(const SurrogateBox& box, std::span<const double> x, std::span<const double> y, double* values) {
  const auto local = [&](std::size_t axis, std::span<const double> coordinates) {
    const double middle = 0.5 * (box.low[axis] + box.high[axis]),
                 half = 0.5 * (box.high[axis] - box.low[axis]);
    std::vector<double> result;
    for (const double c : coordinates) result.push_back((c - middle) / half);
    return result;
  };
  const auto s = local(0, x), t = local(1, y);
  detail::ScatteredSeries series{.coefficients = {},
                                 .terms_x = static_cast<std::size_t>(box.coefficients[0].rows()),
                                 .terms_y = static_cast<std::size_t>(box.coefficients[0].cols()),
                                 .s = s.data(),
                                 .t = t.data(),
                                 .points = s.size(),
                                 .values = values,
                                 .stride = s.size()};
  for (const auto& c : box.coefficients) series.coefficients.push_back(c.data());
  detail::evaluate(series);
}

Eigen::MatrixXd evaluate(const SurrogateBox& box, double x, double y) {
  Eigen::MatrixXd by_columns = error_matrix(box);  // of the same shape
  evaluate(box, {&x, 1}, {&y, 1}, by_columns.data());
  return by_columns.transpose();
}

Eigen::MatrixXd evaluation_error(const SurrogateBox& box) {
  Eigen::MatrixXd rounding = error_matrix(box);  // of the same shape
  const auto growth = [](Eigen::Index terms) {
    const Eigen::ArrayXd j = Eigen::ArrayXd::LinSpaced(terms, 1.0, static_cast<double>(terms));
    return Eigen::VectorXd((j * (j + 1.0) * (j + 2.0) / 2.0).matrix());
  };
  for (std::size_t f = 0; f < box.coefficients.size(); ++f) {
    const Eigen::MatrixXd size = box.coefficients[f].cwiseAbs();
    rounding.data()[f] =
        kUnit * (growth(size.rows()).dot(size.rowwise().sum()) + size.colwise().sum() * growth(size.cols()));
  }
  return error_matrix(box) + rounding.transpose();
}

}  // namespace strutt
