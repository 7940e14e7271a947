#include "io/tongue_overlay.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace strutt {
namespace {

double part(const Axis& axis, double value) {
  if (axis.scale == AxisScale::linear) return (value - axis.from) / (axis.to - axis.from);
  return std::log(value / axis.from) / std::log(axis.to / axis.from);
}

}  // namespace

struct TongueOverlay::Style {
  const char* title;
  const char* line;
};

// Colours that differ in lightness too, and dashes that nobody needs colours to tell apart.
const TongueOverlay::Style TongueOverlay::kTongue{"tongue edges (min. stroke)",
                                                  "linewidth 1.2 linecolor rgb '#000000'"};
const TongueOverlay::Style TongueOverlay::kMinusOne{"edge -1 (min. stroke)",
                                                    "linewidth 1.4 linecolor rgb '#000000'"};
const TongueOverlay::Style TongueOverlay::kPlusOne{"edge +1 (min. stroke)",
                                                   "linewidth 1.6 dashtype (14,5) linecolor rgb '#0072B2'"};
const TongueOverlay::Style TongueOverlay::kComplex{"complex (min. stroke)",
                                                   "linewidth 1.8 dashtype (4,3) linecolor rgb '#6A1B9A'"};

const TongueOverlay::Style* TongueOverlay::style_of(const TongueCurve& curve, const CurvePoint& point) {
  if (curve.order != kNoOrder) return &kTongue;
  switch (point.mechanism) {
    case Mechanism::plus_one:
      return &kPlusOne;
    case Mechanism::minus_one:
      return &kMinusOne;
    case Mechanism::complex_pair:
      break;
  }
  return &kComplex;
}

TongueOverlay::TongueOverlay(const std::vector<TongueCurve>& curves, const ChartRequest& request) {
  for (const Style* style : {&kTongue, &kPlusOne, &kMinusOne, &kComplex}) {
    std::string block;
    for (const TongueCurve& curve : curves) {
      bool before = false;  // the point before has this style: its line goes on to the next one
      for (const CurvePoint& p : curve.points) {
        const bool now = style_of(curve, p) == style;
        if (now || before)
          fmt::format_to(std::back_inserter(block), "{:.6f} {:.6f}\n", part(request.x, p.along),
                         part(request.y, p.over));
        if (before && !now) block += '\n';
        before = now;
      }
      if (before) block += '\n';
    }
    if (block.empty()) continue;
    data_ += block + "\n";  // two empty lines end a block
    styles_.push_back(style);
  }
}

std::string TongueOverlay::plots() const {
  std::string text;
  for (std::size_t i = 0; i < styles_.size(); ++i)
    text += fmt::format(", '{}' index {} with lines {} title '{}'", kTonguesFile, i, styles_[i]->line,
                        styles_[i]->title);
  return text;
}

}  // namespace strutt
