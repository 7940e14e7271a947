#pragma once

#include <string>
#include <vector>

#include "strutt/chart/stability_chart.hpp"
#include "strutt/chart/tongue_curves.hpp"

namespace strutt {

inline constexpr const char* kTonguesFile = "tongues.dat";

/// The edges of tongues on top of a chart: those with an index alike, those of systems by mechanism, told
/// apart by colour and dashes.
class TongueOverlay {
 public:
  TongueOverlay() = default;
  TongueOverlay(const std::vector<TongueCurve>& curves, const ChartRequest& request);

  bool empty() const { return styles_.empty(); }
  bool by_mechanism() const { return !empty() && styles_.front() != &kTongue; }

  /// kTonguesFile, in units of the plotting area: a block for each part of plots().
  const std::string& data() const { return data_; }
  std::string plots() const;  ///< parts of a plot command, each after a comma

 private:
  struct Style;
  std::vector<const Style*> styles_;
  std::string data_;

  static const Style kTongue, kPlusOne, kMinusOne, kComplex;
  static const Style* style_of(const TongueCurve& curve, const CurvePoint& point);
};

}  // namespace strutt
