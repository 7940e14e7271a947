#include "io/contour.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <unordered_map>
#include <utility>

namespace strutt {
namespace {

/// An edge of the grid between neighbours: 2 * (index of its first node), plus 1 if it goes up.
using Edge = std::uint64_t;
constexpr Edge kNone = std::numeric_limits<Edge>::max();

class Tracer {
 public:
  Tracer(const std::vector<float>& values, std::size_t columns, double level)
      : values_(values), columns_(columns), level_(level) {
    const std::size_t rows = values.size() / columns;
    for (std::size_t j = 0; j + 1 < rows; ++j) {
      for (std::size_t i = 0; i + 1 < columns; ++i) add_square(j * columns + i);
    }
  }

  std::vector<ContourLine> run() {
    std::vector<ContourLine> lines;
    for (const Edge edge : order_) {  // open lines first: they begin where an edge has one neighbour
      if (links_.at(edge).second == kNone && !done(edge)) lines.push_back(follow(edge));
    }
    for (const Edge edge : order_) {
      if (!done(edge)) lines.push_back(follow(edge));
    }
    return lines;
  }

 private:
  bool above(std::size_t node) const { return static_cast<double>(values_[node]) > level_; }

  void add_square(std::size_t node) {
    const std::array<std::size_t, 4> corner{node, node + 1, node + columns_ + 1, node + columns_};
    unsigned code = 0;
    for (unsigned k = 0; k < 4; ++k) {
      if (std::isnan(values_[corner[k]])) return;
      if (above(corner[k])) code |= 1U << k;
    }
    if (code == 0 || code == 15) return;
    const Edge bottom = 2 * node, right = 2 * (node + 1) + 1, top = 2 * (node + columns_),
               left = 2 * node + 1;
    if (code == 5 || code == 10) {  // a saddle: the middle decides which corners belong together
      const double middle =
          (static_cast<double>(values_[corner[0]]) + static_cast<double>(values_[corner[1]]) +
           static_cast<double>(values_[corner[2]]) + static_cast<double>(values_[corner[3]])) /
          4.0;
      const bool first_joined = (middle > level_) == (code == 5);
      link(bottom, first_joined ? right : left);
      link(top, first_joined ? left : right);
      return;
    }
    std::array<Edge, 2> ends{kNone, kNone};
    const std::array<Edge, 4> edges{bottom, right, top, left};
    std::size_t found = 0;
    for (unsigned k = 0; k < 4; ++k) {
      const bool crossed = ((code >> k) & 1U) != ((code >> ((k + 1) % 4)) & 1U);
      if (crossed && found < 2) ends[found++] = edges[k];
    }
    link(ends[0], ends[1]);
  }

  void link(Edge a, Edge b) {
    for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, a}}) {
      auto [place, fresh] = links_.try_emplace(from, to, kNone);
      if (fresh)
        order_.push_back(from);
      else
        place->second.second = to;
    }
  }

  bool done(Edge edge) const { return visited_.contains(edge); }

  ContourLine follow(Edge start) {
    ContourLine line;
    Edge edge = start;
    while (edge != kNone && !done(edge)) {
      visited_.emplace(edge, true);
      line.push_back(point(edge));
      const auto [a, b] = links_.at(edge);
      const Edge next = a != kNone && !done(a) ? a : b;
      if ((a == start || b == start) && line.size() > 2 && (next == kNone || done(next)))
        line.push_back(line.front());
      edge = next;
    }
    return line;
  }

  GridPoint point(Edge edge) const {
    const std::size_t node = edge / 2;
    const bool up = edge % 2 == 1;
    const double a = static_cast<double>(values_[node]);
    const double b = static_cast<double>(values_[up ? node + columns_ : node + 1]);
    const double t = std::clamp((level_ - a) / (b - a), 0.0, 1.0);
    const double fraction = std::isnan(t) ? 0.5 : t;  // from -inf to inf
    return {static_cast<double>(node % columns_) + (up ? 0.0 : fraction),
            static_cast<double>(node / columns_) + (up ? fraction : 0.0)};
  }

  const std::vector<float>& values_;
  std::size_t columns_;
  double level_;
  std::unordered_map<Edge, std::pair<Edge, Edge>> links_;
  std::unordered_map<Edge, bool> visited_;
  std::vector<Edge> order_;  // of insertion, so that the result does not depend on hashing
};

}  // namespace

std::vector<ContourLine> contour_lines(const std::vector<float>& values, std::size_t columns, double level) {
  if (columns < 2 || values.size() < 2 * columns) return {};
  return Tracer(values, columns, level).run();
}

double length_of(const ContourLine& line, double column_unit, double row_unit) {
  double length = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i) {
    length += std::hypot((line[i].column - line[i - 1].column) * column_unit,
                         (line[i].row - line[i - 1].row) * row_unit);
  }
  return length;
}

}  // namespace strutt
