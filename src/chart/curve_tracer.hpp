#pragma once

#include <vector>

#include "chart/curve_slices.hpp"

namespace strutt {

/// An edge as a point of a curve, lower or upper.
CurvePoint point_of(const TongueEdge& edge, double over);

/// Joins the edges of neighbouring slices to curves; see tongue_curves().
class CurveTracer {
 public:
  CurveTracer(SliceSource& source, int order, const CurveOptions& options)
      : source_(source), order_(order), options_(options) {}

  std::vector<TongueCurve> curves();

 private:
  /// Part of a curve on which the second parameter grows; each end may be joined to one of another strand.
  struct Strand {
    std::vector<CurvePoint> points;
    int begin_link = -1, end_link = -1;
    bool taken = false;
  };

  void advance(const Slice& a, const Slice& b, int depth);
  bool may_bend(const Slice& a, const Slice& b, double apart) const;
  void bend(const Slice& a, const Slice& b);
  void turn(const Slice& a, const Slice& b, std::size_t pair);
  bool change_thin_pairs(const Slice& a, const Slice& b);
  void begin_thin_pair(const Slice& b, std::size_t pair);
  void turn_at_rest(const Slice& slice, bool begins);
  bool at_rest(const TongueEdge& edge, double over) const;
  void append(const Slice& slice);
  void restart(const Slice& slice);
  int open();
  Slice between(const Slice& a, const Slice& b);
  bool steep(const Slice& a, const Slice& b) const;
  bool straight(const Slice& a, const Slice& middle, const Slice& b) const;
  double border_distance(const Slice& slice) const;
  TongueCurve joined(int strand);

  SliceSource& source_;
  int order_;
  const CurveOptions& options_;
  std::vector<Strand> strands_;
  std::vector<int> active_;  ///< of the edges of the last slice
};

}  // namespace strutt
