#include "floquet/segments.hpp"

#include <algorithm>
#include <cmath>

namespace strutt {
namespace {

constexpr double kLogGrowthPerSegment = 8.0;
constexpr double kRadiansPerSegment = 8.0;

}  // namespace

std::vector<Segment> smooth_pieces(const PeriodicFunction& w, double from, double to, double cut) {
  std::vector<double> ends = w.breakpoints(from, to);
  if (cut > from && cut < to) ends.push_back(cut);
  ends.push_back(to);
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  std::vector<Segment> result;
  for (const double end : ends) result.push_back({result.empty() ? from : result.back().to, end});
  return result;
}

std::vector<Segment> subdivided(const std::vector<Segment>& pieces, const PeriodicFunction& w) {
  std::vector<Segment> result;
  for (const auto& [start, end] : pieces) {
    const auto piece = w.piece(0.5 * (start + end));
    const double log_growth = std::sqrt(std::max(0.0, -piece.lower_bound())) * (end - start);
    const double radians = std::sqrt(piece.bound()) * (end - start);
    const double parts = std::max(
        {1.0, std::ceil(log_growth / kLogGrowthPerSegment), std::ceil(radians / kRadiansPerSegment)});
    if (!(static_cast<double>(result.size()) + parts <= kMostSegments)) return {};
    for (double j = 0.0; j < parts; ++j) {
      result.push_back({std::lerp(start, end, j / parts), std::lerp(start, end, (j + 1.0) / parts)});
    }
  }
  return result;
}

}  // namespace strutt
