#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "chart/cell_columns.hpp"
#include "chart/cell_row.hpp"
#include "chart/hill_model.hpp"
#include "chart/matrix_cell.hpp"
#include "chart/product_table.hpp"
#include "chart/surrogate_grid.hpp"
#include "strutt/base/parallel.hpp"
#include "strutt/chart/stability_chart.hpp"
#include "strutt/floquet/stability.hpp"

namespace strutt {

/// The cells of a chart from a surrogate, strip by strip.
class SurrogateCells {
 public:
  /// Builds the surrogate; see Surrogate::cancelled. For a scene that Surrogate::refusal accepts.
  SurrogateCells(const Scene& scene, const ChartRequest& request);

  const Surrogate& surrogate() const { return surrogate_; }

  /// Fills the cells of the strip whose error and verdict the surrogate can answer for, counts them in
  /// `summary` and puts the places of the others into `rest`, in order. False: cancelled.
  bool fill(ChartStrip& strip, ChartSummary& summary, std::vector<std::size_t>& rest);

 private:
  /// What a piece adds to the summary.
  struct Count {
    std::size_t cells = 0, unresolved = 0;
    double largest_error = 0.0;
  };
  struct Worker {
    FactorRow factors;
    CellRow cells;
    CellColumns columns;
    std::vector<double> quarter_turns;
    std::unique_ptr<HillModel> model;    // kind half_period: to count turns
    std::unique_ptr<MatrixCell> matrix;  // kind period
  };

  Count fill_traces(const GridPiece& piece, ChartStrip& strip, Worker& worker);
  Count fill_matrices(const GridPiece& piece, ChartStrip& strip, Worker& worker);
  Count fill_piece(const GridPiece& piece, ChartStrip& strip, Worker& worker);
  void compute_cells(const GridPiece& piece, Worker& worker) const;
  void count_turns(const GridPiece& piece, Worker& worker) const;
  double quadrant_at(const GridPiece& piece, std::size_t c, Worker& worker) const;
  Count write(const GridPiece& piece, const CellRow& cells, ChartStrip& strip);

  ChartRequest request_;
  bool with_verdict_ = false;
  ParallelOptions parallel_;
  Surrogate surrogate_;
  std::vector<SurrogateBox> boxes_;  // of the surrogate, or with the discriminant alone
  SurrogateGrid grid_;
  ProductTable half_damping_, kappa_square_;
  std::vector<Worker> workers_;
  std::vector<char> done_;  // cells of the strip
};

}  // namespace strutt
