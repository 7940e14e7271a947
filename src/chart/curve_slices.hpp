#pragma once

#include <vector>

#include "chart/known_tongue.hpp"
#include "chart/window_scale.hpp"
#include "strutt/chart/tongue_curves.hpp"
#include "strutt/floquet/monodromy.hpp"

namespace strutt {

/// All edges of one tongue on a line at one value of the second parameter, in their order along the line.
struct Slice {
  struct Edge {
    TongueEdge edge;
    bool interpolated = false;  ///< not on the curve, only near it
  };
  double over = 0.0;
  std::vector<Edge> edges;
};

bool same_pattern(const Slice& a, const Slice& b);

/// A slice without the edges `first` and first + 1.
Slice without_pair(Slice slice, std::size_t first);

/// Slices of a tongue, or of a system (kNoOrder).
class SliceSource {
 public:
  SliceSource(const Scene& scene, const TongueLine& along, const TongueLine& over, int order,
              const CurveOptions& options, Evaluations& evaluations)
      : scene_(scene),
        along_(along),
        over_(over),
        along_scale_(along, options.log_along),
        over_scale_(over, options.log_over),
        order_(order),
        options_(options),
        evaluations_(evaluations),
        tongue_(order, options.cancel, &evaluations) {}

  Slice at(double over);
  bool cancelled() const { return options_.cancel != nullptr && *options_.cancel; }
  double tolerance() const { return options_.tolerance; }
  double resolution() const { return options_.resolution; }
  double thinnest()
      const;  ///< pairs of systems that are thinner are left out of slices: they show in some only
  const Scene& scene() const { return scene_; }
  const TongueLine& along() const { return along_; }
  const TongueLine& over() const { return over_; }
  const WindowScale& along_scale() const { return along_scale_; }
  const WindowScale& over_scale() const { return over_scale_; }

 private:
  MonodromyEngine engine_;
  Scene scene_;
  const TongueLine& along_;
  const TongueLine& over_;
  WindowScale along_scale_, over_scale_;
  int order_;
  const CurveOptions& options_;
  Evaluations& evaluations_;
  KnownTongue tongue_;  ///< what one slice leaves for the next
};

/// Where a pair of neighbouring edges comes into being.
struct CurveTip {
  double along, over, error;  ///< error of `over`, absolute
};

/// Between `none`, a value of the second parameter without the pair, and the slice `with` it: the square of
/// the distance of the pair, linear next to the tip, leads there; the tip is enclosed by slices without and
/// with the pair.
CurveTip find_tip(SliceSource& source, double none, const Slice& with, std::size_t pair);

}  // namespace strutt
