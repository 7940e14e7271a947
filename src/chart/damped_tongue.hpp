#pragma once

#include <vector>

#include "chart/extended_edge.hpp"
#include "chart/stability_line.hpp"
#include "chart/tongue_on_line.hpp"

namespace strutt {

/// Tongue n of an equation with damping on a line: what is left of that without; see tongues().
class DampedTongue {
 public:
  DampedTongue(LineEquation& equation, TongueOnLine& undamped, StabilityLine& verdicts,
               ExtendedEdges& extended, const TongueLine& line, const TongueOptions& options)
      : equation_(equation),
        undamped_(undamped),
        verdicts_(verdicts),
        extended_(extended),
        line_(line),
        options_(options) {}

  std::vector<TongueEdge> edges();

 private:
  /// What is left of a narrow undamped tongue. The width is 0 with the relative error 1 if that is nothing.
  struct Narrow {
    double middle, position_error;
    TongueWidth width;
    double growth;  ///< the largest, with damping
    double uneven;  ///< by how much h/h0 differs between both undamped edges, relatively
  };
  Narrow narrow(const Stretch& stretch);
  bool clearly_closed(const Stretch& stretch);

  std::vector<StabilityChange> changes_in(const Stretch& stretch, double from, double to);
  bool only_mean_changes(double from, double to);
  Margin log_excess(double position);
  bool add_narrow(const Stretch& stretch);
  void add_wide(const Stretch& stretch);
  TongueEdge edge(double position, double error, bool upper) const;
  void add_width(TongueEdge& low, TongueEdge& high, const std::optional<Narrow>& estimate) const;
  void add_growth(TongueEdge& low, TongueEdge& high) const;
  std::optional<double> sharpen(TongueEdge& edge) const;
  void sharpen_rest(std::size_t first);
  void sharpen_pair(TongueEdge& low, TongueEdge& high) const;

  LineEquation& equation_;
  TongueOnLine& undamped_;
  StabilityLine& verdicts_;
  ExtendedEdges& extended_;
  const TongueLine& line_;
  const TongueOptions& options_;
  std::vector<TongueEdge> edges_;
  int crossing_ = 0;
};

}  // namespace strutt
